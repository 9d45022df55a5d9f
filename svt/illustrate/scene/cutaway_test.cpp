#include <svt/illustrate/scene/cutaway.hpp>

#include <gtest/gtest.h>

namespace svt::illustrate {
namespace {

using analyze::SampleBox;

// 20 x 20 x 3 m of 0.1 m voxels, seen from above at a slant.
class CutawayTest : public ::testing::Test {
protected:
    CutawayTest() {
        grid_ = *volume::Grid::fromParts({200, 200, 30}, {0.1, 0.1, 0.1}, {0, 0, 0},
                                         {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        camera_.eye = {30, -10, 25};
        camera_.target = {10, 10, 1};
    }
    static SampleBox boxAt(std::int32_t x, std::int32_t y, std::int32_t size) {
        SampleBox box;
        box.min = {x, y, 5};
        box.max = {x + size, y + size, 10};
        return box;
    }
    [[nodiscard]] std::vector<render::RoundBody> bodiesOf(std::vector<SampleBox> targets, std::size_t most = 16) const {
        return cutawayBodies(camera_, grid_, std::move(targets), 0.15, most);
    }
    volume::Grid grid_;
    render::Camera camera_;
};

TEST_F(CutawayTest, FarTargetsHaveOneBodyEach) {
    const std::vector<SampleBox> targets{boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)};
    const auto bodies = bodiesOf(targets);
    ASSERT_EQ(bodies.size(), 3u);
    // Nothing is cut away between them.
    for (const auto& body : bodies) EXPECT_FALSE(body.contains({10, 10, 2.9}));
    for (std::size_t n = 0; n < targets.size(); ++n)
        EXPECT_TRUE(bodies[n].contains(grid_.worldFromIndex(toDouble(targets[n].min))));
}

TEST_F(CutawayTest, NearTargetsShareOneSmoothBody) {
    const auto bodies = bodiesOf({boxAt(20, 20, 10), boxAt(31, 20, 10), boxAt(170, 170, 10)});
    ASSERT_EQ(bodies.size(), 2u);
    for (const double x : {2.1, 3.1, 4.0}) EXPECT_TRUE(bodies[0].contains({x, 2.5, 0.8})) << x;
}

// A row of targets, each a little farther from the next: whatever is joined, no two bodies that are left meet.
TEST_F(CutawayTest, WhatIsLeftNeverMeets) {
    std::vector<SampleBox> targets;
    for (std::int32_t n = 0; n < 7; ++n) targets.push_back(boxAt(10 + 3 * n * n + 10 * n, 60, 6));
    const auto bodies = bodiesOf(targets);
    EXPECT_GT(bodies.size(), 1u);
    EXPECT_LT(bodies.size(), targets.size());
    for (double x = 0; x < 20; x += 0.1)
        for (double y = 0; y < 20; y += 0.1)
            for (const double z : {0.5, 1.5, 2.9}) {
                int inside = 0;
                for (const auto& body : bodies) inside += body.contains({x, y, z}) ? 1 : 0;
                ASSERT_LE(inside, 1) << x << ", " << y << ", " << z;
            }
    for (const auto& target : targets) {
        int inside = 0;
        for (const auto& body : bodies) inside += body.contains(grid_.worldFromIndex(toDouble(target.min))) ? 1 : 0;
        EXPECT_EQ(inside, 1);
    }
}

TEST_F(CutawayTest, ThereAreNoMoreThanAskedFor) {
    EXPECT_EQ(bodiesOf({boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)}, 2).size(), 2u);
    EXPECT_EQ(bodiesOf({boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)}, 1).size(), 1u);
    EXPECT_EQ(bodiesOf(std::vector<SampleBox>(1000, boxAt(20, 20, 10))).size(), 1u);
}

}  // namespace
}  // namespace svt::illustrate
