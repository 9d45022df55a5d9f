#pragma once
/// \file
/// Findings of readers and of closing, by place, for the reports of `svt check`: what stands beside the tests by ISO 19107.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

#include <map>
#include <string>
#include <vector>

namespace svt::cli {

/// A warning or error, and the feature that it is of.
struct OtherFinding {
    const Diagnostic* item = nullptr;
    model::FeatureIndex feature = model::kNoFeature;  ///< kNoFeature: of no feature that the model has
};

/// Warnings and errors in their order, without notes. The feature is that of the id, which may be that of a polygon.
[[nodiscard]] std::vector<OtherFinding> otherFindings(const model::BuildingModel& model,
                                                      const Diagnostics& diagnostics);

/// The topmost feature that holds `feature`, such as the building of a wall.
[[nodiscard]] model::FeatureIndex rootOf(const model::BuildingModel& model, model::FeatureIndex feature) noexcept;

/// Rings that were left out or closed, links between primal and dual space that do not agree: found by readers, and
/// defects that the tests of geometry look for all the same.
[[nodiscard]] bool isOfGeometry(const Diagnostic& item) noexcept;

}  // namespace svt::cli
