#pragma once
/// \file
/// A section drawing as GeoJSON (RFC 7946), in the coordinates of the model's CRS with heights.
///
///     {"type":"FeatureCollection","name":...,"crs":{...},"plane":{"origin":[...],"u":[...],"v":[...],"normal":[...]},
///      "features":[{"type":"Feature","id":"wall-1",
///        "properties":{"id":"wall-1","class":"WallSurface","name":"Outer wall","area":1.25},
///        "geometry":{"type":"MultiPolygon","coordinates":[[[[x,y,z],...]]]}}]}
///
/// RFC 7946 requires WGS 84, but building drawings are in metres, so the CRS is named in the older `crs` member that
/// GDAL and QGIS read. It is omitted if the name of the model's CRS contains no EPSG code. Coordinates have six
/// decimals.

#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/field_look.hpp>

#include <string>

namespace svt::writers {

/// The drawing as GeoJSON text, one feature per line. `volume` is the volume from which the drawing was made. `area` is
/// in m2 in the section plane. Exterior rings of plans are counter-clockwise as seen from above.
/// \param look  a field: a feature for each value of its lines, for each band with its colour, and for the places without
///              a value
[[nodiscard]] std::string makeGeojson(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                      const FieldLook& look = {});

}  // namespace svt::writers
