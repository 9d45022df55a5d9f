#include <svt/mesh/polygons/triangulate.hpp>
#include <svt/mesh/processor_time_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace svt::mesh {
namespace {

using Points = std::vector<Vec3d>;

Triangulation triangulate(const std::vector<Points>& rings, TriangulateBy by = TriangulateBy::PointCount) {
    Points points;
    std::vector<std::uint32_t> ends;
    for (const Points& ring : rings) {
        points.insert(points.end(), ring.begin(), ring.end());
        ends.push_back(static_cast<std::uint32_t>(points.size()));
    }
    return triangulatePolygon(points, ends, by);
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

// Polygons of many points, which the sweep does.
class LargePolygon : public ::testing::Test {
protected:
    // Seconds of processor time: about 0.1, a minute and more by GLU.
    static constexpr double kSeconds = 30;

    // Expects triangles that run like the exterior ring, have area, fit each other, and add up to `area`.
    static Triangulation expectArea(const std::vector<Points>& rings, double area, Vec3d normal = {0, 0, 1}) {
        const test::ProcessorTime time;
        Triangulation result = triangulate(rings);
        EXPECT_LT(time.seconds(), kSeconds);
        EXPECT_FALSE(result.hasFailed);
        const Areas areas = areasOf(rings, result, normal);
        EXPECT_NEAR(areas.net, area, 1e-9 * area);
        EXPECT_NEAR(areas.total, area, 1e-9 * area);
        expectFitting(result);
        return result;
    }

    // No edge has two triangles on the same side.
    static void expectFitting(const Triangulation& result) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> uses;
        for (const auto& t : result.triangles)
            for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(uses.insert({t[c], t[(c + 1) % 3]}).second);
    }

    static Points circle(std::size_t count, double radius, Vec3d center = {}) {
        Points ring;
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * double(i) / double(count);
            ring.push_back(center + Vec3d{radius * std::cos(angle), radius * std::sin(angle), 0});
        }
        return ring;
    }
};

TEST_F(LargePolygon, StarOfThinSpikes) {
    // All spikes are open at once for a line that sweeps over the middle.
    Points star = circle(100'000, 10);
    for (std::size_t i = 1; i < star.size(); i += 2) star[i] = star[i] * 0.3;
    const auto result = expectArea({star}, length(newellNormal(star)) / 2);
    EXPECT_EQ(result.triangles.size(), star.size() - 2);
    EXPECT_EQ(usedPoints(result).size(), star.size());
    EXPECT_FALSE(result.isSelfTouching);
}

TEST_F(LargePolygon, Comb) {
    Points comb;
    for (int i = 0; i < 50'000; ++i) {
        comb.push_back({double(i), 0, 0});
        comb.push_back({i + 0.5, 10, 0});
    }
    comb.push_back({50'000, -1, 0});
    comb.push_back({0, -1, 0});
    expectArea({reversed(comb)}, length(newellNormal(comb)) / 2);
}

TEST_F(LargePolygon, SpiralInAnObliquePlane) {
    // Two turns' distance apart: a wall of 0.4 m that winds fifty times.
    const Vec3d u = normalized(Vec3d{1, 0.3, 0.7}), normal = normalized(cross(u, Vec3d{-0.2, 1, 0.4})),
                v = cross(normal, u);
    const auto at = [&](double angle, double offset) {
        const double radius = 1 + angle / (2 * std::numbers::pi) + offset;
        return u * (radius * std::cos(angle)) + v * (radius * std::sin(angle));
    };
    Points spiral;
    constexpr int kCount = 10'000;
    for (int i = 0; i < kCount; ++i) spiral.push_back(at(100 * std::numbers::pi * i / kCount, 0.4));
    for (int i = kCount; i-- > 0;) spiral.push_back(at(100 * std::numbers::pi * i / kCount, 0));
    const auto result = expectArea({spiral}, length(newellNormal(spiral)) / 2, normal);
    EXPECT_EQ(usedPoints(result).size(), spiral.size());
}

TEST_F(LargePolygon, ManyHolesOfEitherDirection) {
    constexpr int kSide = 142;  // 20,164 holes
    std::vector<Points> rings{{{0, 0, 0}, {kSide, 0, 0}, {kSide, kSide, 0}, {0, kSide, 0}}};
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const double x = i + 0.25, y = j + 0.25;
            rings.push_back({{x, y, 0}, {x, y + 0.5, 0}, {x + 0.5, y + 0.5, 0}, {x + 0.5, y, 0}});
            if ((i + j) % 2 == 1) rings.back() = reversed(rings.back());
        }
    const auto result = expectArea(rings, 0.75 * kSide * kSide);
    EXPECT_EQ(usedPoints(result).size(), 4u + 4u * kSide * kSide);
    EXPECT_FALSE(result.isSelfTouching);
}

TEST_F(LargePolygon, ChessboardOfHolesThatTouchAtCorners) {
    constexpr int kSide = 40;
    std::vector<Points> rings{{{0, 0, 0}, {kSide, 0, 0}, {kSide, kSide, 0}, {0, kSide, 0}}};
    for (int i = 0; i < kSide; ++i)
        for (int j = (i % 2); j < kSide; j += 2)
            rings.push_back(
                {{double(i), double(j), 0}, {double(i), j + 1.0, 0}, {i + 1.0, j + 1.0, 0}, {i + 1.0, double(j), 0}});
    const auto result = expectArea(rings, kSide * kSide / 2.0);
    EXPECT_TRUE(result.isSelfTouching);
    EXPECT_TRUE(result.extraPoints.empty());
}

TEST_F(LargePolygon, PointsOnStraightEdgesAreKept) {
    Points ring;
    constexpr int kCount = 5'000;
    for (int i = 0; i < kCount; ++i) ring.push_back({double(i), 0, 0});
    for (int i = 0; i < kCount; ++i) ring.push_back({kCount, double(i), 0});
    for (int i = 0; i < kCount; ++i) ring.push_back({double(kCount - i), kCount, 0});
    for (int i = 0; i < kCount; ++i) ring.push_back({0, double(kCount - i), 0});
    const auto result = expectArea({ring}, double(kCount) * kCount);
    EXPECT_EQ(usedPoints(result).size(), ring.size());
    EXPECT_EQ(result.triangles.size(), ring.size() - 2);
    Points points = ring;
    for (const auto& t : result.triangles)
        ASSERT_GT(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z, 0);
}

TEST_F(LargePolygon, DoubledPointsAndSpikesChangeNothing) {
    Points ring;
    for (const Vec3d& point : circle(1'000, 10)) {
        ring.push_back(point);
        ring.push_back(point);
        ring.push_back(point * 1.5);  // out and back
        ring.push_back(point);
    }
    const double area = length(newellNormal(circle(1'000, 10))) / 2;
    const auto result = expectArea({ring}, area);
    EXPECT_EQ(usedPoints(result).size(), 1'000u);
    EXPECT_TRUE(result.isSelfTouching);
}

TEST_F(LargePolygon, CombThatAnEdgeCrossesGetsAPointAtEachTooth) {
    Points comb;
    constexpr int kTeeth = 5'000;
    for (int i = 0; i < kTeeth; ++i) {
        comb.push_back({double(i), -5, 0});
        comb.push_back({i + 0.5, 10, 0});
    }
    comb.push_back({kTeeth, 0, 0});
    comb.push_back({-1, 0, 0});
    const auto result = triangulate({comb});
    EXPECT_FALSE(result.hasFailed);
    EXPECT_TRUE(result.isSelfTouching);
    EXPECT_EQ(result.extraPoints.size(), 2u * kTeeth - 1);  // the last edge begins on the line
    for (const Vec3d& point : result.extraPoints) ASSERT_NEAR(point.y, 0, 1e-8);
    expectFitting(result);
    // Triangles 2/3 m wide and 10 m high over the line, 1/3 m wide and 5 m high below it; the last one over it is 5/6 m
    // wide, the first one below it 7/6 m.
    const double area = (kTeeth - 1) * (10.0 / 3 + 5.0 / 6) + 25.0 / 6 + 35.0 / 12;
    EXPECT_NEAR(areasOf({comb}, result).total, area, 1e-6 * area);
}

TEST_F(LargePolygon, RingThatCrossesItselfTooOftenIsRefusedAtOnce) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 10);
    for (const std::size_t count : {100u, 2'000u, 100'000u}) {
        Points ring;
        for (std::size_t i = 0; i < count; ++i) ring.push_back({uniform(random), uniform(random), 0});
        const test::ProcessorTime time;
        const auto result = triangulate({ring});
        EXPECT_LT(time.seconds(), kSeconds);
        EXPECT_TRUE(result.hasFailed && result.crossesTooOften && result.isSelfTouching) << count;
        EXPECT_TRUE(result.triangles.empty() && result.extraPoints.empty()) << count;
    }
}

TEST_F(LargePolygon, AnyLengthAndPlaceIsFineEnough) {
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double shift : {0.0, 1e3}) {
            Points ring = circle(1'000, scale, Vec3d{shift, -shift, shift} * scale);
            expectArea({ring}, length(newellNormal(ring)) / 2);
        }
}

// What rings in the plane z = 0 enclose by the odd rule: between two neighbouring places where edges end or cross no edge
// ends or crosses, so the area of each strip follows from the heights of the edges in its middle.
double oddArea(const std::vector<Points>& rings) {
    std::vector<std::pair<Vec3d, Vec3d>> edges;
    for (const Points& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
    std::vector<double> places;
    for (const auto& [a, b] : edges) {
        places.push_back(a.x);
        for (const auto& [c, d] : edges) {
            const double whole = cross(b - a, d - c).z;
            if (whole != 0) places.push_back(a.x + (b.x - a.x) * (cross(c - a, d - c).z / whole));
        }
    }
    std::sort(places.begin(), places.end());
    double area = 0;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        const double middle = (places[i] + places[i + 1]) / 2;
        std::vector<double> heights;
        for (const auto& [a, b] : edges)
            if (std::min(a.x, b.x) < middle && middle < std::max(a.x, b.x))
                heights.push_back(a.y + (b.y - a.y) * ((middle - a.x) / (b.x - a.x)));
        std::sort(heights.begin(), heights.end());
        for (std::size_t h = 0; h + 1 < heights.size(); h += 2)
            area += (heights[h + 1] - heights[h]) * (places[i + 1] - places[i]);
    }
    return area;
}

// Rings on a coarse grid touch, overlap and cross all the time.
TEST(TriangulateBySweep, RandomRingsHaveTheirAreaAsByGlu) {
    std::mt19937_64 random(3);
    const auto number = [&](std::uint64_t count) { return random() % count; };
    const auto ringOf = [&](std::size_t count, std::uint64_t size) {
        Points ring;
        for (std::size_t i = 0; i < count; ++i) ring.push_back({double(number(size)), double(number(size)), 0});
        return ring;
    };
    std::size_t compared = 0;
    for (int n = 0; n < 4'000; ++n) {
        const std::uint64_t size = 3 + number(30);
        std::vector<Points> rings{ringOf(4 + number(25), size)};
        for (std::uint64_t hole = number(3); hole > 0; --hole) rings.push_back(ringOf(3 + number(6), size));
        const auto glu = triangulate(rings, TriangulateBy::Glu), sweep = triangulate(rings, TriangulateBy::Sweep);
        if (sweep.crossesTooOften || glu.hasFailed || glu.isZeroArea) continue;
        ++compared;
        const Vec3d normal = normalized(newellNormal(rings[0]));
        const Areas found = areasOf(rings, sweep, normal);
        const double expected = oddArea(rings);
        ASSERT_NEAR(found.net, expected, 1e-9 * (1 + expected)) << n;
        ASSERT_NEAR(found.total, expected, 1e-9 * (1 + expected)) << n;
        // GLU has crossings with the precision of a float.
        ASSERT_NEAR(areasOf(rings, glu, normal).total, expected, 1e-2 * (1 + expected)) << n;
        if (glu.isSelfTouching) {
            ASSERT_TRUE(sweep.isSelfTouching) << n;
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> uses;
        for (const auto& t : sweep.triangles)
            for (std::size_t c = 0; c < 3; ++c) ASSERT_TRUE(uses.insert({t[c], t[(c + 1) % 3]}).second) << n;
    }
    EXPECT_GT(compared, 2'000u);
}

TEST(NewellNormal, IsTwiceTheAreaVector) {
    EXPECT_EQ(newellNormal(kSquare), (Vec3d{0, 0, 32}));
    EXPECT_EQ(newellNormal(reversed(kSquare)), (Vec3d{0, 0, -32}));
    EXPECT_EQ(newellNormal({}), Vec3d{});
}

}  // namespace
}  // namespace svt::mesh
