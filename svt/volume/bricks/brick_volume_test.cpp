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
    // First from the cluster of one label, then from single bricks.
    EXPECT_EQ(bricks.boxes()[0], (SameLabelBox{{16, 16, 0}, {64, 64, 16}, 1}));
    EXPECT_EQ(bricks.boxes()[1], (SameLabelBox{{0, 0, 0}, {64, 16, 16}, 0}));
    EXPECT_EQ(bricks.boxes()[2], (SameLabelBox{{0, 0, 0}, {16, 64, 16}, 0}));
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
    EXPECT_EQ(b.arrays().bricks.size(), 8u);
    EXPECT_EQ(b.arrays().palettes.size() - a.arrays().palettes.size(), 7u * 2);
    EXPECT_EQ(b.arrays().words.size(), a.arrays().words.size());  // no more planes
}

// A volume of `size` samples along each axis, empty but for a small block of label 1 in its middle.
BrickVolume blockIn(std::int32_t size) {
    std::vector<ColumnTileData> tiles;
    const std::int32_t tilesAcross = size / ColumnVolume::kTileSize, middle = tilesAcross / 2;
    for (std::int32_t y = 0; y < tilesAcross; ++y)
        for (std::int32_t x = 0; x < tilesAcross; ++x) {
            ColumnTileBuilder builder(ColumnVolume::kTileSize);
            const auto end = static_cast<std::uint32_t>(size);
            const std::uint16_t air = builder.addColumn(std::vector<Run>{{end, 0}});
            std::vector<std::uint16_t> row(ColumnVolume::kTileSize, air);
            for (std::int32_t j = 0; j < ColumnVolume::kTileSize; ++j) {
                std::vector<std::uint16_t> columns = row;
                if (x == middle && y == middle && j >= 20 && j < 31)
                    for (std::size_t i = 20; i < 31; ++i)
                        columns[i] = builder.addColumn(std::vector<Run>{{end / 2, 0}, {end / 2 + 11, 1}, {end, 0}});
                builder.addRow(columns);
            }
            tiles.push_back(builder.finish());
        }
    auto bricks = BrickVolume::fromColumns(ColumnVolume::fromTiles({size, size, size}, std::move(tiles)));
    EXPECT_TRUE(bricks.hasValue());
    return std::move(*bricks);
}

TEST(BrickVolume, TheIndexGrowsWithTheSurface) {
    const BrickVolume small = blockIn(256), large = blockIn(2048);
    const std::int32_t corner = 1024 + 20;
    EXPECT_EQ(large.scalarAt(corner, corner, 1024), 1u);
    EXPECT_EQ(large.scalarAt(corner - 1, corner, 1024), 0u);
    EXPECT_EQ(large.scalarAt(2047, 2047, 2047), 0u);
    // 512 times as many bricks, 4 bytes for 64 of them.
    EXPECT_LT(large.sizeBytes(), small.sizeBytes() + 4u * 64 * 64 * 64 + 4096);
    EXPECT_LT(large.boxes().size(), 16u);
}

// Labels lie on each other, 16 bricks apart: boxes that grow over all the bricks between spend their budget on them.
TEST(BrickVolume, EachFloorIsOneCodedBoxHoweverFarTheNextOneIs) {
    const Vec3i n{64, 64, 1024};
    const auto scalars = dense(n, [](auto, auto, std::int32_t k) { return Scalar((k + 61) / 128); });
    const BrickVolume bricks = bricksOf(n, scalars);
    EXPECT_EQ(differences(bricks, scalars), 0u);
    EXPECT_EQ(bricks.arrays().boxes.size() - bricks.boxes().size(), 8u);
}

// A slope down to y = 8 ends at a border between bricks. Beyond it, its plane cuts a corner of a brick of air.
TEST(BrickVolume, ASurfaceDoesNotGoOnBeyondItsEnd) {
    const Vec3i dimension{8, 24, 16};
    BrickPlane plane;
    plane.normal = normalized(Vec3d{0, 0.8, 1});
    plane.offset = -dot(plane.normal, Vec3d{0, 16, 7.7});
    std::vector<Scalar> scalars(std::size_t{8} * 24 * 16, 0);
    for (int k = 0; k < 16; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 8; ++i)
                if (dot(plane.normal, Vec3d{i + 0.5, j + 0.5, k + 0.5}) + plane.offset > 0)
                    scalars[std::size_t(i + 8 * (j + 24 * k))] = 1;
    const FacePlane face{plane, {0, 0, 8}, {8, 8, 16}};
    const auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense(dimension, scalars), {.planes = {&face, 1}});
    ASSERT_TRUE(bricks);
    EXPECT_TRUE(bricks->entry(0, 0, 1).isCoded());
    EXPECT_FALSE(bricks->entry(0, 1, 0).isCoded());
}

TEST(BrickVolume, RowsAndTheFlatIndexSayWhatTheEntriesSay) {
    const Vec3i n{141, 77, 61};
    const auto scalars = dense(n, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        return Scalar(i / 37 + (j + k) / 41 * 5 + (i > 90 && k > 30 ? (i + j) % 3 : 0));
    });
    const BrickVolume bricks = bricksOf(n, scalars);
    EXPECT_EQ(differences(bricks, scalars), 0u);
    const Vec3i count = bricks.brickCount();
    const std::vector<std::uint32_t> flat = bricks.flatIndex();
    std::size_t place = 0, mixedBricks = 0;
    for (std::int32_t z = 0; z < count.z; ++z)
        for (std::int32_t y = 0; y < count.y; ++y) {
            std::vector<int> visits(std::size_t(count.x), 0);
            bricks.forRow(
                y, z,
                [&](std::int32_t begin, std::int32_t end, std::size_t box) {
                    ASSERT_LE(end, count.x);
                    for (std::int32_t x = begin; x < end; ++x) {
                        ++visits[std::size_t(x)];
                        ASSERT_FALSE(bricks.entry(x, y, z).isMixed());
                        EXPECT_EQ(bricks.box(bricks.entry(x, y, z)).scalar, bricks.boxes()[box].scalar);
                    }
                },
                [&](std::int32_t x, std::size_t number) {
                    ++visits[std::size_t(x)];
                    ++mixedBricks;
                    ASSERT_TRUE(bricks.entry(x, y, z).isMixed());
                    EXPECT_EQ(bricks.paletteBrickNumber(bricks.entry(x, y, z)), number);
                });
            for (std::int32_t x = 0; x < count.x; ++x, ++place) {
                EXPECT_EQ(visits[std::size_t(x)], 1) << x << ' ' << y << ' ' << z;
                EXPECT_EQ(flat[place], bricks.arrays().entry(x, y, z));
                EXPECT_EQ(flat[place] >= bricks.boxes().size(), bricks.entry(x, y, z).isMixed());
            }
        }
    EXPECT_GT(mixedBricks, 100u);
    EXPECT_EQ(place, flat.size());
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
    BrickVolume::MaskWords scratch;
    for (const Scalar labels : {11u, 200u}) {
        const auto scalars = dense(n, [&](auto, auto, auto) { return Scalar(random() % labels); });
        const BrickVolume bricks = bricksOf(n, scalars);
        for (const Scalar accepted : {0u, 1u, 5u, 10u, 64u, 150u, 199u, 200u}) {
            const auto isWanted = [&](Scalar s) { return (s * 7) % labels < accepted; };
            const auto mask = bricks.voxelMask(bricks.entry(0, 0, 0), isWanted, scratch);
            for (std::size_t at = 0; at < 512; ++at)
                ASSERT_EQ((mask.word(at / 64) >> (at % 64)) & 1u, isWanted(scalars[at])) << accepted << " " << at;
        }
    }
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
