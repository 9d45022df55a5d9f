#include <svt/mesh/models_test.hpp>
#include <svt/mesh/planes.hpp>
#include <svt/mesh/processor_time_test.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

namespace svt::mesh {
namespace {

using test::meshOfRings;

constexpr double kDistance = 2e-5;

MeshSet meshSetOf(std::vector<ObjectMesh> objects) {
    MeshSet meshes;
    meshes.objects = std::move(objects);
    for (ObjectMesh& object : meshes.objects) {
        for (const Vec3d& vertex : object.vertices) object.bounds.add(vertex);
        meshes.bounds.add(object.bounds);
    }
    assignPlanes(meshes, kDistance);
    return meshes;
}

// The quad over [x0, x1] x [0, 3] on a roof plane, with noise on its heights; cut along either diagonal.
ObjectMesh roofPart(double x0, double x1, double lift, double noise, bool otherDiagonal) {
    const auto height = [&](double x, double y, double sign) { return 2 + 0.7 * x - 0.2 * y + lift + sign * noise; };
    std::vector<Vec3d> v{
        {x0, 0, height(x0, 0, 1)}, {x1, 0, height(x1, 0, -1)}, {x1, 3, height(x1, 3, 1)}, {x0, 3, height(x0, 3, -1)}};
    return otherDiagonal ? meshOfRings(v, {{1, 2, 3}, {1, 3, 0}}) : meshOfRings(v, {{0, 1, 2}, {0, 2, 3}});
}

TEST(AssignPlanes, CoplanarFacesOfTwoObjectsShareOnePlane) {
    const MeshSet meshes =
        meshSetOf({roofPart(0, 4, 0, 1e-6, false), roofPart(4, 7, 0, 1e-6, true), roofPart(0, 4, 0, 0, true)});
    ASSERT_EQ(meshes.planes.size(), 1u);
    for (const ObjectMesh& object : meshes.objects)
        for (const Triangle& triangle : object.triangles) EXPECT_EQ(triangle.plane, 0u);
    EXPECT_NEAR(meshes.planes[0].slopeX, 0.7, 1e-5);
    EXPECT_NEAR(meshes.planes[0].slopeY, -0.2, 1e-5);
    EXPECT_NEAR(meshes.planes[0].offset, 2, 1e-5);
}

TEST(AssignPlanes, ParallelPlanesAMillimetreApartAreTwo) {
    const MeshSet meshes = meshSetOf({roofPart(0, 4, 0, 0, false), roofPart(0, 4, 1e-3, 0, false)});
    EXPECT_EQ(meshes.planes.size(), 2u);
    EXPECT_NE(meshes.objects[0].triangles[0].plane, meshes.objects[1].triangles[0].plane);
}

TEST(AssignPlanes, FacesThatLookUpAndDownShareTheirPlane) {
    ObjectMesh below = roofPart(0, 4, 0, 0, false), above = below;
    test::turnOver(above.triangles);
    const MeshSet meshes = meshSetOf({below, above});
    EXPECT_EQ(meshes.planes.size(), 1u);
}

TEST(AssignPlanes, VerticalAndFlatTrianglesHaveNone) {
    const MeshSet meshes =
        meshSetOf({meshOfRings({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}})});
    EXPECT_TRUE(meshes.planes.empty());
    for (const Triangle& triangle : meshes.objects[0].triangles) EXPECT_EQ(triangle.plane, kNoPlane);
}

TEST(AssignPlanes, FloorAtOneHeightIsOnePlaneHoweverFarApart) {
    std::vector<ObjectMesh> floors;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-500, 500);
    for (int n = 0; n < 50; ++n) {
        const double x = uniform(random), y = uniform(random);
        floors.push_back(meshOfRings({{x, y, 3.1}, {x + 1, y, 3.1}, {x + 1, y + 1, 3.1}}, {{0, 1, 2}}));
    }
    const MeshSet meshes = meshSetOf(floors);
    ASSERT_EQ(meshes.planes.size(), 1u);
    EXPECT_EQ(meshes.planes[0].slopeX, 0);
    EXPECT_EQ(meshes.planes[0].slopeY, 0);
    EXPECT_EQ(meshes.planes[0].offset, 3.1);
}

TEST(AssignPlanes, ManyPlanesThatHardlyDifferAreToldApartWithLittleWork) {
    // Triangles of a metre whose corners differ by 0.1 to 50 mm: all planes lie in few cells. Each triangle comes twice, and
    // its double shares its plane. One by one it would be 10^9 comparisons.
    std::mt19937_64 random(4);
    std::uniform_int_distribution<int> uniform(0, 500);
    constexpr std::uint32_t kCount = 30000;
    ObjectMesh mesh;
    for (std::uint32_t n = 0; n < kCount; ++n) {
        const Vec3d a{0, 0, uniform(random) * 1e-4}, b{1, 0, uniform(random) * 1e-4}, c{0, 1, uniform(random) * 1e-4};
        for (const Vec3d& corner : {a, b, c}) mesh.vertices.push_back(corner);
        mesh.triangles.emplace_back();
        mesh.triangles.back().corners = {3 * n, 3 * n + 1, 3 * n + 2};
        mesh.triangles.push_back(mesh.triangles.back());
    }
    const test::ProcessorTime time;
    const MeshSet meshes = meshSetOf({mesh});
    EXPECT_LT(time.seconds(), 60);
    std::set<std::array<double, 3>> distinct;
    for (std::uint32_t n = 0; n < kCount; ++n) {
        const auto& triangles = meshes.objects[0].triangles;
        EXPECT_EQ(triangles[2 * n].plane, triangles[2 * n + 1].plane);
        distinct.insert({mesh.vertices[3 * n].z, mesh.vertices[3 * n + 1].z, mesh.vertices[3 * n + 2].z});
    }
    EXPECT_EQ(meshes.planes.size(), distinct.size());
}

TEST(AssignPlanes, EveryCornerLiesOnItsPlane) {
    // A fan of many slopes: triangles that share a plane are within the distance of it.
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(-5, 5);
    ObjectMesh mesh;
    for (std::uint32_t n = 0; n < 300; ++n) {
        for (int c = 0; c < 3; ++c) mesh.vertices.push_back({uniform(random), uniform(random), uniform(random) * 0.3});
        mesh.triangles.emplace_back();
        mesh.triangles.back().corners = {3 * n, 3 * n + 1, 3 * n + 2};
    }
    const MeshSet meshes = meshSetOf({mesh});
    for (const Triangle& triangle : meshes.objects[0].triangles) {
        if (triangle.plane == kNoPlane) continue;
        const Plane& plane = meshes.planes[triangle.plane];
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3d p = mesh.vertices[corner];
            EXPECT_NEAR(plane.slopeX * p.x + plane.slopeY * p.y + plane.offset, p.z,
                        kDistance * (2 + std::abs(plane.slopeX) + std::abs(plane.slopeY)));
        }
    }
}

}  // namespace
}  // namespace svt::mesh
