#pragma once
/// \file
/// The tests of legal units for `svt check`: overlaps, gaps in storeys, units that no common part reaches.

#include <apps/cli/output/json_output.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>

namespace svt::cli {

/// Builds a volume of a model that has legal units, checks these, and adds a finding for each defect. A model without
/// units is not built.
/// \param overlap  tolerated depth of overlaps as of ValidateOptions::overlap, metres; negative: 1 mm
/// \return an object with `units`, `overlaps` and `gaps` (docs/user/json.md); null if the model has no units, or if its
///         volume cannot be built, which is a warning
[[nodiscard]] Json checkUnits(const model::BuildingModel& model, const pipeline::BuildOptions& options, double overlap,
                              Diagnostics& diagnostics);

}  // namespace svt::cli
