#pragma once
/// \file
/// One index for all points that are closer to each other than a tolerance: the first of them stands for the others.

#include <svt/validate/exact/lattice.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

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
    [[nodiscard]] const std::vector<Point>& points() const noexcept { return points_; }

private:
    struct CellHash {
        std::size_t operator()(const Point& p) const noexcept;
    };

    double tolerance_;
    std::int64_t reach_, cell_;
    std::vector<Point> points_;
    std::vector<std::uint32_t> next_;                        // of the same cell, kNone at the end
    std::unordered_map<Point, std::uint32_t, CellHash> at_;  // cell -> its last point
};

}  // namespace svt::validate
