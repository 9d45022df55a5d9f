#pragma once
/// \file
/// Ambient occlusion from coarse coverage: how much of the space before a surface is taken. Internal to render.

#include <svt/core/vec.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace svt::render {

/// Opaque voxels per block of bricks, and per ever larger blocks.
class OcclusionField {
public:
    OcclusionField() = default;

    /// Blocks are bricks, or larger where voxels are small: about 10 to 20 cm, so that corners are as wide and dark
    /// whatever the voxel size, and a fine volume costs no more.
    /// \param voxelSize  metres, the largest spacing
    /// \param isOpaque   by scalar
    /// \param clipper    blocks whose middle is cut away count as empty
    /// Cost: O(blocks + bricks that hold several labels), a millisecond or two per million; parallel. Memory: 4.6 bytes
    /// a block.
    OcclusionField(const volume::BrickVolume& volume, double voxelSize,
                   const std::function<bool(volume::Scalar)>& isOpaque, const Clipper& clipper, int threads);

    /// Share of the surroundings before a surface that is taken, 0..1.
    /// \param point      on the surface, voxel space
    /// \param direction  away from the surface: the world normal in voxel space, scaled so that its longest component
    ///                   is at most 1
    [[nodiscard]] double occlusion(Vec3d point, Vec3d direction) const noexcept;

    static constexpr std::size_t kLevels = 4;
    /// One block size.
    struct Level {
        Vec3i count;          ///< blocks
        double cellSize = 0;  ///< voxels, along each axis
        double gain = 0;      ///< occlusion by one opaque voxel
        double weight = 0;
        /// Opaque voxels by block, x fastest, then y, then z, with an empty block all around; one more element behind,
        /// so that two may be read at once anywhere.
        std::vector<std::uint32_t> voxels;

        [[nodiscard]] double sample(Vec3d point) const noexcept;
        [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
            return static_cast<std::size_t>(x + 1) +
                   static_cast<std::size_t>(count.x + 2) *
                       (static_cast<std::size_t>(y + 1) +
                        static_cast<std::size_t>(count.y + 2) * static_cast<std::size_t>(z + 1));
        }
    };
    /// Empty where there is nothing opaque.
    [[nodiscard]] const std::vector<Level>& levels() const noexcept { return levels_; }

private:
    static Level halved(const Level& fine);

    std::vector<Level> levels_;
};

}  // namespace svt::render
