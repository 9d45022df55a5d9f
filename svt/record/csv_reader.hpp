#pragma once
/// \file
/// Tables as text with a separator (RFC 4180), row by row with line numbers.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::record {

/// Checks that the text of a table is UTF-8. Spreadsheets may save tables in the code page of the machine.
/// \param file  for the message
/// \return success, or BadValue with the line
[[nodiscard]] Result<void> checkTableText(std::string_view text, const std::string& file);

/// Reads rows from a text, which must outlive the reader. Cells may stand in double quotes and then hold separators, line
/// breaks and doubled quotes. Blanks around other cells do not count; neither do empty lines and lines that begin with #.
class CsvReader {
public:
    /// The separator is a semicolon or a tab if the first line has one outside of quotes, else a comma. With a semicolon or
    /// a tab, numbers may have a decimal comma.
    explicit CsvReader(std::string_view text);

    /// \return whether there was a further row
    [[nodiscard]] bool next(std::vector<std::string>& cells);
    /// The line on which the last row began, from 1.
    [[nodiscard]] std::uint64_t line() const noexcept { return rowLine_; }
    /// Whether the last row ended with a line break, and not with the end of the text.
    [[nodiscard]] bool isWhole() const noexcept { return isWhole_; }
    /// Whether the last quote of the text is missing.
    [[nodiscard]] bool isQuoteOpen() const noexcept { return isQuoteOpen_; }

    /// A cell as a number, also with a decimal comma if the separator is another character.
    [[nodiscard]] std::optional<double> number(std::string_view cell) const;

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1, rowLine_ = 1;
    char separator_ = ',';
    bool isWhole_ = true, isQuoteOpen_ = false;
};

}  // namespace svt::record
