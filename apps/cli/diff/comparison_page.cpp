#include <apps/cli/diff/comparison_page.hpp>

#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/compare/difference_volume.hpp>
#include <svt/core/names.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

namespace svt::cli {
namespace {

using compare::Change;

constexpr std::size_t kMostRows = 2000;
constexpr std::size_t kMostStoreys = 24;  // with pictures
constexpr std::size_t kMostProperties = 6;

constexpr std::string_view kDiffHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>svt diff</title><style>
body{font:15px/1.5 system-ui,sans-serif;color:#1b1f24;max-width:88rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2.2rem;border-bottom:1px solid #d5dae0}h3{font-size:1.05rem;margin:1.4rem 0 .3rem}
.t{overflow-x:auto}table{border-collapse:collapse;margin:.6rem 0}
td,th{text-align:left;vertical-align:top;padding:.2rem .9rem .2rem 0;border-bottom:1px solid #e6e9ed}
.n{text-align:right;font-variant-numeric:tabular-nums}code{font-family:ui-monospace,monospace;font-size:.92em;overflow-wrap:anywhere}
section{break-inside:avoid}.p{display:flex;gap:1rem;flex-wrap:wrap}figure{margin:0}figcaption{color:#5b6570;font-size:.85em}
img{border:1px solid #d5dae0;max-width:100%;height:auto}.r code{display:inline-block;min-width:25ch}.r td:first-child{white-space:nowrap}.r td:nth-child(5){min-width:11em}.r td:last-child{min-width:20em}.s{display:inline-block;width:.8em;height:.8em;margin-right:.4em;border:1px solid #8a929b}
ul.l{list-style:none;padding:0;display:flex;flex-wrap:wrap;gap:.2rem 1.4rem}
</style></head><body>
)";

// RFC 4648.
std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t n = 0; n < bytes.size(); n += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - n);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8 | (i < count ? std::to_integer<std::uint32_t>(bytes[n + i]) : 0);
        for (std::size_t i = 0; i < 4; ++i) text += i <= count ? kDigits[group >> (18 - 6 * i) & 63] : '=';
    }
    return text;
}

std::string swatch(Change change) {
    const Vec3f color = compare::colorOfChange(change);
    const auto byte = [](float part) { return static_cast<int>(part * 255 + 0.5f); };
    return fmt::format("<span class=\"s\" style=\"background:#{:02x}{:02x}{:02x}\"></span>", byte(color.x),
                       byte(color.y), byte(color.z));
}

std::string cubicMetres(const std::optional<double>& volume) {
    return volume ? fmt::format("{:.4f}", *volume) : std::string("unknown");
}

std::string inputRow(std::string_view name, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>", name, value);
}

std::string stateText(const std::string& file, const volume::SemanticVolume& volume) {
    std::string text = fmt::format("<code>{}</code>", xmlAttribute(file));
    if (!volume.modelName.empty()) text += ", " + xmlAttribute(volume.modelName);
    return text +
           fmt::format(", {} features, {}", volume.labels.labels.size(),
                       volume.crsName.empty() ? std::string("reference system unknown") : xmlAttribute(volume.crsName));
}

std::string gridText(const volume::Grid& grid) {
    const Vec3i n = grid.dimension();
    const Vec3d s = grid.spacing();
    return fmt::format("{} x {} x {} samples, {:g} x {:g} x {:g} m apart", n.x, n.y, n.z, s.x, s.y, s.z);
}

std::string inputsTable(const Compared& compared) {
    const compare::CompareOptions& options = compared.options;
    std::string text =
        "<table>" + inputRow("old", stateText(compared.wasFile, compared.was)) +
        inputRow("new", stateText(compared.isFile, compared.is)) +
        inputRow("grid of the old state", gridText(compared.was.grid)) +
        inputRow("grid of the new state", gridText(compared.is.grid)) +
        inputRow("tolerance", fmt::format("{:g} m", options.tolerance)) +
        inputRow("objects matched by", std::string(options.match == compare::MatchBy::Both    ? "space and ids"
                                                   : options.match == compare::MatchBy::Space ? "space"
                                                                                              : "ids")) +
        inputRow("properties compared", std::string(nameOf(options.properties)));
    if (length(compared.shift) > 0)
        text += inputRow("new state moved by",
                         fmt::format("{:.4f}, {:.4f}, {:.4f} m", compared.shift.x, compared.shift.y, compared.shift.z));
    return text + "</table>\n";
}

std::string limitsText(const Compared& compared) {
    std::string text;
    const compare::Comparison& comparison = compared.comparison;
    if (comparison.isReferenceSystemUnknown)
        text += "<p>The reference system of a model is unknown. The coordinates are compared as they are.</p>\n";
    if (!comparison.isOnOneLattice)
        text +=
            "<p>The two volumes have different sample positions. Objects without closed meshes have no volumes.</p>\n";
    if (!comparison.isComplete)
        text += "<p>Some pairs of objects have too many faces for exact volumes. Their volumes come from voxels.</p>\n";
    if (const std::string ambiguous = ambiguousText(comparison); !ambiguous.empty())
        text += "<p>" + ambiguous + ".</p>\n";
    return text;
}

// m3 by class, with a swatch for each colour.
std::string sumsTable(const Compared& compared, std::span<const std::uint32_t> rows) {
    const std::vector<ClassSums> sums = sumsByClass(compared, rows);
    if (sums.empty()) return {};
    std::string text = "<div class=\"t\"><table><tr><th>class</th>";
    for (const std::string& heading :
         {std::string("objects"), swatch(Change::Added) + "added m3", swatch(Change::Removed) + "removed m3",
          std::string("each +- m3"), std::string("without volume")})
        text += "<th class=\"n\">" + heading + "</th>";
    text += "</tr>";
    for (const ClassSums& sum : sums)
        text += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            xmlAttribute(sum.className), sum.objects, cubicMetres(sum.added), cubicMetres(sum.removed),
            cubicMetres(sum.bound), sum.unknown);
    return text + "</table></div>\n";
}

std::string countsList(const std::array<std::size_t, compare::kChangeCount>& counts) {
    std::string text = "<ul class=\"l\">";
    for (std::size_t change = compare::kChangeCount; change-- > 0;)
        if (counts[change] > 0)
            text += fmt::format("<li>{}{} {}</li>", swatch(static_cast<Change>(change)), counts[change],
                                nameOf(static_cast<Change>(change)));
    return text + "</ul>\n";
}

bool isNumeric(const Column& column) {
    return column.title.ends_with(" m") || column.title.ends_with(" m3") || column.title.ends_with(" deg");
}

std::string cellHtml(const Cell& cell, const Column& column) {
    const auto text = [&]() -> std::string {
        if (const double* number = std::get_if<double>(&cell.value))
            return fmt::format("{:.{}f}", *number, column.decimals);
        if (cell.isEmpty()) return "-";
        if (const bool* truth = std::get_if<bool>(&cell.value)) return *truth ? "yes" : "no";
        return writers::cellText(cell);
    }();
    const bool isId = column.name == "old" || column.name == "new";
    return fmt::format("<td{}>{}</td>", isNumeric(column) ? " class=\"n\"" : "",
                       isId && !text.empty() ? fmt::format("<code>{}</code>", xmlAttribute(text)) : xmlAttribute(text));
}

std::string rowsTable(const Compared& compared, std::span<const std::uint32_t> rows) {
    compare::Comparison sorted;
    for (const std::uint32_t r : rows.first(std::min(rows.size(), kMostRows)))
        sorted.rows.push_back(compared.comparison.rows[r]);
    const Table table = comparisonTable({compared.was, compared.is, sorted}, true, kMostProperties);
    std::string text =
        "<h2>Changes</h2>\n<p>The largest change comes first. Objects with unknown volumes follow, then "
        "objects with other properties only.</p>\n<div class=\"t\"><table class=\"r\"><tr>";
    for (const Column& column : table.columns)
        text += fmt::format("<th{}>{}</th>", isNumeric(column) ? " class=\"n\"" : "", xmlAttribute(column.title));
    text += "</tr>\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        text += "<tr>";
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (c == 0)
                text += fmt::format("<td>{}{}</td>", swatch(sorted.rows[r].change),
                                    xmlAttribute(writers::cellText(table.rows[r][c])));
            else
                text += cellHtml(table.rows[r][c], table.columns[c]);
        }
        text += "</tr>\n";
    }
    text += "</table></div>\n";
    if (rows.size() > kMostRows)
        text += fmt::format("<p>{} more rows are not in this table. -o changes.csv has all rows.</p>\n",
                            rows.size() - kMostRows);
    return text;
}

std::string pictureHtml(const std::vector<std::byte>& png, const std::string& caption) {
    return fmt::format(
        "<figure><img width=\"560\" height=\"420\" alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}"
        "</figcaption></figure>",
        xmlAttribute(caption), base64(png));
}

// Views follow the axes of the grid, which may be those of the building.
std::string captionOf(bool isPlan, const volume::Grid& grid) {
    if (grid.isAxisParallel()) return isPlan ? "from above, north up" : "from the south-east";
    return isPlan ? "from above, along the axes of the building" : "from a corner of the building";
}

Result<std::string> storeySection(const Compared& compared, const ChangedStorey& storey, ChangePictures* pictures) {
    std::array<std::size_t, compare::kChangeCount> counts{};
    for (const std::uint32_t r : storey.rows) ++counts[std::size_t(compared.comparison.rows[r].change)];
    std::string text =
        fmt::format("<section><h3>{}</h3>\n", storey.name.empty() ? "Without storey" : xmlAttribute(storey.name));
    const bool hasSolids = hasChangedSolids(compared, storey.rows);
    if (pictures != nullptr) {
        text += "<div class=\"p\">";
        for (const bool isPlan : {false, true}) {
            SVT_TRY(png, pictures->drawStorey(storey, isPlan, hasSolids, compared.was.grid));
            text += pictureHtml(*png, captionOf(isPlan, compared.was.grid));
        }
        text += "</div>\n";
    }
    text += countsList(counts) + sumsTable(compared, storey.rows);
    if (!hasSolids) text += "<p>Only rooms or other spaces changed.</p>\n";
    return text + "</section>\n";
}

constexpr std::string_view kColors =
    "<p>Blue space is added and vermilion space is removed. Purple objects moved. Yellow objects changed or were "
    "reassigned. Purple and yellow fill the space that both states share. Unchanged objects are a grey ghost. Rooms "
    "and other spaces are drawn only if nothing else changed. The pictures show voxels, so details below the distance "
    "of the samples are missing; the tables have the volumes.</p>\n";

Result<std::string> storeySections(const Compared& compared, std::span<const std::uint32_t> rows,
                                   ChangePictures* pictures, const std::string& noPictures) {
    const std::vector<ChangedStorey> storeys = changedStoreys(compared, rows);
    if (storeys.empty()) return std::string();
    std::string text = "<h2>Changes by storey</h2>\n";
    if (pictures != nullptr)
        text += kColors;
    else
        text += fmt::format("<p>This page has no pictures: {}.</p>\n", xmlAttribute(noPictures));
    // The storeys with the most changed space have pictures.
    std::vector<std::size_t> order(storeys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto volumeOf = [&](std::size_t s) {
        double volume = 0;
        for (const std::uint32_t r : storeys[s].rows) volume += changedVolume(compared.comparison.rows[r]).value_or(0);
        return volume;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t s, std::size_t t) { return volumeOf(s) > volumeOf(t); });
    std::vector<char> isDrawn(storeys.size(), 0);
    for (std::size_t n = 0; n < std::min(order.size(), kMostStoreys); ++n) isDrawn[order[n]] = 1;
    for (std::size_t s = 0; s < storeys.size(); ++s) {
        SVT_TRY(section, storeySection(compared, storeys[s], isDrawn[s] != 0 ? pictures : nullptr));
        text += *section;
    }
    if (storeys.size() > kMostStoreys)
        text +=
            fmt::format("<p>{} storeys with smaller changes have no pictures.</p>\n", storeys.size() - kMostStoreys);
    return text;
}

}  // namespace

Result<std::string> comparisonPage(const Compared& compared, ChangePictures* pictures, const std::string& noPictures) {
    const std::vector<std::uint32_t> rows = rowsByVolume(compared.comparison);
    std::string text(kDiffHead);
    text += fmt::format("<h1>{} and {}</h1>\n", xmlAttribute(compared.wasFile), xmlAttribute(compared.isFile));
    text += rows.empty() ? "<p><b>The two states do not differ.</b></p>\n"
                         : fmt::format("<p><b>{} rows differ.</b></p>\n", rows.size());
    text += inputsTable(compared) + limitsText(compared);
    text += "<h2>Summary</h2>\n" + countsList(compared.comparison.counts);
    const std::size_t added = compared.comparison.groups[std::size_t(Change::Added)],
                      removed = compared.comparison.groups[std::size_t(Change::Removed)];
    if (added + removed > 0)
        text +=
            fmt::format("<p>Without geometry, such as storeys and groups: {} added, {} removed.</p>\n", added, removed);
    if (compared.comparison.otherProperties > 0)
        text += fmt::format("<p>{} rows have another class, name, storey or attributes ({}).</p>\n",
                            compared.comparison.otherProperties, propertiesText(compared.comparison.properties));
    const std::string sums = sumsTable(compared, rows);
    if (!sums.empty())
        text += sums + "<p>The sums are by class, because objects of different classes contain each other.</p>\n";
    SVT_TRY(storeys, storeySections(compared, rows, pictures, noPictures));
    text += *storeys;
    if (!rows.empty()) text += rowsTable(compared, rows);
    return text + "</body></html>\n";
}

}  // namespace svt::cli
