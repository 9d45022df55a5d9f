#pragma once
/// \file
/// Which claims enclose the two sides of each edge of an arrangement, by one sweep over the plane.

#include <svt/plane/arrangement.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace svt::plane {

/// How often a claim encloses a place.
struct ClaimCount {
    std::uint32_t claim = 0;
    std::int32_t winding = 0;  ///< never 0
};

/// What a region is: any number, by the claims that enclose it (ascending; those inside out have negative counts).
using RegionRule = std::function<std::uint32_t(std::span<const ClaimCount>)>;

/// The regions on the two sides of an edge, looking from `from` to `to`.
struct EdgeSides {
    std::uint32_t left = 0, right = 0;
};

/// Sweeps over the edges from the lowest u to the highest; the set of claims above an edge is that below it and what the
/// edge changes (Shamos and Hoey 1976, with edges that meet in end points only).
/// \param regionOf  is asked once for each edge and side
/// \return per edge its sides
/// Cost: O(n log n), and the claims that enclose each edge.
[[nodiscard]] std::vector<EdgeSides> sweepRegions(const Arrangement& arrangement, const RegionRule& regionOf);

}  // namespace svt::plane
