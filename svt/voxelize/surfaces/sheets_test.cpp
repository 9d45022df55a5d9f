#include <svt/voxelize/solids_test.hpp>
#include <svt/voxelize/surfaces/sheets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace svt::voxelize {
namespace {

using volume::Grid;
using Voxel = std::tuple<int, int, int>;

const Vec3i kUnits{20, 20, 20};

Grid unitGrid() {
    return *Grid::fromParts(kUnits, {1, 1, 1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

std::set<Voxel> voxelsOf(const std::vector<ClaimedBox>& boxes) {
    std::set<Voxel> voxels;
    for (const ClaimedBox& box : boxes) {
        EXPECT_EQ(box.claim, 5u);
        for (int j = box.firstRow; j < box.endRow; ++j)
            for (int i = box.begin; i < box.end; ++i)
                for (int k = box.low; k < box.high; ++k) voxels.insert({i, j, k});
    }
    return voxels;
}

mesh::ObjectMesh triangleMesh(Vec3d a, Vec3d b, Vec3d c) {
    mesh::ObjectMesh mesh;
    mesh.vertices = {a, b, c};
    test::addTriangle(mesh, 0, 1, 2);
    mesh.closingMethod = mesh::ClosingMethod::Surface;
    return mesh;
}

mesh::ObjectMesh quadMesh(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    mesh::ObjectMesh mesh = triangleMesh(a, b, c);
    mesh.vertices.push_back(d);
    test::addTriangle(mesh, 0, 2, 3);
    return mesh;
}

std::set<Voxel> thinSheet(const mesh::ObjectMesh& mesh, bool boundsBody = false) {
    const auto meshes = test::meshSetOf({mesh});
    std::vector<ClaimedBox> boxes;
    addThinSheet(makeIndexMesh(meshes.objects[0], IndexFromLocal(meshes, unitGrid())), kUnits, 5, boundsBody, boxes);
    return voxelsOf(boxes);
}

std::set<Voxel> conservativeSheet(const mesh::ObjectMesh& mesh) {
    const auto meshes = test::meshSetOf({mesh});
    std::vector<ClaimedBox> boxes;
    addConservativeSheet(makeIndexMesh(meshes.objects[0], IndexFromLocal(meshes, unitGrid())), kUnits, 5, boxes);
    return voxelsOf(boxes);
}

// A roof of a house that is turned in plan. Beyond its edge, where a wall stands, samples lie behind its plane, and neighbours
// along x or y before it. Of a roof that bounds a body these are none of its voxels: they would stick out of the wall.
TEST(AddThinSheet, ASurfaceAroundABodyDoesNotStickOutAtItsEdges) {
    const Vec3d along{0.6, 0.8, 0}, across{-0.8, 0.6, 0.7}, low{8.1, 0.7, 1.2};
    const auto roof = quadMesh(low, low + along * 14.3, low + along * 14.3 + across * 7.7, low + across * 7.7);
    const auto isUnderRoof = [&](const Voxel& voxel) {
        const double x = std::get<0>(voxel) - low.x, y = std::get<1>(voxel) - low.y;
        const double u = 0.6 * x + 0.8 * y, v = -0.8 * x + 0.6 * y;
        return u > -0.01 && u < 14.31 && v > -0.01 && v < 7.71;
    };
    const auto all = thinSheet(roof), bounding = thinSheet(roof, true);
    EXPECT_GT(std::count_if(all.begin(), all.end(), [&](const Voxel& v) { return !isUnderRoof(v); }), 2);
    EXPECT_EQ(std::count_if(bounding.begin(), bounding.end(), [&](const Voxel& v) { return !isUnderRoof(v); }), 0);
    // Under the roof both are the same.
    for (const Voxel& voxel : all) EXPECT_EQ(bounding.count(voxel) != 0, isUnderRoof(voxel));
}

TEST(AddThinSheet, TheSampleBehindTheFaceGetsTheVoxel) {
    // A floor at z = 4.4 that looks up, and one that looks down.
    const auto up = thinSheet(quadMesh({1.5, 1.5, 4.4}, {6.5, 1.5, 4.4}, {6.5, 3.5, 4.4}, {1.5, 3.5, 4.4}));
    const auto down = thinSheet(quadMesh({1.5, 1.5, 4.4}, {1.5, 3.5, 4.4}, {6.5, 3.5, 4.4}, {6.5, 1.5, 4.4}));
    std::set<Voxel> below, above;
    for (int i = 2; i <= 6; ++i)
        for (int j = 2; j <= 3; ++j) {
            below.insert({i, j, 4});
            above.insert({i, j, 5});
        }
    EXPECT_EQ(up, below);
    EXPECT_EQ(down, above);
}

TEST(AddThinSheet, WallsAlongBothAxesLikewise) {
    // Walls at 7.6 that look east and north.
    const auto east = thinSheet(quadMesh({7.6, 1.5, 1.5}, {7.6, 4.5, 1.5}, {7.6, 4.5, 3.5}, {7.6, 1.5, 3.5}));
    const auto north = thinSheet(quadMesh({4.5, 7.6, 1.5}, {1.5, 7.6, 1.5}, {1.5, 7.6, 3.5}, {4.5, 7.6, 3.5}));
    std::set<Voxel> eastVoxels, northVoxels;
    for (int a = 2; a <= 4; ++a)
        for (int k = 2; k <= 3; ++k) {
            eastVoxels.insert({7, a, k});
            northVoxels.insert({a, 7, k});
        }
    EXPECT_EQ(east, eastVoxels);
    EXPECT_EQ(north, northVoxels);
}

TEST(AddThinSheet, SheetsOnTheTwoSidesOfAFaceShareNoVoxel) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-3, 23);
    for (int n = 0; n < 100; ++n) {
        const auto point = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
        const Vec3d a = point(), b = point(), c = point();
        const auto front = thinSheet(triangleMesh(a, b, c)), back = thinSheet(triangleMesh(a, c, b));
        for (const Voxel& voxel : front) {
            const auto [i, j, k] = voxel;
            ASSERT_TRUE(i >= 0 && j >= 0 && k >= 0 && i < 20 && j < 20 && k < 20);
            // At the border of the grid the only existing sample is used for both.
            if (i == 0 || j == 0 || k == 0 || i == 19 || j == 19 || k == 19) continue;
            ASSERT_EQ(back.count(voxel), 0u) << n << ": " << i << ' ' << j << ' ' << k;
        }
    }
}

TEST(AddThinSheet, EveryPairOfSamplesWithTheSheetBetweenIsParted) {
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> uniform(-3, 23);
    int parted = 0;
    for (int n = 0; n < 60; ++n) {
        const auto point = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
        const Vec3d v[3] = {point(), point(), point()};
        const auto voxels = thinSheet(triangleMesh(v[0], v[1], v[2]));
        const Vec3d normal = normalized(cross(v[1] - v[0], v[2] - v[0]));
        for (int axis = 0; axis < 3; ++axis)
            for (int a = 0; a < 20; ++a)
                for (int b = 0; b < 20; ++b)
                    for (int c = 0; c < 19; ++c) {
                        Vec3d low{};
                        low[(axis + 1) % 3] = a;
                        low[(axis + 2) % 3] = b;
                        low[axis] = c;
                        // Where the line from this sample to the next meets the plane; not tested near its ends and
                        // near edges.
                        if (std::abs(normal[axis]) < 1e-3) continue;
                        const double t = dot(v[0] - low, normal) / normal[axis];
                        if (t < 0.02 || t > 0.98) continue;
                        Vec3d hit = low;
                        hit[axis] += t;
                        double inside = 1e9;
                        for (int e = 0; e < 3; ++e)
                            inside = std::min(inside, dot(cross(v[(e + 1) % 3] - v[e], hit - v[e]), normal) /
                                                          length(v[(e + 1) % 3] - v[e]));
                        if (inside < 0.02) continue;
                        Vec3d high = low;
                        high[axis] += 1;
                        const Vec3d behind = normal[axis] > 0 ? low : high;
                        ++parted;
                        ASSERT_EQ(voxels.count({int(behind.x), int(behind.y), int(behind.z)}), 1u) << n;
                    }
    }
    EXPECT_GT(parted, 1000);
}

TEST(AddConservativeSheet, AreTheBoxesThatItTouches) {
    // A triangle in the plane x + y + z = 12.1, touched boxes by brute force: the plane cuts the box and the overlap in
    // the plane is found by clipping the triangle to the box.
    const Vec3d v[3] = {{8.3, 1.9, 1.9}, {2.1, 7.6, 2.4}, {1.7, 2.2, 8.2}};
    const auto voxels = conservativeSheet(triangleMesh(v[0], v[1], v[2]));
    const auto touches = [&](Vec3d center, double half) {
        std::vector<Vec3d> ring(v, v + 3);
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                std::vector<Vec3d> clipped;
                for (std::size_t c = 0; c < ring.size(); ++c) {
                    const Vec3d p = ring[c], q = ring[(c + 1) % ring.size()];
                    const double dp = half - sign * (p[axis] - center[axis]),
                                 dq = half - sign * (q[axis] - center[axis]);
                    if (dp >= 0) clipped.push_back(p);
                    if ((dp >= 0) != (dq >= 0)) clipped.push_back(p + (q - p) * (dp / (dp - dq)));
                }
                ring = std::move(clipped);
                if (ring.empty()) return false;
            }
        return true;
    };
    int certain = 0;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 20; ++k) {
                const Vec3d center{double(i), double(j), double(k)};
                const bool surely = touches(center, 0.49), hardly = !touches(center, 0.51);
                certain += surely;
                if (surely) {
                    EXPECT_EQ(voxels.count({i, j, k}), 1u) << i << ' ' << j << ' ' << k;
                }
                if (hardly) {
                    EXPECT_EQ(voxels.count({i, j, k}), 0u) << i << ' ' << j << ' ' << k;
                }
            }
    EXPECT_GT(certain, 50);
}

TEST(AddConservativeSheet, HoldsTheThinSheetBesideTheFace) {
    // A thin sheet's voxel lies at most one sample from the face, so its box or its neighbour's is touched.
    const auto mesh = triangleMesh({2.2, 3.1, 4.7}, {15.4, 5.2, 6.3}, {7.9, 16.8, 12.2});
    const auto thin = thinSheet(mesh), fat = conservativeSheet(mesh);
    EXPECT_FALSE(thin.empty());
    EXPECT_GT(fat.size(), thin.size());
    for (const auto& [i, j, k] : thin) {
        bool isMet = false;
        for (int d = 0; d < 27; ++d) isMet = isMet || fat.count({i + d % 3 - 1, j + d / 3 % 3 - 1, k + d / 9 - 1}) != 0;
        EXPECT_TRUE(isMet);
    }
}

std::pair<std::set<Voxel>, std::uint64_t> thinParts(const mesh::ObjectMesh& mesh) {
    const auto meshes = test::meshSetOf({mesh});
    const IndexFromLocal indexFromLocal(meshes, unitGrid());
    std::vector<ClaimedBox> boxes;
    const std::uint64_t count =
        addThinParts(makeIndexMesh(meshes.objects[0], indexFromLocal), indexFromLocal, kUnits, {5, 5}, boxes);
    return {voxelsOf(boxes), count};
}

TEST(AddThinParts, BodiesThickerThanAVoxelGetNothing) {
    const auto [voxels, count] = thinParts(test::box({2.3, 2.3, 2.3}, {9.6, 8.7, 6.5}));
    EXPECT_TRUE(voxels.empty());
    EXPECT_EQ(count, 0u);
}

TEST(AddThinParts, SlabBetweenTwoSamplesGetsTheNearerLayer) {
    for (const auto& [low, high, layer] : {std::tuple{4.2, 4.4, 4}, {4.6, 4.8, 5}}) {
        const auto [voxels, count] = thinParts(test::box({2.5, 2.5, low}, {9.5, 8.5, high}));
        std::set<Voxel> expected;
        for (int i = 3; i <= 9; ++i)
            for (int j = 3; j <= 8; ++j) expected.insert({i, j, layer});
        EXPECT_EQ(voxels, expected) << low;
        EXPECT_EQ(count, expected.size());
    }
}

TEST(AddThinParts, SlabWithSamplesInItNeedsNone) {
    EXPECT_EQ(thinParts(test::box({2.5, 2.5, 3.8}, {9.5, 8.5, 4.3})).second, 0u);
}

TEST(AddThinParts, RodIsALineWithoutGaps) {
    const auto [voxels, count] = thinParts(test::box({4.3, 6.4, 2.2}, {4.5, 6.6, 15.7}));
    EXPECT_EQ(count, voxels.size());
    for (int k = 3; k <= 15; ++k) {
        bool isMet = false;
        for (int i = 4; i <= 5; ++i)
            for (int j = 6; j <= 7; ++j) isMet = isMet || voxels.count({i, j, k}) != 0;
        EXPECT_TRUE(isMet) << k;
    }
}

}  // namespace
}  // namespace svt::voxelize
