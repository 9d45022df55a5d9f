#pragma once
/// \file
/// Edges of rings in a plane. Cuts edges that touch, overlap or cross into edges that meet only at their ends.

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

/// Distinct vertices in ascending order, so that a smaller index is further left, and edges in ascending order.
struct EdgeGraph {
    struct Vertex {
        Point at;
        std::uint32_t point = 0;  ///< index in the input, or of an extra point
    };
    std::vector<Vertex> vertices;
    std::vector<Edge> edges;
    bool isTouching = false;  ///< points were joined, or edges touched, overlapped or crossed

    /// The ends of an edge by its number, for sweepEdges().
    [[nodiscard]] std::pair<Point, Point> endsOf(std::uint32_t edge) const {
        return {vertices[edges[edge].left].at, vertices[edges[edge].right].at};
    }

    /// Sorts vertices and edges, and merges vertices at the same place, which keep the smallest `point`. Removes edges
    /// without length and pairs of equal edges: crossing such a pair does not change between inside and outside.
    void tidy();
};

/// Makes the extra point where two edges cross. `first` and `second` are the ends of the edges by `point`, t and u the
/// fractions along them. Returns the number of the point.
using MakePoint = std::function<std::uint32_t(std::pair<std::uint32_t, std::uint32_t> first, double t,
                                              std::pair<std::uint32_t, std::uint32_t> second, double u)>;

/// Cuts the edges of a tidy graph where they touch, overlap or cross, until they meet only at their ends. The inside by
/// the even-odd rule stays the same, up to one grid step where edges cross. Coordinates are at most 2^50 from 0.
/// \param maxCrossings  maximum number of crossings that are cut
/// \return false if there are more, or if cutting does not end
/// Cost: O((n + k) log n) per round, k crossings. One round without crossings, several if edges cross often, at most
///       40. Memory: O(n + k).
[[nodiscard]] bool cutCrossings(EdgeGraph& graph, std::size_t maxCrossings, const MakePoint& makePoint);

/// True if two edges share more than one end, if more than two edges share an end, or if an edge has no length. False
/// for simple rings that do not touch each other. Exact.
/// \param edges  each from one corner of a ring to the next
/// Cost: as cutCrossings() without crossings.
[[nodiscard]] bool meetBeyondEnds(std::span<const std::pair<Point, Point>> edges);

}  // namespace svt::plane
