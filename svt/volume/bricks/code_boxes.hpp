#pragma once
/// \file
/// Merges coded bricks into boxes that share one code.

#include <svt/volume/bricks/brick_coder.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::volume {

/// A code for a box of bricks. Unlike in BrickCode, cuts are counted in voxels from the corner of the volume.
struct BoxCode {
    std::array<std::int32_t, 3> cut{kNoCut, kNoCut, kNoCut};
    std::array<std::uint32_t, BrickVolume::kMaxPlanes> plane{BrickVolume::kNoPlane, BrickVolume::kNoPlane,
                                                             BrickVolume::kNoPlane};
    std::array<std::uint32_t, 3> cutPlane{BrickVolume::kNoPlane, BrickVolume::kNoPlane, BrickVolume::kNoPlane};
    std::vector<Scalar> sideScalars;
    static constexpr std::int32_t kNoCut = -1;
    friend bool operator==(const BoxCode&, const BoxCode&) = default;
};

/// Bricks [min, max) of a tile, and the index of their code.
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

/// Covers the coded bricks of a tile with boxes, greedily: each box is grown from the first brick without a box, along
/// x, then y, then z, over all bricks for which its code gives the same labels as their own: coded bricks that its
/// sides cut, and uniform bricks beside them. Boxes may overlap; a budget of tests bounds the cost: when it is spent, boxes
/// grow only by layers that have a coded brick without a box.
/// \param codeIndex  by place: index in `codes`, or TileBoxes::kNone
[[nodiscard]] TileBoxes findCodeBoxes(const TilePlaces& places, const std::vector<std::uint32_t>& codeIndex,
                                      const std::vector<BrickCode>& codes, const std::vector<BrickPlane>& planes);

}  // namespace svt::volume
