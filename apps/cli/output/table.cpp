#include <apps/cli/output/table.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

std::string joined(const Json& list) {
    std::string text;
    for (const Json& item : list) text += (text.empty() ? "" : " ") + item.get<std::string>();
    return text;
}

std::string textOf(const Json& cell, int decimals) {
    if (cell.is_null()) return "-";
    if (cell.is_string()) return cell.get<std::string>();
    if (cell.is_array()) return joined(cell);
    if (cell.is_number_float()) return fmt::format("{:.{}f}", cell.get<double>(), decimals);
    return cell.dump();
}

std::string csvOf(const Json& cell) {
    if (cell.is_null()) return "";
    if (!cell.is_string() && !cell.is_array()) return cell.dump();
    std::string text = cell.is_array() ? joined(cell) : cell.get<std::string>();
    if (text.find_first_of(",;\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// Counts letters, not bytes.
std::size_t widthOf(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

Json Table::toJson() const {
    Json list = Json::array();
    for (const std::vector<Json>& row : rows) {
        Json object = Json::object();
        for (std::size_t c = 0; c < columns.size(); ++c) object[columns[c].key] = row[c];
        list.push_back(std::move(object));
    }
    return list;
}

void Table::printText() const {
    std::vector<std::vector<std::string>> lines(1);
    std::vector<std::size_t> width;
    std::vector<bool> isNumber(columns.size(), true);
    for (const Column& column : columns) {
        lines[0].push_back(column.title);
        width.push_back(widthOf(column.title));
    }
    for (const std::vector<Json>& row : rows) {
        lines.emplace_back();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            lines.back().push_back(textOf(row[c], columns[c].decimals));
            width[c] = std::max(width[c], widthOf(lines.back().back()));
            isNumber[c] = isNumber[c] && (row[c].is_number() || row[c].is_null());
        }
    }
    for (const std::vector<std::string>& line : lines) {
        std::string text;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c].title.empty()) continue;
            const std::string pad(width[c] - widthOf(line[c]), ' ');
            text += (text.empty() ? "" : "  ") + (isNumber[c] ? pad + line[c] : line[c] + pad);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        fmt::print("{}\n", text);
    }
}

void Table::printCsv() const {
    std::string text;
    for (std::size_t c = 0; c < columns.size(); ++c) text += (c == 0 ? "" : ",") + columns[c].key;
    fmt::print("{}\n", text);
    printCsvRows();
}

void Table::printCsvRows() const {
    std::string text;
    for (const std::vector<Json>& row : rows) {
        text.clear();
        for (std::size_t c = 0; c < columns.size(); ++c) text += (c == 0 ? "" : ",") + csvOf(row[c]);
        fmt::print("{}\n", text);
    }
}

}  // namespace svt::cli
