#pragma once
/// \file
/// What the code of a coordinate reference system says of its coordinates: degrees or lengths, which axis comes first,
/// where on earth it is used. From tables of the EPSG dataset, so that it needs no library and no file.

#include <svt/core/vec.hpp>

#include <optional>

namespace svt::crs {

enum class AxisOrder {
    EastNorth,
    NorthEast,
    SouthWest,  ///< values are usually given with inverted signs, as east and north
};

/// What is known of a code; all as for a projection in metres with east first where the code is not known.
struct CrsFacts {
    int horizontal = 0;      ///< code of the horizontal part of a compound; else the code itself
    int vertical = 0;        ///< code of the vertical part of a compound, 0: none
    bool isDegrees = false;  ///< geographic
    bool isMetres = true;    ///< false: degrees, feet or another unit
    AxisOrder order = AxisOrder::EastNorth;
};

/// Cost: a search in some hundred numbers.
[[nodiscard]] CrsFacts factsOf(int epsg) noexcept;

/// The area of use of a code of degrees, x: longitude, y: latitude; nothing where it is not known or not one box.
[[nodiscard]] std::optional<Box3d> areaOf(int epsg) noexcept;

/// Length of one unit of the heights of a vertical code in metres: 1, or that of a foot.
[[nodiscard]] double metresPerHeight(int vertical) noexcept;

inline constexpr double kFoot = 0.3048;                 ///< international foot in metres
inline constexpr double kSurveyFoot = 1200.0 / 3937.0;  ///< US survey foot in metres

}  // namespace svt::crs
