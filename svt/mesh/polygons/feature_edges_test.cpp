#include <svt/mesh/feature_edges.hpp>
#include <svt/mesh/models_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace svt::mesh {
namespace {

double totalLength(const ObjectMesh& mesh, const std::vector<FeatureEdge>& edges) {
    double sum = 0;
    for (const FeatureEdge& edge : edges) sum += length(mesh.vertices[edge.to] - mesh.vertices[edge.from]);
    return sum;
}

// A prism with `sides` faces around the z axis, radius 1, height 3.
ObjectMesh prism(int sides) {
    std::vector<Vec3d> vertices;
    std::vector<std::vector<std::uint32_t>> rings(2);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        vertices.push_back({std::cos(angle), std::sin(angle), 0});
        vertices.push_back({std::cos(angle), std::sin(angle), 3});
        const auto low = static_cast<std::uint32_t>(2 * i), next = static_cast<std::uint32_t>(2 * ((i + 1) % sides));
        rings.push_back({low, next, next + 1, low + 1});
        rings[0].insert(rings[0].begin(), low);
        rings[1].push_back(low + 1);
    }
    return test::meshOfRings(vertices, rings);
}

TEST(FeatureEdges, ABoxHasTwelveAndNoDiagonal) {
    const ObjectMesh box = test::boxMesh({0, 0, 0}, {2, 3, 5});
    const auto edges = findFeatureEdges(box);
    ASSERT_EQ(edges.size(), 12u);
    EXPECT_NEAR(totalLength(box, edges), 4 * (2 + 3 + 5), 1e-12);
    EXPECT_NEAR(length(box.vertices[edges[0].to] - box.vertices[edges[0].from]), 5, 1e-12) << "longest first";
}

TEST(FeatureEdges, TheWindingOfTrianglesDoesNotMatter) {
    ObjectMesh box = test::boxMesh({0, 0, 0}, {2, 3, 5});
    const auto edges = findFeatureEdges(box);
    std::swap(box.triangles[0].corners[1], box.triangles[0].corners[2]);
    std::swap(box.triangles[7].corners[1], box.triangles[7].corners[2]);
    EXPECT_EQ(findFeatureEdges(box), edges);
}

TEST(FeatureEdges, ASheetHasItsBorderAlone) {
    const ObjectMesh sheet = test::meshOfRings({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}});
    const auto edges = findFeatureEdges(sheet);
    ASSERT_EQ(edges.size(), 4u);
    EXPECT_NEAR(totalLength(sheet, edges), 12, 1e-12);
}

TEST(FeatureEdges, FacetsOfARoundColumnAreNotDrawn) {
    // 24 sides turn by 15 degrees each, 8 sides by 45.
    EXPECT_EQ(findFeatureEdges(prism(24)).size(), 48u) << "the rims at both ends";
    EXPECT_EQ(findFeatureEdges(prism(8)).size(), 24u) << "the rims and eight edges";
    EXPECT_EQ(findFeatureEdges(prism(8), {.creaseAngleDegrees = 50}).size(), 16u);
}

// Two rectangles side by side in one plane; the seam of the right one has a point in its middle.
TEST(FeatureEdges, ASeamWithATJunctionVanishes) {
    const ObjectMesh sheet =
        test::meshOfRings({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {4, 0, 0}, {4, 1, 0}, {4, 2, 0}, {2, 1, 0}},
                          {{0, 1, 2, 3}, {1, 4, 5, 7}, {7, 5, 6, 2}});
    const auto edges = findFeatureEdges(sheet);
    ASSERT_EQ(edges.size(), 4u) << "collinear pieces are one edge";
    EXPECT_NEAR(totalLength(sheet, edges), 12, 1e-9);
}

// The same with the right one folded up by 90 degrees: now the seam is a crease.
TEST(FeatureEdges, ACreaseWithATJunctionIsOneEdge) {
    const ObjectMesh sheet =
        test::meshOfRings({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 2}, {2, 1, 2}, {2, 2, 2}, {2, 1, 0}},
                          {{0, 1, 2, 3}, {1, 4, 5, 7}, {7, 5, 6, 2}});
    const auto edges = findFeatureEdges(sheet);
    ASSERT_EQ(edges.size(), 7u);
    EXPECT_NEAR(totalLength(sheet, edges), 2 * 7, 1e-9);
}

TEST(FeatureEdges, WhereAWallStandsOnAFloorIsAnEdge) {
    const ObjectMesh mesh =
        test::meshOfRings({{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 0}, {-2, 0, 0}, {-2, 2, 0}, {0, 0, 2}, {0, 2, 2}},
                          {{0, 2, 3, 1}, {4, 0, 1, 5}, {0, 1, 7, 6}});
    const auto edges = findFeatureEdges(mesh);
    EXPECT_TRUE(std::any_of(edges.begin(), edges.end(), [](const FeatureEdge& e) { return e.from == 0 && e.to == 1; }));
    EXPECT_EQ(edges.size(), 4u + 3u + 1u) << "the floor's border, three sides of the wall, and its foot";
}

TEST(FeatureEdges, ADegenerateTriangleLeavesNoMark) {
    // A square with an extra point on its lower side, filled by a degenerate triangle.
    ObjectMesh sheet = test::meshOfRings(
        {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {2, 0, 0}, {4, -2, 0}, {0, -2, 0}}, {{0, 1, 2, 3}, {0, 4, 1}});
    sheet.triangles.push_back(sheet.triangles[0]);
    sheet.triangles.back().corners = {6, 4, 0};
    sheet.triangles.push_back(sheet.triangles[0]);
    sheet.triangles.back().corners = {6, 5, 4};
    sheet.triangles.push_back(sheet.triangles[0]);
    sheet.triangles.back().corners = {4, 5, 1};
    const auto edges = findFeatureEdges(sheet);
    EXPECT_EQ(edges.size(), 4u);
    EXPECT_NEAR(totalLength(sheet, edges), 16, 1e-9);
}

TEST(FeatureEdges, AnEmptyMeshHasNone) { EXPECT_TRUE(findFeatureEdges(ObjectMesh()).empty()); }

}  // namespace
}  // namespace svt::mesh
