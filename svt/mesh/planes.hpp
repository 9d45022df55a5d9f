#pragma once
/// \file
/// One plane for all triangles that lie on it, in all objects, so that solids that share a face get the
/// same heights from it whatever their triangulation.

#include <svt/mesh/mesh_scene.hpp>

namespace svt::mesh {

/// Sets Triangle::plane of all triangles of `scene` that are not vertical, and scene.planes. A triangle joins a known
/// plane when its corners are within `distance` metres of it, measured along z scaled by the slope; the largest
/// triangles found the planes. Cost: O(triangles log triangles).
void assignPlanes(MeshScene& scene, double distance);

}  // namespace svt::mesh
