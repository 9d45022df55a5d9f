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
    std::optional<SpacingChoice> choice;  ///< of its spacing, where none was asked for
    LabelledObjects labelled;
};

/// Reports objects outside a grid that was made for another model. \return EmptyModel if all are outside
[[nodiscard]] Result<void> checkGivenGrid(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                          const volume::Grid& grid, Diagnostics* log);

/// Warns of objects whose voxels are too many or too few for the volume that their shells enclose. A face that is up to half
/// a voxel off shifts the volume by half a voxel times its area, so area * spacing / 2 is allowed beside 2 %, and the one
/// voxel that every object gets; so small objects need no special case.
void checkVolumes(const model::BuildingModel& model, const Prepared& prepared, const voxelize::VoxelizeResult& voxels,
                  Diagnostics& log);

/// Reports where a bound on work made the answer coarser than it is elsewhere.
void reportBounds(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                  const voxelize::VoxelizeResult& voxels, Diagnostics& log);

}  // namespace svt::pipeline
