#pragma once
/// \file
/// The planes that the faces of a scene lie on, in the voxel space in which samples are decided.

#include <svt/mesh/mesh_scene.hpp>
#include <svt/volume/face_planes.hpp>
#include <svt/volume/grid.hpp>

#include <vector>

namespace svt::voxelize {

/// Planes of all faces that are large enough for bricks to be told by them: 32 square voxels on one plane, in triangles
/// of one at least. Faces of all objects that lie on one plane (to 1/50 voxel) share it, whichever way they look.
/// \return the planes, those with the largest area first; none of faces outside of the grid
/// Cost: O(triangles log triangles).
[[nodiscard]] std::vector<volume::FacePlane> findFacePlanes(const mesh::MeshScene& scene, const volume::Grid& grid);

}  // namespace svt::voxelize
