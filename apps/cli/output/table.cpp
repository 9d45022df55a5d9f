#include <apps/cli/output/table.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::cli {
namespace {

// Two decimals more than text has, but at least four digits: a measured area of 15.6499996 m2 is 15.65 m2.
double roundedForCsv(double value, int decimals) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int digits = 3 - static_cast<int>(std::floor(std::log10(std::abs(value))));
    return parseNumber(fmt::format("{:.{}f}", value, std::clamp(digits, decimals + 2, 30))).value_or(value);
}

Row roundedForCsv(Row row, const std::vector<Column>& columns) {
    for (std::size_t c = 0; c < row.size(); ++c)
        if (auto* number = std::get_if<double>(&row[c].value)) *number = roundedForCsv(*number, columns[c].decimals);
    return row;
}

}  // namespace

void print(const Table& table, TableFormat format, bool hasHeader) {
    if (format == TableFormat::Text) return fmt::print("{}", makeText(table));
    if (format == TableFormat::JsonRows) return fmt::print("{}", makeJson(table));
    if (hasHeader) fmt::print("{}", csvHeader(table.columns, writers::CsvForm::Stream));
    for (const Row& row : table.rows)
        fmt::print("{}", csvLine(roundedForCsv(row, table.columns), writers::CsvForm::Stream));
}

}  // namespace svt::cli
