#pragma once
/// \file
/// A table with text, CSV and JSON output.

#include <apps/cli/output/json_output.hpp>

#include <string>
#include <vector>

namespace svt::cli {

struct Column {
    std::string key;    ///< in JSON and CSV
    std::string title;  ///< in text; empty: not shown there
    int decimals = 3;   ///< of floating-point numbers in text
};

/// Rows of strings, numbers, null (`-` in text, empty in CSV) and arrays of strings (joined by blanks).
struct Table {
    std::vector<Column> columns;
    std::vector<std::vector<Json>> rows;

    /// An array of objects.
    [[nodiscard]] Json toJson() const;
    /// Columns are as wide as needed, numbers right-aligned.
    void printText() const;
    /// RFC 4180 with a header line of keys, separated by commas; numbers in full precision.
    void printCsv() const;
    /// The same without the header line, for rows that follow others.
    void printCsvRows() const;
};

}  // namespace svt::cli
