#pragma once
/// \file
/// Names of coordinate reference systems: their EPSG code, whether coordinates are degrees,
/// and which axis comes first.

#include <svt/core/vec.hpp>

#include <string>
#include <string_view>

namespace svt::readers::gml {

/// The first EPSG code of a srsName, or 0; see crs::codesOf().
[[nodiscard]] int epsgCode(std::string_view srsName) noexcept;

/// The vertical EPSG code of a compound name or code, or 0.
[[nodiscard]] int verticalCode(std::string_view srsName) noexcept;

/// True for the name of longitude and latitude of WGS 84, in this order (urn:ogc:def:crs:OGC:1.3:CRS84).
[[nodiscard]] bool isCrs84(std::string_view srsName) noexcept;

/// True if both names denote the same horizontal CRS, as far as can be determined.
[[nodiscard]] bool isSameCrs(std::string_view a, std::string_view b) noexcept;

struct AxisDecision {
    bool isGeographic = false;   ///< degrees
    bool isNorthFirst = false;   ///< x and y must be swapped
    bool hasNorthFirst = false;  ///< the authority defines north first
    bool isDoubtful = false;     ///< the remark is about the order
    std::string remark;          ///< an inconsistency between name and coordinates, or empty
};

/// Decides by the code and the form of the name: URNs and URLs mean the axis order of the authority, EPSG:n and other
/// forms mean east first. If the coordinates are possible only in the other order (by their range or the area of use of
/// the CRS), that order is taken, with a remark. The orientation of faces decides nothing.
/// \param box  of the coordinates as given in the file; may be empty
[[nodiscard]] AxisDecision decideAxes(std::string_view srsName, const Box3d& box);

}  // namespace svt::readers::gml
