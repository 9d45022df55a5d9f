#pragma once
/// \file
/// Merges points that lie within a distance of each other.

#include <svt/plane/welder.hpp>

#include <cmath>

namespace svt::readers::ifc {

/// Numbers points. A point within `distance` (along each axis) of earlier ones gets the number and the position of the
/// first of them.
class Welder {
public:
    explicit Welder(double distance) : distance_(distance) {}

    /// Cost: O(1) unless many points are in one cell.
    std::uint32_t add(Vec3d p) {
        const plane::Cell cell{cellOf(p.x), cellOf(p.y), cellOf(p.z)}, next{1, 1, 1};
        return points_.add(p, cell, cell - next, cell + next, [&](std::uint32_t n) {
            const Vec3d apart = points()[n] - p;
            return std::abs(apart.x) <= distance_ && std::abs(apart.y) <= distance_ && std::abs(apart.z) <= distance_;
        });
    }

    [[nodiscard]] const std::vector<Vec3d>& points() const noexcept { return points_.points(); }

private:
    [[nodiscard]] std::int64_t cellOf(double value) const noexcept {
        const double scaled = std::floor(value / (2 * distance_));
        return std::abs(scaled) < 4e18 ? static_cast<std::int64_t>(scaled) : 0;
    }

    double distance_;
    plane::Welder<Vec3d> points_;
};

}  // namespace svt::readers::ifc
