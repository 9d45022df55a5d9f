#include <svt/core/triangle_distance.hpp>
#include <svt/voxelize/bodies.hpp>
#include <svt/voxelize/solids_test.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::voxelize {
namespace {

using volume::Grid;
using volume::Scalar;

// Nearest point by sampling the triangle ever finer around the best sample.
double sampledDistance(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    double bestU = 1.0 / 3, bestV = 1.0 / 3, reach = 1, best = 1e300;
    for (int round = 0; round < 12; ++round) {
        const double centerU = bestU, centerV = bestV;
        for (int i = -12; i <= 12; ++i)
            for (int j = -12; j <= 12; ++j) {
                const double u = std::clamp(centerU + reach * i / 12, 0.0, 1.0);
                const double v = std::clamp(centerV + reach * j / 12, 0.0, 1 - u);
                const double distance = length(p - (a + (b - a) * u + (c - a) * v));
                if (distance < best) {
                    best = distance;
                    bestU = u;
                    bestV = v;
                }
            }
        reach /= 3;
    }
    return best;
}

TEST(DistanceToTriangle, KnownAnswers) {
    const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{0, 3, 0};
    EXPECT_DOUBLE_EQ(distanceToTriangle({1, 1, 2}, a, b, c), 2);              // over the inside
    EXPECT_DOUBLE_EQ(distanceToTriangle({1, 1, 0}, a, b, c), 0);              // on it
    EXPECT_DOUBLE_EQ(distanceToTriangle({-3, -4, 0}, a, b, c), 5);            // corner a
    EXPECT_DOUBLE_EQ(distanceToTriangle({7, -4, 0}, a, b, c), 5);             // corner b
    EXPECT_DOUBLE_EQ(distanceToTriangle({0, 15, 5}, a, b, c), 13);            // corner c
    EXPECT_DOUBLE_EQ(distanceToTriangle({2, -3, 4}, a, b, c), 5);             // edge ab
    EXPECT_DOUBLE_EQ(distanceToTriangle({-3, 1, 4}, a, b, c), 5);             // edge ac
    EXPECT_NEAR(distanceToTriangle({2 + 3, 1.5 + 4, 0}, a, b, c), 5, 1e-12);  // edge bc, along its normal (3, 4) / 5
}

TEST(DistanceToTriangle, AgreesWithSampling) {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> uniform(-2, 2);
    const auto point = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
    for (int n = 0; n < 300; ++n) {
        const Vec3d a = point(), b = point(), c = point(), p = point();
        const double expected = sampledDistance(p, a, b, c);
        ASSERT_LE(distanceToTriangle(p, a, b, c), expected + 1e-12) << n;
        ASSERT_NEAR(distanceToTriangle(p, a, b, c), expected, 2e-3) << n;
        ASSERT_NEAR(distanceToTriangle(p, b, c, a), distanceToTriangle(p, a, b, c), 1e-12);
    }
}

TEST(DistanceToTriangle, TriangleWithoutAreaIsASegmentOrAPoint) {
    EXPECT_NEAR(distanceToTriangle({1, 1, 0}, {0, 0, 0}, {4, 0, 0}, {2, 0, 0}), 1, 1e-12);
    EXPECT_NEAR(distanceToTriangle({1, 2, 2}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 3, 1e-12);
    EXPECT_NEAR(distanceToTriangle({5, 0, 1}, {0, 0, 0}, {4, 0, 0}, {4, 0, 0}), std::sqrt(2.0), 1e-12);
}

mesh::ObjectMesh sideOf(Vec3d low, Vec3d high, int side) {
    const auto at = [&](int i) {
        return Vec3d{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    };
    static constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    mesh::ObjectMesh mesh;
    for (const int corner : kCorners[side]) mesh.vertices.push_back(at(corner));
    test::addTriangle(mesh, 0, 1, 2);
    test::addTriangle(mesh, 0, 2, 3);
    mesh.closingMethod = mesh::ClosingMethod::Surface;
    return mesh;
}

// A building with one room, six surfaces outside and six around the room. Object 0 is the building, 1 the room, 2 to 13
// the surfaces; scalars are one more.
class House : public ::testing::Test {
protected:
    House() {
        std::vector<mesh::ObjectMesh> objects{test::box(low_, high_), test::box(roomLow_, roomHigh_)};
        for (int side = 0; side < 6; ++side) objects.push_back(sideOf(low_, high_, side));
        for (int side = 0; side < 6; ++side) objects.push_back(sideOf(roomLow_, roomHigh_, side));
        meshes_ = test::meshSetOf(std::move(objects), origin_);
        group_.from = 1;
        for (std::uint32_t s = 2; s < 14; ++s) {
            group_.surfaces.push_back(s);
            group_.scalars.push_back(s + 1);
        }
        // Only building and room; surfaces as sheets are tested elsewhere.
        auto solids = meshes_;
        solids.objects.resize(2);
        const std::vector<ObjectClaim> claims{{1, 7, "building"}, {2, 4, "room"}};
        columns_ = voxelize(solids, grid_, claims)->columns;
    }

    [[nodiscard]] Scalar nearestSurface(Vec3d world) const {
        double nearest = 1e300;
        Scalar scalar = 0;
        for (std::size_t s = 0; s < group_.surfaces.size(); ++s) {
            const mesh::ObjectMesh& mesh = meshes_.objects[group_.surfaces[s]];
            for (const mesh::Triangle& t : mesh.triangles) {
                const double distance = distanceToTriangle(world - origin_, mesh.vertices[t.corners[0]],
                                                           mesh.vertices[t.corners[1]], mesh.vertices[t.corners[2]]);
                if (distance < nearest) {
                    nearest = distance;
                    scalar = group_.scalars[s];
                }
            }
        }
        return scalar;
    }

    const Vec3d origin_{4588, 54383, 11};
    const Vec3d low_{0, 0, 0}, high_{6, 5, 3}, roomLow_{0.4, 0.3, 0.25}, roomHigh_{5.5, 4.7, 2.6};
    mesh::MeshSet meshes_;
    // A spacing that divides no dimension, over two tiles along x.
    Grid grid_ = *Grid::fromSpacing({low_ + origin_, high_ + origin_}, {0.083, 0.097, 0.071});
    BodyGroup group_;
    volume::ColumnVolume columns_;
};

TEST_F(House, EveryVoxelOfTheMaterialGoesToTheNearestSurface) {
    const auto given = assignThematicBodies(columns_, grid_, meshes_, {group_}, 1);
    const Vec3i n = grid_.dimension();
    ASSERT_GT(n.x, 64);
    std::vector<std::uint64_t> hits(16, 0);
    for (std::int32_t j = 0; j < n.y; ++j)
        for (std::int32_t i = 0; i < n.x; ++i)
            for (std::int32_t k = 0; k < n.z; ++k) {
                const Scalar was = columns_.scalarAt(i, j, k), is = given.scalarAt(i, j, k);
                ++hits[is];
                if (was != 1)
                    ASSERT_EQ(is, was) << i << ' ' << j << ' ' << k;
                else
                    ASSERT_EQ(is, nearestSurface(grid_.worldFromIndex({double(i), double(j), double(k)})))
                        << i << ' ' << j << ' ' << k;
            }
    EXPECT_EQ(hits[1], 0u);
    EXPECT_EQ(hits[2], columns_.countVoxels(16)[2]);
    for (Scalar s = 3; s < 15; ++s) EXPECT_GT(hits[s], 0u) << s;
}

TEST_F(House, SameForAnyNumberOfThreads) {
    EXPECT_TRUE(assignThematicBodies(columns_, grid_, meshes_, {group_}, 1) ==
                assignThematicBodies(columns_, grid_, meshes_, {group_}, 4));
}

TEST_F(House, AtEqualDistanceTheEarlierSurfaceGets) {
    // The same wall twice: all goes to the first of the two, in either order.
    for (const bool isTurned : {false, true}) {
        BodyGroup twins;
        twins.from = 1;
        twins.surfaces = {4, 4};
        twins.scalars = isTurned ? std::vector<Scalar>{8, 7} : std::vector<Scalar>{7, 8};
        const auto counts = assignThematicBodies(columns_, grid_, meshes_, {twins}, 1).countVoxels(16);
        EXPECT_EQ(counts[twins.scalars[0]], columns_.countVoxels(16)[1]);
        EXPECT_EQ(counts[twins.scalars[1]], 0u);
    }
}

TEST_F(House, MiddleBetweenTwoWallsGoesToTheEarlier) {
    // A slab from x = 0 to 8 with walls at both ends and samples exactly in the middle.
    const auto meshes = test::meshSetOf(
        {test::box({0, 0, 0}, {8, 2, 2}), sideOf({0, 0, 0}, {8, 2, 2}, 3), sideOf({0, 0, 0}, {8, 2, 2}, 5)});
    const Grid grid =
        *Grid::fromParts({9, 3, 3}, {1, 1, 1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const auto columns = volume::ColumnVolume::fromDense({9, 3, 3}, std::vector<Scalar>(81, 1));
    const auto given = assignThematicBodies(columns, grid, meshes, {{1, {1, 2}, {5, 6}}}, 1);
    for (std::int32_t i = 0; i < 9; ++i) EXPECT_EQ(given.scalarAt(i, 1, 1), i >= 4 ? 5u : 6u) << i;
}

TEST_F(House, GroupWithoutSurfacesOrVoxelsChangesNothing) {
    EXPECT_TRUE(assignThematicBodies(columns_, grid_, meshes_, {}, 1) == columns_);
    EXPECT_TRUE(assignThematicBodies(columns_, grid_, meshes_, {{1, {}, {}}}, 1) == columns_);
    EXPECT_TRUE(assignThematicBodies(columns_, grid_, meshes_, {{9, {2, 3}, {3, 4}}}, 1) == columns_);
}

TEST_F(House, TwoBuildingsKeepTheirOwn) {
    // The room serves as a second building with its own surface.
    const BodyGroup second{2, {2}, {15}};
    const auto counts = assignThematicBodies(columns_, grid_, meshes_, {group_, second}, 2).countVoxels(16);
    EXPECT_EQ(counts[15], columns_.countVoxels(16)[2]);
    EXPECT_EQ(counts[1] + counts[2], 0u);
}

}  // namespace
}  // namespace svt::voxelize
