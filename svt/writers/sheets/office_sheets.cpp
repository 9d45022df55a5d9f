#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/opening_schedule.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/office_sheets.hpp>
#include <svt/writers/sheets/sheet_layout.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace svt::writers {
namespace {

std::string levelText(const std::vector<drawing::BuildingLevel>& levels, std::size_t level, SheetLanguage language) {
    if (level >= levels.size()) return {};
    if (!levels[level].name.empty()) return levels[level].name;
    return fmt::format("{} {}", sheetWord(SheetWord::Level, language),
                       numberText(levels[level].floor - drawing::zeroLevel(levels), 2, language));
}

SheetTable tableOfOpenings(const drawing::OpeningSchedule& openings, const std::vector<drawing::BuildingLevel>& levels,
                           bool ofDoors, SheetLanguage language) {
    const auto word = [&](SheetWord w) { return std::string(sheetWord(w, language)); };
    SheetTable table{word(ofDoors ? SheetWord::Doors : SheetWord::Windows),
                     {{word(SheetWord::Mark)},
                      {std::string(sheetWord(SheetWord::Type, language))},
                      {std::string(sheetWord(SheetWord::Storey, language))},
                      {word(SheetWord::Width), true},
                      {word(SheetWord::WidthMeasured), true},
                      {word(SheetWord::WidthClear), true},
                      {word(SheetWord::Height), true},
                      {word(SheetWord::HeightMeasured), true},
                      {word(SheetWord::Sill), true},
                      {std::string(sheetWord(SheetWord::Count, language)), true}},
                     {},
                     1};
    std::size_t count = 0;
    bool hasClear = false;
    const auto size = [&](const std::optional<double>& metres) {
        return metres ? numberText(*metres, 3, language) : std::string("\u2013");
    };
    for (const drawing::OpeningRow& row : openings.rows) {
        if (row.isDoor != ofDoors) continue;
        table.rows.push_back({row.mark, row.type, levelText(levels, row.level, language), size(row.statedWidth),
                              size(row.measuredWidth), size(row.clearWidth), size(row.statedHeight),
                              size(row.measuredHeight), size(row.sill), fmt::format("{}", row.labels.size())});
        hasClear = hasClear || row.clearWidth;
        count += row.labels.size();
    }
    if (count == 0) return {};
    table.rows.push_back(
        {"", std::string(sheetWord(SheetWord::Total, language)), "", "", "", "", "", "", "", fmt::format("{}", count)});
    if (hasClear) return table;
    constexpr std::ptrdiff_t kClear = 5;
    table.columns.erase(table.columns.begin() + kClear);
    for (auto& row : table.rows) row.erase(row.begin() + kClear);
    return table;
}

Cell cellOf(const std::optional<double>& metres) { return metres ? Cell(*metres) : Cell(); }

}  // namespace

std::vector<SheetTable> makeOpeningTables(const drawing::OpeningSchedule& openings,
                                          const std::vector<drawing::BuildingLevel>& levels, SheetLanguage language) {
    std::vector<SheetTable> tables;
    for (const bool ofDoors : {true, false})
        if (SheetTable table = tableOfOpenings(openings, levels, ofDoors, language); !table.rows.empty())
            tables.push_back(std::move(table));
    return tables;
}

Table openingTable(const drawing::OpeningSchedule& schedule, const std::vector<drawing::BuildingLevel>& levels,
                   const volume::LabelTable& labels) {
    Table table;
    for (const char* name : {"mark", "kind", "type", "storey", "overallWidth", "overallHeight", "measuredWidth",
                             "measuredHeight", "clearWidth", "sill", "count", "ids"})
        table.columns.push_back({name});
    for (const drawing::OpeningRow& row : schedule.rows) {
        std::vector<std::string> ids;
        for (const std::uint32_t label : row.labels) ids.push_back(labels.labels[label].id);
        table.rows.push_back({row.mark, row.isDoor ? "door" : "window", row.type,
                              levelText(levels, row.level, SheetLanguage::English), cellOf(row.statedWidth),
                              cellOf(row.statedHeight), cellOf(row.measuredWidth), cellOf(row.measuredHeight),
                              cellOf(row.clearWidth), cellOf(row.sill), row.labels.size(), std::move(ids)});
    }
    return table;
}

Result<std::string> smallestPaper(const SheetContent& content, const volume::SemanticVolume& volume,
                                  const SheetOptions& options) {
    constexpr std::array kPapers = {"A4", "A3", "A2", "A1", "A0"};
    SheetOptions attempt = options;
    SheetContent cropped = content;
    const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(volume);
    for (DrawnView& view : cropped.views) view.drawing = drawing::croppedToBuilding(view.drawing, isAround);
    for (const char* paper : kPapers) {
        attempt.paper = paper;
        const auto layout = layOutSheets(cropped, attempt);
        if (layout) return std::string(paper);
        if (paper == kPapers.back())
            return Error(layout.error().code(), layout.error().message() + ", or leave out parts with --hide");
    }
    return std::string(kPapers.back());
}

std::vector<std::string> emptyBlockOptions(const drawing::TitleBlock& block) {
    std::vector<std::string> empty;
    for (const auto& [text, option] : {std::pair(&block.number, "--number"), std::pair(&block.creator, "--creator"),
                                       std::pair(&block.approver, "--approver"), std::pair(&block.date, "--issued"),
                                       std::pair(&block.owner, "--owner")})
        if (text->empty()) empty.emplace_back(option);
    return empty;
}

}  // namespace svt::writers
