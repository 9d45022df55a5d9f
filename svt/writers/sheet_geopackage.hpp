#pragma once
/// \file
/// The views of sheets as one GeoPackage (OGC 12-128r19), for GIS and databases.
///
/// | table | geometry | coordinates |
/// |---|---|---|
/// | `plan_polygons`, `plan_lines` | MultiPolygon, MultiLineString | the model's CRS, from above. |
/// | `upright_polygons`, `upright_lines` | the same | of the drawing: metres right and up from `views.origin`. |
/// | `views` | none | one row per view: name, kind, and the axes of its drawing in the world. |
///
/// Columns: `view` (key of `views`), `kind` (`cut`, `sheet`, `visible`, `hidden`, `above`, `swing`), `id`, `class`,
/// `name`, and for polygons `area` (m2, in the plane), `bound` (m2) and `exact` (0 or 1).

#include <svt/core/result.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <string>

namespace svt::writers {

/// \return the bytes of the file, or CannotWrite, also if the SQLite library is missing. Equal views give equal
///         bytes with the same release of SQLite.
[[nodiscard]] Result<std::string> makeSheetGeoPackage(const SheetContent& content,
                                                      const volume::SemanticVolume& volume);

}  // namespace svt::writers
