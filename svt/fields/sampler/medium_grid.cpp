#include <svt/fields/sampler/medium_grid.hpp>

#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <array>

namespace svt::fields {
namespace {

using volume::ColumnVolume;
using volume::Run;

// The bits of a column of bricks while they are made: per brick 16 words.
using BrickColumn = std::vector<std::array<std::uint64_t, 16>>;

// Sets the bits of one column of voxels; `bit` is its place in a brick.
void addColumn(std::span<const Run> runs, std::span<const Medium> mediumOfScalar, int bit, BrickColumn& bricks) {
    std::uint32_t begin = 0;
    for (const Run& run : runs) {
        const auto medium = static_cast<std::uint64_t>(mediumOfScalar[run.scalar]);
        if (medium != 0)
            for (std::uint32_t k = begin; k < run.end; ++k) {
                auto& words = bricks[k >> 3];
                words[k & 7] |= (medium & 1u) << bit;
                words[8 + (k & 7)] |= (medium >> 1) << bit;
            }
        begin = run.end;
    }
}

// The medium of a brick whose voxels inside the volume all have it.
bool isUniformBrick(const std::array<std::uint64_t, 16>& words, std::uint64_t inside, int height, Medium& medium) {
    const auto low = (words[0] & inside) != 0, high = (words[8] & inside) != 0;
    for (std::size_t k = 0; k < std::size_t(height); ++k) {
        if ((words[k] & inside) != (low ? inside : 0)) return false;
        if ((words[8 + k] & inside) != (high ? inside : 0)) return false;
    }
    medium = static_cast<Medium>((low ? 1 : 0) + (high ? 2 : 0));
    return true;
}

std::uint64_t insideMask(int width, int depth) noexcept {
    std::uint64_t mask = 0;
    for (int j = 0; j < depth; ++j)
        for (int i = 0; i < width; ++i) mask |= std::uint64_t{1} << (i + 8 * j);
    return mask;
}

}  // namespace

MediumGrid::MediumGrid(const ColumnVolume& columns, std::span<const Medium> mediumOfScalar)
    : dimension_(columns.dimension()) {
    SVT_CHECK(!mediumOfScalar.empty());
    outside_ = mediumOfScalar[0];
    brickCount_ = {(dimension_.x + 7) / 8, (dimension_.y + 7) / 8, (dimension_.z + 7) / 8};
    const std::size_t rowBricks = std::size_t(brickCount_.x) * std::size_t(brickCount_.z);
    bricks_.resize(rowBricks * std::size_t(brickCount_.y));
    // Rows of bricks along x are independent; their words are joined in order afterwards.
    std::vector<std::vector<std::uint64_t>> words(std::size_t(brickCount_.y));
    parallelFor(words.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
        BrickColumn bricks(std::size_t(brickCount_.z));
        for (std::size_t by = begin; by < end; ++by)
            for (std::int32_t bx = 0; bx < brickCount_.x; ++bx) {
                const int width = std::min(8, dimension_.x - 8 * bx);
                const int depth = std::min(8, dimension_.y - 8 * static_cast<std::int32_t>(by));
                std::fill(bricks.begin(), bricks.end(), std::array<std::uint64_t, 16>{});
                for (int j = 0; j < depth; ++j)
                    for (int i = 0; i < width; ++i)
                        addColumn(columns.column(8 * bx + i, 8 * static_cast<std::int32_t>(by) + j), mediumOfScalar,
                                  i + 8 * j, bricks);
                const std::uint64_t inside = insideMask(width, depth);
                for (std::int32_t bz = 0; bz < brickCount_.z; ++bz) {
                    const std::size_t brick = brickIndex({8 * bx, 8 * static_cast<std::int32_t>(by), 8 * bz});
                    const auto& bits = bricks[std::size_t(bz)];
                    Medium medium = Medium::None;
                    if (isUniformBrick(bits, inside, std::min(8, dimension_.z - 8 * bz), medium)) {
                        bricks_[brick] = kUniform + static_cast<std::uint32_t>(medium);
                    } else {
                        bricks_[brick] = static_cast<std::uint32_t>(words[by].size() / kBrickWords);
                        words[by].insert(words[by].end(), bits.begin(), bits.end());
                    }
                }
            }
    });
    std::uint32_t before = 0;
    for (std::int32_t by = 0; by < brickCount_.y; ++by) {
        for (std::int32_t bz = 0; bz < brickCount_.z; ++bz)
            for (std::int32_t bx = 0; bx < brickCount_.x; ++bx)
                if (std::uint32_t& brick = bricks_[brickIndex({8 * bx, 8 * by, 8 * bz})]; brick < kUniform)
                    brick += before;
        const auto& row = words[std::size_t(by)];
        words_.insert(words_.end(), row.begin(), row.end());
        before += static_cast<std::uint32_t>(row.size() / kBrickWords);
    }
}

bool MediumGrid::isUniform(const VoxelBox& box) const noexcept {
    if (!isInside(box.low) || !isInside(box.high)) return false;
    const std::uint32_t first = bricks_[brickIndex(box.low)];
    if (first < kUniform) return false;
    for (std::int32_t z = box.low.z >> 3; z <= box.high.z >> 3; ++z)
        for (std::int32_t y = box.low.y >> 3; y <= box.high.y >> 3; ++y)
            for (std::int32_t x = box.low.x >> 3; x <= box.high.x >> 3; ++x)
                if (bricks_[brickIndex({8 * x, 8 * y, 8 * z})] != first) return false;
    return true;
}

void MediumGrid::copy(const VoxelBox& box, std::span<Medium> out) const noexcept {
    std::size_t next = 0;
    for (std::int32_t z = box.low.z; z <= box.high.z; ++z)
        for (std::int32_t y = box.low.y; y <= box.high.y; ++y)
            for (std::int32_t x = box.low.x; x <= box.high.x; ++x) out[next++] = at({x, y, z});
}

}  // namespace svt::fields
