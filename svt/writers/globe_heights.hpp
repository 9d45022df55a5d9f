#pragma once
/// \file
/// Heights of 3D Tiles, which count from the ellipsoid, for models whose heights count from the sea.

#include <svt/core/vec.hpp>

#include <string>

namespace svt::writers {

struct GlobeHeights {
    double lift = 0;     ///< metres to be added to heights (TilesetWriteOptions::lift)
    std::string remark;  ///< a sentence for the user: the source of the lift, or that it is missing
};

/// The lift by the vertical code in the name of a CRS and the grid of PROJ, at one place.
/// \param place  x: east, y: north, metres. The geoid is inclined by up to 10 cm per km against the ellipsoid.
/// \return lift 0 if the name has no vertical code, or PROJ or its grid is not installed; the remark says so
[[nodiscard]] GlobeHeights globeHeights(const std::string& crsName, Vec3d place);

}  // namespace svt::writers
