#pragma once
/// \file
/// Assigns shared planes: all coplanar triangles, in all objects, refer to one plane, so that solids that share a face
/// get the same heights whatever their triangulation.
///
/// voxelize/face_planes.hpp groups faces by plane as well, for another purpose. Here, a plane is a height over (x, y)
/// that holds for every grid, and a triangle that joins a plane takes its heights from it. So (nearly) vertical
/// triangles have no plane, and distances are in metres. There, planes code the bricks of one grid. So distances are in
/// voxels, normals may have any direction, and both sides of a face share one plane. Triangles that share a plane here
/// also share one there.

#include <svt/mesh/mesh_set.hpp>

namespace svt::mesh {

/// Sets meshes.planes, and Triangle::plane of all triangles that are not (nearly) vertical. Triangles are processed by
/// descending area, so that the largest ones define the planes. A triangle joins the first plane with a similar slope
/// that passes its corners within `distance` metres, measured along z and scaled by the slope.
/// Cost: O(triangles log triangles), also if planes hardly differ.
void assignPlanes(MeshSet& meshes, double distance);

}  // namespace svt::mesh
