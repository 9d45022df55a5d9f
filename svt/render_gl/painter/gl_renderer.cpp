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
            if (auto done = body(tile); !done) return done;
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
        if (auto checked = checkFrameSpec(spec); !checked) return checked;
        clearGlErrors();
        return painter.prepare({spec, volume, grid, textures, limits, options});
    }

    Result<void> readTiles(const render::FrameSpec& spec, render::Frame& frame, bool withLabels) {
        if (auto prepared = prepare(spec); !prepared) return prepared;
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
        return Error(Code::BadArgument, "the grid's dimension is not the volume's");
    if (auto checked = checkOptions(options); !checked) return checked.error();
    const auto limits = glLimits();
    if (!limits) return limits.error();
    auto textures = VolumeTextures::make(volume, *limits);
    if (!textures) return textures.error();
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
    if (auto prepared = parts_->prepare(spec); !prepared) return prepared;
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
    if (auto drawn = parts_->readTiles(spec, frame, true); !drawn) return drawn.error();
    return frame;
}

Result<image::Image<image::Rgba8>> GlRenderer::readColor(const render::FrameSpec& spec) {
    render::Frame frame;
    const FramebufferGuard bindings;
    if (auto drawn = parts_->readTiles(spec, frame, false); !drawn) return drawn.error();
    return std::move(frame.color);
}

Result<PickedPixel> GlRenderer::pick(const render::FrameSpec& spec, std::int32_t x, std::int32_t y) {
    if (x < 0 || y < 0 || x >= spec.width || y >= spec.height)
        return Error(Code::BadArgument,
                     fmt::format("pixel ({}, {}) lies outside of a picture of {} x {}", x, y, spec.width, spec.height));
    const FramebufferGuard bindings;
    if (auto prepared = parts_->prepare(spec); !prepared) return prepared.error();
    PickedPixel picked;
    parts_->painter.pick({x, y, 1, 1}, [&](std::int32_t, std::int32_t, const PickedPixel& hit) { picked = hit; });
    if (auto checked = checkGl("the picked pixel"); !checked) return checked.error();
    return picked;
}

std::size_t GlRenderer::sizeBytes() const noexcept { return parts_->textures.sizeBytes; }

}  // namespace svt::render_gl
