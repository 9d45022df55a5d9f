#pragma once
/// \file
/// Names of coordinate reference systems: which EPSG code they mean, whether their coordinates are
/// degrees, and which axis comes first. Nothing is reprojected. Internal to the readers.

#include <svt/core/vec.hpp>

#include <string>
#include <string_view>

namespace svt::readers::gml {

/// The horizontal EPSG code of a srsName, or 0. Understands EPSG:25832, urn:ogc:def:crs:EPSG::25832, compounds
/// (urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783 and EPSG:25832+5783), http://www.opengis.net/def/crs/EPSG/0/25832,
/// .../gml/srs/epsg.xml#25832, and the names of the German surveying authorities (urn:adv:crs:ETRS89_UTM32*...).
[[nodiscard]] int epsgCode(std::string_view srsName) noexcept;

/// True where both names mean the same horizontal CRS as far as can be told.
[[nodiscard]] bool isSameCrs(std::string_view a, std::string_view b) noexcept;

struct AxisDecision {
    bool isGeographic = false;  ///< degrees
    bool isNorthFirst = false;  ///< x and y are to be exchanged
    std::string remark;         ///< what is odd about name and coordinates, or empty
};

/// Decides by code and form of the name (URN and URL forms promise the authority's axis order, EPSG:n does not).
/// Many files break that rule, so the coordinates win where they tell: by magnitude, else by handedness.
/// \param box         of the coordinates as given in the file; may be empty
/// \param handedness  +1 where faces of bodies look outward with coordinates as given, -1 where they do so
///                    only with x and y exchanged, 0 where the geometry does not tell
[[nodiscard]] AxisDecision decideAxes(std::string_view srsName, const Box3d& box, int handedness);

}  // namespace svt::readers::gml
