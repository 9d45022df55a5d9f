#include <svt/core/vec.hpp>

#include <gtest/gtest.h>

namespace svt {
namespace {

TEST(Vec3, ArithmeticIsComponentWise) {
    const Vec3d a{1, 2, 3};
    const Vec3d b{10, 20, 40};
    EXPECT_EQ(a + b, (Vec3d{11, 22, 43}));
    EXPECT_EQ(b - a, (Vec3d{9, 18, 37}));
    EXPECT_EQ(-a, (Vec3d{-1, -2, -3}));
    EXPECT_EQ(a * 2.0, (Vec3d{2, 4, 6}));
    EXPECT_EQ(2.0 * a, a * 2.0);
    EXPECT_EQ(b / 10.0, (Vec3d{1, 2, 4}));
    EXPECT_EQ(scaled(a, b), (Vec3d{10, 40, 120}));
}

TEST(Vec3, DoublesHoldWhatTheVectorHeld) {
    EXPECT_EQ(toDouble(Vec3i{-2147483647, 0, 2147483647}), (Vec3d{-2147483647, 0, 2147483647}));
    EXPECT_EQ(toDouble(Vec3f{0.5f, -0.0f, 0.1f}), (Vec3d{0.5, -0.0, double(0.1f)}));
}

TEST(Vec3, IndexReachesTheComponents) {
    Vec3i v{7, 8, 9};
    EXPECT_EQ(v[0], 7);
    EXPECT_EQ(v[1], 8);
    EXPECT_EQ(v[2], 9);
    v[1] = 5;
    EXPECT_EQ(v.y, 5);
}

TEST(Vec3, CrossProductIsRightHanded) {
    EXPECT_EQ(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0}), (Vec3d{0, 0, 1}));
    EXPECT_EQ(cross(Vec3d{0, 1, 0}, Vec3d{1, 0, 0}), (Vec3d{0, 0, -1}));
    const Vec3d a{1, 2, 3};
    const Vec3d b{-4, 5, 0.5};
    EXPECT_EQ(dot(cross(a, b), a), 0);
    EXPECT_EQ(dot(cross(a, b), b), 0);
}

TEST(Vec3, NormalizedHasLengthOneAndZeroStaysZero) {
    EXPECT_EQ(length(Vec3d{2, 3, 6}), 7);
    EXPECT_EQ(normalized(Vec3d{0, 3, 4}), (Vec3d{0, 0.6, 0.8}));
    EXPECT_EQ(normalized(Vec3d{}), Vec3d{});
}

TEST(Vec3, OrderIsLexical) {
    EXPECT_LT((Vec3i{1, 9, 9}), (Vec3i{2, 0, 0}));
    EXPECT_LT((Vec3i{1, 1, 9}), (Vec3i{1, 2, 0}));
}

TEST(Vec3, FiniteMeansAllThree) {
    EXPECT_TRUE(isFinite(Vec3d{1, 2, 3}));
    EXPECT_FALSE(isFinite(Vec3d{1, std::nan(""), 3}));
    EXPECT_FALSE(isFinite(Vec3d{1, 2, std::numeric_limits<double>::infinity()}));
}

TEST(Box3d, EmptyUntilAPointIsAdded) {
    Box3d box;
    EXPECT_TRUE(box.isEmpty());
    EXPECT_EQ(box.size(), Vec3d{});
    EXPECT_FALSE(box.contains({0, 0, 0}));
    box.add(Vec3d{1, 2, 3});
    EXPECT_FALSE(box.isEmpty());
    EXPECT_EQ(box.size(), Vec3d{});
    EXPECT_TRUE(box.contains({1, 2, 3}));
}

TEST(Box3d, HoldsAllThatWasAdded) {
    Box3d box;
    box.add(Vec3d{1, 2, 3});
    box.add(Vec3d{-1, 5, 3});
    EXPECT_EQ(box.min, (Vec3d{-1, 2, 3}));
    EXPECT_EQ(box.max, (Vec3d{1, 5, 3}));
    EXPECT_EQ(box.center(), (Vec3d{0, 3.5, 3}));
    box.add(Box3d{});
    EXPECT_EQ(box.max, (Vec3d{1, 5, 3})) << "an empty box adds nothing";
    box.add(Box3d{{9, 9, 9}, {10, 10, 10}});
    EXPECT_EQ(box.max, (Vec3d{10, 10, 10}));
}

TEST(Box3d, BoxesThatTouchOverlap) {
    const Box3d box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(box.overlaps({{1, 1, 1}, {2, 2, 2}}));
    EXPECT_FALSE(box.overlaps({{1.001, 0, 0}, {2, 1, 1}}));
    EXPECT_FALSE(box.overlaps(Box3d{}));
}

}  // namespace
}  // namespace svt
