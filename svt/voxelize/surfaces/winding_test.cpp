#include <svt/voxelize/open_shells_test.hpp>
#include <svt/voxelize/surfaces/winding.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdio>
#include <ctime>
#include <random>

namespace svt::voxelize {
namespace {

using test::ball;
using test::box;
using test::houseWithHoles;
using test::meshSetOf;
using test::withoutTriangles;
using volume::Grid;

Grid gridAround(const mesh::MeshSet& meshes, Vec3i dimension) {
    Box3d world{meshes.bounds.min + meshes.origin, meshes.bounds.max + meshes.origin};
    return *Grid::fromDimension(world, dimension);
}

std::vector<ObjectClaim> oneClaim() { return {{1, 3, "object"}}; }

// Processor time, one thread.
double secondsOf(const mesh::MeshSet& meshes, const Grid& grid, int repeats) {
    VoxelizeOptions options;
    options.threads = 1;
    double best = 1e9;
    for (int n = 0; n < repeats; ++n) {
        const std::clock_t start = std::clock();
        const auto result = voxelize(meshes, grid, oneClaim(), options);
        EXPECT_TRUE(result);
        best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

// Distance of `p` to the nearest triangle, or `enough` if none is nearer; index space.
double distanceToShell(const mesh::ObjectMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3d local) {
    const Vec3d p = indexFromLocal.point(local);
    double nearest = 1e300;
    for (const mesh::Triangle& t : mesh.triangles) {
        const Vec3d a = indexFromLocal.point(mesh.vertices[t.corners[0]]) - p;
        const Vec3d b = indexFromLocal.point(mesh.vertices[t.corners[1]]) - p;
        const Vec3d c = indexFromLocal.point(mesh.vertices[t.corners[2]]) - p;
        const auto segment = [](Vec3d s, Vec3d e) {
            const Vec3d d = e - s;
            const double l = dot(d, d);
            return length(s + d * (l > 0 ? std::clamp(-dot(s, d) / l, 0.0, 1.0) : 0.0));
        };
        nearest = std::min({nearest, segment(a, b), segment(b, c), segment(c, a)});
        const Vec3d n = cross(b - a, c - a);
        if (length(n) > 0 && dot(cross(a, b), n) >= 0 && dot(cross(b, c), n) >= 0 && dot(cross(c, a), n) >= 0)
            nearest = std::min(nearest, std::abs(dot(a, normalized(n))));
    }
    return nearest;
}

struct Comparison {
    int compared = 0, inside = 0, wrong = 0;
    std::uint64_t uncertain = 0, onLimit = 0;  // by the plain sum, over the bounding box
};

// Compares the voxels of object 0 with the plain sum over all triangles, at every `stride`-th sample.
Comparison compareWithSum(const mesh::MeshSet& meshes, const Grid& grid, const VoxelizeResult& result, int stride = 1) {
    const mesh::ObjectMesh& mesh = meshes.objects[0];
    const IndexFromLocal indexFromLocal(meshes, grid);
    Comparison comparison;
    const Vec3i dimension = grid.dimension();
    int n = 0;
    for (int k = 0; k < dimension.z; ++k)
        for (int j = 0; j < dimension.y; ++j)
            for (int i = 0; i < dimension.x; ++i) {
                if (++n % stride != 0) continue;
                constexpr double kShift = 1.0 / 512;
                const Vec3d p = grid.worldFromIndex({i + kShift, j + kShift, k + kShift}) - meshes.origin;
                const double w = windingNumber(mesh, p);
                const double toHalf = std::abs(w - std::floor(w) - 0.5);
                if (mesh.bounds.contains(p)) {
                    comparison.uncertain += toHalf < 0.25;
                    comparison.onLimit += std::abs(toHalf - 0.25) < 0.011;
                }
                if (std::abs(w - 0.5) < 1e-6) continue;
                const bool isInside = w > 0.5 && mesh.bounds.contains(p);
                ++comparison.compared;
                comparison.inside += isInside;
                if ((result.columns.scalarAt(i, j, k) != 0) == isInside) continue;
                if (distanceToShell(mesh, indexFromLocal, p) < 1.0 / 128) continue;
                if (++comparison.wrong <= 5)
                    ADD_FAILURE() << i << ' ' << j << ' ' << k << " winding number " << w << " is "
                                  << result.columns.scalarAt(i, j, k);
            }
    return comparison;
}

// Samples at whole metres.
Grid smallGrid() {
    return *Grid::fromParts({19, 18, 17}, {1, 1, 1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

// `dimension` {}: a grid of metres.
void expectLikeSum(const mesh::ObjectMesh& open, Vec3i dimension, int stride = 1) {
    ASSERT_EQ(open.closingMethod, mesh::ClosingMethod::Open);
    const auto meshes = meshSetOf({open});
    const Grid grid = dimension.x > 0 ? gridAround(meshes, dimension) : smallGrid();
    VoxelizeOptions options;
    options.keepThinParts = false;  // the filling only, without the faces that it leaves out
    const auto result = voxelize(meshes, grid, oneClaim(), options);
    ASSERT_TRUE(result);
    const Comparison comparison = compareWithSum(meshes, grid, *result, stride);
    EXPECT_EQ(comparison.wrong, 0);
    EXPECT_GT(comparison.inside, comparison.compared / 10);
    if (stride == 1 && dimension.x > 0) {
        EXPECT_NEAR(double(result->uncertainVoxels[0]), double(comparison.uncertain), double(comparison.onLimit));
    }
    options.threads = 1;
    const auto again = voxelize(meshes, grid, oneClaim(), options);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->columns == result->columns);
    EXPECT_EQ(again->uncertainVoxels, result->uncertainVoxels);
}

TEST(WindingFill, HousesWithHoles) {
    expectLikeSum(houseWithHoles(6, 3, 1), {61, 53, 47});
    expectLikeSum(houseWithHoles(6, 3, 1, 17), {61, 53, 47});
    expectLikeSum(houseWithHoles(6, 6, 4), {61, 53, 47});
    expectLikeSum(houseWithHoles(6, 6, 4, 31), {61, 53, 47});
    expectLikeSum(houseWithHoles(12, 2, 1, 5), {83, 71, 41}, 3);
}

TEST(WindingFill, BallWithHoles) {
    for (const std::size_t every : {3u, 7u, 31u})
        expectLikeSum(withoutTriangles(ball({1, 1, 1}, 0.9, 16), [&](std::size_t t) { return t % every == 1; }),
                      {41, 43, 39});
}

TEST(WindingFill, HugeCaps) {
    // Half a ball, a box without its lower or its eastern side, a box with only three sides.
    expectLikeSum(withoutTriangles(ball({1, 1, 1}, 0.9, 20), [](std::size_t t) { return t % 7 < 3; }), {41, 43, 39});
    for (const auto& sides : {std::array<std::size_t, 3>{0, 0, 0}, {3, 3, 3}, {5, 5, 5}, {0, 3, 5}, {1, 2, 3}})
        expectLikeSum(withoutTriangles(box({0, 0, 0}, {2, 1.7, 1.3}),
                                       [&](std::size_t t) { return std::ranges::find(sides, t / 2) != sides.end(); }),
                      {43, 41, 39});
}

TEST(WindingFill, LidsAtSamples) {
    // The missing sides lie at samples, which are 1/512 voxel beyond the whole numbers, or up to 1/512 voxel beside.
    for (const double shift : {0.0, 1 / 512.0, 2 / 512.0})
        for (const auto& sides : {std::array<std::size_t, 2>{0, 1}, {2, 4}, {3, 5}, {1, 2}})
            for (const bool hasOther : {false, true}) {
                auto open = withoutTriangles(
                    box(Vec3d{2, 3, 2} + Vec3d{shift, shift, shift}, Vec3d{16, 15, 14} + Vec3d{shift, shift, shift}),
                    [&](std::size_t t) { return t / 2 == sides[0] || (hasOther && t / 2 == sides[1]); });
                expectLikeSum(std::move(open), {0, 0, 0});
            }
    // A wall that stands exactly on samples: x + y of its corners is 2/512 more than a whole number, as of samples.
    for (const std::size_t wall : {0u, 1u, 2u, 3u}) {
        const double x = 9 + 2 / 512.0, y = 9;
        auto open =
            withoutTriangles(test::prism({{x + 6, y}, {x, y + 6}, {x - 6, y}, {x, y - 6}}, 2, 13), [&](std::size_t t) {
                const std::size_t first[4] = {0, 2, 6, 10};
                return t == first[wall] || t == first[wall] + 1;
            });
        expectLikeSum(std::move(open), {0, 0, 0});
    }
}

TEST(WindingFill, RimsThatBranch) {
    // A ball with every second triangle, so that its holes meet at their corners.
    expectLikeSum(withoutTriangles(ball({1, 1, 1}, 0.9, 14), [](std::size_t t) { return t % 2 == 1 && t % 5 != 0; }),
                  {37, 31, 33});
    // A box without its upper side, some triangles of which are there twice, and with a wall within.
    auto open = box({0, 0, 0}, {2, 1.7, 1.3});
    test::addTriangle(open, 0, 1, 5);
    test::addTriangle(open, 0, 1, 5);
    test::addTriangle(open, 0, 2, 6);
    expectLikeSum(withoutTriangles(std::move(open), [](std::size_t t) { return t == 6; }), {37, 31, 33});
}

// Every triangle with corners of its own, moved a little: all edges are open.
mesh::ObjectMesh looseTriangles(const mesh::ObjectMesh& from, double moved) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-moved, moved);
    mesh::ObjectMesh loose = from;
    loose.vertices.clear();
    for (mesh::Triangle& triangle : loose.triangles) {
        const Vec3d shift{along(random), along(random), along(random)};
        for (std::uint32_t& corner : triangle.corners) {
            loose.vertices.push_back(from.vertices[corner] + shift);
            corner = static_cast<std::uint32_t>(loose.vertices.size() - 1);
        }
    }
    return test::asOpen(std::move(loose));
}

TEST(WindingFill, LooseTriangles) { expectLikeSum(looseTriangles(ball({1, 1, 1}, 0.9, 16), 0.02), {41, 43, 39}); }

TEST(WindingFill, PastItsBoundTheShellIsASheet) {
    const auto meshes = meshSetOf({looseTriangles(ball({1, 1, 1}, 0.9, 60), 0.1)});
    const Grid grid = gridAround(meshes, {41, 43, 39});
    VoxelizeOptions options;
    const auto filled = voxelize(meshes, grid, oneClaim(), options);
    ASSERT_TRUE(filled);
    EXPECT_TRUE(filled->unfilled.empty());
    options.solidAngles = 0;
    const auto sheet = voxelize(meshes, grid, oneClaim(), options);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->unfilled, std::vector<std::uint32_t>{0});
    const std::uint64_t inside = filled->columns.countVoxels(2)[1], behind = sheet->columns.countVoxels(2)[1];
    EXPECT_GT(behind, 0u);
    EXPECT_LT(behind, inside / 2);
    options.threads = 1;
    const auto again = voxelize(meshes, grid, oneClaim(), options);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->columns == sheet->columns);
}

TEST(WindingFill, ManySamplesOfLargeGrids) {
    for (const double degrees : {0.0, 23.0}) {
        const auto meshes = meshSetOf({houseWithHoles(8, 4, 2, degrees)});
        const Grid grid = gridAround(meshes, {203, 187, 151});
        const auto result = voxelize(meshes, grid, oneClaim());
        ASSERT_TRUE(result);
        const IndexFromLocal indexFromLocal(meshes, grid);
        std::mt19937 random(7);
        int inside = 0;
        const auto check = [&](Vec3i at) {
            constexpr double kShift = 1.0 / 512;
            const Vec3d p = grid.worldFromIndex({at.x + kShift, at.y + kShift, at.z + kShift}) - meshes.origin;
            const double w = windingNumber(meshes.objects[0], p);
            const bool isInside = result->columns.scalarAt(at.x, at.y, at.z) != 0;
            inside += isInside;
            if (std::abs(w - 0.5) < 1e-6 || isInside == (w > 0.5)) return;
            EXPECT_LT(distanceToShell(meshes.objects[0], indexFromLocal, p), 1.0 / 128)
                << at.x << ' ' << at.y << ' ' << at.z << " winding number " << w;
        };
        for (int n = 0; n < 500; ++n) {
            const Vec3i at{int(random() % 203), int(random() % 187), int(random() % 151)};
            check(at);
            // The samples on both sides of all changes of this column.
            for (int k = 1; k < 151; ++k)
                if ((result->columns.scalarAt(at.x, at.y, k) != 0) !=
                    (result->columns.scalarAt(at.x, at.y, k - 1) != 0)) {
                    check({at.x, at.y, k - 1});
                    check({at.x, at.y, k});
                }
        }
        EXPECT_GT(inside, 300);
    }
}

TEST(WindingFill, EveryInstructionSetGivesTheSameBits) {
    const auto meshes = meshSetOf({houseWithHoles(6, 3, 1, 17)});
    const Grid grid = gridAround(meshes, {61, 53, 47});
    const auto best = voxelize(meshes, grid, oneClaim());
    ASSERT_TRUE(best);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        const auto result = voxelize(meshes, grid, oneClaim());
        hwy::SetSupportedTargetsForTest(0);
        ASSERT_TRUE(result);
        EXPECT_TRUE(result->columns == best->columns);
        EXPECT_EQ(result->uncertainVoxels, best->uncertainVoxels);
    }
}

TEST(WindingFill, DISABLED_Profile) {
    const auto open = meshSetOf({houseWithHoles(24, 12, 4, 17)});
    const Grid grid = gridAround(open, {300, 300, 200});
    std::printf("%.2f ms\n", secondsOf(open, grid, 10) * 1e3);
}

TEST(WindingFill, DISABLED_Timing) {
    for (const double degrees : {0.0, 17.0})
        for (const auto& [pitch, size] : {std::pair{12, 4}, std::pair{8, 2}, std::pair{4, 1}, std::pair{24, 20}}) {
            const auto closed = meshSetOf({houseWithHoles(24, pitch, 0, degrees)});
            const auto open = meshSetOf({houseWithHoles(24, pitch, size, degrees)});
            for (const Vec3i dimension : {Vec3i{300, 300, 200}, Vec3i{800, 700, 400}}) {
                const Grid grid = gridAround(closed, dimension);
                const double a = secondsOf(closed, grid, 5), b = secondsOf(open, grid, 2);
                std::printf(
                    "degrees %2.0f pitch %2d size %2d edges %5zu  %d x %d x %d  closed %8.2f ms open %9.2f ms  x "
                    "%.2f\n",
                    degrees, pitch, size, open.objects[0].openEdges.size(), dimension.x, dimension.y, dimension.z,
                    a * 1e3, b * 1e3, b / a);
                std::fflush(stdout);
            }
        }
    const auto closed = meshSetOf({ball({0, 0, 0}, 5, 80)});
    const auto open = meshSetOf({withoutTriangles(ball({0, 0, 0}, 5, 80), [](std::size_t t) { return t % 53 == 7; })});
    for (const Vec3i dimension : {Vec3i{300, 300, 200}, Vec3i{800, 700, 400}}) {
        const Grid grid = gridAround(closed, dimension);
        const double a = secondsOf(closed, grid, 5), b = secondsOf(open, grid, 2);
        std::printf("ball %zu triangles, edges %5zu  %d x %d x %d  closed %8.2f ms open %9.2f ms  x %.2f\n",
                    closed.objects[0].triangles.size(), open.objects[0].openEdges.size(), dimension.x, dimension.y,
                    dimension.z, a * 1e3, b * 1e3, b / a);
    }
}

}  // namespace
}  // namespace svt::voxelize
