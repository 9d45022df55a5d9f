#pragma once
/// \file
/// The medium of each voxel, in bricks of 8 x 8 x 8 voxels. A brick of one medium takes 4 bytes, any other 132. So the grid grows
/// with the surface of the objects, not with the volume.

#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::fields {

/// The medium of a voxel.
enum class Medium : std::uint8_t {
    None,  ///< the field has no values there
    Air,
    Solid
};

/// A box of voxels, both ends included. It may reach beyond the volume.
struct VoxelBox {
    Vec3i low, high;

    [[nodiscard]] Vec3i size() const noexcept { return high - low + Vec3i{1, 1, 1}; }
    [[nodiscard]] std::size_t count() const noexcept {
        const Vec3i n = size();
        return std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z);
    }
    /// Index of a voxel of the box; x runs fastest.
    [[nodiscard]] std::size_t indexOf(Vec3i voxel) const noexcept {
        const Vec3i n = size(), at = voxel - low;
        return std::size_t(at.x) + std::size_t(n.x) * (std::size_t(at.y) + std::size_t(n.y) * std::size_t(at.z));
    }
};

/// Media by voxel. Immutable; any thread may read it.
class MediumGrid {
public:
    MediumGrid() = default;
    /// \param mediumOfScalar  one entry per scalar of the volume; entry 0 holds for background, and beyond the volume
    /// Cost: O(columns * runs of a column). The result does not depend on the number of threads.
    MediumGrid(const volume::ColumnVolume& columns, std::span<const Medium> mediumOfScalar);

    [[nodiscard]] Medium at(Vec3i voxel) const noexcept {
        if (!isInside(voxel)) return outside_;
        const std::uint32_t brick = bricks_[brickIndex(voxel)];
        if (brick >= kUniform) return static_cast<Medium>(brick - kUniform);
        return mixedAt(brick, voxel);
    }
    /// Whether two voxels lie in one brick of one medium; else false, even if all voxels between them have one medium.
    [[nodiscard]] bool areInUniformBrick(Vec3i a, Vec3i b) const noexcept {
        if (!isInside(a) || !isInside(b)) return false;
        const std::size_t brick = brickIndex(a);
        return brick == brickIndex(b) && bricks_[brick] >= kUniform;
    }
    /// True if all bricks that a box touches have one medium, the same, and the box lies inside the volume. May be false where
    /// all voxels have one medium. Cost: O(bricks of the box).
    [[nodiscard]] bool isUniform(const VoxelBox& box) const noexcept;
    /// Media of the voxels of a box, x fastest. `out` has box.count() entries.
    void copy(const VoxelBox& box, std::span<Medium> out) const noexcept;

    [[nodiscard]] std::size_t sizeBytes() const noexcept {
        return bricks_.size() * sizeof(bricks_[0]) + words_.size() * sizeof(words_[0]);
    }

private:
    static constexpr std::uint32_t kUniform = 0xFFFFFFF0u;  // plus the medium
    static constexpr std::size_t kBrickWords = 16;          // two bits of each voxel

    [[nodiscard]] bool isInside(Vec3i voxel) const noexcept {
        return static_cast<std::uint32_t>(voxel.x) < static_cast<std::uint32_t>(dimension_.x) &&
               static_cast<std::uint32_t>(voxel.y) < static_cast<std::uint32_t>(dimension_.y) &&
               static_cast<std::uint32_t>(voxel.z) < static_cast<std::uint32_t>(dimension_.z);
    }
    [[nodiscard]] std::size_t brickIndex(Vec3i voxel) const noexcept {
        return std::size_t(voxel.x >> 3) +
               std::size_t(brickCount_.x) *
                   (std::size_t(voxel.y >> 3) + std::size_t(brickCount_.y) * std::size_t(voxel.z >> 3));
    }
    [[nodiscard]] Medium mixedAt(std::uint32_t brick, Vec3i voxel) const noexcept {
        const std::uint64_t* words = words_.data() + kBrickWords * brick + std::size_t(voxel.z & 7);
        const int bit = (voxel.x & 7) + 8 * (voxel.y & 7);
        return static_cast<Medium>(((words[0] >> bit) & 1u) | (((words[8] >> bit) & 1u) << 1));
    }

    Vec3i dimension_{}, brickCount_{};
    Medium outside_ = Medium::None;
    std::vector<std::uint32_t> bricks_;  // kUniform + medium, or the number of the brick in words_
    std::vector<std::uint64_t> words_;
};

}  // namespace svt::fields
