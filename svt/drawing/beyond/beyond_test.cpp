/// Lines beyond the cut of boxes whose visible parts are known.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

namespace svt::drawing {
namespace {

/// The lines behind a plane, seen along y: u is x, v is z, of the grid's lower corner.
SectionDrawing drawBeyond(const Boxes& boxes, Vec3d normal, Vec3d point, BeyondOptions beyond = {.visible = true},
                          int threads = 1, std::vector<std::string> hide = {}) {
    SectionOptions options;
    options.beyond = beyond;
    options.threads = threads;
    options.hide = std::move(hide);
    return *drawSection(boxes.volume, {normalized(normal), boxes.volume.grid.origin() + point}, options);
}
SectionDrawing fromSouth(const Boxes& boxes, double y, BeyondOptions beyond = {.visible = true}) {
    return drawBeyond(boxes, {0, -1, 0}, {0, y, 0}, beyond);
}

/// Lines of a kind in millimetres: from, to, in the order of places.
using Lines = std::set<std::tuple<long, long, long, long>>;
Lines linesOf(const SectionDrawing& drawing, BeyondKind kind = BeyondKind::Visible) {
    Lines lines;
    const auto mm = [](double metres) { return std::lround(metres * 1000); };
    for (const BeyondLine& line : drawing.beyond)
        if (line.kind == kind) {
            auto from = std::tuple(mm(line.from.u), mm(line.from.v)), to = std::tuple(mm(line.to.u), mm(line.to.v));
            if (to < from) std::swap(from, to);
            lines.insert(std::tuple_cat(from, to));
        }
    return lines;
}

Lines rectangle(long u, long v, long right, long top) {
    return {{u, v, right, v}, {u, top, right, top}, {u, v, u, top}, {right, v, right, top}};
}
Lines operator+(Lines a, const Lines& b) {
    a.insert(b.begin(), b.end());
    return a;
}

//      +----+
//   +--| A  |-----+      B stands behind A; both on the ground
//   |B |    |     |
//   +--+----+-----+
TEST(LinesBeyond, ABoxHidesWhatIsBehindIt) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 1, 0}, {4, 2, 2});
    boxes.addBox("B", "BuildingInstallation", {0, 3, 0}, {6, 4, 1});
    const SectionDrawing drawing = fromSouth(boxes, 0.5, {.visible = true, .hidden = true});
    EXPECT_TRUE(drawing.components.empty());
    EXPECT_EQ(linesOf(drawing), (rectangle(2000, 0, 4000, 2000) + Lines{{0, 0, 0, 1000},
                                                                        {6000, 0, 6000, 1000},
                                                                        {0, 1000, 2000, 1000},
                                                                        {4000, 1000, 6000, 1000},
                                                                        {0, 0, 2000, 0},
                                                                        {4000, 0, 6000, 0}}));
    // The back of each box lies behind its front.
    EXPECT_EQ(linesOf(drawing, BeyondKind::Hidden), (Lines{{2000, 1000, 4000, 1000}}));
}

// From behind, only the part of A above B is visible.
TEST(LinesBeyond, TheOtherSideIsSeenTheOtherWayRound) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 1, 0}, {4, 2, 2});
    boxes.addBox("B", "BuildingInstallation", {0, 3, 0}, {6, 4, 1});
    // u points to the west.
    EXPECT_EQ(linesOf(drawBeyond(boxes, {0, 1, 0}, {0, 5, 0})),
              (rectangle(-6000, 0, 0, 1000) +
               Lines{{-4000, 1000, -4000, 2000}, {-2000, 1000, -2000, 2000}, {-4000, 2000, -2000, 2000}}));
}

//   +---------------+
//   |   +-------+   |     a wall of four blocks around a hole: its joints are not drawn;
//   |   | --+   |   |     the hole shows a part of the box behind
//   |   |   |   |   |
//   |   +-------+   |
//   +---------------+
TEST(LinesBeyond, AHoleLetsEdgesThroughAndBlocksOfOneWallHaveNoJoints) {
    Boxes boxes;
    boxes.addBox("left", "WallSurface", {0, 1, 0}, {1, 1.3, 3});
    boxes.addBox("right", "WallSurface", {3, 1, 0}, {4, 1.3, 3});
    boxes.addBox("below", "WallSurface", {1, 1, 0}, {3, 1.3, 1});
    boxes.addBox("above", "WallSurface", {1, 1, 2}, {3, 1.3, 3});
    boxes.addBox("table", "BuildingFurniture", {0.2, 2, 0.2}, {2, 3, 1.5});
    // Lines are joined within an object.
    const Lines outside{{0, 0, 1000, 0},          {1000, 0, 3000, 0},       {3000, 0, 4000, 0}, {0, 3000, 1000, 3000},
                        {1000, 3000, 3000, 3000}, {3000, 3000, 4000, 3000}, {0, 0, 0, 3000},    {4000, 0, 4000, 3000}};
    const Lines inside{
        {1000, 1000, 3000, 1000}, {1000, 2000, 3000, 2000}, {1000, 1500, 2000, 1500}, {2000, 1000, 2000, 1500}};
    EXPECT_EQ(linesOf(fromSouth(boxes, 0.5)),
              (outside + inside + Lines{{1000, 1000, 1000, 2000}, {3000, 1000, 3000, 2000}}));
    // A block of another kind shows its joints.
    boxes.volume.labels.labels[2].className = "RoofSurface";
    EXPECT_EQ(linesOf(fromSouth(boxes, 0.5)), (outside + inside + Lines{{1000, 0, 1000, 2000}, {3000, 0, 3000, 2000}}));
}

TEST(LinesBeyond, WhatIsCutHidesWhatIsBehindItAndKeepsItsBorders) {
    Boxes boxes;
    boxes.addBox("A", "WallSurface", {2, 0, 0}, {4, 2, 2});
    boxes.addBox("B", "BuildingInstallation", {0, 3, 0}, {6, 4, 1});
    const SectionDrawing drawing = fromSouth(boxes, 1);
    ASSERT_EQ(drawing.components.size(), 1u);
    EXPECT_EQ(linesOf(drawing), (Lines{{0, 0, 0, 1000},
                                       {6000, 0, 6000, 1000},
                                       {0, 1000, 2000, 1000},
                                       {4000, 1000, 6000, 1000},
                                       {0, 0, 2000, 0},
                                       {4000, 0, 6000, 0}}));
}

// A building of one piece with a room in it: the room's shell is seen from within, and hides what is outside.
TEST(LinesBeyond, ARoomInABuildingShowsItsWallsAndWhatStandsInIt) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addBox("room", "BuildingRoom", {1, 1, 0.5}, {7, 5, 2.5});
    boxes.addBox("table", "BuildingFurniture", {2, 3, 0.5}, {3, 4, 1.5});
    boxes.addBox("outside", "BuildingInstallation", {4, 7, 1}, {5, 8, 4});
    for (std::uint32_t l = 1; l < 3; ++l) boxes.volume.labels.labels[l].parent = 0;
    boxes.volume.labels.labels[0].subtreeEnd = 3;
    // The back of the room lies on the border of the cut; the outside is seen above the building only.
    EXPECT_EQ(linesOf(fromSouth(boxes, 2)), (Lines{{2000, 500, 2000, 1500},
                                                   {3000, 500, 3000, 1500},
                                                   {2000, 1500, 3000, 1500},
                                                   {4000, 3000, 4000, 4000},
                                                   {5000, 3000, 5000, 4000},
                                                   {4000, 4000, 5000, 4000}}));
}

TEST(LinesBeyond, APlanShowsWhatIsBelowAndWhatIsAbove) {
    Boxes boxes;
    boxes.addBox("slab", "FloorSurface", {0, 0, 0}, {6, 4, 0.2});
    boxes.addBox("post", "WallSurface", {1, 1, 0.2}, {2, 2, 3});
    boxes.addBox("beam", "WallSurface", {0, 1, 3}, {6, 2, 3.3});
    const SectionDrawing drawing = drawBeyond(boxes, {0, 0, 1}, {0, 0, 1}, {.visible = true, .above = true});
    EXPECT_EQ(linesOf(drawing), rectangle(0, 0, 6000, 4000));
    // Its ends lie on the border of the slab, its sides beside the post.
    EXPECT_EQ(
        linesOf(drawing, BeyondKind::Above),
        (Lines{{0, 1000, 1000, 1000}, {2000, 1000, 6000, 1000}, {0, 2000, 1000, 2000}, {2000, 2000, 6000, 2000}}));
}

/// Half a turn of a winding stair: solid steps between the radii 0.2 and 1.2 m around (3, 3), whose undersides together
/// are a helical soffit of facets.
Boxes windingStair(int steps, const char* ifcType = "IfcStairFlight") {
    Boxes boxes;
    boxes.addLabel("stair", "BuildingConstructiveElement", volume::Filling::Solid, 1);
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string(ifcType), ""});
    constexpr double kPi = 3.14159265358979323846, kRiser = 0.175, kThick = 0.2;
    const auto at = [&](double radius, int step, double z) {
        const double angle = kPi * step / steps;
        return Vec3d{3 + radius * std::cos(angle), 3 + radius * std::sin(angle), z};
    };
    for (int n = 0; n < steps; ++n) {
        const double top = 3 + kRiser * (n + 1), low = top - kThick - kRiser, high = top - kThick;
        const Vec3d a = at(0.2, n, low), b = at(1.2, n, low), c = at(1.2, n + 1, high), d = at(0.2, n + 1, high);
        const Vec3d e = at(0.2, n, top), f = at(1.2, n, top), g = at(1.2, n + 1, top), h = at(0.2, n + 1, top);
        boxes.addQuad({a, d, c, b});
        boxes.addQuad({e, f, g, h});
        boxes.addQuad({a, b, f, e});
        boxes.addQuad({c, d, h, g});
        boxes.addQuad({b, c, g, f});
        boxes.addQuad({d, a, e, h});
    }
    return boxes;
}

// Lines in plan that are not chords of the two circles.
std::size_t linesAcross(const SectionDrawing& drawing, BeyondKind kind) {
    std::size_t count = 0;
    for (const BeyondLine& line : drawing.beyond)
        if (line.kind == kind &&
            std::abs(std::hypot(line.from.u - 3, line.from.v - 3) - std::hypot(line.to.u - 3, line.to.v - 3)) > 0.1)
            ++count;
    return count;
}

TEST(LinesBeyond, AHelicalSoffitShowsNoFacets) {
    for (const int steps : {8, 12}) {
        const Boxes stair = windingStair(steps);
        const SectionDrawing below = drawBeyond(stair, {0, 0, 1}, {0, 0, 2}, {.above = true});
        EXPECT_EQ(linesAcross(below, BeyondKind::Above), 2u) << "its two ends";
        const SectionDrawing above = drawBeyond(stair, {0, 0, 1}, {0, 0, 8});
        EXPECT_EQ(linesAcross(above, BeyondKind::Visible), std::size_t(steps) + 1) << "its treads";
    }
    // Other bodies of facets keep their edges.
    const SectionDrawing other = drawBeyond(windingStair(8, "IfcSlab"), {0, 0, 1}, {0, 0, 2}, {.above = true});
    EXPECT_GT(linesAcross(other, BeyondKind::Above), 8u);
}

// The underside of a straight flight meets that of its landing in an edge.
TEST(LinesBeyond, FlightsAndLandingsKeepTheirEdges) {
    Boxes boxes;
    boxes.addLabel("stair", "BuildingConstructiveElement", volume::Filling::Solid, 1);
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcStair"), ""});
    const auto edge = [](double x, double z, double y) { return Vec3d{x, y, z}; };
    const std::array<std::array<double, 2>, 6> profile{
        {{1, 3}, {4, 4.8}, {5.2, 4.8}, {5.2, 5}, {4, 5}, {1, 3.2}}};  // from the side
    for (std::size_t n = 0; n < profile.size(); ++n) {
        const auto [x, z] = profile[n];
        const auto [nextX, nextZ] = profile[(n + 1) % profile.size()];
        boxes.addQuad({edge(x, z, 1), edge(x, z, 2), edge(nextX, nextZ, 2), edge(nextX, nextZ, 1)});
    }
    const SectionDrawing below = drawBeyond(boxes, {0, 0, 1}, {0, 0, 2}, {.above = true});
    EXPECT_TRUE(linesOf(below, BeyondKind::Above).contains({4000, 1000, 4000, 2000}));
}

// A line that pierces a slope ends there: the slope rises by 1 in 2, the rod's upper edges lie at 1.25 m.
TEST(LinesBeyond, ALineEndsWhereItPiercesAFace) {
    Boxes boxes;
    boxes.addBox("rod", "BuildingInstallation", {1, 4, 1}, {1.25, 4.25, 1.25});
    boxes.addBox("post", "BuildingInstallation", {4, 4, 0.125}, {4.5, 4.5, 3});
    boxes.addLabel("slope", "RoofSurface", volume::Filling::Surface, 0);
    // From y = 2, z = 0 to y = 6, z = 2.
    boxes.addQuad({Vec3d{0, 2, 0}, Vec3d{8, 2, 0}, Vec3d{8, 6, 2}, Vec3d{0, 6, 2}});
    const SectionDrawing drawing = fromSouth(boxes, 0.5);
    double lowest = 9;
    for (const BeyondLine& line : drawing.beyond)
        if (line.label == 1 && line.from.u == line.to.u) lowest = std::min(lowest, std::min(line.from.v, line.to.v));
    // The post's front edges at y = 4 leave the slope at z = 1.
    EXPECT_NEAR(lowest, 1, 1e-5);
    const Lines lines = linesOf(drawing);
    EXPECT_TRUE(lines.contains({1000, 1000, 1000, 1250}));
    EXPECT_TRUE(lines.contains({4000, 3000, 4500, 3000}));
}

// A slab that reaches into a wall meets it in the corner; one that only touches it gives no line of its own.
TEST(LinesBeyond, ALineIsDrawnWhereShellsPierceEachOther) {
    Boxes boxes;
    boxes.addBox("wall", "WallSurface", {0, 4, 0}, {6, 4.4, 3});
    boxes.addBox("beam", "BuildingInstallation", {1, 1, 1}, {2, 4.2, 1.5});
    // Seen from the south-west at an angle, the beam's west side and the wall's front cross upright.
    const SectionDrawing drawing = drawBeyond(boxes, {-0.6, -0.8, 0}, {-3, -3, 0});
    const double u = dot(Vec3d{1, 4, 0} - (drawing.axes.origin - boxes.volume.grid.origin()), drawing.axes.u);
    std::size_t found = 0;
    for (const BeyondLine& line : drawing.beyond)
        if (std::abs(line.from.u - u) < 1e-5 && std::abs(line.to.u - u) < 1e-5) {
            ++found;
            EXPECT_NEAR(std::min(line.from.v, line.to.v), 1, 1e-5);
            EXPECT_NEAR(std::max(line.from.v, line.to.v), 1.5, 1e-5);
        }
    EXPECT_EQ(found, 1u);
}

// Facets of round things have no edges between them, only an outline.
TEST(LinesBeyond, ARoundColumnShowsItsOutline) {
    Boxes boxes;
    boxes.addLabel("column", "BuildingInstallation", volume::Filling::Solid, 1);
    constexpr int kSides = 36;
    const auto rim = [](int n, double z) {
        const double angle = 2 * 3.14159265358979323846 * (n % kSides) / kSides;
        return Vec3d{4 + std::cos(angle), 4 + std::sin(angle), z};
    };
    for (int n = 0; n < kSides; ++n) {
        boxes.addQuad({rim(n, 0), rim(n + 1, 0), rim(n + 1, 3), rim(n, 3)});
        if (n % 2 == 0) {
            boxes.addQuad({Vec3d{4, 4, 0}, rim(n + 2, 0), rim(n + 1, 0), rim(n, 0)});
            boxes.addQuad({Vec3d{4, 4, 3}, rim(n, 3), rim(n + 1, 3), rim(n + 2, 3)});
        }
    }
    EXPECT_EQ(linesOf(fromSouth(boxes, 0.5)), rectangle(3000, 0, 5000, 3000));
}

TEST(LinesBeyond, WhatIsNotDrawnNeitherShowsNorHides) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 1, 0}, {4, 2, 2});
    boxes.addBox("B", "BuildingInstallation", {0, 3, 0}, {6, 4, 1});
    EXPECT_EQ(linesOf(drawBeyond(boxes, {0, -1, 0}, {0, 0.5, 0}, {.visible = true}, 1, {"id=A"})),
              rectangle(0, 0, 6000, 1000));
}

TEST(LinesBeyond, ThreadsMakeNoDifference) {
    Boxes boxes;
    for (int n = 0; n < 9; ++n)
        for (int m = 0; m < 9; ++m)
            boxes.addBox(std::to_string(n) + "-" + std::to_string(m), "BuildingFurniture",
                         {0.9 * n, 0.8 * m, 0.1 * ((n * 7 + m * 3) % 9)},
                         {0.9 * n + 0.7, 0.8 * m + 0.5, 0.5 + 0.2 * ((n * 5 + m * 11) % 9)});
    const BeyondOptions all{.visible = true, .hidden = true, .above = true};
    const SectionDrawing one = drawBeyond(boxes, {0.5, -0.7, 0.3}, {4, 3, 1}, all, 1);
    EXPECT_GT(one.beyond.size(), 100u);
    EXPECT_EQ(one.beyond, drawBeyond(boxes, {0.5, -0.7, 0.3}, {4, 3, 1}, all, 3).beyond);
}

TEST(LinesBeyond, AVolumeWithoutMeshesHasNone) {
    Boxes boxes;
    boxes.addLabel("voxels", "WallSurface", volume::Filling::Solid, 1);
    EXPECT_TRUE(fromSouth(boxes, 0.5).beyond.empty());
}

TEST(ElevationPlane, StandsBeforeTheModelOnTheSideThatIsAsked) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 1, 0}, {4, 2.5, 2});
    const auto& volume = boxes.volume;
    for (const auto& [side, normal, before] :
         {std::tuple("north", Vec3d{0, 1, 0}, 2.5), std::tuple("south", Vec3d{0, -1, 0}, -1.0),
          std::tuple("east", Vec3d{1, 0, 0}, 4.0), std::tuple("west", Vec3d{-1, 0, 0}, -2.0)}) {
        const auto plane = elevationPlane(side, volume);
        ASSERT_TRUE(plane);
        EXPECT_EQ(plane->normal, normal);
        EXPECT_NEAR(dot(plane->point - volume.grid.origin(), normal), before + 0.01, 1e-6);
    }
    EXPECT_EQ(elevationPlane("up", volume).error().code(), Code::BadSection);
}

}  // namespace
}  // namespace svt::drawing
