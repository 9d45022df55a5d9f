#pragma once
/// \file
/// Convex hulls of few points.

#include <svt/plane/point.hpp>

#include <cstddef>
#include <vector>

namespace svt::plane {

/// The chain of the convex hull from the first to the last point of a sorted list (Andrew 1979, "Another efficient algorithm
/// for convex hulls in two dimensions"). The lower and the upper chain are the whole hull; either is also the other one of
/// the list in descending order.
/// \param sorted  items with points that ascend or descend by x, then y
/// \param turns   1: all turns of the chain are counter-clockwise; -1: clockwise
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
