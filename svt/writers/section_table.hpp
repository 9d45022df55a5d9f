#pragma once
/// \file
/// Cut areas of a section, per component and per class, as JSON and CSV.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace svt::writers {

/// One JSON object: `plane` (origin, u, v, normal, edgesInPlane, shift, bound), `components` (id, class, name,
/// polygons, area, areaBound, exact, lineLength in metres), `classes` (class, components, area) and `area`, all in m2.
[[nodiscard]] std::string makeSectionJson(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume);

/// CSV (RFC 4180) with the header `kind,id,class,name,polygons,area_m2,area_bound_m2,exact,line_length_m`. `kind` is
/// component, class or total; rows of classes and the total have neither id nor name.
[[nodiscard]] std::string makeSectionCsv(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume);

}  // namespace svt::writers
