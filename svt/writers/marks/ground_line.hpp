#pragma once
/// \file
/// The ground in sections: a bold line where terrain without a body is cut, with strokes of earth below it.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/canvas/mark_shapes.hpp>

namespace svt::writers {

/// Terrain with a body has its own hatch and gets no strokes.
/// \param millimetres  on paper per metre
[[nodiscard]] MarkShapes drawGround(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                    double millimetres);

}  // namespace svt::writers
