#pragma once
/// \file
/// One index for all points that are closer to each other than a tolerance: the first of them stands for the others.

#include <svt/plane/welder.hpp>
#include <svt/validate/exact/lattice.hpp>

namespace svt::validate {

class Snapper {
public:
    /// \param tolerance  in units; points less than this apart are one; 0: equal points only
    explicit Snapper(double tolerance) noexcept
        : tolerance_(tolerance),
          reach_(static_cast<std::int64_t>(std::ceil(tolerance))),
          cell_(std::max<std::int64_t>(2 * reach_, 1)) {}

    /// The index of `point`: of the first added point that is near enough, else a new one.
    /// Cost: O(1) unless many points crowd within the tolerance.
    std::uint32_t add(const Point& point);
    [[nodiscard]] const std::vector<Point>& points() const noexcept { return welder_.points(); }

private:
    double tolerance_;
    std::int64_t reach_, cell_;
    plane::Welder<Point> welder_;
};

}  // namespace svt::validate
