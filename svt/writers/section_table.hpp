#pragma once
/// \file
/// Cut areas of a section, per component and per class, as JSON and CSV.

#include <svt/core/result.hpp>
#include <svt/drawing/hatches.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::writers {

/// One JSON object, areas in m2, lengths in metres. `plane` has origin, u, v, normal, edgesInPlane, shift, bound.
/// `components` have id, class, name, polygons, area, areaBound, exact, lineLength. `classes` have class, components,
/// area. `spaces` are units, storeys, buildings and groups with id, class, name, components, and the area of their drawn
/// parts. `area` is the total. `hatches`, with hatches given, have hatch, source, material, word, components.
[[nodiscard]] std::string makeSectionJson(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                          const std::vector<drawing::HatchUse>& hatches = {});

/// CSV (RFC 4180) with the header `kind,id,class,name,polygons,area_m2,area_bound_m2,exact,line_length_m`. `kind` is
/// component, class, space or total; rows of classes and the total have neither id nor name.
[[nodiscard]] std::string makeSectionCsv(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume);

}  // namespace svt::writers
