#include <svt/drawing/footprints.hpp>

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace svt::drawing {
namespace {

using analyze::PlanOutline;
using volume::Filling;

Footprint footprintOf(const volume::SemanticVolume& volume, std::uint32_t label,
                      PlanOutline outline = PlanOutline::Footprint) {
    const analyze::Extents extents(volume.labels);
    return Footprints(volume, extents).of(label, outline);
}

// A building without a body, whose surfaces are quads at a height. The children are added to label 0.
struct Surfaces : Boxes {
    Surfaces() { volume::test::addGroup(volume, "building", "Building"); }
    void add(const char* className, std::vector<std::array<double, 4>> rectangles, double z) {
        volume::Label& label = volume::test::addObject(volume, className, className, 0);
        label.filling = Filling::Surface;
        for (const auto& [west, south, east, north] : rectangles)
            addQuad({Vec3d{west, south, z}, Vec3d{west, north, z}, Vec3d{east, north, z}, Vec3d{east, south, z}});
    }
};

TEST(Footprints, AreTheGroundSurfacesWithHoles) {
    Surfaces court;
    // Four wings around a court of 4 x 2 m, and a shed apart. The roof is larger.
    court.add("GroundSurface", {{0, 0, 8, 2}, {0, 4, 8, 6}, {0, 2, 2, 4}, {6, 2, 8, 4}, {9, 0, 10, 1}}, 1);
    court.add("RoofSurface", {{-0.5, -0.5, 8.5, 6.5}}, 5);
    const Footprint ground = footprintOf(court.volume, 0);
    EXPECT_NEAR(ground.area, 48 - 8 + 1, 1e-6);
    EXPECT_EQ(ground.source, "ground surfaces");
    ASSERT_EQ(ground.polygons.size(), 2u);
    ASSERT_EQ(ground.polygons[0].rings.size(), 2u) << "the court";
    EXPECT_EQ(ground.polygons[0].rings[0].size(), 4u) << "points on straight lines are dropped";
    EXPECT_EQ(ground.polygons[0].rings[1].size(), 4u);
    EXPECT_NEAR(areaOf(ground.polygons[1]), 1, 1e-6);
    for (const auto& [x, y] : ground.polygons[1].rings[0]) {
        EXPECT_GE(x, 500009 - 1e-6);
        EXPECT_LE(y, 5400001 + 1e-6);
    }
    const Footprint roof = footprintOf(court.volume, 0, PlanOutline::Roof);
    EXPECT_NEAR(roof.area, 63, 1e-6);
    EXPECT_EQ(roof.source, "roof surfaces");
}

TEST(Footprints, AreTheOutlinesOfSolidsWithoutGroundSurfaces) {
    Boxes boxes;
    volume::test::addGroup(boxes.volume, "building", "Building");
    const auto addPart = [&](const char* id, const char* className, Vec3d low, Vec3d high) {
        boxes.addBox(id, className, low, high);
        volume::Label& label = boxes.volume.labels.labels.back();
        label.parent = 0;
        boxes.volume.labels.labels[0].subtreeEnd = static_cast<std::uint32_t>(boxes.volume.labels.labels.size());
    };
    addPart("low", "BuildingPart", {0, 0, 0}, {4, 4, 3});
    addPart("high", "BuildingPart", {2, 2, 0}, {6, 6, 9});
    addPart("chimney", "BuildingInstallation", {8, 8, 0}, {9, 9, 3});
    EXPECT_NEAR(footprintOf(boxes.volume, 1).area, 16, 1e-6);
    const Footprint both = footprintOf(boxes.volume, 0);
    EXPECT_NEAR(both.area, 16 + 16 - 4 + 1, 1e-6) << "a part in two counts once";
    EXPECT_EQ(both.source, "meshes");
    ASSERT_FALSE(both.polygons.empty());
    EXPECT_EQ(both.polygons[0].rings[0].size(), 8u);
    // One part has a ground surface, which does not stand for the other part.
    Boxes mixed = boxes;
    volume::test::addObject(mixed.volume, "annex", "BuildingPart", 0);
    const auto annex = static_cast<std::uint32_t>(mixed.volume.labels.labels.size() - 1);
    volume::test::addObject(mixed.volume, "ground", "GroundSurface", annex).filling = Filling::Surface;
    mixed.addQuad({Vec3d{10, 0, 0}, Vec3d{10, 1, 0}, Vec3d{12, 1, 0}, Vec3d{12, 0, 0}});
    EXPECT_NEAR(footprintOf(mixed.volume, annex).area, 2, 1e-6);
    EXPECT_NEAR(footprintOf(mixed.volume, 0).area, 29 + 2, 1e-6);
    EXPECT_EQ(footprintOf(mixed.volume, 0).source, "ground surfaces and meshes");
}

// Voxels of 0.5 m in the shape of a U with a court, also in a turned grid.
TEST(Footprints, OfVoxelsAreTheirColumns) {
    for (const double angle : {0.0, 0.4}) {
        const double c = std::cos(angle), s = std::sin(angle);
        volume::SemanticVolume volume = volume::test::emptyVolume({10, 8, 4}, {0.5, 0.5, 0.5}, {1000, 2000, 5},
                                                                  {Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}});
        volume::test::addObject(volume, "a", "Building").filling = Filling::Solid;
        volume::test::addObject(volume, "b", "Building").filling = Filling::Solid;
        volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {6, 6, 2}},
                                          {0, {2, 2, 0}, {4, 4, 4}},
                                          {1, {8, 0, 1}, {9, 3, 2}},
                                          {2, {0, 7, 0}, {10, 8, 1}}});
        const Footprint u = footprintOf(volume, 0);
        EXPECT_NEAR(u.area, (36 - 4 + 3) * 0.25, 1e-5) << angle;
        ASSERT_EQ(u.polygons.size(), 2u);
        EXPECT_EQ(u.polygons[0].rings.size(), 2u);
        EXPECT_EQ(u.source, "voxels");
        EXPECT_NEAR(footprintOf(volume, 1).area, 2.5, 1e-5);
        // The first sample's column.
        const Vec3d corner = volume.grid.worldFromIndex({-0.5, -0.5, 0});
        bool hasCorner = false;
        for (const auto& [x, y] : u.polygons[0].rings[0])
            hasCorner = hasCorner || (std::abs(x - corner.x) < 1e-5 && std::abs(y - corner.y) < 1e-5);
        EXPECT_TRUE(hasCorner) << angle;
    }
}

TEST(Footprints, OfUprightFacesAreThoseOfTheirVoxels) {
    Surfaces wall;
    volume::Label& label = volume::test::addObject(wall.volume, "wall", "WallSurface", 0);
    label.filling = Filling::Surface;
    wall.addQuad({Vec3d{1, 2, 0}, Vec3d{5, 2, 0}, Vec3d{5, 2, 3}, Vec3d{1, 2, 3}});
    volume::test::paintBoxes(wall.volume, {{1, {1, 2, 0}, {5, 3, 3}}});
    const Footprint footprint = footprintOf(wall.volume, 1);
    EXPECT_NEAR(footprint.area, 4, 1e-5);
    EXPECT_EQ(footprint.source, "voxels");
}

TEST(Footprints, OfNothingAreEmpty) {
    Surfaces nothing;
    const Footprint footprint = footprintOf(nothing.volume, 0);
    EXPECT_TRUE(footprint.polygons.empty());
    EXPECT_EQ(footprint.area, 0);
    EXPECT_EQ(footprint.source, "");
}

// The faces that tiles of cities store give the same footprints as all faces.
TEST(Footprints, AreTheSameFromStoredFaces) {
    Surfaces court;
    court.add("GroundSurface", {{0, 0, 8, 2}, {0, 4, 8, 6}, {0, 2, 2, 4}, {6, 2, 8, 4}}, 1);
    court.add("RoofSurface", {{-0.5, -0.5, 8.5, 6.5}}, 5);
    court.addBox("tower", "Building", {20, 0, 0}, {23, 3, 30});
    const Footprint all = footprintOf(court.volume, 0), tower = footprintOf(court.volume, 3);
    // Older tiles have only the faces of footprints.
    court.volume.footprints = std::exchange(court.volume.vectors, {});
    std::erase_if(court.volume.footprints.triangles, [&](const volume::VectorParts::Triangle& triangle) {
        return court.volume.labels.labels[triangle.label].className == "RoofSurface";
    });
    EXPECT_EQ(footprintOf(court.volume, 0).polygons, all.polygons);
    EXPECT_EQ(footprintOf(court.volume, 3).polygons, tower.polygons);
    EXPECT_NEAR(tower.area, 9, 1e-6);
}

}  // namespace
}  // namespace svt::drawing
