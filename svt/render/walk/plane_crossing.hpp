#pragma once
/// \file
/// Where a ray crosses the planes of a coded brick, and which plane belongs to a label that starts on a brick's face.

#include <svt/render/picture_constants.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/volume/brick_volume.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace svt::render {

/// When a ray crosses an oblique plane, and on which side it is before and after.
struct PlaneCrossing {
    double time = std::numeric_limits<double>::infinity();
    bool isRising = false;  ///< true: on the positive side from `time` on; false: until then

    PlaneCrossing(const volume::BrickPlane& plane, const VoxelRay& ray) noexcept {
        const double height = dot(plane.normal, ray.origin) + plane.offset, rise = dot(plane.normal, ray.direction);
        isRising = rise > 0;
        if (rise != 0)
            time = -height / rise;
        else
            isRising = !(height > 0);
    }
    [[nodiscard]] bool isPositiveAt(double t) const noexcept { return (t >= time) == isRising; }
};

/// Whether a brick is coded by any plane.
[[nodiscard]] inline bool hasPlanes(const volume::BrickVolume& volume, volume::BrickVolume::Entry entry) noexcept {
    if (!entry.isCoded()) return false;
    bool isAny = false;
    volume.coding(entry).forEachSide([](int, std::uint16_t) {}, [&](std::uint32_t) { isAny = true; });
    return isAny;
}

/// The planes of a brick; kNoPlanes if it is not coded by any.
using BrickPlanes = decltype(volume::BrickVolume::BoxCoding::plane);
inline constexpr BrickPlanes kNoPlanes = volume::BrickVolume::BoxCoding().plane;
[[nodiscard]] inline BrickPlanes planesOf(const volume::BrickVolume& volume,
                                          volume::BrickVolume::Entry entry) noexcept {
    return entry.isCoded() ? volume.coding(entry).plane : kNoPlanes;
}

/// Planes of adjacent bricks for one surface may not quite meet; then a label starts on the face between the bricks, a
/// seam. Finds the plane that the surface has there: the first of `planes` near the point at t (kSeamDistance) whose
/// normal has a component along `axis`, that of the face; BrickVolume::kNoPlane if there is none.
[[nodiscard]] inline std::uint32_t nearPlane(const volume::BrickVolume& volume, const VoxelRay& ray, double t, int axis,
                                             const BrickPlanes& planes) noexcept {
    const Vec3d point = ray.origin + ray.direction * t;
    for (const std::uint32_t number : planes) {
        if (number == volume::BrickVolume::kNoPlane) continue;
        const volume::BrickPlane& plane = volume.planes()[number];
        const double distance = dot(plane.normal, point) + plane.offset;
        if (std::abs(distance) < kSeamDistance && std::abs(plane.normal[axis]) > kSeamSlope) return number;
    }
    return volume::BrickVolume::kNoPlane;
}
/// The plane of the seam at which a ray enters `voxel` at t. It belongs to the brick that the ray enters or leaves.
/// BrickVolume::kNoPlane if the ray is not on a face of a brick, or no plane is near.
[[nodiscard]] inline std::uint32_t seamPlane(const volume::BrickVolume& volume, const VoxelRay& ray, double t,
                                             Vec3i voxel) noexcept {
    const int axis = ray.entryAxis(t, voxel);
    if (axis < 0) return volume::BrickVolume::kNoPlane;
    const std::int32_t face = ray.step[axis] < 0 ? voxel[axis] + 1 : voxel[axis];
    if ((face & 7) != 0) return volume::BrickVolume::kNoPlane;
    const BrickPlanes entered = planesOf(volume, volume.entry(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3));
    const std::uint32_t plane = nearPlane(volume, ray, t, axis, entered);
    if (plane != volume::BrickVolume::kNoPlane) return plane;
    Vec3i left = voxel;
    left[axis] -= ray.step[axis];
    return nearPlane(volume, ray, t, axis, planesOf(volume, volume.entry(left.x >> 3, left.y >> 3, left.z >> 3)));
}

}  // namespace svt::render
