#include <svt/voxelize/solids_test.hpp>
#include <svt/voxelize/surfaces/winding.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::voxelize {
namespace {

using test::ball;
using test::box;
using test::join;
using test::meshSetOf;
using test::SolidOracle;
using volume::Grid;

Grid gridOver(const mesh::MeshSet& meshes, Vec3i dimension) {
    Box3d world{meshes.bounds.min + meshes.origin, meshes.bounds.max + meshes.origin};
    return *Grid::fromDimension(world, dimension);
}

Grid gridWith(Vec3d origin, Vec3d spacing, Vec3i dimension) {
    return *Grid::fromParts(dimension, spacing, origin, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

std::vector<ObjectClaim> claimsFor(const mesh::MeshSet& meshes, std::uint8_t rank = 3) {
    std::vector<ObjectClaim> claims;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o)
        claims.push_back({o + 1, rank, "object" + std::to_string(o)});
    return claims;
}

VoxelizeOptions solidsOnly() {
    VoxelizeOptions options;
    options.keepThinParts = false;
    return options;
}

std::uint64_t countOf(const VoxelizeResult& result, volume::Scalar scalar) {
    return result.columns.countVoxels(100)[scalar];
}

TEST(Voxelize, BoxHasExactlyTheSamplesInside) {
    for (const Vec3d origin : {Vec3d{0, 0, 0}, Vec3d{458877.123, 5438353.777, 111.6}}) {
        const auto meshes = meshSetOf({box({0.3, 0.4, 0.5}, {2.75, 3.1, 1.9})}, origin);
        const Grid grid = gridWith(origin + Vec3d{0.013, 0.017, 0.019}, {0.1, 0.07, 0.05}, {37, 61, 53});
        const auto result = voxelize(meshes, grid, claimsFor(meshes), solidsOnly());
        ASSERT_TRUE(result);
        std::uint64_t expected = 0;
        for (int k = 0; k < 53; ++k)
            for (int j = 0; j < 61; ++j)
                for (int i = 0; i < 37; ++i) {
                    const Vec3d at = grid.worldFromIndex({double(i), double(j), double(k)}) - origin;
                    const bool isInside =
                        at.x > 0.3 && at.x < 2.75 && at.y > 0.4 && at.y < 3.1 && at.z > 0.5 && at.z < 1.9;
                    expected += isInside;
                    ASSERT_EQ(result->columns.scalarAt(i, j, k) != 0, isInside) << i << ' ' << j << ' ' << k;
                }
        EXPECT_EQ(countOf(*result, 1), expected);
        EXPECT_GT(expected, 1000u);
    }
}

TEST(Voxelize, FacesOnSamplePlanesLeaveNoGapAndNoDoubleClaim) {
    // Eight boxes that fill a cube exactly, cut where samples lie.
    std::vector<mesh::ObjectMesh> parts;
    for (int n = 0; n < 8; ++n) {
        const Vec3d low{n & 1 ? 0.5 : 0.0, n & 2 ? 0.5 : 0.0, n & 4 ? 0.5 : 0.0};
        const Vec3d high{n & 1 ? 1.0 : 0.5, n & 2 ? 1.0 : 0.5, n & 4 ? 1.0 : 0.5};
        parts.push_back(box(low, high));
    }
    const auto meshes = meshSetOf(std::move(parts));
    const Grid grid = gridWith({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, {13, 13, 13});
    const auto result = voxelize(meshes, grid, claimsFor(meshes), solidsOnly());
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->overlaps.empty());
    std::uint64_t filled = 0;
    for (volume::Scalar s = 1; s <= 8; ++s) {
        EXPECT_EQ(countOf(*result, s), 125u) << s;
        filled += countOf(*result, s);
    }
    EXPECT_EQ(filled, 1000u);
}

TEST(Voxelize, ObliqueFaceSharedWithOtherTriangulationLeavesNoGap) {
    // Two wedges that make a box; the shared slanted face is cut along different diagonals.
    const auto wedge = [](bool isLower, bool otherDiagonal) {
        mesh::ObjectMesh mesh;
        mesh.vertices = {{0, 0, 0},   {3, 0, 0},   {3, 2, 0},   {0, 2, 0},
                         {0, 0, 1.3}, {3, 0, 1.3}, {3, 2, 1.3}, {0, 2, 1.3}};
        const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, bool other) {
            if (other) {
                test::addTriangle(mesh, b, c, d);
                test::addTriangle(mesh, b, d, a);
            } else {
                test::addTriangle(mesh, a, b, c);
                test::addTriangle(mesh, a, c, d);
            }
        };
        if (isLower) {  // below the plane through 0, 3 and 5, 6
            quad(0, 3, 2, 1, false);
            quad(1, 2, 6, 5, false);
            test::addTriangle(mesh, 0, 1, 5);
            test::addTriangle(mesh, 3, 6, 2);
            quad(0, 5, 6, 3, otherDiagonal);
        } else {
            quad(4, 5, 6, 7, false);
            quad(0, 4, 7, 3, false);
            test::addTriangle(mesh, 0, 5, 4);
            test::addTriangle(mesh, 3, 7, 6);
            quad(0, 3, 6, 5, otherDiagonal);
        }
        mesh.closingMethod = mesh::ClosingMethod::Closed;
        return mesh;
    };
    for (const double degrees : {0.0, 17.0, 45.0}) {
        std::vector<mesh::ObjectMesh> parts{wedge(true, false), wedge(false, true)};
        for (auto& part : parts)
            for (Vec3d& v : part.vertices) {
                const double c = std::cos(degrees / 57.3), s = std::sin(degrees / 57.3);
                v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
            }
        const auto meshes = meshSetOf(parts);
        const auto both = voxelize(meshes, gridOver(meshes, {101, 97, 83}), claimsFor(meshes), solidsOnly());
        mesh::ObjectMesh whole = box({0, 0, 0}, {3, 2, 1.3});
        for (Vec3d& v : whole.vertices) {
            const double c = std::cos(degrees / 57.3), s = std::sin(degrees / 57.3);
            v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
        }
        const auto wholeMeshes = meshSetOf({whole});
        const auto one = voxelize(wholeMeshes, gridOver(meshes, {101, 97, 83}), claimsFor(wholeMeshes), solidsOnly());
        ASSERT_TRUE(both && one);
        EXPECT_TRUE(both->overlaps.empty()) << degrees;
        EXPECT_EQ(countOf(*both, 1) + countOf(*both, 2), countOf(*one, 1)) << degrees;
    }
}

TEST(Voxelize, VoidsStayEmptyAndNestedShellsAreHarmless) {
    const auto meshes = meshSetOf({join(box({0, 0, 0}, {4, 4, 4}), box({1, 1, 1}, {3, 3, 3}), true)});
    const Grid grid = gridWith({-0.05, -0.05, -0.05}, {0.1, 0.1, 0.1}, {43, 43, 43});
    auto result = voxelize(meshes, grid, claimsFor(meshes), solidsOnly());
    ASSERT_TRUE(result);
    EXPECT_EQ(countOf(*result, 1), 40u * 40 * 40 - 20u * 20 * 20);
    const auto doubled = meshSetOf({join(box({0, 0, 0}, {4, 4, 4}), box({1, 1, 1}, {3, 3, 3}), false)});
    result = voxelize(doubled, grid, claimsFor(doubled), solidsOnly());
    ASSERT_TRUE(result);
    EXPECT_EQ(countOf(*result, 1), 40u * 40 * 40);
}

TEST(Voxelize, ExactOracleAgreesOnRandomAndNearFaceSamples) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Vec3d origin : {Vec3d{0, 0, 0}, Vec3d{458877.123, 5438353.777, 111.6}}) {
        std::vector<mesh::ObjectMesh> solids{ball({1.1, 1.3, 0.9}, 0.83),
                                             test::turnedBox({2.1, 0.2, 0.1}, {3.7, 1.9, 1.4}, 31),
                                             test::prism({{0.2, 2.3}, {1.9, 2.2}, {2.6, 3.3}, {1.0, 3.9}}, 0.15, 1.73)};
        const auto meshes = meshSetOf(solids, origin);
        const Grid grid = gridOver(meshes, {83, 91, 67});
        const auto result = voxelize(meshes, grid, claimsFor(meshes), solidsOnly());
        ASSERT_TRUE(result);
        std::vector<SolidOracle> oracles;
        for (const auto& object : meshes.objects) oracles.emplace_back(object);
        int checked = 0;
        const auto check = [&](Vec3i v) {
            const Vec3d local = grid.worldFromIndex({double(v.x), double(v.y), double(v.z)}) - origin;
            volume::Scalar expected = 0;
            for (std::uint32_t o = 0; o < oracles.size(); ++o) {
                if (oracles[o].distance(local, grid.spacing()) < 1.0 / 128) return;
                if (expected == 0 && oracles[o].contains(local)) expected = o + 1;  // the ball is the smallest and wins
            }
            ++checked;
            ASSERT_EQ(result->columns.scalarAt(v.x, v.y, v.z), expected) << v.x << ' ' << v.y << ' ' << v.z;
        };
        for (int n = 0; n < 4000; ++n)
            check({int(uniform(random) * 83), int(uniform(random) * 91), int(uniform(random) * 67)});
        // Where the label changes along a column: both sides of every face.
        for (int j = 0; j < 91; j += 3)
            for (int i = 0; i < 83; i += 3)
                for (const volume::Run& run : result->columns.column(i, j)) {
                    if (run.end < 67) check({i, j, int(run.end)});
                    check({i, j, int(run.end) - 1});
                }
        EXPECT_GT(checked, 5000);
    }
}

TEST(Voxelize, FinerComponentWinsAndTheOverlapIsCounted) {
    const auto meshes =
        meshSetOf({box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3}), box({1.5, 1.5, 1.5}, {1.9, 1.9, 1.9})});
    const Grid grid = gridWith({-0.05, -0.05, -0.05}, {0.1, 0.1, 0.1}, {33, 33, 33});
    const std::vector<ObjectClaim> claims{{1, 4, "room"}, {2, 3, "wall"}, {3, 0, "table"}};
    const auto result = voxelize(meshes, grid, claims, solidsOnly());
    ASSERT_TRUE(result);
    EXPECT_EQ(countOf(*result, 3), 64u);
    EXPECT_EQ(countOf(*result, 2), 8000u - 64u);
    EXPECT_EQ(countOf(*result, 1), 7000u);
    const std::vector<ClaimPair> expected{{1, 0, 1000}, {2, 0, 64}, {2, 1, 64}};
    EXPECT_EQ(result->overlaps, expected);
}

TEST(Voxelize, OfManySolidsInOnePlaceTheOverlapsWithTheFirstAreCounted) {
    constexpr std::size_t kSolids = 40, kFirst = 16;
    const auto meshes = meshSetOf(std::vector<mesh::ObjectMesh>(kSolids, box({0, 0, 0}, {2, 2, 2})));
    const auto result = voxelize(meshes, gridOver(meshes, {9, 9, 9}), claimsFor(meshes));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->overlaps.size(), kFirst * (kSolids - 1) - kFirst * (kFirst - 1) / 2);
    EXPECT_EQ(result->crowdedVoxels, result->overlaps[0].voxels);
    EXPECT_GT(result->crowdedVoxels, 0u);
    const auto few = meshSetOf(std::vector<mesh::ObjectMesh>(kFirst, box({0, 0, 0}, {2, 2, 2})));
    const auto all = voxelize(few, gridOver(few, {9, 9, 9}), claimsFor(few));
    ASSERT_TRUE(all);
    EXPECT_EQ(all->overlaps.size(), kFirst * (kFirst - 1) / 2);
    EXPECT_EQ(all->crowdedVoxels, 0u);
}

TEST(Voxelize, SameBytesForAnyNumberOfThreads) {
    std::vector<mesh::ObjectMesh> solids;
    for (int n = 0; n < 12; ++n) solids.push_back(ball({0.7 * n, 0.4 * (n % 5), 0.3 * (n % 3)}, 0.9));
    const auto meshes = meshSetOf(solids);
    VoxelizeOptions one, many;
    one.threads = 1;
    many.threads = 4;
    const auto a = voxelize(meshes, gridOver(meshes, {301, 97, 75}), claimsFor(meshes), one);
    const auto b = voxelize(meshes, gridOver(meshes, {301, 97, 75}), claimsFor(meshes), many);
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(a->columns == b->columns);
    EXPECT_EQ(a->overlaps, b->overlaps);
    EXPECT_FALSE(a->overlaps.empty());
}

TEST(Voxelize, PaneThinnerThanAVoxelStaysWhole) {
    // A pane of 5 mm turned by 30 degrees in voxels of 20 mm: a flood from one side must not reach the other.
    const auto meshes =
        meshSetOf({test::turnedBox({-1, -0.0025, 0}, {1, 0.0025, 1}, 30), box({-1.2, -1.2, -0.1}, {1.2, 1.2, -0.05})});
    const Grid grid = gridOver(meshes, {121, 121, 56});
    const auto result = voxelize(meshes, grid, claimsFor(meshes));
    ASSERT_TRUE(result);
    const Vec3d direction{std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6), 0};
    for (int s = -40; s <= 40; ++s) {
        // Along every sample line across the pane's dominant axis (y) there is a voxel of it.
        const Vec3d at = grid.indexFromWorld(direction * (s / 45.0) + Vec3d{0, 0, 0.5});
        const int i = int(std::lround(at.x)), k = int(std::lround(at.z));
        bool isMet = false;
        for (int j = 0; j < 121; ++j) isMet = isMet || result->columns.scalarAt(i, j, k) == 1;
        EXPECT_TRUE(isMet) << s;
    }
    EXPECT_GT(result->thinVoxels[0], 1000u);
}

TEST(Voxelize, AxisParallelPaneBetweenSamplesIsOneVoxelThick) {
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d low{0.2, 0.2, 0.2}, high{0.8, 0.8, 0.8};
        low[axis] = 0.462;
        high[axis] = 0.478;  // samples stand at 0.45 and 0.5
        const auto meshes = meshSetOf({box(low, high)});
        const auto result = voxelize(meshes, gridWith({0, 0, 0}, {0.05, 0.05, 0.05}, {21, 21, 21}), claimsFor(meshes));
        ASSERT_TRUE(result);
        EXPECT_EQ(countOf(*result, 1), 144u) << axis;
        EXPECT_EQ(result->thinVoxels[0], 144u) << axis;
        Vec3i inside{10, 10, 10};
        inside[axis] = 9;
        EXPECT_EQ(result->columns.scalarAt(inside.x, inside.y, inside.z), 1u) << axis;
    }
}

// A leaf of 4 cm with a block behind a part of it, as the jamb of a door has its leaf:
//
//     y 0.8 +-+
//           | |              samples are 0.1 m apart; the leaf's are at x = 0.2
//      0.45 | +--------+
//      0.15 +----------+
//         x 0.22 0.26  0.75
//
// The ray from the middle of a triangle of the leaf's face may pass through the block.
TEST(Voxelize, ALeafStaysWholeHoweverItsFaceIsCut) {
    test::ObjectMesh leaf =
        test::prism({{0.26, 0.45}, {0.26, 0.8}, {0.22, 0.8}, {0.22, 0.15}, {0.75, 0.15}, {0.75, 0.45}}, 0.21, 1.79);
    for (const bool isMirrored : {false, true}) {
        if (isMirrored) {
            for (Vec3d& vertex : leaf.vertices) vertex.z = 2 - vertex.z;
            for (mesh::Triangle& triangle : leaf.triangles) std::swap(triangle.corners[1], triangle.corners[2]);
        }
        const auto meshes = meshSetOf({leaf});
        const auto result = voxelize(meshes, gridWith({0, 0, 0}, {0.1, 0.1, 0.1}, {10, 10, 20}), claimsFor(meshes));
        ASSERT_TRUE(result);
        EXPECT_EQ(result->thinVoxels[0], 3u * 15u) << isMirrored;
        EXPECT_EQ(countOf(*result, 1), 3u * 15u + 5u * 3u * 15u) << isMirrored;
        for (const int j : {5, 6, 7}) EXPECT_EQ(result->columns.scalarAt(2, j, 10), 1u) << isMirrored << ' ' << j;
    }
}

// A side of the plate lies on the samples at x = 0.5, and so does a surface of equal rank. Whether those samples count as
// inside of the plate depends on the side; that the plate has them does not.
TEST(Voxelize, APlateWithSamplesOnASideHasThemAsIfInside) {
    for (const auto& [low, high] : {std::pair{0.44, 0.5}, {0.5, 0.56}}) {
        test::ObjectMesh surface;
        surface.vertices = {{0.5, 0.15, 0.15}, {0.5, 0.15, 0.85}, {0.5, 0.95, 0.85}, {0.5, 0.95, 0.15}};
        test::addTriangle(surface, 0, 1, 2);
        test::addTriangle(surface, 0, 2, 3);
        surface.closingMethod = mesh::ClosingMethod::Surface;
        const auto meshes = meshSetOf({box({low, 0.15, 0.15}, {high, 0.85, 0.85}), surface});
        const auto result = voxelize(meshes, gridWith({0, 0, 0}, {0.1, 0.1, 0.1}, {11, 11, 11}), claimsFor(meshes));
        ASSERT_TRUE(result);
        EXPECT_EQ(countOf(*result, 1), 7u * 7u) << low;
        for (int j = 2; j < 9; ++j) EXPECT_EQ(result->columns.scalarAt(5, j, 5), 1u) << low << ' ' << j;
        EXPECT_TRUE(result->overlaps.empty());
    }
}

TEST(Voxelize, RodThinnerThanAVoxelIsALineOfVoxels) {
    const auto meshes = meshSetOf({box({0.031, 0.031, 0.01}, {0.034, 0.034, 0.99}), box({0, 0, -0.1}, {1, 1, -0.05})});
    const Grid grid = gridOver(meshes, {21, 21, 56});
    const auto result = voxelize(meshes, grid, claimsFor(meshes));
    ASSERT_TRUE(result);
    for (int k = 8; k < 54; ++k) {
        bool isMet = false;
        for (int j = 0; j < 21; ++j)
            for (int i = 0; i < 21; ++i) isMet = isMet || result->columns.scalarAt(i, j, k) == 1;
        EXPECT_TRUE(isMet) << k;
    }
}

TEST(Voxelize, AtEqualRankWhatIsTrulyInsideGoesBeforeThinParts) {
    // A pane of 18 mm on a wall; the sample nearest to the pane's middle, at y = 0.45, lies in the wall.
    const auto meshes = meshSetOf({box({0.2, 0.2, 0.2}, {0.8, 0.46, 0.8}), box({0.2, 0.46, 0.2}, {0.8, 0.478, 0.8})});
    const Grid grid = gridWith({0, 0, 0}, {0.05, 0.05, 0.05}, {21, 21, 21});
    const auto equal = voxelize(meshes, grid, std::vector<ObjectClaim>{{1, 3, "wall"}, {2, 3, "pane"}});
    const auto finer = voxelize(meshes, grid, std::vector<ObjectClaim>{{1, 3, "wall"}, {2, 2, "pane"}});
    ASSERT_TRUE(equal && finer);
    EXPECT_EQ(countOf(*equal, 2), 1u) << "the one voxel that every object keeps";
    EXPECT_EQ(countOf(*equal, 1), 12u * 6u * 12u - 1u);
    EXPECT_EQ(countOf(*finer, 2), 144u);
}

TEST(Voxelize, NoObjectWithGeometryEndsWithZeroVoxels) {
    // A grain, and one of two equal boxes that the other one covers.
    const auto meshes = meshSetOf(
        {box({0.5, 0.5, 0.5}, {0.5001, 0.5001, 0.5001}), box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1})});
    const auto result = voxelize(meshes, gridOver(meshes, {20, 20, 20}), claimsFor(meshes));
    ASSERT_TRUE(result);
    for (volume::Scalar s = 1; s <= 3; ++s) EXPECT_GT(countOf(*result, s), 0u) << s;
}

mesh::ObjectMesh sheet(std::vector<Vec3d> quad) {
    mesh::ObjectMesh mesh;
    mesh.vertices = std::move(quad);
    test::addTriangle(mesh, 0, 1, 2);
    test::addTriangle(mesh, 0, 2, 3);
    mesh.closingMethod = mesh::ClosingMethod::Surface;
    return mesh;
}

TEST(Voxelize, ThinSheetSeparatesSixNeighboursEverywhere) {
    // Slanted in all directions, reaching out of the grid: from one corner no path of face neighbours leads to the
    // opposite one.
    const auto meshes = meshSetOf({sheet({{-2, -2, 3.9}, {4, -2, 1.9}, {4, 4, -2.1}, {-2, 4, -0.1}})});
    const Grid grid = gridWith({0, 0, 0}, {0.05, 0.05, 0.05}, {41, 37, 43});
    const auto result = voxelize(meshes, grid, claimsFor(meshes));
    ASSERT_TRUE(result);
    std::vector<char> seen(41 * 37 * 43, 0);
    std::vector<Vec3i> stack{{0, 0, 0}};
    const auto at = [](Vec3i v) { return std::size_t(v.x + 41 * (v.y + 37 * v.z)); };
    seen[0] = 1;
    while (!stack.empty()) {
        const Vec3i v = stack.back();
        stack.pop_back();
        for (const Vec3i d : {Vec3i{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
            const Vec3i n = v + d;
            if (n.x < 0 || n.y < 0 || n.z < 0 || n.x >= 41 || n.y >= 37 || n.z >= 43 || seen[at(n)]) continue;
            if (result->columns.scalarAt(n.x, n.y, n.z) != 0) continue;
            seen[at(n)] = 1;
            stack.push_back(n);
        }
    }
    EXPECT_FALSE(seen[at({40, 36, 42})]);
    EXPECT_EQ(result->columns.scalarAt(0, 0, 0), 0u);
    EXPECT_EQ(result->columns.scalarAt(40, 36, 42), 0u);
}

TEST(Voxelize, ConservativeSheetMarksEveryTouchedBox) {
    const auto meshes = meshSetOf({sheet({{0.1, 0.2, 0.3}, {1.9, 0.3, 0.6}, {1.8, 1.7, 1.5}, {0.2, 1.6, 1.2}})});
    const Grid grid = gridWith({0, 0, 0}, {0.1, 0.1, 0.1}, {21, 21, 21});
    VoxelizeOptions options;
    const auto thin = voxelize(meshes, grid, claimsFor(meshes), options);
    options.sheets = SheetMode::Conservative;
    const auto fat = voxelize(meshes, grid, claimsFor(meshes), options);
    ASSERT_TRUE(thin && fat);
    EXPECT_GT(countOf(*fat, 1), countOf(*thin, 1));
    // Points of the sheet, each in a marked box.
    for (double u = 0.02; u < 1; u += 0.05)
        for (double v = 0.02; v < 1 - u; v += 0.05) {
            const auto& q = meshes.objects[0].vertices;
            const Vec3d p = grid.indexFromWorld(q[0] + (q[1] - q[0]) * u + (q[2] - q[0]) * v);
            EXPECT_NE(fat->columns.scalarAt(int(std::lround(p.x)), int(std::lround(p.y)), int(std::lround(p.z))), 0u);
        }
}

TEST(Voxelize, OpenShellIsFilledLikeItsWindingNumber) {
    mesh::ObjectMesh open = ball({1, 1, 1}, 0.9, 16);
    open.closingMethod = mesh::ClosingMethod::Open;
    // Remove some triangles and list the edges without a partner.
    std::vector<mesh::Triangle> kept;
    for (std::size_t t = 0; t < open.triangles.size(); ++t)
        if (t % 16 != 3) kept.push_back(open.triangles[t]);
    for (const mesh::Triangle& t : kept)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = t.corners[c], b = t.corners[(c + 1) % 3];
            const bool hasPartner = std::any_of(kept.begin(), kept.end(), [&](const mesh::Triangle& u) {
                for (std::size_t d = 0; d < 3; ++d)
                    if (u.corners[d] == b && u.corners[(d + 1) % 3] == a) return true;
                return false;
            });
            if (!hasPartner) open.openEdges.push_back({a, b});
        }
    open.triangles = kept;
    ASSERT_FALSE(open.openEdges.empty());
    const auto meshes = meshSetOf({open});
    const Grid grid = gridOver(meshes, {41, 43, 39});
    const auto result = voxelize(meshes, grid, claimsFor(meshes));
    ASSERT_TRUE(result);
    int inside = 0;
    for (int k = 0; k < 39; ++k)
        for (int j = 0; j < 43; ++j)
            for (int i = 0; i < 41; ++i) {
                const double w = windingNumber(meshes.objects[0],
                                               grid.worldFromIndex({i + 1 / 512.0, j + 1 / 512.0, k + 1 / 512.0}));
                if (std::abs(w - 0.5) < 0.02) continue;
                if (SolidOracle(meshes.objects[0])
                        .distance(grid.worldFromIndex({double(i), double(j), double(k)}), grid.spacing()) < 1.0 / 128)
                    continue;
                ASSERT_EQ(result->columns.scalarAt(i, j, k) != 0, w > 0.5) << i << ' ' << j << ' ' << k << ' ' << w;
                inside += w > 0.5;
            }
    EXPECT_GT(inside, 10000);
}

TEST(Voxelize, TurnedGridGivesTheVolumeOfTheStraightModel) {
    // A house of boxes rotated by 30 degrees, in a grid rotated with it, gives the same voxels as the unrotated one.
    const auto straight = meshSetOf({box({0, 0, 0}, {4, 3, 2}), box({4, 0, 0}, {4.5, 3, 2})});
    auto turned = straight;
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    for (auto& object : turned.objects)
        for (Vec3d& v : object.vertices) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    turned = meshSetOf(turned.objects);
    const Grid grid = gridWith({-0.013, -0.017, -0.011}, {0.051, 0.049, 0.05}, {93, 67, 44});
    const Grid turnedGrid = *Grid::fromParts(
        grid.dimension(), grid.spacing(),
        Vec3d{c * grid.origin().x - s * grid.origin().y, s * grid.origin().x + c * grid.origin().y, grid.origin().z},
        {Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}});
    const auto a = voxelize(straight, grid, claimsFor(straight));
    const auto b = voxelize(turned, turnedGrid, claimsFor(turned));
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(a->columns == b->columns);
}

TEST(Voxelize, CancelStopsWithoutResult) {
    const auto meshes = meshSetOf({box({0, 0, 0}, {1, 1, 1})});
    Progress progress;
    progress.cancel = true;
    VoxelizeOptions options;
    options.progress = &progress;
    const auto result = voxelize(meshes, gridOver(meshes, {20, 20, 20}), claimsFor(meshes), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code(), Code::Cancelled);
}

}  // namespace
}  // namespace svt::voxelize
