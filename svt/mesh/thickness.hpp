#pragma once
/// \file
/// Thickness of the material behind each face of a solid, to distinguish thin panes from bodies.

#include <svt/mesh/mesh_set.hpp>

#include <limits>

namespace svt::mesh {

/// Sets Triangle::thickness of a closed mesh: the distance, in metres, from the centroid of the face along its inward
/// normal to the next face of the same object whose normal is within 45 degrees of that direction; +inf if there is
/// none. Cost: O(n log n) by a bounding volume hierarchy; where that fails, as for very many thin triangles across each
/// other's boxes, the search ends after 256 boxes a face on average (and at least 34 million), and +inf stands for the
/// faces that are left.
/// \param limit  metres; a thickness of this or more is +inf, too, and costs little: a ray ends there
void measureThickness(ObjectMesh& mesh, double limit = std::numeric_limits<double>::infinity());

/// The same for all solids of a model.
/// \param threads  0: all cores; the result does not depend on it
void measureThickness(MeshSet& meshes, double limit, int threads);

}  // namespace svt::mesh
