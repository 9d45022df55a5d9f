#pragma once
/// \file
/// Gives points that are near each other the same number. Finds points by the cells of a grid.

#include <svt/core/hash.hpp>
#include <svt/plane/point.hpp>

#include <unordered_map>
#include <vector>

namespace svt::plane {

/// A cell of a cubic grid; a plane has z = 0.
using Cell = Vec3<std::int64_t>;

/// An index of the numbers 0, 1, 2, ... by the cells that they are added to.
class CellIndex {
public:
    /// Adds the next number to `cell`.
    void add(const Cell& cell) {
        std::uint32_t& last = last_.try_emplace(keyOf(cell), kNone).first->second;
        before_.push_back(last);
        last = static_cast<std::uint32_t>(before_.size() - 1);
    }

    /// Calls visit(number) for all numbers in the cells from `low` to `high`, both included: cell by cell with z
    /// fastest, in each cell the last number first. Cells that share a hash add a few other numbers, or repeat a
    /// number.
    /// Cost: O(1) per cell and number.
    template <class Visit>
    void forEach(const Cell& low, const Cell& high, const Visit& visit) const {
        for (std::int64_t x = low.x; x <= high.x; ++x)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t z = low.z; z <= high.z; ++z) {
                    const auto found = last_.find(keyOf({x, y, z}));
                    for (std::uint32_t n = found == last_.end() ? kNone : found->second; n != kNone; n = before_[n])
                        visit(n);
                }
    }

private:
    // Different cells may share a key; the distance decides which points are near.
    [[nodiscard]] static std::uint64_t keyOf(const Cell& cell) noexcept {
        const std::uint64_t key = mixHash(mixHash(0, std::uint64_t(cell.x)), std::uint64_t(cell.y));
        return mixHash(key, std::uint64_t(cell.z));
    }

    std::vector<std::uint32_t> before_;                      // per number: the one before in its cell, or kNone
    std::unordered_map<std::uint64_t, std::uint32_t> last_;  // cell -> its last number
};

/// Numbers points. A point near earlier points gets the number of the first of them, so it has the same number each
/// time. The caller decides which points are near.
/// \tparam P  a point of a plane or of space
template <class P>
class Welder {
public:
    /// The number of `p`: that of the first point near it, or else a new one.
    /// \param home       the cell of p
    /// \param low, high  the cells in which a point near p can lie, both included
    /// \param isNear     isNear(number): whether an earlier point is near p
    /// Cost: O(1) for a few cells, unless many points crowd in them.
    template <class IsNear>
    std::uint32_t add(const P& p, const Cell& home, const Cell& low, const Cell& high, const IsNear& isNear) {
        std::uint32_t first = kNone;
        cells_.forEach(low, high, [&](std::uint32_t n) {
            if (n < first && isNear(n)) first = n;
        });
        if (first != kNone) return first;
        points_.push_back(p);
        cells_.add(home);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }

    [[nodiscard]] const std::vector<P>& points() const noexcept { return points_; }

private:
    std::vector<P> points_;
    CellIndex cells_;
};

}  // namespace svt::plane
