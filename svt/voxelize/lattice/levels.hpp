#pragma once
/// \file
/// Levels: the heights at which lines along z meet a plane. Faces of one level are met at the same sample everywhere,
/// whichever object they belong to.

#include <svt/voxelize/lattice/scan.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::voxelize {

/// First sample above (i, j): (base + slopeX i + slopeY j) >> kBits, kept within [lowest, highest].
struct Level {
    static constexpr int kBits = Height::kBits + kQuantaBits;
    std::int64_t base = 0, slopeX = 0, slopeY = 0;
    std::int32_t lowest = 0, highest = 0;  ///< within [0, depth]

    Level() = default;
    Level(const FaceHeight& face, std::int32_t depth) noexcept;

    [[nodiscard]] std::int32_t clamped(std::int64_t height) const noexcept {
        const std::int64_t k = height >> kBits;
        return static_cast<std::int32_t>(k < lowest ? lowest : k > highest ? highest : k);
    }
    [[nodiscard]] bool isFlat() const noexcept { return slopeX == 0 && slopeY == 0; }
    /// First sample above, 0 to depth.
    [[nodiscard]] std::int32_t sampleAbove(std::int32_t i, std::int32_t j) const noexcept {
        return clamped(base + slopeX * i + slopeY * j);
    }
};

/// Levels of a grid by number: 0 to depth are the flat ones below these samples, sloped ones follow from `first` on.
struct LevelTable {
    std::int32_t depth = 0;
    std::uint32_t first = 0;
    std::vector<Level> sloped;

    [[nodiscard]] bool isSloped(std::uint32_t number) const noexcept {
        return number > static_cast<std::uint32_t>(depth);
    }
    /// Of a sloped level.
    [[nodiscard]] const Level& operator[](std::uint32_t number) const noexcept { return sloped[number - first]; }
    /// Number of a level; a new one where it slopes.
    std::uint32_t add(const Level& level);
    /// The same with a place in `sloped` that is kept for it; left unused where it does not slope.
    std::uint32_t put(std::size_t place, const Level& level) noexcept;
    [[nodiscard]] std::uint32_t next() const noexcept { return first + static_cast<std::uint32_t>(sloped.size()); }
};

/// Stands for a level of planes that are too steep for one.
inline constexpr std::uint32_t kNoLevel = 0xFFFFFFFFu;

/// What bounds a claim at a level: its winding changes by one where a line passes it upwards.
struct Boundary {
    std::uint32_t level = 0;
    std::uint32_t claim = 0;  ///< below 2^30
    bool isEntry = false;

    [[nodiscard]] std::uint64_t packed() const noexcept {
        return std::uint64_t(level) << 32 | std::uint64_t(claim) << 1 | std::uint64_t(isEntry);
    }
    [[nodiscard]] static Boundary unpack(std::uint64_t packed) noexcept {
        return {static_cast<std::uint32_t>(packed >> 32), static_cast<std::uint32_t>(packed & 0xFFFFFFFFu) >> 1,
                (packed & 1) != 0};
    }
};

}  // namespace svt::voxelize
