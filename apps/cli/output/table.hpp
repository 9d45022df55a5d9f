#pragma once
/// \file
/// One table for people, spreadsheets and programs.

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
    /// Columns as wide as they need, numbers to the right.
    void printText() const;
    /// RFC 4180 with a line of keys, separated by commas; numbers in full.
    void printCsv() const;
};

}  // namespace svt::cli
