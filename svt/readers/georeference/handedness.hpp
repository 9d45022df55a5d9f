#pragma once
/// \file
/// Warns of models that seem to be mirrored: their shells face inward, as they do with exchanged axes.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::readers::georeference {

/// Adds the finding AxisOrder if there are at least three solids, roofs or grounds, and nine tenths of them face the
/// wrong way: solids inward, roofs down, grounds up. Changes nothing, because inverted shells have the same sign.
/// \param model         in the order east, north
/// \param isNorthFirst  whether the axes of the file were exchanged
/// Cost: O(points).
void warnOfMirror(const model::BuildingModel& model, bool isNorthFirst, const Place& place, Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
