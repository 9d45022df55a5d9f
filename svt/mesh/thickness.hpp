#pragma once
/// \file
/// Thickness of the material behind each face of a solid, to distinguish thin panes from bodies.

#include <svt/mesh/mesh_set.hpp>

namespace svt::mesh {

/// Sets Triangle::thickness of a closed mesh: the distance, in metres, from the centroid of the face along its inward
/// normal to the next face of the same object whose normal is within 45 degrees of that direction; +inf if there is
/// none. Cost: O(n log n) by a bounding volume hierarchy; where that fails, as for very many thin triangles across each
/// other's boxes, the search ends after 256 boxes a face on average (and at least 34 million), and +inf stands for the
/// faces that are left.
void measureThickness(ObjectMesh& mesh);

}  // namespace svt::mesh
