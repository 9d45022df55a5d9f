#pragma once
/// \file
/// Joins coded bricks to boxes that one code describes. Internal to volume.

#include <svt/volume/bricks/brick_coder.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::volume {

/// A code for more than one brick: cuts are planes between voxels of the tile's axes, counted from the volume's corner.
struct BoxCode {
    std::array<std::int32_t, 3> cut{kNoCut, kNoCut, kNoCut};
    std::array<std::uint32_t, BrickVolume::kMostPlanes> plane{BrickVolume::kNoPlane, BrickVolume::kNoPlane,
                                                              BrickVolume::kNoPlane};
    std::vector<Scalar> cells;
    static constexpr std::int32_t kNoCut = -1;
    friend bool operator==(const BoxCode&, const BoxCode&) = default;
};

/// Bricks [min, max) of a tile, and the number of their code.
struct CodeBox {
    Vec3i min, max;
    std::uint32_t code = 0;
};

struct TileBoxes {
    std::vector<BoxCode> codes;
    std::vector<CodeBox> boxes;
    std::vector<std::uint32_t> boxOf;  ///< by place; kNone for bricks that are not coded
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
};

/// Covers the coded bricks of a tile with boxes. Each is grown from the first brick that has none yet, along x, then y,
/// then z, over all bricks of which its code says the same as their own: coded ones that its sides cut, and uniform
/// ones beside them. Boxes may overlap; what that costs is bounded by a budget.
/// \param codeOf  by place: a number of `codes`, or TileBoxes::kNone
[[nodiscard]] TileBoxes findCodeBoxes(const TilePlaces& places, const std::vector<std::uint32_t>& codeOf,
                                      const std::vector<BrickCode>& codes, const std::vector<BrickPlane>& planes);

}  // namespace svt::volume
