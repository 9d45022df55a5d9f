#pragma once
/// \file
/// Areas of the regions of rings, for tests.

#include <svt/plane/regions.hpp>

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace svt::plane {

inline constexpr std::uint32_t kNothing = 0xFFFFFFFFu;

using TestRing = std::vector<Point>;

inline void addRing(const TestRing& ring, std::uint32_t claim, std::vector<ClaimSegment>& segments) {
    for (std::size_t n = 0; n < ring.size(); ++n) segments.push_back({ring[n], ring[(n + 1) % ring.size()], claim, 1});
}

inline std::uint32_t lowestClaim(std::span<const ClaimCount> counts) {
    for (const ClaimCount& count : counts)
        if (count.winding > 0) return count.claim;
    return kNothing;
}

/// Area of each region, by its claim.
inline std::map<std::uint32_t, double> areasOf(const std::vector<ClaimSegment>& segments, std::int32_t tolerance) {
    const auto arranged = arrangeSegments(segments, tolerance);
    EXPECT_TRUE(arranged);
    std::map<std::uint32_t, double> areas;
    if (!arranged) return areas;
    const auto sides = sweepRegions(*arranged, lowestClaim);
    for (std::size_t e = 0; e < sides.size(); ++e) {
        const ArrangementEdge& edge = arranged->edges[e];
        const double area = 0.5 * (double(edge.from.u) * double(edge.to.v) - double(edge.from.v) * double(edge.to.u));
        areas[sides[e].left] += area;
        areas[sides[e].right] -= area;
    }
    areas.erase(kNothing);
    return areas;
}

}  // namespace svt::plane
