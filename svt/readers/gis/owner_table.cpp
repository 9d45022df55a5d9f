#include <svt/readers/owner_table.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/gis/sqlite_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::readers {
namespace {

using gis::SqliteFile;
using gis::SqliteRow;
using gis::SqliteValue;

constexpr std::uint64_t kMaxTableBytes = std::uint64_t{64} << 20;

std::string csvField(const SqliteValue& value) {
    std::string text;
    if (const auto* known = std::get_if<std::string>(&value)) text = *known;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) text = std::to_string(*whole);
    if (const auto* number = std::get_if<double>(&value)) text = fmt::format("{}", *number);
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// The columns feature, owner and share of a table, in this order; empty: it has no owners.
std::vector<std::string> ownerColumns(const std::vector<std::string>& names) {
    std::vector<std::string> columns;
    for (const std::string_view wanted : {"feature", "owner", "share"}) {
        const auto at = std::find_if(names.begin(), names.end(),
                                     [&](const std::string& name) { return equalsIgnoringCase(name, wanted); });
        if (at == names.end() && wanted != "share") return {};
        if (at != names.end()) columns.push_back(gis::quotedName(*at));
    }
    return columns;
}

}  // namespace

Result<std::string> readOwnerTable(const std::filesystem::path& path) {
    SVT_TRY(file, FileBytes::read(path, kMaxTableBytes));
    if (!file->text().starts_with("SQLite format 3")) return std::string(file->text());
    SVT_TRY(database, SqliteFile::open(path));
    std::vector<std::string> tables;
    SVT_DO(database->select("SELECT name FROM sqlite_master WHERE type IN ('table','view')", [&](const SqliteRow& row) {
        if (const auto* name = std::get_if<std::string>(&row[0])) tables.push_back(*name);
    }));
    for (const std::string& table : tables) {
        const auto names =
            database->select("SELECT * FROM " + gis::quotedName(table) + " LIMIT 0", [](const SqliteRow&) {});
        if (!names) continue;  // a virtual table whose module is not loaded
        const std::vector<std::string> columns = ownerColumns(*names);
        if (columns.empty()) continue;
        // Rows without a share leave the column out, as in a CSV.
        std::string text, list;
        for (const std::string& column : columns) list += (list.empty() ? "" : ",") + column;
        SVT_DO(
            database->select(fmt::format("SELECT {} FROM {}", list, gis::quotedName(table)), [&](const SqliteRow& row) {
                text += csvField(row[0]) + "," + csvField(row[1]);
                if (row.size() > 2 && row[2].index() != 0) text += "," + csvField(row[2]);
                text += "\n";
            }));
        return text;
    }
    return Error(Code::BadValue, "owners table: no table with the columns feature and owner; rename the columns",
                 {path.string(), 0, 0, {}});
}

}  // namespace svt::readers
