#include <svt/writers/tables/cell_json.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

struct TextOfValue {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(const Blob&) const { return {}; }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const JsonArray& array) const { return array.text; }
    std::string operator()(const std::vector<std::string>& texts) const {
        return fmt::format("{}", fmt::join(texts, " "));
    }
    template <class Plain>
    std::string operator()(Plain value) const {
        return fmt::format("{}", value);
    }
};

std::string alignedText(const Cell& cell, int decimals) {
    if (cell.isEmpty()) return "-";
    if (const auto* number = std::get_if<double>(&cell.value)) return fmt::format("{:.{}f}", *number, decimals);
    if (const auto* small = std::get_if<float>(&cell.value)) return fmt::format("{:.{}f}", *small, decimals);
    return cellText(cell);
}

bool isNumberOrEmpty(const Cell& cell) {
    return cell.isEmpty() || std::holds_alternative<std::int64_t>(cell.value) ||
           std::holds_alternative<double>(cell.value) || std::holds_alternative<float>(cell.value);
}

}  // namespace

void appendCorners(Row& row, const Box3d& box) {
    for (const Vec3d& corner : {box.min, box.max})
        for (int axis = 0; axis < 3; ++axis) {
            Cell& cell = row.emplace_back();
            if (!box.isEmpty()) cell.value = corner[axis];
        }
}

std::string cellText(const Cell& cell) { return std::visit(TextOfValue(), cell.value); }

std::string makeText(const Table& table) {
    std::vector<std::vector<std::string>> lines(1);
    std::vector<std::size_t> width;
    std::vector<bool> isNumber(table.columns.size(), true);
    for (const Column& column : table.columns) {
        lines[0].push_back(column.title);
        width.push_back(characterCount(column.title));
    }
    for (const Row& row : table.rows) {
        lines.emplace_back();
        for (std::size_t c = 0; c < row.size(); ++c) {
            lines.back().push_back(alignedText(row[c], table.columns[c].decimals));
            width[c] = std::max(width[c], characterCount(lines.back().back()));
            isNumber[c] = isNumber[c] && isNumberOrEmpty(row[c]);
        }
    }
    std::string all;
    for (const std::vector<std::string>& line : lines) {
        std::string text;
        for (std::size_t c = 0; c < line.size(); ++c) {
            if (table.columns[c].title.empty()) continue;
            const std::string pad(width[c] - characterCount(line[c]), ' ');
            text += (text.empty() ? "" : "  ") + (isNumber[c] ? pad + line[c] : line[c] + pad);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        all += text + "\n";
    }
    return all;
}

std::string makeJson(const Table& table) {
    using Json = nlohmann::ordered_json;
    Json list = Json::array();
    for (const Row& row : table.rows) {
        Json& object = list.emplace_back(Json::object());
        for (std::size_t c = 0; c < row.size(); ++c) object[table.columns[c].name] = cellJson(row[c]);
    }
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csvLine(std::span<const Cell> cells, CsvForm form) {
    const bool isFile = form == CsvForm::File;
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (c > 0) line += ',';
        const auto* real = std::get_if<double>(&cells[c].value);
        // Twelve digits: a sum of 129.98706249999998 is 129.9870625.
        const std::string text = real == nullptr ? cellText(cells[c])
                                 : isFile        ? fmt::format("{:.12g}", *real)
                                                 : cellJson(cells[c]).dump();
        if (text.find_first_of(isFile ? ",\"\r\n" : ",;\"\r\n") == std::string::npos) {
            line += text;
            continue;
        }
        line += '"';
        for (const char letter : text) line.append(letter == '"' ? 2 : 1, letter);
        line += '"';
    }
    return line += isFile ? "\r\n" : "\n";
}

std::string csvHeader(std::span<const Column> columns, CsvForm form) {
    Row names;
    for (const Column& column : columns) names.emplace_back(column.name);
    return csvLine(names, form);
}

std::string makeCsv(const Table& table) {
    std::string csv = csvHeader(table.columns);
    for (const Row& row : table.rows) csv += csvLine(row);
    return csv;
}

}  // namespace svt::writers
