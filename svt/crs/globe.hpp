#pragma once
/// \file
/// Where on earth coordinates of a reference system are: longitude and latitude, and metres from the earth's centre.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>

namespace svt::crs {

/// Longitude (x) and latitude (y) on WGS 84 in degrees of a point of a projection; z stays. The zones of UTM and of Japan
/// by our own series, everything else by PROJ. Datums on GRS 1980 or WGS 84 are taken as WGS 84, which is right to a metre
/// or two (drift of continents).
/// \param epsg   code of a projection or of a compound with one
/// \param place  x: east, y: north, metres
/// \return CannotProject: an unknown code, one in degrees, `place` outside of what it can describe, or a way that needs
///         PROJ in a build without it. Cost: microseconds, by PROJ milliseconds
[[nodiscard]] Result<Vec3d> placeOnEarth(int epsg, Vec3d place);

/// The point (metres from the earth's centre: EPSG:4978) of longitude and latitude in degrees and a height over the
/// ellipsoid of WGS 84 in metres. The same bits on every machine.
[[nodiscard]] Vec3d earthCentred(Vec3d place) noexcept;

/// A plane on the globe: what one metre east, north and upwards is around a point.
struct GlobeFrame {
    Vec3d origin;               ///< metres from the earth's centre
    std::array<Vec3d, 3> axes;  ///< of a step of one metre along x, y and up; those of a projection have its scale
};

/// The frame at longitude, latitude and height: east, north, up.
[[nodiscard]] GlobeFrame frameAt(Vec3d place) noexcept;

/// The frame of a projection at `place`: along its own axes, which are turned against east and north and are longer or
/// shorter than metres on the ground. Straight lines from `place` miss the projected point by the curvature of the earth:
/// 1 mm at 100 m, in height.
/// \param place  x: east, y: north in metres of `epsg`; z: height over the ellipsoid
/// \return as placeOnEarth()
[[nodiscard]] Result<GlobeFrame> frameOf(int epsg, Vec3d place);

}  // namespace svt::crs
