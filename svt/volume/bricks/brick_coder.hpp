#pragma once
/// \file
/// Codes bricks of 8 x 8 x 8 voxels by cuts and planes, exactly: every sample keeps its label.
///
///     j 7   c c c c c c c c         One layer of a brick with three labels, coded by two sides.
///       6   c c c c c c c c
///       5   c c c c c c c c           bit 0 of the sides   cut across y at 5: 1 where j >= 5.
///           ---------------           bit 1                a plane: 1 on its positive side (right).
///       4   a a a a a/b b b
///       3   a a a a/b b b b         2 sides have 2^2 combinations; `sideScalars` has one label per combination.
///       2   a a a/b b b b b
///       1   a a/b b b b b b           sides  0   1   2   3
///       0   a/b b b b b b b           label  a   c   b   c
///           0 1 2 3 4 5 6 7  i
///
/// The ideas (all ours):
/// - A side is a mask of 512 bits: the samples on the positive side of a plane, or beyond a cut. A code is valid if the
///   samples of each side combination have one label, which is tested on the bit planes of the palette by a few AND
///   operations.
/// - The places where labels change from voxel to voxel are a mask, too. Changes along an axis that no plane explains
///   must all lie at one place: this is the cut across that axis. So cuts are derived, not searched for.
/// - Candidate planes are tried in order, and the first match wins. First come planes of the model's faces: single
///   planes, pairs and triples. Then comes the plane of a neighbouring brick, so that a roof keeps one plane. Last
///   comes a least-squares plane through the boundary between two labels, which is read as a height field over one axis
///   in the brick and its neighbours.
/// - A fitted plane is shifted along that axis by the least amount that puts all samples of the brick on the right side
///   (an interval of offsets; no solution if it is empty).
/// - Bricks of one label next to a sloped surface get its plane if it cuts the half voxel outside of their samples, so
///   that the surface continues there.

#include <svt/volume/brick_volume.hpp>
#include <svt/volume/bricks/side_masks.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace svt::volume {

/// A brick as voxels: its distinct scalars, and the palette index of each voxel as bit planes. Bit p of the index of
/// voxel (i, j, k) is bit i + 8 j of word 8 p + k.
struct BrickPattern {
    std::vector<Scalar> palette;
    std::vector<std::uint64_t> bitPlanes;
};

/// A brick as cuts, planes and the label of each side combination; BrickVolume::BoxCoding is the same for a box of
/// bricks.
struct BrickCode {
    std::array<std::uint8_t, 3> cut{};  ///< voxels of the brick below the cut across each axis, 1..7; 0: no cut
    std::array<std::uint32_t, BrickVolume::kMaxPlanes> plane{BrickVolume::kNoPlane, BrickVolume::kNoPlane,
                                                             BrickVolume::kNoPlane};
    /// Planes across an axis that replace its cut, which is then 0. So a code has at most six sides.
    std::array<std::uint32_t, 3> cutPlane{BrickVolume::kNoPlane, BrickVolume::kNoPlane, BrickVolume::kNoPlane};
    /// Label of each side combination: one bit per cut or its plane (x, y, z), then one per plane, lowest bit first.
    std::vector<Scalar> sideScalars;
    friend bool operator==(const BrickCode&, const BrickCode&) = default;
};

/// Per axis: the voxels that differ from the next voxel along this axis.
using Changes = std::array<SideMask, 3>;

/// A side, and the places where it changes.
struct BrickSide {
    explicit BrickSide(const SideMask& sideMask) noexcept;
    SideMask mask;
    Changes changes{};
};

/// The places where the labels of `pattern` change.
[[nodiscard]] Changes findChanges(const BrickPattern& pattern) noexcept;

/// Codes `pattern` by the given sides of planes and at most one cut across each axis.
/// \param changes  findChanges(pattern)
/// \param planes   at most BrickVolume::kMaxPlanes
/// \return the code without BrickCode::plane, which the caller sets, or nullopt if there is no code
[[nodiscard]] std::optional<BrickCode> codeBySides(const BrickPattern& pattern, const Changes& changes,
                                                   std::initializer_list<const BrickSide*> planes = {});

/// Finds the labels of side combinations without a sample, which are slivers between the others. Each takes the label
/// of the nearest combination with samples. Crossing side s costs `costOf(s)`; at equal cost, the lowest combination
/// wins.
/// \param known    bit n: `scalars[n]` is known
template <class CostOf>
void fillUnknown(std::size_t sides, std::uint64_t known, const CostOf& costOf, std::vector<Scalar>& scalars) {
    const std::size_t count = std::size_t{1} << sides;
    std::array<std::size_t, std::size_t{1} << BrickVolume::kMaxSides> distance{};  // by sides that differ
    for (std::size_t s = 0; s < sides; ++s)
        for (std::size_t part = 0; part < std::size_t{1} << s; ++part)
            distance[part | std::size_t{1} << s] = distance[part] + costOf(s);
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    for (std::uint64_t unknown = all & ~known; unknown != 0; unknown &= unknown - 1) {
        const auto combination = static_cast<std::size_t>(std::countr_zero(unknown));
        std::size_t nearest = count;
        for (std::uint64_t rest = known & all; rest != 0; rest &= rest - 1) {
            const auto other = static_cast<std::size_t>(std::countr_zero(rest));
            if (nearest == count || distance[other ^ combination] < distance[nearest ^ combination]) nearest = other;
        }
        scalars[combination] = scalars[nearest];
    }
}

/// The bricks of a tile by place: for each the index of its pattern, or kUniform if it has one label.
struct TilePlaces {
    Vec3i origin;  ///< of the tile in the volume, voxels
    Vec3i count;   ///< bricks
    static constexpr std::uint32_t kUniform = 0xFFFFFFFFu;
    std::vector<std::uint32_t> patternOf;  ///< x fastest, then y, then z
    std::vector<Scalar> scalarOf;          ///< label of uniform bricks, same order

    [[nodiscard]] std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const noexcept {
        return static_cast<std::size_t>(x + count.x * (y + count.y * z));
    }
};

/// A brick that is coded by planes. BrickCode::plane are indices of TileCodes::planes.
struct PlacedCode {
    std::uint32_t place = 0;
    BrickCode code;
};

/// Whether cuts suffice to code a pattern.
enum class BrickKind : std::uint8_t {
    Uncoded,
    Coded,
    Step  ///< coded, but possibly a step of a sloped surface: planes are tried first
};

struct TileCodes {
    std::vector<BrickPlane> planes;
    std::vector<PlacedCode> codes;  ///< by place, ascending
};

/// Codes bricks by planes: those that cuts do not code, and steps. Passes over the tile, in this order:
///
/// 1. All of them: by single planes, pairs and triples of planes of the model's faces.
/// 2. Bricks of two labels whose boundary is a height field over an axis: by the plane of a neighbour, else by least
///    squares through the boundary in the brick and its neighbours.
/// 3. Steps of two labels as in 2, but not by a plane fitted to only this brick; other steps by planes of neighbours.
/// 4. Bricks where surfaces meet: by planes of the model and of the neighbours, in the same way as 1, then by planes
///    fitted to the boundary between two labels.
/// 5. Uniform bricks next to a sloped surface: by its plane, if it cuts the half voxel outside of their samples.
///
/// Every code is checked sample by sample. Bricks without a code stay patterns.
/// \param kindOfPattern  per pattern: its BrickKind
/// \param faces    planes of the model's faces in this tile, in order of preference; empty if unknown
/// Cost: O(bricks on oblique surfaces), 1 to 5 us each.
[[nodiscard]] TileCodes codeTile(const TilePlaces& places, const std::vector<BrickPattern>& patterns,
                                 const std::vector<std::uint8_t>& kindOfPattern, std::span<const FacePlane> faces);

}  // namespace svt::volume
