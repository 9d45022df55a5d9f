#include <apps/cli/output/table.hpp>

#include <fmt/format.h>

namespace svt::cli {

void print(const Table& table, TableFormat format, bool hasHeader) {
    if (format == TableFormat::Text) return fmt::print("{}", makeText(table));
    if (format == TableFormat::JsonRows) return fmt::print("{}", makeJson(table));
    if (hasHeader) fmt::print("{}", csvHeader(table.columns, writers::CsvForm::Stream));
    for (const Row& row : table.rows) fmt::print("{}", csvLine(row, writers::CsvForm::Stream));
}

}  // namespace svt::cli
