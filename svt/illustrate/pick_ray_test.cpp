#include <svt/illustrate/pick_ray.hpp>

#include <gtest/gtest.h>

namespace svt::illustrate {
namespace {

volume::Grid gridAt(Vec3d origin) {
    return *volume::Grid::fromParts({5, 9, 13}, {0.5, 0.5, 0.5}, origin,
                                    {Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}});
}

TEST(PickRay, CountsFromTheLowerCornerAlongWorldAxes) {
    const auto ray = parsePickRay("1,0.5,-2:0,0,4", gridAt({100, 200, 30}));
    ASSERT_FALSE(ray);  // the grid is turned: it lies on the other side of x = 0
    const auto other = parsePickRay("-1,0.5,-2:0,0,4", gridAt({100, 200, 30}));
    ASSERT_TRUE(other) << other.error().toString();
    EXPECT_EQ(other->origin, (Vec3d{99, 200.5, 28}));
    EXPECT_EQ(other->direction, (Vec3d{0, 0, 1}));
}

TEST(PickRay, SaysWhatIsWrong) {
    for (const char* text : {"", "1", "1,2,3", "1,2,3:", "1,2,3:1,0", "1,2,3,1,0,0", "0,0,0:0,0,0", "0,0,0:nan,0,1",
                             "0,0,0:1,0,0,0", "0,0,0:1,0,0m", "0,0,-2:0,0,-1", "50,0,0:0,0,1"}) {
        const auto ray = parsePickRay(text, gridAt({0, 0, 0}));
        ASSERT_FALSE(ray) << text;
        EXPECT_EQ(ray.error().code(), Code::BadArgument);
    }
}

}  // namespace
}  // namespace svt::illustrate
