/// The arrangement against Clipper.

#include <svt/plane/region_areas_test.hpp>

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace svt::plane {
namespace {

TEST(Arrangement, OverlappingSquaresBelongToTheFirst) {
    std::vector<ClaimSegment> segments;
    addRing({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, 0, segments);
    addRing({{50, 50}, {150, 50}, {150, 150}, {50, 150}}, 1, segments);
    const auto areas = areasOf(segments, 2);
    EXPECT_EQ(areas, (std::map<std::uint32_t, double>{{0, 10000}, {1, 7500}}));
}

TEST(Arrangement, RingsOfOneClaimAddUp) {
    std::vector<ClaimSegment> segments;
    addRing({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, 0, segments);
    addRing({{50, 50}, {150, 50}, {150, 150}, {50, 150}}, 0, segments);
    addRing({{-50, -50}, {200, -50}, {200, 200}, {-50, 200}}, 1, segments);
    addRing({{10, 10}, {10, 20}, {20, 20}, {20, 10}}, 0, segments);  // a hole
    const auto areas = areasOf(segments, 2);
    EXPECT_EQ(areas, (std::map<std::uint32_t, double>{{0, 17400}, {1, 62500 - 17400}}));
}

TEST(Arrangement, BordersThatNearlyMeetAreOne) {
    std::vector<ClaimSegment> segments;
    addRing({{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}, 0, segments);
    // The common border has other points, and lies off by 3.
    addRing({{1003, -200}, {2000, -200}, {2000, 700}, {998, 700}, {1002, 300}}, 1, segments);
    const auto arranged = arrangeSegments(segments, 8);
    ASSERT_TRUE(arranged);
    const auto sides = sweepRegions(*arranged, lowestClaim);
    int shared = 0;
    for (const EdgeSides& side : sides)
        if (side.left != kNothing && side.right != kNothing) ++shared;
    // From (1000, 0) over (1002, 300) and the crossing at (1000, 500) to (998, 700).
    EXPECT_EQ(shared, 3);
    // No region is a sliver.
    EXPECT_EQ(areasOf(segments, 8).size(), 2u);
}

TEST(Arrangement, LinesAreCutAndHaveNoInside) {
    std::vector<ClaimSegment> segments;
    addRing({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, 0, segments);
    segments.push_back({{50, -50}, {50, 150}, 1, 0});
    const auto arranged = arrangeSegments(segments, 2);
    ASSERT_TRUE(arranged);
    std::vector<std::pair<Point, Point>> parts;
    for (const ArrangementEdge& edge : arranged->edges)
        for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m) {
            EXPECT_EQ(arranged->marks[m].winding == 0, arranged->marks[m].claim == 1);
            if (arranged->marks[m].claim == 1) parts.emplace_back(edge.from, edge.to);
        }
    EXPECT_EQ(parts, (std::vector<std::pair<Point, Point>>{
                         {{50, -50}, {50, 0}}, {{50, 0}, {50, 100}}, {{50, 100}, {50, 150}}}));
    EXPECT_EQ(areasOf(segments, 2), (std::map<std::uint32_t, double>{{0, 10000}}));
}

TEST(Arrangement, RandomPolygonsHaveTheAreasOfClipper) {
    std::mt19937 random(11);
    for (int round = 0; round < 20; ++round) {
        std::vector<ClaimSegment> segments;
        std::vector<ClipperLib::Path> paths;
        const std::uint32_t count = 2 + static_cast<std::uint32_t>(round) % 9;
        for (std::uint32_t claim = 0; claim < count; ++claim) {
            TestRing ring;
            const double u = double(random() % 1000000), v = double(random() % 1000000);
            const std::size_t corners = 3 + random() % 40;
            for (std::size_t n = 0; n < corners; ++n) {
                const double angle = 6.283185307 * double(n) / double(corners),
                             radius = 1e5 + double(random() % 400000);
                ring.push_back({static_cast<std::int64_t>(u + radius * std::cos(angle)),
                                static_cast<std::int64_t>(v + radius * std::sin(angle))});
            }
            addRing(ring, claim, segments);
            ClipperLib::Path& path = paths.emplace_back();
            for (const Point p : ring) path.push_back({p.u, p.v});
        }
        const auto areas = areasOf(segments, 2);
        for (std::uint32_t claim = 0; claim < count; ++claim) {
            ClipperLib::Clipper clipper;
            clipper.AddPath(paths[claim], ClipperLib::ptSubject, true);
            for (std::uint32_t other = 0; other < claim; ++other)
                clipper.AddPath(paths[other], ClipperLib::ptClip, true);
            ClipperLib::Paths rest;
            clipper.Execute(ClipperLib::ctDifference, rest, ClipperLib::pftPositive, ClipperLib::pftPositive);
            double expected = 0;
            for (const ClipperLib::Path& path : rest) expected += ClipperLib::Area(path);
            const auto found = areas.find(claim);
            // Crossings are rounded: an edge of 1e6 by a few units.
            EXPECT_NEAR(found == areas.end() ? 0 : found->second, expected, 2e7) << round << " " << claim;
        }
    }
}

// The number of points of claims where other windings leave than arrive.
int openEnds(const Arrangement& arranged) {
    std::map<std::tuple<std::uint32_t, Point>, int> ends;
    for (const ArrangementEdge& edge : arranged.edges)
        for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m) {
            ends[{arranged.marks[m].claim, edge.from}] += arranged.marks[m].winding;
            ends[{arranged.marks[m].claim, edge.to}] -= arranged.marks[m].winding;
        }
    return static_cast<int>(std::ranges::count_if(ends, [](const auto& end) { return end.second != 0; }));
}

TEST(Arrangement, ClosedRingsStayClosedWhateverMeets) {
    std::mt19937 random(5);
    // Many short edges in few places: everything is within the tolerance of something.
    std::vector<ClaimSegment> segments;
    for (std::uint32_t claim = 0; claim < 25; ++claim) {
        TestRing ring;
        for (int n = 0; n < 7; ++n)
            ring.push_back({static_cast<std::int64_t>(random() % 300), static_cast<std::int64_t>(random() % 300)});
        addRing(ring, claim, segments);
    }
    const auto arranged = arrangeSegments(segments, 6);
    ASSERT_TRUE(arranged);
    EXPECT_EQ(openEnds(*arranged), 0);
}

// Rings of one claim whose corners are a few points, and points within the tolerance of them.
std::vector<ClaimSegment> ringsOfNearPoints(std::mt19937& random, std::int64_t tolerance) {
    const auto below = [&](std::int64_t count) { return static_cast<std::int64_t>(random() % std::uint32_t(count)); };
    std::vector<Point> points;
    const std::int64_t extent = 50 + below(4000);
    for (std::int64_t n = 3 + below(40); n > 0; --n) {
        const std::int64_t u = below(extent);
        points.push_back({u, below(extent)});
    }
    for (std::int64_t n = below(60); n > 0; --n) {
        const Point p = points[static_cast<std::size_t>(below(static_cast<std::int64_t>(points.size())))];
        const std::int64_t u = p.u + below(2 * tolerance + 1) - tolerance;
        points.push_back({u, p.v + below(2 * tolerance + 1) - tolerance});
    }
    std::vector<ClaimSegment> segments;
    for (std::int64_t rings = 1 + below(20); rings > 0; --rings) {
        TestRing ring;
        for (std::int64_t n = 3 + below(5); n > 0; --n)
            ring.push_back(points[static_cast<std::size_t>(below(static_cast<std::int64_t>(points.size())))]);
        addRing(ring, 0, segments);
    }
    return segments;
}

TEST(Arrangement, APointHasOneNodeInAllItsSegments) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto tolerance = static_cast<std::int32_t>(2 + random() % 12);
        const auto segments = ringsOfNearPoints(random, tolerance);
        const auto arranged = arrangeSegments(segments, tolerance);
        ASSERT_TRUE(arranged) << seed;
        EXPECT_EQ(openEnds(*arranged), 0) << seed;
        double before = 0, after = 0, length = 0;
        for (const ClaimSegment& s : segments) {
            before += static_cast<double>(cross(s.from, s.to)) / 2;
            length += std::hypot(double(s.to.u - s.from.u), double(s.to.v - s.from.v));
        }
        for (const ArrangementEdge& edge : arranged->edges)
            after += arranged->marks[edge.firstMark].winding * static_cast<double>(cross(edge.from, edge.to)) / 2;
        EXPECT_LE(std::abs(after - before), 2 * tolerance * length) << seed;
        for (std::size_t i = 0; i < arranged->edges.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const ArrangementEdge &a = arranged->edges[i], &b = arranged->edges[j];
                EXPECT_NE(meet(a.from, a.to, b.from, b.to), Meeting::Cross) << seed;
            }
    }
}

// Each crossing moves long edges by less than the tolerance, so that they cross again next to it: over 40 rounds.
TEST(Arrangement, SettlesWhereLongEdgesCrossAtSmallAngles) {
    const auto settles = [](const std::vector<ClaimSegment>& segments, std::int32_t tolerance) {
        const auto arranged = arrangeSegments(segments, tolerance);
        return arranged && !arranged->edges.empty();
    };
    EXPECT_TRUE(settles(
        {{{2606, 1922}, {929, 1095}, 0, 1}, {{2607, 1923}, {1320, 1395}, 0, 1}, {{2609, 1923}, {1320, 1395}, 0, 1}},
        2));
    EXPECT_TRUE(settles(
        {{{1346, 1812}, {866, 1617}, 0, 1}, {{866, 1617}, {1463, 1839}, 0, 1}, {{1462, 1840}, {863, 1616}, 0, 1}}, 3));
}

}  // namespace
}  // namespace svt::plane
