#pragma once
/// \file
/// The form a label volume has while rays go through it: a flat index of 8 x 8 x 8 bricks. Built from
/// the columns in milliseconds, never through a dense array.
///
///     index[bx + nbx * (by + nby * bz)]   one entry a brick:
///       uniform  -> number of a same-label box: bounds in voxels and the scalar. All bricks of a box hold this one
///                   scalar, so a ray leaves the whole box in one step. Boxes may overlap. They are skipped by EQUAL
///                   LABEL, not by emptiness: a change of styles never rebuilds anything.
///       mixed    -> number of a palette brick: its distinct scalars in order of first use, and the index of each voxel
///                   as bit planes. Plane p, word k, bit i + 8 j is bit p of the palette index of voxel (i, j, k), so a
///                   brick of two labels is 64 bytes and "which voxels hold palette entry e" is a few words' logic.
///
/// Palette bricks are stored once each, and so are their bit planes (walls repeat along their length).

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
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

/// A label volume as bricks, immutable. Thread-safe to read.
class BrickVolume {
public:
    static constexpr std::int32_t kBrickSize = 8;
    static constexpr std::uint64_t kMaxBricks = std::uint64_t{1} << 29;

    /// What the index says of one brick.
    class Entry {
    public:
        [[nodiscard]] bool isMixed() const noexcept { return (value_ & kMixed) != 0; }

    private:
        friend class BrickVolume;
        static constexpr std::uint32_t kMixed = 0x80000000u;
        explicit Entry(std::uint32_t value) noexcept : value_(value) {}
        std::uint32_t value_;
    };

    BrickVolume() = default;

    /// Bricks of `columns`.
    /// \param threads  0: all cores; the result does not depend on it
    /// \return the bricks, or GridTooLarge where there are more than kMaxBricks of them or a dimension is over 65535
    /// Cost: O(distinct columns' runs + bricks).
    [[nodiscard]] static Result<BrickVolume> fromColumns(const ColumnVolume& columns, int threads = 0);

    [[nodiscard]] Vec3i dimension() const noexcept { return dimension_; }
    [[nodiscard]] Vec3i brickCount() const noexcept { return brickCount_; }

    /// Scalar of sample (i, j, k), which must lie inside. Cost O(1).
    [[nodiscard]] Scalar scalarAt(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
        const Entry brick = entry(i >> 3, j >> 3, k >> 3);
        return brick.isMixed() ? mixedBrick(brick).scalarAt(i & 7, j & 7, k & 7) : box(brick).scalar;
    }

    /// Entry of brick (bx, by, bz), which must lie inside.
    [[nodiscard]] Entry entry(std::int32_t bx, std::int32_t by, std::int32_t bz) const noexcept {
        return Entry(index_[static_cast<std::size_t>(bx) +
                            static_cast<std::size_t>(brickCount_.x) *
                                (static_cast<std::size_t>(by) +
                                 static_cast<std::size_t>(brickCount_.y) * static_cast<std::size_t>(bz))]);
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
        const PaletteBrick& brick = bricks_[mixed.value_ & ~Entry::kMixed];
        MixedBrick view;
        view.words_ = planes_.data() + brick.planes;
        view.palette_ = palettes_.data() + brick.palette;
        view.planeCount_ = brick.planeCount;
        return view;
    }

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
        const PaletteBrick& mixed = bricks_[brick.value_ & ~Entry::kMixed];
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
    [[nodiscard]] std::size_t paletteBrickNumber(Entry mixed) const noexcept { return mixed.value_ & ~Entry::kMixed; }
    /// The entry of any brick that shows palette brick `number`.
    [[nodiscard]] static Entry paletteBrickEntry(std::size_t number) noexcept {
        return Entry(static_cast<std::uint32_t>(number) | Entry::kMixed);
    }
    /// All same-label boxes; together with the mixed bricks they cover the volume. They may overlap.
    [[nodiscard]] std::span<const SameLabelBox> boxes() const noexcept { return boxes_; }
    /// 1 + the largest scalar.
    [[nodiscard]] std::uint64_t scalarCount() const noexcept { return scalarCount_; }
    /// Bytes of all arrays.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

    /// Equal arrays. Equal volumes have equal bricks.
    friend bool operator==(const BrickVolume&, const BrickVolume&) = default;

private:
    friend class BrickMerger;

    struct PaletteBrick {
        std::uint32_t palette = 0;     ///< first of its scalars in palettes_
        std::uint32_t planes = 0;      ///< first of its words in planes_, 8 a plane
        std::uint32_t planeCount = 0;  ///< 1..9
        std::uint32_t paletteSize = 0;
        friend bool operator==(const PaletteBrick&, const PaletteBrick&) = default;
    };

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

    Vec3i dimension_{};
    Vec3i brickCount_{};
    std::uint64_t scalarCount_ = 0;
    std::vector<std::uint32_t> index_;
    std::vector<SameLabelBox> boxes_;
    std::vector<PaletteBrick> bricks_;
    std::vector<Scalar> palettes_;
    std::vector<std::uint64_t> planes_;
};

}  // namespace svt::volume
