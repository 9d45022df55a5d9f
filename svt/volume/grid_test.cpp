#include <svt/volume/grid.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace svt::volume {
namespace {

const std::array<Vec3d, 3> kIdentity{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

void expectNear(Vec3d a, Vec3d b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Grid, SpacingIsEnvelopeOverDimensionMinusOne) {
    const auto grid = Grid::fromDimension({{10, 20, 30}, {26.5, 31, 43.5}}, {100, 101, 50});
    ASSERT_TRUE(grid);
    EXPECT_DOUBLE_EQ(grid->spacing().x, 16.5 / 99);
    EXPECT_DOUBLE_EQ(grid->spacing().y, 11.0 / 100);
    EXPECT_DOUBLE_EQ(grid->spacing().z, 13.5 / 49);
    EXPECT_EQ(grid->sampleCount(), 100u * 101 * 50);
    EXPECT_DOUBLE_EQ(grid->voxelVolume(), 16.5 / 99 * 0.11 * 13.5 / 49);
}

TEST(Grid, FirstAndLastSamplesLieOnTheEnvelope) {
    const Box3d envelope{{458877.03, 5438353.7, 111.6}, {458899.4, 5438370.1, 121.2}};
    const auto grid = Grid::fromDimension(envelope, {801, 701, 401});
    ASSERT_TRUE(grid);
    expectNear(grid->worldFromIndex({0, 0, 0}), envelope.min, 1e-12);
    expectNear(grid->worldFromIndex({800, 700, 400}), envelope.max, 1e-8);
}

TEST(Grid, AxisWithoutExtentIsWidenedEvenly) {
    const auto grid = Grid::fromDimension({{0, 0, 5}, {10, 20, 5}}, {11, 21, 3});
    ASSERT_TRUE(grid);
    EXPECT_DOUBLE_EQ(grid->spacing().z, 0.02 / 2);  // one thousandth of 20 m over two steps
    EXPECT_DOUBLE_EQ(grid->origin().z, 5 - 0.01);
    const auto point = Grid::fromDimension({{1, 2, 3}, {1, 2, 3}}, {2, 2, 2});
    ASSERT_TRUE(point);
    EXPECT_DOUBLE_EQ(point->spacing().x, 1e-3);
    expectNear(point->worldFromIndex({0.5, 0.5, 0.5}), {1, 2, 3}, 1e-12);
}

TEST(Grid, SpacingWidensTheEnvelopeEvenlyToWholeStepsAndHalfAStep) {
    const Box3d envelope{{1, 2, 3}, {2.05, 3, 3.9}};
    const auto grid = Grid::fromSpacing(envelope, {0.1, 0.25, 0.4});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->dimension(), (Vec3i{13, 6, 5}));  // 1.05 -> 11 steps, 1.0 -> 4, 0.9 -> 3; one more of margin
    EXPECT_EQ(grid->spacing(), (Vec3d{0.1, 0.25, 0.4}));
    const Vec3d low = grid->worldFromIndex({0, 0, 0}), high = grid->worldFromIndex({12, 5, 4});
    expectNear((low + high) * 0.5, envelope.center(), 1e-12);
    expectNear(high - low, {1.2, 1.25, 1.6}, 1e-12);
}

TEST(Grid, WholeNumberOfStepsGetsNoStepMoreByRounding) {
    for (const double shift : {0.0, 458877.03, -0.7}) {
        const auto grid =
            Grid::fromSpacing({{shift, shift, shift}, {shift + 0.3, shift + 0.7, shift + 16.5}}, {0.1, 0.1, 0.1});
        ASSERT_TRUE(grid);
        EXPECT_EQ(grid->dimension(), (Vec3i{5, 9, 167})) << shift;
        expectNear(grid->origin(), {shift - 0.05, shift - 0.05, shift - 0.05}, 1e-9);
    }
}

TEST(Grid, FlatEnvelopeBySpacingHasTwoSamples) {
    const auto grid = Grid::fromSpacing({{0, 0, 1}, {1, 1, 1}}, {0.5, 0.5, 0.5});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->dimension(), (Vec3i{4, 4, 2}));
    EXPECT_DOUBLE_EQ(grid->origin().z, 0.75);
}

TEST(Grid, DimensionOutOfRangeNamesValueAndAxis) {
    const Box3d box{{0, 0, 0}, {1, 1, 1}};
    for (const Vec3i bad : {Vec3i{1, 5, 5}, {5, 0, 5}, {5, 5, -3}, {65536, 2, 2}}) {
        const auto grid = Grid::fromDimension(box, bad);
        ASSERT_FALSE(grid);
        EXPECT_EQ(grid.error().code(), Code::BadDimension);
    }
    EXPECT_TRUE(Grid::fromDimension(box, {2, 2, 65535}));
    const auto zero = Grid::fromDimension(box, {5, 0, 5});
    EXPECT_NE(zero.error().message().find("0 along y"), std::string::npos) << zero.error().message();
}

TEST(Grid, TooManyColumnsAreGridTooLarge) {
    const Box3d box{{0, 0, 0}, {1, 1, 1}};
    const auto grid = Grid::fromDimension(box, {65535, 65535, 2});
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code(), Code::GridTooLarge);
    EXPECT_TRUE(Grid::fromDimension(box, {65535, 32768, 2}));
}

TEST(Grid, EmptyOrInfiniteEnvelopeIsRefused) {
    for (const Box3d& box : {Box3d{}, Box3d{{0, 0, 0}, {kInfinity, 1, 1}}, Box3d{{-kInfinity, 0, 0}, {0, 1, 1}}}) {
        const auto byDimension = Grid::fromDimension(box, {5, 5, 5});
        const auto bySpacing = Grid::fromSpacing(box, {1, 1, 1});
        ASSERT_FALSE(byDimension || bySpacing);
        EXPECT_EQ(byDimension.error().code(), Code::BadDimension);
        EXPECT_EQ(bySpacing.error().code(), Code::BadDimension);
    }
}

TEST(Grid, BadSpacingIsRefused) {
    const Box3d box{{0, 0, 0}, {1, 1, 1}};
    for (const double bad : {0.0, -0.1, kInfinity, std::numeric_limits<double>::quiet_NaN(), 1e-9, 1e-300}) {
        const auto grid = Grid::fromSpacing(box, {0.1, bad, 0.1});
        ASSERT_FALSE(grid) << bad;
        EXPECT_EQ(grid.error().code(), Code::BadDimension) << bad;
    }
    const auto large = Grid::fromSpacing(box, {1.0 / 60000, 1.0 / 60000, 0.1});
    ASSERT_FALSE(large);
    EXPECT_EQ(large.error().code(), Code::GridTooLarge);
}

TEST(Grid, PartsComeBackAsTheyWere) {
    const auto made = Grid::fromDimension({{1, 2, 3}, {4, 6, 8}}, {7, 9, 11});
    ASSERT_TRUE(made);
    const auto again = Grid::fromParts(made->dimension(), made->spacing(), made->origin(), made->axes());
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, *made);
    EXPECT_TRUE(again->isAxisParallel());
}

TEST(Grid, PartsThatAreNoGridAreRefused) {
    EXPECT_FALSE(Grid::fromParts({1, 2, 2}, {1, 1, 1}, {}, kIdentity));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 0, 1}, {}, kIdentity));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, kInfinity, 1}, {}, kIdentity));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {0, kInfinity, 0}, kIdentity));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {}, {Vec3d{2, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {}, {Vec3d{1, 0, 0}, Vec3d{0.1, 1, 0}, Vec3d{0, 0, 1}}));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {}, {Vec3d{kInfinity, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}));
}

TEST(Grid, MirroredAxesAreNoRotation) {
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, -1}}));
    EXPECT_FALSE(Grid::fromParts({2, 2, 2}, {1, 1, 1}, {}, {Vec3d{0, 1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}));
}

TEST(Grid, TurnedFrameGoesThereAndBack) {
    const double c = 0.8, s = 0.6;
    const std::array<Vec3d, 3> axes{Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}};
    const Vec3d pivot{458877, 5438353, 111};
    // Measured along the axes from the pivot: 12 x 8 x 5 m from (1, 2, 3).
    const auto flat = Grid::fromDimension({{1, 2, 3}, {13, 10, 8}}, {121, 81, 51});
    ASSERT_TRUE(flat);
    const Grid grid = flat->turned(axes, pivot);
    EXPECT_FALSE(grid.isAxisParallel());
    expectNear(grid.worldFromIndex({0, 0, 0}), pivot + axes[0] * 1 + axes[1] * 2 + axes[2] * 3, 1e-9);
    expectNear(grid.worldFromIndex({120, 80, 50}), pivot + axes[0] * 13 + axes[1] * 10 + axes[2] * 8, 1e-9);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-50, 200);
    for (int n = 0; n < 1000; ++n) {
        const Vec3d index{uniform(random), uniform(random), uniform(random)};
        expectNear(grid.indexFromWorld(grid.worldFromIndex(index)), index, 1e-6);
        expectNear(grid.indexFromWorldDirection(grid.worldFromIndexDirection(index)), index, 1e-9);
        EXPECT_NEAR(length(grid.worldFromIndexDirection(index)), length(index) * 0.1, 1e-9);
    }
}

}  // namespace
}  // namespace svt::volume
