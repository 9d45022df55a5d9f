#include <svt/readers/owner_table.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/gis/sqlite_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

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

constexpr std::string_view kOwnerColumns[] = {"feature", "owner", "share", "right", "source"};

// The columns of a table that its rows of owners have, as (name in SQL, name in the CSV); empty: it has no owners.
std::vector<std::pair<std::string, std::string_view>> ownerColumns(const std::vector<std::string>& names) {
    std::vector<std::pair<std::string, std::string_view>> columns;
    for (const std::string_view wanted : kOwnerColumns) {
        const auto at = std::find_if(names.begin(), names.end(),
                                     [&](const std::string& name) { return equalsIgnoringCase(name, wanted); });
        const bool isNeeded = wanted == "feature" || wanted == "owner";
        if (at == names.end() && isNeeded) return {};
        if (at != names.end()) columns.emplace_back(gis::quotedName(*at), wanted);
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
        const auto columns = ownerColumns(*names);
        if (columns.empty()) continue;
        std::string text, list;
        for (const auto& [column, name] : columns) {
            list += (list.empty() ? "" : ",") + column;
            text += (text.empty() ? "" : ",") + std::string(name);
        }
        text += "\n";
        SVT_DO(
            database->select(fmt::format("SELECT {} FROM {}", list, gis::quotedName(table)), [&](const SqliteRow& row) {
                for (std::size_t n = 0; n < row.size(); ++n) text += (n == 0 ? "" : ",") + csvField(row[n]);
                text += "\n";
            }));
        return text;
    }
    return Error(Code::BadValue, "owners table: no table with the columns feature and owner; rename the columns",
                 {path.string(), 0, 0, {}});
}

}  // namespace svt::readers
