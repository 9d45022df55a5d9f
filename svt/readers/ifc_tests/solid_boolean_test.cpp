#include <svt/readers/ifc_shape/solid_boolean.hpp>

#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/sweeps.hpp>

#include <gtest/gtest.h>

#include <random>

namespace svt::readers::ifc {
namespace {

using Faces = std::vector<model::Polygon>;

Faces boxAt(Vec3d low, Vec3d size) {
    Transform place;
    place.origin = low;
    return transformed(block(size), place);
}

double volumeOf(const std::optional<Faces>& faces) {
    EXPECT_TRUE(faces);
    if (!faces) return -1;
    EXPECT_TRUE(faces->empty() || isClosed(*faces));
    return enclosedVolume(*faces);
}

// Whatever the two are: what is in both, in one or in either adds up.
void expectSums(const Faces& a, const Faces& b, int number) {
    const double both = volumeOf(evaluateBoolean(BooleanOperator::Intersection, {a, b}));
    const double either = volumeOf(evaluateBoolean(BooleanOperator::Union, {a, b}));
    const double first = volumeOf(evaluateBoolean(BooleanOperator::Difference, {a, b}));
    const double second = volumeOf(evaluateBoolean(BooleanOperator::Difference, {b, a}));
    const double tolerance = 2e-4;  // edges are moved by up to 10 micrometres
    EXPECT_NEAR(either + both, enclosedVolume(a) + enclosedVolume(b), tolerance) << number;
    EXPECT_NEAR(first + both, enclosedVolume(a), tolerance) << number;
    EXPECT_NEAR(second + both, enclosedVolume(b), tolerance) << number;
}

TEST(SolidBoolean, KnownBoxes) {
    const Faces a = boxAt({0, 0, 0}, {2, 2, 2});
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference, {a, boxAt({1, 1, 1}, {2, 2, 2})})), 7, 1e-12);
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference, {a, boxAt({0.5, 0.5, -1}, {1, 1, 4})})), 6,
                1e-12);
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference, {a, boxAt({0.5, 0.5, 0.5}, {1, 1, 1})})), 7,
                1e-12);
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Intersection, {a, boxAt({0.5, 0.5, 0.5}, {1, 1, 1})})), 1,
                1e-12);
    EXPECT_TRUE(evaluateBoolean(BooleanOperator::Difference, {a, a})->empty());
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Union, {a, a})), 8, 1e-12);
    // Side by side, the face between them goes; apart, both stay.
    const auto joined = evaluateBoolean(BooleanOperator::Union, {a, boxAt({2, 0, 0}, {1, 2, 2})});
    EXPECT_NEAR(volumeOf(joined), 12, 1e-12);
    EXPECT_EQ(joined->size(), 6U);
    EXPECT_EQ(evaluateBoolean(BooleanOperator::Union, {a, boxAt({5, 0, 0}, {1, 2, 2})})->size(), 12U);
    EXPECT_TRUE(evaluateBoolean(BooleanOperator::Intersection, {a, boxAt({2, 0, 0}, {1, 2, 2})})->empty());
}

TEST(SolidBoolean, ManyOpeningsAtOnceThatOverlap) {
    const auto wall =
        evaluateBoolean(BooleanOperator::Difference,
                        {boxAt({0, 0, 0}, {10, 0.3, 3}), boxAt({1, 0, 1}, {1, 0.3, 1}), boxAt({1.5, -1, 1}, {1, 2, 1}),
                         boxAt({4, 0, 0}, {1, 0.3, 2}), boxAt({7, 0.1, 1}, {1, 5, 1})});
    EXPECT_NEAR(volumeOf(wall), 0.3 * (30 - 1.5 - 2) - 0.2, 1e-12);
}

TEST(SolidBoolean, BoxesWithFacesOnCommonPlanes) {
    std::mt19937 random(7);
    const auto whole = [&](int low, int high) {
        return low + static_cast<int>(random() % std::uint32_t(high - low + 1));
    };
    for (int i = 0; i < 150; ++i) {
        const auto box = [&] {
            return boxAt({whole(0, 3) * 0.5, whole(0, 3) * 0.5, whole(0, 3) * 0.5},
                         {whole(1, 4) * 0.5, whole(1, 4) * 0.5, whole(1, 4) * 0.5});
        };
        const Faces a = box(), b = box();
        expectSums(a, b, i);
    }
}

TEST(SolidBoolean, TurnedBoxesAndRoundOnes) {
    std::mt19937 random(11);
    const auto share = [&] { return double(random() % 10000) / 10000; };
    for (int i = 0; i < 60; ++i) {
        const auto body = [&](bool isRound) {
            Transform place = axesFrom({share(), share(), share()}, {share() - 0.5, share() - 0.5, share() - 0.5},
                                       {share() - 0.5, share() - 0.5, share() - 0.5});
            return transformed(isRound ? cone(0.3 + share(), 0.3 + share(), 0.5 + share())
                                       : block({0.3 + share(), 0.3 + share(), 0.3 + share()}),
                               place);
        };
        const Faces a = body(i % 4 == 3), b = body(i % 4 == 2);
        expectSums(a, b, i);
    }
}

TEST(SolidBoolean, InwardOperandsAndHalfSpaces) {
    Faces inward = boxAt({0, 0, 0}, {1, 1, 1});
    turnOver(inward);
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference, {boxAt({0, 0, 0}, {2, 1, 1}), inward})), 1,
                1e-12);
    const Faces box = boxAt({0, 0, 0}, {1, 1, 1});
    const Faces half = halfSpaceAround(boundsOf(box), {0.5, 0.5, 0.5}, {1, 1, 1});
    EXPECT_TRUE(isClosed(half));
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference, {box, half})), 0.5, 1e-9);
    // The plane only touches a corner, or lies on a face.
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference,
                                         {box, halfSpaceAround(boundsOf(box), {1, 1, 1}, {1, 1, 1})})),
                1, 1e-9);
    EXPECT_NEAR(volumeOf(evaluateBoolean(BooleanOperator::Difference,
                                         {box, halfSpaceAround(boundsOf(box), {0, 0, 1}, {0, 0, 1})})),
                1, 1e-12);
    EXPECT_TRUE(
        evaluateBoolean(BooleanOperator::Difference, {box, halfSpaceAround(boundsOf(box), {0, 0, 0}, {0, 0, 1})})
            ->empty());
}

TEST(SolidBoolean, WhatIsNotClosedGivesNothing) {
    Faces open = boxAt({0, 0, 0}, {1, 1, 1});
    open.pop_back();
    EXPECT_FALSE(isClosed(open));
    EXPECT_FALSE(evaluateBoolean(BooleanOperator::Difference, {open, boxAt({0.5, 0.5, 0.5}, {1, 1, 1})}));
}

TEST(Body, ClosedUpToPointsOnEdges) {
    Faces faces = boxAt({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(isClosed(faces));
    // One face in two, whose common corner lies within an edge of a neighbour.
    const model::Polygon whole = faces[0];
    const Vec3d a = whole.points[0], b = whole.points[1], c = whole.points[2], d = whole.points[3], m = (a + b) * 0.5;
    faces.erase(faces.begin());
    addFace(faces, {{a, m, d}});
    addFace(faces, {{m, b, c, d}});
    EXPECT_TRUE(isClosed(faces));
    EXPECT_NEAR(enclosedVolume(faces), 1, 1e-12);
}

}  // namespace
}  // namespace svt::readers::ifc
