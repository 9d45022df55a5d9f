#include <svt/volume/dense.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_part.hpp>

#include <gtest/gtest.h>

namespace svt::volume {
namespace {

using test::sampleVolume;

/// A volume whose scalars tell their place: no two axes look alike, tiles and their borders differ.
SemanticVolume placesVolume(Vec3i dimension) {
    SemanticVolume volume = sampleVolume(dimension);
    volume.columns =
        test::paintedColumns(dimension, [](int i, int j, int k) { return (i / 3 + 2 * (j / 5) + 3 * (k / 2)) % 6; });
    return volume;
}

TEST(VolumePart, BoxHasTheSamplesAndThePlacesOfTheWhole) {
    const SemanticVolume whole = placesVolume({200, 150, 17});
    for (const IndexBox& box : {IndexBox{{0, 0, 0}, {200, 150, 17}}, IndexBox{{63, 1, 3}, {129, 150, 9}},
                                IndexBox{{10, 64, 0}, {12, 66, 2}}, IndexBox{{100, 30, 5}, {200, 100, 17}}}) {
        const auto part = croppedVolume(whole, box);
        ASSERT_TRUE(part) << part.error().toString();
        const Vec3i size = box.end - box.begin;
        ASSERT_EQ(part->grid.dimension(), size);
        ASSERT_EQ(part->columns.dimension(), size);
        std::vector<Scalar> expected;
        for (std::int32_t k = box.begin.z; k < box.end.z; ++k)
            for (std::int32_t j = box.begin.y; j < box.end.y; ++j)
                for (std::int32_t i = box.begin.x; i < box.end.x; ++i)
                    expected.push_back(whole.columns.scalarAt(i, j, k));
        EXPECT_TRUE(part->columns == ColumnVolume::fromDense(size, expected)) << "the same in canonical form";
        EXPECT_LT(length(part->grid.worldFromIndex({1, 1, 1}) -
                         whole.grid.worldFromIndex(toDouble(box.begin + Vec3i{1, 1, 1}))),
                  1e-9);
    }
    EXPECT_EQ(croppedVolume(whole, {{0, 0, 0}, {201, 2, 2}}).error().code(), Code::BadArgument);
    EXPECT_EQ(croppedVolume(whole, {{0, 0, 0}, {1, 2, 2}}).error().code(), Code::BadArgument);
}

TEST(VolumePart, BoxOfTheWorldTakesTheSamplesInIt) {
    const auto grid =
        Grid::fromParts({10, 20, 30}, {0.5, 1, 2}, {100, 200, 300}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    ASSERT_TRUE(grid);
    const auto some = samplesIn(*grid, {{100.9, 203, 303}, {102, 207.5, 310}});
    ASSERT_TRUE(some);
    EXPECT_EQ(*some, (IndexBox{{2, 3, 2}, {5, 8, 6}}));
    const auto all = samplesIn(*grid, {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}});
    ASSERT_TRUE(all);
    EXPECT_EQ(*all, (IndexBox{{}, {10, 20, 30}}));
    const auto one = samplesIn(*grid, {{104.5, 219, 358}, {104.6, 219.1, 358.1}});
    ASSERT_TRUE(one) << "a grid has two samples at least";
    EXPECT_EQ(*one, (IndexBox{{8, 18, 28}, {10, 20, 30}}));
    EXPECT_EQ(samplesIn(*grid, {{0, 0, 0}, {1, 1, 1}}).error().code(), Code::NothingSelected);
    EXPECT_EQ(samplesIn(*grid, {{101, 201, 301}, {100, 200, 300}}).error().code(), Code::NothingSelected);
}

TEST(VolumePart, SamplesAroundScalarsAreOneWiderWithinTheGrid) {
    std::vector<Scalar> dense(6 * 5 * 4, 0);
    const auto at = [&](int i, int j, int k) -> Scalar& { return dense[std::size_t(i + 6 * (j + 5 * k))]; };
    at(2, 3, 1) = 7, at(3, 3, 2) = 8, at(0, 4, 3) = 9;
    const auto columns = ColumnVolume::fromDense({6, 5, 4}, dense);
    EXPECT_EQ(samplesAround(columns), (IndexBox{{0, 2, 0}, {5, 5, 4}}));
    EXPECT_EQ(samplesAround(columns, 7, 8), (IndexBox{{1, 2, 0}, {5, 5, 4}}));
    EXPECT_EQ(samplesAround(columns, 7, 7), (IndexBox{{1, 2, 0}, {4, 5, 3}}));
    EXPECT_EQ(samplesAround(columns, 1, 6), IndexBox());
}

TEST(VolumePart, SelectionKeepsScalarsAndTableAndCountsAgain) {
    const SemanticVolume whole = sampleVolume({70, 66, 9});
    const std::vector<std::uint32_t> kept{2};
    const auto part = selectedVolume(whole, kept);
    ASSERT_TRUE(part);
    for (std::int32_t k = 0; k < 9; ++k)
        for (std::int32_t i = 0; i < 70; ++i) {
            const Scalar scalar = whole.columns.scalarAt(i, 5, k);
            ASSERT_EQ(part->columns.scalarAt(i, 5, k), scalar >= 2 && scalar < 5 ? scalar : 0u);
        }
    EXPECT_EQ(part->labels.labels.size(), whole.labels.labels.size());
    EXPECT_EQ(part->labels.labels[2].voxels, whole.labels.labels[2].voxels);
    EXPECT_EQ(part->labels.labels[1].voxels, 0u);
    EXPECT_EQ(part->labels.labels[1].volume, 0.0);
    const auto dense = toDense<Scalar>(part->columns);
    ASSERT_TRUE(dense);
    EXPECT_TRUE(part->columns == ColumnVolume::fromDense({70, 66, 9}, *dense)) << "canonical";
    EXPECT_EQ(selectedVolume(whole, std::vector<std::uint32_t>{9}).error().code(), Code::BadArgument);
}

// Two rooms in a house, of which a box takes one whole and half of the other.
TEST(VolumePart, KeepsWhatItsLabelsShare) {
    SemanticVolume whole = test::emptyVolume({12, 6, 6}, {1, 1, 1});
    test::addObject(whole, "house", "Building").volume = 200;
    test::addObject(whole, "hall", "BuildingRoom", 0).volume = 32;
    test::addObject(whole, "attic", "BuildingRoom", 0).volume = 32;
    test::paintBoxes(whole, {{1, {1, 1, 1}, {11, 5, 5}}, {2, {1, 1, 1}, {3, 5, 5}}, {3, {7, 1, 1}, {9, 5, 5}}});
    whole.labels.overlaps = {{1, 0, 32, true}, {2, 0, 30, true}};
    const auto part = croppedVolume(whole, {{0, 0, 0}, {8, 6, 6}});
    ASSERT_TRUE(part);
    EXPECT_EQ(part->labels.overlaps, (std::vector<Overlap>{{1, 0, 32, true}, {2, 0, 15, true}}));
    EXPECT_EQ(part->labels.labels[1].volume, 32);
    EXPECT_EQ(part->labels.labels[2].volume, 0) << "it lost voxels";
    const auto west = croppedVolume(whole, {{0, 0, 0}, {5, 6, 6}});
    ASSERT_TRUE(west);
    EXPECT_EQ(west->labels.overlaps, (std::vector<Overlap>{{1, 0, 32, true}})) << "the attic is not in it";
    const auto rooms = selectedVolume(whole, std::vector<std::uint32_t>{0, 1});
    ASSERT_TRUE(rooms);
    EXPECT_EQ(rooms->labels.overlaps, (std::vector<Overlap>{{1, 0, 32, true}}));
}

TEST(VolumePart, LevelHasTheLabelThatFillsMostOfACell) {
    SemanticVolume whole = sampleVolume({8, 8, 8});
    whole.grid = *Grid::fromParts({8, 8, 8}, {1, 1, 1}, {10, 20, 30}, {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    std::vector<Scalar> dense(512, 0);
    const auto at = [&](int i, int j, int k) -> Scalar& { return dense[std::size_t(i + 8 * (j + 8 * k))]; };
    for (int k = 0; k < 8; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 5; ++i) at(i, j, k) = 1;  // half of cells i = 2
    // Three phases of one label against five of a room: 2 + 2 + 1 of the wall win together.
    at(0, 0, 0) = 2, at(1, 0, 0) = 2, at(0, 1, 0) = 3, at(1, 1, 0) = 3, at(0, 0, 1) = 4;
    at(6, 6, 6) = 5;  // one of eight: vanishes
    whole.columns = ColumnVolume::fromDense({8, 8, 8}, dense);
    const auto part = coarseVolume(whole, 1);
    ASSERT_TRUE(part) << part.error().toString();
    EXPECT_EQ(part->grid.dimension(), (Vec3i{4, 4, 4}));
    EXPECT_EQ(part->grid.origin(), (Vec3d{10.5, 20.5, 30.5}));
    EXPECT_EQ(part->columns.scalarAt(0, 0, 0), 2u);
    EXPECT_EQ(part->columns.scalarAt(1, 1, 1), 1u);
    EXPECT_EQ(part->columns.scalarAt(2, 1, 1), 1u) << "of equal shares, the label";
    EXPECT_EQ(part->columns.scalarAt(3, 3, 3), 0u);
    const auto same = coarseVolume(whole, 0);
    ASSERT_TRUE(same);
    EXPECT_TRUE(same->columns == whole.columns);
    EXPECT_EQ(coarseVolume(whole, 7).error().code(), Code::BadArgument);
    EXPECT_EQ(coarseVolume(whole, 5).error().code(), Code::BadArgument) << "too small";
}

}  // namespace
}  // namespace svt::volume
