#pragma once
/// \file
/// A ray in voxel space and its walk through a volume as runs of one scalar. Internal to render.
///
/// Voxel space is index space plus one half: voxel i reaches from i to i + 1. The ray's parameter t is depth: metres
/// along the view direction. When a ray crosses plane n of an axis is always the same expression, planeTime(), never a
/// running sum. It grows with n, so which voxel a ray is in at t is decided by comparing such times alone, and a walk
/// that leaves a whole box at once visits the same runs, to the last bit, as one that goes from voxel to voxel.

#include <svt/core/vec.hpp>
#include <svt/volume/brick_volume.hpp>

#include <algorithm>
#include <cmath>
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

struct IndexRay {
    Vec3d origin, direction;  ///< position(t) = origin + t * direction
    Vec3d inverse;            ///< 1 / direction; +inf along axes the ray does not move on
    Vec3d planeOrigin;        ///< origin; -1 along axes the ray does not move on, so that all planes are at +inf
    Vec3i step;               ///< 1, -1 or 0 per axis
    double slack;             ///< positions are exact to this, voxels

    IndexRay(Vec3d from, Vec3d along) noexcept : origin(from), direction(along), planeOrigin(from) {
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

[[nodiscard]] inline RaySpan spanInVolume(const IndexRay& ray, Vec3i count) noexcept {
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

/// Walks [from, to) of the ray, which must lie in spanInVolume(), and tells `visitor` of each run of one scalar:
///     bool enter(Scalar, double from, Vec3i cell)      at its start; true ends the walk
///     bool leave(Scalar, double from, double to)       at its end; true ends the walk
/// Same-label boxes are crossed in one step, mixed bricks voxel by voxel.
template <class Visitor>
void walkRuns(const volume::BrickVolume& volume, const IndexRay& ray, double from, double to, Visitor& visitor) {
    const Vec3i count = volume.dimension();
    Vec3i cell = ray.cellAt(from, count);
    double t = from, runStart = from;
    volume::Scalar runScalar = 0;
    bool isFirst = true;
    const auto moveTo = [&](volume::Scalar scalar) {
        if (!isFirst && scalar == runScalar) return false;
        if (!isFirst && visitor.leave(runScalar, runStart, t)) return true;
        isFirst = false;
        runScalar = scalar;
        runStart = t;
        return visitor.enter(scalar, t, cell);
    };
    while (true) {
        const volume::BrickVolume::Entry entry = volume.entry(cell.x >> 3, cell.y >> 3, cell.z >> 3);
        if (!entry.isMixed()) {
            const volume::SameLabelBox& box = volume.box(entry);
            if (moveTo(box.scalar)) return;
            Vec3d leave;
            Vec3i plane;
            forEachAxis([&](auto axis) {
                plane[axis] = ray.step[axis] < 0 ? box.min[axis] : box.max[axis];
                leave[axis] = ray.planeTime(axis, plane[axis]);
            });
            t = std::min({leave.x, leave.y, leave.z});
            if (!(t < to)) break;
            forEachAxis([&](auto axis) {
                cell[axis] =
                    leave[axis] == t ? plane[axis] - (ray.step[axis] < 0 ? 1 : 0) : ray.cellAt(axis, t, count[axis]);
            });
            continue;
        }
        const volume::BrickVolume::MixedBrick mixed = volume.mixedBrick(entry);
        const Vec3i brick{cell.x >> 3, cell.y >> 3, cell.z >> 3};
        Vec3d leave{ray.leaveTime(0, cell.x), ray.leaveTime(1, cell.y), ray.leaveTime(2, cell.z)};
        do {
            if (moveTo(mixed.scalarAt(cell.x & 7, cell.y & 7, cell.z & 7))) return;
            t = std::min({leave.x, leave.y, leave.z});
            if (!(t < to)) break;
            forEachAxis([&](auto axis) {
                while (leave[axis] <= t) {
                    cell[axis] += ray.step[axis];
                    leave[axis] = ray.leaveTime(axis, cell[axis]);
                }
            });
        } while ((((cell.x >> 3) ^ brick.x) | ((cell.y >> 3) ^ brick.y) | ((cell.z >> 3) ^ brick.z)) == 0);
        if (!(t < to)) break;
    }
    visitor.leave(runScalar, runStart, to);
}

/// The same, from voxel to voxel and by scalarAt() alone: what walkRuns() is held against.
template <class Visitor>
void walkRunsReference(const volume::BrickVolume& volume, const IndexRay& ray, double from, double to,
                       Visitor& visitor) {
    Vec3i cell = ray.cellAt(from, volume.dimension());
    double t = from, runStart = from;
    volume::Scalar runScalar = volume.scalarAt(cell.x, cell.y, cell.z);
    if (visitor.enter(runScalar, from, cell)) return;
    while (true) {
        t = std::min({ray.leaveTime(0, cell.x), ray.leaveTime(1, cell.y), ray.leaveTime(2, cell.z)});
        if (!(t < to)) break;
        for (int axis = 0; axis < 3; ++axis)
            while (ray.leaveTime(axis, cell[axis]) <= t) cell[axis] += ray.step[axis];
        const volume::Scalar scalar = volume.scalarAt(cell.x, cell.y, cell.z);
        if (scalar == runScalar) continue;
        if (visitor.leave(runScalar, runStart, t)) return;
        runScalar = scalar;
        runStart = t;
        if (visitor.enter(scalar, t, cell)) return;
    }
    visitor.leave(runScalar, runStart, to);
}

}  // namespace svt::render
