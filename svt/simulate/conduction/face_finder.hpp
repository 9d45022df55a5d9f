#pragma once
/// \file
/// Where the line between the centres of two adjacent voxels crosses the face between their labels, and the face's normal.

#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::simulate {

enum class FaceSource : std::uint8_t {
    Brick,  ///< a plane of the brick
    Model,  ///< another plane of the model's faces
    Voxel   ///< none: the face between the voxels
};

/// A face between two voxels.
struct FaceCrossing {
    double at = 0.5;  ///< from the centre of the lower voxel, 0, to that of the upper one, 1
    Vec3d normal{};   ///< in metres along the grid's axes, unit length, towards the upper voxel
    FaceSource source = FaceSource::Voxel;
};

/// Immutable. Thread-safe to read.
class FaceFinder {
public:
    /// \param volume  must outlive this
    /// \return or as BrickVolume::fromColumns()
    /// Cost: that of the bricks, and O(bricks that the model's planes cross).
    [[nodiscard]] static Result<FaceFinder> make(const volume::SemanticVolume& volume, int threads,
                                                 const Progress* progress);

    /// The face at which the line from the centre of `voxel` to that of the next one along `axis` leaves the scalars for which
    /// isOwn(scalar) is true. The scalar of `voxel` is such, that of the next voxel is not.
    template <class IsOwn>
    [[nodiscard]] FaceCrossing find(Vec3i voxel, int axis, const IsOwn& isOwn) const {
        Vec3i next = voxel;
        ++next[axis];
        Leave leave = leaveOf(voxel, axis, voxel, 0, 0.5, isOwn);
        if (!leave.isFound) leave = leaveOf(voxel, axis, next, 0.5, 1, isOwn);
        if (!leave.isFound || leave.plane == volume::BrickVolume::kNoPlane)
            return findInModel(voxel, next, axis, -1e-6, 1 + 1e-6);
        // Bricks move planes by up to some thousandths of a voxel away from samples.
        FaceCrossing face = crossingOf(bricks_.planes()[leave.plane], axis, leave.at, FaceSource::Brick);
        const FaceCrossing exact = findInModel(voxel, next, axis, leave.at - kMoved, leave.at + kMoved);
        if (exact.source == FaceSource::Model && dot(exact.normal, face.normal) > 0.999) {
            face.at = exact.at;
            face.normal = exact.normal;
        }
        return face;
    }

    [[nodiscard]] const volume::BrickVolume& bricks() const noexcept { return bricks_; }

private:
    static constexpr double kMoved = 0.01;
    struct Leave {
        bool isFound = false;
        double at = 0.5;
        std::uint32_t plane = volume::BrickVolume::kNoPlane;
    };
    explicit FaceFinder(const volume::SemanticVolume& volume) : volume_(&volume) {}
    void indexPlanes();
    [[nodiscard]] FaceCrossing crossingOf(const volume::BrickPlane& plane, int axis, double at,
                                          FaceSource source) const;
    // The largest plane of the model between `least` and `most` of the line.
    [[nodiscard]] FaceCrossing findInModel(Vec3i voxel, Vec3i next, int axis, double least, double most) const;

    // Where the part [from, to] of the line, which lies in voxel `in`, leaves the own scalars.
    template <class IsOwn>
    [[nodiscard]] Leave leaveOf(Vec3i voxel, int axis, Vec3i in, double from, double to, const IsOwn& isOwn) const {
        using volume::BrickVolume;
        const BrickVolume::Entry entry = bricks_.entry(in.x >> 3, in.y >> 3, in.z >> 3);
        if (!entry.isCoded()) return {!isOwn(bricks_.scalarAt(in.x, in.y, in.z)), from, BrickVolume::kNoPlane};
        const BrickVolume::BoxCoding& coding = bricks_.coding(entry);
        const Vec3d start = toDouble(voxel) + Vec3d{0.5, 0.5, 0.5};
        struct Crossing {
            double at = 0;
            std::uint32_t plane = BrickVolume::kNoPlane;
        };
        Crossing crossings[BrickVolume::kMaxSides + 1];
        std::size_t count = 0;
        crossings[count++] = {from, BrickVolume::kNoPlane};
        coding.forEachSide([](int, std::uint16_t) {},
                           [&](std::uint32_t number) {
                               const volume::BrickPlane& plane = bricks_.planes()[number];
                               const double rise = plane.normal[axis];
                               if (rise == 0) return;
                               const double at = -(dot(plane.normal, start) + plane.offset) / rise;
                               if (at >= from && at < to) crossings[count++] = {at, number};
                           });
        for (std::size_t n = 1; n < count; ++n)  // few: insertion sort
            for (std::size_t m = n; m > 0 && crossings[m].at < crossings[m - 1].at; --m)
                std::swap(crossings[m], crossings[m - 1]);
        for (std::size_t n = 0; n < count; ++n) {
            const double end = n + 1 < count ? crossings[n + 1].at : to;
            if (!(end > crossings[n].at)) continue;
            Vec3d point = start;
            point[axis] += (crossings[n].at + end) / 2;
            if (isOwn(bricks_.sideScalar(coding, sidesAt(coding, in, point)))) continue;
            std::uint32_t plane = crossings[n].plane;
            // Planes that meet in one place: any of them but the start of the part.
            if (plane == BrickVolume::kNoPlane && n > 0) plane = crossings[n - 1].plane;
            return {true, crossings[n].at, plane};
        }
        return {};
    }
    [[nodiscard]] std::size_t sidesAt(const volume::BrickVolume::BoxCoding& coding, Vec3i in,
                                      Vec3d point) const noexcept {
        std::size_t sides = 0;
        int bit = 0;
        coding.forEachSide([&](int axis, std::int32_t place) { sides |= std::size_t{in[axis] >= place} << bit++; },
                           [&](std::uint32_t number) {
                               const volume::BrickPlane& plane = bricks_.planes()[number];
                               sides |= std::size_t{dot(plane.normal, point) + plane.offset > 0} << bit++;
                           });
        return sides;
    }

    const volume::SemanticVolume* volume_;
    volume::BrickVolume bricks_;
    std::vector<std::size_t> start_;      // of each brick, x fastest: its planes in byBrick_; one more at the end
    std::vector<std::uint32_t> byBrick_;  // numbers of planes, ascending in each brick
};

}  // namespace svt::simulate
