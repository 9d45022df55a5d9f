#pragma once
/// \file
/// Ray caster on the CPU. Exact: a ray is a list of runs (scalar, from, to), found by stepping from label to label,
/// with no sampling distance and no filtering of labels. The reference for every other renderer.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/image/image.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/run_source.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <cstdint>
#include <span>

namespace svt::render {

struct CastOptions {
    int threads = 0;          ///< 0: all cores; the picture does not depend on it
    float opaqueAt = 0.999f;  ///< early ray termination at this opacity, in (0, 1]
    float labelAt = 0;        ///< label and depth are those of the first run after which the ray's opacity exceeds
                              ///< this, in [0, 1). 0: the first visible label; 0.5: looks through ghosts.
    /// Adaptive sampling: with several samples per pixel, a pixel gets all of them only if it differs from one of its
    /// eight neighbours in label, depth, normal or colour. Ignored if the farthest voxels are smaller than a pixel,
    /// since thin parts between equal pixel centres would be missed. So adaptive sampling misses at most the tips of
    /// parts seen edge-on.
    bool isAdaptive = false;
    const Progress* progress = nullptr;  ///< for cancelling only; no progress is reported
};

/// One frame: three buffers of spec.width x spec.height pixels; row 0 is the top.
struct Frame {
    image::Image<image::Rgba8> color;    ///< sRGB, alpha not premultiplied
    image::Image<volume::Scalar> label;  ///< of the ray through the pixel's centre; 0: background
    image::Image<float> depth;  ///< metres along the view direction to the start of the label; +inf: background
};

/// Colours of opaque surfaces by their place, such as from a field, in place of those of their styles.
class SurfacePaint {
public:
    struct Point {
        std::uint32_t pass = 0;    ///< number of the pass
        volume::Scalar label = 0;  ///< as Frame::label
        double depth = 0;          ///< metres along the view direction
        Vec3d world{};
        Vec3d normal{};      ///< world space, unit length, towards the viewer
        bool isCap = false;  ///< on the cut face of a clip
        Vec3f color{};       ///< of its style, linear light
    };
    virtual ~SurfacePaint() = default;
    /// \return linear light, before shading. Several threads call this at once.
    [[nodiscard]] virtual Vec3f colorAt(const Point& point) const noexcept = 0;
};

/// A representation of a semantic volume that passes can draw: the volume itself, a level of detail, or its hulls. All
/// representations have the scalars of the volume, so one table of styles applies to all of them. The arguments must
/// outlive it.
class DrawnVolume {
public:
    /// \param grid  where the samples of `bricks` lie; its dimension must be that of `bricks`
    /// \param source  of the runs of rays, such as a FaceModel; null: the bricks. A frame with a source casts one ray after
    ///                the other, without packets. Ambient occlusion comes from the bricks. Must outlive this.
    DrawnVolume(const volume::BrickVolume& bricks, const volume::Grid& grid, const RunSource* source = nullptr)
        : bricks_(&bricks), grid_(&grid), source_(source) {}
    /// A coarse level.
    ///
    /// A cell has the extinction and colour of its labels, weighted by coverage (Al-Thelaya 2020). An opaque label
    /// stops 99 % of the light over the length of one fine voxel, so a wall one voxel thick stays nearly opaque at each
    /// level. A cell that opaque labels cover by half or more is a surface. Frame::label has the most frequent visible
    /// label of the cell.
    DrawnVolume(const volume::LodLevel& level) : bricks_(&level.bricks), grid_(&level.grid), level_(&level) {}

    [[nodiscard]] const volume::BrickVolume& bricks() const noexcept { return *bricks_; }
    [[nodiscard]] const volume::Grid& grid() const noexcept { return *grid_; }
    [[nodiscard]] const volume::LodLevel* level() const noexcept { return level_; }  ///< null: full resolution
    [[nodiscard]] const RunSource* source() const noexcept { return source_; }       ///< null: the bricks

    /// From now on `paint` gives the colours of opaque surfaces of this volume. Translucent parts, lines and hatches keep
    /// those of the frame. null: the styles. Must outlive this. Only castRays() and castRaysReference() use it.
    void paintBy(const SurfacePaint* paint) noexcept { paint_ = paint; }
    [[nodiscard]] const SurfacePaint* paint() const noexcept { return paint_; }

private:
    const volume::BrickVolume* bricks_;
    const volume::Grid* grid_;
    const volume::LodLevel* level_ = nullptr;
    const RunSource* source_ = nullptr;
    const SurfacePaint* paint_ = nullptr;
};

/// Draws `volumes` as described by `spec`; Pass::volume is the index of the volume that a pass draws.
///
/// A voxel is the box of half a spacing around its sample. Per pass, the ray is clipped to the volume's voxels and by
/// the clips. It is then split into runs of one scalar, which are blended front to back:
///   - opacity 1: an opaque surface at the start of the run, lit by its normal.
///   - opacity o in (0, 1): over a length in metres it stops 1 - (1 - o)^length of the light (Beer-Lambert), whatever
///     the voxel size. Its colour is lit half as strongly as a surface, at the start of the run, so that the shape of
///     glass is visible.
///   - opacity 0: nothing.
/// A surface has the normal of the plane or voxel face where the run starts. The normal of an opaque surface in a brick
/// of voxels is fitted to the opaque voxels around it. A cap (cut face) has the normal of the clip face, and shows the
/// label that is cut. Lighting and blending are in linear light; passes are composited by Pass::Join, all over the
/// background.
///
/// \return the frame, or
///         - BadFrame, BadCamera   see checkFrameSpec(); a pass draws a volume that does not exist
///         - BadArgument           no volume, a grid that is not the volume's, or an option out of range
///         - Cancelled
/// Cost: O(pixels * samples * passes * same-label boxes crossed), and O(bricks) per pass with ambient occlusion.
/// Threads: reads only; several frames may be cast at once. The result does not depend on the number of threads.
[[nodiscard]] Result<Frame> castRays(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                     const CastOptions& options = {});
[[nodiscard]] inline Result<Frame> castRays(const DrawnVolume& volume, const FrameSpec& spec,
                                            const CastOptions& options = {}) {
    return castRays(std::span(&volume, 1), spec, options);
}
[[nodiscard]] inline Result<Frame> castRays(const volume::BrickVolume& volume, const volume::Grid& grid,
                                            const FrameSpec& spec, const CastOptions& options = {}) {
    return castRays(DrawnVolume(volume, grid), spec, options);
}

/// The same by stepping from voxel to voxel, without skipping. Slow; castRays() is tested against it.
[[nodiscard]] Result<Frame> castRaysReference(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                              const CastOptions& options = {});
[[nodiscard]] inline Result<Frame> castRaysReference(const volume::BrickVolume& volume, const volume::Grid& grid,
                                                     const FrameSpec& spec, const CastOptions& options = {}) {
    const DrawnVolume drawn(volume, grid);
    return castRaysReference(std::span(&drawn, 1), spec, options);
}

/// Level of detail for a frame of a volume on `grid`: the coarsest one whose cells are at most half a pixel wide
/// wherever the volume is seen, so that distant parts do not alias. 0, the volume itself, if a pixel is narrower than 4
/// voxels or the eye is inside. At most `coarsest`.
[[nodiscard]] int levelForView(const FrameSpec& spec, const volume::Grid& grid, int coarsest = 6);

}  // namespace svt::render
