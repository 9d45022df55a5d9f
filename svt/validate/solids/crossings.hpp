#pragma once
/// \file
/// Where triangles meet: within one shell, and between two bodies.

#include <svt/validate/solids/shell.hpp>

#include <array>
#include <optional>

namespace svt::validate {

using Triangle = std::array<Point, 3>;
using Segment = std::array<Vec3d, 2>;

/// True if two triangles have a point in common beyond the corners that they share by index. Exact.
[[nodiscard]] bool meetBeyondCorners(const Corners& a, const Corners& b, const PointSet& points);

/// True if two triangles that share nothing by index have a point in common. Exact.
[[nodiscard]] bool triangleMeets(const Triangle& a, const Triangle& b) noexcept;

/// True if an edge of one leads through the inside of the other and extends by more than `depth` on both sides. Exact,
/// except for the depth.
[[nodiscard]] bool triangleCrosses(const Triangle& a, const Triangle& b, double depth) noexcept;

/// The segment that the triangle `b` has in common with the plane of `a`, in units; empty for a point, nothing, or
/// triangles of one plane (corners within `noise` of it). `isCoplanar` is true in the last case.
[[nodiscard]] std::optional<Segment> cutByPlane(const Triangle& a, const Triangle& b, double noise, bool& isCoplanar);

/// The part of the segment `s`, in the plane of `t`, that lies within `t` grown by `noise`; empty for none.
[[nodiscard]] std::optional<Segment> clippedTo(const Triangle& t, const Segment& s, double noise);

/// Faces of a closed shell that meet elsewhere than along shared edges and points (306).
void checkIntersections(const Shell& shell, const PointSet& points, std::vector<Defect>& defects);

/// Boxes of triangles.
[[nodiscard]] std::vector<Box3d> boxesOf(std::span<const Corners> triangles, const PointSet& points);

}  // namespace svt::validate
