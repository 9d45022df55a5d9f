#pragma once
/// \file
/// From the edges of pieces to borders between labels, and to closed polygons. Internal to illustrate.

#include <svt/illustrate/section/section_cells.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::illustrate {

/// A line of points between two labels. It ends where a third label begins, or closes.
struct QuantumBorder {
    std::vector<QuantumPoint> points;  ///< a closed one repeats the first at the end
    std::uint32_t left = 0, right = 0;
};

/// A step of a ring: its point, and the border along which it goes on.
struct RingPoint {
    QuantumPoint point;
    std::uint32_t border = 0;
};

/// A polygon of one label: the outer ring counter-clockwise, then its holes clockwise.
struct QuantumPolygon {
    std::uint32_t label = 0;
    std::vector<std::vector<RingPoint>> rings;
};

/// What is left of `edges` when those that lie between equal labels go. Cost: O(n log n).
[[nodiscard]] std::vector<QuantumBorder> joinEdges(std::vector<CellEdge> edges);

/// Drops points that lie within `tolerance` quanta of the line that stands for them, after Douglas and Peucker (1973).
/// Ends of borders stay. Closed borders that have no area left go.
void straighten(std::vector<QuantumBorder>& borders, double tolerance);

/// Polygons of all labels, ordered by label, then by their lowest point.
[[nodiscard]] std::vector<QuantumPolygon> polygonsOf(const std::vector<QuantumBorder>& borders);

/// Twice the signed area of a ring, square quanta.
[[nodiscard]] double twiceAreaOf(const std::vector<RingPoint>& ring) noexcept;

}  // namespace svt::illustrate
