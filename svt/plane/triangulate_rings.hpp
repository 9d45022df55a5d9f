#pragma once
/// \file
/// Triangles of a polygon whose rings do not cross. All points of the rings become corners, also those in the middle of
/// a straight line, so that two faces that share an edge share the edges of their triangles.

#include <svt/plane/point.hpp>

#include <vector>

namespace svt::plane {

/// Corners of a triangle: indices of points.
using Corners = std::array<std::uint32_t, 3>;

/// A corner of a ring: its place and its index. Equal places have equal indices.
struct RingCorner {
    Point at;
    std::uint32_t index = 0;
};

/// Cuts ears (Meisters 1975; holes joined to the exterior by bridges as in Eberly, "Triangulation by ear clipping"),
/// then flips edges until no sum of opposite angles in space exceeds 180 degrees (Lawson 1977), which avoids slivers.
///
/// \param rings   the exterior counter-clockwise, then holes clockwise; rings may touch at shared corners, not cross
/// \param points  in space, by index
/// \return corners by index, counter-clockwise
/// Cost: O(n^2) in the worst case; near O(n) for convex polygons, and for many small holes.
[[nodiscard]] std::vector<Corners> triangulateRings(const std::vector<std::vector<RingCorner>>& rings,
                                                    const std::vector<Vec3d>& points);

}  // namespace svt::plane
