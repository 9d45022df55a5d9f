#pragma once
/// \file
/// Features that lie far away from all others, as one with swapped or missing coordinates does: a grid around them all
/// would have cells of kilometres.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::readers::georeference {

/// Empties the geometry of features that lie farther from the middle of all than 10 km and 50 times the distance that
/// three quarters of the features keep. The middle is the median of the centres, so it stands among the many. With
/// fewer than three features, or where every fourth feature is far away, none is.
/// \param metresPerUnit  of the coordinates, by axis; about right is enough
/// \return number of features left out; each is a finding FarFeature, a feature with all its parts is one
std::size_t leaveOutFarFeatures(model::BuildingModel& model, Vec3d metresPerUnit, const Place& file,
                                Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
