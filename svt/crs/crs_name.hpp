#pragma once
/// \file
/// The EPSG code in the name of a coordinate reference system.

#include <cstdint>
#include <string_view>

namespace svt::crs {

/// The number in the first "EPSG" of a CRS name ("urn:ogc:def:crs:EPSG::25832", "EPSG:25832",
/// "http://www.opengis.net/def/crs/EPSG/0/25832"), or 0.
[[nodiscard]] std::uint32_t epsgCodeOf(std::string_view crsName) noexcept;

}  // namespace svt::crs
