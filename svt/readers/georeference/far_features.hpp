#pragma once
/// \file
/// Features that lie far away from all others, for example because of swapped or missing coordinates. A grid around all
/// features would have cells of kilometres.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

namespace svt::readers::georeference {

/// Empties the geometry of features that lie farther from the middle than 10 km and than 50 times the distance within
/// which three quarters of the features lie. The middle is the median of all centres, so it is close to most features.
/// With fewer than three features, or if a quarter of the features is far away, no feature is emptied.
/// \param metresPerUnit  of the coordinates, by axis; an approximation is sufficient
/// \return number of features left out; each is a finding FarFeature, a feature with all its parts is one
std::size_t leaveOutFarFeatures(model::BuildingModel& model, Vec3d metresPerUnit, const Place& file,
                                Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
