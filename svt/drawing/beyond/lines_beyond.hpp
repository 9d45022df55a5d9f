#pragma once
/// \file
/// Lines beyond a cut: the edges of the model, each split where a face begins to hide it.
///
/// Visibility is decided between lines and faces, not by pixels. Each edge is a line in view space, and each face that
/// may hide it is convex. The part of the line behind the face is one interval whose ends are exact to rounding (object
/// space hidden lines: Roberts 1963, Appel 1967). Parts outside all intervals are visible.
///
///     edge      0 ----------------------------------- 1
///     faces          [------------]   [----]
///     cut                    [---------]
///     visible   -----                       ----------

#include <svt/drawing/beyond/view_shapes.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// Adds the lines that `options` request to a drawing whose cut is complete. Adds nothing if the volume stores no
/// meshes.
///
/// A face does not hide lines within 0.2 mm of it. Lines closer than 0.1 mm count as one. Joints between objects of one
/// class and hatch whose faces lie in one plane are not drawn. Pieces below 0.5 mm are omitted.
/// \param isDrawn  by label; other labels are neither drawn nor hide anything
/// \param tables   of the volume
/// \param threads  0: all cores; the result does not depend on it
/// Cost: O(faces + edges * faces that a grid cell along them meets). FZK-Haus, 21,740 triangles: 20 to 60 ms.
void addLinesBeyond(SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    std::span<const std::uint8_t> isDrawn, const BeyondOptions& options, const DrawingTables& tables,
                    int threads);

/// Adds the lines that an eye sees to a drawing whose cut is in the coordinates of the picture, see EyeView.
/// \param isHidden  also add hidden edges
void addLinesOfView(SectionDrawing& drawing, const volume::SemanticVolume& volume,
                    std::span<const std::uint8_t> isDrawn, const EyeView& eye, bool isHidden, int threads);

}  // namespace svt::drawing
