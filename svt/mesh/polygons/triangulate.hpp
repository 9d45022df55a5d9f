#pragma once
/// \file
/// Triangulates polygons with holes by the even-odd rule, so that a hole with the wrong orientation is still a hole,
/// and a ring that crosses itself still gets an area. The GLU tessellator triangulates polygons of typical buildings.
/// Its cost is quadratic in the points, so SVT's own sweep triangulates polygons of many points.

#include <svt/plane/rings.hpp>

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
    double planeDeviation = 0;     ///< largest distance of a point from the polygon's mean plane, metres
    bool isZeroArea = false;       ///< all points are collinear; a triangle is kept for its edges, others are dropped
    bool isSelfTouching = false;   ///< rings touch or cross themselves or each other
    bool hasFailed = false;        ///< the tessellator gave up
    bool crossesTooOften = false;  ///< it gave up because the rings cross in more than maxCrossings() places
};

/// Polygons of more points, of all rings, are triangulated by the sweep.
inline constexpr std::size_t kMaxGluPoints = 400;

/// Number of places where the rings of a polygon may cross; unlimited for up to kMaxUncountedPoints points.
inline constexpr std::size_t kMaxUncountedPoints = 64;
[[nodiscard]] constexpr std::size_t maxCrossings(std::size_t pointCount) noexcept { return 2 * pointCount; }

enum class TriangulateBy : std::uint8_t {
    PointCount,  ///< GLU up to kMaxGluPoints points, else the sweep
    Glu,         ///< for tests that compare the two
    Sweep
};

using plane::newellNormal;

/// Triangulates one polygon. `ringEnds` as in model::Polygon: the first ring is the exterior one.
/// Rings of fewer than three points are ignored. All points are used as corners, also those on a straight edge, so that
/// neighbours that share an edge share its points.
/// Cost: O(n log n), 1 s for a million points; three points and convex quads take a shortcut.
/// Threads: no shared state.
[[nodiscard]] Triangulation triangulatePolygon(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds,
                                               TriangulateBy by = TriangulateBy::PointCount);

}  // namespace svt::mesh
