#include <svt/render/light/surface_normal.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace svt::render {
namespace {

using test::makeVolume;
using test::TestVolume;

const auto kBody = [](volume::Scalar scalar) { return scalar != 0; };

TEST(VoxelWindow, ShowsTheVoxelsAroundAlsoAcrossBricksAndBorders) {
    std::mt19937 random(9);
    const Vec3i n{21, 19, 26};
    const TestVolume volume = makeVolume(n, {1, 1, 1}, [&](auto, auto, auto) { return random() % 3; });
    for (int round = 0; round < 300; ++round) {
        const Vec3i middle{int(random() % 25) - 2, int(random() % 23) - 2, int(random() % 30) - 2};
        const VoxelWindow window = voxelWindow(volume.bricks, middle, kBody);
        for (int z = 0; z < 7; ++z)
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) {
                    const Vec3i p{middle.x + x - 3, middle.y + y - 3, middle.z + z - 3};
                    const bool isInside =
                        x < 7 && y < 7 && p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < n.x && p.y < n.y && p.z < n.z;
                    const bool expected = isInside && volume.bricks.scalarAt(p.x, p.y, p.z) != 0;
                    ASSERT_EQ((window[std::size_t(z)] >> (x + 8 * y)) & 1, expected);
                }
    }
}

// The normal where a ray that comes along -axis meets the body in the column through (a, b) of that axis.
Vec3d normalAlong(const TestVolume& volume, int axis, int sign, Vec3i at) {
    at[axis] = sign > 0 ? volume.bricks.dimension()[axis] - 1 : 0;
    while (volume.bricks.scalarAt(at.x, at.y, at.z) == 0) at[axis] -= sign;
    const SurfaceNormal normal = surfaceNormal(volume.bricks, at, axis, sign, kBody);
    return normalized({normal.indexNormal.x, normal.indexNormal.y, normal.indexNormal.z});
}

TEST(SurfaceNormal, WallsAlongTheAxesHaveExactNormalsUpToTheirEdges) {
    const TestVolume volume = makeVolume({40, 40, 40}, {1, 1, 1}, [](auto i, auto j, auto k) {
        return i >= 8 && i < 30 && j >= 10 && j < 33 && k >= 5 && k < 28 ? 1u : 0u;
    });
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1})
            for (const int offset : {11, 20, 27}) {
                Vec3d expected{};
                expected[axis] = sign;
                EXPECT_EQ(normalAlong(volume, axis, sign, {offset, offset, offset}), expected);
            }
    for (std::int32_t i = 8; i < 30; ++i) EXPECT_EQ(normalAlong(volume, 2, 1, {i, 20, 0}), (Vec3d{0, 0, 1})) << i;
    for (std::int32_t k = 5; k < 28; ++k) EXPECT_EQ(normalAlong(volume, 1, -1, {20, 0, k}), (Vec3d{0, -1, 0})) << k;
}

TEST(SurfaceNormal, ASheetOfOneVoxelHasTwoSides) {
    const TestVolume volume = makeVolume({32, 32, 32}, {1, 1, 1}, [](auto, auto j, auto) { return j == 16 ? 1u : 0u; });
    EXPECT_EQ(normalAlong(volume, 1, -1, {16, 0, 16}), (Vec3d{0, -1, 0}));
    EXPECT_EQ(normalAlong(volume, 1, 1, {16, 0, 16}), (Vec3d{0, 1, 0}));
}

TEST(SurfaceNormal, SlopesAreSmooth) {
    for (const double degrees : {15.0, 22.0, 30.0, 38.0, 45.0, 60.0, 71.0}) {
        const double angle = degrees * 3.14159265358979 / 180;
        const Vec3d plane{0, -std::sin(angle), std::cos(angle)};
        const TestVolume volume = makeVolume({40, 64, 64}, {1, 1, 1}, [&](auto i, auto j, auto k) {
            return dot(plane, Vec3d{i + 0.5, j - 31.7, k - 31.7}) < 0 ? 1u : 0u;
        });
        double worst = 0, sum = 0;
        for (std::int32_t j = 24; j < 40; ++j) {
            const Vec3d normal = normalAlong(volume, 2, 1, {20, j, 0});
            const double off = std::acos(std::min(1.0, dot(normal, plane))) * 57.3;
            worst = std::max(worst, off);
            sum += off;
        }
        // What the rounding to voxels leaves within seven of them.
        EXPECT_LT(worst, 10) << degrees;
        EXPECT_LT(sum / 16, 3) << degrees;
    }
}

TEST(SurfaceNormal, SpheresAreRound) {
    const Vec3d middle{32, 32, 32};
    const TestVolume volume = makeVolume({64, 64, 64}, {1, 1, 1}, [&](auto i, auto j, auto k) {
        return length(Vec3d{i + 0.5, j + 0.5, k + 0.5} - middle) < 25 ? 1u : 0u;
    });
    double sum = 0, worst = 0;
    int count = 0;
    for (std::int32_t j = 15; j < 49; ++j)
        for (std::int32_t i = 15; i < 49; ++i, ++count) {
            Vec3i at{i, j, 63};
            while (volume.bricks.scalarAt(at.x, at.y, at.z) == 0) --at.z;
            const Vec3d expected = normalized(Vec3d{at.x + 0.5, at.y + 0.5, at.z + 1.0} - middle);
            const double off = std::acos(std::min(1.0, dot(normalAlong(volume, 2, 1, {i, j, 0}), expected))) * 57.3;
            sum += off;
            worst = std::max(worst, off);
        }
    EXPECT_LT(sum / count, 2.5);
    EXPECT_LT(worst, 12);
}

TEST(SurfaceNormal, CornersAreMoreCoveredThanPlanes) {
    const TestVolume plane = makeVolume({32, 32, 32}, {1, 1, 1}, [](auto, auto, auto k) { return k < 16 ? 1u : 0u; });
    const TestVolume corner =
        makeVolume({32, 32, 32}, {1, 1, 1}, [](auto i, auto, auto k) { return k < 16 || i < 16 ? 1u : 0u; });
    const float flat = surfaceNormal(plane.bricks, {16, 16, 15}, 2, 1, kBody).filledShare;
    EXPECT_FLOAT_EQ(flat, SurfaceNormal::kPlaneFilledShare);
    EXPECT_GT(surfaceNormal(corner.bricks, {16, 16, 15}, 2, 1, kBody).filledShare, flat + 0.1f);
}

}  // namespace
}  // namespace svt::render
