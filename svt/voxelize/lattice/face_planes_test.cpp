#include <svt/voxelize/face_planes.hpp>
#include <svt/voxelize/solids_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::voxelize {
namespace {

using volume::FacePlane;

// 100 x 80 x 60 samples of 0.1 m; the first at the origin.
volume::Grid gridOf(Vec3i n = {100, 80, 60}) {
    return *volume::Grid::fromParts(n, {0.1, 0.1, 0.1}, {0, 0, 0}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

// Distance of a point of world space, in voxels.
double distance(const FacePlane& face, Vec3d world) {
    const Vec3d voxel = world / 0.1 + Vec3d{0.5, 0.5, 0.5};
    return dot(face.plane.normal, voxel) + face.plane.offset;
}

const FacePlane* through(const std::vector<FacePlane>& faces, std::initializer_list<Vec3d> points) {
    for (const FacePlane& face : faces)
        if (std::all_of(points.begin(), points.end(), [&](Vec3d p) { return std::abs(distance(face, p)) < 0.01; }))
            return &face;
    return nullptr;
}

TEST(FacePlanes, OfABoxAreItsSixSides) {
    const auto faces = findFacePlanes(test::meshSetOf({test::box({1, 2, 1}, {7, 5.4, 4})}), gridOf());
    ASSERT_EQ(faces.size(), 6u);
    // Of the largest sides first; as far as the box reaches.
    EXPECT_EQ(std::abs(faces[0].plane.normal.z), 1);
    EXPECT_EQ(std::abs(faces[2].plane.normal.y), 1);
    EXPECT_EQ(std::abs(faces[4].plane.normal.x), 1);
    const FacePlane* const left = through(faces, {{1, 2, 1}, {1, 5.4, 4}});
    ASSERT_NE(left, nullptr);
    EXPECT_EQ(left->min, (std::array<std::uint16_t, 3>{10, 20, 10}));
    EXPECT_EQ(left->max, (std::array<std::uint16_t, 3>{11, 55, 41}));
}

TEST(FacePlanes, OfATurnedBoxPassThroughItsEdges) {
    const mesh::ObjectMesh box = test::turnedBox({2, 2, 1}, {7, 5, 4}, 27);
    const auto faces = findFacePlanes(test::meshSetOf({box}), gridOf());
    ASSERT_EQ(faces.size(), 6u);
    for (std::size_t side = 0; side < 4; ++side) {
        const auto& v = box.vertices;
        EXPECT_NE(through(faces, {v[side], v[(side + 1) % 4], v[side + 4], v[(side + 1) % 4 + 4]}), nullptr) << side;
    }
}

TEST(FacePlanes, AreSharedByNeighborsWhicheverWayTheyLook) {
    // Two turned boxes side by side: the wall between them is one plane, and so are the walls in line.
    const std::vector<mesh::ObjectMesh> boxes{test::turnedBox({2, 2, 1}, {7, 5, 4}, 27)};
    mesh::ObjectMesh beside = boxes[0];
    const Vec3d step = boxes[0].vertices[1] - boxes[0].vertices[0];
    for (Vec3d& v : beside.vertices) v = v + step * 0.4;
    mesh::ObjectMesh first = boxes[0];
    for (Vec3d& v : first.vertices) v = v - step * 0.6;
    const auto faces = findFacePlanes(test::meshSetOf({first, beside}), gridOf({140, 140, 60}));
    EXPECT_EQ(faces.size(), 2u + 2u + 3u);
}

TEST(FacePlanes, AreSharedByBothSidesOfAWallInSpiteOfNoise) {
    // Coordinates as files have them: walls are vertical up to rounding, in either direction.
    mesh::ObjectMesh box = test::turnedBox({2, 2, 1}, {7, 5, 4}, 27);
    mesh::ObjectMesh beside = box;
    const Vec3d step = box.vertices[1] - box.vertices[0];
    for (std::size_t n = 0; n < box.vertices.size(); ++n) {
        const double noise = n % 3 == 0 ? 3e-9 : -2e-9;
        box.vertices[n] = box.vertices[n] - step * 0.6 + Vec3d{noise, -noise, 0};
        beside.vertices[n] = beside.vertices[n] + step * 0.4 + Vec3d{-noise, noise, 0};
    }
    EXPECT_EQ(findFacePlanes(test::meshSetOf({box, beside}), gridOf({140, 140, 60})).size(), 2u + 2u + 3u);
}

TEST(FacePlanes, OutsideOfTheGridOrTooSmallAreLeftOut) {
    const auto outside = findFacePlanes(test::meshSetOf({test::box({20, 2, 1}, {27, 5, 4})}), gridOf());
    EXPECT_TRUE(outside.empty());
    const auto small = findFacePlanes(test::meshSetOf({test::box({1, 1, 1}, {1.5, 1.5, 1.5})}), gridOf());
    EXPECT_TRUE(small.empty());  // 25 square voxels a side
    const auto half = findFacePlanes(test::meshSetOf({test::box({5, 2, 1}, {27, 5, 4})}), gridOf());
    EXPECT_EQ(half.size(), 5u);
    for (const FacePlane& face : half)
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(face.min[axis], face.max[axis]);
    EXPECT_FALSE(volume::checkFacePlanes(half, {99, 80, 60}).hasValue());
    EXPECT_TRUE(volume::checkFacePlanes(half, {100, 80, 60}).hasValue());
}

}  // namespace
}  // namespace svt::voxelize
