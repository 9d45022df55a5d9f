#pragma once
/// \file
/// Crops a drawing to the building, so that terrain and trees do not decide the scale of its sheet.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

namespace svt::drawing {

/// The drawing without the parts of terrain, vegetation, roads and city furniture that lie beyond the building. A margin
/// of a twentieth of the building, at least 1 m, remains. A drawing without a building stays as it is. The cut-off has no
/// border.
/// Cost: O(points of the drawing).
[[nodiscard]] SectionDrawing croppedToBuilding(const SectionDrawing& drawing, const volume::SemanticVolume& volume);

}  // namespace svt::drawing
