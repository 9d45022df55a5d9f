#include <svt/fields/field_statistics.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::fields {
namespace {

using volume::SemanticVolume;

// Labels: 0 storey, 1 room, 2 room, 3 wall; voxels of 0.1 x 0.2 x 0.5 m.
SemanticVolume storeyWithTwoRooms() {
    SemanticVolume volume = volume::test::emptyVolume({21, 10, 10}, {0.1, 0.2, 0.5});
    volume::test::addGroup(volume, "storey", "Storey");
    volume::test::addObject(volume, "west", "BuildingRoom", 0);
    volume::test::addObject(volume, "east", "BuildingRoom", 0);
    volume::test::addObject(volume, "wall", "Wall", 0);
    volume::test::paintBoxes(
        volume, {{1, {0, 0, 0}, {10, 10, 10}}, {2, {11, 0, 0}, {21, 10, 10}}, {3, {10, 0, 0}, {11, 10, 10}}});
    return volume;
}

// x + 100 * time at each voxel, missing below the row j = 4.
Field ramp(std::string medium, std::vector<double> times) {
    Field field;
    field.head.name = "t";
    field.head.unit = "Cel";
    field.head.medium = std::move(medium);
    field.head.lattice = {{21, 10, 10}, {0, 0, 0}, {1, 1, 1}, {}};
    field.head.times = std::move(times);
    for (std::size_t t = 0; t < field.head.times.size(); ++t)
        for (int k = 0; k < 10; ++k)
            for (int j = 0; j < 10; ++j)
                for (int i = 0; i < 21; ++i)
                    field.values.push_back(j < 4 ? std::nanf("") : static_cast<float>(i) + 100 * static_cast<float>(t));
    return field;
}

constexpr double kVoxel = 0.1 * 0.2 * 0.5;

TEST(FieldStatistics, AreThoseOfTheVoxelsOfALabel) {
    const SemanticVolume volume = storeyWithTwoRooms();
    StatisticsOptions options;
    options.over = 6;
    options.under = 2;
    const auto sums = sumField(ramp("air", {0}), volume, options);
    ASSERT_TRUE(sums) << sums.error().message();
    const std::uint32_t west[] = {1};
    const FieldFigures figures = figuresAt(*sums, west, 0);
    // The row j = 0 is farther than two cells from a value, rows 1 to 3 take that of row 4.
    EXPECT_NEAR(figures.volume, 900 * kVoxel, 1e-9);
    EXPECT_NEAR(figures.missing, 100 * kVoxel, 1e-9);
    EXPECT_NEAR(*figures.mean, 4.5, 1e-9);
    EXPECT_EQ(figures.min, 0);
    EXPECT_EQ(figures.max, 9);
    EXPECT_NEAR(*figures.deviation, std::sqrt(8.25), 1e-9) << "of 0 to 9";
    EXPECT_NEAR(*figures.shareOver, 0.3, 1e-9) << "7, 8 and 9";
    EXPECT_NEAR(*figures.shareUnder, 0.2, 1e-9) << "0 and 1";
}

TEST(FieldStatistics, SumsOfLabelsAreThoseOfTheirUnion) {
    const SemanticVolume volume = storeyWithTwoRooms();
    const auto sums = sumField(ramp("air", {0}), volume);
    const std::uint32_t all[] = {0, 1, 2, 3};
    const FieldFigures figures = figuresAt(*sums, all, 0);
    EXPECT_NEAR(figures.volume, 1800 * kVoxel, 1e-9) << "the wall is not in the medium";
    EXPECT_NEAR(*figures.mean, 10, 1e-9);
    EXPECT_EQ(figures.max, 20);
    const std::uint32_t wall[] = {3};
    const FieldFigures none = figuresAt(*sums, wall, 0);
    EXPECT_EQ(none.volume, 0);
    EXPECT_EQ(none.missing, 0);
    EXPECT_FALSE(none.mean || none.min || none.max || none.deviation || none.shareOver) << "unknown, not 0";
}

TEST(FieldStatistics, HoursAreInterpolatedBetweenTimes) {
    const SemanticVolume volume = storeyWithTwoRooms();
    StatisticsOptions options;
    options.over = 54.5;
    options.under = 29.5;
    const auto sums = sumField(ramp("air", {0, 7200, 14400}), volume, options);
    const std::uint32_t west[] = {1};  // means 4.5, 104.5, 204.5
    const HoursBeyond hours = hoursBeyond(*sums, west);
    EXPECT_NEAR(*hours.over, 1 + 2, 1e-6);
    EXPECT_NEAR(*hours.under, 0.5, 1e-6);
    EXPECT_NEAR(hours.known, 4, 1e-9);
    EXPECT_EQ(hours.unknown, 0);
    const FieldFigures overall = figuresOverTimes(*sums, west);
    EXPECT_NEAR(*overall.mean, 104.5, 1e-6);
    EXPECT_EQ(overall.max, 209);
    EXPECT_NEAR(overall.volume, 900 * kVoxel, 1e-9);
    const std::uint32_t wall[] = {3};
    EXPECT_FALSE(hoursBeyond(*sums, wall).over);
    EXPECT_NEAR(hoursBeyond(*sums, wall).unknown, 4, 1e-9);
}

TEST(FieldStatistics, DoNotDependOnTheThreads) {
    const SemanticVolume volume = storeyWithTwoRooms();
    StatisticsOptions one, two;
    one.threads = 1;
    two.threads = 2;
    const auto a = sumField(ramp("all", {0, 1}), volume, one), b = sumField(ramp("all", {0, 1}), volume, two);
    for (std::size_t s = 0; s < a->sums.size(); ++s) {
        EXPECT_EQ(a->sums[s].sum, b->sums[s].sum);
        EXPECT_EQ(a->sums[s].squares, b->sums[s].squares);
        EXPECT_EQ(a->sums[s].voxels, b->sums[s].voxels);
    }
}

TEST(FieldStatistics, OfVectorsAreThoseOfAComponentOrTheLength) {
    const SemanticVolume volume = storeyWithTwoRooms();
    Field field = ramp("air", {0});
    field.head.components = 3;
    field.values.assign(3 * 2100, 3);
    for (std::size_t v = 0; v < 2100; ++v) field.values[v] = 4;
    for (std::size_t v = 4200; v < 6300; ++v) field.values[v] = 0;
    const std::uint32_t west[] = {1};
    StatisticsOptions options;
    EXPECT_EQ(figuresAt(*sumField(field, volume, options), west, 0).mean, 4);
    options.component = StatisticsOptions::kMagnitude;
    EXPECT_EQ(figuresAt(*sumField(field, volume, options), west, 0).mean, 5);
    options.component = 3;
    EXPECT_EQ(sumField(field, volume, options).error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::fields
