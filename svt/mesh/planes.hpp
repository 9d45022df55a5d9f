#pragma once
/// \file
/// Assigns shared planes: all coplanar triangles, in all objects, refer to one plane, so that solids that share a face
/// get the same heights whatever their triangulation.
///
/// voxelize/face_planes.hpp groups faces by plane as well, for another purpose. Here a plane is a height over (x, y)
/// that holds for every grid, and a triangle that joins one takes its heights from it. So (nearly) vertical triangles
/// have none, and distances are in metres. There the planes serve to code the bricks of one grid. So distances are in
/// voxels, normals may have any direction, and both sides of a face have one plane. A plane from here is kept there.

#include <svt/mesh/mesh_set.hpp>

namespace svt::mesh {

/// Sets meshes.planes, and Triangle::plane of all triangles that are not (nearly) vertical. Triangles are processed by
/// descending area, so that the largest ones define the planes. A triangle joins the first plane whose slope is like its
/// own and that passes its corners within `distance` metres, measured along z and scaled by the slope.
/// Cost: O(triangles log triangles), also where planes hardly differ.
void assignPlanes(MeshSet& meshes, double distance);

}  // namespace svt::mesh
