#include <svt/mesh/models_test.hpp>
#include <svt/mesh/thickness.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace svt::mesh {
namespace {

using test::boxMesh;

// Thickness of the faces of a box, by the axis that they look along.
void expectBox(Vec3d size) {
    ObjectMesh mesh = boxMesh({1, 2, 3}, Vec3d{1, 2, 3} + size);
    measureThickness(mesh);
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        const Vec3d normal =
            normalized(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a));
        const double expected = std::abs(normal.x) > 0.5 ? size.x : std::abs(normal.y) > 0.5 ? size.y : size.z;
        EXPECT_NEAR(triangle.thickness, expected, 1e-6 * expected + 1e-9);
    }
}

TEST(MeasureThickness, SlabPaneAndRodAreAsThickAsTheyAre) {
    expectBox({10, 8, 0.2});     // slab
    expectBox({2, 0.004, 1.5});  // pane
    expectBox({0.01, 0.01, 3});  // rod
}

TEST(MeasureThickness, BeyondTheLimitItIsUnknown) {
    const ObjectMesh box = boxMesh({1, 2, 3}, {1.5, 2.25, 3.125});
    ObjectMesh all = box;
    measureThickness(all);
    for (const double limit : {0.1, 0.2, 0.3, 1.0}) {
        MeshSet meshes;
        meshes.objects = {box, box};
        meshes.objects[0].closingMethod = ClosingMethod::Closed;
        meshes.objects[1].closingMethod = ClosingMethod::Surface;
        for (ObjectMesh& mesh : meshes.objects)
            for (Triangle& triangle : mesh.triangles) triangle.thickness = std::numeric_limits<float>::infinity();
        measureThickness(meshes, limit, 2);
        std::size_t known = 0;
        for (std::size_t t = 0; t < box.triangles.size(); ++t) {
            const float thickness = all.triangles[t].thickness;
            known += thickness < limit ? 1 : 0;
            EXPECT_EQ(meshes.objects[0].triangles[t].thickness,
                      thickness < limit ? thickness : std::numeric_limits<float>::infinity());
            EXPECT_TRUE(std::isinf(meshes.objects[1].triangles[t].thickness));  // no solid
        }
        EXPECT_EQ(known, limit == 0.1 ? 0u : limit == 0.2 ? 4u : limit == 0.3 ? 8u : 12u);
    }
}

TEST(MeasureThickness, BallIsAsThickAsItsDiameter) {
    ObjectMesh ball;
    constexpr std::uint32_t kSlices = 48, kStacks = 24;
    ball.vertices.push_back({0, 0, -2});
    for (std::uint32_t s = 1; s < kStacks; ++s)
        for (std::uint32_t t = 0; t < kSlices; ++t) {
            const double theta = std::numbers::pi * (double(s) / kStacks - 0.5),
                         phi = 2 * std::numbers::pi * t / kSlices;
            ball.vertices.push_back(
                {2 * std::cos(theta) * std::cos(phi), 2 * std::cos(theta) * std::sin(phi), 2 * std::sin(theta)});
        }
    ball.vertices.push_back({0, 0, 2});
    const auto at = [](std::uint32_t s, std::uint32_t t) { return 1 + (s - 1) * kSlices + t % kSlices; };
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (std::uint32_t t = 0; t < kSlices; ++t) {
        corners.push_back({0, at(1, t + 1), at(1, t)});
        corners.push_back(
            {static_cast<std::uint32_t>(ball.vertices.size() - 1), at(kStacks - 1, t), at(kStacks - 1, t + 1)});
        for (std::uint32_t s = 1; s + 1 < kStacks; ++s) {
            corners.push_back({at(s, t), at(s, t + 1), at(s + 1, t + 1)});
            corners.push_back({at(s, t), at(s + 1, t + 1), at(s + 1, t)});
        }
    }
    ball.triangles = test::trianglesOf(corners);
    measureThickness(ball);
    for (const Triangle& triangle : ball.triangles) EXPECT_NEAR(triangle.thickness, 4, 0.05);
}

TEST(MeasureThickness, MaterialEndsAtAVoid) {
    ObjectMesh mesh = boxMesh({0, 0, 0}, {4, 4, 4}), hole = boxMesh({1, 1, 1}, {3, 3, 3});
    test::turnOver(hole.triangles);
    test::append(mesh, hole);
    measureThickness(mesh);
    // Centres of the outer faces lie over the void, and the void's faces look at the outer ones.
    for (const Triangle& triangle : mesh.triangles) EXPECT_NEAR(triangle.thickness, 1, 1e-6);
}

TEST(MeasureThickness, FacesThatLookTheSameWayDoNotCount) {
    // A sheet has nothing behind it, and a second sheet behind it that looks the same way is no back side.
    ObjectMesh mesh =
        test::meshOfRings({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}},
                          {{0, 1, 2, 3}, {4, 5, 6, 7}});
    measureThickness(mesh);
    for (const Triangle& triangle : mesh.triangles) EXPECT_TRUE(std::isinf(triangle.thickness));
}

TEST(MeasureThickness, TriangleWithoutAreaIsHarmless) {
    ObjectMesh mesh = boxMesh({0, 0, 0}, {1, 1, 1});
    mesh.triangles.emplace_back();
    mesh.triangles.back().corners = {0, 0, 1};
    measureThickness(mesh);
    EXPECT_TRUE(std::isinf(mesh.triangles.back().thickness));
    EXPECT_NEAR(mesh.triangles.front().thickness, 1, 1e-6);
    ObjectMesh empty;
    measureThickness(empty);
}

}  // namespace
}  // namespace svt::mesh
