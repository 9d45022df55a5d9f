#pragma once
/// \file
/// Tables on stdout.

#include <svt/writers/table.hpp>

namespace svt::cli {

using writers::Cell;
using writers::Column;
using writers::Row;
using writers::Table;

enum class TableFormat : std::uint8_t { Text, Csv, JsonRows };

/// Prints a table on stdout. \param hasHeader  for CSV; false: rows that continue a table
void print(const Table& table, TableFormat format, bool hasHeader = true);

}  // namespace svt::cli
