#pragma once
/// \file
/// Creates the label table from features and meshes: tree order, scalar ranges, styles.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/voxelize/patterns.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <vector>

namespace svt::pipeline {

struct LabelledObjects {
    volume::LabelTable table;
    std::vector<std::uint32_t> labelOfObject;         ///< per meshes.objects
    std::vector<std::uint32_t> labelOfLine;           ///< per model.lines
    std::vector<voxelize::ObjectClaim> claims;        ///< per meshes.objects
    std::vector<voxelize::PatternedObject> patterns;  ///< objects with a pattern
};

/// Adds a ClosureSurface feature below each object that was closed by caps, with the cap area as attribute.
void addCapFeatures(model::BuildingModel& model, const mesh::MeshSet& meshes);

/// Numbers all features in tree order and assigns every object a contiguous scalar range. A feature with lines is an
/// object as well, without voxels: a separate scalar gives its lines a style.
/// \param thinnest  metres: thickness with which thinner parts are drawn, for the opacity of transparent materials
/// \return the labels, or TooManyLabels over volume::kMaxScalarCount
[[nodiscard]] Result<LabelledObjects> makeLabels(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                                 std::span<const StyleSheet* const> sheets, double thinnest = 0.05);

}  // namespace svt::pipeline
