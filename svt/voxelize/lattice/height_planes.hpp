#pragma once
/// \file
/// A height plane is the height function of a plane: for each column (i, j) the first sample above it, in fixed point.
/// Faces of one height plane are crossed at the same sample everywhere, whichever object they belong to.

#include <svt/voxelize/lattice/scan.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::voxelize {

/// First sample above the plane at (i, j): (base + slopeX i + slopeY j) >> kBits, clamped to [lowest, highest].
struct HeightPlane {
    static constexpr int kBits = Height::kBits + kQuantaBits;
    std::int64_t base = 0, slopeX = 0, slopeY = 0;
    std::int32_t lowest = 0, highest = 0;  ///< within [0, depth]

    HeightPlane() = default;
    HeightPlane(const FaceHeight& face, std::int32_t depth) noexcept;

    [[nodiscard]] std::int32_t clamped(std::int64_t height) const noexcept {
        const std::int64_t k = height >> kBits;
        return static_cast<std::int32_t>(k < lowest ? lowest : k > highest ? highest : k);
    }
    [[nodiscard]] bool isFlat() const noexcept { return slopeX == 0 && slopeY == 0; }
    /// First sample above the plane, 0 to depth.
    [[nodiscard]] std::int32_t sampleAbove(std::int32_t i, std::int32_t j) const noexcept {
        return clamped(base + slopeX * i + slopeY * j);
    }
};

/// Height planes of a grid by number. Numbers 0 to depth are flat height planes, each directly below the sample with
/// its number. Numbers from `first` on are sloped height planes.
struct HeightPlanes {
    std::int32_t depth = 0;
    std::uint32_t first = 0;
    std::vector<HeightPlane> sloped;

    [[nodiscard]] bool isSloped(std::uint32_t number) const noexcept {
        return number > static_cast<std::uint32_t>(depth);
    }
    /// The sloped height plane with this number.
    [[nodiscard]] const HeightPlane& operator[](std::uint32_t number) const noexcept { return sloped[number - first]; }
    /// Number of a height plane. A sloped height plane is appended.
    std::uint32_t add(const HeightPlane& heightPlane);
    /// Like add(), but stores a sloped height plane in the reserved entry `sloped[place]`; a flat height plane leaves
    /// it unused.
    std::uint32_t put(std::size_t place, const HeightPlane& heightPlane) noexcept;
    [[nodiscard]] std::uint32_t next() const noexcept { return first + static_cast<std::uint32_t>(sloped.size()); }
};

/// Marks a plane that is too steep to have a height plane.
inline constexpr std::uint32_t kNoHeightPlane = 0xFFFFFFFFu;

/// A face of an object at a height plane. Where an upward line passes it, the winding number of the claim changes by
/// one: +1 for an entry, -1 for an exit.
struct Boundary {
    std::uint32_t heightPlane = 0;
    std::uint32_t claim = 0;  ///< below 2^30
    bool isEntry = false;

    [[nodiscard]] std::uint64_t packed() const noexcept {
        return std::uint64_t(heightPlane) << 32 | std::uint64_t(claim) << 1 | std::uint64_t(isEntry);
    }
    [[nodiscard]] static Boundary unpack(std::uint64_t packed) noexcept {
        return {static_cast<std::uint32_t>(packed >> 32), static_cast<std::uint32_t>(packed & 0xFFFFFFFFu) >> 1,
                (packed & 1) != 0};
    }
};

}  // namespace svt::voxelize
