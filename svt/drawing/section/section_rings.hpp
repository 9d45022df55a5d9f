#pragma once
/// \file
/// Joins the edges of pieces to borders between labels, and these to closed polygons.
///
///     pieces and their edges       borders, nodes (o)           rings, by label
///
///     +---+---+---+                +-------o---+                +-------+   +---+
///     | A | A | B |                |       | B |                |       |   | B |
///     +---+---+---+                |   A   o---o                |   A   |   +---+
///     | A | A | C |                |       | C |                |       |   | C |
///     +---+---+---+                +-------o---+                +-------+   +---+
///
/// - Each piece gives its edges counter-clockwise, so an edge between two pieces is present once in each direction. If
///   both pieces have the same label, the two edges cancel (ours).
/// - The rest is joined to borders: polylines with one label on the left and one on the right, from node to node, or
///   closed. A node is a point that more than one border touches.
/// - A border is simplified once, with its nodes fixed (Douglas and Peucker 1973), so both neighbours keep sharing it
///   point by point: no gaps, no overlaps.
/// - A ring follows the borders of its label. At a node it takes the first one clockwise from the one that it came by,
///   which keeps the inside connected; a walk that meets itself is split into rings that touch there.
/// - A hole belongs to the smallest outer ring around it, by counting crossings exactly, in integers.

#include <svt/drawing/section/section_pieces.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::drawing {

/// A polyline between two labels, from node to node, or closed.
struct DrawingBorder {
    std::vector<plane::Point> points;  ///< a closed one repeats the first at the end
    std::uint32_t left = 0, right = 0;
};

/// A point of a ring, and the border that leads to the next point.
struct RingPoint {
    plane::Point point;
    std::uint32_t border = 0;
};

/// A polygon of one label: the outer ring counter-clockwise, then its holes clockwise.
struct DrawingPolygon {
    std::uint32_t label = 0;
    std::vector<std::vector<RingPoint>> rings;
};

/// Cancels edges between equal labels, and joins the rest to borders. Cost: O(n log n).
[[nodiscard]] std::vector<DrawingBorder> joinEdges(std::vector<PieceEdge> edges);

/// Simplifies borders (Douglas and Peucker 1973): drops points within `tolerance` drawing units of the segment that
/// replaces them. Ends of borders are kept. Closed borders without area are removed.
void straighten(std::vector<DrawingBorder>& borders, double tolerance);

/// Polygons of all labels, ordered by label, then by the smallest point of the outer ring.
[[nodiscard]] std::vector<DrawingPolygon> makePolygons(const std::vector<DrawingBorder>& borders);

/// Twice the signed area of a ring, square drawing units.
[[nodiscard]] double twiceSignedArea(const std::vector<RingPoint>& ring) noexcept;

}  // namespace svt::drawing
