#pragma once
/// \file
/// Triangulates polygons with holes. Uses the GLU tessellator with the odd winding rule, so that a hole with the wrong
/// orientation is still a hole, and a ring that crosses itself still gets an area.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::mesh {

/// Result of triangulatePolygon. Corners are indices of the input points; indices from points.size() on refer to
/// `extraPoints`, which exist only where rings cross.
struct Triangulation {
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< same orientation as the exterior ring
    std::vector<Vec3d> extraPoints;
    double planeDeviation = 0;    ///< largest distance of a point from the polygon's mean plane, metres
    bool isZeroArea = false;      ///< all points are collinear; a triangle is kept for its edges, others are dropped
    bool isSelfTouching = false;  ///< rings touch or cross themselves or each other
    bool hasFailed = false;       ///< the tessellator gave up
};

/// Newell's normal of a ring: twice its area vector; robust for non-planar rings.
[[nodiscard]] Vec3d newellNormal(std::span<const Vec3d> ring) noexcept;

/// Triangulates one polygon. `ringEnds` as in model::Polygon: the first ring is the exterior one.
/// Rings of fewer than three points are ignored. All points are used as corners, also those on a straight edge, so that
/// neighbours that share an edge share its points.
/// Cost: O(n log n); three points and convex quads take a shortcut.
/// Threads: no shared state.
[[nodiscard]] Triangulation triangulatePolygon(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds);

}  // namespace svt::mesh
