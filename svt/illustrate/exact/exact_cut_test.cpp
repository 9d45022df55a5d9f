/// The arrangement against Clipper, and exact drawings of boxes whose areas are known.

#include <svt/illustrate/exact/body_cells.hpp>
#include <svt/illustrate/exact/boxes_test.hpp>
#include <svt/illustrate/exact/region_sweep.hpp>
#include <svt/illustrate/section_drawing.hpp>

#include <gtest/gtest.h>
#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace svt::illustrate {
namespace {

constexpr std::uint32_t kNothing = 0xFFFFFFFFu;

using Corners = std::vector<DrawingPoint>;

void addRing(const Corners& ring, std::uint32_t claim, std::vector<ClaimSegment>& segments) {
    for (std::size_t n = 0; n < ring.size(); ++n) segments.push_back({ring[n], ring[(n + 1) % ring.size()], claim, 1});
}

std::uint32_t lowestClaim(std::span<const ClaimCount> counts) {
    for (const ClaimCount& count : counts)
        if (count.winding > 0) return count.claim;
    return kNothing;
}

/// Area of each region, by its claim.
std::map<std::uint32_t, double> areasOf(const std::vector<ClaimSegment>& segments, std::int32_t tolerance) {
    const auto arranged = arrangeSegments(segments, tolerance);
    EXPECT_TRUE(arranged);
    std::map<std::uint32_t, double> areas;
    if (!arranged) return areas;
    const auto sides = sweepRegions(*arranged, lowestClaim);
    for (std::size_t e = 0; e < sides.size(); ++e) {
        const ArrangementEdge& edge = arranged->edges[e];
        const double area = 0.5 * (double(edge.from.u) * edge.to.v - double(edge.from.v) * edge.to.u);
        areas[sides[e].left] += area;
        areas[sides[e].right] -= area;
    }
    areas.erase(kNothing);
    return areas;
}

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
    // Each edge is once there, and no region is a sliver.
    EXPECT_EQ(areasOf(segments, 8).size(), 2u);
}

TEST(Arrangement, RandomPolygonsHaveTheAreasOfClipper) {
    std::mt19937 random(11);
    for (int round = 0; round < 20; ++round) {
        std::vector<ClaimSegment> segments;
        std::vector<ClipperLib::Path> paths;
        const std::uint32_t count = 2 + static_cast<std::uint32_t>(round) % 9;
        for (std::uint32_t claim = 0; claim < count; ++claim) {
            Corners ring;
            const double u = double(random() % 1000000), v = double(random() % 1000000);
            const std::size_t corners = 3 + random() % 40;
            for (std::size_t n = 0; n < corners; ++n) {
                const double angle = 6.283185307 * double(n) / double(corners),
                             radius = 1e5 + double(random() % 400000);
                ring.push_back({static_cast<std::int32_t>(u + radius * std::cos(angle)),
                                static_cast<std::int32_t>(v + radius * std::sin(angle))});
            }
            addRing(ring, claim, segments);
            ClipperLib::Path& path = paths.emplace_back();
            for (const DrawingPoint p : ring) path.push_back({p.u, p.v});
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
        Corners ring;
        for (int n = 0; n < 7; ++n)
            ring.push_back({static_cast<std::int32_t>(random() % 300), static_cast<std::int32_t>(random() % 300)});
        addRing(ring, claim, segments);
    }
    const auto arranged = arrangeSegments(segments, 6);
    ASSERT_TRUE(arranged);
    std::map<std::tuple<std::uint32_t, DrawingPoint>, int>
        ends;  // of each claim: what leaves a node minus what arrives
    for (const ArrangementEdge& edge : arranged->edges)
        for (std::uint32_t m = edge.firstMark; m < edge.endMark; ++m) {
            ends[{arranged->marks[m].claim, edge.from}] += arranged->marks[m].winding;
            ends[{arranged->marks[m].claim, edge.to}] -= arranged->marks[m].winding;
        }
    for (const auto& [key, sum] : ends) EXPECT_EQ(sum, 0);
}

constexpr double kTestUnit = 1e-5;

/// Areas (m2) of the bodies in a square of 1 m.
std::map<std::uint32_t, double> bodyAreas(const std::vector<BodyFace>& faces) {
    const Corners square{{0, 0}, {100000, 0}, {100000, 100000}, {0, 100000}};
    std::vector<MaterialEdge> material;
    for (std::size_t n = 0; n < 4; ++n) material.emplace_back(square[n], square[(n + 1) % 4]);
    std::vector<ClaimSegment> segments =
        divideBodies(faces, material, {{kTestUnit, 0, 0}, {0, kTestUnit, 0}}, kTestUnit);
    for (ClaimSegment& body : segments) body.claim += 1;
    // What lies around the material belongs to claim 0.
    addRing({{-9000000, -9000000}, {9000000, -9000000}, {9000000, 9000000}, {-9000000, 9000000}}, 0, segments);
    for (std::size_t n = 0; n < 4; ++n) segments.push_back({square[(n + 1) % 4], square[n], 0, 1});
    std::map<std::uint32_t, double> areas;
    for (const auto& [claim, area] : areasOf(segments, 2))
        if (claim != 0) areas[claim - 1] = area * kTestUnit * kTestUnit;
    return areas;
}

TEST(BodyCells, ACornerOfTwoWallsIsMitred) {
    // Surfaces along the left and the lower side of the material: the border is the diagonal.
    const auto areas = bodyAreas({{{0, 0, -5}, {0, 1, -5}, {0, 1, 5}, 0},
                                  {{0, 0, -5}, {0, 1, 5}, {0, 0, 5}, 0},
                                  {{0, 0, -5}, {1, 0, -5}, {1, 0, 5}, 1},
                                  {{0, 0, -5}, {1, 0, 5}, {0, 0, 5}, 1}});
    EXPECT_NEAR(areas.at(0), 0.5, 2e-4);
    EXPECT_NEAR(areas.at(1), 0.5, 2e-4);
}

TEST(BodyCells, BetweenAWallAndAPostTheBorderIsAParabola) {
    const auto areas = bodyAreas({{{0, -9, -5}, {0, 9, -5}, {0, 9, 5}, 0},
                                  {{0, -9, -5}, {0, 9, 5}, {0, -9, 5}, 0},
                                  {{1, 0.5, -5}, {1, 0.5, 0}, {1, 0.5, 5}, 1}});
    // x = (1 + (y - 1/2)^2) / 2
    EXPECT_NEAR(areas.at(0), 0.5 + 1.0 / 24, 2e-5);
    EXPECT_NEAR(areas.at(1), 0.5 - 1.0 / 24, 2e-5);
}

double areaOf(const SectionDrawing& drawing, std::uint32_t label) {
    for (const SectionComponent& component : drawing.components)
        if (component.label == label) return component.area;
    return 0;
}

TEST(ExactSection, BoxesHaveTheirAreasByPriority) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0.2}, {7.7, 5.7, 2.8});
    boxes.addBox("table", "BuildingFurniture", {1, 1, 0.2}, {2.5, 1.7, 0.9});
    const SectionDrawing plan = boxes.cut({0, 0, 1}, {0, 0, 0.5});
    ASSERT_EQ(plan.components.size(), 3u);
    EXPECT_NEAR(areaOf(plan, 2), 1.5 * 0.7, 2e-5);
    EXPECT_NEAR(areaOf(plan, 1), 7.4 * 5.4 - 1.5 * 0.7, 1e-4);
    EXPECT_NEAR(areaOf(plan, 0), 48 - 7.4 * 5.4, 1e-4);
    for (const SectionComponent& component : plan.components) {
        EXPECT_TRUE(component.isExact);
        EXPECT_LT(component.areaBound, 1e-3);
        ASSERT_EQ(component.polygons.size(), 1u);
        EXPECT_EQ(component.polygons[0].outer.size(), 4u);
    }
    EXPECT_EQ(plan.borders.size(), 3u);
    // An oblique plane: the building's area by its projection.
    const SectionDrawing oblique = boxes.cut({0, 0.6, 0.8}, {4, 3, 1.5});
    EXPECT_NEAR(oblique.area, 8 * (3 / 0.6), 1e-4);
}

TEST(ExactSection, APlaneInFacesDrawsWhatIsKept) {
    Boxes boxes;
    boxes.addBox("lower", "WallSurface", {0, 0, 0}, {4, 4, 2});
    boxes.addBox("upper", "WallSurface", {0, 0, 2}, {3, 3, 4});
    const SectionDrawing below = boxes.cut({0, 0, 1}, {0, 0, 2}), above = boxes.cut({0, 0, -1}, {0, 0, 2});
    EXPECT_GT(below.edgesInPlane, 0u);
    EXPECT_EQ(below.planeShift, 0);
    EXPECT_NEAR(below.area, 16, 1e-4);
    EXPECT_NEAR(areaOf(below, 0), 16, 1e-4);
    EXPECT_NEAR(above.area, 9, 1e-4);
    EXPECT_NEAR(areaOf(above, 1), 9, 1e-4);
    // Nearly in the plane: moved clear of it.
    const SectionDrawing near = boxes.cut({0, 0, 1}, {0, 0, 2.0001});
    EXPECT_GT(near.planeShift, 0);
    EXPECT_NEAR(areaOf(near, 0), 16, 1e-4);
    Diagnostics log;
    reportSection(near, boxes.volume, log);
    EXPECT_EQ(log.count(Severity::Note), 1u);
}

TEST(ExactSection, SheetsAreLinesWhereNothingFinerCoversThem) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addLabel("wall", "WallSurface", volume::Filling::Surface, 0);
    boxes.addQuad({Vec3d{0, 0, 0}, Vec3d{8, 0, 0}, Vec3d{8, 0, 3}, Vec3d{0, 0, 3}});
    boxes.addBox("door", "Door", {2, -0.1, 0}, {3, 0.1, 2});
    const SectionDrawing plan = boxes.cut({0, 0, 1}, {0, 0, 1.03});
    double length = 0;
    for (const SectionComponent& component : plan.components)
        if (component.label == 1) length = component.lineLength;
    EXPECT_NEAR(length, 7, 1e-4);
    EXPECT_EQ(plan.lines.size(), 2u);
    EXPECT_NEAR(areaOf(plan, 0), 48 - 0.1, 1e-4);
    EXPECT_NEAR(areaOf(plan, 1), 0, 0);
}

TEST(ExactSection, DrawingsOfMeshesCanBeRefused) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    SectionOptions options;
    options.useMeshes = false;
    const SectionPlane plane{{0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 1}};
    SectionDrawing drawing = *drawSection(boxes.volume, plane, options);
    EXPECT_TRUE(drawing.components.empty());
    // What was wished for is not told; what did not succeed is, and shells are not blamed for it.
    drawing.components.emplace_back();
    Diagnostics log;
    reportSection(drawing, boxes.volume, log);
    EXPECT_TRUE(log.items().empty());
    drawing.isUnsettled = true;
    reportSection(drawing, boxes.volume, log);
    ASSERT_EQ(log.items().size(), 1u);
    EXPECT_EQ(log.items()[0].code, Code::DrawnByVoxels);
    EXPECT_EQ(log.items()[0].message.find("open"), std::string::npos);
    EXPECT_TRUE(boxes.cut({0, 0, 1}, {0, 0, 1}).isFromMeshes);
}

}  // namespace
}  // namespace svt::illustrate
