#pragma once
/// \file
/// Lines that lie on each other become one, and lines that go on in the same direction are joined.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::drawing {

/// Removes what lies on borders and lines of the cut, or on other lines: of two, the lower kind stays, else the longer
/// one. Then joins pieces of one label and kind.
/// \return the lines by kind, label and place
/// Cost: O(n log n) for lines that are spread over the drawing.
[[nodiscard]] std::vector<BeyondLine> mergeLines(std::vector<BeyondLine> lines, const SectionDrawing& drawing,
                                                 const volume::LabelTable& table, int threads);

}  // namespace svt::drawing
