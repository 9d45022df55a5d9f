#pragma once
/// \file
/// The ground in sections and elevations: a bold line with strokes of earth below it.

#include <svt/drawing/building_levels.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/canvas/mark_shapes.hpp>

#include <span>

namespace svt::writers {

/// The terrain that a section cuts. Terrain with a body has its own hatch and gets no strokes.
/// \param millimetres  on paper per metre
[[nodiscard]] MarkShapes drawGround(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                    double millimetres);

/// The assumed ground of an elevation reaches beyond the drawing by this length, millimetres.
inline constexpr double kGroundOver = 6;

/// The ground of an elevation, in front of the building.
struct GroundBefore {
    MarkShapes shapes;
    bool isAssumed = false;  ///< the model has neither terrain nor ground surfaces: the line is at the ground floor
};
/// The line of the terrain along the foremost part of the building. Without terrain there, the lowest point of the
/// ground surfaces, if the model has no level below the ground floor; otherwise the ground floor.
/// \param drawing  of an elevation, cropped to the building
/// \param levels   of the volume
/// Cost: O(triangles).
[[nodiscard]] GroundBefore drawGroundBefore(const drawing::SectionDrawing& drawing,
                                            const volume::SemanticVolume& volume,
                                            std::span<const drawing::BuildingLevel> levels, double millimetres);

/// Hides the parts of an elevation below its ground line. Below the terrain of the model, nothing is drawn. Below another
/// ground line, lines of the building become hidden lines.
/// \param isAround  by label, of labelsAroundBuilding()
/// Cost: O(triangles + lines * segments of the ground).
void hideBelowGround(drawing::SectionDrawing& elevation, const volume::SemanticVolume& volume,
                     std::span<const drawing::BuildingLevel> levels, std::span<const std::uint8_t> isAround);

}  // namespace svt::writers
