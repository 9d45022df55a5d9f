#include <svt/render/ray_labels.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace svt::render {
namespace {

using volume::BrickVolume;
using volume::ColumnVolume;
using volume::Grid;
using volume::Scalar;

// Label 0 has the scalars 1 and 2, label 1 has 3.
volume::LabelTable twoLabels() {
    volume::LabelTable table;
    table.labels.resize(2);
    table.labels[0].first = 1;
    table.labels[0].count = 2;
    table.labels[1].first = 3;
    table.labels[1].count = 1;
    return table;
}

TEST(RayLabels, AreThoseAlongAnAxisInMetres) {
    std::vector<Scalar> dense;
    for (int n = 0; n < 20 * 10 * 10; ++n) {
        const int i = n % 20;
        dense.push_back(i < 3 ? 0 : i < 7 ? 1 : i < 9 ? 2 : i < 12 ? 3 : i < 15 ? 0 : 1);
    }
    const auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense({20, 10, 10}, dense), {.threads = 1});
    const Grid grid = *Grid::fromParts({20, 10, 10}, {0.5, 0.5, 0.5}, {100, 200, 300},
                                       {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const auto along = labelsAlong(*bricks, grid, twoLabels(), {98.75, 202, 302}, {3, 0, 0});
    ASSERT_TRUE(along);
    // The grid's voxels begin at 99.75; both scalars of label 0 are one interval.
    ASSERT_EQ(along->size(), 3u);
    const LabelInterval expected[] = {{0, 2.5, 5.5}, {1, 5.5, 7}, {0, 8.5, 11}};
    for (std::size_t s = 0; s < 3; ++s) {
        EXPECT_EQ((*along)[s].label, expected[s].label);
        EXPECT_NEAR((*along)[s].enter, expected[s].enter, 1e-12);
        EXPECT_NEAR((*along)[s].leave, expected[s].leave, 1e-12);
    }
    // From inside, and back.
    const auto back = labelsAlong(*bricks, grid, twoLabels(), {103, 202, 302}, {-1, 0, 0});
    ASSERT_EQ(back->size(), 1u);
    EXPECT_NEAR(back->at(0).leave, 1.75, 1e-12);
    EXPECT_TRUE(labelsAlong(*bricks, grid, twoLabels(), {98, 300, 302}, {1, 0, 0})->empty());
    for (const Vec3d direction : {Vec3d{0, 0, 0}, Vec3d{NAN, 0, 1}})
        EXPECT_EQ(labelsAlong(*bricks, grid, twoLabels(), {}, direction).error().code(), Code::BadArgument);
}

TEST(RayLabels, ManyRaysAreThoseOfEachAlone) {
    std::mt19937 random(5);
    std::vector<Scalar> dense;
    for (int n = 0; n < 40 * 30 * 20; ++n) dense.push_back(random() % 7 == 0 ? random() % 4 : n / 9000);
    const auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense({40, 30, 20}, dense), {.threads = 1});
    const Grid grid = *Grid::fromParts({40, 30, 20}, {0.5, 0.5, 0.5}, {100, 200, 300},
                                       {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    std::uniform_real_distribution<double> at(-3, 23);
    std::vector<Vec3d> origins, directions;
    for (int r = 0; r < 3000; ++r) {
        origins.push_back(Vec3d{100, 200, 300} + Vec3d{at(random), at(random), at(random)});
        directions.push_back({at(random) - 10, at(random) - 10, at(random) - 10});
    }
    const auto rays = labelsAlongRays(*bricks, grid, twoLabels(), origins, directions);
    ASSERT_TRUE(rays);
    ASSERT_EQ(rays->start.size(), 3001u);
    ASSERT_EQ(rays->start.back(), rays->intervals.size());
    std::size_t hits = 0;
    for (std::size_t r = 0; r < origins.size(); ++r) {
        const auto alone = labelsAlong(*bricks, grid, twoLabels(), origins[r], directions[r]);
        hits += !alone->empty();
        const std::vector<LabelInterval> among(rays->intervals.begin() + std::ptrdiff_t(rays->start[r]),
                                               rays->intervals.begin() + std::ptrdiff_t(rays->start[r + 1]));
        ASSERT_EQ(among, *alone) << r;
    }
    EXPECT_GT(hits, 500u);
    const auto one = labelsAlongRays(*bricks, grid, twoLabels(), origins, directions, 1);
    EXPECT_EQ(one->intervals, rays->intervals);
    // One direction for all.
    const auto down = labelsAlongRays(*bricks, grid, twoLabels(), origins, std::vector<Vec3d>{{0, 0, -1}});
    ASSERT_TRUE(down);
    EXPECT_EQ(down->start[1], labelsAlong(*bricks, grid, twoLabels(), origins[0], {0, 0, -1})->size());
}

TEST(RayLabels, RaysThatAreNoneAreNamed) {
    const auto bricks =
        BrickVolume::fromColumns(ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>(8, 1)), {.threads = 1});
    const Grid grid;
    const std::vector<Vec3d> three(3), good(3, Vec3d{1, 0, 0});
    const auto few = labelsAlongRays(*bricks, grid, twoLabels(), three, std::vector<Vec3d>(2, Vec3d{1, 0, 0}));
    EXPECT_EQ(few.error().code(), Code::BadArgument);
    std::vector<Vec3d> bad = good;
    bad[2] = {};
    const auto zero = labelsAlongRays(*bricks, grid, twoLabels(), three, bad);
    ASSERT_FALSE(zero);
    EXPECT_EQ(zero.error().message().substr(0, 5), "ray 2");
    EXPECT_EQ(labelsAlongRays(*bricks, grid, twoLabels(), {}, good).error().code(), Code::BadArgument);
    EXPECT_EQ(labelsAlongRays(*bricks, grid, twoLabels(), {}, {})->start, std::vector<std::uint64_t>{0});
    Progress stopped;
    stopped.cancel = true;
    EXPECT_EQ(labelsAlongRays(*bricks, grid, twoLabels(), three, good, 0, &stopped).error().code(), Code::Cancelled);
}

TEST(RayLabels, MeetASphereWhereItIs) {
    std::vector<Scalar> dense;
    for (int k = 0; k < 48; ++k)
        for (int j = 0; j < 48; ++j)
            for (int i = 0; i < 48; ++i) {
                const Vec3d p{i - 24.2, j - 23.7, k - 24.1};
                dense.push_back(dot(p, p) < 18 * 18 ? 3 : 0);
            }
    const auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense({48, 48, 48}, dense), {.threads = 1});
    const double turn = 0.6;
    const Grid grid = *Grid::fromParts({48, 48, 48}, {0.1, 0.1, 0.1}, {5, 6, 7},
                                       {Vec3d{turn, 0.8, 0}, Vec3d{-0.8, turn, 0}, Vec3d{0, 0, 1}});
    const Vec3d center = grid.worldFromIndex({24.2, 23.7, 24.1});
    std::mt19937 random(5);
    const auto unit = [&] { return double(random()) / 2147483648.0 - 1; };
    for (int ray = 0; ray < 100; ++ray) {
        const Vec3d direction = normalized(Vec3d{unit(), unit(), unit()});
        const auto along = labelsAlong(*bricks, grid, twoLabels(), center - direction * 4.0, direction);
        ASSERT_TRUE(along);
        ASSERT_EQ(along->size(), 1u);
        // Within a voxel's half diagonal.
        EXPECT_NEAR(along->at(0).enter, 4 - 1.8, 0.09);
        EXPECT_NEAR(along->at(0).leave, 4 + 1.8, 0.09);
    }
}

}  // namespace
}  // namespace svt::render
