#pragma once
/// \file
/// Edit distance between two names, for "did you mean" hints.

#include <cstddef>
#include <span>
#include <string_view>

namespace svt {

/// Number of letters to insert, delete, replace or swap with their neighbour, ignoring ASCII case (optimal string
/// alignment distance); `limit` + 1 where it exceeds `limit`. Cost: O(a * b), less where the limit is exceeded early.
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit);

/// The name that a user may have meant by `word`; empty if none is near: a distance below 3, or below half of the word.
[[nodiscard]] std::string_view nearestName(std::string_view word, std::span<const std::string_view> names);

}  // namespace svt
