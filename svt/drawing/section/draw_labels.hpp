#pragma once
/// \file
/// A section of chosen labels; what drawSection() and drawLineView() have in common.

#include <svt/drawing/section_drawing.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

/// As drawSection(), for a plane that is checked, with the labels of `isDrawn` instead of the queries of `options`.
/// \param bricks  those of the volume, or null: made where they are needed
[[nodiscard]] Result<SectionDrawing> drawLabels(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks,
                                                const SectionPlane& plane, const std::vector<std::uint8_t>& isDrawn,
                                                const SectionOptions& options);

}  // namespace svt::drawing
