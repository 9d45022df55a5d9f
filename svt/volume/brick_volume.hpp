#pragma once
/// \file
/// The form a label volume has while rays go through it: a flat index of 8 x 8 x 8 bricks. Built from
/// the columns in milliseconds, never through a dense array.
///
///     index[bx + nbx * (by + nby * bz)]   one entry a brick, of 16 bits where they are enough, else 32:
///       uniform  -> number of a same-label box: bounds in voxels and the scalar. All bricks of a box hold this one
///                   scalar, so a ray leaves the whole box in one step. Boxes may overlap. They are skipped by EQUAL
///                   LABEL, not by emptiness: a change of styles never rebuilds anything.
///       coded    -> number of a box with a code, see below
///       voxels   -> number of a palette brick: its distinct scalars in order of first use, and the index of each voxel
///                   as bit planes. Plane p, word k, bit i + 8 j is bit p of the palette index of voxel (i, j, k), so a
///                   brick of two labels is 64 bytes and "which voxels hold palette entry e" is a few words' logic.
///
/// Most mixed bricks are coded: by at most one cut across each axis, between two voxels, and at most three planes. The
/// sides on which a point lies say its scalar, and they say it of all 512 samples of a brick as its voxels do. Bricks
/// that one code describes, with the uniform ones beside them, share a box, so a ray crosses a wall in as many steps as
/// it meets labels, faces stay flat however near the eye, and normals are those of planes. What cuts and planes cannot
/// say stays a matter of voxels. Coded bricks have palette bricks as well, for what asks for voxels.
///
/// Palette bricks are stored once each, and so are their bit planes (walls repeat along their length).

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

/// Voxels [min, max) of whole bricks (cut at the volume's border) that all hold `scalar`.
struct SameLabelBox {
    std::array<std::uint16_t, 3> min{}, max{};
    Scalar scalar = 0;
    friend bool operator==(const SameLabelBox&, const SameLabelBox&) = default;
};

/// What stands in for the voxels of mixed bricks while rays go through them.
enum class BrickFaces : std::uint8_t {
    Planes,  ///< cuts and planes, where they say the same as the voxels
    Voxels   ///< voxels alone
};

/// A label volume as bricks, immutable. Thread-safe to read.
class BrickVolume {
public:
    static constexpr std::uint32_t kNoPlane = 0xFFFFFFFFu;
    static constexpr std::size_t kMostPlanes = 3;               ///< of a code
    static constexpr std::size_t kMostSides = 3 + kMostPlanes;  ///< of a code: cuts and planes

    static constexpr std::int32_t kBrickSize = 8;
    static constexpr std::uint64_t kMaxBricks = std::uint64_t{1} << 29;

    /// What the index says of one brick.
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
        /// That the faces of the model lie on, in the voxel space of `columns`: tried first, in this order.
        std::span<const FacePlane> planes{};
        int threads = 0;  ///< 0: all cores; the result does not depend on it
    };

    /// Bricks of `columns`. Planes that are said to be there are believed where all samples of a brick agree; those
    /// around a tile's 64 x 64 columns count, 256 of them at most.
    /// \return the bricks, or GridTooLarge where there are more than kMaxBricks of them or a dimension is over 65535
    /// Cost: O(distinct columns' runs + bricks), and for planes O(bricks on oblique surfaces), 1 to 5 us each.
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
        const std::size_t brick = placeOf(bx, by, bz);
        const std::uint32_t value = narrow_.empty() ? wide_[brick] : narrow_[brick];
        if (value < uniformBoxes_) return {value, 0};
        if (value < boxes_.size()) return {value | Entry::kCoded, patternOf(brick)};
        const std::uint32_t pattern = value - static_cast<std::uint32_t>(boxes_.size());
        return {pattern | Entry::kVoxels, pattern};
    }
    /// Same-label box of a brick that is not mixed.
    [[nodiscard]] const SameLabelBox& box(Entry uniform) const noexcept { return boxes_[uniform.value_]; }
    /// Its number, an index of boxes().
    [[nodiscard]] std::size_t boxNumber(Entry uniform) const noexcept { return uniform.value_; }
    /// A mixed brick, looked up once for many of its voxels.
    class MixedBrick {
    public:
        /// Scalar of voxel (i, j, k), each 0..7.
        [[nodiscard]] Scalar scalarAt(int i, int j, int k) const noexcept {
            const std::uint64_t* word = words_ + k;
            const int bit = i + 8 * j;
            std::uint32_t index = static_cast<std::uint32_t>(*word >> bit) & 1u;
            for (std::uint32_t plane = 1; plane < planeCount_; ++plane)
                index |= (static_cast<std::uint32_t>(word[8 * plane] >> bit) & 1u) << plane;
            return palette_[index];
        }

    private:
        friend class BrickVolume;
        const std::uint64_t* words_ = nullptr;
        const Scalar* palette_ = nullptr;
        std::uint32_t planeCount_ = 0;
    };
    [[nodiscard]] MixedBrick mixedBrick(Entry mixed) const noexcept {
        const PaletteBrick& brick = bricks_[mixed.pattern_];
        MixedBrick view;
        view.words_ = planes_.data() + brick.planes;
        view.palette_ = palettes_.data() + brick.palette;
        view.planeCount_ = brick.planeCount;
        return view;
    }

    /// How cuts and planes stand for the voxels of a box. 24 bytes.
    struct BoxCoding {
        std::array<std::uint16_t, 3> cut{};  ///< voxels of the volume below the cut across each axis that has one
        std::uint16_t cutAxes = 0;           ///< bit a: there is a cut across axis a
        std::array<std::uint32_t, kMostPlanes> plane{kNoPlane, kNoPlane, kNoPlane};  ///< indices of oblique()
        /// First of the scalars by side, in palettes: one bit for each cut (x, y, z) and plane that there is, in this
        /// order from the lowest; 1 is beyond a cut, or a plane's positive side.
        std::uint32_t cells = 0;
        [[nodiscard]] bool hasCut(int axis) const noexcept { return ((cutAxes >> axis) & 1u) != 0; }
        friend bool operator==(const BoxCoding&, const BoxCoding&) = default;
    };
    /// Box of a coded brick.
    [[nodiscard]] const SameLabelBox& codedBox(Entry coded) const noexcept {
        return boxes_[coded.value_ & ~Entry::kCoded];
    }
    [[nodiscard]] const BoxCoding& coding(Entry coded) const noexcept { return codes_[codedBox(coded).scalar]; }
    /// Scalar on the sides that `cell` says, see BoxCoding::cells.
    [[nodiscard]] Scalar cellScalar(const BoxCoding& coding, std::size_t cell) const noexcept {
        return palettes_[coding.cells + cell];
    }
    /// The planes of all bricks.
    [[nodiscard]] std::span<const BrickPlane> oblique() const noexcept { return oblique_; }

    /// Which voxels of a brick hold one of some scalars: bit i + 8 j of word(k).
    class VoxelMask {
    public:
        [[nodiscard]] std::uint64_t word(std::size_t k) const noexcept { return words_[k] ^ flip_; }

    private:
        friend class BrickVolume;
        const std::uint64_t* words_ = kNoVoxels.data();
        std::uint64_t flip_ = 0;
    };
    using MaskWords = std::array<std::uint64_t, 8>;

    /// The voxels of a brick whose scalar `accepts(scalar)`. Voxels beyond the volume's border repeat the border's.
    /// \param scratch  holds the words where they must be put together; must live as long as the mask
    template <class Accepts>
    [[nodiscard]] VoxelMask voxelMask(Entry brick, const Accepts& accepts, MaskWords& scratch) const {
        VoxelMask mask;
        if (!brick.isMixed()) {
            mask.flip_ = accepts(box(brick).scalar) ? ~std::uint64_t{0} : 0;
            return mask;
        }
        const PaletteBrick& mixed = bricks_[brick.pattern_];
        if (mixed.paletteSize == 2) {  // most are
            const bool first = accepts(palettes_[mixed.palette]), second = accepts(palettes_[mixed.palette + 1]);
            if (first != second) mask.words_ = planes_.data() + mixed.planes;
            mask.flip_ = first ? ~std::uint64_t{0} : 0;
            return mask;
        }
        putTogether(mixed, accepts, scratch);
        mask.words_ = scratch.data();
        return mask;
    }

    /// Distinct palette bricks, in the order of their numbers.
    [[nodiscard]] std::size_t paletteBrickCount() const noexcept { return bricks_.size(); }
    /// Number of a mixed brick's palette brick.
    [[nodiscard]] std::size_t paletteBrickNumber(Entry mixed) const noexcept { return mixed.pattern_; }
    /// The entry of any brick that shows palette brick `number`.
    [[nodiscard]] static Entry paletteBrickEntry(std::size_t number) noexcept {
        return {static_cast<std::uint32_t>(number) | Entry::kVoxels, static_cast<std::uint32_t>(number)};
    }
    /// Goes along the bricks of row (by, bz) in order of x: `uniform(begin, end, box)` for bricks that lie in one of
    /// boxes(), `mixed(bx, number)` for one that shows palette brick `number`. Cost: by runs of uniform bricks.
    template <class Uniform, class Mixed>
    void forRow(std::int32_t by, std::int32_t bz, const Uniform& uniform, const Mixed& mixed) const {
        const std::size_t row = placeOf(0, by, bz);
        const std::uint32_t* coded = nullptr;  // pattern of the next coded brick
        for (std::int32_t x = 0; x < brickCount_.x;) {
            const std::size_t brick = row + static_cast<std::size_t>(x);
            const std::uint32_t value = narrow_.empty() ? wide_[brick] : narrow_[brick];
            if (value < uniformBoxes_) {
                const std::int32_t end = std::min((boxes_[value].max[0] + 7) / 8, brickCount_.x);
                uniform(x, end, std::size_t{value});
                // Bricks of a box may be entries of others, but none of them is coded.
                x = end;
            } else {
                if (value >= boxes_.size()) {
                    mixed(x, value - boxes_.size());
                } else {
                    if (coded == nullptr) coded = codedPatterns_.data() + rankOf(brick);
                    mixed(x, std::size_t{*coded++});
                }
                ++x;
            }
        }
    }
    /// All same-label boxes; together with the mixed bricks they cover the volume. They may overlap.
    [[nodiscard]] std::span<const SameLabelBox> boxes() const noexcept {
        return std::span(boxes_).first(uniformBoxes_);
    }
    /// A palette brick as it is stored.
    struct PaletteBrick {
        std::uint32_t palette = 0;     ///< first of its scalars in palettes
        std::uint32_t planes = 0;      ///< first of its words in words, 8 a bit plane
        std::uint32_t planeCount = 0;  ///< 1..9
        std::uint32_t paletteSize = 0;
        friend bool operator==(const PaletteBrick&, const PaletteBrick&) = default;
    };
    /// All arrays as they are stored, for casters that read many rays' bricks at once, and for textures. An entry of
    /// the index is, in this order, a same-label box, a box of coded bricks, which has the number of a code for the
    /// scalar, or a palette brick. Where 16 bits are enough for all of them the index is `narrow`, else `wide`; the
    /// other is empty. Behind the index stand 8 bytes more and behind `palettes` 7 elements, so that 64 bits and 8
    /// elements may be read at once anywhere.
    struct Arrays {
        std::span<const std::uint16_t> narrow;
        std::span<const std::uint32_t> wide;
        std::size_t uniformBoxes = 0;
        std::span<const SameLabelBox> boxes;
        std::span<const BoxCoding> codes;
        std::span<const PaletteBrick> bricks;
        std::span<const Scalar> palettes;
        std::span<const std::uint64_t> words;
        std::span<const BrickPlane> oblique;
    };
    [[nodiscard]] Arrays arrays() const noexcept {
        return {narrow_, wide_, uniformBoxes_, boxes_, codes_, bricks_, palettes_, planes_, oblique_};
    }

    /// 1 + the largest scalar.
    [[nodiscard]] std::uint64_t scalarCount() const noexcept { return scalarCount_; }
    /// Bytes of all arrays.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

    /// Equal arrays. Equal volumes have equal bricks.
    friend bool operator==(const BrickVolume&, const BrickVolume&) = default;

private:
    friend class BrickMerger;

    static constexpr std::array<std::uint64_t, 8> kNoVoxels{};

    template <class Accepts>
    void putTogether(const PaletteBrick& brick, const Accepts& accepts, MaskWords& mask) const {
        const std::uint64_t* words = planes_.data() + brick.planes;
        mask.fill(0);
        for (std::uint32_t e = 0; e < brick.paletteSize; ++e) {
            if (!accepts(palettes_[brick.palette + e])) continue;
            for (std::size_t k = 0; k < 8; ++k) {
                std::uint64_t equal = ~std::uint64_t{0};
                for (std::uint32_t plane = 0; plane < brick.planeCount; ++plane) {
                    const std::uint64_t word = words[8 * plane + k];
                    equal &= ((e >> plane) & 1u) != 0 ? word : ~word;
                }
                mask[k] |= equal;
            }
        }
    }

    [[nodiscard]] std::size_t placeOf(std::int32_t bx, std::int32_t by, std::int32_t bz) const noexcept {
        return static_cast<std::size_t>(bx) +
               static_cast<std::size_t>(brickCount_.x) *
                   (static_cast<std::size_t>(by) +
                    static_cast<std::size_t>(brickCount_.y) * static_cast<std::size_t>(bz));
    }
    // Palette brick of a coded brick: found by its rank among them.
    [[nodiscard]] std::uint32_t rankOf(std::size_t brick) const noexcept {
        const std::uint64_t before = codedBricks_[brick / 64] & ((std::uint64_t{1} << (brick % 64)) - 1);
        return codedBefore_[brick / 64] + static_cast<std::uint32_t>(std::popcount(before));
    }
    [[nodiscard]] std::uint32_t patternOf(std::size_t brick) const noexcept { return codedPatterns_[rankOf(brick)]; }

    Vec3i dimension_{};
    Vec3i brickCount_{};
    std::uint64_t scalarCount_ = 0;
    std::vector<std::uint16_t> narrow_;
    std::vector<std::uint32_t> wide_;
    std::size_t uniformBoxes_ = 0;
    std::vector<SameLabelBox> boxes_;
    std::vector<BoxCoding> codes_;
    std::vector<BrickPlane> oblique_;
    std::vector<PaletteBrick> bricks_;
    std::vector<Scalar> palettes_;
    std::vector<std::uint64_t> planes_;
    std::vector<std::uint64_t> codedBricks_;    // a bit a brick
    std::vector<std::uint32_t> codedBefore_;    // coded bricks before each word of codedBricks_
    std::vector<std::uint32_t> codedPatterns_;  // palette bricks of the coded bricks, in order
};

}  // namespace svt::volume
