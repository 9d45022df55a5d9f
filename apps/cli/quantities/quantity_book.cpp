#include <apps/cli/quantities/quantity_book.hpp>

#include <apps/cli/output/version.hpp>

#include <svt/writers/xlsx_file.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::cli {
namespace {

constexpr const char* kBookTitle = "Quantities";
constexpr int kBoundDecimals = 6;  // bounds of closed meshes are far below a litre

writers::XlsxSheet quantitySheet(std::string name, Table table, const QuantitySettings& settings) {
    for (Column& column : table.columns)
        if (column.name == "bound" || column.name == "grossBound") column.decimals = kBoundDecimals;
    std::vector<std::string> headings = quantityHeadings(table, settings);
    return {std::move(name), std::move(table), std::move(headings)};
}

writers::XlsxSheet aboutSheet(const BookAbout& about, const QuantitySettings& settings) {
    Table table;
    table.columns = {{"about"}, {"value"}};
    const bool isGerman = settings.language == "de";
    const Vec3d s = about.spacing;
    table.rows.push_back({isGerman ? "Eingabe" : "Input", about.input});
    table.rows.push_back({isGerman ? "Rasterweite" : "Spacing", fmt::format("{} x {} x {} m", s.x, s.y, s.z)});
    table.rows.push_back({"Version", fmt::format("svt {}", versionNumber())});
    for (const std::string& text : about.assumptions) table.rows.push_back({isGerman ? "Annahme" : "Assumption", text});
    for (const std::string& text : about.notes) table.rows.push_back({isGerman ? "Hinweis" : "Note", text});
    writers::XlsxSheet sheet = quantitySheet("About", std::move(table), settings);
    sheet.hasFilter = false;
    return sheet;
}

// A sheet of some columns of the rows, without the objects whose figure in `needed` is unknown.
Result<writers::XlsxSheet> partSheet(std::string name, const Table& rows, std::vector<std::string> columns,
                                     const std::string& needed, const QuantitySettings& settings) {
    QuantitySettings part = settings;
    part.columns = std::move(columns);
    SVT_TRY(table, withQuantitySettings(rows, part));
    std::size_t at = 0;
    while (table->columns[at].name != needed) ++at;
    std::vector<Row> known;
    for (Row& row : table->rows)
        if (!row[at].isEmpty()) known.push_back(std::move(row));
    table->rows = std::move(known);
    return quantitySheet(std::move(name), std::move(*table), settings);
}

TakeOff withKeys(const TakeOff& takeOff) {
    TakeOff result = takeOff;
    if (!result.keys.empty()) return result;
    result.keys = {"class"};
    result.values.clear();
    for (const auto& object : result.objects)
        result.values.push_back({result.volume.labels.labels[object.label].className});
    return result;
}

}  // namespace

Result<std::string> takeOffBook(const TakeOff& takeOff, bool hasStated, const BookAbout& about,
                                const QuantitySettings& settings) {
    const Table rows = takeOffTable(takeOff, false);
    SVT_TRY(table, withQuantitySettings(rows, settings));
    std::vector<writers::XlsxSheet> sheets;
    sheets.push_back(quantitySheet(kBookTitle, std::move(*table), settings));
    const TakeOff keyed = withKeys(takeOff);
    SVT_TRY(sums, withQuantitySettings(takeOffSums(keyed, true), settings, keyed.keys.size() + 1));
    sheets.push_back(quantitySheet("Sums", std::move(*sums), settings));
    if (takeOff.hasExterior) {
        std::vector<std::string> columns{"id", "class", "name", "exteriorArea"};
        for (const std::string_view facing : quantities::kFacingNames)
            columns.push_back("exterior_" + std::string(facing));
        SVT_TRY(sheet, partSheet("Exterior", rows, std::move(columns), "exteriorArea", settings));
        sheets.push_back(std::move(*sheet));
    }
    if (takeOff.hasFormwork) {
        SVT_TRY(sheet, partSheet("Formwork", rows, {"id", "class", "name", "formworkArea", "formworkTopArea"},
                                 "formworkArea", settings));
        sheets.push_back(std::move(*sheet));
    }
    if (hasStated) sheets.push_back(quantitySheet("Stated", statedTable(takeOff), settings));
    sheets.push_back(aboutSheet(about, settings));
    return writers::makeXlsx(sheets, kBookTitle);
}

Result<std::string> contactBook(const Table& contacts, const BookAbout& about, const QuantitySettings& settings) {
    const writers::XlsxSheet sheets[] = {quantitySheet("Between", contacts, settings), aboutSheet(about, settings)};
    return writers::makeXlsx(sheets, kBookTitle);
}

}  // namespace svt::cli
