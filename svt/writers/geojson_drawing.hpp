#pragma once
/// \file
/// A section drawing as GeoJSON (RFC 7946), in the coordinates of the model's CRS with heights.
///
///     {"type":"FeatureCollection","name":...,"crs":{...},"plane":{"origin":[...],"u":[...],"v":[...],"normal":[...]},
///      "features":[{"type":"Feature","id":"wall-1",
///        "properties":{"id":"wall-1","class":"WallSurface","name":"Outer wall","area":1.25},
///        "geometry":{"type":"MultiPolygon","coordinates":[[[[x,y,z],...]]]}}]}
///
/// RFC 7946 asks for WGS 84; buildings are drawn in metres, so the CRS is named in the older `crs` member that GDAL and
/// QGIS read. It is left out where the name of the model's CRS tells no EPSG code. Coordinates have six decimals.

#include <svt/core/result.hpp>
#include <svt/illustrate/section_drawing.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace svt::writers {

/// The drawing as GeoJSON text, a feature per line. `volume` is what the drawing was made from. `area` is m2 in the
/// plane of the section. Outer rings of plans are counter-clockwise as seen from above.
[[nodiscard]] std::string geojsonOf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume);

/// The same as a file, all or nothing. \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeGeojson(const illustrate::SectionDrawing& drawing,
                                                 const volume::SemanticVolume& volume,
                                                 const std::filesystem::path& path);

}  // namespace svt::writers
