#pragma once
/// \file
/// Reports of `svt check` on a validation: JSON of its own and of val3dity, messages, a page with pictures.

#include <apps/cli/output/json_output.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/validate/validate.hpp>

#include <string>

namespace svt::cli {

/// A model, the findings in it, and the tolerances of the tests.
struct Checked {
    const model::BuildingModel& model;
    const validate::ValidationReport& report;
    const validate::ValidateOptions& options;
    const mesh::MeshSet& meshes;
    const Diagnostics& others;  ///< findings of readers and of closing
    Json units{};               ///< of checkUnits(); null: the model has no units, or they were not compared
};

/// Keys `valid`, `findings`, `counts`, `features`, `primitives`, `polygons` of the JSON of `svt check`.
void addValidationJson(Json& json, const Checked& checked);

/// The report in the format of val3dity; keys `other_findings` and `other_counts` have the findings that val3dity does
/// not test.
/// \param inputFile as named by the user
[[nodiscard]] Json val3dityJson(const Checked& checked, const std::string& inputFile);

/// Adds each finding as a warning, except findings whose code and id are already present.
void addFindings(Diagnostics& diagnostics, const Checked& checked);

/// The page of `--report`: counts by kind and by place, and all findings by kind, with pictures. A single file that
/// loads nothing else.
[[nodiscard]] std::string htmlReport(const Checked& checked, const std::string& inputFile);

/// The place of a finding: the id of its polygon, "polygon 12" if the polygon lacks an id, or empty without a polygon.
[[nodiscard]] std::string polygonName(const model::BuildingModel& model, const validate::Finding& finding);

}  // namespace svt::cli
