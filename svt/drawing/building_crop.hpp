#pragma once
/// \file
/// Crops a drawing to the building, so that terrain and trees do not decide the scale of its sheet.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// The drawing without the parts of terrain, vegetation, roads and city furniture that lie beyond the building, and
/// without those of partsAwayFromBuilding(). Slabs of the site, outside of all buildings and storeys, that are more than
/// half as long again as the buildings count as terrain. A margin of a twentieth of the building, at least 1 m, remains.
/// A drawing without a building stays as it is. The cut-off has no border. A plan has no tree or shrub that would be cut
/// off.
/// Cost: O(points of the drawing + triangles of the model).
[[nodiscard]] SectionDrawing croppedToBuilding(const SectionDrawing& drawing, const volume::SemanticVolume& volume);

/// The labels that croppedToBuilding() cuts off, for several drawings of one volume: 1 for terrain, vegetation and parts
/// away from the building, 2 for single trees and shrubs, 0 for the others.
[[nodiscard]] std::vector<std::uint8_t> labelsAroundBuilding(const volume::SemanticVolume& volume);
/// The same crop, without another look at the model.
/// \param isAround  by label, of labelsAroundBuilding()
[[nodiscard]] SectionDrawing croppedToBuilding(const SectionDrawing& drawing, std::span<const std::uint8_t> isAround);

/// Furniture, proxies and other parts that are not measured and stand away from the buildings: by more than a quarter of
/// their length, at least 2 m, with sides up to 0.3 of their length. Points of reference decide no scale. Only parts
/// with meshes count.
/// Cost: O(triangles of the model).
/// \return labels, sorted
[[nodiscard]] std::vector<std::uint32_t> partsAwayFromBuilding(const volume::SemanticVolume& volume);

}  // namespace svt::drawing
