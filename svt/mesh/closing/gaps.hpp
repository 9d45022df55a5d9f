#pragma once
/// \file
/// Gaps between the faces of an open shell: joins edges that nearly meet, and bridges loops that run next to each
/// other.

#include <svt/mesh/mesh_set.hpp>

#include <cstdint>

namespace svt::mesh {

/// Merges ends of open edges that are up to `distance` metres apart into one corner in their middle. An end moves by no
/// more than 0.3 of its shortest open edge; edges below 0.1 mm do not count. Triangles that lose a side are dropped.
/// \pre mesh.openEdges holds the open edges; it is out of date afterwards
/// Cost: O(n log n) in the open edges, plus their pairs that overlap along x.
void weldLooseEnds(ObjectMesh& mesh, double distance);

/// Joins ends of open edges, and ends and edges, that are up to 1 mm, 1 cm, 5 cm or 25 cm apart. Uses the smallest of
/// these distances that leaves no edge open. Otherwise uses the one that leaves the least length of open edges, if that
/// is less than half. Joined corners meet in their middle. A corner moves by no more than 0.3 of its shortest open edge
/// and 0.02 of the diagonal of the object, so that small parts keep their shape.
///
///      o------o   o------o             o------o------o
///      | face  \   \ face |    -->     | face  \ face |
///      o--------o   o-----o            o--------o-----o
/// \post mesh.openEdges holds the edges that are still open
/// \return number of edges that are no longer open
/// Cost: O(n log n) in the open edges, plus their pairs that overlap along x.
std::uint32_t joinGaps(ObjectMesh& mesh);

/// Bridges loops of open edges of different parts of the shell that run around the same area: a ground that shares no
/// edge with the walls, a roof above missing walls. They must face each other and be up to 0.5 m or a fifth of their
/// size apart everywhere. Two loops that are level rather than steep may instead lie above each other: then the
/// vertical walls between them are missing.
///
///     |        |            |        |
///     |  walls |            |  walls |           A strip of triangles between two loops, the shorter diagonal first
///     o--------o    -->     o--------o           (Christiansen & Sederberg 1978).
///    o==========o           o========o
///       ground
/// \post mesh.openEdges holds the edges that are still open
/// \return number of bridged pairs
/// Cost: O(pairs of loops * their points squared); shells of more than 64 loops are left as they are.
std::uint32_t bridgeLoops(ObjectMesh& mesh);

}  // namespace svt::mesh
