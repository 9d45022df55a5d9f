#pragma once
/// \file
/// The closing test (does every edge have a partner?), and repairs of edges and orientation.

#include <svt/mesh/mesh_set.hpp>

#include <vector>

namespace svt::mesh {

/// Edges that are not used equally often in both directions, in the direction of the excess uses, and repeated for each
/// of them. Empty if the mesh is closed. Sorted by (from, to).
/// Cost: O(n log n).
[[nodiscard]] std::vector<OpenEdge> findOpenEdges(const std::vector<Triangle>& triangles);

/// Removes T-junctions: splits triangles at ends of open edges that lie within `distance` (metres) of another open
/// edge, in at most 8 rounds. Adds no points; the triangles cover the same area as before.
/// \param isUnfinished  set to true if points still lie on edges at the end; may be null. Splitting stops after the last
///                      round. It also stops at too many points on edges: over 16 per open edge and over a million
///                      in a round, or over `mostCuts` in all rounds.
/// \return count of splits
/// Cost: O(n log n) in the open edges and splits.
std::uint32_t cutAtTJunctions(std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles, double distance,
                              bool* isUnfinished = nullptr,
                              std::size_t mostCuts = std::numeric_limits<std::size_t>::max());

/// Removes faces that occur twice with different triangulations: triangles whose edges are used more often in their
/// direction than in the other and that a remaining triangle covers. Does nothing if that would not reduce the count of
/// open edges.
/// \return count of removed triangles
std::uint32_t removeDoubledFaces(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles);

/// Orients triangles consistently across edges with two uses, by a breadth-first search over each component. The
/// majority of a component decides its direction. Components that are consistent already, or not orientable (Moebius
/// strip), stay unchanged.
/// \return count of reversed triangles
std::uint32_t orientConsistently(std::vector<Triangle>& triangles);

/// Reverses components that face inwards (negative volume), unless a larger component encloses them (a void).
/// \return count of reversed triangles
std::uint32_t orientOutwards(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles);

/// Index of the edge-connected component of each triangle, numbered by first triangle.
[[nodiscard]] std::vector<std::uint32_t> findComponents(const std::vector<Triangle>& triangles);

/// Chains open edges into loops, each edge used at most once. Loops run against the direction of the edges, so that
/// they bound the missing face. Chains that do not close are left out. Deterministic.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> findBoundaryLoops(const std::vector<OpenEdge>& edges);

}  // namespace svt::mesh
