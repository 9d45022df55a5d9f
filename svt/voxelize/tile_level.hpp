#pragma once
/// \file
/// Planes over the columns of one tile, as heights in samples.

#include <svt/voxelize/scan.hpp>

#include <cstdint>

namespace svt::voxelize {

/// First sample above (x, y) of the tile: (base + slopeX x + slopeY y) >> kBits, kept within [lowest, highest].
/// Faces of one level are met at the same height everywhere.
struct TileLevel {
    static constexpr int kBits = Height::kBits + kQuantaBits;
    std::int64_t base = 0, slopeX = 0, slopeY = 0;
    std::int32_t lowest = 0, highest = 0;  ///< within [0, depth]

    [[nodiscard]] bool isFlat() const noexcept { return slopeX == 0 && slopeY == 0; }
    [[nodiscard]] std::int32_t clamped(std::int64_t height) const noexcept {
        const std::int64_t k = height >> kBits;
        return static_cast<std::int32_t>(k < lowest ? lowest : k > highest ? highest : k);
    }
    /// First sample above, 0 to depth.
    [[nodiscard]] std::int32_t sampleAbove(std::int32_t x, std::int32_t y) const noexcept {
        return clamped(base + slopeX * x + slopeY * y);
    }
    friend bool operator==(const TileLevel&, const TileLevel&) = default;
};

/// Columns side by side along x, or rows along y.
struct TileLine {
    std::int32_t x = 0, y = 0, count = 1;
    bool isAlongX = true;
};

}  // namespace svt::voxelize
