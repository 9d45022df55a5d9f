#pragma once
/// \file
/// Checks of the numbers of a frame that are shares: colours, opacities, strengths.

#include <svt/core/vec.hpp>

namespace svt::render {

/// Whether `value` is 0 to 1; false for NaN.
[[nodiscard]] constexpr bool isShare(float value) noexcept { return value >= 0 && value <= 1; }
[[nodiscard]] constexpr bool isColor(Vec3f color) noexcept {
    return isShare(color.x) && isShare(color.y) && isShare(color.z);
}

}  // namespace svt::render
