#pragma once
/// \file
/// Rays through a volume, parsed from text.

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

/// Parses `x,y,z:dx,dy,dz`: the origin, metres from the grid's lower corner, and the direction, both along world axes.
/// \return the ray, or BadArgument if the syntax is wrong, a number is not finite, the direction is zero, or the ray
///         misses the grid
[[nodiscard]] Result<PickRay> parsePickRay(std::string_view text, const volume::Grid& grid);

}  // namespace svt::illustrate
