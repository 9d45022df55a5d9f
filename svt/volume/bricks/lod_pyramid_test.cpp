#include <svt/volume/lod_pyramid.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

namespace svt::volume {
namespace {

using LabelAt = std::function<Scalar(std::int32_t, std::int32_t, std::int32_t)>;

ColumnVolume columnsOf(Vec3i n, const LabelAt& labelAt) {
    std::vector<Scalar> scalars;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) scalars.push_back(labelAt(i, j, k));
    return ColumnVolume::fromDense(n, scalars);
}

Grid gridOf(Vec3i n) {
    return *Grid::fromDimension(Box3d{{10, 20, 30}, {10 + 0.1 * (n.x - 1), 20 + 0.2 * (n.y - 1), 30 + 0.3 * (n.z - 1)}},
                                n);
}

std::vector<LodLevel> pyramidOf(const ColumnVolume& columns, int coarsest = 6, int threads = 0) {
    auto levels = buildLodPyramid(columns, gridOf(columns.dimension()), coarsest, threads);
    EXPECT_TRUE(levels.hasValue());
    return std::move(*levels);
}

const Mixture& cellOf(const LodLevel& level, std::int32_t i, std::int32_t j, std::int32_t k) {
    return level.mixtures[level.bricks.scalarAt(i, j, k)];
}

TEST(LodPyramid, ThinWallsSurviveEveryLevel) {
    const Vec3i n{128, 64, 64};
    const ColumnVolume columns =
        columnsOf(n, [](std::int32_t i, std::int32_t, std::int32_t) { return i == 77 ? 3u : 0u; });
    for (const LodLevel& level : pyramidOf(columns, 5)) {
        const std::int32_t size = 1 << level.level;
        for (std::int32_t i = 0; i < level.grid.dimension().x; ++i) {
            const Mixture& cell = cellOf(level, i, 1, 1);
            ASSERT_EQ(cell.partCount, i == 77 / size ? 1 : 0);
            if (cell.partCount == 0) continue;
            EXPECT_EQ(cell.parts[0].scalar, 3u);
            EXPECT_EQ(cell.parts[0].coverage, (255 + size / 2) / size);  // one part in `size`
        }
    }
}

TEST(LodPyramid, FullBlocksAreFullyCovered) {
    const Vec3i n{64, 64, 64};
    const ColumnVolume columns = columnsOf(n, [](std::int32_t i, std::int32_t, std::int32_t k) {
        return k < 32 ? 0u : i < 32 ? 1u : 2u;
    });
    const auto levels = pyramidOf(columns, 5);
    ASSERT_EQ(levels.size(), 5u);
    for (const LodLevel& level : levels) {
        const Vec3i d = level.grid.dimension();
        EXPECT_EQ(level.mixtures.size(), 3u);
        EXPECT_EQ(cellOf(level, 0, 0, 0).partCount, 0);
        EXPECT_EQ(level.bricks.scalarAt(0, 0, 0), 0u);
        const Mixture left = cellOf(level, 0, 0, d.z - 1), right = cellOf(level, d.x - 1, 0, d.z - 1);
        EXPECT_EQ(left.parts[0], (MixturePart{1, 255}));
        EXPECT_EQ(right.parts[0], (MixturePart{2, 255}));
    }
}

TEST(LodPyramid, CellsAreTheMixturesOfTheirBlocks) {
    std::mt19937 random(5);
    const Vec3i n{67, 41, 53};
    const ColumnVolume columns = columnsOf(n, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return random() % 6 == 0 ? Scalar(random() % 9) : Scalar((i / 7 + j / 9 + k / 11) % 4);
    });
    for (const LodLevel& level : pyramidOf(columns, 4)) {
        const std::int32_t size = 1 << level.level;
        const Vec3i d = level.grid.dimension();
        for (std::int32_t k = 0; k < d.z; ++k)
            for (std::int32_t j = 0; j < d.y; ++j)
                for (std::int32_t i = 0; i < d.x; ++i) {
                    std::map<Scalar, std::uint64_t> counts;
                    std::uint64_t total = 0;
                    for (std::int32_t z = k * size; z < std::min(n.z, (k + 1) * size); ++z)
                        for (std::int32_t y = j * size; y < std::min(n.y, (j + 1) * size); ++y)
                            for (std::int32_t x = i * size; x < std::min(n.x, (i + 1) * size); ++x, ++total)
                                ++counts[columns.scalarAt(x, y, z)];
                    const std::vector<std::pair<Scalar, std::uint64_t>> list(counts.begin(), counts.end());
                    ASSERT_EQ(cellOf(level, i, j, k), makeMixture(list, total)) << level.level;
                }
    }
}

TEST(LodPyramid, CellCentersAreTheMeanOfTheirSamples) {
    const Vec3i n{32, 32, 32};
    const ColumnVolume columns = columnsOf(n, [](auto, auto, auto) { return 0u; });
    const Grid fine = gridOf(n);
    for (const LodLevel& level : pyramidOf(columns, 4)) {
        const std::int32_t size = 1 << level.level;
        Vec3d sum;
        for (std::int32_t z = 0; z < size; ++z)
            for (std::int32_t y = 0; y < size; ++y)
                for (std::int32_t x = 0; x < size; ++x)
                    sum = sum + fine.worldFromIndex({double(x + size), double(y), double(z + size)});
        const Vec3d mean = sum / double(size * size * size);
        const Vec3d center = level.grid.worldFromIndex({1, 0, 1});
        EXPECT_NEAR(length(mean - center), 0, 1e-9);
        EXPECT_NEAR(level.grid.spacing().y, 0.2 * size, 1e-12);
    }
}

TEST(LodPyramid, LevelsEndBeforeADimensionFallsBelowTwo) {
    EXPECT_EQ(pyramidOf(columnsOf({40, 5, 40}, [](auto, auto, auto) { return 0u; })).size(), 2u);  // 5, 3, 2
    EXPECT_EQ(pyramidOf(columnsOf({2, 2, 2}, [](auto, auto, auto) { return 0u; })).size(), 0u);
    const ColumnVolume columns = columnsOf({4, 4, 4}, [](auto, auto, auto) { return 0u; });
    EXPECT_EQ(buildLodPyramid(columns, gridOf({4, 4, 4}), 0).error().code(), Code::BadArgument);
    EXPECT_EQ(buildLodPyramid(columns, gridOf({4, 4, 4}), 7).error().code(), Code::BadArgument);
    EXPECT_EQ(buildLodPyramid(columns, gridOf({4, 4, 5}), 1).error().code(), Code::BadArgument);
}

TEST(LodPyramid, DoesNotDependOnTheThreads) {
    const ColumnVolume columns = columnsOf({200, 150, 60}, [](std::int32_t i, std::int32_t j, std::int32_t k) {
        return Scalar((i * i + j * j + 2 * k * k) / 3000);
    });
    const auto one = pyramidOf(columns, 3, 1), four = pyramidOf(columns, 3, 4);
    ASSERT_EQ(one.size(), four.size());
    for (std::size_t n = 0; n < one.size(); ++n) {
        EXPECT_EQ(one[n].mixtures, four[n].mixtures);
        EXPECT_EQ(one[n].columns, four[n].columns);
        EXPECT_EQ(one[n].bricks, four[n].bricks);
    }
}

TEST(LodPyramid, ALevelAloneIsThatOfThePyramid) {
    std::mt19937 random(9);
    const Vec3i n{67, 41, 53};
    const ColumnVolume columns = columnsOf(n, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return random() % 6 == 0 ? Scalar(random() % 9) : Scalar((i / 7 + j / 9 + k / 11) % 4);
    });
    const auto levels = pyramidOf(columns);
    ASSERT_EQ(lodLevelCount(n), 5);
    ASSERT_EQ(levels.size(), 5u);
    for (const LodLevel& level : levels) {
        const auto alone = buildLodLevel(columns, gridOf(n), level.level, 1);
        ASSERT_TRUE(alone.hasValue());
        EXPECT_EQ(alone->grid.dimension(), level.grid.dimension());
        EXPECT_EQ(alone->mixtures, level.mixtures);
        EXPECT_EQ(alone->columns, level.columns);
        EXPECT_EQ(alone->bricks, level.bricks);
    }
    EXPECT_EQ(buildLodLevel(columns, gridOf(n), 0).error().code(), Code::BadArgument);
    EXPECT_EQ(buildLodLevel(columns, gridOf(n), 6).error().code(), Code::BadArgument);
    EXPECT_EQ(buildLodLevel(columns, gridOf({66, 41, 53}), 1).error().code(), Code::BadArgument);
    EXPECT_EQ(lodLevelCount({1, 100, 100}), 0);
}

TEST(Mixture, CoverageSumsToTheFilledShare) {
    using Counts = std::vector<std::pair<Scalar, std::uint64_t>>;
    EXPECT_EQ(makeMixture(Counts{{0, 8}}, 8), Mixture{});
    EXPECT_EQ(makeMixture(Counts{{4, 3}, {7, 5}}, 8).coverage(), 255);
    EXPECT_EQ(makeMixture(Counts{{1, 1}, {2, 1}, {3, 1}}, 3).coverage(), 255);
    EXPECT_EQ(makeMixture(Counts{{0, 4}, {7, 4}}, 8).coverage(), 128);
    // Equal counts: the smaller scalar first. Five labels: the rest goes to the first four.
    const Mixture five = makeMixture(Counts{{9, 2}, {5, 2}, {1, 2}, {3, 1}, {2, 1}}, 8);
    EXPECT_EQ(five.partCount, 4);
    EXPECT_EQ(five.parts[0].scalar, 1u);
    EXPECT_EQ(five.parts[1].scalar, 5u);
    EXPECT_EQ(five.parts[2].scalar, 9u);
    EXPECT_EQ(five.parts[3].scalar, 2u);
    EXPECT_EQ(five.coverage(), 255);
}

TEST(Mixture, ALabelThatIsThereIsNeverRoundedAwayNorIsBackground) {
    using Counts = std::vector<std::pair<Scalar, std::uint64_t>>;
    const Mixture speck = makeMixture(Counts{{0, 262143}, {6, 1}}, 262144);
    EXPECT_EQ(speck.partCount, 1);
    EXPECT_EQ(speck.parts[0].coverage, 1);
    EXPECT_EQ(makeMixture(Counts{{0, 1}, {6, 262143}}, 262144).coverage(), 254);
    const Mixture two = makeMixture(Counts{{5, 262143}, {6, 1}}, 262144);
    EXPECT_EQ(two.parts[0], (MixturePart{5, 254}));
    EXPECT_EQ(two.parts[1], (MixturePart{6, 1}));
}

}  // namespace
}  // namespace svt::volume
