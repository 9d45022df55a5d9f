#pragma once
/// \file
/// What is asked of the PROJ library. Two sources: one that calls it, one for builds without it.

#include <svt/crs/projection.hpp>

namespace svt::crs::project {

/// A way from one code to another, with axes in the order east, north.
/// \return the way; BadArgument where PROJ does not know the target, or it is no projection in metres; CannotProject for
///         an unknown source, no way between them, a build without PROJ, or where PROJ finds none of its data
[[nodiscard]] Result<Projection> projBetween(int source, int target);

/// Code of the degrees that a projection stands on, and the longitude and latitude of `place`.
struct PlaceInDegrees {
    int epsg = 0;
    Vec3d place;
};
[[nodiscard]] Result<PlaceInDegrees> placeInDegrees(int source, Vec3d place);

}  // namespace svt::crs::project
