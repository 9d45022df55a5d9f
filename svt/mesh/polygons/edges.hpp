#pragma once
/// \file
/// The closing test: does every edge have its partners?

#include <svt/mesh/mesh_scene.hpp>

#include <vector>

namespace svt::mesh {

/// Edges that are not used equally often in both directions, each as often as it is missing, in the
/// direction in which the mesh uses it. Empty: the mesh is closed. Sorted by (from, to).
/// Cost: O(n log n).
[[nodiscard]] std::vector<OpenEdge> findOpenEdges(const std::vector<Triangle>& triangles);

/// Cuts the triangles at points of open edges that lie within `distance` (metres) of another open edge, until
/// no such edge is left. Adds no points; the triangles cover what they covered.
/// \return how many edges were cut
/// Cost: O(open edges log + pairs near each other).
std::uint32_t cutAtTJunctions(std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles, double distance);

/// Removes faces that stand doubled with another triangulation: triangles on edges that their direction uses more often
/// than the other, where a triangle that stays covers them, if that closes the mesh further. \return count of removed
/// triangles, 0 where it would not help
std::uint32_t removeDoubledFaces(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles);

/// Turns triangles until neighbours over edges with two uses agree, component by component; a component that agrees
/// already, or cannot agree (Moebius), stays. The larger part of a component decides.
/// \return count of turned triangles
std::uint32_t orientConsistently(std::vector<Triangle>& triangles);

/// Turns closed components that face inwards although no other component encloses them.
/// \return count of turned triangles
std::uint32_t orientOutwards(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles);

/// Number of the connected component (over shared corners' edges) of each triangle, 0-based by first triangle.
[[nodiscard]] std::vector<std::uint32_t> findComponents(const std::vector<Triangle>& triangles);

/// Chains open edges to loops (each edge used once), against the direction of the edges so that the loop bounds the
/// missing face. Loops that do not close are left out. Deterministic.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> findBoundaryLoops(const std::vector<OpenEdge>& edges);

}  // namespace svt::mesh
