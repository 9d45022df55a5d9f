#pragma once
/// \file
/// Finds the claims that enclose the two sides of each edge of an arrangement, in one sweep over the plane.

#include <svt/plane/arrangement.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace svt::plane {

/// The number of times that a claim encloses a place.
struct ClaimCount {
    std::uint32_t claim = 0;
    std::int32_t winding = 0;  ///< never 0
};

/// Assigns a region (any number) to the claims that enclose it. The claims are ascending; inverted claims have negative
/// counts.
using RegionRule = std::function<std::uint32_t(std::span<const ClaimCount>)>;

/// The regions on the two sides of an edge, looking from `from` to `to`.
struct EdgeSides {
    std::uint32_t left = 0, right = 0;
};

/// Sweeps over the edges from the lowest u to the highest. The claims above an edge are the claims below it plus the
/// changes at the edge (Shamos and Hoey 1976, for edges that meet only in end points).
/// \param regionOf  called once per edge and side
/// \return the sides of each edge
/// Cost: O(n log n), plus the claims that enclose each edge.
[[nodiscard]] std::vector<EdgeSides> sweepRegions(const Arrangement& arrangement, const RegionRule& regionOf);

}  // namespace svt::plane
