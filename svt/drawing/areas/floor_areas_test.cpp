/// Areas of boxes that are known, and uses that words tell.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/room_floor_areas.hpp>
#include <svt/pipeline/sample_models_test.hpp>

#include <gtest/gtest.h>
#include <polyclipping/clipper.hpp>

#include <cmath>
#include <map>
#include <string>

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

// A gross area that the file stores as a room, a flat of two rooms in it, and a booth in one of the rooms.
TEST(FloorAreas, ZonesDoNotCountAndSharedFloorsCountOnce) {
    Boxes boxes;
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {0.5, 8, 2.5});
    boxes.addBox("hall", "BuildingRoom", {0.5, 0, 0}, {6.5, 8, 2.5});
    boxes.addBox("office", "BuildingRoom", {6.5, 0, 0}, {10.5, 8, 2.5});
    boxes.addBox("booth", "BuildingRoom", {1, 1, 0}, {3, 3, 2});
    boxes.addBox("flat", "BuildingRoom", {0.5, 0, 0}, {10.5, 8, 2.5});
    boxes.addBox("gross", "BuildingRoom", {0, 0, 0}, {10.5, 8, 2.5});
    for (auto& label : boxes.volume.labels.labels) label.name = label.id;
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 1u);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    std::map<std::string, RoomArea> rooms;
    for (const RoomArea& room : areas->rooms) rooms[room.name] = room;
    ASSERT_EQ(rooms.size(), 5u);
    EXPECT_TRUE(rooms["flat"].isZone);
    EXPECT_TRUE(rooms["gross"].isZone);
    EXPECT_NEAR(rooms["gross"].area, 84, 1e-3) << "its own area stays";
    EXPECT_EQ(rooms["gross"].countedArea, 0);
    EXPECT_NEAR(rooms["gross"].unclaimedArea, 4, 1e-2);
    EXPECT_EQ(rooms["hall"].unclaimedArea, 0);
    EXPECT_FALSE(rooms["hall"].isZone);
    EXPECT_TRUE(rooms["hall"].isShared);
    EXPECT_NEAR(rooms["hall"].area, 48, 1e-3);
    EXPECT_NEAR(rooms["hall"].countedArea, 44, 1e-3) << "by the floor, not by the volume";
    EXPECT_NEAR(rooms["hall"].countedVolume, 48 * 2.5 - 8, 1e-3);
    EXPECT_FALSE(rooms["booth"].isShared);
    EXPECT_FALSE(rooms["office"].isShared);
    EXPECT_NEAR(areas->levels[0].net, 80, 1e-3);
    EXPECT_EQ(areas->levels[0].rooms, 3u);
    EXPECT_NEAR(areas->levels[0].construction, 4, 1e-3);
    EXPECT_TRUE(areas->levels[0].isExact);
    Diagnostics log;
    reportAreas(*areas, levels, boxes.volume, log);
    ASSERT_EQ(log.count(Code::RoomsShareSpace), 2u);
    const std::string zones = log.items()[0].message, overlap = log.items()[1].message;
    EXPECT_NE(zones.find("mostly of other rooms: 'flat', 'gross';"), std::string::npos) << zones;
    EXPECT_NE(zones.find("No other room covers about 4.0 m2 of their floor"), std::string::npos) << zones;
    EXPECT_NE(overlap.find("by 4.00 m2, which count once: 'hall'"), std::string::npos) << overlap;
    EXPECT_EQ(log.count(Code::NetExceedsGross), 0u);
    // Plans omit stamps of zones.
    for (const auto& component : boxes.cut({0, 0, 1}, {0, 0, 1.1}).components)
        EXPECT_EQ(component.isZone, rooms[boxes.volume.labels.labels[component.label].id].isZone);
}

// A wall of three parts around an opening; the last box becomes a part of the label before it.
void addToLabelBefore(Boxes& boxes) {
    auto& labels = boxes.volume.labels.labels;
    for (auto& triangle : boxes.volume.vectors.triangles)
        if (triangle.label == labels.size() - 1) --triangle.label;
    labels[labels.size() - 2].volume += labels.back().volume;
    labels.pop_back();
}

TEST(FloorAreas, ADoorOfGlassTakesNothingFromTheGrossArea) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.4, 0.4, 1}, {9, 7, 3.5});
    boxes.addBox("wall", "BuildingConstructiveElement", {0, 0, 1}, {4, 0.4, 3.5});
    boxes.addBox("beside the door", "BuildingConstructiveElement", {6, 0, 1}, {9, 0.4, 3.5});
    addToLabelBefore(boxes);
    boxes.addBox("lintel", "BuildingConstructiveElement", {4, 0, 3.2}, {6, 0.4, 3.5});
    addToLabelBefore(boxes);
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcWall"), ""});
    boxes.addBox("glass door", "Door", {4, 0.1, 1}, {6, 0.12, 3.2});
    boxes.addBox("other wall", "BuildingConstructiveElement", {0, 0.4, 1}, {0.4, 7, 3.5});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 1u);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].gross, 9 * 7, 1e-3);
    EXPECT_NEAR(areas->levels[0].construction, 9 * 0.4 + 0.4 * 6.6, 1e-3);
    EXPECT_TRUE(areas->levels[0].isGrossKnown);
    EXPECT_FALSE(areas->levels[0].netExceedsGross());
}

TEST(FloorAreas, RoofSpacesAndFoundationsAreNoFloors) {
    Boxes boxes;
    const auto addStorey = [&](const std::string& name, double level) {
        volume::Label& storey = volume::test::addGroup(boxes.volume, name, "Storey");
        storey.name = name;
        storey.attributes = {{"modelElevation", 100 + level, "m"}};
        return static_cast<std::uint32_t>(boxes.volume.labels.labels.size() - 1);
    };
    const auto addOn = [&](std::uint32_t storey, const std::string& className, Vec3d low,
                           Vec3d high) -> volume::Label& {
        boxes.addBox("part", className, low, high);
        boxes.volume.labels.labels.back().parent = storey;
        return boxes.volume.labels.labels.back();
    };
    const auto base = addStorey("T/FDN", 0), ground = addStorey("Level 1", 2), roof = addStorey("Roof", 5);
    addOn(base, "BuildingConstructiveElement", {0, 0, 0}, {8, 8, 2});
    addOn(ground, "BuildingRoom", {0, 0, 2}, {8, 8, 4.7});
    addOn(ground, "BuildingConstructiveElement", {8, 0, 2}, {8.4, 8, 4.7});
    addOn(roof, "BuildingRoom", {0, 0, 5}, {8, 8, 8}).name = "Roof";
    addOn(roof, "BuildingConstructiveElement", {8, 0, 5}, {8.4, 8, 8});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 3u);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_FALSE(areas->levels[0].isFloor);
    EXPECT_TRUE(areas->levels[1].isFloor);
    EXPECT_FALSE(areas->levels[2].isFloor);
    ASSERT_EQ(areas->rooms.size(), 1u);
    EXPECT_NEAR(areas->total().gross, 8.4 * 8, 1e-3);
    EXPECT_NEAR(areas->total().net, 64, 1e-3);
}

TEST(FloorAreas, RoomsWithMoreAreaThanTheirPlanAreReported) {
    Boxes boxes;
    boxes.addBox("hall", "BuildingRoom", {0, 0, 0}, {8, 8, 2.7});
    boxes.addBox("raised hall", "BuildingRoom", {8.4, 0, 0.5}, {16.4, 8, 3.2});
    boxes.addBox("wall", "BuildingConstructiveElement", {8, 0, 0}, {8.4, 8, 2.7});
    const auto levels = findLevels(boxes.volume);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->levels.size(), 1u);
    EXPECT_TRUE(areas->levels[0].netExceedsGross());
    Diagnostics log;
    reportAreas(*areas, levels, boxes.volume, log);
    ASSERT_EQ(log.count(Code::NetExceedsGross), 1u);
    EXPECT_NE(log.items()[0].message.find("have 128.00 m2, more than the 67.20 m2"), std::string::npos)
        << log.items()[0].message;
    EXPECT_FALSE(areas->total().isGrossKnown);
}

TEST(FloorAreas, StampsHaveTheNumbersOfTables) {
    // A glass panel stands in the room, and takes its part of the plan.
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0}, {6, 4, 2.5});
    auto& attributes = boxes.volume.labels.labels.back().attributes;
    attributes = {{"BaseQuantities.GrossFloorArea", 30.0, "m2"}, {"Qto_SpaceBaseQuantities.NetFloorArea", 21.0, "m2"}};
    boxes.addBox("panel", "BuildingConstructiveElement", {0.3, 0.3, 0}, {6, 0.4, 2.5});
    const auto areas = measureFloorAreas(boxes.volume, findLevels(boxes.volume));
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->rooms.size(), 1u);
    EXPECT_NEAR(areas->rooms[0].area, 5.7 * 3.7, 1e-4);
    EXPECT_EQ(areas->rooms[0].stated, 21.0) << "net before gross";
    for (const double height : {0.5, 1.1, 2.4}) {
        const SectionDrawing plan = boxes.cut({0, 0, 1}, {0, 0, height});
        ASSERT_EQ(plan.components.size(), 2u);
        EXPECT_NEAR(plan.components[0].area, 5.7 * 3.6, 1e-3) << "the cut itself";
        EXPECT_EQ(plan.components[0].stampArea(), areas->rooms[0].area);
        EXPECT_FALSE(plan.components[1].floorArea);
    }
    EXPECT_FALSE(boxes.cut({0, 1, 0}, {0, 2, 0}).components[0].floorArea) << "upright sections have no floors";
}

TEST(FloorAreas, StatedAreasAreQuantitiesOfTheFile) {
    const auto statedOf = [](std::vector<Attribute> attributes) {
        volume::Label label;
        label.attributes = std::move(attributes);
        return statedFloorArea(label);
    };
    EXPECT_EQ(statedOf({{"Dimensions.Area", 12.5, "m2"}}), 12.5);
    EXPECT_EQ(statedOf({{"floorArea", std::int64_t{12}, ""}, {"area", 13.0, ""}}), 12.0);
    EXPECT_FALSE(statedOf({{"Energy.Area per Person", 3.0, "m2"}, {"Area", std::string("12"), ""}}));
    EXPECT_FALSE(statedOf({{"Area", 0.0, "m2"}, {"NetFloorArea", 130.0, "ft2"}}));
}

TEST(FloorAreas, WithoutConstructionTheGrossAreaIsUnknown) {
    Boxes boxes;
    boxes.addBox("hall", "BuildingRoom", {0, 0, 0}, {8, 8, 2.7});
    const auto areas = measureFloorAreas(boxes.volume, findLevels(boxes.volume));
    ASSERT_TRUE(areas);
    EXPECT_TRUE(areas->levels[0].isFloor);
    EXPECT_FALSE(areas->levels[0].isGrossKnown);
}

TEST(FloorAreas, WithoutLevelsThereAreComponentsOnly) {
    Boxes boxes;
    boxes.addBox("house", "Building", {0, 0, 0}, {8, 6, 3});
    const auto areas = measureFloorAreas(boxes.volume, {});
    ASSERT_TRUE(areas);
    EXPECT_TRUE(areas->rooms.empty());
    EXPECT_EQ(areas->components.size(), 1u);
}

TEST(FloorAreas, PanesAndFramesCountWithTheirWindow) {
    Boxes boxes;
    boxes.addBox("wall", "BuildingConstructiveElement", {0, 0, 0}, {4, 0.3, 3});
    boxes.addBox("window", "Window", {1, 0.1, 1}, {2, 0.2, 1.1});
    for (const double x : {1.0, 1.5}) {
        boxes.addBox("pane", "WindowPhase", {x, 0.14, 1.1}, {x + 0.5, 0.16, 2});
        boxes.volume.labels.labels.back().parent = 1;
    }
    boxes.addBox("note", "Annotation", {0, 0, 3}, {1, 0.3, 3.2});
    const auto areas = measureFloorAreas(boxes.volume, findLevels(boxes.volume));
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->components.size(), 2u);
    EXPECT_EQ(areas->components[1].className, "Window");
    EXPECT_EQ(areas->components[1].count, 1u);
    EXPECT_NEAR(areas->components[1].volume, 0.1 * 0.1 + 2 * 0.5 * 0.02 * 0.9, 1e-9);
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

// The union of the faces of a label that look down, seen from above, by Clipper; m2.
double unionByClipper(const volume::SemanticVolume& volume, std::uint32_t label) {
    ClipperLib::Clipper clipper;
    const Vec3d origin = volume.grid.origin();
    for (const volume::VectorParts::Triangle& triangle : volume.vectors.triangles) {
        if (triangle.label != label) continue;
        ClipperLib::Path path;
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3d p = volume.vectors.position(corner, origin);
            path.emplace_back(std::llround((p.x - origin.x) * 1e7), std::llround((p.y - origin.y) * 1e7));
        }
        if (ClipperLib::Area(path) < 0) clipper.AddPath(path, ClipperLib::ptSubject, true);
    }
    ClipperLib::Paths joined;
    clipper.Execute(ClipperLib::ctUnion, joined, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    double area = 0;
    for (const ClipperLib::Path& path : joined) area += ClipperLib::Area(path) / 1e14;
    return area;
}

TEST(RoomFloorAreas, AreTheUnionOfFacesThatLookDown) {
    const volume::SemanticVolume volume =
        svt::test::volumeOfSample(samples::SampleKind::House, samples::SampleFormat::Ifc4, 0.2);
    const auto areas = roomFloorAreas(volume);
    int rooms = 0;
    for (std::uint32_t l = 0; l < areas.size(); ++l) {
        if (!areas[l]) continue;
        ++rooms;
        EXPECT_NEAR(*areas[l], unionByClipper(volume, l), 2e-4) << volume.labels.labels[l].name;
    }
    EXPECT_GT(rooms, 10);
}

TEST(RoomFloorAreas, ASpaceOutdoorsIsNoArea) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0}, {4, 4, 2.5});
    boxes.addBox("terrace", "BuildingRoom", {4, 0.3, 0}, {6, 4, 2.5});
    boxes.volume.labels.labels.back().attributes.push_back({"predefinedType", std::string("EXTERNAL"), ""});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {0.3, 4, 2.5});
    const auto areas = measureFloorAreas(boxes.volume, findLevels(boxes.volume));
    ASSERT_TRUE(areas);
    ASSERT_EQ(areas->rooms.size(), 1u);
    EXPECT_EQ(areas->rooms[0].name, "room");
}

}  // namespace
}  // namespace svt::drawing
