#pragma once
/// \file
/// Bodies of buildings of which a file has only the footprint and a height.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::readers {

/// Gives each feature whose only geometry is flat, with no geometry below it in the tree, and that tells its height by the attribute measuredHeight or height (its
/// own, else that of a parent), a solid of level of detail 1: its lowest horizontal polygons, raised by the height. What
/// it had stays. Feet (a unit with "ft" or "foot" in it) are understood; heights that are not above 0 are none.
/// \param diagnostics  is told how many got a body, and how many have no height; may be null
/// \return count of features that got a body
/// Cost: O(points).
std::size_t extrudeFootprints(model::BuildingModel& model, Diagnostics* diagnostics);

}  // namespace svt::readers
