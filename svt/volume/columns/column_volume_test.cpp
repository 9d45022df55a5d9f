#include <svt/volume/column_volume.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace svt::volume {
namespace {

using Runs = std::vector<Run>;  // inside of a test, Run is one of its members

std::vector<Scalar> randomDense(Vec3i dimension, std::uint32_t seed, Scalar scalarCount) {
    std::mt19937 random(seed);
    std::vector<Scalar> dense(std::size_t(dimension.x) * std::size_t(dimension.y) * std::size_t(dimension.z));
    Scalar current = 0;
    for (Scalar& scalar : dense) {
        if (random() % 4 == 0) current = Scalar(random() % scalarCount);
        scalar = current;
    }
    return dense;
}

std::vector<Scalar> toDense(const ColumnVolume& volume) {
    std::vector<Scalar> dense;
    const Vec3i n = volume.dimension();
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) dense.push_back(volume.scalarAt(i, j, k));
    return dense;
}

TEST(ColumnVolume, DenseGoesThereAndBack) {
    for (const Vec3i dimension : {Vec3i{1, 1, 1}, {64, 64, 3}, {65, 63, 7}, {130, 129, 5}, {3, 200, 40}, {2, 2, 300}}) {
        const std::vector<Scalar> dense = randomDense(dimension, 11, 9);
        const ColumnVolume volume = ColumnVolume::fromDense(dimension, dense);
        EXPECT_EQ(volume.dimension(), dimension);
        EXPECT_EQ(volume.tiles().size(), std::size_t(volume.tilesX()) * std::size_t(volume.tilesY()));
        EXPECT_EQ(toDense(volume), dense);
    }
}

TEST(ColumnVolume, RunsAreCanonical) {
    const Vec3i dimension{70, 66, 31};
    const ColumnVolume volume = ColumnVolume::fromDense(dimension, randomDense(dimension, 3, 4));
    for (std::int32_t j = 0; j < dimension.y; ++j)
        for (std::int32_t i = 0; i < dimension.x; ++i) {
            const auto runs = volume.column(i, j);
            ASSERT_FALSE(runs.empty());
            EXPECT_EQ(runs.back().end, 31u);
            for (std::size_t r = 1; r < runs.size(); ++r) {
                EXPECT_GT(runs[r].end, runs[r - 1].end);
                EXPECT_NE(runs[r].scalar, runs[r - 1].scalar);
            }
        }
}

TEST(ColumnVolume, TilesAtTheRimAreNarrower) {
    const ColumnVolume volume = ColumnVolume::fromDense({130, 65, 2}, std::vector<Scalar>(130 * 65 * 2, 0));
    EXPECT_EQ(volume.tilesX(), 3);
    EXPECT_EQ(volume.tilesY(), 2);
    EXPECT_EQ(volume.tileWidth(0), 64);
    EXPECT_EQ(volume.tileWidth(2), 2);
    EXPECT_EQ(volume.tileHeight(1), 1);
}

TEST(ColumnVolume, CountsEveryVoxelOnce) {
    const Vec3i dimension{131, 67, 23};
    const std::vector<Scalar> dense = randomDense(dimension, 17, 6);
    std::vector<std::uint64_t> expected(8, 0);
    for (const Scalar scalar : dense) ++expected[scalar];
    EXPECT_EQ(ColumnVolume::fromDense(dimension, dense).countVoxels(8), expected);
}

TEST(ColumnVolume, EqualColumnsAndRowsAreStoredOnce) {
    // A slab of one height over all of a tile: one column, one row.
    const Vec3i dimension{64, 64, 100};
    std::vector<Scalar> dense(64 * 64 * 100, 0);
    for (std::size_t v = 64 * 64 * 40; v < 64 * 64 * 60; ++v) dense[v] = 7;
    const ColumnVolume volume = ColumnVolume::fromDense(dimension, dense);
    const ColumnTile& tile = volume.tiles()[0];
    EXPECT_EQ(tile.rowOf.size(), 64u);
    EXPECT_EQ(tile.rowColumns.size(), 64u);
    const Runs expected{{40, 0}, {60, 7}, {100, 0}};
    EXPECT_EQ(Runs(tile.runs.begin(), tile.runs.end()), expected);
    EXPECT_LT(volume.sizeBytes(), 500u);
}

TEST(ColumnVolume, EqualVolumesHaveEqualBytesAndOneVoxelTellsThemApart) {
    const Vec3i dimension{66, 70, 12};
    std::vector<Scalar> dense = randomDense(dimension, 23, 5);
    const ColumnVolume a = ColumnVolume::fromDense(dimension, dense);
    EXPECT_TRUE(a == ColumnVolume::fromDense(dimension, dense));
    dense[66 * 70 * 6 + 66 * 69 + 65] += 1;
    EXPECT_FALSE(a == ColumnVolume::fromDense(dimension, dense));
    EXPECT_FALSE(ColumnVolume::fromDense({2, 3, 4}, std::vector<Scalar>(24, 1)) ==
                 ColumnVolume::fromDense({3, 2, 4}, std::vector<Scalar>(24, 1)));
    EXPECT_TRUE(ColumnVolume() == ColumnVolume());
}

TEST(ColumnVolume, CopiesShareTheirStorage) {
    ColumnVolume copy;
    const volume::Run* before = nullptr;
    {
        const ColumnVolume volume = ColumnVolume::fromDense({4, 4, 4}, std::vector<Scalar>(64, 2));
        before = volume.tiles()[0].runs.data();
        copy = volume;
    }
    EXPECT_EQ(copy.tiles()[0].runs.data(), before);
    EXPECT_EQ(copy.scalarAt(3, 3, 3), 2u);
}

TEST(ColumnTileBuilder, KnownColumnsKeepTheirNumber) {
    ColumnTileBuilder builder(2);
    const Runs empty{{9, 0}}, full{{9, 1}}, half{{4, 1}, {9, 0}};
    EXPECT_EQ(builder.addColumn(empty), 0u);
    EXPECT_EQ(builder.addColumn(full), 1u);
    EXPECT_EQ(builder.addColumn(empty), 0u);
    EXPECT_EQ(builder.addColumn(half), 2u);
    builder.addRow(std::vector<std::uint16_t>{0, 1});
    builder.addRow(std::vector<std::uint16_t>{2, 2});
    builder.repeatRow();
    builder.addRow(std::vector<std::uint16_t>{0, 1});
    EXPECT_EQ(builder.rowCount(), 4);
    const ColumnTileData tile = builder.finish();
    EXPECT_EQ(tile.rowOf, (std::vector<std::uint8_t>{0, 1, 1, 0}));
    EXPECT_EQ(tile.rowColumns, (std::vector<std::uint16_t>{0, 1, 2, 2}));
    EXPECT_EQ(tile.columnStart, (std::vector<std::uint32_t>{0, 1, 2, 4}));
}

TEST(ColumnTileBuilder, HoldsAllColumnsOfATileThatDiffer) {
    // 64 * 64 different columns: the table grows many times and every number stays right.
    ColumnTileBuilder builder(64);
    std::vector<std::uint16_t> row(64);
    for (std::uint32_t j = 0; j < 64; ++j) {
        for (std::uint32_t i = 0; i < 64; ++i) row[i] = builder.addColumn(Runs{{7, j * 64 + i}});
        builder.addRow(row);
    }
    EXPECT_EQ(builder.addColumn(Runs{{7, 5}}), 5u);
    const ColumnVolume volume = ColumnVolume::fromTiles({64, 64, 7}, {builder.finish()});
    for (std::int32_t j = 0; j < 64; ++j)
        for (std::int32_t i = 0; i < 64; ++i) ASSERT_EQ(volume.scalarAt(i, j, 6), Scalar(j * 64 + i));
}

}  // namespace
}  // namespace svt::volume
