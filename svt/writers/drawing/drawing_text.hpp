#pragma once
/// \file
/// Text helpers shared by the drawing writers: numbers, names and a description of the plane.

#include <svt/crs/crs_name.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/drawing/drawing_style.hpp>
#include <svt/writers/labels/label_looks.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::writers {

/// `value` with up to `decimals` decimals, without trailing zeros; never "-0".
[[nodiscard]] std::string shortNumber(double value, int decimals);

/// The coordinates of a vector, each as by shortNumber().
[[nodiscard]] std::string vectorText(Vec3d v, int decimals, std::string_view separator = " ");

/// `name` with every character outside A-Z, a-z, 0-9, '_' and '-' replaced by '_'; `fallback` if empty.
[[nodiscard]] std::string plainName(std::string_view name, std::string_view fallback = "none");

/// "visible", "hidden" or "above".
[[nodiscard]] std::string_view beyondName(drawing::BeyondKind kind) noexcept;

/// Whether a drawing shows the model from outside: a vertical plane that cuts nothing, and lines behind it.
[[nodiscard]] bool isElevation(const drawing::SectionDrawing& drawing, const volume::Grid& grid) noexcept;

/// "Elevation from the south", "Plan at z = 1.2 m", "Section at y = 5 m", "Section 0.6, 0.8, 0, -3": metres from the
/// grid's lower corner. Directions are relative to true north.
[[nodiscard]] std::string planeText(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume);

/// True if the section plane is horizontal.
[[nodiscard]] bool isPlan(const drawing::SectionDrawing& drawing, const volume::Grid& grid) noexcept;

/// The member `crs` of GeoJSON 2008, which GDAL and QGIS read, with a comma before it. Empty without an EPSG code.
[[nodiscard]] std::string geoJsonCrs(std::string_view crsName);

/// A hatch as a pattern of SVG. \param isTurned  whether the pattern has its rotation
[[nodiscard]] std::string svgPattern(const HatchTile& tile, bool isTurned);

using crs::epsgCodeOf;

}  // namespace svt::writers
