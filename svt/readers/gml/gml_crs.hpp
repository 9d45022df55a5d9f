#pragma once
/// \file
/// Names of coordinate reference systems: their EPSG code, whether coordinates are degrees,
/// and which axis comes first.

#include <svt/core/vec.hpp>

#include <string>
#include <string_view>

namespace svt::readers::gml {

/// The horizontal EPSG code of a srsName, or 0. Understands EPSG:25832, urn:ogc:def:crs:EPSG::25832, compounds
/// (urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783 and EPSG:25832+5783), http://www.opengis.net/def/crs/EPSG/0/25832,
/// .../gml/srs/epsg.xml#25832, and the names of the German surveying authorities (urn:adv:crs:ETRS89_UTM32*...).
[[nodiscard]] int epsgCode(std::string_view srsName) noexcept;

/// The vertical EPSG code of a compound name, or 0.
[[nodiscard]] int verticalCode(std::string_view srsName) noexcept;

/// True for the name of longitude and latitude of WGS 84, in this order (urn:ogc:def:crs:OGC:1.3:CRS84).
[[nodiscard]] bool isCrs84(std::string_view srsName) noexcept;

/// True if both names denote the same horizontal CRS, as far as can be determined.
[[nodiscard]] bool isSameCrs(std::string_view a, std::string_view b) noexcept;

struct AxisDecision {
    bool isGeographic = false;  ///< degrees
    bool isNorthFirst = false;  ///< x and y must be swapped
    std::string remark;         ///< an inconsistency between name and coordinates, or empty
};

/// Decides by the code and the format of the name (URNs and URLs imply the authority's axis order, EPSG:n does not).
/// Many files break that rule, so the coordinates take precedence if conclusive: by magnitude or the area of use of the
/// CRS, else by handedness.
/// \param box         of the coordinates as given in the file; may be empty
/// \param handedness  +1 if faces of solids look outward with coordinates as given, -1 if they do so
///                    only with x and y swapped, 0 if the geometry is inconclusive
[[nodiscard]] AxisDecision decideAxes(std::string_view srsName, const Box3d& box, int handedness);

}  // namespace svt::readers::gml
