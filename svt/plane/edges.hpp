#pragma once
/// \file
/// Edges of rings in a plane. Edges that touch, overlap or cross are made into edges that meet at their ends only.

#include <svt/plane/point.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace svt::plane {

/// An edge between two vertices, by their indices. The left vertex comes first in the order of Point.
struct Edge {
    std::uint32_t left = 0, right = 0;
    friend bool operator==(const Edge&, const Edge&) = default;
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

/// Vertices in ascending order, none twice, so that a smaller index is further left; and edges, ascending.
struct EdgeGraph {
    struct Vertex {
        Point at;
        std::uint32_t point = 0;  ///< of the input, or an extra one
    };
    std::vector<Vertex> vertices;
    std::vector<Edge> edges;
    bool isTouching = false;  ///< points were joined, or edges touched, overlapped or crossed

    /// Ends of an edge by its number, as sweepEdges() asks for them.
    [[nodiscard]] std::pair<Point, Point> endsOf(std::uint32_t edge) const {
        return {vertices[edges[edge].left].at, vertices[edges[edge].right].at};
    }

    /// Sorts vertices and edges, and joins vertices at the same place: the smallest `point` stays. Edges without length
    /// go, and so do pairs of equal edges: between two of them nothing changes from inside to outside.
    void tidy();
};

/// Makes the extra point where two edges cross: `first` and `second` are their ends by `point`, t and u the fractions of
/// them. Returns its number.
using MakePoint = std::function<std::uint32_t(std::pair<std::uint32_t, std::uint32_t> first, double t,
                                              std::pair<std::uint32_t, std::uint32_t> second, double u)>;

/// Cuts the edges of a tidy graph where they touch, overlap or cross, until they meet at their ends only. The inside by
/// the odd rule stays the same, up to a step of the grid where edges cross. Coordinates are at most 2^50 from 0.
/// \param maxCrossings  number of places where edges cross that are cut
/// \return false if there are more, or if cutting does not come to an end
/// Cost: O((n + k) log n) a round, k crossings; one round without crossings, some where edges cross often, 40 at most.
///       Memory: O(n + k).
[[nodiscard]] bool cutCrossings(EdgeGraph& graph, std::size_t maxCrossings, const MakePoint& makePoint);

/// True if two edges have more in common than one end each, more than two edges have an end in common, or an edge has no
/// length. False for simple rings that do not touch each other. Exact.
/// \param edges  each from one corner of a ring to the next
/// Cost: as cutCrossings() without crossings.
[[nodiscard]] bool meetBeyondEnds(std::span<const std::pair<Point, Point>> edges);

}  // namespace svt::plane
