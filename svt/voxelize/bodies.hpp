#pragma once
/// \file
/// Thematic bodies. A CityGML 2 LoD4 building has its walls, slabs and roof only as surfaces: the material between the
/// outer hull and the rooms belongs to the building as a whole. Here every voxel of this material is assigned to the
/// nearest boundary surface, so that each wall has a body of its own in a section.

#include <svt/core/progress.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <vector>

namespace svt::voxelize {

/// One building: the scalar whose voxels are reassigned, and the surfaces that receive them.
struct BodyGroup {
    volume::Scalar from = 0;              ///< scalar of the building's solid
    std::vector<std::uint32_t> surfaces;  ///< objects of the meshes: its boundary surfaces, in tree order
    std::vector<volume::Scalar> scalars;  ///< their scalars, same order
};

/// Assigns every voxel of `from` to the surface nearest to its centre (distance in world space, ties go to the earlier
/// surface). Exact: octree blocks are split until one surface is nearest to the whole block, or down to single voxels.
/// Surfaces too far from a block are discarded for all of its children.
/// \param progress  receives the progress of the stage "bodies"; may be null
/// Cost: O(area between the bodies), not their volume. The result does not depend on `threads`.
[[nodiscard]] volume::ColumnVolume assignThematicBodies(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                                        const mesh::MeshSet& meshes,
                                                        const std::vector<BodyGroup>& groups, int threads,
                                                        const Progress* progress = nullptr);

}  // namespace svt::voxelize
