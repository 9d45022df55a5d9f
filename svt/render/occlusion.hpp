#pragma once
/// \file
/// Ambient occlusion from coarse coverage: how much of the space before a surface is taken. Internal to render.

#include <svt/core/vec.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/volume/brick_volume.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace svt::render {

/// Shares of opaque voxels per brick, and of ever larger blocks of bricks.
class OcclusionField {
public:
    OcclusionField() = default;

    /// \param isOpaque  by scalar
    /// \param clipper   bricks whose middle is cut away count as empty
    /// Cost: O(bricks), a millisecond or two per million; parallel.
    OcclusionField(const volume::BrickVolume& volume, const std::function<bool(volume::Scalar)>& isOpaque,
                   const Clipper& clipper, int threads);

    /// Share of the surroundings before a surface that is taken, 0..1.
    /// \param point      on the surface, voxel space
    /// \param direction  away from the surface: the world normal in voxel space, scaled so that its longest component
    /// is
    ///                   at most 1
    [[nodiscard]] float occlusion(Vec3f point, Vec3f direction) const noexcept;

private:
    struct Level {
        Vec3i count;
        float cellSize = 8;  // voxels
        std::vector<float> coverage;
        [[nodiscard]] float sample(Vec3f point) const noexcept;
    };
    static Level halved(const Level& fine);

    std::vector<Level> levels_;
};

}  // namespace svt::render
