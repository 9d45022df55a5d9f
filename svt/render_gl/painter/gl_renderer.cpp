#include <svt/render_gl/gl_renderer.hpp>

#include <svt/image/color.hpp>
#include <svt/render/camera_rays.hpp>
#include <svt/render_gl/painter/frame_painter.hpp>
#include <svt/render_gl/painter/pass_textures.hpp>
#include <svt/render_gl/painter/volume_textures.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::render_gl {
namespace {

/// Restores the framebuffer bindings at the end of its scope.
class FramebufferGuard {
public:
    FramebufferGuard() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    }
    FramebufferGuard(const FramebufferGuard&) = delete;
    FramebufferGuard& operator=(const FramebufferGuard&) = delete;
    ~FramebufferGuard() {
        bindDraw();
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    }
    void bindDraw() const { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_)); }

private:
    GLint draw_ = 0, read_ = 0;
};

Result<void> checkOptions(const GlOptions& options) {
    if (options.opaqueAt > 0 && options.opaqueAt <= 1 && options.labelAt >= 0 && options.labelAt < 1) return {};
    return Error(Code::BadArgument, fmt::format("opaqueAt of {} or labelAt of {} is out of range; (0, 1] and [0, 1) "
                                                "are possible",
                                                options.opaqueAt, options.labelAt));
}

// Calls body(tile) for the tiles of a picture, rows from the top.
template <class Body>
Result<void> forTiles(const render::FrameSpec& spec, std::int32_t size, const Body& body) {
    for (std::int32_t y = 0; y < spec.height; y += size)
        for (std::int32_t x = 0; x < spec.width; x += size) {
            const PixelTile tile{x, y, std::min(size, spec.width - x), std::min(size, spec.height - y)};
            SVT_DO(body(tile));
        }
    return {};
}

// Reads a tile of the bound framebuffer into the picture, flipping its rows.
void readPixels(const PixelTile& tile, image::Image<image::Rgba8>& color) {
    std::vector<image::Rgba8> rows(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height));
    glReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    for (std::int32_t y = 0; y < tile.height; ++y)
        std::copy_n(rows.begin() + std::ptrdiff_t{tile.height - 1 - y} * tile.width, tile.width,
                    &color.at(tile.x, tile.y + y));
}

}  // namespace

struct GlRenderer::Parts {
    const volume::BrickVolume& volume;
    const volume::Grid& grid;
    GlOptions options;
    GlLimits limits;
    VolumeTextures textures;
    FramePainter painter;
    Texture pixels{};
    Target pixelTarget{};

    Result<void> prepare(const render::FrameSpec& spec) {
        SVT_DO(checkFrameSpec(spec));
        clearGlErrors();
        return painter.prepare({spec, volume, grid, textures, limits, options});
    }

    Result<void> readTiles(const render::FrameSpec& spec, render::Frame& frame, bool withLabels) {
        SVT_DO(prepare(spec));
        frame.color = image::Image<image::Rgba8>(spec.width, spec.height);
        if (withLabels) {
            frame.label = image::Image<volume::Scalar>(spec.width, spec.height);
            frame.depth = image::Image<float>(spec.width, spec.height);
        }
        return forTiles(spec, painter.tilePixels(), [&](const PixelTile& tile) -> Result<void> {
            painter.castSamples(tile);
            pixels.setTarget(GL_RGBA8, tile.width, tile.height);
            pixelTarget.bind({pixels.name()});
            painter.resolve(tile, tile);
            readPixels(tile, frame.color);
            if (withLabels) {
                painter.readCenters(tile, [&](std::int32_t x, std::int32_t y, const PickedPixel& hit) {
                    frame.label.at(tile.x + x, tile.y + y) = hit.label;
                    frame.depth.at(tile.x + x, tile.y + y) = hit.depth;
                });
            }
            return checkGl("the picture");
        });
    }
};

GlRenderer::GlRenderer(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
GlRenderer::GlRenderer(GlRenderer&&) noexcept = default;
GlRenderer& GlRenderer::operator=(GlRenderer&&) noexcept = default;
GlRenderer::~GlRenderer() = default;

Result<GlRenderer> GlRenderer::make(const volume::BrickVolume& volume, const volume::Grid& grid,
                                    const GlOptions& options) {
    if (volume.dimension() != grid.dimension())
        return Error(Code::BadArgument, "the grid and the volume have different dimensions");
    SVT_DO(checkOptions(options));
    SVT_TRY(limits, glLimits());
    SVT_TRY(textures, VolumeTextures::make(volume, *limits));
    return GlRenderer(
        std::unique_ptr<Parts>(new Parts{volume, grid, options, *limits, std::move(*textures), FramePainter()}));
}

Result<void> GlRenderer::draw(const render::FrameSpec& spec) {
    const std::int32_t most = parts_->limits.textureSize;
    if (spec.width > most || spec.height > most)
        return Error(Code::BadFrame, fmt::format("a picture of {} x {} pixels is larger than a framebuffer of this "
                                                 "graphics driver, {} pixels; draw a smaller one",
                                                 spec.width, spec.height, most));
    const FramebufferGuard bindings;
    SVT_DO(parts_->prepare(spec));
    FramePainter& painter = parts_->painter;
    auto drawn = forTiles(spec, painter.tilePixels(), [&](const PixelTile& tile) -> Result<void> {
        painter.castSamples(tile);
        bindings.bindDraw();
        painter.resolve(tile, PixelTile{0, 0, spec.width, spec.height});
        return {};
    });
    if (!drawn) return drawn;
    return checkGl("the picture");
}

Result<render::Frame> GlRenderer::read(const render::FrameSpec& spec) {
    render::Frame frame;
    const FramebufferGuard bindings;
    SVT_DO(parts_->readTiles(spec, frame, true));
    return frame;
}

Result<image::Image<image::Rgba8>> GlRenderer::readColor(const render::FrameSpec& spec) {
    render::Frame frame;
    const FramebufferGuard bindings;
    SVT_DO(parts_->readTiles(spec, frame, false));
    return std::move(frame.color);
}

Result<PickedPixel> GlRenderer::pick(const render::FrameSpec& spec, std::int32_t x, std::int32_t y) {
    if (x < 0 || y < 0 || x >= spec.width || y >= spec.height)
        return Error(Code::BadArgument,
                     fmt::format("pixel ({}, {}) lies outside of a picture of {} x {}", x, y, spec.width, spec.height));
    const FramebufferGuard bindings;
    SVT_DO(parts_->prepare(spec));
    PickedPixel picked;
    parts_->painter.pick({x, y, 1, 1}, [&](std::int32_t, std::int32_t, const PickedPixel& hit) { picked = hit; });
    SVT_DO(checkGl("the picked pixel"));
    return picked;
}

std::size_t GlRenderer::sizeBytes() const noexcept { return parts_->textures.sizeBytes; }

}  // namespace svt::render_gl
