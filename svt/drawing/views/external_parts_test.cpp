// External walls from the hull:
//
//     +-----------------+      1 to 4: outer walls, 5: an inner wall that ends at the outer air,
//     |        5        |      6: a door in wall 1
//     |        5        |
//     +--6-----5--------+
//              5
#include <svt/drawing/external_parts.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <string>

namespace svt::drawing {
namespace {

enum HousePart : std::uint32_t { South, North, West, East, Inner, DoorPart, RoomWest, RoomEast };

struct HollowHouse {
    bool hasRooms = true, isOpen = false, hasTerrain = false;

    volume::SemanticVolume make() const {
        auto volume = volume::test::emptyVolume({40, 24, 16}, {0.25, 0.25, 0.25});
        for (const char* id : {"south", "north", "west", "east", "inner"})
            volume::test::addObject(volume, id, "BuildingConstructiveElement").attributes = {
                {"function", std::string("wall"), ""}};
        volume::test::addObject(volume, "door", "Door");
        volume::test::addObject(volume, "room west", "BuildingRoom");
        volume::test::addObject(volume, "room east", "BuildingRoom");
        volume::test::addObject(volume, "slab", "BuildingConstructiveElement");
        volume::test::addObject(volume, "earth", "TINRelief");
        using volume::test::PaintedBox;
        std::vector<PaintedBox> boxes{
            {9, {2, 4, 2}, {38, 22, 14}},  // slab and roof, hollowed below
            {0, {3, 5, 3}, {37, 21, 13}},  // air
            {1, {2, 4, 3}, {38, 5, 13}},   {2, {2, 21, 3}, {38, 22, 13}}, {3, {2, 5, 3}, {3, 21, 13}},
            {4, {37, 5, 3}, {38, 21, 13}}, {5, {19, 3, 3}, {21, 21, 13}},  // its end is outside
        };
        if (hasRooms) {
            boxes.push_back({7, {3, 5, 3}, {19, 21, 13}});
            boxes.push_back({8, {21, 5, 3}, {37, 21, 13}});
        }
        boxes.push_back({isOpen ? 0u : 6u, {8, 4, 3}, {12, 5, 11}});
        if (isOpen) boxes.push_back({0, {28, 4, 3}, {32, 5, 11}});
        if (hasTerrain) boxes.push_back({10, {0, 0, 0}, {40, 4, 16}});
        volume::test::paintBoxes(volume, boxes);
        return volume;
    }
};

TEST(ExternalParts, AreFoundByTheOutsideAir) {
    for (const bool hasRooms : {true, false}) {
        const auto parts = findExternalParts(HollowHouse{.hasRooms = hasRooms}.make());
        for (const auto wall : {South, North, West, East, DoorPart})
            EXPECT_EQ(parts[wall], (ExternalPart{true, ExternalSource::Hull})) << wall;
        EXPECT_EQ(parts[Inner], (ExternalPart{false, ExternalSource::Hull})) << "only its end is outside";
        EXPECT_EQ(parts[RoomWest].source, ExternalSource::None);
    }
}

TEST(ExternalParts, TheFileDecidesFirst) {
    auto volume = HollowHouse().make();
    volume.labels.labels[South].attributes.push_back({"Pset_WallCommon.IsExternal", false, ""});
    volume.labels.labels[Inner].attributes.push_back({"Pset_WallCommon.IsExternal", true, ""});
    const auto parts = findExternalParts(volume);
    EXPECT_EQ(parts[South], (ExternalPart{false, ExternalSource::File}));
    EXPECT_EQ(parts[Inner], (ExternalPart{true, ExternalSource::File}));
    EXPECT_EQ(parts[North], (ExternalPart{true, ExternalSource::Hull}));
    const std::string text = externalSources(parts, volume.labels);
    EXPECT_NE(text.find("5 of 6 (stated in the file: 1;"), std::string::npos) << text;
    EXPECT_NE(text.find("one side: 4)"), std::string::npos) << text;
}

// Rooms count as inside, even where a door is missing. Without rooms, both sides of such a wall look alike.
TEST(ExternalParts, OfAnOpenModelNeedRooms) {
    const auto parts = findExternalParts(HollowHouse{.hasRooms = true, .isOpen = true}.make());
    EXPECT_EQ(parts[North], (ExternalPart{true, ExternalSource::Hull}));
    EXPECT_EQ(parts[Inner], (ExternalPart{false, ExternalSource::Hull}));
    const auto open = HollowHouse{.hasRooms = false, .isOpen = true}.make();
    const auto unknown = findExternalParts(open);
    for (const auto wall : {South, North, West, East, Inner})
        EXPECT_EQ(unknown[wall], (ExternalPart{false, ExternalSource::Open})) << wall;
    EXPECT_NE(externalSources(unknown, open.labels).find("5 undecided"), std::string::npos);
}

TEST(ExternalParts, StandAgainstEarthToo) {
    const auto parts = findExternalParts(HollowHouse{.hasTerrain = true}.make());
    EXPECT_EQ(parts[South], (ExternalPart{true, ExternalSource::Hull}));
}

TEST(ExternalParts, LayersAreWhereTheirWallIs) {
    auto volume = volume::test::emptyVolume({20, 10, 10}, {0.25, 0.25, 0.25});
    const auto wall = [&](const char* id, std::uint32_t parent) {
        volume::test::addObject(volume, id, "BuildingConstructiveElement", parent).attributes = {
            {"ifcType", std::string("IfcWall"), ""}};
    };
    wall("wall", volume::kNoLabel);
    wall("outer layer", 0);
    wall("inner layer", 0);
    volume::test::addObject(volume, "room", "BuildingRoom");
    volume::test::paintBoxes(volume,
                             {{4, {2, 2, 2}, {18, 6, 8}}, {3, {2, 6, 2}, {18, 7, 8}}, {2, {2, 7, 2}, {18, 8, 8}}});
    const auto parts = findExternalParts(volume);
    for (std::size_t layer = 0; layer < 3; ++layer)
        EXPECT_EQ(parts[layer], (ExternalPart{true, ExternalSource::Hull})) << layer;
    EXPECT_NE(externalSources(parts, volume.labels).find("1 of 1"), std::string::npos);
}

}  // namespace
}  // namespace svt::drawing
