#pragma once
/// \file
/// Points and lines of a polygon by place: cells of a square grid, about one for every two corners.

#include <svt/validate/exact/lattice.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::validate {

/// Numbers of points and of lines, filed under the cells that they lie in. What was added stays.
class FlatGrid {
public:
    /// A range of cells, both ends included.
    struct Cells {
        std::int64_t lowU, highU, lowV, highV;
        [[nodiscard]] double count() const noexcept { return double(highU - lowU + 1) * double(highV - lowV + 1); }
    };

    FlatGrid(Point2 low, Point2 high, std::size_t corners) : low_(low) {
        const double width = double(high.u - low.u) + 1, height = double(high.v - low.v) + 1;
        const double wanted = std::max(1.0, double(corners) / 2);
        size_ = std::max({std::sqrt(width * height / wanted), width / 4096, height / 4096, 1.0});
        countU_ = std::int64_t(width / size_) + 1;
        countV_ = std::int64_t(height / size_) + 1;
        points_.resize(std::size_t(countU_ * countV_));
        lines_.resize(points_.size());
    }

    void addPoint(Point2 at, std::size_t number) { points_[indexOf(cellU(at.u), cellV(at.v))].push_back(number); }

    /// Files the line under all cells that it can pass through, and some beside them.
    void addLine(Point2 a, Point2 b, std::size_t number) {
        (void)forCellsAlong(a, b, [&](std::size_t cell) {
            if (lines_[cell].empty() || lines_[cell].back() != number) lines_[cell].push_back(number);
            return true;
        });
    }

    [[nodiscard]] Cells cellsOf(Point2 low, Point2 high) const noexcept {
        return {cellU(low.u), cellU(high.u), cellV(low.v), cellV(high.v)};
    }

    /// Calls body(number) for the points in cells; ends with false where it returns false.
    template <class Body>
    [[nodiscard]] bool forPoints(const Cells& cells, const Body& body) const {
        for (std::int64_t v = cells.lowV; v <= cells.highV; ++v)
            for (std::int64_t u = cells.lowU; u <= cells.highU; ++u)
                for (const std::size_t number : points_[indexOf(u, v)])
                    if (!body(number)) return false;
        return true;
    }

    /// Calls body(number) for the points in the cells that are `ring` cells away from that of `at`. \return false if there
    /// are no such cells any more
    template <class Body>
    [[nodiscard]] bool forPointsInRing(Point2 at, std::int64_t ring, const Body& body) const {
        const std::int64_t u = cellU(at.u), v = cellV(at.v);
        if (u - ring < 0 && v - ring < 0 && u + ring >= countU_ && v + ring >= countV_) return false;
        for (std::int64_t y = std::max<std::int64_t>(v - ring, 0); y <= std::min(v + ring, countV_ - 1); ++y) {
            const bool isSide = y == v - ring || y == v + ring;
            for (std::int64_t x = u - ring; x <= u + ring; x += isSide || ring == 0 ? 1 : 2 * ring)
                if (x >= 0 && x < countU_)
                    for (const std::size_t number : points_[indexOf(x, y)]) body(number);
        }
        return true;
    }

    /// All points that are no farther away lie within this many cells around.
    [[nodiscard]] double reachOf(std::int64_t ring) const noexcept { return double(ring) * size_; }

    /// Calls body(number) for lines that may meet a-b, some of them repeatedly; ends with false where it returns false.
    template <class Body>
    [[nodiscard]] bool forLines(Point2 a, Point2 b, const Body& body) const {
        return forCellsAlong(a, b, [&](std::size_t cell) {
            for (const std::size_t number : lines_[cell])
                if (!body(number)) return false;
            return true;
        });
    }

private:
    [[nodiscard]] std::int64_t cellU(std::int64_t u) const noexcept {
        return std::clamp<std::int64_t>(std::int64_t(double(u - low_.u) / size_), 0, countU_ - 1);
    }
    [[nodiscard]] std::int64_t cellV(std::int64_t v) const noexcept {
        return std::clamp<std::int64_t>(std::int64_t(double(v - low_.v) / size_), 0, countV_ - 1);
    }
    [[nodiscard]] std::size_t indexOf(std::int64_t u, std::int64_t v) const noexcept {
        return std::size_t(u + v * countU_);
    }

    // Row by row the cells between which the line enters and leaves it, with one more at each end for rounding.
    template <class Body>
    [[nodiscard]] bool forCellsAlong(Point2 a, Point2 b, const Body& body) const {
        if (a.v > b.v) std::swap(a, b);
        const std::int64_t first = cellV(a.v), last = cellV(b.v);
        const double slope = a.v == b.v ? 0 : double(b.u - a.u) / double(b.v - a.v);
        for (std::int64_t row = first; row <= last; ++row) {
            const double from = row == first ? double(a.u) : double(a.u) + slope * (rowStart(row) - double(a.v));
            const double to = row == last ? double(b.u) : double(a.u) + slope * (rowStart(row + 1) - double(a.v));
            const std::int64_t one = columnOf(from), other = columnOf(to);
            const std::int64_t low = std::max<std::int64_t>(std::min(one, other) - 1, 0);
            const std::int64_t high = std::min(std::max(one, other) + 1, countU_ - 1);
            for (std::int64_t u = low; u <= high; ++u)
                if (!body(indexOf(u, row))) return false;
        }
        return true;
    }
    [[nodiscard]] double rowStart(std::int64_t row) const noexcept { return double(low_.v) + double(row) * size_; }
    [[nodiscard]] std::int64_t columnOf(double u) const noexcept {
        return std::clamp<std::int64_t>(std::int64_t((u - double(low_.u)) / size_), 0, countU_ - 1);
    }

    Point2 low_;
    double size_ = 1;
    std::int64_t countU_ = 1, countV_ = 1;
    std::vector<std::vector<std::size_t>> points_, lines_;
};

}  // namespace svt::validate
