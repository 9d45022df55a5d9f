#pragma once
/// \file
/// A ray in voxel space, and the times at which it crosses the planes between voxels.
///
/// Voxel space is index space plus one half: voxel i is [i, i + 1]. The ray's parameter t is depth: metres along the
/// view direction. The time at which a ray crosses plane n of an axis is always computed by the same expression,
/// planeTime(), never by a running sum. It is monotonic in n, so the comparison of such times decides which voxel the
/// ray is in. A walk that skips a whole box thus visits the same voxels, to the last bit, as one that steps from voxel
/// to voxel (Amanatides and Woo 1987, without their accumulated sums).

#include <svt/core/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace svt::render {

/// Calls body(0), body(1), body(2) with the axis as a compile-time constant, so that selecting a component is free.
template <class Body>
constexpr void forEachAxis(const Body& body) {
    body(std::integral_constant<int, 0>{});
    body(std::integral_constant<int, 1>{});
    body(std::integral_constant<int, 2>{});
}

struct VoxelRay {
    Vec3d origin, direction;  ///< position(t) = origin + t * direction
    Vec3d inverse;            ///< 1 / direction; +inf on axes with zero direction
    Vec3d planeOrigin;        ///< origin; -1 on axes with zero direction, so that all crossing times are +inf
    Vec3i step;               ///< sign of the direction: 1, -1 or 0 per axis
    double slack;             ///< error bound of positions, voxels

    VoxelRay(Vec3d from, Vec3d along) noexcept : origin(from), direction(along), planeOrigin(from) {
        const double largest = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
        // Far above the rounding error of origin + t * direction, whose terms are bounded by the distance of the origin
        // and the size of the volume.
        slack = 1e-13 * (std::abs(from.x) + std::abs(from.y) + std::abs(from.z) + 65536);
        forEachAxis([&](auto axis) {
            // A component this small is rounding noise.
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

    /// Time at which the ray crosses plane `plane` (0..n) of an axis.
    [[nodiscard]] double planeTime(int axis, std::int32_t plane) const noexcept {
        return (plane - planeOrigin[axis]) * inverse[axis];
    }
    /// Time at which the ray leaves `voxel` along an axis.
    [[nodiscard]] double leaveTime(int axis, std::int32_t voxel) const noexcept {
        return planeTime(axis, step[axis] < 0 ? voxel : voxel + 1);
    }
    /// Time at which the ray entered `voxel` along an axis; only for axes with non-zero direction.
    [[nodiscard]] double enterTime(int axis, std::int32_t voxel) const noexcept {
        return planeTime(axis, step[axis] < 0 ? voxel + 1 : voxel);
    }
    /// The voxel that the ray is in from t on, along an axis of `count` voxels.
    [[nodiscard]] std::int32_t voxelAt(int axis, double t, std::int32_t count) const noexcept {
        const double position = origin[axis] + t * direction[axis];
        const double guess = position > 0 ? std::min(position, static_cast<double>(count - 1)) : 0;  // 0 also for NaN
        auto voxel = static_cast<std::int32_t>(guess);
        // Only next to a plane can the rounded position and planeTime() disagree.
        const double inVoxel = guess - voxel;
        if (inVoxel > slack && inVoxel < 1 - slack) return voxel;
        if (step[axis] > 0) {
            while (voxel + 1 < count && planeTime(axis, voxel + 1) <= t) ++voxel;
            while (voxel > 0 && planeTime(axis, voxel) > t) --voxel;
        } else if (step[axis] < 0) {
            while (voxel > 0 && planeTime(axis, voxel) <= t) --voxel;
            while (voxel + 1 < count && planeTime(axis, voxel + 1) > t) ++voxel;
        }
        return voxel;
    }
    [[nodiscard]] Vec3i voxelAt(double t, Vec3i count) const noexcept {
        return {voxelAt(0, t, count.x), voxelAt(1, t, count.y), voxelAt(2, t, count.z)};
    }
    /// The first axis whose plane the ray crosses at t when it enters `voxel`; -1 if it crosses none at t.
    [[nodiscard]] int entryAxis(double t, Vec3i voxel) const noexcept {
        for (int axis = 0; axis < 3; ++axis)
            if (step[axis] != 0 && enterTime(axis, voxel[axis]) == t) return axis;
        return -1;
    }
};

/// An interval of a ray; empty if from >= to. spanInVolume() gives the part inside the volume, in front of the eye.
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
