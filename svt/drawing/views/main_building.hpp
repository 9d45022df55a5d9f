#pragma once
/// \file
/// The building that sections of a set of sheets cut, if a model has several.

#include <svt/drawing/storey_floors.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <span>

namespace svt::drawing {

/// Boxes along the grid's axes, metres from its lower corner.
struct MainBuilding {
    Box3d box;                   ///< empty if the model has neither walls nor rooms
    std::optional<Box3d> stair;  ///< its largest stair
    std::optional<Box3d> ridge;  ///< the highest part of its roof, if it is a line along x or y
};

/// Parts of the hull and rooms whose boxes touch in plan form one building. The one with the largest box is the main
/// building. Gaps below 0.25 m, or 1/512 of the model, do not separate buildings.
/// \param extents  of labelExtents()
/// Cost: O(labels + triangles).
[[nodiscard]] MainBuilding findMainBuilding(const volume::SemanticVolume& volume, std::span<const LabelExtent> extents);

}  // namespace svt::drawing
