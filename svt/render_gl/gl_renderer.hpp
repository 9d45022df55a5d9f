#pragma once
/// \file
/// Draws frames with OpenGL ES 3.0 or WebGL2, like render::castRays() on the CPU.

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
    int threads = 0;          ///< for preparation on the CPU; 0: all cores
    float opaqueAt = 0.999f;  ///< early ray termination at this opacity, in (0, 1]
    float labelAt = 0;        ///< see render::CastOptions::labelAt, in [0, 1)
};

/// Label and depth of one pixel.
struct PickedPixel {
    volume::Scalar label = 0;  ///< of the ray through the pixel's centre; 0: background
    float depth = 0;           ///< metres along the view direction; +inf: background
};

/// A volume in graphics memory, and a renderer for it.
///
/// All calls, and the destructor, require that the context in which make() was called is current. They change the
/// context's program, textures, vertex array, viewport and scissor, and leave blending, face culling, depth and stencil
/// tests disabled; framebuffer bindings are restored.
///
/// The result is that of render::castRays() with the same options. Labels are equal, except for pixels whose ray passes
/// within 1e-3 voxel of an edge (floats instead of doubles; for volumes of up to about 5,000 voxels along a side).
/// Colours are within 3 of 255. draw() and pick() give the same result for the same ray.
class GlRenderer {
public:
    /// Uploads the bricks, without conversion.
    /// \param volume, grid  must outlive the renderer
    /// \return the renderer, or
    ///         - NoGraphics    no context of OpenGL ES 3.0 is current, or its memory is too small.
    ///         - GridTooLarge  an array of the volume does not fit a texture.
    ///         - BadArgument   the grid is not the volume's, or an option is out of range.
    /// Cost: O(bytes of the bricks). Shaders are compiled when a frame first needs them, see README.md.
    [[nodiscard]] static Result<GlRenderer> make(const volume::BrickVolume& volume, const volume::Grid& grid,
                                                 const GlOptions& options = {});
    GlRenderer(GlRenderer&&) noexcept;
    GlRenderer& operator=(GlRenderer&&) noexcept;
    ~GlRenderer();

    /// Draws into the lower left spec.width x spec.height pixels of the current framebuffer, overwriting them: sRGB,
    /// alpha not premultiplied.
    /// \return nothing; BadFrame or BadCamera as render::checkFrameSpec(); BadFrame if the picture is larger than a
    ///         framebuffer of this driver; NoGraphics if the driver fails
    /// Cost: O(pixels * samples * passes * same-label boxes crossed). Only what differs from the frame before is
    /// uploaded: for a camera, uniforms; for a style or a clip, its small table and, with ambient occlusion, coverage
    /// by brick. Lines and meshes are uploaded with each frame.
    [[nodiscard]] Result<void> draw(const render::FrameSpec& spec);

    /// Draws offscreen, and reads back color, labels and depths.
    /// \return as draw()
    [[nodiscard]] Result<render::Frame> read(const render::FrameSpec& spec);

    /// Draws offscreen, and reads back the color only.
    /// \return the picture; errors as draw()
    [[nodiscard]] Result<image::Image<image::Rgba8>> readColor(const render::FrameSpec& spec);

    /// Label and depth of the frame `spec` at pixel (x, y), y from the top; casts one ray.
    /// \return the label and depth; errors as draw(), and BadArgument if the pixel is outside
    [[nodiscard]] Result<PickedPixel> pick(const render::FrameSpec& spec, std::int32_t x, std::int32_t y);

    /// Bytes of the volume's textures.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

private:
    struct Parts;
    explicit GlRenderer(std::unique_ptr<Parts> parts) noexcept;

    std::unique_ptr<Parts> parts_;
};

}  // namespace svt::render_gl
