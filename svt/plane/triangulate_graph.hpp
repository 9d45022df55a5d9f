#pragma once
/// \file
/// Triangulates what edges enclose by the odd rule, in one sweep: for polygons of many points, where GLU's list of open
/// edges makes it quadratic.

#include <svt/plane/edges.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::plane {

/// Triangles of the inside, counter-clockwise, corners by EdgeGraph::Vertex::point. All vertices with edges are corners,
/// also those on straight lines; no triangle is without area on the grid.
/// \param graph  tidy, with edges that meet at their ends only (cutCrossings()), an even number at each vertex
/// Cost: O(n log n). Source: S. Hertel, K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulateInside(const EdgeGraph& graph);

}  // namespace svt::plane
