#pragma once
/// \file
/// Creates the label table from features and meshes: tree order, scalar ranges, styles.

#include <svt/mesh/mesh_scene.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/voxelize/patterns.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <vector>

namespace svt::pipeline {

struct Labelling {
    volume::LabelTable table;
    std::vector<std::uint32_t> labelOfObject;         ///< per scene.objects
    std::vector<voxelize::ObjectClaim> claims;        ///< per scene.objects
    std::vector<voxelize::PatternedObject> patterns;  ///< objects with a pattern
};

/// Adds a ClosureSurface feature below each object that was closed by caps, with the cap area as attribute.
void addCapFeatures(model::BuildingModel& model, const mesh::MeshScene& scene);

/// Numbers all features in tree order and assigns every object a contiguous scalar range.
/// \return the labels, or TooManyLabels over volume::kMaxScalarCount
[[nodiscard]] Result<Labelling> makeLabels(const model::BuildingModel& model, const mesh::MeshScene& scene,
                                           std::span<const StyleSheet* const> sheets);

}  // namespace svt::pipeline
