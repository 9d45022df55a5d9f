#pragma once
/// \file
/// Ambient occlusion from a pyramid of coverage: how much of the space in front of a surface is filled. For renderers:
/// used by render and render_gl.

#include <svt/core/vec.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace svt::render {

/// Number of opaque voxels per block of bricks, for kLevels block sizes, each twice as large as the one before.
class OcclusionField {
public:
    OcclusionField() = default;

    /// The smallest blocks are bricks, or larger if voxels are small: about 10 to 20 cm wide. So the shading of corners
    /// and the cost do not depend on the voxel size.
    /// \param voxelSize  metres, the largest spacing
    /// \param isOpaque   by scalar
    /// \param clipper    blocks whose centre is cut away count as empty
    /// Cost: O(blocks + mixed bricks), 1 to 2 ms per million; parallel. Memory: 4.6 bytes per block.
    OcclusionField(const volume::BrickVolume& volume, double voxelSize,
                   const std::function<bool(volume::Scalar)>& isOpaque, const Clipper& clipper, int threads);

    /// Occlusion of a point on a surface, 0 (open) to 1.
    /// \param point      on the surface, voxel space
    /// \param direction  outwards: the world normal transformed to voxel space, scaled so that its longest component is
    ///                   at most 1
    [[nodiscard]] double occlusion(Vec3d point, Vec3d direction) const noexcept;

    static constexpr std::size_t kLevels = 4;
    /// One block size.
    struct Level {
        Vec3i count;          ///< blocks
        double cellSize = 0;  ///< block size in voxels, along each axis
        double gain = 0;      ///< occlusion by one opaque voxel
        double weight = 0;    ///< of this level in the sum
        /// Opaque voxels by block, x fastest, then y, then z, padded by an empty block on all sides; one more element
        /// at the end, so that two may be read at once anywhere.
        std::vector<std::uint32_t> voxels;

        [[nodiscard]] double sample(Vec3d point) const noexcept;
        [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
            return static_cast<std::size_t>(x + 1) +
                   static_cast<std::size_t>(count.x + 2) *
                       (static_cast<std::size_t>(y + 1) +
                        static_cast<std::size_t>(count.y + 2) * static_cast<std::size_t>(z + 1));
        }
    };
    /// Empty if nothing is opaque.
    [[nodiscard]] const std::vector<Level>& levels() const noexcept { return levels_; }

private:
    static Level halved(const Level& fine);

    std::vector<Level> levels_;
};

}  // namespace svt::render
