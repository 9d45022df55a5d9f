/// The arrangement against Clipper.

#include <svt/plane/region_areas_test.hpp>

#include <polyclipping/clipper.hpp>

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
    std::map<std::tuple<std::uint32_t, Point>, int> ends;  // of each claim: leaving minus arriving windings
    for (const ArrangementEdge& edge : arranged->edges)
        for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m) {
            ends[{arranged->marks[m].claim, edge.from}] += arranged->marks[m].winding;
            ends[{arranged->marks[m].claim, edge.to}] -= arranged->marks[m].winding;
        }
    for (const auto& [key, sum] : ends) EXPECT_EQ(sum, 0);
}

}  // namespace
}  // namespace svt::plane
