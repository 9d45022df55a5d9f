#pragma once
/// \file
/// Casts the samples of a frame, tile by tile, and makes pixels of them. Internal to render_gl.

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

/// Pixels of the picture; y from the top.
struct PixelTile {
    std::int32_t x = 0, y = 0, width = 0, height = 0;
};

/// What a frame is drawn from.
struct FrameParts {
    const render::FrameSpec& spec;
    const volume::BrickVolume& volume;
    const volume::Grid& grid;
    const VolumeTextures& textures;
    const GlLimits& limits;
    const GlOptions& options;
};

/// Keeps programs, tables and targets between frames.
class FramePainter {
public:
    /// Before the first tile of a frame; `parts` must live until its last.
    [[nodiscard]] Result<void> prepare(const FrameParts& parts);
    /// Side of a tile whose samples fit the targets, pixels.
    [[nodiscard]] std::int32_t tilePixels() const noexcept;

    /// Casts the samples of a tile, and those around it that border lines look at.
    void castSamples(const PixelTile& tile);
    /// Makes their pixels, in the bound framebuffer, whose pixels are those of `window`.
    void resolve(const PixelTile& tile, const PixelTile& window);
    /// Labels and depths of what the rays through the middles of pixels see: taken(x, y, hit), from the tile's upper
    /// left corner.
    using TakeHit = std::function<void(std::int32_t, std::int32_t, const PickedPixel&)>;
    /// Of the tile whose samples were cast last.
    void readMiddles(const PixelTile& tile, const TakeHit& taken);
    /// Of any tile.
    void pick(const PixelTile& tile, const TakeHit& taken);

private:
    // What the shader of a pass must be able to do.
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
    void readHits(std::int32_t first, const PixelTile& tile, const TakeHit& taken);
    void scissorTo(const SampleGrid& samples) const;
    void setView(Program& program) const;
    void setHatches(Program& program, int side) const;

    std::optional<FrameParts> parts_;
    std::vector<PassTextures> passes_;
    std::vector<unsigned> passNeeds_;
    std::array<std::optional<Program>, kNeeds> cast_;
    std::array<std::optional<Program>, 2> resolve_;  // without and with border lines
    // Two sets: a pass reads what the one before has written.
    std::array<Texture, 2> color_, hit_;
    std::array<Target, 2> targets_;
    std::size_t last_ = 0;  // the set written last
    int side_ = 1;
    std::int32_t lineReach_ = 1, cutReach_ = 1, margin_ = 0;  // samples, as TileRenderer has them
};

}  // namespace svt::render_gl
