#pragma once
/// \file
/// Findings of a build: objects outside a given grid, volumes that differ from those of the model, bounds on work.

#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/labels.hpp>

#include <optional>

namespace svt::pipeline {

/// A model before its voxels.
struct Prepared {
    mesh::MeshSet meshes;
    volume::Grid grid;
    std::optional<SpacingChoice> choice;  ///< the chosen spacing; empty if one was requested
    LabelledObjects labelled;
};

/// Reports objects outside a grid that was made for another model. \return EmptyModel if all are outside
[[nodiscard]] Result<void> checkGivenGrid(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                          const volume::Grid& grid, Diagnostics* log);

/// Warns of objects that are far larger than all others, so that a default grid ends before they do (GridTooLarge).
void reportCutObjects(const model::BuildingModel& model, const mesh::MeshSet& meshes, const volume::Grid& grid,
                      const SpacingChoice& choice, Diagnostics& log);

/// Warns of objects that have too many or too few voxels for the volume that their shells enclose. The tolerance is 2 %
/// plus area * spacing / 2 plus one voxel. A face that is half a voxel off changes the volume by half a voxel times its
/// area, and every object gets at least one voxel, so small objects need no special case.
void checkVolumes(const model::BuildingModel& model, const Prepared& prepared, const voxelize::VoxelizeResult& voxels,
                  Diagnostics& log);

/// Reports objects whose result is coarser than usual because of a limit on work.
void reportBounds(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                  const voxelize::VoxelizeResult& voxels, Diagnostics& log);

}  // namespace svt::pipeline
