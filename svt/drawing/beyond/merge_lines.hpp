#pragma once
/// \file
/// Merges overlapping lines, and joins lines that continue in the same direction.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

/// Removes lines that lie on borders and lines of the cut, or on other lines. The line of the lower kind is kept; for
/// equal kinds, the longer one. Then joins pieces of one label and kind.
/// \return the lines by kind, label and place
/// Cost: O(n log n) for lines that are spread over the drawing.
[[nodiscard]] std::vector<BeyondLine> mergeLines(std::vector<BeyondLine> lines, const SectionDrawing& drawing,
                                                 const volume::LabelTable& table, int threads);

}  // namespace svt::drawing
