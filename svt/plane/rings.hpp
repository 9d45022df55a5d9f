#pragma once
/// \file
/// Closed rings of points, in the plane or in space.

#include <svt/plane/point.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace svt::plane {

/// Newell's normal of a ring: twice its area vector; robust for non-planar rings. Relative to the first point, to avoid
/// cancellation with large world coordinates.
[[nodiscard]] inline Vec3d newellNormal(std::span<const Vec3d> ring) noexcept {
    Vec3d normal{};
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) normal = normal + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    return normal;
}

/// Splits a closed walk at repeated points into rings that touch there, and calls take(ring) for each ring.
/// \param pointOf  returns the point of a step of the walk, of any type with an order
/// \param take     receives each ring as a std::vector<Step>; an empty vector for an empty walk
/// Cost: O(n log n).
template <class Step, class PointOf, class Take>
void splitAtRepeats(const std::vector<Step>& walk, const PointOf& pointOf, const Take& take) {
    std::map<decltype(pointOf(std::declval<Step>())), std::size_t> placeOf;
    std::vector<Step> open;
    for (const Step& step : walk) {
        if (const auto known = placeOf.find(pointOf(step)); known != placeOf.end()) {
            const std::size_t at = known->second;
            take(std::vector<Step>(open.begin() + static_cast<std::ptrdiff_t>(at), open.end()));
            for (std::size_t n = at; n < open.size(); ++n) placeOf.erase(pointOf(open[n]));
            open.resize(at);
        }
        placeOf.emplace(pointOf(step), open.size());
        open.push_back(step);
    }
    take(std::move(open));
}

}  // namespace svt::plane
