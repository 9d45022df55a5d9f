#include <svt/voxelize/rewrite/rewrite.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::voxelize {
namespace {

using volume::ColumnVolume;
using volume::Scalar;
using Runs = std::vector<volume::Run>;

const Vec3i kDimension{131, 70, 9};

std::size_t at(Vec3i v) {
    return std::size_t(v.x) +
           std::size_t(kDimension.x) * (std::size_t(v.y) + std::size_t(kDimension.y) * std::size_t(v.z));
}

std::vector<Scalar> randomDense(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Scalar> dense(std::size_t(kDimension.x) * std::size_t(kDimension.y) * std::size_t(kDimension.z));
    for (Scalar& scalar : dense) scalar = Scalar(random() % 3);
    return dense;
}

TEST(EditVoxels, SetsExactlyTheVoxelsAsked) {
    std::vector<Scalar> dense = randomDense(1);
    const ColumnVolume before = ColumnVolume::fromDense(kDimension, dense);
    std::mt19937 random(2);
    std::vector<VoxelEdit> edits;
    for (int n = 0; n < 3000; ++n) {
        const Vec3i v{std::int32_t(random() % 131), std::int32_t(random() % 70), std::int32_t(random() % 9)};
        // Edit each voxel at most once.
        if (dense[at(v)] >= 10) continue;
        const auto scalar = Scalar(10 + random() % 5);
        edits.push_back({v, scalar});
        dense[at(v)] = scalar;
    }
    const ColumnVolume expected = ColumnVolume::fromDense(kDimension, dense);
    EXPECT_TRUE(editVoxels(before, edits, 1) == expected);
    EXPECT_TRUE(editVoxels(before, edits, 4) == expected);
    std::reverse(edits.begin(), edits.end());
    EXPECT_TRUE(editVoxels(before, edits, 2) == expected);
    EXPECT_TRUE(editVoxels(before, {}, 1) == before);
}

TEST(EditVoxels, ValueThatIsThereKeepsTheVolumeCanonical) {
    const ColumnVolume before =
        ColumnVolume::fromDense({2, 2, 4}, std::vector<Scalar>{1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2});
    EXPECT_TRUE(editVoxels(before, {{{0, 0, 1}, 1}, {{1, 1, 2}, 2}}, 1) == before);
    // The edit joins the runs below and above.
    const auto edited = editVoxels(before, {{{0, 0, 1}, 2}, {{0, 0, 0}, 2}}, 1);
    const auto column = edited.column(0, 0);
    EXPECT_EQ(Runs(column.begin(), column.end()), (Runs{{4, 2}}));
}

TEST(EditVoxels, VoxelsOutsideAreIgnored) {
    const std::vector<Scalar> dense = randomDense(5);
    const ColumnVolume before = ColumnVolume::fromDense(kDimension, dense);
    EXPECT_TRUE(editVoxels(before, {{{131, 0, 0}, 9}, {{0, 70, 0}, 9}, {{0, 0, 9}, 9}, {{500, 500, 500}, 9}}, 1) ==
                before);
}

TEST(RewriteColumns, EqualNeighboursAreJoinedAndTilesWithoutRewriterStay) {
    const std::vector<Scalar> dense = randomDense(3);
    const ColumnVolume before = ColumnVolume::fromDense(kDimension, dense);
    std::vector<Scalar> expected = dense;
    for (std::int32_t k = 0; k < 9; ++k)
        for (std::int32_t j = 0; j < 64; ++j)
            for (std::int32_t i = 64; i < 128; ++i) expected[at({i, j, k})] = dense[at({i, j, k})] == 0 ? 0 : 1;
    for (const int threads : {1, 4}) {
        const ColumnVolume after = rewriteColumns(
            before,
            [](std::int32_t tileX, std::int32_t tileY, const volume::ColumnTile&) -> ColumnRewriter {
                if (tileX != 1 || tileY != 0) return {};
                return [](std::int32_t, std::int32_t, std::span<const volume::Run> runs, Runs& out) {
                    for (const volume::Run& run : runs) out.push_back({run.end, run.scalar == 0 ? 0u : 1u});
                };
            },
            threads);
        EXPECT_TRUE(after == ColumnVolume::fromDense(kDimension, expected));
    }
}

TEST(RewriteColumns, RewriterIsToldItsColumn) {
    const ColumnVolume before = ColumnVolume::fromDense(kDimension, std::vector<Scalar>(131 * 70 * 9, 0));
    const ColumnVolume after = rewriteColumns(
        before,
        [](std::int32_t, std::int32_t, const volume::ColumnTile&) -> ColumnRewriter {
            return [](std::int32_t i, std::int32_t j, std::span<const volume::Run>, Runs& out) {
                out.push_back({9, Scalar(i + 1000 * j)});
            };
        },
        3);
    for (std::int32_t j = 0; j < 70; ++j)
        for (std::int32_t i = 0; i < 131; ++i) ASSERT_EQ(after.scalarAt(i, j, 4), Scalar(i + 1000 * j));
}

}  // namespace
}  // namespace svt::voxelize
