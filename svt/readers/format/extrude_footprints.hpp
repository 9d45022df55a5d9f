#pragma once
/// \file
/// Makes solids for buildings that have only a footprint and a height.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::readers {

/// Adds a solid of level of detail 1 to each feature whose only geometry is flat and that has no geometry below it in
/// the tree. The feature needs a height: the attribute measuredHeight or height, its own or that of a parent. The solid
/// is the extrusion of its lowest horizontal polygons. The existing geometry stays. Heights may be in feet (a unit with
/// "ft" or "foot" in it). Heights that are not above 0 are ignored.
/// \param diagnostics  receives the number of features with a new solid, and the number without a height; may be null
/// \return number of features that got a solid
/// Cost: O(points).
std::size_t extrudeFootprints(model::BuildingModel& model, Diagnostics* diagnostics);

}  // namespace svt::readers
