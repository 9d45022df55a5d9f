#pragma once
/// \file
/// What `svt check` reports of a validation: JSON of its own and of val3dity, messages, a page with pictures.

#include <apps/cli/output/json_output.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/validate/validate.hpp>

#include <string>

namespace svt::cli {

/// A model, what was found in it, and by which tolerances.
struct Checked {
    const model::BuildingModel& model;
    const validate::ValidationReport& report;
    const validate::ValidateOptions& options;
    const mesh::MeshSet& meshes;
    const Diagnostics& others;  ///< findings of readers and of closing
};

/// Keys `valid`, `findings`, `counts`, `features`, `primitives`, `polygons` of the JSON of `svt check`.
void addValidationJson(Json& json, const Checked& checked);

/// The report as val3dity writes it; keys `other_findings` and `other_counts` have what it does not look for.
/// \param inputFile as named by the user
[[nodiscard]] Json val3dityJson(const Checked& checked, const std::string& inputFile);

/// Adds each finding as a warning, but those that are there already by code and id.
void addFindings(Diagnostics& diagnostics, const Checked& checked);

/// The page of `--report`: counts by kind and by place, all findings by kind, with pictures. One file, nothing loaded
/// from elsewhere.
[[nodiscard]] std::string htmlReport(const Checked& checked, const std::string& inputFile);

/// Where a finding is: id of its polygon, "polygon 12" where that has none, else empty.
[[nodiscard]] std::string polygonName(const model::BuildingModel& model, const validate::Finding& finding);

}  // namespace svt::cli
