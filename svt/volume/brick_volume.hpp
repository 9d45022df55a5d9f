#pragma once
/// \file
/// A label volume for ray casting: a flat index of bricks of 8 x 8 x 8 voxels. Built from the columns in milliseconds,
/// without a dense array.
///
///     z  +-----+-----+--#--+--#--+-----+-----+      vertical section; # are the two faces of a wall
///     ^  | U0  | U0  |C0#  |C1#  | U1  | U1  |
///     |  +-----+-----+--#--+--#--+-----+-----+      U  uniform: all voxels have one label
///     |  | U0  | U0  |C0#  |C1#  | V0  | U1  |      C  coded: cuts and planes give the label of every sample
///     |  +-----+-----+--#--+--#--+-----+-----+      V  voxels: a palette and the palette index of each voxel
///     |        air      # wall#      room
///     +--------> x
///
///     The index has two steps: clusters of 4 x 4 x 4 bricks, x fastest, and the bricks of each cluster.
///       cluster        If one same-label box contains all bricks of the cluster: the number of this box.
///                      Otherwise: kMixedCluster, and the start of its list of bricks in `clusterWords`.
///       list           64 bits, one per brick: 1 if the brick is coded. The number of coded bricks in all previous
///                      lists. 64 bytes, one per brick, x fastest: the place of its entry in the table that follows.
///                      The table contains the distinct entries.
///
///     With u same-label boxes and c boxes of coded bricks:
///       entry          kind     refers to
///       [0, u)         uniform  a same-label box: bounds in voxels and the scalar
///       [u, u + c)     coded    a box of coded bricks that share one code (BoxCoding)
///       [u + c, ...)   voxels   a palette brick: its distinct scalars in order of first use, and bit planes. Bit
///                               i + 8 j of word k of plane p is bit p of the palette index of voxel (i, j, k).
///
/// The ideas (ours unless a source is named):
/// - All bricks of a same-label box hold one scalar, so a ray crosses the whole box in one step. Boxes may overlap.
///   This is empty-space skipping by EQUAL LABEL instead of emptiness: a change of styles never rebuilds anything.
/// - Most mixed bricks are coded by at most six sides: planes, and cuts between two voxels across an axis (at most one
///   cut per axis). The sides on which a point lies select its scalar (brick_coder.hpp). All 512 samples of a brick
///   keep their label.
/// - Bricks that one code describes share a box, together with adjacent uniform bricks. So a ray through a wall takes
///   one step per label, faces are flat even in close-up, and normals are those of planes.
/// - Other bricks have a palette per brick, as in neuroglancer's compressed_segmentation, but store the indices as bit
///   planes. A brick of two labels takes 64 bytes, and the mask of the voxels with one label takes a few word
///   operations. Coded bricks have a palette brick as well, for access to single voxels. It is found by the rank of the
///   brick in the bit vector of its cluster.
/// - A cluster without changes of label takes 4 bytes, so the index grows with the surface, as all other arrays do.
/// - Equal palette bricks are stored once, and so are equal bit planes (walls repeat along their length).

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/face_planes.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Voxels [min, max) of whole bricks (clipped at the border of the volume) that all hold `scalar`.
struct SameLabelBox {
    std::array<std::uint16_t, 3> min{}, max{};
    Scalar scalar = 0;
    friend bool operator==(const SameLabelBox&, const SameLabelBox&) = default;
};

/// How rays see the labels of mixed bricks.
enum class BrickFaces : std::uint8_t {
    Planes,  ///< by cuts and planes, where these reproduce all samples; else by voxels
    /// As Planes, but borders parallel to an axis stay between voxels and do not move to the model's faces. This avoids
    /// ledges of up to half a voxel where some bricks find the plane of a face and their neighbours do not.
    Slopes,
    Voxels  ///< by voxels only
};

/// A label volume as bricks, immutable. Thread-safe to read.
class BrickVolume {
public:
    static constexpr std::uint32_t kNoPlane = 0xFFFFFFFFu;
    static constexpr std::size_t kMaxPlanes = 3;              ///< maximum number of planes in a code
    static constexpr std::size_t kMaxSides = 3 + kMaxPlanes;  ///< maximum number of sides in a code: cuts and planes

    static constexpr std::int32_t kBrickSize = 8;
    static constexpr std::int32_t kClusterSize = 4;  ///< bricks along an axis
    static constexpr std::uint64_t kMaxBricks = std::uint64_t{1} << 29;

    /// The index entry of one brick.
    class Entry {
    public:
        [[nodiscard]] bool isMixed() const noexcept { return (value_ & (kCoded | kVoxels)) != 0; }
        [[nodiscard]] bool isCoded() const noexcept { return (value_ & kCoded) != 0; }

    private:
        friend class BrickVolume;
        static constexpr std::uint32_t kCoded = 0x40000000u, kVoxels = 0x80000000u;
        Entry(std::uint32_t value, std::uint32_t pattern) noexcept : value_(value), pattern_(pattern) {}
        std::uint32_t value_, pattern_;
    };

    BrickVolume() = default;

    struct Options {
        BrickFaces faces = BrickFaces::Planes;
        /// Planes of the model's faces, in the voxel space of `columns`. They are tried first, in this order.
        std::span<const FacePlane> planes{};
        int threads = 0;                     ///< 0: all cores; the result does not depend on it
        const Progress* progress = nullptr;  ///< receives the progress of the stage "prepare"
    };

    /// Makes the bricks of `columns`. A given plane is used in a brick only if all samples of the brick agree with it.
    /// Each tile of 64 x 64 columns tries the planes with faces in or next to it, at most 256.
    /// \return the bricks, or GridTooLarge if there are more than kMaxBricks, a dimension is over 65535, or the mixed
    ///         bricks hold more than 2^32 - 1 words
    /// Cost: O(runs of distinct columns + bricks), plus 1 to 5 us per brick on oblique surfaces for planes.
    [[nodiscard]] static Result<BrickVolume> fromColumns(const ColumnVolume& columns, const Options& options);
    [[nodiscard]] static Result<BrickVolume> fromColumns(const ColumnVolume& columns) {
        return fromColumns(columns, {});
    }

    [[nodiscard]] Vec3i dimension() const noexcept { return dimension_; }
    [[nodiscard]] Vec3i brickCount() const noexcept { return brickCount_; }

    /// Scalar of sample (i, j, k), which must lie inside. Cost O(1).
    [[nodiscard]] Scalar scalarAt(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
        const Entry brick = entry(i >> 3, j >> 3, k >> 3);
        return brick.isMixed() ? mixedBrick(brick).scalarAt(i & 7, j & 7, k & 7) : box(brick).scalar;
    }

    /// Entry of brick (bx, by, bz), which must lie inside.
    [[nodiscard]] Entry entry(std::int32_t bx, std::int32_t by, std::int32_t bz) const noexcept {
        const std::uint32_t cluster = clusters_[clusterIndex(bx, by, bz)];
        if ((cluster & kMixedCluster) == 0) return {cluster, 0};
        const std::uint32_t* list = listOf(cluster);
        const std::uint32_t brick = brickInCluster(bx, by, bz), value = entryInList(list, brick);
        if (value < uniformBoxes_) return {value, 0};
        if (value < boxes_.size()) return {value | Entry::kCoded, codedPatterns_[rankOf(list, brick)]};
        const std::uint32_t pattern = value - static_cast<std::uint32_t>(boxes_.size());
        return {pattern | Entry::kVoxels, pattern};
    }
    /// Same-label box of a brick that is not mixed.
    [[nodiscard]] const SameLabelBox& box(Entry uniform) const noexcept { return boxes_[uniform.value_]; }
    /// Index in boxes() of the same-label box of a brick that is not mixed.
    [[nodiscard]] std::size_t boxNumber(Entry uniform) const noexcept { return uniform.value_; }
    /// A view of a mixed brick, for fast access to many of its voxels.
    class MixedBrick {
    public:
        /// Scalar of voxel (i, j, k), each 0..7.
        [[nodiscard]] Scalar scalarAt(int i, int j, int k) const noexcept {
            const std::uint64_t* word = words_ + k;
            const int bit = i + 8 * j;
            std::uint32_t index = static_cast<std::uint32_t>(*word >> bit) & 1u;
            for (std::uint32_t plane = 1; plane < bitPlaneCount_; ++plane)
                index |= (static_cast<std::uint32_t>(word[8 * plane] >> bit) & 1u) << plane;
            return palette_[index];
        }

    private:
        friend class BrickVolume;
        const std::uint64_t* words_ = nullptr;
        const Scalar* palette_ = nullptr;
        std::uint32_t bitPlaneCount_ = 0;
    };
    [[nodiscard]] MixedBrick mixedBrick(Entry mixed) const noexcept {
        const PaletteBrick& brick = bricks_[mixed.pattern_];
        MixedBrick view;
        view.words_ = bitPlanes_.data() + brick.bitPlanes;
        view.palette_ = palettes_.data() + brick.palette;
        view.bitPlaneCount_ = brick.bitPlaneCount;
        return view;
    }

    /// The code of a box of bricks: cuts, planes and the label of each side combination. 24 bytes.
    struct BoxCoding {
        /// Per axis: the number of voxels of the volume below the cut, or the low bits of the number of the plane that
        /// replaces the cut.
        std::array<std::uint16_t, 3> cut{};
        /// Bit a: the code has a cut across axis a. Bit 3 + a: a plane across axis a replaces the cut. Bits 6 + 3 a to
        /// 8 + 3 a: the high bits of the number of this plane.
        std::uint16_t cutAxes = 0;
        std::array<std::uint32_t, kMaxPlanes> plane{kNoPlane, kNoPlane, kNoPlane};  ///< indices in planes()
        /// Offset in palettes of the scalars by side combination. A combination has one bit per side in the order of
        /// forEachSide(), lowest bit first; 1 means beyond the cut, or on the positive side of the plane.
        std::uint32_t firstSideScalar = 0;
        static constexpr std::uint32_t kMostPlanesInCuts = 1u << 19;  ///< planes with lower numbers can replace cuts
        [[nodiscard]] bool hasCut(int axis) const noexcept { return ((cutAxes >> axis) & 1u) != 0; }
        [[nodiscard]] std::uint32_t planeInCut(int axis) const noexcept {
            if (((cutAxes >> (3 + axis)) & 1u) == 0) return kNoPlane;
            return cut[static_cast<std::size_t>(axis)] | ((std::uint32_t{cutAxes} >> (6 + 3 * axis)) & 7u) << 16;
        }
        void setPlaneInCut(std::size_t axis, std::uint32_t number) noexcept {
            cut[axis] = static_cast<std::uint16_t>(number);
            cutAxes = static_cast<std::uint16_t>(cutAxes | 8u << axis | (number >> 16) << (6 + 3 * axis));
        }
        /// Calls onCut(axis, place) or onPlane(number) for each side: x, y, z, then `plane`.
        template <class OnCut, class OnPlane>
        void forEachSide(const OnCut& onCut, const OnPlane& onPlane) const {
            for (int axis = 0; axis < 3; ++axis) {
                if (hasCut(axis))
                    onCut(axis, cut[static_cast<std::size_t>(axis)]);
                else if (const std::uint32_t number = planeInCut(axis); number != kNoPlane)
                    onPlane(number);
            }
            for (const std::uint32_t number : plane)
                if (number != kNoPlane) onPlane(number);
        }
        friend bool operator==(const BoxCoding&, const BoxCoding&) = default;
    };
    /// Box of a coded brick.
    [[nodiscard]] const SameLabelBox& codedBox(Entry coded) const noexcept {
        return boxes_[coded.value_ & ~Entry::kCoded];
    }
    [[nodiscard]] const BoxCoding& coding(Entry coded) const noexcept { return codes_[codedBox(coded).scalar]; }
    /// Scalar of a side combination, see BoxCoding::firstSideScalar.
    [[nodiscard]] Scalar sideScalar(const BoxCoding& coding, std::size_t sides) const noexcept {
        return palettes_[coding.firstSideScalar + sides];
    }
    /// The planes used by all codes.
    [[nodiscard]] std::span<const BrickPlane> planes() const noexcept { return planes_; }

    /// A set of voxels of a brick: bit i + 8 j of word(k) stands for voxel (i, j, k).
    class VoxelMask {
    public:
        [[nodiscard]] std::uint64_t word(std::size_t k) const noexcept { return words_[k] ^ flip_; }

    private:
        friend class BrickVolume;
        const std::uint64_t* words_ = kNoVoxels.data();
        std::uint64_t flip_ = 0;
    };
    using MaskWords = std::array<std::uint64_t, 8>;

    /// The voxels of a brick for whose scalar `accepts(scalar)` is true. Voxels beyond the border of the volume repeat
    /// those at the border.
    /// \param scratch  may be used to hold the words of the mask; must live as long as the mask
    template <class Accepts>
    [[nodiscard]] VoxelMask voxelMask(Entry brick, const Accepts& accepts, MaskWords& scratch) const {
        VoxelMask mask;
        if (!brick.isMixed()) {
            mask.flip_ = accepts(box(brick).scalar) ? ~std::uint64_t{0} : 0;
            return mask;
        }
        const PaletteBrick& mixed = bricks_[brick.pattern_];
        if (mixed.paletteSize == 2) {  // the most frequent case
            const bool first = accepts(palettes_[mixed.palette]), second = accepts(palettes_[mixed.palette + 1]);
            if (first != second) mask.words_ = bitPlanes_.data() + mixed.bitPlanes;
            mask.flip_ = first ? ~std::uint64_t{0} : 0;
            return mask;
        }
        combineMask(mixed, accepts, scratch);
        mask.words_ = scratch.data();
        return mask;
    }

    /// Count of distinct palette bricks.
    [[nodiscard]] std::size_t paletteBrickCount() const noexcept { return bricks_.size(); }
    /// Number of a mixed brick's palette brick.
    [[nodiscard]] std::size_t paletteBrickNumber(Entry mixed) const noexcept { return mixed.pattern_; }
    /// An entry that refers to palette brick `number`.
    [[nodiscard]] static Entry paletteBrickEntry(std::size_t number) noexcept {
        return {static_cast<std::uint32_t>(number) | Entry::kVoxels, static_cast<std::uint32_t>(number)};
    }
    /// Visits the bricks of row (by, bz) in order of x: calls `uniform(begin, end, box)` for each run of bricks in one
    /// of boxes(), and `mixed(bx, number)` for each brick with palette brick `number`. Cost: O(runs + mixed bricks).
    template <class Uniform, class Mixed>
    void forRow(std::int32_t by, std::int32_t bz, const Uniform& uniform, const Mixed& mixed) const {
        for (std::int32_t x = 0; x < brickCount_.x;) {
            const std::uint32_t cluster = clusters_[clusterIndex(x, by, bz)];
            if ((cluster & kMixedCluster) == 0) {
                const std::int32_t end = std::min((boxes_[cluster].max[0] + 7) / 8, brickCount_.x);
                uniform(x, end, std::size_t{cluster});
                x = end;
                continue;
            }
            const std::uint32_t* list = listOf(cluster);
            for (const std::int32_t end = std::min((x | (kClusterSize - 1)) + 1, brickCount_.x); x < end;) {
                const std::uint32_t brick = brickInCluster(x, by, bz), value = entryInList(list, brick);
                if (value < uniformBoxes_) {
                    const std::int32_t behind = std::min((boxes_[value].max[0] + 7) / 8, brickCount_.x);
                    uniform(x, behind, std::size_t{value});
                    // The entries of these bricks may name other boxes, but all are uniform.
                    x = behind;
                } else {
                    mixed(x++, std::size_t{value < boxes_.size() ? codedPatterns_[rankOf(list, brick)]
                                                                 : value - static_cast<std::uint32_t>(boxes_.size())});
                }
            }
        }
    }
    /// All same-label boxes. Together with the mixed bricks they cover the volume; they may overlap.
    [[nodiscard]] std::span<const SameLabelBox> boxes() const noexcept {
        return std::span(boxes_).first(uniformBoxes_);
    }
    /// A palette brick as it is stored.
    struct PaletteBrick {
        std::uint32_t palette = 0;        ///< offset of its scalars in palettes
        std::uint32_t bitPlanes = 0;      ///< offset of its bit planes in words, 8 words each
        std::uint32_t bitPlaneCount = 0;  ///< 1..9
        std::uint32_t paletteSize = 0;
        friend bool operator==(const PaletteBrick&, const PaletteBrick&) = default;
    };
    static constexpr std::uint32_t kMixedCluster = 0x80000000u;
    /// All arrays as stored, for SIMD ray casters and for textures. Entries of the index are numbered as in the file
    /// comment; the boxes of coded bricks follow the same-label boxes in `boxes`, with the index of their code in the
    /// field `scalar`. `palettes` is padded by 7 elements, so that 8 elements can be read anywhere.
    struct Arrays {
        Vec3i clusterCount{};
        std::span<const std::uint32_t> clusters, clusterWords;
        std::size_t uniformBoxes = 0;
        std::span<const SameLabelBox> boxes;
        std::span<const BoxCoding> codes;
        std::span<const PaletteBrick> bricks;
        std::span<const Scalar> palettes;
        std::span<const std::uint64_t> words;
        std::span<const BrickPlane> planes;

        /// Entry of brick (bx, by, bz), which must lie inside.
        [[nodiscard]] std::uint32_t entry(std::int32_t bx, std::int32_t by, std::int32_t bz) const noexcept {
            const std::uint32_t cluster = clusters[indexIn(clusterCount, bx, by, bz)];
            if ((cluster & kMixedCluster) == 0) return cluster;
            return entryInList(clusterWords.data() + (cluster & ~kMixedCluster), brickInCluster(bx, by, bz));
        }
    };
    [[nodiscard]] Arrays arrays() const noexcept {
        return {clusterCount_, clusters_, clusterWords_, uniformBoxes_, boxes_,
                codes_,        bricks_,   palettes_,     bitPlanes_,    planes_};
    }
    /// The entries of all bricks, x fastest, then y, then z: for textures.
    [[nodiscard]] std::vector<std::uint32_t> flatIndex() const;

    /// 1 + the largest scalar.
    [[nodiscard]] std::uint64_t scalarCount() const noexcept { return scalarCount_; }
    /// Bytes of all arrays.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

    /// Equal arrays. Equal volumes have equal bricks.
    friend bool operator==(const BrickVolume&, const BrickVolume&) = default;

private:
    friend class BrickMerger;

    static constexpr std::array<std::uint64_t, 8> kNoVoxels{};

    // The mask of a brick with several scalars. Each scalar costs the words of all bit planes, so the fewer ones are
    // combined: those accepted, or those refused. Mostly only air is refused.
    template <class Accepts>
    void combineMask(const PaletteBrick& brick, const Accepts& accepts, MaskWords& mask) const {
        MaskWords accepted{};  // bit e: palette entry e
        std::uint32_t count = 0;
        for (std::uint32_t e = 0; e < brick.paletteSize; ++e)
            if (accepts(palettes_[brick.palette + e])) {
                accepted[e / 64] |= std::uint64_t{1} << (e % 64);
                ++count;
            }
        const bool areRefused = 2 * count > brick.paletteSize;
        const std::uint64_t* words = bitPlanes_.data() + brick.bitPlanes;
        mask.fill(0);
        for (std::uint32_t e = 0; e < brick.paletteSize; ++e) {
            if (((accepted[e / 64] >> (e % 64)) & 1u) == (areRefused ? 1u : 0u)) continue;
            for (std::size_t k = 0; k < 8; ++k) {
                std::uint64_t equal = ~std::uint64_t{0};
                for (std::uint32_t plane = 0; plane < brick.bitPlaneCount; ++plane) {
                    const std::uint64_t word = words[8 * plane + k];
                    equal &= ((e >> plane) & 1u) != 0 ? word : ~word;
                }
                mask[k] |= equal;
            }
        }
        if (areRefused)
            for (std::uint64_t& word : mask) word = ~word;
    }

    // Words of a cluster's list before the places of entries, and before the entries.
    static constexpr std::size_t kListPlaces = 3, kListEntries = kListPlaces + 16;

    [[nodiscard]] static std::size_t indexIn(Vec3i clusters, std::int32_t bx, std::int32_t by,
                                             std::int32_t bz) noexcept {
        return static_cast<std::size_t>(bx >> 2) +
               static_cast<std::size_t>(clusters.x) *
                   (static_cast<std::size_t>(by >> 2) +
                    static_cast<std::size_t>(clusters.y) * static_cast<std::size_t>(bz >> 2));
    }
    [[nodiscard]] std::size_t clusterIndex(std::int32_t bx, std::int32_t by, std::int32_t bz) const noexcept {
        return indexIn(clusterCount_, bx, by, bz);
    }
    [[nodiscard]] const std::uint32_t* listOf(std::uint32_t cluster) const noexcept {
        return clusterWords_.data() + (cluster & ~kMixedCluster);
    }
    [[nodiscard]] static std::uint32_t brickInCluster(std::int32_t bx, std::int32_t by, std::int32_t bz) noexcept {
        return static_cast<std::uint32_t>((bx & 3) | (by & 3) << 2 | (bz & 3) << 4);
    }
    [[nodiscard]] static std::uint32_t entryInList(const std::uint32_t* list, std::uint32_t brick) noexcept {
        return list[kListEntries + ((list[kListPlaces + brick / 4] >> (8 * (brick % 4))) & 0xFFu)];
    }
    // Rank of a coded brick among all coded bricks: bit vectors with rank (Jacobson 1989), one count per cluster.
    [[nodiscard]] static std::uint32_t rankOf(const std::uint32_t* list, std::uint32_t brick) noexcept {
        const std::uint64_t coded = list[0] | std::uint64_t{list[1]} << 32;
        return list[2] + static_cast<std::uint32_t>(std::popcount(coded & ((std::uint64_t{1} << brick) - 1)));
    }

    Vec3i dimension_{};
    Vec3i brickCount_{};
    std::uint64_t scalarCount_ = 0;
    Vec3i clusterCount_{};
    std::vector<std::uint32_t> clusters_, clusterWords_;
    std::size_t uniformBoxes_ = 0;
    std::vector<SameLabelBox> boxes_;
    std::vector<BoxCoding> codes_;
    std::vector<BrickPlane> planes_;
    std::vector<PaletteBrick> bricks_;
    std::vector<Scalar> palettes_;
    std::vector<std::uint64_t> bitPlanes_;
    std::vector<std::uint32_t> codedPatterns_;  // per coded brick, by rank: its palette brick
};

}  // namespace svt::volume
