#include <svt/mesh/polygons/triangulate.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace svt::mesh {
namespace {

using Points = std::vector<Vec3d>;

Triangulation triangulate(const std::vector<Points>& rings) {
    Points points;
    std::vector<std::uint32_t> ends;
    for (const Points& ring : rings) {
        points.insert(points.end(), ring.begin(), ring.end());
        ends.push_back(static_cast<std::uint32_t>(points.size()));
    }
    return triangulatePolygon(points, ends);
}

// Areas along `normal`: the sum with sign, and the sum without.
struct Areas {
    double net = 0, total = 0;
};

Areas areasOf(const std::vector<Points>& rings, const Triangulation& result, Vec3d normal = {0, 0, 1}) {
    Points points;
    for (const Points& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
    points.insert(points.end(), result.extraPoints.begin(), result.extraPoints.end());
    Areas areas;
    for (const auto& t : result.triangles) {
        const Vec3d twice = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
        areas.net += dot(twice, normal) / 2;
        areas.total += length(twice) / 2;
    }
    return areas;
}

std::set<std::uint32_t> usedPoints(const Triangulation& result) {
    std::set<std::uint32_t> used;
    for (const auto& t : result.triangles) used.insert(t.begin(), t.end());
    return used;
}

const Points kSquare{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};

Points reversed(Points points) {
    std::reverse(points.begin(), points.end());
    return points;
}

TEST(TriangulatePolygon, TriangleIsItself) {
    const auto result = triangulate({{{0, 0, 0}, {3, 0, 1}, {0, 2, 5}}});
    ASSERT_EQ(result.triangles.size(), 1u);
    EXPECT_EQ(result.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_FALSE(result.isZeroArea || result.isSelfTouching || result.hasFailed);
    EXPECT_EQ(result.planeDeviation, 0);
}

TEST(TriangulatePolygon, ConvexQuadIsTwoTriangles) {
    const auto result = triangulate({kSquare});
    EXPECT_EQ(result.triangles.size(), 2u);
    const Areas areas = areasOf({kSquare}, result);
    EXPECT_DOUBLE_EQ(areas.net, 16);
    EXPECT_DOUBLE_EQ(areas.total, 16);
}

TEST(TriangulatePolygon, ConcaveQuadIsNotCutAcrossItsNotch) {
    // An arrow head: the diagonal 0-2 lies outside, and in the second order 1-3 does.
    const Points arrow{{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, 4, 0}};
    for (std::size_t shift = 0; shift < 4; ++shift) {
        Points ring = arrow;
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(shift), ring.end());
        const Areas areas = areasOf({ring}, triangulate({ring}));
        EXPECT_NEAR(areas.net, 6, 1e-12) << shift;
        EXPECT_NEAR(areas.total, 6, 1e-12) << shift;
    }
}

TEST(TriangulatePolygon, TrianglesRunLikeTheExteriorRing) {
    for (const Vec3d normal : {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}}) {
        const Points ring = normal.z > 0 ? Points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}
                                         : Points{{0, 4, 0}, {2, 1, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}};
        const Areas areas = areasOf({ring}, triangulate({ring}), normal);
        EXPECT_NEAR(areas.net, 10, 1e-12);
        EXPECT_NEAR(areas.total, 10, 1e-12);
    }
}

TEST(TriangulatePolygon, HoleOfEitherDirectionIsAHole) {
    const Points hole{{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};
    for (const Points& ring : {hole, reversed(hole)}) {
        const auto result = triangulate({kSquare, ring});
        const Areas areas = areasOf({kSquare, ring}, result);
        EXPECT_NEAR(areas.net, 12, 1e-12);
        EXPECT_NEAR(areas.total, 12, 1e-12);
        EXPECT_EQ(usedPoints(result).size(), 8u);
        EXPECT_FALSE(result.isSelfTouching);
    }
}

TEST(TriangulatePolygon, SeveralHolesInAVerticalWall) {
    // A wall in the plane y = 2 that looks south, with a door at the ground and two windows.
    const auto at = [](double x, double z) { return Vec3d{x, 2, z}; };
    const std::vector<Points> rings{{at(0, 0), at(10, 0), at(10, 3), at(0, 3)},
                                    {at(1, 1), at(2, 1), at(2, 2), at(1, 2)},
                                    {at(4, 1), at(4, 2), at(6, 2), at(6, 1)},
                                    {at(7, 0.1), at(8, 0.1), at(8, 2.1), at(7, 2.1)}};
    const Areas areas = areasOf(rings, triangulate(rings), {0, -1, 0});
    EXPECT_NEAR(areas.net, 30 - 1 - 2 - 2, 1e-12);
    EXPECT_NEAR(areas.total, areas.net, 1e-12);
}

TEST(TriangulatePolygon, PointsOnStraightEdgesAreKept) {
    const std::vector<Points> rings{
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 1, 0}, {4, 4, 0}, {3, 4, 0}, {0, 4, 0}, {0, 2, 0}},
        {{1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}}};
    const auto result = triangulate(rings);
    EXPECT_EQ(usedPoints(result).size(), 14u);
    // Every edge of the rings is the edge of exactly one triangle; the others have two.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : result.triangles)
        for (std::size_t c = 0; c < 3; ++c) ++uses[{t[c], t[(c + 1) % 3]}];
    for (std::uint32_t i = 0; i < 9; ++i) EXPECT_EQ((uses[{i, (i + 1) % 9}]), 1) << i;
    for (const auto& [edge, count] : uses) EXPECT_EQ(count, 1);
    EXPECT_NEAR(areasOf(rings, result).total, 12, 1e-12);
}

TEST(TriangulatePolygon, QuadWithAStraightCornerKeepsIt) {
    for (std::size_t shift = 0; shift < 4; ++shift) {
        Points ring{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 3, 0}};
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(shift), ring.end());
        const auto result = triangulate({ring});
        EXPECT_EQ(usedPoints(result).size(), 4u) << shift;
        EXPECT_NEAR(areasOf({ring}, result).total, 6, 1e-12) << shift;
    }
}

TEST(TriangulatePolygon, DeviationFromThePlaneIsMeasured) {
    // One corner is 0.4 m high: the mean plane halves that between the two diagonals.
    const auto bent = triangulate({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0.4}, {0, 4, 0}}});
    EXPECT_NEAR(bent.planeDeviation, 0.1, 1e-3);
    EXPECT_EQ(bent.triangles.size(), 2u);
    const auto flat = triangulate({{{0, 0, 0}, {4, 0, 4}, {4, 4, 4}, {0, 4, 0}}});
    EXPECT_NEAR(flat.planeDeviation, 0, 1e-12);
}

TEST(TriangulatePolygon, DeviationOfAHoleCounts) {
    const auto result = triangulate({kSquare, {{1, 1, 0.5}, {1, 3, 0.5}, {3, 3, 0.5}, {3, 1, 0.5}}});
    EXPECT_GT(result.planeDeviation, 0.2);
}

TEST(TriangulatePolygon, WorldCoordinatesLoseNothing) {
    const Vec3d world{458877, 5438353, 111};
    std::vector<Points> rings{kSquare, {{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}}};
    for (Points& ring : rings)
        for (Vec3d& point : ring) point = point + world;
    const auto result = triangulate(rings);
    EXPECT_NEAR(areasOf(rings, result).total, 12, 1e-9);
    EXPECT_NEAR(result.planeDeviation, 0, 1e-9);
}

TEST(TriangulatePolygon, NoAreaGivesNothingButATriangleIsKept) {
    const auto line = triangulate({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}});
    EXPECT_TRUE(line.isZeroArea);
    EXPECT_TRUE(line.triangles.empty());
    const auto sliver = triangulate({{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}});
    EXPECT_TRUE(sliver.isZeroArea);
    EXPECT_EQ(sliver.triangles.size(), 1u);
    const auto point = triangulate({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}});
    EXPECT_TRUE(point.isZeroArea);
    EXPECT_TRUE(point.triangles.empty());
}

TEST(TriangulatePolygon, TooFewPointsGiveNothing) {
    EXPECT_TRUE(triangulate({}).triangles.empty());
    EXPECT_TRUE(triangulate({}).isZeroArea);
    EXPECT_TRUE(triangulate({{{0, 0, 0}, {1, 0, 0}}}).isZeroArea);
    // A hole of two points is ignored.
    const auto result = triangulate({kSquare, {{1, 1, 0}, {2, 2, 0}}});
    EXPECT_NEAR(areasOf({kSquare, {{1, 1, 0}, {2, 2, 0}}}, result).total, 16, 1e-12);
}

TEST(TriangulatePolygon, RingThatCrossesItselfStillGetsItsLobes) {
    // A bow tie with lobes of 4 and 1 m2 that meet in (2, 0).
    const Points bow{{0, -2, 0}, {3, 1, 0}, {3, -1, 0}, {0, 2, 0}};
    const auto result = triangulate({bow});
    EXPECT_TRUE(result.isSelfTouching);
    ASSERT_EQ(result.extraPoints.size(), 1u);
    EXPECT_NEAR(length(result.extraPoints[0] - Vec3d{2, 0, 0}), 0, 1e-6);
    EXPECT_NEAR(areasOf({bow}, result).total, 5, 1e-6);
    EXPECT_FALSE(result.hasFailed);
}

TEST(TriangulatePolygon, HoleThatTouchesTheExteriorSharesItsPoint) {
    const std::vector<Points> rings{kSquare, {{0, 0, 0}, {2, 1, 0}, {1, 2, 0}}};
    const auto result = triangulate(rings);
    EXPECT_TRUE(result.isSelfTouching);
    EXPECT_TRUE(result.extraPoints.empty());
    EXPECT_NEAR(areasOf(rings, result).total, 16 - 1.5, 1e-9);
}

TEST(TriangulatePolygon, AreaOfRandomStarsWithHolesIsExact) {
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int n = 0; n < 200; ++n) {
        const int corners = 5 + int(uniform(random) * 40), holeCorners = 3 + int(uniform(random) * 10);
        Points star, hole;
        for (int c = 0; c < corners; ++c) {
            const double angle = 2 * std::numbers::pi * c / corners, radius = 3 + 7 * uniform(random);
            star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        }
        // Within the inner radius of the star: 3 cos(pi / 5) > 2.4.
        for (int c = 0; c < holeCorners; ++c) {
            const double angle = 2 * std::numbers::pi * c / holeCorners, radius = 0.5 + 1.8 * uniform(random);
            hole.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        }
        const double expected = length(newellNormal(star)) / 2 - length(newellNormal(hole)) / 2;
        if (n % 2 == 1) hole = reversed(hole);
        // Laid into an oblique plane.
        const Vec3d u = normalized(Vec3d{1, 0.3, 0.7}), normal = normalized(cross(u, Vec3d{-0.2, 1, 0.4})),
                    v = cross(normal, u);
        std::vector<Points> rings{star, hole};
        for (Points& ring : rings)
            for (Vec3d& point : ring) point = u * point.x + v * point.y + Vec3d{50, -20, 7};
        const auto result = triangulate(rings);
        const Areas areas = areasOf(rings, result, normal);
        ASSERT_NEAR(areas.net, expected, 1e-9 * expected) << n;
        ASSERT_NEAR(areas.total, expected, 1e-9 * expected) << n;
        ASSERT_EQ(usedPoints(result).size(), star.size() + hole.size()) << n;
        ASSERT_FALSE(result.isSelfTouching) << n;
    }
}

TEST(NewellNormal, IsTwiceTheAreaVector) {
    EXPECT_EQ(newellNormal(kSquare), (Vec3d{0, 0, 32}));
    EXPECT_EQ(newellNormal(reversed(kSquare)), (Vec3d{0, 0, -32}));
    EXPECT_EQ(newellNormal({}), Vec3d{});
}

}  // namespace
}  // namespace svt::mesh
