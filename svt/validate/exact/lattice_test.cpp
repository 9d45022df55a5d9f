#include <svt/validate/exact/snapper.hpp>

#include <gtest/gtest.h>

namespace svt::validate {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 40;

TEST(Lattice, SidesAreExactWhereDoublesAreNot) {
    const Point p{-kFar, -kFar, -kFar}, q{kFar, -kFar, kFar}, r{-kFar, kFar, kFar - 1};
    EXPECT_EQ(side(p, q, r, {kFar, kFar, 3 * (kFar / 3)}), side(p, q, r, {0, 0, -kFar}));
    EXPECT_EQ(side(p, q, r, p), 0);
    EXPECT_EQ(side(p, q, r, {-kFar, -kFar, -kFar + 1}), 1);
    EXPECT_EQ(side(p, q, r, {-kFar, -kFar, -kFar - 1}), -1);
}

TEST(Lattice, AModelOfTheWholeEarthFits) {
    Box3d bounds;
    bounds.add(Vec3d{-7e6, -7e6, -7e6});
    bounds.add(Vec3d{7e6, 7e6, 7e6});
    const Lattice lattice(bounds);
    const Vec3d corner{7e6, -7e6, 6.5e6};
    EXPECT_LE(std::abs(lattice.toLattice(corner).x), kFar);
    EXPECT_LT(length(lattice.toWorld(lattice.toLattice(corner)) - corner), 2 * lattice.unit());
}

TEST(Lattice, SegmentsAndTrianglesMeetOrNot) {
    const std::array<Point, 3> t{Point{0, 0, 0}, Point{10, 0, 0}, Point{0, 10, 0}};
    EXPECT_EQ(meet(Point{2, 2, -1}, Point{2, 2, 1}, t), Meeting::Cross);
    EXPECT_EQ(meet(Point{2, 2, 0}, Point{2, 2, 1}, t), Meeting::Touch);
    EXPECT_EQ(meet(Point{2, 2, 1}, Point{2, 2, 2}, t), Meeting::None);
    EXPECT_EQ(meet(Point{5, 5, -1}, Point{5, 5, 1}, t), Meeting::Touch);  // on an edge
    EXPECT_EQ(meet(Point{6, 5, -1}, Point{6, 5, 1}, t), Meeting::None);
    EXPECT_EQ(meet(Point{-5, 2, 0}, Point{20, 2, 0}, t), Meeting::Touch);  // within the plane
    EXPECT_EQ(meet(Point{-5, 20, 0}, Point{20, 20, 0}, t), Meeting::None);
}

TEST(Snapper, PointsCloserThanTheToleranceAreOne) {
    Snapper snapper(10);
    EXPECT_EQ(snapper.add({0, 0, 0}), 0u);
    EXPECT_EQ(snapper.add({9, 0, 0}), 0u);
    EXPECT_EQ(snapper.add({10, 0, 0}), 1u);
    EXPECT_EQ(snapper.add({6, 0, 0}), 0u) << "the first of two that are near enough";
    EXPECT_EQ(snapper.add({-5, -5, -5}), 0u);
    EXPECT_EQ(snapper.add({-7, -7, -7}), 2u);
    Snapper exact(0);
    EXPECT_EQ(exact.add({1, 2, 3}), 0u);
    EXPECT_EQ(exact.add({1, 2, 3}), 0u);
    EXPECT_EQ(exact.add({1, 2, 4}), 1u);
}

}  // namespace
}  // namespace svt::validate
