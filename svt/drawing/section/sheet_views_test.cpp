/// Views chosen for boxes: levels from rooms, sections beside walls and through stairs.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/sheet_views.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

/// Two rooms on the ground, one above them; a wall of 0.4 m stands in the middle of x.
Boxes threeRooms() {
    Boxes boxes;
    boxes.addBox("left", "BuildingRoom", {0.3, 0.3, 0.2}, {3.8, 5.7, 2.7});
    boxes.addBox("right", "BuildingRoom", {4.2, 0.3, 0.2}, {7.7, 5.7, 2.7});
    boxes.addBox("upper", "BuildingRoom", {0.3, 0.3, 3.05}, {7.7, 5.7, 5.5});
    boxes.addBox("void", "BuildingRoom", {0.3, 0.3, 2.7}, {7.7, 5.7, 2.8});
    boxes.addBox("wall", "BuildingConstructiveElement", {3.8, 0.3, 0.2}, {4.2, 5.7, 2.7});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {0.3, 6, 6});
    boxes.addBox("east", "BuildingConstructiveElement", {7.7, 0, 0}, {8, 6, 6});
    return boxes;
}

double placeAlong(const Boxes& boxes, const SheetView& view, Vec3d axis) {
    return dot(view.plane.point - boxes.volume.grid.origin(), axis);
}

TEST(SheetViews, LevelsAreFloorsOfRoomsButNotOfVoids) {
    const Boxes boxes = threeRooms();
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_NEAR(levels[0].floor, 0.2, 1e-5);
    EXPECT_NEAR(levels[1].floor, 3.05, 1e-5);
}

TEST(SheetViews, WithoutRoomsLevelsAreTopsOfSlabsButNotOfRoofsAndLandings) {
    Boxes boxes;
    boxes.addBox("ground", "BuildingConstructiveElement", {0, 0, 0}, {8, 6, 0.2});
    boxes.addBox("upper", "BuildingConstructiveElement", {0, 0, 2.8}, {8, 6, 3.05});
    boxes.addBox("landing", "BuildingConstructiveElement", {0, 0, 1.4}, {1, 2, 1.6});
    boxes.addBox("flat roof", "BuildingConstructiveElement", {0, 0, 5.8}, {8, 6, 6});
    boxes.addBox("wall", "BuildingConstructiveElement", {0, 0, 0.2}, {0.3, 6, 2.8});
    for (volume::Label& label : boxes.volume.labels.labels)
        label.attributes.push_back({"ifcType", std::string(label.id == "wall" ? "IfcWall" : "IfcSlab"), {}});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_NEAR(levels[0].floor, 0.2, 1e-5);
    EXPECT_NEAR(levels[1].floor, 3.05, 1e-5);
}

TEST(SheetViews, AShaftThatBeginsBelowIsNotTheFloor) {
    Boxes boxes = threeRooms();
    boxes.addBox("shaft", "BuildingRoom", {0.3, 0.3, 2.8}, {1.8, 1.8, 5.5});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_NEAR(levels[1].floor, 3.05, 1e-5);
}

TEST(SheetViews, PlansSectionsAndElevationsInTheirOrder) {
    const Boxes boxes = threeRooms();
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    ASSERT_EQ(chosen->views.size(), 8u);
    EXPECT_EQ(chosen->views[0].kind, ViewKind::Plan);
    EXPECT_NEAR(placeAlong(boxes, chosen->views[0], {0, 0, 1}), 1.3, 1e-5);
    EXPECT_NEAR(placeAlong(boxes, chosen->views[1], {0, 0, 1}), 4.15, 1e-5);
    EXPECT_EQ(chosen->views[2].name, "A");
    // Across the longer side, beside the wall in the middle.
    EXPECT_EQ(chosen->views[2].plane.normal, (Vec3d{1, 0, 0}));
    const double x = placeAlong(boxes, chosen->views[2], {1, 0, 0});
    EXPECT_TRUE(x < 3.8 || x > 4.2) << x;
    EXPECT_EQ(chosen->views[3].plane.normal, (Vec3d{0, -1, 0}));
    for (std::size_t n = 4; n < 8; ++n) EXPECT_EQ(chosen->views[n].kind, ViewKind::Elevation);
    EXPECT_EQ(chosen->views[7].name, "west");
}

TEST(SheetViews, SectionsGoThroughAStair) {
    Boxes boxes = threeRooms();
    boxes.addBox("stair", "BuildingInstallation", {6, 4, 0.2}, {7, 5, 2.7});
    boxes.volume.labels.labels.back().name = "Haupttreppe";
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    const double x = placeAlong(boxes, chosen->views[2], {1, 0, 0}), y = placeAlong(boxes, chosen->views[3], {0, 1, 0});
    EXPECT_TRUE(x > 6 && x < 7) << x;
    EXPECT_TRUE(y > 4 && y < 5) << y;
}

// A room that reaches around the house, such as its gross area, has the stair in it: the section would show a landing.
TEST(SheetViews, SectionsDoNotGoThroughAStairOutside) {
    Boxes boxes = threeRooms();
    boxes.addBox("south", "BuildingConstructiveElement", {0, 0, 0}, {8, 0.3, 6});
    boxes.addBox("north", "BuildingConstructiveElement", {0, 5.7, 0}, {8, 6, 6});
    boxes.addBox("gross area", "BuildingRoom", {0, -2, 0.2}, {8, 6, 2.7});
    boxes.addBox("stair", "BuildingInstallation", {6, -1.5, 0.2}, {7, -0.5, 2.7});
    boxes.volume.labels.labels.back().name = "Stair";
    boxes.addBox("landing", "BuildingConstructiveElement", {6, -1.5, 2.7}, {7, -0.5, 2.9});
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    const double x = placeAlong(boxes, chosen->views[2], {1, 0, 0}), y = placeAlong(boxes, chosen->views[3], {0, 1, 0});
    EXPECT_TRUE(x > 6 && x < 7) << x;
    EXPECT_TRUE(y > 0.3 && y < 5.7) << y;
}

bool cutsSomething(const Boxes& boxes, const SheetView& view) {
    return !drawSection(boxes.volume, view.plane)->components.empty();
}

//   +--+
//   |  |   small        gaps in x and y
//   +--+     +------+
//            | main |
//            +------+
TEST(SheetViews, SectionsNeverStandBetweenBuildings) {
    Boxes boxes;
    boxes.addBox("small west", "BuildingConstructiveElement", {0, 20, 0}, {0.3, 24, 3});
    boxes.addBox("small south", "BuildingConstructiveElement", {0.3, 20, 0}, {4, 20.3, 3});
    boxes.addBox("main west", "BuildingConstructiveElement", {22, 0, 0}, {22.3, 6, 6});
    boxes.addBox("main south", "BuildingConstructiveElement", {22, 0, 0}, {30, 0.3, 6});
    boxes.addBox("main east", "BuildingConstructiveElement", {29.7, 0, 0}, {30, 6, 6});
    boxes.addBox("tree", "SolitaryVegetationObject", {-40, -40, 0}, {-39, -39, 5});
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    std::size_t sections = 0;
    for (const SheetView& view : chosen->views) {
        if (view.kind != ViewKind::Section) continue;
        ++sections;
        EXPECT_TRUE(cutsSomething(boxes, view)) << view.name;
        const bool isAcrossX = std::abs(view.plane.normal.x) > 0.5;
        const double at = placeAlong(boxes, view, isAcrossX ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
        EXPECT_TRUE(isAcrossX ? at > 22 && at < 30 : at > 0 && at < 6) << at;
    }
    EXPECT_EQ(sections, 2u);
}

// The ridge runs along the shorter side, from y = 2 to 4: A-A cuts it there.
TEST(SheetViews, SectionACutsTheRidge) {
    Boxes boxes;
    boxes.addBox("walls", "BuildingConstructiveElement", {0, 0, 0}, {8, 6, 3});
    boxes.addLabel("roof", "RoofSurface", volume::Filling::Surface, 0);
    const Vec3d from{4, 1, 5}, to{4, 3, 5};
    boxes.addQuad({Vec3d{0, 0, 3}, Vec3d{0, 6, 3}, to, from});
    boxes.addQuad({Vec3d{8, 6, 3}, Vec3d{8, 0, 3}, from, to});
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    const auto a = std::find_if(chosen->views.begin(), chosen->views.end(),
                                [](const SheetView& view) { return view.kind == ViewKind::Section; });
    ASSERT_NE(a, chosen->views.end());
    EXPECT_NEAR(std::abs(a->plane.normal.y), 1, 1e-9);
    const double y = placeAlong(boxes, *a, {0, 1, 0});
    EXPECT_TRUE(y > 1 && y < 3) << y;
}

TEST(SheetViews, WithoutRoomsThereIsOnePlan) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    EXPECT_TRUE(findLevels(boxes.volume).empty());
    const auto chosen = chooseSheetViews(boxes.volume);
    ASSERT_TRUE(chosen);
    ASSERT_EQ(chosen->views.size(), 7u);
    EXPECT_EQ(chosen->views[0].kind, ViewKind::Plan);
}

}  // namespace
}  // namespace svt::drawing
