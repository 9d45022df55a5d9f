#pragma once
/// \file
/// The planes of the faces of a model's meshes, in voxel space, with the offset of the samples that the voxelizer uses.
///
/// Triangles with a shared plane of their meshes (mesh/planes.hpp) keep it. Only the others are grouped here: vertical
/// ones, and all triangles if the grid's z axis is not vertical. The planes of the meshes do not suit these: they are
/// heights over (x, y). Since they apply to every grid, their tolerance is in metres, not in voxels.

#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/face_planes.hpp>
#include <svt/volume/grid.hpp>

#include <vector>

namespace svt::voxelize {

/// Planes of all faces that are large enough to code bricks: at least 32 square voxels on one plane, counting triangles
/// of at least one square voxel. Coplanar faces (to 1/50 voxel) of all objects share a plane, regardless of their
/// orientation.
/// \return the planes, largest area first; planes whose faces lie outside the grid are left out
/// Cost: O(triangles log triangles).
[[nodiscard]] std::vector<volume::FacePlane> findFacePlanes(const mesh::MeshSet& meshes, const volume::Grid& grid);

}  // namespace svt::voxelize
