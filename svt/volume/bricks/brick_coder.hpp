#pragma once
/// \file
/// Finds planes that say the same as the voxels of a brick. Internal to volume.

#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace svt::volume {

/// The distinct scalars of a brick, and the bit planes of its palette indices: bit i + 8 j of word 8 p + k.
struct BrickPattern {
    std::vector<Scalar> palette;
    std::vector<std::uint64_t> planes;
};

/// How sides of cuts and planes stand for a brick's voxels; see BrickVolume::Coding.
struct BrickCode {
    std::array<std::uint8_t, 3> cut{};
    std::array<std::uint32_t, BrickVolume::kMostPlanes> plane{BrickVolume::kNoPlane, BrickVolume::kNoPlane,
                                                              BrickVolume::kNoPlane};
    std::vector<Scalar> cells;
    friend bool operator==(const BrickCode&, const BrickCode&) = default;
};

/// Which voxels of a brick lie on the positive side of something: bit i + 8 j of word k.
using SideMask = std::array<std::uint64_t, 8>;

/// By axis: voxels that differ from the next one along it.
using Changes = std::array<SideMask, 3>;

/// A side, and where it changes.
struct BrickSide {
    explicit BrickSide(const SideMask& sideMask) noexcept;
    SideMask mask;
    Changes changes{};
};

/// Where the labels of `pattern` change.
[[nodiscard]] Changes changesOf(const BrickPattern& pattern) noexcept;

/// Codes `pattern` by the sides of planes and at most one cut across each axis, if that is possible.
/// \param changes  changesOf(pattern)
/// \param planes   at most BrickVolume::kMostPlanes
[[nodiscard]] std::optional<BrickCode> codeBySides(const BrickPattern& pattern, const Changes& changes,
                                                   std::initializer_list<const BrickSide*> planes = {});

/// One tile's bricks by place, each a number of `patterns` or kUniform.
struct TilePlaces {
    Vec3i origin;  ///< of the tile, voxels
    Vec3i count;   ///< bricks
    static constexpr std::uint32_t kUniform = 0xFFFFFFFFu;
    std::vector<std::uint32_t> patternOf;  ///< x fastest, then y, then z
    std::vector<Scalar> scalarOf;          ///< of the uniform ones

    [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
        return static_cast<std::size_t>(x + count.x * (y + count.y * z));
    }
};

/// A brick that got general planes. They are numbers of TileCodes::planes.
struct PlacedCode {
    std::uint32_t place = 0;
    BrickCode code;
};

/// What cuts alone can say of a pattern.
enum class PatternKind : std::uint8_t {
    Uncoded,
    Coded,
    Step  ///< coded, but as well a surface that rises by a voxel: planes are tried first
};

struct TileCodes {
    std::vector<BrickPlane> planes;
    std::vector<PlacedCode> codes;  ///< by place, ascending
};

/// Codes what is not coded yet by planes: first those that the model's faces are known to lie on, alone, in pairs and
/// by threes, then planes fitted to the voxels around.
///
/// Where a brick of two labels is a surface over one of the axes, its plane is that of least squares through the
/// surface in the brick and its neighbors, moved as little as its own voxels ask for; a neighbor's plane is taken
/// first, so that a roof has one plane. Where surfaces meet, the planes of the bricks around are tried in the same way
/// as the model's. Uniform bricks beside a sloped surface get its plane where that cuts their rim, the half voxel
/// outside of their samples. Every code is checked sample by sample; what has none stays a pattern.
/// \param isCoded  by pattern: a PatternKind
/// \param faces    what faces of the model lie on in the tile; none where they are not known
[[nodiscard]] TileCodes codeTile(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
                                 const std::vector<std::uint8_t>& isCoded, std::span<const FacePlane> faces);

}  // namespace svt::volume
