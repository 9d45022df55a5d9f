#pragma once
/// \file
/// Edges of rings in a plane, on a grid of whole numbers, so that each question of order is answered exactly: which point
/// is left of another, on which side of an edge a point lies. Edges that touch, overlap or cross are made into edges that
/// meet at their ends alone.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace svt::mesh {

/// A point of the plane. At most 2^50 from zero along each axis.
struct FlatPoint {
    std::int64_t x = 0, y = 0;
    friend bool operator==(const FlatPoint&, const FlatPoint&) = default;
    /// The order of a line that sweeps from left to right and is leaned a little: of points with the same x the lower
    /// one comes first.
    friend bool operator<(const FlatPoint& a, const FlatPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

/// Above 0: `c` lies to the left of the line from `a` to `b`; below 0: to its right; 0: on it. Exact.
[[nodiscard]] inline int sideOf(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) noexcept {
    __extension__ using Wide = __int128;
    const Wide twiceArea = Wide(b.x - a.x) * (c.y - a.y) - Wide(b.y - a.y) * (c.x - a.x);
    return (twiceArea > 0) - (twiceArea < 0);
}

/// An edge between two vertices, by their indices; the left one comes first in the order of FlatPoint.
struct FlatEdge {
    std::uint32_t left = 0, right = 0;
    friend bool operator==(const FlatEdge&, const FlatEdge&) = default;
    friend bool operator<(const FlatEdge& a, const FlatEdge& b) {
        return a.left != b.left ? a.left < b.left : a.right < b.right;
    }
};

/// Vertices in ascending order, none twice, so that a smaller index is further left; and edges, ascending.
struct FlatGraph {
    struct Vertex {
        FlatPoint at;
        std::uint32_t point = 0;  ///< of the input, or an extra one
    };
    std::vector<Vertex> vertices;
    std::vector<FlatEdge> edges;
    bool isTouching = false;  ///< points were joined, or edges touched, overlapped or crossed

    /// Sorts vertices and edges, and joins vertices at the same place: the smallest `point` stays. Edges without length
    /// go, and so do pairs of equal edges: between two of them nothing changes from inside to outside.
    void tidy();
};

/// Makes the extra point where two edges cross: `first` and `second` are their ends by `point`, t and u the fractions of
/// them. Returns its number.
using MakePoint = std::function<std::uint32_t(std::pair<std::uint32_t, std::uint32_t> first, double t,
                                              std::pair<std::uint32_t, std::uint32_t> second, double u)>;

/// Cuts the edges of a tidy graph where they touch, overlap or cross, until they meet at their ends alone. What lies
/// inside by the odd rule stays the same, up to a step of the grid where edges cross.
/// \param maxCrossings  how many places where edges cross are cut
/// \return false if there are more, or if cutting does not come to an end
/// Cost: O((n + k) log n) a round, k crossings; one round without crossings, some where edges cross often, 40 at most.
///       Memory: O(n + k).
[[nodiscard]] bool cutCrossings(FlatGraph& graph, std::size_t maxCrossings, const MakePoint& makePoint);

}  // namespace svt::mesh
