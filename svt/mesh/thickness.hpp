#pragma once
/// \file
/// Thickness of the material behind each face of a solid, to distinguish thin panes from bodies.

#include <svt/mesh/mesh_set.hpp>

#include <limits>

namespace svt::mesh {

/// Sets Triangle::thickness of a closed mesh: the distance, in metres, from the centroid of a face along its inward
/// normal to the next face of the same object. The normal of the next face must be within 45 degrees of the inward
/// normal. Without such a face, the thickness is +inf.
/// Cost: O(n log n) by a bounding volume hierarchy. The hierarchy fails for very many thin triangles that cross each
/// other's boxes. Then the search ends after 256 boxes per face plus 34 million boxes, and the remaining faces keep
/// +inf.
/// \param limit  metres; a thickness of this or more becomes +inf, too; a small limit saves time, because rays end
///               there
void measureThickness(ObjectMesh& mesh, double limit = std::numeric_limits<double>::infinity());

/// The same for all solids of a model.
/// \param threads  0: all cores; the result does not depend on it
void measureThickness(MeshSet& meshes, double limit, int threads);

}  // namespace svt::mesh
