#pragma once
/// \file
/// Closes holes of a shell by planes.

#include <svt/mesh/mesh_set.hpp>

namespace svt::mesh {

/// Closes the loops of open edges that planar faces can fill, and records these in mesh.caps. A loop is tried as
///
///     one plane               a corner                    planes along chords
///                             o-----.                     o-------o
///     o--------o              |\     \  three runs of     |  run  |   a wall and the ground below it are
///     |  cap   |              | x-----o edges, each in    o- - - -o   missing: a run of edges in one plane is cut off
///     o--------o              |/     /  a plane: x is      \  run  \  by the chord of its ends, then the next
///                             o-----'   where they meet     o-------o
///
/// A loop inside another one in its plane, in the opposite direction, is a hole of its cap: the lower edges of a court in
/// the missing floor of a building.
///
/// A run is evidence of a plane if it bends at least twice, and if a cap there would not lie on the neighbouring faces.
/// The border of a flat part, such as a single floating face, is not a hole, unless the part is a sliver: all slivers
/// together are at most a hundredth of the shell. Non-planar holes stay open.
/// \param deviation  how far the border may be from its plane, metres
/// \post mesh.openEdges holds the edges that are still open
/// Cost: O(n) for a planar loop of n points, else O(n^3); loops of more than 200 points are tried as one plane only.
void capHoles(ObjectMesh& mesh, double deviation);

}  // namespace svt::mesh
