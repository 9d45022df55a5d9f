#include <svt/illustrate/exact/region_sweep.hpp>

#include <algorithm>
#include <set>

namespace svt::illustrate {
namespace {

// Orders edges that the sweep line meets from below to above; such edges never cross.
struct BelowEdge {
    using is_transparent = void;
    const std::vector<ArrangementEdge>* edges = nullptr;

    [[nodiscard]] static std::int64_t sideOf(const ArrangementEdge& edge, DrawingPoint p) noexcept {
        return cross(edge.to - edge.from, p - edge.from);
    }
    bool operator()(std::uint32_t a, std::uint32_t b) const noexcept {
        if (a == b) return false;
        const ArrangementEdge &p = (*edges)[a], &q = (*edges)[b];
        // The one that begins later, seen from the other.
        if (p.from < q.from) {
            const std::int64_t side = sideOf(p, q.from);
            return side != 0 ? side > 0 : sideOf(p, q.to) > 0;
        }
        if (q.from < p.from) {
            const std::int64_t side = sideOf(q, p.from);
            return side != 0 ? side < 0 : sideOf(q, p.to) < 0;
        }
        return cross(p.to - p.from, q.to - q.from) > 0;
    }
    bool operator()(std::uint32_t a, DrawingPoint p) const noexcept { return sideOf((*edges)[a], p) > 0; }
    bool operator()(DrawingPoint p, std::uint32_t a) const noexcept { return sideOf((*edges)[a], p) < 0; }
};

class RegionSweep {
public:
    RegionSweep(const Arrangement& arrangement, const RegionRule& regionOf)
        : all_(arrangement),
          regionOf_(regionOf),
          status_(BelowEdge{&arrangement.edges}),
          places_(arrangement.edges.size(), status_.end()),
          above_(arrangement.edges.size()),
          sides_(arrangement.edges.size()) {}

    std::vector<EdgeSides> run() {
        std::vector<std::uint32_t> byEnd(all_.edges.size());
        for (std::uint32_t e = 0; e < byEnd.size(); ++e) byEnd[e] = e;
        std::sort(byEnd.begin(), byEnd.end(), [&](std::uint32_t a, std::uint32_t b) {
            return all_.edges[a].to != all_.edges[b].to ? all_.edges[a].to < all_.edges[b].to : a < b;
        });
        // Edges are ordered by where they begin.
        std::size_t ended = 0;
        for (std::uint32_t begin = 0, end = 0; begin < all_.edges.size(); begin = end) {
            const DrawingPoint node = all_.edges[begin].from;
            while (end < all_.edges.size() && all_.edges[end].from == node) ++end;
            for (; ended < byEnd.size() && all_.edges[byEnd[ended]].to <= node; ++ended) remove(byEnd[ended]);
            insert(node, begin, end);
        }
        return std::move(sides_);
    }

private:
    using Counts = std::vector<ClaimCount>;

    void remove(std::uint32_t edge) {
        if (places_[edge] == status_.end()) return;
        status_.erase(places_[edge]);
        above_[edge] = {};
    }

    // Inserts the edges [begin, end) that start at a node, from below to above.
    void insert(DrawingPoint node, std::uint32_t begin, std::uint32_t end) {
        std::vector<std::uint32_t> order;
        for (std::uint32_t e = begin; e < end; ++e) order.push_back(e);
        std::sort(order.begin(), order.end(), BelowEdge{&all_.edges});
        const auto next = status_.lower_bound(node);
        const Counts* below = next == status_.begin() ? &none_ : &above_[*std::prev(next)];
        for (const std::uint32_t e : order) {
            above_[e] = crossed(*below, e);
            sides_[e] = {regionOf_(above_[e]), regionOf_(*below)};
            places_[e] = status_.insert(next, e);
            below = &above_[e];
        }
    }

    // What encloses the place above an edge.
    [[nodiscard]] Counts crossed(const Counts& below, std::uint32_t edge) const {
        Counts above;
        auto old = below.begin();
        for (std::uint32_t m = all_.edges[edge].firstMark; m < all_.edges[edge].endMark; ++m) {
            const EdgeMark mark = all_.marks[m];
            if (mark.winding == 0) continue;
            for (; old != below.end() && old->claim < mark.claim; ++old) above.push_back(*old);
            const bool isKnown = old != below.end() && old->claim == mark.claim;
            const std::int32_t winding = mark.winding + (isKnown ? old->winding : 0);
            if (winding != 0) above.push_back({mark.claim, winding});
            if (isKnown) ++old;
        }
        above.insert(above.end(), old, below.end());
        return above;
    }

    const Arrangement& all_;
    const RegionRule& regionOf_;
    const Counts none_;
    using Status = std::set<std::uint32_t, BelowEdge>;
    Status status_;
    std::vector<Status::iterator> places_;  // by edge
    std::vector<Counts> above_;             // by edge
    std::vector<EdgeSides> sides_;
};

}  // namespace

std::vector<EdgeSides> sweepRegions(const Arrangement& arrangement, const RegionRule& regionOf) {
    return RegionSweep(arrangement, regionOf).run();
}

}  // namespace svt::illustrate
