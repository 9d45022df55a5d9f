#include <svt/plane/point.hpp>

#include <gtest/gtest.h>

namespace svt::plane {
namespace {

constexpr std::int64_t kWide = std::int64_t{1} << 40;

TEST(Point, TurnsAreExactWhereDoublesAreNot) {
    // A line through the whole range: one step beside it is beside it.
    const Point a{-kWide, -kWide}, b{kWide, kWide - 1};
    EXPECT_EQ(turn(a, b, {0, 0}), 1);
    EXPECT_EQ(turn(a, b, {1, 0}), -1);
    EXPECT_EQ(turn(a, b, b), 0);
    // Twice this area is 1, of products near 2^82.
    const std::int64_t u = 1099511627776, v = 1099511627775;
    const Point far{2199023255551, 2199023255549};
    EXPECT_EQ(turn({0, 0}, far, {u, v}), 1);
    EXPECT_EQ(turn({0, 0}, {u, v}, far), -1);
    EXPECT_EQ(turn({0, 0}, far, {u - 1, v - 1}), -1);
}

TEST(Point, SegmentsMeetOrNot) {
    EXPECT_EQ(meet({0, 0}, {10, 10}, {0, 10}, {10, 0}), Meeting::Cross);
    EXPECT_EQ(meet({0, 0}, {10, 10}, {5, 5}, {9, 0}), Meeting::Touch);
    EXPECT_EQ(meet({0, 0}, {10, 0}, {4, 0}, {20, 0}), Meeting::Touch) << "along one line";
    EXPECT_EQ(meet({0, 0}, {10, 0}, {11, 0}, {20, 0}), Meeting::None) << "one behind the other";
    EXPECT_EQ(meet({0, 0}, {10, 10}, {0, 9}, {4, 5}), Meeting::None);
    EXPECT_TRUE(liesOn({4, 2}, {0, 0}, {10, 5}));
    EXPECT_FALSE(liesOn({12, 6}, {0, 0}, {10, 5})) << "on the line beyond the segment";
    EXPECT_FALSE(liesOn({4, 3}, {0, 0}, {10, 5}));
}

}  // namespace
}  // namespace svt::plane
