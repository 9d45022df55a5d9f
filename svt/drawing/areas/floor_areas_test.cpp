/// Areas of boxes that are known, and uses that words tell.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/floor_areas.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

TEST(FloorAreas, RoomsStoreysAndComponentsOfBoxes) {
    Boxes boxes;
    boxes.addBox("kitchen", "BuildingRoom", {0.3, 0.3, 0}, {4, 4, 2.5});
    boxes.volume.labels.labels.back().name = "Küche";
    boxes.addBox("stairwell", "BuildingRoom", {4, 0.3, 0}, {6, 4, 2.5});
    boxes.volume.labels.labels.back().name = "Treppenhaus";
    boxes.volume.labels.labels.back().attributes.push_back({"number", std::string("2"), ""});
    boxes.addBox("void", "BuildingRoom", {0.3, 0.3, 2.5}, {6, 4, 2.8});
    boxes.addBox("loft", "BuildingRoom", {0.3, 0.3, 3}, {6, 4, 5});
    boxes.addBox("table", "BuildingFurniture", {1, 1, 0}, {2, 2, 0.8});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {0.3, 4, 5});
    boxes.addBox("garden", "LandUse", {0, 5, 0}, {8, 8, 0.5});
    const std::vector<BuildingLevel> levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->rooms.size(), 3u);
    EXPECT_EQ(areas->rooms[0].name, "Küche");
    // The table stands in the room and takes nothing of its area.
    EXPECT_NEAR(areas->rooms[0].area, 3.7 * 3.7, 1e-4);
    EXPECT_NEAR(areas->rooms[0].height, 2.5, 1e-5);
    EXPECT_EQ(areas->rooms[0].use, RoomUse::Use);
    EXPECT_EQ(areas->rooms[1].number, "2");
    EXPECT_EQ(areas->rooms[1].use, RoomUse::Traffic);
    EXPECT_EQ(areas->rooms[2].level, 1u);
    const LevelArea& ground = areas->levels[0];
    EXPECT_NEAR(ground.net, 5.7 * 3.7, 1e-4);
    EXPECT_NEAR(ground.traffic, 2 * 3.7, 1e-4);
    EXPECT_NEAR(ground.construction, 0.3 * 4, 1e-3);
    EXPECT_NEAR(ground.gross, ground.net + ground.construction, 1e-9);
    EXPECT_NEAR(areas->total().unknown, 5.7 * 3.7, 1e-4);  // the loft
    ASSERT_EQ(areas->components.size(), 3u);
    EXPECT_EQ(areas->components[0].className, "BuildingConstructiveElement");
    EXPECT_NEAR(areas->components[0].area, 4 * 5, 1e-4);  // face-on
    EXPECT_NEAR(areas->components[0].volume, 0.3 * 4 * 5, 1e-9);
}

TEST(FloorAreas, WithoutLevelsThereAreComponentsOnly) {
    Boxes boxes;
    boxes.addBox("house", "Building", {0, 0, 0}, {8, 6, 3});
    const auto areas = measureFloorAreas(boxes.volume, {});
    ASSERT_TRUE(areas);
    EXPECT_TRUE(areas->rooms.empty());
    EXPECT_EQ(areas->components.size(), 1u);
}

TEST(RoomUse, WordsOfNamesAndAttributesTell) {
    const auto useOf = [](const std::string& name, const std::string& function = "") {
        volume::Label label;
        label.name = name;
        if (!function.empty()) label.attributes.push_back({"function", function, ""});
        return roomUseOf(label);
    };
    EXPECT_EQ(useOf("Schlafzimmer"), RoomUse::Use);
    EXPECT_EQ(useOf("Bad"), RoomUse::Use);
    EXPECT_EQ(useOf("Entrance hall"), RoomUse::Traffic);
    EXPECT_EQ(useOf("Hall"), RoomUse::Traffic);
    EXPECT_EQ(useOf("Lagerhalle"), RoomUse::Use);
    EXPECT_EQ(useOf("Heizungsraum"), RoomUse::Technical);
    EXPECT_EQ(useOf("1.07", "Kitchen"), RoomUse::Use);
    EXPECT_EQ(useOf("1.07"), RoomUse::Unknown);
    EXPECT_EQ(useOf("Badge 7"), RoomUse::Unknown);
}

}  // namespace
}  // namespace svt::drawing
