#pragma once
/// \file
/// Rays through a volume, as people write them.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/grid.hpp>

#include <string_view>

namespace svt::illustrate {

/// World space.
struct PickRay {
    Vec3d origin{};
    Vec3d direction{0, 0, 1};  ///< length 1
};

/// A ray from `x,y,z:dx,dy,dz`: where it begins, metres from the grid's lower corner, and where it goes; world axes.
/// \return the ray, or BadArgument where the text is none, a number is not finite, the direction is zero, or the ray
///         passes the whole grid by
[[nodiscard]] Result<PickRay> parsePickRay(std::string_view text, const volume::Grid& grid);

}  // namespace svt::illustrate
