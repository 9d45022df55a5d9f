#pragma once
/// \file
/// A frame prepared for casting: volumes with the camera's rays in their voxel spaces, and passes with their tables of
/// styles, clips, occlusion, shapes and hulls. Made once per frame, then only read, by all threads.

#include <svt/render/camera_rays.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/occlusion.hpp>
#include <svt/render/pass_shapes.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/render/prepare/direction_table.hpp>
#include <svt/render/prepare/shadow_maps.hpp>
#include <svt/render/prepare/visible_hull.hpp>
#include <svt/render/ray_caster.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::render {

/// A rectangle of the picture, pixels.
struct PixelRect {
    double left = 0, top = 0, right = 0, bottom = 0;
    void widen(double by) noexcept { *this = {left - by, top - by, right + by, bottom + by}; }
    void include(const PixelRect& other) noexcept {
        *this = {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
                 std::max(bottom, other.bottom)};
    }
    [[nodiscard]] bool overlaps(std::int32_t x, std::int32_t y, std::int32_t width,
                                std::int32_t height) const noexcept {
        return x <= right && x + width >= left && y <= bottom && y + height >= top;
    }
};

/// A pass, prepared for all rays.
struct PreparedPass {
    PassTable table;
    Clipper clipper;
    OcclusionField occlusion;
    Pass::Join join;
    std::uint8_t volume;  ///< index into PreparedFrame::volumes
    PassShapes shapes{};
    VisibleHull hull{};  ///< not for the reference, which walks all rays in full
};

/// A volume, prepared for all rays.
struct PreparedVolume {
    const volume::BrickVolume& bricks;
    const volume::Grid& grid;
    CameraRays rays;
    DirectionTable directions;
    double voxelSize;           ///< metres, the largest spacing
    const RunSource* source;    ///< of the runs of rays; null: the bricks
    const SurfacePaint* paint;  ///< colours of opaque surfaces; null: those of the styles

    PreparedVolume(const DrawnVolume& drawn, const FrameSpec& spec)
        : bricks(drawn.bricks()),
          grid(drawn.grid()),
          rays(spec, grid),
          directions(bricks, grid),
          voxelSize(std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z})),
          source(drawn.source()),
          paint(drawn.paint()) {}
};

/// A frame, prepared for all rays.
struct PreparedFrame {
    const FrameSpec& spec;
    const CastOptions& options;
    std::vector<PreparedVolume> volumes{};  ///< at least one
    std::vector<PreparedPass> passes{};
    Vec3d towardsLight{};  ///< world space, unit length
    ShadowMaps shadows{};  ///< empty: none
    Vec3f hatchColor{};    ///< linear light
    bool isReference = false;
    bool isAdaptive = false;  ///< several samples only in pixels that differ from a neighbour
    PixelRect drawn{};        ///< outside of it no ray meets a volume or a line
    bool hasShapes = false;   ///< whether any pass has shapes
    /// Samples along a pixel's side for the antialiasing of lines, whose edges fade over one sample. 1 if adaptive,
    /// since most pixels then have one sample.
    double lineSamples = 1;

    /// The camera's rays, for values that do not depend on the volume; CameraRay::voxelRay does.
    [[nodiscard]] const CameraRays& rays() const noexcept { return volumes.front().rays; }
    [[nodiscard]] const PreparedVolume& volumeOf(std::size_t pass) const noexcept {
        return volumes[passes[pass].volume];
    }
};

}  // namespace svt::render
