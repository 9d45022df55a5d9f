#pragma once
/// \file
/// A sweep over edges that meet only at their ends, from the first point to the last, with the edges at each point in
/// order.

#include <svt/plane/point.hpp>

#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace svt::plane {

/// The order, from below, of the edges that the sweep line meets, and of points among them. The edge that begins later
/// lies on the side of the earlier edge on which it begins; if it begins on the earlier edge, on the side on which it
/// ends. Edges must not cross.
/// \tparam EndsOf  the ends of an edge by its number: a pair of Points, the lesser first
template <class EndsOf>
struct BelowEdge {
    using is_transparent = void;
    EndsOf endsOf;

    [[nodiscard]] int side(std::uint32_t edge, Point p) const {
        const auto& [left, right] = endsOf(edge);
        return turn(left, right, p);
    }
    bool operator()(std::uint32_t a, std::uint32_t b) const {
        const auto& [aLeft, aRight] = endsOf(a);
        const auto& [bLeft, bRight] = endsOf(b);
        if (aLeft == bLeft) return turn(aLeft, aRight, bRight) > 0;
        if (aLeft < bLeft) {
            const int begin = turn(aLeft, aRight, bLeft);
            return (begin != 0 ? begin : turn(aLeft, aRight, bRight)) > 0;
        }
        const int begin = turn(bLeft, bRight, aLeft);
        return (begin != 0 ? begin : turn(bLeft, bRight, aRight)) < 0;
    }
    bool operator()(std::uint32_t edge, Point p) const { return side(edge, p) > 0; }
    bool operator()(Point p, std::uint32_t edge) const { return side(edge, p) < 0; }
};

/// Calls visit(point, ending, starting, below) for each end of an edge, in ascending order. `ending` and `starting` are
/// the numbers of the edges that end and start there, from below; `below` is the number of the edge below the point, or
/// kNone.
/// \param count   number of edges; they are numbered in ascending order of their lesser ends
/// \param endsOf  as for BelowEdge
/// Cost: O(n log n). Source: M. I. Shamos, D. Hoey, Geometric intersection problems, FOCS 1976.
template <class EndsOf, class Visit>
void sweepEdges(std::uint32_t count, const EndsOf& endsOf, const Visit& visit) {
    std::vector<std::uint32_t> byRight(count), ending, starting;
    std::iota(byRight.begin(), byRight.end(), 0u);
    std::sort(byRight.begin(), byRight.end(),
              [&](std::uint32_t a, std::uint32_t b) { return endsOf(a).second < endsOf(b).second; });
    const BelowEdge<EndsOf> below{endsOf};
    std::set<std::uint32_t, BelowEdge<EndsOf>> open(below);
    for (std::uint32_t left = 0, right = 0; right < count;) {
        Point at = endsOf(byRight[right]).second;
        if (left < count) at = std::min<Point>(at, endsOf(left).first);
        ending.clear();
        starting.clear();
        auto above = open.lower_bound(at);
        for (; above != open.end() && endsOf(*above).second == at; above = open.erase(above)) ending.push_back(*above);
        while (right < count && endsOf(byRight[right]).second == at) ++right;
        for (; left < count && endsOf(left).first == at; ++left) starting.push_back(left);
        std::sort(starting.begin(), starting.end(), below);
        if (ending.empty() && starting.empty()) continue;
        visit(at, std::span<const std::uint32_t>(ending), std::span<const std::uint32_t>(starting),
              above == open.begin() ? kNone : *std::prev(above));
        for (const std::uint32_t edge : starting) open.insert(above, edge);
    }
}

}  // namespace svt::plane
