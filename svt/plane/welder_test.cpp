#include <svt/plane/welder.hpp>

#include <gtest/gtest.h>

#include <cstdlib>

namespace svt::plane {
namespace {

TEST(Welder, APointKeepsItsNumberWhenNearerPointsFollow) {
    Welder<Point> welder;
    const auto numberOf = [&](Point p) {
        const auto cellAt = [&](std::int64_t by) { return Cell{(p.u + by) / 20, 0, 0}; };
        return welder.add(p, cellAt(0), cellAt(-10), cellAt(10),
                          [&](std::uint32_t n) { return std::abs(welder.points()[n].u - p.u) <= 10; });
    };
    EXPECT_EQ(numberOf({100, 0}), 0u);
    EXPECT_EQ(numberOf({108, 0}), 0u);
    EXPECT_EQ(numberOf({111, 0}), 1u);  // in the cell of the point before, and nearer to it
    EXPECT_EQ(numberOf({108, 0}), 0u);
    EXPECT_EQ(welder.points(), (std::vector<Point>{{100, 0}, {111, 0}}));
}

}  // namespace
}  // namespace svt::plane
