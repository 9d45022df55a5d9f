#pragma once
/// \file
/// Walks a ray through a volume as runs of one scalar.
///
///     ray     --->  . . a a a a a b b . . .
///     runs          [ 0 ][    a   ][ b ][ 0 ]      enter(a), leave(a), enter(b), ...
///
/// walkRuns() crosses whole boxes at once; walkRunsReference() steps from voxel to voxel. Both visit the same runs, to
/// the last bit, since both decide only by VoxelRay::planeTime().

#include <svt/render/run_source.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/render/walk/plane_crossing.hpp>
#include <svt/volume/brick_volume.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace svt::render {

/// Walks [from, to) of the ray, which must lie in spanInVolume(), and calls `visitor` for each run of one scalar.
///     bool enter(Scalar, double from, RunStart)        at its start; true ends the walk.
///     bool leave(Scalar, double from, double to)       at its end; true ends the walk.
/// Same-label boxes are crossed in one step, coded boxes from one cut or plane to the next, other mixed bricks voxel by
/// voxel.
template <class Visitor>
class RunWalk {
public:
    RunWalk(const volume::BrickVolume& volume, const VoxelRay& ray, double from, double to, Visitor& visitor)
        : volume_(volume),
          ray_(ray),
          count_(volume.dimension()),
          visitor_(visitor),
          t_(from),
          to_(to),
          runStart_(from) {}

    void walk() {
        voxel_ = ray_.voxelAt(t_, count_);
        while (true) {
            const volume::BrickVolume::Entry entry = volume_.entry(voxel_.x >> 3, voxel_.y >> 3, voxel_.z >> 3);
            const bool isDone = !entry.isMixed()  ? crossBox(entry)
                                : entry.isCoded() ? crossCoded(entry)
                                                  : crossVoxels(entry);
            if (isDone) return;
            if (!(t_ < to_)) break;
        }
        visitor_.leave(runScalar_, runStart_, to_);
    }

private:
    // The ray is in `scalar` from t_ on. Returns true if the visitor ends the walk.
    bool moveTo(volume::Scalar scalar, std::uint32_t plane = volume::BrickVolume::kNoPlane, bool isVoxel = false) {
        if (!isFirst_ && scalar == runScalar_) return false;
        if (!isFirst_ && visitor_.leave(runScalar_, runStart_, t_)) return true;
        if (!isFirst_ && plane == volume::BrickVolume::kNoPlane) plane = seamPlane(volume_, ray_, t_, voxel_);
        isFirst_ = false;
        runScalar_ = scalar;
        runStart_ = t_;
        return visitor_.enter(scalar, t_, RunStart{voxel_, plane, isVoxel});
    }

    // Where the ray leaves the voxels [min, max): by axis the time and the plane, and the earliest of the times.
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
            voxel_[axis] = exit.leave[axis] == t_ ? exit.plane[axis] - (ray_.step[axis] < 0 ? 1 : 0)
                                                  : ray_.voxelAt(axis, t_, count_[axis]);
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
        // The cuts and planes, in the order of the bits of a side combination: when the ray crosses each, and whether
        // it is beyond it after or before that time.
        struct Side {
            double time;
            bool isBeyondAfter;
            int axis;
            std::uint32_t plane;
        };
        std::array<Side, volume::BrickVolume::kMaxSides> sides;
        std::size_t count = 0;
        const auto addPlane = [&](std::uint32_t plane) {
            if (plane == volume::BrickVolume::kNoPlane) return;
            const PlaneCrossing crossing(volume_.planes()[plane], ray_);
            sides[count++] = {crossing.time, crossing.isRising, -1, plane};
        };
        forEachAxis([&](auto axis) {
            if (!coding.hasCut(axis)) return addPlane(coding.planeInCut(axis));
            const std::int32_t place = coding.cut[static_cast<std::size_t>(axis)];
            Side side{ray_.planeTime(axis, place), ray_.step[axis] > 0, axis, volume::BrickVolume::kNoPlane};
            // A ray with zero direction on this axis stays on one side.
            if (ray_.step[axis] == 0) side.isBeyondAfter = voxel_[axis] < place;
            sides[count++] = side;
        });
        for (const std::uint32_t plane : coding.plane) addPlane(plane);
        std::uint32_t crossed = volume::BrickVolume::kNoPlane;
        while (true) {
            std::size_t combination = 0;
            double next = exit.time;
            const Side* nextSide = nullptr;
            for (std::size_t s = 0; s < count; ++s) {
                const bool isAfter = t_ >= sides[s].time;
                combination |= std::size_t{isAfter == sides[s].isBeyondAfter} << s;
                if (!isAfter && sides[s].time < next) {
                    next = sides[s].time;
                    nextSide = &sides[s];
                }
            }
            if (moveTo(volume_.sideScalar(coding, combination), crossed)) return true;
            if (nextSide == nullptr) break;
            t_ = next;
            if (!(t_ < to_)) return false;
            crossed = nextSide->plane;
            forEachAxis([&](auto axis) { voxel_[axis] = ray_.voxelAt(axis, t_, count_[axis]); });
        }
        leaveBy(exit);
        return false;
    }

    bool crossVoxels(volume::BrickVolume::Entry entry) {
        const volume::BrickVolume::MixedBrick mixed = volume_.mixedBrick(entry);
        const Vec3i brick{voxel_.x >> 3, voxel_.y >> 3, voxel_.z >> 3};
        Vec3d leave{ray_.leaveTime(0, voxel_.x), ray_.leaveTime(1, voxel_.y), ray_.leaveTime(2, voxel_.z)};
        do {
            if (moveTo(mixed.scalarAt(voxel_.x & 7, voxel_.y & 7, voxel_.z & 7), volume::BrickVolume::kNoPlane, true))
                return true;
            t_ = std::min({leave.x, leave.y, leave.z});
            if (!(t_ < to_)) return false;
            forEachAxis([&](auto axis) {
                while (leave[axis] <= t_) {
                    voxel_[axis] += ray_.step[axis];
                    leave[axis] = ray_.leaveTime(axis, voxel_[axis]);
                }
            });
        } while ((((voxel_.x >> 3) ^ brick.x) | ((voxel_.y >> 3) ^ brick.y) | ((voxel_.z >> 3) ^ brick.z)) == 0);
        return false;
    }

    const volume::BrickVolume& volume_;
    const VoxelRay& ray_;
    Vec3i count_;
    Visitor& visitor_;
    Vec3i voxel_{};
    double t_, to_, runStart_;
    volume::Scalar runScalar_ = 0;
    bool isFirst_ = true;
};

template <class Visitor>
void walkRuns(const volume::BrickVolume& volume, const VoxelRay& ray, double from, double to, Visitor& visitor) {
    RunWalk<Visitor>(volume, ray, from, to, visitor).walk();
}

/// The same by stepping from voxel to voxel. Within voxels of coded bricks, it steps from plane to plane; all other
/// labels come from scalarAt(). Tests compare the fast walks with this reference.
template <class Visitor>
void walkRunsReference(const volume::BrickVolume& volume, const VoxelRay& ray, double from, double to,
                       Visitor& visitor) {
    Vec3i voxel = ray.voxelAt(from, volume.dimension());
    double t = from, runStart = from;
    volume::Scalar runScalar = 0;
    bool isFirst = true;
    const auto moveTo = [&](volume::Scalar scalar, std::uint32_t plane, bool isVoxel) {
        if (!isFirst && scalar == runScalar) return false;
        if (!isFirst && visitor.leave(runScalar, runStart, t)) return true;
        if (!isFirst && plane == volume::BrickVolume::kNoPlane) plane = seamPlane(volume, ray, t, voxel);
        isFirst = false;
        runScalar = scalar;
        runStart = t;
        return visitor.enter(scalar, t, RunStart{voxel, plane, isVoxel});
    };
    std::uint32_t crossed = volume::BrickVolume::kNoPlane;
    while (true) {
        const double leave =
            std::min({ray.leaveTime(0, voxel.x), ray.leaveTime(1, voxel.y), ray.leaveTime(2, voxel.z)});
        const volume::BrickVolume::Entry entry = volume.entry(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3);
        double next = leave;
        if (hasPlanes(volume, entry)) {
            const volume::BrickVolume::BoxCoding& coding = volume.coding(entry);
            std::size_t side = 0;
            int bit = 0;
            std::uint32_t nextPlane = volume::BrickVolume::kNoPlane;
            coding.forEachSide(
                [&](int axis, std::int32_t place) { side |= std::size_t{voxel[axis] >= place} << bit++; },
                [&](std::uint32_t plane) {
                    const PlaneCrossing crossing(volume.planes()[plane], ray);
                    side |= std::size_t{crossing.isPositiveAt(t)} << bit++;
                    // A plane may be crossed exactly where the ray leaves the voxel; then it counts as crossed, too.
                    const bool isFirstPlane = nextPlane == volume::BrickVolume::kNoPlane;
                    if (crossing.time > t && (crossing.time < next || (isFirstPlane && crossing.time == next))) {
                        next = crossing.time;
                        nextPlane = plane;
                    }
                });
            if (moveTo(volume.sideScalar(coding, side), crossed, false)) return;
            crossed = nextPlane;
        } else {
            const bool isVoxel = entry.isMixed() && !entry.isCoded();
            if (moveTo(volume.scalarAt(voxel.x, voxel.y, voxel.z), volume::BrickVolume::kNoPlane, isVoxel)) return;
            crossed = volume::BrickVolume::kNoPlane;
        }
        t = next;
        if (!(t < to)) break;
        if (t < leave) continue;
        const Vec3i brick{voxel.x >> 3, voxel.y >> 3, voxel.z >> 3};
        for (int axis = 0; axis < 3; ++axis)
            while (ray.leaveTime(axis, voxel[axis]) <= t) voxel[axis] += ray.step[axis];
        if (brick != Vec3i{voxel.x >> 3, voxel.y >> 3, voxel.z >> 3}) crossed = volume::BrickVolume::kNoPlane;
    }
    visitor.leave(runScalar, runStart, to);
}

}  // namespace svt::render
