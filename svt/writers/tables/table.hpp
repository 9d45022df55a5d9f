#pragma once
/// \file
/// A table as its formats are written from it: named columns of cells.

#include <svt/core/result.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace svt::writers {

/// Nothing, or a value. What stands in a column may be of several kinds, as attributes of models are.
using TableCell = std::variant<std::monostate, std::string, std::int64_t, double, float, bool>;

struct TableColumn {
    std::string name;
    std::vector<TableCell> cells;
};

struct Table {
    std::vector<TableColumn> columns;                        ///< all of the same length
    std::vector<std::pair<std::string, std::string>> notes;  ///< of the whole, where the format has a place for them

    [[nodiscard]] std::size_t rows() const noexcept { return columns.empty() ? 0 : columns.front().cells.size(); }
};

/// Comma-separated values (RFC 4180, UTF-8, a header line); notes are left out.
[[nodiscard]] std::string makeCsv(const Table& table);

/// Apache Parquet: one row group, plain encoding, not compressed. A column whose cells are all whole numbers is INT64, of
/// numbers DOUBLE (FLOAT), of truth values BOOLEAN, else UTF-8 text; one with empty cells is optional. Notes are key/value
/// metadata. Source: the format's own parquet.thrift and Encodings.md.
/// \return the file, or GridTooLarge where a column would have 2 GiB
[[nodiscard]] Result<std::string> makeParquet(const Table& table);

}  // namespace svt::writers
