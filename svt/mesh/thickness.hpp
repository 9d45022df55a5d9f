#pragma once
/// \file
/// How much material lies behind each face of a solid: what tells thin panes and sheets from bodies.

#include <svt/mesh/mesh_scene.hpp>

namespace svt::mesh {

/// Sets Triangle::thickness of a closed mesh: the distance, in metres, from the centre of the face along its inward
/// normal to the next face of the same object that faces the other way within 45 degrees; +inf where there is none.
/// Cost: O(n log n) by a bounding volume hierarchy.
void measureThickness(ObjectMesh& mesh);

}  // namespace svt::mesh
