#include <svt/plane/regions.hpp>

#include <svt/plane/sweep.hpp>

namespace svt::plane {
namespace {

class RegionSweep {
public:
    RegionSweep(const Arrangement& arrangement, const RegionRule& regionOf)
        : all_(arrangement), regionOf_(regionOf), above_(arrangement.edges.size()), sides_(arrangement.edges.size()) {}

    std::vector<EdgeSides> run() {
        using Edges = std::span<const std::uint32_t>;  // by number
        sweepEdges(
            static_cast<std::uint32_t>(all_.edges.size()),
            [&](std::uint32_t e) { return std::pair(all_.edges[e].from, all_.edges[e].to); },
            [&](Point, Edges ending, Edges starting, std::uint32_t edgeBelow) {
                for (const std::uint32_t e : ending) above_[e] = {};
                const Counts* below = edgeBelow == kNone ? &none_ : &above_[edgeBelow];
                for (const std::uint32_t e : starting) {
                    above_[e] = crossed(*below, e);
                    sides_[e] = {regionOf_(above_[e]), regionOf_(*below)};
                    below = &above_[e];
                }
            });
        return std::move(sides_);
    }

private:
    using Counts = std::vector<ClaimCount>;

    // The claims that enclose the place above an edge.
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
    std::vector<Counts> above_;  // by edge
    std::vector<EdgeSides> sides_;
};

}  // namespace

std::vector<EdgeSides> sweepRegions(const Arrangement& arrangement, const RegionRule& regionOf) {
    return RegionSweep(arrangement, regionOf).run();
}

}  // namespace svt::plane
