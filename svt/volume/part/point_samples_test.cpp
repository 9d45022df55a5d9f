#include <svt/volume/point_samples.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace svt::volume {
namespace {

// 3 x 2 x 4 samples with the scalar 1 + i + 3 j + 6 k, spacing 0.5, 1, 0.25 m, turned by 90 degrees about z.
struct Numbered {
    Vec3i dimension{3, 2, 4};
    Grid grid =
        *Grid::fromParts(dimension, {0.5, 1, 0.25}, {100, 200, 10}, {Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}});
    ColumnVolume columns = [this] {
        std::vector<Scalar> scalars(24);
        for (Scalar s = 0; s < 24; ++s) scalars[s] = s + 1;
        return ColumnVolume::fromDense(dimension, scalars);
    }();

    [[nodiscard]] std::vector<Scalar> at(std::vector<Vec3d> points, int threads = 0) const {
        std::vector<Scalar> out(points.size(), 77);
        samplePoints(columns, grid, points, out, threads);
        return out;
    }
};

TEST(PointSamples, EachSampleAnswersAtItsPlaceAndInItsVoxel) {
    const Numbered volume;
    std::vector<Vec3d> points;
    std::vector<Scalar> expected;
    for (std::int32_t k = 0; k < 4; ++k)
        for (std::int32_t j = 0; j < 2; ++j)
            for (std::int32_t i = 0; i < 3; ++i)
                for (const double off : {0.0, 0.49, -0.49}) {
                    points.push_back(volume.grid.worldFromIndex({i + off, j - off, k + off}));
                    expected.push_back(Scalar(1 + i + 3 * j + 6 * k));
                }
    EXPECT_EQ(volume.at(points), expected);
    // One place by hand: i runs along y, j along -x.
    EXPECT_EQ(volume.at({{99, 200.5, 10.75}}), std::vector<Scalar>{1 + 1 + 3 + 18});
}

TEST(PointSamples, OutsideIsBackground) {
    const Numbered volume;
    const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::infinity();
    EXPECT_EQ(volume.at({volume.grid.worldFromIndex({-0.51, 0, 0}),
                         volume.grid.worldFromIndex({2.51, 0, 0}),
                         volume.grid.worldFromIndex({0, 1.51, 0}),
                         volume.grid.worldFromIndex({0, 0, 3.51}),
                         {nan, 200, 10},
                         {huge, 200, 10},
                         {1e300, -1e300, 0}}),
              std::vector<Scalar>(7, 0));
    EXPECT_EQ(volume.at({}), std::vector<Scalar>{});
}

TEST(PointSamples, AnyNumberOfThreadsGivesTheSame) {
    const Numbered volume;
    std::vector<Vec3d> points;
    for (int n = 0; n < 50000; ++n)
        points.push_back({98.5 + 2.0 * std::sin(n), 200.5 + std::sin(1.7 * n), 10.4 + 0.6 * std::sin(2.3 * n)});
    EXPECT_EQ(volume.at(points, 1), volume.at(points, 4));
}

}  // namespace
}  // namespace svt::volume
