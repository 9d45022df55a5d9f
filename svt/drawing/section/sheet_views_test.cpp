/// Views chosen for boxes: levels from rooms, sections beside walls and through stairs.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/sheet_views.hpp>

#include <gtest/gtest.h>

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
