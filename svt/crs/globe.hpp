#pragma once
/// \file
/// Converts coordinates of a reference system to places on earth: longitude and latitude, and metres from the earth's
/// centre.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <optional>

namespace svt::crs {

/// Longitude (x) and latitude (y) on WGS 84, in degrees, of a point of a projection; z is unchanged. Zones of UTM and
/// of Japan use SVT's own series, all other projections PROJ. Datums on GRS 1980 or WGS 84 are treated as WGS 84, which
/// is accurate to one or two metres (continental drift).
/// \param epsg   code of a projection or of a compound with one
/// \param place  x: east, y: north, metres
/// \return the place, or CannotProject: the code is unknown or in degrees, `place` is outside the range of the
///         projection, or the conversion needs PROJ in a build without it. Cost: microseconds, with PROJ milliseconds
[[nodiscard]] Result<Vec3d> placeOnEarth(int epsg, Vec3d place);

/// Height of the surface from which a vertical code measures, over the ellipsoid of WGS 84, by a grid of PROJ.
/// \param epsg      code of a projection
/// \param vertical  code of heights
/// \param place     x: east, y: north, metres
/// \return the height in metres; nothing if PROJ or the grid is not installed, or the codes are unknown
[[nodiscard]] std::optional<double> geoidHeight(int epsg, int vertical, Vec3d place);

/// Converts longitude and latitude in degrees and the height over the ellipsoid of WGS 84 in metres to metres from the
/// earth's centre (EPSG:4978). The same bits on every machine.
[[nodiscard]] Vec3d earthCentred(Vec3d place) noexcept;

/// A local frame on the globe: the steps of one metre east, north and upwards around a point.
struct GlobeFrame {
    Vec3d origin;               ///< metres from the earth's centre
    std::array<Vec3d, 3> axes;  ///< steps of one metre along x, y and up; those of a projection have its scale
};

/// The frame at longitude, latitude and height: east, north, up.
[[nodiscard]] GlobeFrame frameAt(Vec3d place) noexcept;

/// The frame of a projection at `place`, along the axes of the projection. They are turned against east and north, and
/// longer or shorter than metres on the ground. Straight lines from `place` differ from the projected point by the
/// curvature of the earth: 1 mm at 100 m, in height.
/// \param place  x: east, y: north in metres of `epsg`; z: height over the ellipsoid
/// \return as placeOnEarth()
[[nodiscard]] Result<GlobeFrame> frameOf(int epsg, Vec3d place);

}  // namespace svt::crs
