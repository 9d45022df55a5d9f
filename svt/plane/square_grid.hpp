#pragma once
/// \file
/// Equal squares over a part of the plane, to find points and segments near a place.

#include <svt/plane/point.hpp>

#include <cmath>
#include <cstddef>

namespace svt::plane {

/// Finds the squares that a segment or a box meets. The caller keeps lists of their content. The functions call
/// body(square) with the number of each square until a call returns false. They return true if no call did.
class SquareGrid {
public:
    /// \param box        the part of the plane, not empty; at most 2^50 from 0
    /// \param wanted     wanted number of squares; some more for a long and narrow part, fewer if a limit below applies
    /// \param mostAlong  maximum number of squares along the longer side
    /// \param least      minimum side of a square
    SquareGrid(const Box& box, double wanted, double mostAlong, double least) noexcept : low_(box.low) {
        const double width = double(box.high.u) - double(box.low.u) + 1;
        const double height = double(box.high.v) - double(box.low.v) + 1;
        side_ = std::max({std::sqrt(width * height / wanted), std::max(width, height) / mostAlong, least});
        columns_ = static_cast<std::int64_t>(width / side_) + 1;
        rows_ = static_cast<std::int64_t>(height / side_) + 1;
    }

    [[nodiscard]] std::size_t count() const noexcept { return static_cast<std::size_t>(columns_ * rows_); }
    [[nodiscard]] double side() const noexcept { return side_; }
    [[nodiscard]] std::size_t squareOf(Point p) const noexcept { return at(columnOf(double(p.u)), rowOf(double(p.v))); }

    /// Visits each square within `reach` of the segment a-b, and some squares further away; each once.
    /// \param reach  at least 1, which exceeds the rounding error
    template <class Body>
    [[nodiscard]] bool forSegment(Point a, Point b, double reach, const Body& body) const {
        const auto [left, right] = std::minmax(a, b);
        const double leftU = double(left.u), leftV = double(left.v), rightU = double(right.u), rightV = double(right.v);
        const std::int64_t first = columnOf(leftU - reach), last = columnOf(rightU + reach);
        const double du = rightU - leftU, dv = rightV - leftV;
        for (std::int64_t column = first; column <= last; ++column) {
            double from = leftV, to = rightV;
            if (du > 0) {
                const double begin = double(low_.u) + double(column) * side_ - reach, end = begin + side_ + 2 * reach;
                from = leftV + dv * std::clamp((begin - leftU) / du, 0.0, 1.0);
                to = leftV + dv * std::clamp((end - leftU) / du, 0.0, 1.0);
            }
            const std::int64_t bottom = rowOf(std::min(from, to) - reach - 1),
                               top = rowOf(std::max(from, to) + reach + 1);
            for (std::int64_t row = bottom; row <= top; ++row)
                if (!body(at(column, row))) return false;
        }
        return true;
    }

    /// Visits each square that meets the box.
    template <class Body>
    [[nodiscard]] bool forBox(const Box& box, const Body& body) const {
        for (std::int64_t row = rowOf(double(box.low.v)), top = rowOf(double(box.high.v)); row <= top; ++row)
            for (std::int64_t column = columnOf(double(box.low.u)); column <= columnOf(double(box.high.u)); ++column)
                if (!body(at(column, row))) return false;
        return true;
    }
    /// Number of squares that meet the box.
    [[nodiscard]] double countIn(const Box& box) const noexcept {
        return double(columnOf(double(box.high.u)) - columnOf(double(box.low.u)) + 1) *
               double(rowOf(double(box.high.v)) - rowOf(double(box.low.v)) + 1);
    }

    /// Visits each square that lies `ring` squares away from the square of `p`. Ignores the result of body(square).
    /// \return false if all squares are nearer to `p`
    template <class Body>
    [[nodiscard]] bool forRing(Point p, std::int64_t ring, const Body& body) const {
        const std::int64_t u = columnOf(double(p.u)), v = rowOf(double(p.v));
        if (u - ring < 0 && v - ring < 0 && u + ring >= columns_ && v + ring >= rows_) return false;
        for (std::int64_t row = std::max<std::int64_t>(v - ring, 0); row <= std::min(v + ring, rows_ - 1); ++row) {
            const bool isWhole = row == v - ring || row == v + ring;
            for (std::int64_t column = u - ring; column <= u + ring; column += isWhole || ring == 0 ? 1 : 2 * ring)
                if (column >= 0 && column < columns_) body(at(column, row));
        }
        return true;
    }

private:
    [[nodiscard]] std::size_t at(std::int64_t column, std::int64_t row) const noexcept {
        return static_cast<std::size_t>(column + columns_ * row);
    }
    [[nodiscard]] std::int64_t columnOf(double u) const noexcept {
        const double column = std::floor((u - double(low_.u)) / side_);
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(column), 0, columns_ - 1);
    }
    [[nodiscard]] std::int64_t rowOf(double v) const noexcept {
        const double row = std::floor((v - double(low_.v)) / side_);
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(row), 0, rows_ - 1);
    }

    Point low_;
    double side_ = 1;
    std::int64_t columns_ = 1, rows_ = 1;
};

}  // namespace svt::plane
