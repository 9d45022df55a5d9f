#pragma once
/// \file
/// Findings of readers and of closing, by place, for the reports of `svt check`, beside the tests by ISO 19107.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

#include <map>
#include <string>
#include <vector>

namespace svt::cli {

/// A warning or error, and its feature.
struct OtherFinding {
    const Diagnostic* item = nullptr;
    model::FeatureIndex feature = model::kNoFeature;  ///< kNoFeature: the model has no such feature
};

/// Warnings and errors in their order, without notes. The id of a finding, feature or polygon, gives the feature.
[[nodiscard]] std::vector<OtherFinding> otherFindings(const model::BuildingModel& model,
                                                      const Diagnostics& diagnostics);

/// The topmost feature that holds `feature`, such as the building of a wall.
[[nodiscard]] model::FeatureIndex rootOf(const model::BuildingModel& model, model::FeatureIndex feature) noexcept;

/// Whether readers found a defect of geometry, which the tests cover too: rings that were left out or closed, and
/// inconsistent links between primal and dual space.
[[nodiscard]] bool isOfGeometry(const Diagnostic& item) noexcept;

}  // namespace svt::cli
