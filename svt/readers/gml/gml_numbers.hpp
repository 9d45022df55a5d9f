#pragma once
/// \file
/// Numbers in GML text: fast, without locale, correctly rounded. Internal to the readers.

#include <optional>
#include <string_view>
#include <vector>

namespace svt::readers::gml {

/// Appends the white-space separated numbers of `text` to `numbers`. "NaN", "INF" and numbers beyond the
/// range of double are appended as such (NaN, infinity), for the caller to judge; a leading '+' is accepted.
/// \return the first token that is no number, or an empty view where all are
/// Cost: O(text), 300 to 600 MB/s.
[[nodiscard]] std::string_view parseNumbers(std::string_view text, std::vector<double>& numbers);

/// gml:coordinates: tuples separated by `tupleSeparator`, members by `memberSeparator`, with `decimal` as point.
/// \return the numbers of all tuples and, if all tuples are of one size, that size; nothing where a token is no number
struct Tuples {
    std::vector<double> numbers;
    std::size_t dimension = 0;
};
[[nodiscard]] std::optional<Tuples> parseTuples(std::string_view text, char decimal, char memberSeparator,
                                                char tupleSeparator);

/// The whole of `text` as one number, else nothing.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

}  // namespace svt::readers::gml
