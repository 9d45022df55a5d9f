#pragma once
/// \file
/// Triangulates the area that edges enclose by the even-odd rule, in one sweep. For polygons of many points, where the
/// list of open edges makes GLU quadratic.

#include <svt/plane/edges.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::plane {

/// Triangles of the inside, counter-clockwise, corners by EdgeGraph::Vertex::point. All vertices with edges are
/// corners, also those on straight lines; no triangle has zero area on the grid.
/// \param graph  tidy, with edges that meet only at their ends (cutCrossings()), and an even number of them at each
///               vertex
/// Cost: O(n log n). Source: S. Hertel, K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulateInside(const EdgeGraph& graph);

}  // namespace svt::plane
