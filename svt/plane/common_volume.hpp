#pragma once
/// \file
/// The volume that two closed meshes have in common, without their intersection.
///
/// A point lies in a mesh if one more of the triangles above it faces up than down. So with s = +1 for triangles that
/// face up, -1 for those that face down, and "below t" for the prism from triangle t down to the ground,
///
///     inside A  =  sum over its triangles t of  s(t) * below(t)
///     inside A and B  =  sum over pairs (t, u) of  s(t) * s(u) * (below(t) and below(u))
///
/// and the prisms of two triangles meet over the convex polygon in which their projections overlap, up to the lower of
/// two planes. Each term changes continuously with the points, so faces that coincide, edges that touch and thin gaps
/// need no special cases. Where a mesh covers itself, the volume counts as often.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::plane {

/// A triangle that is not upright, prepared: local space, metres.
struct RoofTriangle {
    std::array<Vec3d, 3> corners;  ///< counter-clockwise seen from above
    double sign = 1;               ///< -1: the face looks down
    double slopeX = 0, slopeY = 0;
    double minX = 0, maxX = 0, minY = 0, maxY = 0;

    /// Height of its plane, within the heights of its corners.
    [[nodiscard]] double heightAt(double x, double y) const noexcept;
};

/// Prepares a triangle; false if it has no area seen from above.
[[nodiscard]] bool makeRoofTriangle(const std::array<Vec3d, 3>& corners, RoofTriangle& triangle);

/// Number of pairs that commonVolume() compares: triangles whose extents along x overlap. Both in order of minX.
[[nodiscard]] std::uint64_t comparisons(std::span<const RoofTriangle> a, std::span<const RoofTriangle> b);

/// The common volume of two closed meshes, m3. Triangles can be left out if the other mesh has no triangle above or
/// below.
/// \param a, b    in order of minX
/// \param ground  a height below all triangles, close to them to limit rounding
[[nodiscard]] double commonVolume(std::span<const RoofTriangle> a, std::span<const RoofTriangle> b, double ground);

}  // namespace svt::plane
