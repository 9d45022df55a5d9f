#pragma once
/// \file
/// The codes in the name of a coordinate reference system. All readers, writers and options resolve names here.

#include <cstdint>
#include <string_view>

namespace svt::crs {

/// Codes of EPSG; 0: none.
struct CrsCodes {
    int code = 0;        ///< the first code in the name, which may be that of a compound
    int horizontal = 0;  ///< of the part in plan: 28992 of EPSG:7415
    int vertical = 0;    ///< of the heights: 5709 of EPSG:7415, 5783 of "EPSG:25832+5783"
};

/// The codes in a name. These forms are understood:
///
/// EPSG:25832, epsg:25832, 25832, EPSG:25832+5783.
///
/// urn:ogc:def:crs:EPSG::25832, urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783.
///
/// http(s)://www.opengis.net/def/crs/EPSG/0/7415, .../def/crs-compound?1=...&2=..., .../gml/srs/epsg.xml#25832.
///
/// urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH, of the German surveying authorities.
///
/// CH1903+, CH1903, LV95, LV03, RD New, NAP, Lambert-93, "ETRS89 / UTM zone 32N", "WGS 84 / UTM zone 33S".
///
/// EPSG:6677 (from EPSG:6668+6695), which SVT writes. The heights are those of the second name.
///
/// CH1903 means the projection LV03, which models with this name have.
/// Cost: a search in some hundred numbers.
[[nodiscard]] CrsCodes codesOf(std::string_view crsName) noexcept;

/// The code of the part in plan, or 0; as codesOf().
[[nodiscard]] std::uint32_t epsgCodeOf(std::string_view crsName) noexcept;

}  // namespace svt::crs
