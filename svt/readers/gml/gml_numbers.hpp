#pragma once
/// \file
/// Numbers in GML text: fast, locale-independent, correctly rounded.

#include <optional>
#include <string_view>
#include <vector>

namespace svt::readers::gml {

/// Appends the white-space separated numbers of `text` to `numbers`. "NaN", "INF" and numbers beyond the
/// range of double are appended as NaN or infinity, for the caller to check; a leading '+' is accepted.
/// \return the first token that is not a number, or an empty view if all are
/// Cost: O(text), 300 to 600 MB/s.
[[nodiscard]] std::string_view parseNumbers(std::string_view text, std::vector<double>& numbers);

/// Parses gml:coordinates: tuples separated by `tupleSeparator`, members by `memberSeparator`, `decimal` as decimal
/// point.
/// \return the numbers of all tuples and, if all tuples have one size, that size; nothing if a token is not a number
struct Tuples {
    std::vector<double> numbers;
    std::size_t dimension = 0;
};
[[nodiscard]] std::optional<Tuples> parseTuples(std::string_view text, char decimal, char memberSeparator,
                                                char tupleSeparator);

/// The whole of `text` as one number, or nothing.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

}  // namespace svt::readers::gml
