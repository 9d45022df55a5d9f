#pragma once
/// \file
/// Normals of voxel surfaces, fitted to a window of 7 x 7 x 7 voxels that are body or not.

#include <svt/core/hash.hpp>
#include <svt/core/vec.hpp>
#include <svt/render/picture_constants.hpp>
#include <svt/volume/brick_volume.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace svt::render {

/// The 7 x 7 x 7 voxels around a centre voxel as bits: bit x + 8 y of word z, with x, y, z = 0..6 and the centre at 3.
using VoxelWindow = std::array<std::uint64_t, 7>;

/// Window around voxel `middle`, which may lie outside the volume. Voxels are body if accepts(scalar); those outside
/// the volume are not. Cost: the masks of up to 8 bricks.
template <class Accepts>
[[nodiscard]] VoxelWindow voxelWindow(const volume::BrickVolume& volume, Vec3i middle, const Accepts& accepts) {
    const Vec3i low{middle.x - 3, middle.y - 3, middle.z - 3};
    const Vec3i count = volume.dimension(), bricks = volume.brickCount();
    const int shiftX = low.x & 7, shiftY = low.y & 7;
    // Bits of a row that come from the first brick; bits of a layer that are inside the volume.
    const std::uint64_t firstBits = 0x0101010101010101ull * static_cast<std::uint64_t>(0xFF >> shiftX);
    std::uint64_t inside = 0x007F7F7F7F7F7F7Full;
    if (low.x < 0 || low.y < 0 || low.x + 7 > count.x || low.y + 7 > count.y) {
        std::uint64_t row = 0;
        for (int x = 0; x < 7; ++x) row |= static_cast<std::uint64_t>(low.x + x >= 0 && low.x + x < count.x) << x;
        inside = 0;
        for (int y = 0; y < 7; ++y)
            if (low.y + y >= 0 && low.y + y < count.y) inside |= row << (8 * y);
    }

    VoxelWindow window{};
    volume::BrickVolume::VoxelMask masks[2][2];
    volume::BrickVolume::MaskWords scratch[2][2];
    for (int z = 0; z < 7;) {
        const std::int32_t k = low.z + z;
        if (k < 0) {
            ++z;
            continue;
        }
        if (k >= count.z) break;
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) {
                const std::int32_t bx = (low.x >> 3) + x, by = (low.y >> 3) + y;
                const bool isNeeded = bx >= 0 && bx < bricks.x && by >= 0 && by < bricks.y && (x == 0 || shiftX > 1) &&
                                      (y == 0 || shiftY > 1);
                masks[y][x] = isNeeded ? volume.voxelMask(volume.entry(bx, by, k >> 3), accepts, scratch[y][x])
                                       : volume::BrickVolume::VoxelMask();
            }
        const std::int32_t end = std::min({7, (k & ~7) + 8 - low.z, count.z - low.z});
        for (; z < end; ++z) {
            const auto word = static_cast<std::size_t>((low.z + z) & 7);
            const auto joinX = [&](const volume::BrickVolume::VoxelMask* pair) {
                return ((pair[0].word(word) >> shiftX) & firstBits) |
                       ((pair[1].word(word) << (8 - shiftX)) & ~firstBits);
            };
            std::uint64_t slice = joinX(masks[0]) >> (8 * shiftY);
            if (shiftY > 1) slice |= joinX(masks[1]) << (64 - 8 * shiftY);
            window[static_cast<std::size_t>(z)] = slice & inside;
        }
    }
    return window;
}

/// Normal of a body's surface.
struct SurfaceNormal {
    Vec3f indexNormal;  ///< index space (a covector); not normalized, never zero
    /// Share of body voxels in a ball around the voxel in front of the surface: kPlaneFilledShare on a plane, more in
    /// concave corners.
    float filledShare = 0;

    static constexpr float kPlaneFilledShare = static_cast<float>(kPlaneVoxels) / kBallVoxels;
};

/// Normal of the surface next to the centre of a window. The window is centred on the voxel in front of the surface, so
/// that a sheet one voxel thick has two sides.
/// \param faceAxis  axis of the voxel face that the ray hits, 0..2
/// \param faceSign  sign of the normal of this face along the axis, 1 or -1
///
/// The surface is a height field over the face's plane, grown from the face while neighbouring heights differ by at
/// most one voxel. If all heights are equal, the normal is exactly the face's, up to the edges of a wall. Else it is
/// that of the least-squares plane through the heights. Where these are steep or few, heights over the axis of the
/// longest component of the body's first moment in a ball are taken instead. If they are too few as well, the normal is
/// the moment, reversed; if all else fails, the face's.
[[nodiscard]] SurfaceNormal fitNormal(const VoxelWindow& window, int faceAxis, int faceSign) noexcept;

/// Normal of the surface of all voxels with accepts(scalar), where a ray enters `voxel` through a face.
template <class Accepts>
[[nodiscard]] SurfaceNormal surfaceNormal(const volume::BrickVolume& volume, Vec3i voxel, int faceAxis, int faceSign,
                                          const Accepts& accepts) {
    voxel[faceAxis] += faceSign;
    return fitNormal(voxelWindow(volume, voxel, accepts), faceAxis, faceSign);
}

/// Direct-mapped cache of normals of hit voxels: neighbouring rays often hit the same voxel.
class NormalCache {
public:
    struct Slot {
        std::uint64_t key = ~std::uint64_t{0};
        SurfaceNormal normal;
    };
    [[nodiscard]] Slot& slot(std::uint64_t key) noexcept { return slots_[place(key)]; }

private:
    static constexpr int kBits = 10;
    [[nodiscard]] static std::size_t place(std::uint64_t key) noexcept {
        return static_cast<std::size_t>((key * kHashFactor) >> (64 - kBits));
    }
    std::array<Slot, std::size_t{1} << kBits> slots_{};
};

}  // namespace svt::render
