#pragma once
/// \file
/// Tables as an XLSX workbook (Office Open XML, ISO/IEC 29500) for spreadsheet programs, by the libxlsxwriter library.

#include <svt/writers/table.hpp>

#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// A sheet of a workbook: bold headings that stay in view, and rows. Numbers are numbers, empty cells are empty.
struct XlsxSheet {
    std::string name;                   ///< at most 31 characters without []:*?/\, different from all others
    Table table;                        ///< Column::decimals are the shown ones; cells have all digits
    std::vector<std::string> headings;  ///< one per column
    bool hasFilter = true;              ///< the headings have filters
};

/// The bytes of a workbook. Equal sheets give equal bytes; the date of creation is 2000-01-01.
/// Invalid UTF-8 becomes U+FFFD. The library writes temporary files; the workbook is read back and checked before it is
/// returned. Threads: any.
/// \param sheets  at least one
/// \return the file; CannotWrite: libxlsxwriter is missing, this build does not have it, temporary files cannot be
///         written, or a sheet has more than 1,048,576 rows, 16,384 columns or a text of more than 32,767 characters
/// Cost: about 2 s per million cells. Memory: about 100 bytes per cell.
[[nodiscard]] Result<std::string> makeXlsx(std::span<const XlsxSheet> sheets, const std::string& title);

}  // namespace svt::writers
