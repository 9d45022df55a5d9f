#pragma once
/// \file
/// Lines of terrain in plans.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>

namespace svt::writers {

/// Removes the lines of terrain in a plan that have the same height on both sides: joints between the pieces of a site.
/// Edges, steps and breaks of the terrain stay. Terrain of more than 5000 triangles stays as it is.
/// \param isAround  by label, of labelsAroundBuilding()
/// Cost: O(lines of terrain * triangles of their labels).
void removeTerrainJoints(drawing::SectionDrawing& plan, const volume::SemanticVolume& volume,
                         std::span<const std::uint8_t> isAround);

}  // namespace svt::writers
