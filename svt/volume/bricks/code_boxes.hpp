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

/// Greedily covers the coded bricks of a tile with boxes. Each box starts at the first brick without a box and grows
/// along x, then y, then z. It takes all bricks for which its code gives the same labels as their own: coded bricks
/// that its sides cut, and adjacent uniform bricks. Boxes may overlap. A budget of tests bounds the cost; when it is
/// used up, boxes grow only by layers with a coded brick without a box.
/// \param codeIndex  by place: index in `codes`, or TileBoxes::kNone
[[nodiscard]] TileBoxes findCodeBoxes(const TilePlaces& places, const std::vector<std::uint32_t>& codeIndex,
                                      const std::vector<BrickCode>& codes, const std::vector<BrickPlane>& planes);

}  // namespace svt::volume
