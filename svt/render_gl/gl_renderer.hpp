#pragma once
/// \file
/// Draws frames on OpenGL ES 3.0 or WebGL2, as render::castRays() does on the CPU.

#include <svt/core/result.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace svt::render_gl {

struct GlOptions {
    int threads = 0;          ///< for what the CPU prepares; 0: all cores
    float opaqueAt = 0.999f;  ///< a ray ends at this opacity, in (0, 1]
    float labelAt = 0;        ///< see render::CastOptions::labelAt, in [0, 1)
};

/// What one pixel shows.
struct PickedPixel {
    volume::Scalar label = 0;  ///< 0 where the ray through the pixel's middle meets nothing
    float depth = 0;           ///< metres along the view direction; +inf where nothing
};

/// A volume on the graphics card, and pictures of it.
///
/// All calls, the destructor too, need the context current in which make() was called. They change the context's
/// program, textures, vertex array, viewport and scissor, and leave blending, depth and stencil tests switched off;
/// framebuffer bindings are as before.
///
/// The picture is that of render::castRays() with the same options: labels but for pixels whose ray passes within
/// 1e-3 voxel of an edge (floats against doubles; volumes of up to some 5,000 voxels along a side), colours within 3 of
/// 255. What a ray meets twice, once in draw() and once in pick(), is the same.
class GlRenderer {
public:
    /// Uploads the bricks, as they are.
    /// \param volume, grid  must outlive the renderer
    /// \return the renderer, or
    ///         - NoGraphics    no context of OpenGL ES 3.0 is current, or its memory is too small
    ///         - GridTooLarge  an array of the volume is larger than a texture
    ///         - BadArgument   the grid is not the volume's, or an option is out of range
    /// Cost: the bytes of the bricks. Shaders are made when a frame first needs them, see README.md.
    [[nodiscard]] static Result<GlRenderer> make(const volume::BrickVolume& volume, const volume::Grid& grid,
                                                 const GlOptions& options = {});
    GlRenderer(GlRenderer&&) noexcept;
    GlRenderer& operator=(GlRenderer&&) noexcept;
    ~GlRenderer();

    /// Draws into the lower left spec.width x spec.height pixels of the current framebuffer: sRGB, alpha not
    /// premultiplied. What stood there before is overwritten.
    /// \return nothing; BadFrame or BadCamera as render::checkFrameSpec(), BadFrame where a framebuffer of this driver
    /// is
    ///         smaller than the picture, NoGraphics where the driver fails
    /// Cost: O(pixels * samples * passes * same-label stretches). Uploaded is only what differs from the frame before:
    /// a camera nothing but numbers, a style or a clip its small table and, with ambient occlusion, coverage by brick.
    [[nodiscard]] Result<void> draw(const render::FrameSpec& spec);

    /// Draws apart from any framebuffer, and reads color, labels and depths.
    /// \return as draw()
    [[nodiscard]] Result<render::Frame> read(const render::FrameSpec& spec);

    /// The picture alone. \return as draw()
    [[nodiscard]] Result<image::Image<image::Rgba8>> readColor(const render::FrameSpec& spec);

    /// What the picture of `spec` shows at pixel (x, y), y from the top; casts that one ray.
    /// \return the label and depth; as draw(), and BadArgument where the pixel lies outside
    [[nodiscard]] Result<PickedPixel> pick(const render::FrameSpec& spec, std::int32_t x, std::int32_t y);

    /// Bytes of the volume's textures.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

private:
    struct Parts;
    explicit GlRenderer(std::unique_ptr<Parts> parts) noexcept;

    std::unique_ptr<Parts> parts_;
};

}  // namespace svt::render_gl
