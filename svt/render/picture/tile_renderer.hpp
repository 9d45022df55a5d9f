#pragma once
/// \file
/// Renders one tile of the picture: samples, border lines, pixels.

#include <svt/image/color.hpp>
#include <svt/render/packet/packet_caster.hpp>
#include <svt/render/plain/point_caster.hpp>
#include <svt/render/ray_caster.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace svt::render {

inline constexpr std::int32_t kTilePixels = 32;

/// Numbers of samples in a tile and in the margin around it.
struct SampleLayout {
    std::int32_t side;                 ///< samples per pixel along one axis
    std::int32_t lineReach, cutReach;  ///< half widths of border lines, samples; cutReach: around caps
    std::int32_t margin;               ///< samples around the tile
    std::int32_t pixelMargin;          ///< pixels around the tile whose centres are cast in adaptive sampling

    explicit SampleLayout(const FrameSpec& spec);
    /// Distance from the start of the first block of rays to the tile, pixels.
    [[nodiscard]] double blockMargin(bool isAdaptive) const noexcept {
        return isAdaptive && side > 1 ? double(pixelMargin) : double(margin) / side;
    }
};

/// Renders tiles; keeps its buffers between them. Not thread-safe: one per thread.
class TileRenderer {
public:
    /// \param packets  null: rays are cast one by one
    /// \param caster   of single rays; null with packets
    TileRenderer(const PreparedFrame& frame, const PacketPasses* packets, std::unique_ptr<PointCaster> caster,
                 Frame& picture);

    /// Renders the tile whose first pixel is (x, y), and writes its pixels of the picture only.
    void render(std::int32_t x, std::int32_t y);

private:
    void castSamples();
    void castPackets();
    void castAdaptively();
    void castPixels();
    // A regular grid of rays; coordinates are in samples, relative to the tile.
    struct RayGrid {
        double first, step;  // the same along both axes
        std::int32_t width, height, stride;
    };
    void castGrid(const RayGrid& grid, std::vector<Sample>& samples);
    [[nodiscard]] bool needsSamples(std::int32_t x, std::int32_t y) const;
    [[nodiscard]] bool looksOther(const Sample& sample, const Sample& other, Vec3d aside) const;
    void castCenters();
    void findLines();
    [[nodiscard]] float lineOn(const Sample& sample, std::int32_t x, std::int32_t y) const;
    [[nodiscard]] std::int32_t reachBetween(const Sample& sample, const Sample& other) const noexcept;
    [[nodiscard]] float lineBetween(const Sample& sample, const Sample& other, Vec3d aside, bool isFirst) const;
    void writePixels();
    void fillBackground();
    /// Background in row y of the tile, linear light.
    [[nodiscard]] Vec3f backgroundOf(std::int32_t y) const noexcept;
    struct PixelLight {
        Vec3f color;  ///< premultiplied
        float alpha;
    };
    /// Light of one sample, with its border line.
    [[nodiscard]] PixelLight lightOf(std::size_t place) const noexcept;
    /// Mean over the samples of pixel (x, y).
    [[nodiscard]] PixelLight lightOf(std::int32_t x, std::int32_t y) const noexcept;
    // The light of a row of pixels.
    struct LightRow {
        std::array<float, kTilePixels> red{}, green{}, blue{}, alpha{};
    };
    void writeColors(std::int32_t y, const LightRow& row) noexcept;

    [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y) const noexcept {
        return static_cast<std::size_t>(x + layout_.margin) +
               static_cast<std::size_t>(stride_) * static_cast<std::size_t>(y + layout_.margin);
    }
    [[nodiscard]] std::size_t middleOf(std::int32_t x, std::int32_t y) const noexcept {
        return static_cast<std::size_t>(x + layout_.pixelMargin) +
               static_cast<std::size_t>(kTilePixels + 2 * layout_.pixelMargin) *
                   static_cast<std::size_t>(y + layout_.pixelMargin);
    }
    [[nodiscard]] double horizontal(double sampleX) const noexcept;
    [[nodiscard]] double vertical(double sampleY) const noexcept;

    const PreparedFrame& frame_;
    Frame& picture_;
    std::unique_ptr<PointCaster> caster_;  // null: packets
    bool isAdaptive_;
    std::optional<PacketCaster> packets_;
    SampleLayout layout_;
    std::int32_t stride_;
    Vec3f backgroundTop_, backgroundBottom_, lineColor_;  // linear light
    const image::SrgbBytes& bytes_ = image::SrgbBytes::table();
    std::int32_t tileX_ = 0, tileY_ = 0, tileWidth_ = 0, tileHeight_ = 0;  // pixels
    std::vector<double> columns_, rows_;                                   // u and v of the rays of a grid, -1..1
    std::vector<Sample> samples_;
    std::vector<Sample> centers_;  // at the centres of the tile's pixels, if no sample is there
    std::vector<Sample> pixels_;   // adaptive: at the centres of the tile's pixels and of those around it
    std::vector<float> lines_;     // by sample: coverage by a border line, 0..1
};

}  // namespace svt::render
