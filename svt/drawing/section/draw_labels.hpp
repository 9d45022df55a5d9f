#pragma once
/// \file
/// A section of selected labels: the common part of drawSection() and drawLineView().

#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

/// Like drawSection() with a checked plane, but draws the labels of `isDrawn` instead of the queries of `options`.
/// The borders between walls are those of the cut, see joinWalls() in section/wall_joints.hpp.
/// \param bricks  bricks of the volume, or null: made if needed
/// \param tables  of the volume
[[nodiscard]] Result<SectionDrawing> drawLabels(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks,
                                                const SectionPlane& plane, const std::vector<std::uint8_t>& isDrawn,
                                                const SectionOptions& options, const DrawingTables& tables);

}  // namespace svt::drawing
