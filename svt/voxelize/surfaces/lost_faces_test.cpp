#include <svt/voxelize/open_shells_test.hpp>
#include <svt/voxelize/surfaces/lost_faces.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace svt::voxelize {
namespace {

using test::addTriangle;
using test::asOpen;
using test::box;
using test::join;
using test::meshSetOf;
using volume::Grid;

constexpr double kVoxel = 0.05;
const Grid kGrid = *Grid::fromSpacing({{0, 0, 0}, {2, 2, 2}}, {kVoxel, kVoxel, kVoxel});

// A rectangle across y that faces -y.
mesh::ObjectMesh sheetAcross(double y, double x0, double x1, double z0, double z1) {
    mesh::ObjectMesh mesh;
    mesh.vertices = {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}};
    addTriangle(mesh, 0, 1, 2);
    addTriangle(mesh, 0, 2, 3);
    return mesh;
}

// A rectangle across z that faces up.
mesh::ObjectMesh sheetAt(double z, double x0, double x1, double y0, double y1) {
    mesh::ObjectMesh mesh;
    mesh.vertices = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    addTriangle(mesh, 0, 1, 2);
    addTriangle(mesh, 0, 2, 3);
    return mesh;
}

// Two faces at a distance of 7 mm that both face -y.
mesh::ObjectMesh pane() {
    return asOpen(join(sheetAcross(1.012, 0.5, 1.5, 0.4, 1.6), sheetAcross(1.019, 0.5, 1.5, 0.4, 1.6), false));
}

VoxelizeResult voxelsOf(const mesh::MeshSet& meshes, const std::vector<ObjectClaim>& claims, bool keepsThinParts) {
    VoxelizeOptions options;
    options.keepThinParts = keepsThinParts;
    auto result = voxelize(meshes, kGrid, claims, options);
    EXPECT_TRUE(result);
    return std::move(*result);
}

std::uint64_t voxelCount(const VoxelizeResult& result, volume::Scalar scalar) {
    return result.columns.countVoxels(scalar + 1)[scalar];
}

TEST(LostFaces, APaneWithFacesThatPointTheSameWayIsOneWholeSheet) {
    const mesh::MeshSet meshes = meshSetOf({pane()});
    const VoxelizeResult result = voxelsOf(meshes, {{1, 3, "pane"}}, true);
    int lines = 0;
    for (int i = 0; i < kGrid.dimension().x; ++i)
        for (int k = 0; k < kGrid.dimension().z; ++k) {
            const Vec3d at = kGrid.worldFromIndex({double(i), 0, double(k)});
            if (at.x < 0.51 || at.x > 1.49 || at.z < 0.41 || at.z > 1.59) continue;
            ++lines;
            int owned = 0;
            for (int j = 0; j < kGrid.dimension().y; ++j) owned += result.columns.scalarAt(i, j, k) == 1;
            ASSERT_EQ(owned, 1) << i << ' ' << k;
        }
    EXPECT_GT(lines, 400);
    ASSERT_EQ(result.lostFaces.size(), 1u);
    EXPECT_EQ(result.lostFaces[0].object, 0u);
    EXPECT_GT(result.lostFaces[0].share, 0.9);
    EXPECT_EQ(result.thinVoxels[0], voxelCount(result, 1));
}

TEST(LostFaces, WithoutThinPartsNothingIsAdded) {
    const mesh::MeshSet meshes = meshSetOf({pane()});
    const VoxelizeResult result = voxelsOf(meshes, {{1, 3, "pane"}}, false);
    EXPECT_EQ(voxelCount(result, 1), 1u);
    EXPECT_TRUE(result.lostFaces.empty());
}

TEST(LostFaces, ALeakingCounterJoinsItsCupboard) {
    const mesh::ObjectMesh cupboard =
        test::withoutTriangles(box({0.2, 0.2, 0.2}, {0.8, 0.8, 1}), [](std::size_t triangle) { return triangle == 3; });
    const mesh::ObjectMesh counter = sheetAt(0.97, 0.8, 1.8, 0.2, 0.8);
    const VoxelizeResult without = voxelsOf(meshSetOf({cupboard}), {{1, 3, "kitchen"}}, true);
    const VoxelizeResult with =
        voxelsOf(meshSetOf({asOpen(join(cupboard, counter, false))}), {{1, 3, "kitchen"}}, true);
    const auto at = [&](const VoxelizeResult& result, double x) {
        const Vec3d index = kGrid.indexFromWorld({x, 0.5, 0.97});  // the sample below the counter
        return result.columns.scalarAt(int(std::lround(index.x)), int(std::lround(index.y)), int(index.z));
    };
    for (double x = 0.3; x < 1.77; x += kVoxel) EXPECT_EQ(at(with, x), 1u) << x;
    EXPECT_EQ(at(without, 1.2), 0u);
    EXPECT_GE(voxelCount(with, 1), voxelCount(without, 1) + 200);
}

// The inside of a well-filled shell reaches its faces.
TEST(LostFaces, AShellWithAHoleStaysAsItIsFilled) {
    const mesh::MeshSet meshes = meshSetOf({test::withoutTriangles(
        box({0.21, 0.22, 0.23}, {1.77, 1.78, 1.66}), [](std::size_t triangle) { return triangle == 3; })});
    const VoxelizeResult with = voxelsOf(meshes, {{1, 3, "shell"}}, true);
    EXPECT_TRUE(with.lostFaces.empty());
    EXPECT_TRUE(with.columns == voxelsOf(meshes, {{1, 3, "shell"}}, false).columns);
}

TEST(LostFaces, OnlyVoxelsOfCoarserObjectsAreTaken) {
    const mesh::MeshSet meshes = meshSetOf({pane(), box({0.3, 0.3, 0.3}, {1, 1.7, 1.7})});
    constexpr std::uint8_t kFiner = 2, kSame = 3, kCoarser = 4;
    std::array<std::uint64_t, 3> counts{};
    for (const std::uint8_t rank : {kFiner, kSame, kCoarser})
        counts[rank - kFiner] = voxelCount(voxelsOf(meshes, {{1, 3, "pane"}, {2, rank, "box"}}, true), 1);
    EXPECT_EQ(counts[0], counts[1]);
    EXPECT_NEAR(double(counts[2]), 2 * double(counts[0]), 0.2 * double(counts[0]));
}

// A leg of 1 cm that leaks: no sample line meets it.
TEST(LostFaces, ALegBetweenSampleLinesIsALine) {
    mesh::ObjectMesh leg = box({1.017, 1.012, 0.3}, {1.028, 1.022, 1.5});
    leg = test::withoutTriangles(leg, [](std::size_t triangle) { return triangle % 2 == 0; });
    const VoxelizeResult result = voxelsOf(meshSetOf({leg}), {{1, 3, "leg"}}, true);
    const Vec3d index = kGrid.indexFromWorld({1.022, 1.017, 0.9});
    int owned = 0;
    for (int k = 0; k < kGrid.dimension().z; ++k)
        for (int n = 0; n < 9; ++n)
            if (result.columns.scalarAt(int(index.x) + n % 3 - 1, int(index.y) + n / 3 - 1, k) == 1) {
                ++owned;
                break;
            }
    EXPECT_GE(owned, 23);
}

}  // namespace
}  // namespace svt::voxelize
