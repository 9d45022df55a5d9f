#pragma once
/// \file
/// A ray in voxel space, and when it crosses the planes between voxels.
///
/// Voxel space is index space plus one half: voxel i reaches from i to i + 1. The ray's parameter t is depth: metres
/// along the view direction. When a ray crosses plane n of an axis is always the same expression, planeTime(), never a
/// running sum. It grows with n, so which voxel a ray is in at t is decided by comparing such times alone, and a walk
/// that leaves a whole box at once visits the same voxels, to the last bit, as one that steps from voxel to voxel
/// (Amanatides and Woo 1987, without their accumulated sums).

#include <svt/core/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace svt::render {

/// Calls body(0), body(1), body(2) with the axis as a constant: selecting a component must cost nothing here.
template <class Body>
constexpr void forEachAxis(const Body& body) {
    body(std::integral_constant<int, 0>{});
    body(std::integral_constant<int, 1>{});
    body(std::integral_constant<int, 2>{});
}

struct VoxelRay {
    Vec3d origin, direction;  ///< position(t) = origin + t * direction
    Vec3d inverse;            ///< 1 / direction; +inf along axes the ray does not move on
    Vec3d planeOrigin;        ///< origin; -1 along axes the ray does not move on, so that all planes are at +inf
    Vec3i step;               ///< 1, -1 or 0 per axis
    double slack;             ///< positions are exact to this, voxels

    VoxelRay(Vec3d from, Vec3d along) noexcept : origin(from), direction(along), planeOrigin(from) {
        const double largest = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
        // Far above the rounding of origin + t * direction, whose terms are at most the origin's distance and the
        // volume.
        slack = 1e-13 * (std::abs(from.x) + std::abs(from.y) + std::abs(from.z) + 65536);
        forEachAxis([&](auto axis) {
            // Rounding leaves a trace of a direction on axes that it does not have.
            if (std::abs(along[axis]) > largest * 1e-12) {
                inverse[axis] = 1 / along[axis];
                step[axis] = along[axis] > 0 ? 1 : -1;
            } else {
                direction[axis] = 0;
                inverse[axis] = std::numeric_limits<double>::infinity();
                planeOrigin[axis] = -1;
                step[axis] = 0;
            }
        });
    }

    /// When the ray crosses plane `plane` (0..n) of an axis.
    [[nodiscard]] double planeTime(int axis, std::int32_t plane) const noexcept {
        return (plane - planeOrigin[axis]) * inverse[axis];
    }
    /// When the ray leaves voxel `cell` along an axis.
    [[nodiscard]] double leaveTime(int axis, std::int32_t cell) const noexcept {
        return planeTime(axis, step[axis] < 0 ? cell : cell + 1);
    }
    /// When the ray entered voxel `cell` along an axis; only where it moves on that axis.
    [[nodiscard]] double enterTime(int axis, std::int32_t cell) const noexcept {
        return planeTime(axis, step[axis] < 0 ? cell + 1 : cell);
    }
    /// The voxel that holds the ray from t on, along an axis of `count` voxels.
    [[nodiscard]] std::int32_t cellAt(int axis, double t, std::int32_t count) const noexcept {
        const double position = origin[axis] + t * direction[axis];
        const double guess = position > 0 ? std::min(position, static_cast<double>(count - 1)) : 0;  // 0 also for NaN
        auto cell = static_cast<std::int32_t>(guess);
        // Only beside a plane can rounding and planeTime() disagree.
        const double inCell = guess - cell;
        if (inCell > slack && inCell < 1 - slack) return cell;
        if (step[axis] > 0) {
            while (cell + 1 < count && planeTime(axis, cell + 1) <= t) ++cell;
            while (cell > 0 && planeTime(axis, cell) > t) --cell;
        } else if (step[axis] < 0) {
            while (cell > 0 && planeTime(axis, cell) <= t) --cell;
            while (cell + 1 < count && planeTime(axis, cell + 1) > t) ++cell;
        }
        return cell;
    }
    [[nodiscard]] Vec3i cellAt(double t, Vec3i count) const noexcept {
        return {cellAt(0, t, count.x), cellAt(1, t, count.y), cellAt(2, t, count.z)};
    }
    /// The axis whose plane the ray crosses at t to get into `cell`: the first of those; -1 if it crosses none there.
    [[nodiscard]] int entryAxis(double t, Vec3i cell) const noexcept {
        for (int axis = 0; axis < 3; ++axis)
            if (step[axis] != 0 && enterTime(axis, cell[axis]) == t) return axis;
        return -1;
    }
};

/// Part of a ray inside the volume's voxels, from the eye on; empty where from >= to.
struct RaySpan {
    double from = 0, to = 0;
};

[[nodiscard]] inline RaySpan spanInVolume(const VoxelRay& ray, Vec3i count) noexcept {
    RaySpan span{0, std::numeric_limits<double>::infinity()};
    forEachAxis([&](auto axis) {
        if (ray.step[axis] == 0) {
            if (!(ray.origin[axis] >= 0 && ray.origin[axis] < count[axis])) span.to = 0;
            return;
        }
        const double low = ray.planeTime(axis, 0), high = ray.planeTime(axis, count[axis]);
        span.from = std::max(span.from, std::min(low, high));
        span.to = std::min(span.to, std::max(low, high));
    });
    return span;
}

}  // namespace svt::render
