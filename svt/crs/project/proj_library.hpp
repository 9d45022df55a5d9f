#pragma once
/// \file
/// Conversions by the PROJ library. Two sources: one calls the library, the other is for builds without it.

#include <svt/crs/projection.hpp>

#include <optional>

namespace svt::crs::project {

/// A conversion from one code to another, with axes in the order east, north.
/// \return the conversion; BadArgument if PROJ does not know the target, or the target is not a projection in metres;
///         CannotProject for an unknown source, no conversion, a build without PROJ, or missing data of PROJ
[[nodiscard]] Result<Projection> projBetween(int source, int target);

/// The geographic code that a projection is based on, and the longitude and latitude of `place`.
struct PlaceInDegrees {
    int epsg = 0;
    Vec3d place;
};
[[nodiscard]] Result<PlaceInDegrees> placeInDegrees(int source, Vec3d place);

/// The area of use of a code, x: longitude, y: latitude, degrees; min.x > max.x if it crosses the 180th meridian.
/// \return nothing if it is unknown, or without PROJ
[[nodiscard]] std::optional<Box3d> projAreaOf(int epsg);

/// As geoidHeight().
[[nodiscard]] std::optional<double> projGeoidHeight(int epsg, int vertical, Vec3d place);

}  // namespace svt::crs::project
