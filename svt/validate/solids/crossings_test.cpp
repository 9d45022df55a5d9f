#include <svt/validate/solids/crossings.hpp>

#include <gtest/gtest.h>

namespace svt::validate {
namespace {

// Points by index; triangles share those that they name alike.
bool meetBeyond(const std::vector<Point>& points, const Corners& a, const Corners& b) {
    const Lattice lattice;
    const PointSet set{&points, &lattice, 0};
    const bool result = meetBeyondCorners(a, b, set);
    EXPECT_EQ(meetBeyondCorners(b, a, set), result);
    return result;
}

TEST(MeetBeyondCorners, TrianglesWithoutCommonCorners) {
    const std::vector<Point> p{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {2, 2, -3}, {2, 2, 3}, {8, 8, 3}, {2, 2, 1}};
    EXPECT_TRUE(meetBeyond(p, {0, 1, 2}, {3, 4, 5}));
    EXPECT_FALSE(meetBeyond(p, {0, 1, 2}, {6, 4, 5}));
    // A corner on the other, by its place alone.
    const std::vector<Point> q{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {2, 2, 0}, {2, 2, 3}, {8, 8, 3}};
    EXPECT_TRUE(meetBeyond(q, {0, 1, 2}, {3, 4, 5}));
}

TEST(MeetBeyondCorners, TrianglesWithOneCommonCorner) {
    const std::vector<Point> p{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {4, 4, 3}, {4, 4, -3}, {-4, -4, 3}, {-4, -4, -3}};
    EXPECT_TRUE(meetBeyond(p, {0, 1, 2}, {0, 3, 4}));
    EXPECT_FALSE(meetBeyond(p, {0, 1, 2}, {0, 5, 6}));
}

TEST(MeetBeyondCorners, TrianglesWithACommonEdge) {
    const std::vector<Point> p{{0, 0, 0}, {9, 0, 0}, {4, 9, 0}, {4, -9, 0}, {4, 5, 0}, {4, 5, 1}};
    EXPECT_FALSE(meetBeyond(p, {0, 1, 2}, {1, 0, 3})) << "side by side";
    EXPECT_TRUE(meetBeyond(p, {0, 1, 2}, {1, 0, 4})) << "folded onto each other";
    EXPECT_FALSE(meetBeyond(p, {0, 1, 2}, {1, 0, 5})) << "a sharp edge";
    EXPECT_TRUE(meetBeyond(p, {0, 1, 2}, {2, 1, 0})) << "the same corners";
}

}  // namespace
}  // namespace svt::validate
