#pragma once
/// \file
/// Facts about the coordinates of a coordinate reference system, by its code: degrees or lengths, order of the axes,
/// area of use. They come from built-in tables of the EPSG dataset and need no library or file.

#include <svt/core/vec.hpp>

#include <optional>

namespace svt::crs {

enum class AxisOrder {
    EastNorth,
    NorthEast,
    SouthWest,  ///< values are usually given with inverted signs, as east and north
};

/// Facts about a code. An unknown code has those of a projection in metres with east first.
struct CrsFacts {
    int horizontal = 0;         ///< code of the horizontal part of a compound; else the code itself
    int vertical = 0;           ///< code of the vertical part of a compound, 0: none
    bool isDegrees = false;     ///< geographic
    bool isGeocentric = false;  ///< metres from the centre of the earth, so z does not point up
    bool isMetres = true;       ///< false: degrees, feet or another unit
    AxisOrder order = AxisOrder::EastNorth;
};

/// Cost: a search in a few hundred numbers.
[[nodiscard]] CrsFacts factsOf(int epsg) noexcept;

/// The area of use of a geographic code, x: longitude, y: latitude, degrees; nothing if it is unknown or not a single
/// box.
[[nodiscard]] std::optional<Box3d> areaOf(int epsg) noexcept;

/// Whether a place lies in the area of use of a code, with a margin of one degree; nothing if that is unknown. Degrees
/// and UTM zones are known by the tables, other projections by PROJ.
/// \param place  x: east or longitude, y: north or latitude, in units of the code
/// Cost: microseconds, with PROJ milliseconds.
[[nodiscard]] std::optional<bool> isInAreaOfUse(int epsg, Vec3d place);

/// The scale of a Mercator projection of the world, which shows lengths too large away from the equator.
struct MapScale {
    double factor = 1;  ///< length on the map per length on the ground; 1 for other projections
    int localCode = 0;  ///< code of the usual projection of the place, with a factor close to 1
};
/// \param place  x: east, y: north, metres
[[nodiscard]] MapScale mapScaleAt(int epsg, Vec3d place);

/// Metres per unit of the heights of a vertical code: 1, or the length of a foot.
[[nodiscard]] double metresPerHeight(int vertical) noexcept;

inline constexpr double kFoot = 0.3048;                 ///< international foot in metres
inline constexpr double kSurveyFoot = 1200.0 / 3937.0;  ///< US survey foot in metres

}  // namespace svt::crs
