#include <svt/drawing/clip_segment.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

void expectPart(PlanePoint a, PlanePoint b, PlanePoint from, PlanePoint to) {
    const auto part = clipSegment(a, b, {0, 0}, {4, 2});
    ASSERT_TRUE(part);
    EXPECT_DOUBLE_EQ(part->first.u, from.u);
    EXPECT_DOUBLE_EQ(part->first.v, from.v);
    EXPECT_DOUBLE_EQ(part->second.u, to.u);
    EXPECT_DOUBLE_EQ(part->second.v, to.v);
}

TEST(ClipSegment, KeepsThePartWithinTheRectangle) {
    expectPart({1, 1}, {3, 1.5}, {1, 1}, {3, 1.5});
    expectPart({-2, 1}, {6, 1}, {0, 1}, {4, 1});
    expectPart({6, 1}, {-2, 1}, {4, 1}, {0, 1});
    expectPart({3, 1}, {3, 7}, {3, 1}, {3, 2});
    expectPart({-1, -1}, {1, 1}, {0, 0}, {1, 1});
    expectPart({0, 0}, {4, 0}, {0, 0}, {4, 0});  // along an edge
}

TEST(ClipSegment, IsNothingOutside) {
    const auto isOutside = [](PlanePoint a, PlanePoint b) { return !clipSegment(a, b, {0, 0}, {4, 2}); };
    EXPECT_TRUE(isOutside({5, 0}, {5, 2}));
    EXPECT_TRUE(isOutside({-1, 3}, {5, 3}));
    EXPECT_TRUE(isOutside({3, -2}, {6, 1}));   // beside the corner
    EXPECT_TRUE(isOutside({-1, 1}, {1, -1}));  // touches the corner
    EXPECT_TRUE(isOutside({1, 1}, {1, 1}));
}

TEST(ClipSegment, ARectangleIsMetAtItsBorderToo) {
    const PlanePoint low{0, 0}, high{4, 2};
    EXPECT_TRUE(meetsRectangle({-1, 1}, {5, 1}, low, high));
    EXPECT_TRUE(meetsRectangle({-1, 2}, {5, 2}, low, high));
    EXPECT_TRUE(meetsRectangle({-1, 1}, {1, -1}, low, high)) << "at a corner";
    EXPECT_TRUE(meetsRectangle({1, 1}, {1, 1}, low, high)) << "a point";
    EXPECT_FALSE(meetsRectangle({5, 1}, {5, 1}, low, high));
    EXPECT_FALSE(meetsRectangle({-1, 3}, {5, 3}, low, high));
    EXPECT_FALSE(meetsRectangle({-1, 0.5}, {0.5, -1}, low, high)) << "past a corner";
}

}  // namespace
}  // namespace svt::drawing
