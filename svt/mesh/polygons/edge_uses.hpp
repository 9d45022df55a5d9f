#pragma once
/// \file
/// Uses of edges by the triangles of a mesh, sorted by edge: for each edge, the triangles on its sides.

#include <svt/mesh/mesh_set.hpp>

#include <cstdint>
#include <vector>

namespace svt::mesh {

/// A use of an undirected edge by a triangle.
struct EdgeUse {
    std::uint32_t low, high;  ///< vertices of the edge
    std::uint32_t triangle;
    bool isForward;  ///< the triangle runs from `low` to `high`
    [[nodiscard]] bool isSameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All uses of edges, by ascending `low`, then `high`, then triangle.
/// Cost: O(n log n); O(n) where a vertex has few edges, and the vertices are numbered without large gaps.
[[nodiscard]] std::vector<EdgeUse> collectEdgeUses(const std::vector<Triangle>& triangles);

/// Calls `body(begin, end)` for each edge, whose uses are uses[begin] to uses[end - 1].
template <class F>
void forEachEdge(const std::vector<EdgeUse>& uses, F&& body) {
    for (std::size_t begin = 0; begin < uses.size();) {
        std::size_t end = begin + 1;
        while (end < uses.size() && uses[end].isSameEdge(uses[begin])) ++end;
        body(begin, end);
        begin = end;
    }
}

}  // namespace svt::mesh
