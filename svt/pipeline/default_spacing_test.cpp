#include <svt/pipeline/default_spacing.hpp>

#include <gtest/gtest.h>

namespace svt::pipeline {
namespace {

TEST(DefaultSpacing, IsFiveCentimetresForHousesAndBlocks) {
    // A house of 12 x 10 x 8 m, furnished; a block of 20 houses.
    EXPECT_EQ(chooseSpacing({12, 10, 8}, 3000, SpacingChoice::kMemoryBytes).spacing, 0.05);
    EXPECT_EQ(chooseSpacing({100, 80, 15}, 12000, SpacingChoice::kMemoryBytes).spacing, 0.05);
}

TEST(DefaultSpacing, IsFinerWhereTheModelIsSmall) {
    EXPECT_EQ(chooseSpacing({5, 1, 1}, 22, SpacingChoice::kMemoryBytes).spacing, 0.05);
    EXPECT_EQ(chooseSpacing({4.9, 1, 1}, 22, SpacingChoice::kMemoryBytes).spacing, 0.02);
    const SpacingChoice chair = chooseSpacing({0.5, 0.5, 1}, 3, SpacingChoice::kMemoryBytes);
    EXPECT_EQ(chair.spacing, 0.01);
    EXPECT_EQ(chair.reason, "0.01 m, because at 0.05 m the longest side would have 22 samples");
    EXPECT_EQ(chooseSpacing({1e-3, 1e-3, 0}, 1e-6, SpacingChoice::kMemoryBytes).spacing, SpacingChoice::kFinest);
    EXPECT_EQ(chooseSpacing({0, 0, 0}, 0, SpacingChoice::kMemoryBytes).spacing, SpacingChoice::kFinest);
}

TEST(DefaultSpacing, GetsCoarserUntilAllLimitsHold) {
    for (const double size : {1e2, 1e3, 1e4, 1e5, 1e7})
        for (const double cover : {0.01, 1.0, 100.0}) {
            const Vec3d box{size, size, 100};
            const double area = size * size * cover;
            const SpacingChoice choice = chooseSpacing(box, area, SpacingChoice::kMemoryBytes);
            EXPECT_LE(choice.forecast.bytes, double(SpacingChoice::kMemoryBytes));
            EXPECT_LE(choice.forecast.surfaceVoxels, SpacingChoice::kMostSurfaceVoxels);
            EXPECT_LE(choice.forecast.columns, SpacingChoice::kMostColumns);
            EXPECT_LE(choice.forecast.largestDimension, 65535);
            // The next finer one of 1, 2, 5 would not do, or is finer than wanted.
            const double finer = choice.spacing / (choice.reason.find("0.05") == 0 ? 2.5 : 2);
            const GridForecast before = forecastGrid(box, area, finer);
            EXPECT_TRUE(choice.spacing == SpacingChoice::kUsual || before.bytes > double(SpacingChoice::kMemoryBytes) ||
                        before.surfaceVoxels > SpacingChoice::kMostSurfaceVoxels ||
                        before.columns > SpacingChoice::kMostColumns)
                << size << " " << cover << ": " << choice.reason;
        }
}

// 54 buildings of 20 x 20 x 15 m on 9 x 10 km.
TEST(DefaultSpacing, OfSparseModelsFollowsTheirFeatures) {
    const Box3d box{{0, 0, 0}, {9000, 10000, 60}};
    std::vector<Box3d> buildings;
    for (int n = 0; n < 54; ++n) {
        const Vec3d low{(n % 9) * 1100.0, (n / 9) * 1900.0, 0};
        buildings.push_back({low, low + Vec3d{20, 20, 15}});
    }
    const double share = occupiedShare(box, buildings), area = 54 * 2000.0;
    EXPECT_LT(share, 0.001);
    EXPECT_EQ(occupiedShare(box, std::vector<Box3d>{box}), 1);
    EXPECT_EQ(occupiedShare(box, std::vector<Box3d>{}), 0);
    EXPECT_EQ(occupiedShare({{0, 0, 0}, {0, 5, 5}}, std::vector<Box3d>{box}), 1);
    const SpacingChoice choice = chooseSpacing(box.size(), area, SpacingChoice::kMemoryBytes, share);
    EXPECT_EQ(choice.spacing, 0.5) << choice.reason;
    EXPECT_NE(choice.reason.find("because at 0.2 m it would"), std::string::npos) << choice.reason;
    EXPECT_EQ(chooseSpacing(box.size(), area, SpacingChoice::kMemoryBytes).spacing, 2);
    // Less memory, a coarser grid.
    EXPECT_GT(chooseSpacing(box.size(), area, 100'000'000, share).spacing, 0.5);
}

TEST(DefaultSpacing, SaysWhichLimitMadeItCoarser) {
    const SpacingChoice area = chooseSpacing({300, 300, 20}, 1e6, SpacingChoice::kMemoryBytes);
    EXPECT_NE(area.reason.find("m, because at 0.1 m it would have 100 million voxels on surfaces (limit for default "
                               "spacings: 80)"),
              std::string::npos)
        << area.reason;
    const SpacingChoice memory = chooseSpacing({300, 300, 20}, 1e5, 100'000'000);
    EXPECT_NE(memory.reason.find("of memory (limit for default spacings: 100 MB)"), std::string::npos) << memory.reason;
    const SpacingChoice columns = chooseSpacing({5000, 5000, 1}, 10, SpacingChoice::kMemoryBytes);
    EXPECT_NE(columns.reason.find("million columns (limit for default spacings: 60)"), std::string::npos)
        << columns.reason;
    const SpacingChoice road = chooseSpacing({5000, 1, 1}, 10, SpacingChoice::kMemoryBytes);
    EXPECT_EQ(road.spacing, 0.1);
    EXPECT_NE(road.reason.find("100002 samples along its longest side"), std::string::npos) << road.reason;
}

}  // namespace
}  // namespace svt::pipeline
