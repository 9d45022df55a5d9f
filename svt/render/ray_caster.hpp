#pragma once
/// \file
/// Ray caster on the CPU. Exact: a ray is a list of runs (scalar, from, to), found by stepping from label to label,
/// with no step size and no filtering of labels. The reference for every other renderer.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/image/image.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <span>

namespace svt::render {

struct CastOptions {
    int threads = 0;          ///< 0: all cores; the picture does not depend on it
    float opaqueAt = 0.999f;  ///< a ray ends at this opacity, in (0, 1]
    float labelAt = 0;        ///< label and depth are of the first run after which the ray's opacity is above this, in
                              ///< [0, 1): 0 = the first visible label, 0.5 = looks through ghosts
    /// With several samples per pixel: whether a pixel gets them only where it differs from one of its eight neighbours
    /// in label, depth, normal or colour. Not where voxels of the far side are smaller than a pixel: what is thin would
    /// be missed between the middles of pixels that see the same. So only the tips of what is seen edge-on may be.
    bool isAdaptive = false;
    const Progress* progress = nullptr;  ///< may cancel; told nothing
};

/// One picture. Row 0 is the top; all three have spec.width x spec.height pixels.
struct Frame {
    image::Image<image::Rgba8> color;    ///< sRGB, alpha not premultiplied
    image::Image<volume::Scalar> label;  ///< by the ray through the pixel's centre; 0 where it met nothing
    image::Image<float> depth;  ///< metres along the view direction to where that label begins; +inf where nothing
};

/// A form of a semantic volume that passes may draw: the volume itself, a level of it, or its shell. All forms have the
/// scalars of the volume, so one table of styles holds for each. What it is made of must outlive it.
class DrawnVolume {
public:
    /// \param grid  where the samples of `bricks` lie; its dimension must be that of `bricks`
    DrawnVolume(const volume::BrickVolume& bricks, const volume::Grid& grid) : bricks_(&bricks), grid_(&grid) {}
    /// A coarse level.
    ///
    /// A cell has the extinction and colour of its labels, each weighted by coverage (Al-Thelaya 2020); an opaque label
    /// stops 99 % of the light on the length of one fine voxel, so a wall one voxel thick stays nearly opaque at each
    /// level. A cell that opaque labels cover by half or more is a surface. Frame::label has the most frequent visible
    /// label of the cell.
    DrawnVolume(const volume::LodLevel& level) : bricks_(&level.bricks), grid_(&level.grid), level_(&level) {}

    [[nodiscard]] const volume::BrickVolume& bricks() const noexcept { return *bricks_; }
    [[nodiscard]] const volume::Grid& grid() const noexcept { return *grid_; }
    [[nodiscard]] const volume::LodLevel* level() const noexcept { return level_; }  ///< null: as fine as it is

private:
    const volume::BrickVolume* bricks_;
    const volume::Grid* grid_;
    const volume::LodLevel* level_ = nullptr;
};

/// Draws `volumes` as `spec` says; Pass::volume tells which of them a pass draws.
///
/// A voxel is the box of half a spacing around its sample. Per pass, the ray is cut to the volume's voxels and by the
/// clips, then taken apart into runs of one scalar:
///   - opacity 1: an opaque surface where the run begins, lit by its normal;
///   - opacity o in (0, 1): stops 1 - (1 - o)^length of the light on its length in metres (Beer-Lambert), whatever the
///     voxel size. Its colour is lit half as strongly as a surface where it begins, so bodies of glass have a shape;
///   - opacity 0: nothing.
/// Normals come from the voxels around (opaque ones for a surface, the same object's for glass), on a cut face from its
/// plane; a cut face shows the label that it cuts. Lit and blended in linear light; passes are joined as Pass::Join
/// says, all over the background.
///
/// \return the frame, or
///         - BadFrame, BadCamera   see checkFrameSpec(); a pass draws a volume that is not there
///         - BadArgument           no volume, a grid that is not the volume's, or an option out of range
///         - Cancelled
/// Cost: O(pixels * samples * passes * same-label stretches crossed), and per pass with ambient occlusion O(bricks).
/// Threads: reads only; several frames may be cast at once. The same bytes for any number of threads.
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

/// The same from voxel to voxel, with no skipping. Slow; what castRays() is tested against.
[[nodiscard]] Result<Frame> castRaysReference(std::span<const DrawnVolume> volumes, const FrameSpec& spec,
                                              const CastOptions& options = {});
[[nodiscard]] inline Result<Frame> castRaysReference(const volume::BrickVolume& volume, const volume::Grid& grid,
                                                     const FrameSpec& spec, const CastOptions& options = {}) {
    const DrawnVolume drawn(volume, grid);
    return castRaysReference(std::span(&drawn, 1), spec, options);
}

/// Level of detail for a picture of a volume on `grid`: the coarsest whose cells are at most half a pixel wide wherever
/// the volume is seen, so that what is far away does not alias; 0 = the volume itself, where pixels are finer than 4
/// voxels or the eye is in it. At most `coarsest`.
[[nodiscard]] int levelForView(const FrameSpec& spec, const volume::Grid& grid, int coarsest = 6);

}  // namespace svt::render
