#pragma once
/// \file
/// Round numbers as people choose them for scales and spacings.

#include <cmath>

namespace svt {

/// The largest of 1, 2 and 5 times a power of ten that does not exceed `value`.
/// \param value  > 0
[[nodiscard]] inline double roundDownTo125(double value) noexcept {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    const double share = value / power;
    return power * (share < 2 ? 1 : share < 5 ? 2 : 5);
}

}  // namespace svt
