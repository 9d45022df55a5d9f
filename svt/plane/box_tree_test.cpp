#include <svt/plane/box_tree.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace svt::plane {
namespace {

std::vector<SpaceTriangle> randomTriangles(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&](unsigned most) { return double(random() % most); };
    std::vector<SpaceTriangle> triangles;
    for (std::size_t n = 0; n < count; ++n) {
        const Vec3d at{number(200), number(100), number(20)};
        triangles.push_back({at, at + Vec3d{number(30), number(3), number(3)}, at + Vec3d{number(30), number(9), 2}});
    }
    return triangles;
}

Box3d boxAround(const SpaceTriangle& triangle) {
    Box3d box;
    for (const Vec3d& corner : triangle) box.add(corner);
    return box;
}

std::vector<Box3d> boxesAround(const std::vector<SpaceTriangle>& triangles) {
    std::vector<Box3d> boxes;
    for (const SpaceTriangle& triangle : triangles) boxes.push_back(boxAround(triangle));
    return boxes;
}

TEST(BoxTree, FindsTheBoxesThatOverlap) {
    const std::vector<Box3d> boxes = boxesAround(randomTriangles(900, 1));
    for (const BoxTree::Halving halving : {BoxTree::Halving{}, BoxTree::Halving{1, false}}) {
        const BoxTree tree(boxes, halving);
        std::size_t found = 0;
        for (const Box3d& box : boxesAround(randomTriangles(60, 2))) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t n = 0; n < boxes.size(); ++n)
                if (boxes[n].overlaps(box)) expected.push_back(n);
            EXPECT_EQ(tree.findAll(box), expected);
            found += expected.size();
        }
        EXPECT_GT(found, 100u);
    }
}

TEST(BoxTree, EndsWithTheFirstCallThatReturnsTrue) {
    const BoxTree tree(boxesAround(randomTriangles(50, 3)));
    int calls = 0;
    EXPECT_TRUE(tree.visit([](const Box3d&) { return true; }, [&](std::uint32_t) { return ++calls == 7; }));
    EXPECT_EQ(calls, 7);
    EXPECT_FALSE(tree.visit([](const Box3d&) { return false; }, [](std::uint32_t) { return true; }));
    EXPECT_FALSE(BoxTree().visit([](const Box3d&) { return true; }, [](std::uint32_t) { return true; }));
}

TEST(BoxTree, AlongADirectionFindsTheSameBoxesTheNearerHalfFirst) {
    std::vector<Box3d> boxes;
    for (int n = 0; n < 64; ++n) boxes.push_back({{n * 2.0, 0, 0}, {n * 2.0 + 1, 1, 1}});
    const BoxTree tree(boxes, BoxTree::Halving{1, true});
    for (const double sign : {1.0, -1.0}) {
        std::vector<std::uint32_t> found;
        tree.forEachAlong(
            {sign, 0, 0}, [](const Box3d& box) { return box.max.x > 32; },
            [&](std::uint32_t n) { found.push_back(n); });
        ASSERT_EQ(found.size(), 48u);
        EXPECT_EQ(found.front(), sign > 0 ? 16u : 63u);
        if (sign < 0) std::reverse(found.begin(), found.end());
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    }
}

TEST(BoxTree, SlabsLeaveOutOnlyTrianglesThatDoNotReachEachOther) {
    // Long slanted triangles side by side: all boxes meet, few triangles do.
    std::vector<SpaceTriangle> triangles;
    for (int n = 0; n < 40; ++n)
        triangles.push_back({Vec3d{0, double(10 * n), 0}, {1000, double(10 * n + 1000), 0}, {0, double(10 * n), 5}});
    BoxTree tree(boxesAround(triangles), {1, true});
    tree.addSlabs(triangles);
    std::size_t all = 0, beside = 0;
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
        const Box3d box = boxAround(triangles[n]);
        all += tree.findAll(box).size();
        std::vector<std::uint32_t> found;
        tree.forEachBeside(box, triangles[n], [&](std::uint32_t i) { found.push_back(i); });
        EXPECT_NE(std::ranges::find(found, n), found.end()) << "a triangle reaches itself";
        beside += found.size();
    }
    EXPECT_EQ(all, triangles.size() * triangles.size());
    EXPECT_LT(beside, all / 4);
}

}  // namespace
}  // namespace svt::plane
