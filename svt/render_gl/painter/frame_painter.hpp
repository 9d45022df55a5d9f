#pragma once
/// \file
/// Casts the samples of a frame tile by tile, and resolves them to pixels.

#include <svt/render/frame_spec.hpp>
#include <svt/render_gl/gl_renderer.hpp>
#include <svt/render_gl/painter/gl_objects.hpp>
#include <svt/render_gl/painter/pass_textures.hpp>
#include <svt/render_gl/painter/volume_textures.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace svt::render_gl {

/// A rectangle of the picture, pixels; y from the top.
struct PixelTile {
    std::int32_t x = 0, y = 0, width = 0, height = 0;
};

/// Inputs of a frame.
struct FrameParts {
    const render::FrameSpec& spec;
    const volume::BrickVolume& volume;
    const volume::Grid& grid;
    const VolumeTextures& textures;
    const GlLimits& limits;
    const GlOptions& options;
};

/// Draws frames; keeps programs, tables and render targets between them.
class FramePainter {
public:
    /// Must be called before the first tile of a frame; `parts` must live until its last one.
    [[nodiscard]] Result<void> prepare(const FrameParts& parts);
    /// Side of the largest tile whose samples fit the targets, pixels.
    [[nodiscard]] std::int32_t tilePixels() const noexcept;

    /// Casts the samples of a tile, and those in the margin around it that border lines need.
    void castSamples(const PixelTile& tile);
    /// Resolves the samples cast last to the pixels of `tile`, in the bound framebuffer, which covers `window`.
    void resolve(const PixelTile& tile, const PixelTile& window);
    /// Receives label and depth of the ray through a pixel's centre; x and y are relative to the tile's upper left.
    using HitCallback = std::function<void(std::int32_t, std::int32_t, const PickedPixel&)>;
    /// Reads the hits of the tile whose samples were cast last.
    void readCenters(const PixelTile& tile, const HitCallback& taken);
    /// Casts and reads the hits of any tile.
    void pick(const PixelTile& tile, const HitCallback& taken);

private:
    // Features that the shader of a pass needs, as bits.
    enum Needs : unsigned {
        kClips = 1,
        kTranslucent = 2,
        kFitted = 4,
        kHatches = 8,
        kShapes = 16,
        kTriangles = 32,
        kNeeds = 64
    };
    struct SampleGrid {
        double firstX, firstY;  // samples from the picture's upper left corner
        int side;               // samples along a pixel
        std::int32_t width, height;
    };

    [[nodiscard]] unsigned needsOf(const PassTextures& pass) const;
    [[nodiscard]] Result<void> prepareCast(unsigned needs);
    [[nodiscard]] Result<void> prepareResolve();
    void castGrid(const SampleGrid& grid);
    void readHits(std::int32_t first, const PixelTile& tile, const HitCallback& taken);
    void scissorTo(const SampleGrid& samples) const;
    void setView(Program& program) const;
    void setHatches(Program& program, int side) const;

    std::optional<FrameParts> parts_;
    std::vector<PassTextures> passes_;
    std::vector<unsigned> passNeeds_;
    std::array<std::optional<Program>, kNeeds> cast_;
    std::array<std::optional<Program>, 2> resolve_;  // without and with border lines
    // Two sets of targets (ping-pong): a pass reads what the one before has written.
    std::array<Texture, 2> color_, hit_;
    std::array<Target, 2> targets_;
    std::size_t last_ = 0;  // the set written last
    int side_ = 1;
    std::int32_t lineReach_ = 1, cutReach_ = 1, margin_ = 0;  // samples, as in render::SampleLayout
};

}  // namespace svt::render_gl
