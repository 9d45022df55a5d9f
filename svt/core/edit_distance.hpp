#pragma once
/// \file
/// How far two names are apart, for "did you mean".

#include <cstddef>
#include <string_view>

namespace svt {

/// Letters to insert, drop, change or swap with their neighbour, without regard to ASCII case (optimal string
/// alignment); `limit` + 1 where there are more. Cost: O(a * b), less where the limit is met early.
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit);

}  // namespace svt
