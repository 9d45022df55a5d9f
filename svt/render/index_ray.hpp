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
#include <array>
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

/// When a ray crosses an oblique plane, and which side it is on when.
struct PlaneCrossing {
    double time = std::numeric_limits<double>::infinity();
    bool isRising = false;  ///< on the positive side from `time` on, else until then

    PlaneCrossing(const volume::BrickPlane& plane, const IndexRay& ray) noexcept {
        const double height = dot(plane.normal, ray.origin) + plane.offset, rise = dot(plane.normal, ray.direction);
        isRising = rise > 0;
        if (rise != 0)
            time = -height / rise;
        else
            isRising = !(height > 0);
    }
    [[nodiscard]] bool isPositiveAt(double t) const noexcept { return (t >= time) == isRising; }
};

/// The planes of a brick; none where it is not coded by any.
using BrickPlanes = decltype(volume::BrickVolume::BoxCoding::plane);
inline constexpr BrickPlanes kNoPlanes = volume::BrickVolume::BoxCoding().plane;
[[nodiscard]] inline BrickPlanes planesOf(const volume::BrickVolume& volume,
                                          volume::BrickVolume::Entry entry) noexcept {
    return entry.isCoded() ? volume.coding(entry).plane : kNoPlanes;
}

/// Bricks beside each other may have planes for one surface that do not quite meet, so that a label begins on the side
/// of a brick: the first of `planes` that the point at t is near, among those that look along the side's axis;
/// BrickVolume::kNoPlane if there is none.
[[nodiscard]] inline std::uint32_t nearPlane(const volume::BrickVolume& volume, const IndexRay& ray, double t, int axis,
                                             const BrickPlanes& planes) noexcept {
    const Vec3d point = ray.origin + ray.direction * t;
    for (const std::uint32_t number : planes) {
        if (number == volume::BrickVolume::kNoPlane) continue;
        const volume::BrickPlane& plane = volume.oblique()[number];
        const double distance = dot(plane.normal, point) + plane.offset;
        if (std::abs(distance) < 0.75 && std::abs(plane.normal[axis]) > 0.2) return number;
    }
    return volume::BrickVolume::kNoPlane;
}
/// The same for where a ray comes into `cell` at t, if that is on the side of a brick.
[[nodiscard]] inline std::uint32_t seamPlane(const volume::BrickVolume& volume, const IndexRay& ray, double t,
                                             Vec3i cell) noexcept {
    const int axis = ray.entryAxis(t, cell);
    if (axis < 0) return volume::BrickVolume::kNoPlane;
    const std::int32_t face = ray.step[axis] < 0 ? cell[axis] + 1 : cell[axis];
    if ((face & 7) != 0) return volume::BrickVolume::kNoPlane;
    const BrickPlanes entered = planesOf(volume, volume.entry(cell.x >> 3, cell.y >> 3, cell.z >> 3));
    const std::uint32_t plane = nearPlane(volume, ray, t, axis, entered);
    if (plane != volume::BrickVolume::kNoPlane) return plane;
    Vec3i left = cell;
    left[axis] -= ray.step[axis];
    return nearPlane(volume, ray, t, axis, planesOf(volume, volume.entry(left.x >> 3, left.y >> 3, left.z >> 3)));
}

/// Where a run begins: in which voxel, at which oblique plane if it is one that the ray crosses there or a seam of one,
/// and whether voxels alone tell the label there.
struct RunStart {
    Vec3i cell;
    std::uint32_t plane = volume::BrickVolume::kNoPlane;
    bool isVoxel = false;
};

/// Walks [from, to) of the ray, which must lie in spanInVolume(), and tells `visitor` of each run of one scalar:
///     bool enter(Scalar, double from, RunStart)        at its start; true ends the walk
///     bool leave(Scalar, double from, double to)       at its end; true ends the walk
/// Same-label boxes are crossed in one step, coded bricks from side to side, other mixed bricks voxel by voxel.
template <class Visitor>
class RunWalk {
public:
    RunWalk(const volume::BrickVolume& volume, const IndexRay& ray, double from, double to, Visitor& visitor)
        : volume_(volume),
          ray_(ray),
          count_(volume.dimension()),
          visitor_(visitor),
          t_(from),
          to_(to),
          runStart_(from) {}

    void walk() {
        cell_ = ray_.cellAt(t_, count_);
        while (true) {
            const volume::BrickVolume::Entry entry = volume_.entry(cell_.x >> 3, cell_.y >> 3, cell_.z >> 3);
            const bool isDone = !entry.isMixed()  ? crossBox(entry)
                                : entry.isCoded() ? crossCoded(entry)
                                                  : crossVoxels(entry);
            if (isDone) return;
            if (!(t_ < to_)) break;
        }
        visitor_.leave(runScalar_, runStart_, to_);
    }

private:
    // The ray is in `scalar` from t_ on; true ends the walk.
    bool moveTo(volume::Scalar scalar, std::uint32_t plane = volume::BrickVolume::kNoPlane, bool isVoxel = false) {
        if (!isFirst_ && scalar == runScalar_) return false;
        if (!isFirst_ && visitor_.leave(runScalar_, runStart_, t_)) return true;
        if (!isFirst_ && plane == volume::BrickVolume::kNoPlane) plane = seamPlane(volume_, ray_, t_, cell_);
        isFirst_ = false;
        runScalar_ = scalar;
        runStart_ = t_;
        return visitor_.enter(scalar, t_, RunStart{cell_, plane, isVoxel});
    }

    // To where the ray leaves the voxels [min, max).
    struct Exit {
        Vec3d leave;
        Vec3i plane;
        double time;
    };
    template <class Min, class Max>
    [[nodiscard]] Exit exitOf(const Min& min, const Max& max) const noexcept {
        Exit exit;
        forEachAxis([&](auto axis) {
            exit.plane[axis] = ray_.step[axis] < 0 ? min(axis) : max(axis);
            exit.leave[axis] = ray_.planeTime(axis, exit.plane[axis]);
        });
        exit.time = std::min({exit.leave.x, exit.leave.y, exit.leave.z});
        return exit;
    }
    void leaveBy(const Exit& exit) noexcept {
        t_ = exit.time;
        if (!(t_ < to_)) return;
        forEachAxis([&](auto axis) {
            cell_[axis] = exit.leave[axis] == t_ ? exit.plane[axis] - (ray_.step[axis] < 0 ? 1 : 0)
                                                 : ray_.cellAt(axis, t_, count_[axis]);
        });
    }

    bool crossBox(volume::BrickVolume::Entry entry) {
        const volume::SameLabelBox& box = volume_.box(entry);
        if (moveTo(box.scalar)) return true;
        leaveBy(exitOf([&](int axis) { return std::int32_t{box.min[static_cast<std::size_t>(axis)]}; },
                       [&](int axis) { return std::int32_t{box.max[static_cast<std::size_t>(axis)]}; }));
        return false;
    }

    bool crossCoded(volume::BrickVolume::Entry entry) {
        const volume::SameLabelBox& box = volume_.codedBox(entry);
        const volume::BrickVolume::BoxCoding& coding = volume_.coding(entry);
        const Exit exit = exitOf([&](int axis) { return std::int32_t{box.min[static_cast<std::size_t>(axis)]}; },
                                 [&](int axis) { return std::int32_t{box.max[static_cast<std::size_t>(axis)]}; });
        // When the ray changes sides, in the order of the bits; whether it is beyond from then on, or until then.
        struct Side {
            double time;
            bool isBeyondAfter;
            int axis;
            std::uint32_t plane;
        };
        std::array<Side, volume::BrickVolume::kMostSides> sides;
        std::size_t count = 0;
        forEachAxis([&](auto axis) {
            if (!coding.hasCut(axis)) return;
            const std::int32_t place = coding.cut[static_cast<std::size_t>(axis)];
            Side side{ray_.planeTime(axis, place), ray_.step[axis] > 0, axis, volume::BrickVolume::kNoPlane};
            // Not along this axis: on one side for good.
            if (ray_.step[axis] == 0) side.isBeyondAfter = cell_[axis] < place;
            sides[count++] = side;
        });
        for (const std::uint32_t plane : coding.plane) {
            if (plane == volume::BrickVolume::kNoPlane) continue;
            const PlaneCrossing crossing(volume_.oblique()[plane], ray_);
            sides[count++] = {crossing.time, crossing.isRising, -1, plane};
        }
        std::uint32_t crossed = volume::BrickVolume::kNoPlane;
        while (true) {
            std::size_t cell = 0;
            double next = exit.time;
            const Side* nextSide = nullptr;
            for (std::size_t s = 0; s < count; ++s) {
                const bool isAfter = t_ >= sides[s].time;
                cell |= std::size_t{isAfter == sides[s].isBeyondAfter} << s;
                if (!isAfter && sides[s].time < next) {
                    next = sides[s].time;
                    nextSide = &sides[s];
                }
            }
            if (moveTo(volume_.cellScalar(coding, cell), crossed)) return true;
            if (nextSide == nullptr) break;
            t_ = next;
            if (!(t_ < to_)) return false;
            crossed = nextSide->plane;
            forEachAxis([&](auto axis) { cell_[axis] = ray_.cellAt(axis, t_, count_[axis]); });
        }
        leaveBy(exit);
        return false;
    }

    bool crossVoxels(volume::BrickVolume::Entry entry) {
        const volume::BrickVolume::MixedBrick mixed = volume_.mixedBrick(entry);
        const Vec3i brick{cell_.x >> 3, cell_.y >> 3, cell_.z >> 3};
        Vec3d leave{ray_.leaveTime(0, cell_.x), ray_.leaveTime(1, cell_.y), ray_.leaveTime(2, cell_.z)};
        do {
            if (moveTo(mixed.scalarAt(cell_.x & 7, cell_.y & 7, cell_.z & 7), volume::BrickVolume::kNoPlane, true))
                return true;
            t_ = std::min({leave.x, leave.y, leave.z});
            if (!(t_ < to_)) return false;
            forEachAxis([&](auto axis) {
                while (leave[axis] <= t_) {
                    cell_[axis] += ray_.step[axis];
                    leave[axis] = ray_.leaveTime(axis, cell_[axis]);
                }
            });
        } while ((((cell_.x >> 3) ^ brick.x) | ((cell_.y >> 3) ^ brick.y) | ((cell_.z >> 3) ^ brick.z)) == 0);
        return false;
    }

    const volume::BrickVolume& volume_;
    const IndexRay& ray_;
    Vec3i count_;
    Visitor& visitor_;
    Vec3i cell_{};
    double t_, to_, runStart_;
    volume::Scalar runScalar_ = 0;
    bool isFirst_ = true;
};

template <class Visitor>
void walkRuns(const volume::BrickVolume& volume, const IndexRay& ray, double from, double to, Visitor& visitor) {
    RunWalk<Visitor>(volume, ray, from, to, visitor).walk();
}

/// The same from voxel to voxel, within a voxel from oblique plane to oblique plane, and else by scalarAt() alone: what
/// the fast ways are held against.
template <class Visitor>
void walkRunsReference(const volume::BrickVolume& volume, const IndexRay& ray, double from, double to,
                       Visitor& visitor) {
    Vec3i cell = ray.cellAt(from, volume.dimension());
    double t = from, runStart = from;
    volume::Scalar runScalar = 0;
    bool isFirst = true;
    const auto moveTo = [&](volume::Scalar scalar, std::uint32_t plane, bool isVoxel) {
        if (!isFirst && scalar == runScalar) return false;
        if (!isFirst && visitor.leave(runScalar, runStart, t)) return true;
        if (!isFirst && plane == volume::BrickVolume::kNoPlane) plane = seamPlane(volume, ray, t, cell);
        isFirst = false;
        runScalar = scalar;
        runStart = t;
        return visitor.enter(scalar, t, RunStart{cell, plane, isVoxel});
    };
    std::uint32_t crossed = volume::BrickVolume::kNoPlane;
    while (true) {
        const double leave = std::min({ray.leaveTime(0, cell.x), ray.leaveTime(1, cell.y), ray.leaveTime(2, cell.z)});
        const volume::BrickVolume::Entry entry = volume.entry(cell.x >> 3, cell.y >> 3, cell.z >> 3);
        double next = leave;
        if (planesOf(volume, entry) != kNoPlanes) {
            const volume::BrickVolume::BoxCoding& coding = volume.coding(entry);
            std::size_t side = 0;
            int bit = 0;
            for (int axis = 0; axis < 3; ++axis)
                if (coding.hasCut(axis))
                    side |= std::size_t{cell[axis] >= coding.cut[static_cast<std::size_t>(axis)]} << bit++;
            std::uint32_t nextPlane = volume::BrickVolume::kNoPlane;
            for (const std::uint32_t plane : coding.plane) {
                if (plane == volume::BrickVolume::kNoPlane) continue;
                const PlaneCrossing crossing(volume.oblique()[plane], ray);
                side |= std::size_t{crossing.isPositiveAt(t)} << bit++;
                // A plane between voxels is met where a voxel ends.
                const bool isFirstPlane = nextPlane == volume::BrickVolume::kNoPlane;
                if (crossing.time > t && (crossing.time < next || (isFirstPlane && crossing.time == next))) {
                    next = crossing.time;
                    nextPlane = plane;
                }
            }
            if (moveTo(volume.cellScalar(coding, side), crossed, false)) return;
            crossed = nextPlane;
        } else {
            const bool isVoxel = entry.isMixed() && !entry.isCoded();
            if (moveTo(volume.scalarAt(cell.x, cell.y, cell.z), volume::BrickVolume::kNoPlane, isVoxel)) return;
            crossed = volume::BrickVolume::kNoPlane;
        }
        t = next;
        if (!(t < to)) break;
        if (t < leave) continue;
        const Vec3i brick{cell.x >> 3, cell.y >> 3, cell.z >> 3};
        for (int axis = 0; axis < 3; ++axis)
            while (ray.leaveTime(axis, cell[axis]) <= t) cell[axis] += ray.step[axis];
        if (brick != Vec3i{cell.x >> 3, cell.y >> 3, cell.z >> 3}) crossed = volume::BrickVolume::kNoPlane;
    }
    visitor.leave(runScalar, runStart, to);
}

}  // namespace svt::render
