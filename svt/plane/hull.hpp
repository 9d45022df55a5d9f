#pragma once
/// \file
/// Convex hulls of few points.

#include <svt/plane/point.hpp>

#include <cstddef>
#include <vector>

namespace svt::plane {

/// The lower or upper chain of a convex hull, from the first to the last point of a sorted list. Both chains together
/// are the hull. Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979.
/// \param sorted  items with points that ascend or descend by x, then y
/// \param turns   1: all turns of the chain are counter-clockwise (the lower chain of an ascending list, the upper one
///                of a descending list); -1: clockwise, the other chain
/// \param at      the point of an item, Vec3d; z is ignored
/// Cost: O(n).
template <class Items, class At>
[[nodiscard]] Items hullChain(const Items& sorted, double turns, const At& at) {
    Items chain;
    for (const auto& item : sorted) {
        while (chain.size() >= 2 && turns * twiceArea(at(chain[chain.size() - 2]), at(chain.back()), at(item)) <= 0)
            chain.pop_back();
        chain.push_back(item);
    }
    return chain;
}

}  // namespace svt::plane
