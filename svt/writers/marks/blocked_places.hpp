#pragma once
/// \file
/// Where rectangles of one size contain an obstacle: one bit for each place, so that a search of many places asks few of
/// them about their obstacles.

#include <svt/writers/marks/free_space.hpp>

#include <cstdint>
#include <utility>

namespace svt::writers {

/// Squares of 1 mm that borders, lines or texts meet make a rectangle around them unfit. This is the union of the marked
/// squares within the least number of columns and rows that a rectangle of the size contains wherever it stands.
///
/// It knows the space as it was when it was made.
class BlockedPlaces {
public:
    /// Cost: O(area of `reach` in mm2 / 64 * log(size)).
    /// \param reach      the part of the drawing in which the rectangles stand, millimetres
    /// \param size       of the rectangles, millimetres
    /// \param withLines  whether visible lines are obstacles
    BlockedPlaces(const FreeSpace& space, const MarkBox& reach, std::pair<double, double> size, bool withLines);

    /// Whether a rectangle of the size contains a marked square. If not, it may meet an obstacle nevertheless. A rectangle
    /// outside of the reach gives false. Cost: O(1).
    [[nodiscard]] bool isBlocked(const MarkBox& box) const noexcept;

private:
    [[nodiscard]] bool isMarked(std::int64_t column, std::int64_t row) const noexcept {
        return (marks_.rows[static_cast<std::size_t>(row) * marks_.words + static_cast<std::size_t>(column >> 6)] >>
                (column & 63)) &
               1;
    }
    void widen(std::int64_t columns);
    void heighten(std::int64_t rows);

    MarkRaster marks_;  // after construction: of the rectangle whose lower left square this is
    std::int64_t columns_ = 0, rows_ = 0;
};

}  // namespace svt::writers
