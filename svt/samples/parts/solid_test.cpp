#include <svt/samples/parts/plan.hpp>
#include <svt/samples/parts/solid.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::samples {
namespace {

// Faces of an isolated solid, simplified to its own corners.
std::vector<RawFace> facesOf(const Solid& solid) {
    Boundary shape = boundary(solid, {});
    std::vector<Point> corners;
    for (const RawFace& face : shape.faces) collectCorners(face, corners);
    std::sort(corners.begin(), corners.end());
    for (RawFace& face : shape.faces) simplify(face, corners);
    return shape.faces;
}

bool isClosed(const std::vector<RawFace>& faces) {
    std::map<std::pair<Point, Point>, int> edges;
    for (const RawFace& face : faces)
        for (const auto& ring : face.rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Point p = ring[i], q = ring[(i + 1) % ring.size()];
                ++edges[{p, q}];
                --edges[{q, p}];
            }
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

std::size_t vertexCount(const std::vector<RawFace>& faces) {
    std::size_t count = 0;
    for (const RawFace& face : faces)
        for (const auto& ring : face.rings) count += ring.size();
    return count;
}

TEST(Boundary, BoxHasSixRectangles) {
    const Solid solid{Axis::X, Material::Brick, {box(0, 2000, 0, 3000, 0, 500)}};
    const std::vector<RawFace> faces = facesOf(solid);
    EXPECT_EQ(faces.size(), 6u);
    EXPECT_EQ(vertexCount(faces), 24u);
    EXPECT_TRUE(isClosed(faces));
    EXPECT_DOUBLE_EQ(boundary(solid, {}).volume, 3.0);
}

TEST(Boundary, PiecesThatTouchHaveNoFaceBetweenThem) {
    const Solid solid{Axis::X, Material::Brick, {box(0, 1000, 0, 1000, 0, 1000), box(1000, 2000, 0, 1000, 0, 1000)}};
    EXPECT_EQ(facesOf(solid).size(), 6u);
}

TEST(Boundary, StepHasNoVertexInsideAnEdge) {
    // The side faces of an L have six corners; the bottom gets none from the step.
    const Solid solid{Axis::X, Material::Brick, {box(0, 2000, 0, 1000, 0, 1000), box(0, 1000, 0, 1000, 1000, 2000)}};
    const std::vector<RawFace> faces = facesOf(solid);
    EXPECT_EQ(faces.size(), 8u);
    EXPECT_EQ(vertexCount(faces), 6u * 4 + 2 * 6);
    EXPECT_TRUE(isClosed(faces));
}

TEST(Boundary, CornerOnANeighboringEdgeBecomesAVertexOfBothFaces) {
    // The upper box covers half of the lower one's front edge: its corner splits that edge for every face along it.
    const Solid solid{Axis::X, Material::Brick, {box(0, 2000, 0, 1000, 0, 1000), box(500, 1000, -500, 0, 0, 1000)}};
    const std::vector<RawFace> faces = facesOf(solid);
    EXPECT_TRUE(isClosed(faces));
}

TEST(Boundary, OpeningIsAHoleInBothFacesOfTheWall) {
    Solid wall{Axis::X, Material::Brick, {box(0, 4000, 0, 300, 0, 2500)}};
    wall.cut(box(1000, 2000, 0, 300, 800, 2000));
    const std::vector<RawFace> faces = facesOf(wall);
    EXPECT_EQ(faces.size(), 10u);
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const RawFace& f) { return f.rings.size() == 2; }), 2);
    EXPECT_TRUE(isClosed(faces));
    EXPECT_NEAR(boundary(wall, {}).volume, (4.0 * 2.5 - 1.0 * 1.2) * 0.3, 1e-12);
}

TEST(Boundary, SlopedPrismIsExactAlongBothAxes) {
    for (const Axis axis : {Axis::X, Axis::Y}) {
        // A wedge 1 m long under the slope z = 4/5 v, v from 0 to 1 m.
        const Solid solid{axis, Material::Brick, {{0, 1000, {{1, 0, 1000}, {0, -1, 0}, {-4, 5, 0}}, true}}};
        const std::vector<RawFace> faces = facesOf(solid);
        EXPECT_EQ(faces.size(), 5u);
        EXPECT_TRUE(isClosed(faces));
        EXPECT_NEAR(boundary(solid, {}).volume, 0.4, 1e-12);
        double signedVolume = 0;
        for (const RawFace& face : faces)
            for (std::size_t i = 1; i + 1 < face.rings[0].size(); ++i) {
                const auto at = [&](std::size_t k) {
                    const Point p = face.rings[0][k];
                    return Vec3d{double(p.x), double(p.y), double(p.z)} / (1000.0 * kUnitsPerMillimetre);
                };
                signedVolume += dot(at(0), cross(at(i), at(i + 1))) / 6;
            }
        EXPECT_NEAR(signedVolume, 0.4, 1e-12) << "outward orientation";
    }
}

TEST(Boundary, FaceIsSplitWhereTheNeighborChanges) {
    const Solid wall{Axis::X, Material::Brick, {box(0, 4000, 0, 300, 0, 2500)}};
    const Solid left{Axis::X, Material::Air, {box(0, 1500, 300, 3000, 0, 2500)}};
    const Solid right{Axis::X, Material::Air, {box(1500, 4000, 300, 3000, 0, 2500)}};
    const std::vector<Neighbor> neighbors{Neighbor(left, 7), Neighbor(right, 8)};
    std::map<int, int> facesByNeighbor;
    for (const RawFace& face : boundary(wall, neighbors).faces) ++facesByNeighbor[face.neighbor];
    EXPECT_EQ(facesByNeighbor, (std::map<int, int>{{-1, 5}, {7, 1}, {8, 1}}));
}

TEST(Solid, LaterPiecesOverruleEarlierOnes) {
    Solid solid{Axis::X, Material::Brick, {box(0, 1000, 0, 1000, 0, 1000)}};
    solid.cut(box(0, 500, 0, 1000, 0, 1000)).add(box(0, 100, 0, 1000, 0, 1000));
    EXPECT_TRUE(contains(solid, {50, 500, 500}));
    EXPECT_FALSE(contains(solid, {300, 500, 500}));
    EXPECT_TRUE(contains(solid, {700, 500, 500}));
    EXPECT_FALSE(contains(solid, {700, 500, 1500}));
}

}  // namespace
}  // namespace svt::samples
