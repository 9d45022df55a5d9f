#include <svt/volume/brick_volume.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

namespace svt::volume {
namespace {

using LabelAt = std::function<Scalar(std::int32_t, std::int32_t, std::int32_t)>;

std::vector<Scalar> dense(Vec3i dimension, const LabelAt& labelAt) {
    std::vector<Scalar> scalars;
    for (std::int32_t k = 0; k < dimension.z; ++k)
        for (std::int32_t j = 0; j < dimension.y; ++j)
            for (std::int32_t i = 0; i < dimension.x; ++i) scalars.push_back(labelAt(i, j, k));
    return scalars;
}

BrickVolume bricksOf(Vec3i dimension, const std::vector<Scalar>& scalars, int threads = 0) {
    auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense(dimension, scalars), {.threads = threads});
    EXPECT_TRUE(bricks.hasValue());
    return std::move(*bricks);
}

// Number of samples that differ from the dense array.
std::size_t differences(const BrickVolume& bricks, const std::vector<Scalar>& scalars) {
    const Vec3i n = bricks.dimension();
    std::size_t at = 0, count = 0;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) count += bricks.scalarAt(i, j, k) != scalars[at++];
    return count;
}

// Each box must hold only its scalar, and contain the bricks that refer to it.
void expectBoxesHold(const BrickVolume& bricks) {
    const Vec3i count = bricks.brickCount();
    for (const SameLabelBox& box : bricks.boxes())
        for (std::int32_t k = box.min[2]; k < box.max[2]; ++k)
            for (std::int32_t j = box.min[1]; j < box.max[1]; ++j)
                for (std::int32_t i = box.min[0]; i < box.max[0]; ++i) ASSERT_EQ(bricks.scalarAt(i, j, k), box.scalar);
    for (std::int32_t bz = 0; bz < count.z; ++bz)
        for (std::int32_t by = 0; by < count.y; ++by)
            for (std::int32_t bx = 0; bx < count.x; ++bx) {
                const auto entry = bricks.entry(bx, by, bz);
                if (entry.isMixed()) continue;
                const SameLabelBox& box = bricks.box(entry);
                const std::int32_t first[] = {8 * bx, 8 * by, 8 * bz};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    ASSERT_LE(box.min[axis], first[axis]);
                    ASSERT_GE(box.max[axis], std::min(first[axis] + 8, bricks.dimension()[int(axis)]));
                }
            }
}

TEST(BrickVolume, EqualsTheColumnsAtEverySampleOfRandomVolumes) {
    std::mt19937 random(7);
    for (const Vec3i n : {Vec3i{1, 1, 1}, Vec3i{7, 9, 17}, Vec3i{64, 64, 8}, Vec3i{65, 70, 33}, Vec3i{130, 3, 41}}) {
        for (const std::uint32_t labels : {2u, 3u, 5u, 20u, 600u, 0xFFFFFFFFu}) {
            const auto scalars =
                dense(n, [&](std::int32_t, std::int32_t, std::int32_t) { return Scalar(random() % labels); });
            EXPECT_EQ(differences(bricksOf(n, scalars), scalars), 0u)
                << n.x << ' ' << n.y << ' ' << n.z << ' ' << labels;
        }
    }
}

TEST(BrickVolume, EqualsTheColumnsAtEverySampleOfBlockyVolumes) {
    std::mt19937 random(11);
    for (const Vec3i n : {Vec3i{61, 67, 71}, Vec3i{129, 40, 100}}) {
        std::vector<Scalar> scalars(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z), 0);
        for (Scalar box = 1; box < 40; ++box) {
            Vec3i a, b;
            for (int axis = 0; axis < 3; ++axis) {
                a[axis] = std::int32_t(random() % std::uint32_t(n[axis]));
                b[axis] = std::min(n[axis], a[axis] + 1 + std::int32_t(random() % 30));
            }
            for (std::int32_t k = a.z; k < b.z; ++k)
                for (std::int32_t j = a.y; j < b.y; ++j)
                    for (std::int32_t i = a.x; i < b.x; ++i)
                        scalars[std::size_t(i) +
                                std::size_t(n.x) * (std::size_t(j) + std::size_t(n.y) * std::size_t(k))] = box % 7;
        }
        const BrickVolume bricks = bricksOf(n, scalars);
        EXPECT_EQ(differences(bricks, scalars), 0u);
        expectBoxesHold(bricks);
    }
}

TEST(BrickVolume, OneLabelIsOneBox) {
    const Vec3i n{100, 77, 51};
    const BrickVolume bricks = bricksOf(n, dense(n, [](auto, auto, auto) { return 5u; }));
    ASSERT_EQ(bricks.boxes().size(), 1u);
    const SameLabelBox expected{{0, 0, 0}, {100, 77, 51}, 5};
    EXPECT_EQ(bricks.boxes()[0], expected);
    EXPECT_EQ(bricks.paletteBrickCount(), 0u);
    EXPECT_EQ(bricks.scalarCount(), 6u);
}

TEST(BrickVolume, BoxesReachOverEachOther) {
    // An L of air around a block: two boxes, each as long as the volume.
    const Vec3i n{64, 64, 16};
    const BrickVolume bricks = bricksOf(n, dense(n, [](auto i, auto j, auto) { return i >= 16 && j >= 16 ? 1u : 0u; }));
    ASSERT_EQ(bricks.boxes().size(), 3u);
    EXPECT_EQ(bricks.boxes()[0], (SameLabelBox{{0, 0, 0}, {64, 16, 16}, 0}));
    EXPECT_EQ(bricks.boxes()[1], (SameLabelBox{{0, 0, 0}, {16, 64, 16}, 0}));
    EXPECT_EQ(bricks.boxes()[2], (SameLabelBox{{16, 16, 0}, {64, 64, 16}, 1}));
}

TEST(BrickVolume, CheckerboardIsOnePaletteBrick) {
    const Vec3i n{64, 128, 32};
    const auto scalars =
        dense(n, [](std::int32_t i, std::int32_t j, std::int32_t k) { return Scalar((i + j + k) & 1); });
    const BrickVolume bricks = bricksOf(n, scalars);
    EXPECT_EQ(differences(bricks, scalars), 0u);
    EXPECT_EQ(bricks.paletteBrickCount(), 1u);
    EXPECT_TRUE(bricks.boxes().empty());
}

TEST(BrickVolume, EqualPatternsOfOtherLabelsShareTheirPlanes) {
    const Vec3i n{64, 64, 64};
    const auto few = dense(n, [](std::int32_t i, std::int32_t, std::int32_t) { return Scalar(i % 8 < 4 ? 1 : 2); });
    const auto many =
        dense(n, [](std::int32_t i, std::int32_t, std::int32_t) { return Scalar((i % 8 < 4 ? 1 : 2) + 2 * (i / 8)); });
    const BrickVolume a = bricksOf(n, few), b = bricksOf(n, many);
    EXPECT_EQ(a.paletteBrickCount(), 1u);
    EXPECT_EQ(b.paletteBrickCount(), 8u);
    EXPECT_EQ(b.sizeBytes() - a.sizeBytes(), 7u * (16 + 2 * 4));  // seven more records and palettes, no more planes
}

TEST(BrickVolume, DoesNotDependOnTheThreads) {
    const Vec3i n{200, 190, 70};
    const auto scalars = dense(n, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        return Scalar((i * i + j * j / 2 + k * k * 3) / 5000);
    });
    EXPECT_EQ(bricksOf(n, scalars, 1), bricksOf(n, scalars, 4));
}

TEST(BrickVolume, VoxelMaskShowsTheVoxelsOfASelection) {
    const Vec3i n{8, 8, 8};
    std::mt19937 random(3);
    const auto scalars = dense(n, [&](auto, auto, auto) { return Scalar(random() % 11); });
    const BrickVolume bricks = bricksOf(n, scalars);
    const std::set<Scalar> wanted{2, 3, 10};
    BrickVolume::MaskWords scratch;
    const auto mask = bricks.voxelMask(
        bricks.entry(0, 0, 0), [&](Scalar s) { return wanted.count(s) != 0; }, scratch);
    for (std::size_t at = 0; at < 512; ++at)
        EXPECT_EQ((mask.word(at / 64) >> (at % 64)) & 1u, wanted.count(scalars[at])) << at;
    const BrickVolume one = bricksOf(n, std::vector<Scalar>(512, 2));
    EXPECT_EQ(one.voxelMask(
                     one.entry(0, 0, 0), [](Scalar s) { return s == 2; }, scratch)
                  .word(3),
              ~std::uint64_t{0});
    EXPECT_EQ(one.voxelMask(
                     one.entry(0, 0, 0), [](Scalar s) { return s != 2; }, scratch)
                  .word(3),
              0u);
}

TEST(BrickVolume, VoxelMaskOfTwoLabelsTakesEither) {
    const Vec3i n{8, 8, 8};
    const auto scalars = dense(n, [](auto i, auto j, auto k) { return i + j > k ? 4u : 9u; });
    const BrickVolume bricks = bricksOf(n, scalars);
    BrickVolume::MaskWords scratch;
    for (const auto& wanted : {std::set<Scalar>{}, std::set<Scalar>{4}, std::set<Scalar>{9}, std::set<Scalar>{4, 9}}) {
        const auto mask = bricks.voxelMask(
            bricks.entry(0, 0, 0), [&](Scalar s) { return wanted.count(s) != 0; }, scratch);
        for (std::size_t at = 0; at < 512; ++at)
            ASSERT_EQ((mask.word(at / 64) >> (at % 64)) & 1u, wanted.count(scalars[at])) << at;
    }
}

TEST(BrickVolume, TooManyBricksAreRefused) {
    const Vec3i n{65535, 65535, 65535};
    std::vector<ColumnTileData> tiles;
    for (int tile = 0; tile < 1024 * 1024; ++tile) tiles.push_back({});
    const auto bricks = BrickVolume::fromColumns(ColumnVolume::fromTiles(n, std::move(tiles)));
    ASSERT_FALSE(bricks.hasValue());
    EXPECT_EQ(bricks.error().code(), Code::GridTooLarge);
}

}  // namespace
}  // namespace svt::volume
