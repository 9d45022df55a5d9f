#pragma once
/// \file
/// Finds the segments and faces of a drawing that may lie near a line, with a grid of equal cells over the drawing.

#include <svt/drawing/section_drawing.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// Convex polygons of two points or more, found by the cells that they meet. Items are numbered as they were added;
/// each cell lists its own in that order.
class PlaneIndex {
public:
    /// The items that a thread has already seen on its current line.
    struct Seen {
        std::vector<std::uint32_t> lineOfItem;
        std::uint32_t line = 0;
    };

    /// \param corners      the corners of all items, one item after the other
    /// \param firstCorner  per item, and once more at the end
    /// \param reach        items up to this distance from a line are found, metres
    PlaneIndex(std::span<const PlanePoint> corners, std::span<const std::uint32_t> firstCorner, double reach);

    /// Calls `visit(item)` once for each item that may lie near the line. It returns whether to go on.
    template <class Visit>
    void visitNear(PlanePoint from, PlanePoint to, Seen& seen, const Visit& visit) const {
        const PlanePoint line[2] = {from, to};
        visitNear(line, seen, visit);
    }
    /// The same for a convex polygon of one point or more.
    template <class Visit>
    void visitNear(std::span<const PlanePoint> polygon, Seen& seen, const Visit& visit) const {
        if (cellStart_.empty()) return;
        if (seen.lineOfItem.size() != items_) seen = {std::vector<std::uint32_t>(items_, 0), 0};
        ++seen.line;
        const Rows rows = rowsOf(polygon);
        for (std::int32_t row = rows.first; row <= rows.last; ++row) {
            const Rows columns = columnsOf(polygon, row);
            for (std::int32_t column = columns.first; column <= columns.last; ++column) {
                const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                         static_cast<std::size_t>(column);
                for (std::uint32_t n = cellStart_[cell]; n < cellStart_[cell + 1]; ++n) {
                    const std::uint32_t item = cellItems_[n];
                    if (seen.lineOfItem[item] == seen.line) continue;
                    seen.lineOfItem[item] = seen.line;
                    if (!visit(item)) return;
                }
            }
        }
    }

private:
    struct Rows {
        std::int32_t first = 0, last = -1;
    };
    [[nodiscard]] Rows rowsOf(std::span<const PlanePoint> corners) const noexcept;
    [[nodiscard]] Rows columnsOf(std::span<const PlanePoint> corners, std::int32_t row) const noexcept;

    PlanePoint low_;
    double cell_ = 1, reach_ = 0;
    std::int32_t columns_ = 0, rows_ = 0;
    std::size_t items_ = 0;
    std::vector<std::uint32_t> cellStart_, cellItems_;
};

}  // namespace svt::drawing
