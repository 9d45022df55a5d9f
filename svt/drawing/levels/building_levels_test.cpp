/// Levels of boxes: pits, roofs, half storeys, cellars; the ground floor by names and elevations.

#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/floor_areas.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

// A building, label 0, with storeys that declare their levels.
struct House : Boxes {
    House() { volume::test::addGroup(volume, "house", "Building"); }

    std::uint32_t addStorey(const std::string& name, double level, double elevation) {
        volume::Label& storey = volume::test::addGroup(volume, name, "Storey", 0);
        storey.name = name;
        storey.attributes = {{"ifcType", std::string("IfcBuildingStorey"), ""},
                             {"elevation", elevation, "m"},
                             {"modelElevation", 100 + level, "m"}};
        return static_cast<std::uint32_t>(volume.labels.labels.size() - 1);
    }

    void addOn(std::uint32_t storey, const std::string& id, const std::string& className, Vec3d low, Vec3d high) {
        addBox(id, className, low, high);
        volume.labels.labels.back().parent = storey;
    }

    [[nodiscard]] std::size_t groundFloor() const {
        const auto levels = findLevels(volume);
        for (std::size_t n = 0; n < levels.size(); ++n)
            if (levels[n].isGround) return n;
        return levels.size();
    }
};

TEST(BuildingLevels, APitIsNotALevel) {
    Boxes boxes;
    boxes.addBox("hall", "BuildingRoom", {0, 0, 1.5}, {8, 8, 4.5});
    boxes.addBox("pit of the lift", "BuildingRoom", {8, 0, 0.25}, {9.5, 1.5, 4.5});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 1u);
    EXPECT_NEAR(levels[0].floor, 1.5, 2e-6);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].net, 64 + 2.25, 1e-4);
    EXPECT_NEAR(areas->levels[0].gross, 64 + 2.25, 1e-3) << "cut above the hall's floor";
}

TEST(BuildingLevels, AHalfStoreyIsALevel) {
    Boxes boxes;
    boxes.addBox("entrance", "BuildingRoom", {0, 0, 1.4}, {4, 8, 3.9});
    boxes.addBox("living room", "BuildingRoom", {4, 0, 0}, {8, 8, 2.6});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u) << "the plan of one would cut the other just below its ceiling";
    EXPECT_NEAR(levels[1].floor, 1.4, 2e-6);
}

TEST(BuildingLevels, WithoutStoreysAPitBelongsToTheFloorAboveIt) {
    Boxes boxes;
    boxes.addBox("cellar", "BuildingRoom", {0, 0, 0}, {8, 8, 2.3});
    boxes.addBox("hall", "BuildingRoom", {0, 0, 2.7}, {8, 8, 5.2});
    boxes.addBox("pit of the lift", "BuildingRoom", {8, 0, 1.45}, {9.5, 1.5, 5.2});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levelsOfLabels(boxes.volume, levels, labelExtents(boxes.volume)), (std::vector<std::size_t>{0, 1, 1}));
}

TEST(BuildingLevels, AStoreyWithRoomsOnTwoFloorsHasALevelForEach) {
    House house;
    const auto storey = house.addStorey("Default storey", 0, 0);
    house.addOn(storey, "living room", "BuildingRoom", {0, 0, 0}, {8, 8, 2.8});
    house.addOn(storey, "bedroom", "BuildingRoom", {0, 0, 3.1}, {8, 4, 5.9});
    house.addOn(storey, "void above the ceiling", "BuildingRoom", {0, 4, 3.1}, {2, 6, 4.7});
    house.addOn(storey, "upper wall", "BuildingConstructiveElement", {8, 0, 3.1}, {8.3, 8, 5.9});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_NEAR(levels[0].floor, 0, 2e-6);
    EXPECT_NEAR(levels[1].floor, 3.1, 2e-6);
    EXPECT_EQ(levels[1].name, "Default storey");
    EXPECT_TRUE(levels[0].isGround);
    const auto found = levelsOfLabels(house.volume, levels, labelExtents(house.volume));
    EXPECT_EQ(std::vector<std::size_t>(found.begin() + 2, found.end()), (std::vector<std::size_t>{0, 1, 1, 1}));
    const auto areas = measureFloorAreas(house.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].net, 64, 1e-4);
    EXPECT_NEAR(areas->levels[1].net, 32 + 4, 1e-4);
    Diagnostics log;
    reportStoreys(house.volume, log);
    ASSERT_EQ(log.items().size(), 1u);
    EXPECT_NE(log.items().front().message.find("stand on 2 floors, at 100.00 m, 103.10 m"), std::string::npos);
}

TEST(BuildingLevels, SmallRoomsAboveAStoreyAndThoseOfOtherPlansHaveNoLevel) {
    House house;
    const auto lower = house.addStorey("Level 1", 0, 0), upper = house.addStorey("Level 2", 3, 3);
    house.addOn(lower, "hall", "BuildingRoom", {0, 0, 0}, {8, 8, 2.7});
    house.addOn(lower, "on the wrong storey", "BuildingRoom", {0, 0, 3}, {8, 4, 5.7});
    house.addOn(upper, "bedroom", "BuildingRoom", {0, 4, 3}, {8, 8, 5.7});
    house.addOn(upper, "tank room", "BuildingRoom", {0, 4, 6}, {2, 6, 8});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0].name, "Level 1");
    EXPECT_EQ(levels[1].name, "Level 2");
}

TEST(BuildingLevels, AFoundationDoesNotTakeTheNameOfTheGroundFloor) {
    House house;
    const auto foundation = house.addStorey("Bk fundering", -0.75, -0.75),
               ground = house.addStorey("Begane grondvloer", 0, 0), upper = house.addStorey("1e verdieping", 3, 3);
    for (int n = 0; n < 4; ++n)
        house.addOn(foundation, "beam " + std::to_string(n), "BuildingConstructiveElement", {2.0 * n, 0, -0.75},
                    {2.0 * n + 0.4, 8, -0.35});
    house.addOn(ground, "wall", "BuildingConstructiveElement", {0, 0, 0}, {0.3, 8, 2.7});
    house.addOn(upper, "upper wall", "BuildingConstructiveElement", {0, 0, 3}, {0.3, 8, 5.7});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0].name, "Begane grondvloer");
    EXPECT_NEAR(levels[0].floor, 0, 2e-6);
    EXPECT_TRUE(levels[0].isGround);
    EXPECT_EQ(levels[0].storeys.size(), 2u);
}

// Its eaves hang below the floor of the upper storey, and it has no rooms.
TEST(BuildingLevels, ARoofDoesNotTakeTheNameOfTheStoreyBelowIt) {
    House house;
    const auto lower = house.addStorey("Level 1", 0, 0), upper = house.addStorey("Level 2", 3, 3),
               roof = house.addStorey("Roof", 3.5, 3.5);
    house.addOn(lower, "living room", "BuildingRoom", {0, 0, 0}, {8, 8, 2.7});
    house.addOn(upper, "bedroom", "BuildingRoom", {0, 0, 3}, {8, 8, 5.5});
    // Its floor is lower than that of the storey, and nearer to the one below.
    house.addOn(upper, "room over the garage", "BuildingRoom", {8, 0, 2.4}, {10, 8, 5});
    house.addOn(roof, "roof", "BuildingConstructiveElement", {0, 0, 2.2}, {10, 9, 6});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0].name, "Level 1");
    EXPECT_EQ(levels[1].name, "Level 2");
    EXPECT_NEAR(levels[1].floor, 3, 1e-9);
    EXPECT_EQ(levels[1].storeys, (std::vector<std::uint32_t>{upper, roof}));
    const auto areas = measureFloorAreas(house.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].net, 64, 1e-4);
    EXPECT_NEAR(areas->levels[1].net, 64 + 16, 1e-4);
}

TEST(BuildingLevels, ARoomBelongsToTheStoreyThatContainsIt) {
    House house;
    const auto lower = house.addStorey("EG", 0, 0), upper = house.addStorey("OG", 3, 3);
    house.addOn(lower, "hall", "BuildingRoom", {0, 0, 0}, {8, 8, 2.7});
    house.addOn(lower, "gallery", "BuildingRoom", {8, 0, 3}, {10, 8, 5.5});
    house.addOn(upper, "bedroom", "BuildingRoom", {0, 0, 3}, {8, 8, 5.5});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 2u);
    const auto levelOf = levelsOfLabels(house.volume, levels, labelExtents(house.volume));
    EXPECT_EQ(levelOf[3], 0u);
    EXPECT_EQ(levelOf[4], 0u) << "the file says so, although it stands 3 m higher";
    EXPECT_EQ(levelOf[5], 1u);
}

TEST(BuildingLevels, StoreysOfOneBuildingWithRoomsStayApart) {
    House house;
    const auto lower = house.addStorey("EG", 0, 0), higher = house.addStorey("EG+", 0.9, 0.9);
    house.addOn(lower, "kitchen", "BuildingRoom", {0, 0, 0}, {4, 8, 2.7});
    house.addOn(higher, "living room", "BuildingRoom", {4, 0, 0.9}, {8, 8, 3.6});
    EXPECT_EQ(findLevels(house.volume).size(), 2u);
    // Storeys of two buildings form one level.
    volume::test::addGroup(house.volume, "other", "Building");
    house.volume.labels.labels[higher].parent = static_cast<std::uint32_t>(house.volume.labels.labels.size() - 1);
    EXPECT_EQ(findLevels(house.volume).size(), 1u);
}

TEST(BuildingLevels, AFinishedFloorAboveTheDeclaredLevelIsKnown) {
    House house;
    const auto storey = house.addStorey("EG", 1, 0);
    house.addOn(storey, "room", "BuildingRoom", {0, 0, 1.2}, {8, 8, 3.7});
    house.addOn(storey, "floor", "BuildingConstructiveElement", {0, 0, 0.8}, {8, 8, 1});
    const auto levels = findLevels(house.volume);
    ASSERT_EQ(levels.size(), 1u);
    EXPECT_NEAR(levels[0].floor, 1, 1e-9);
    ASSERT_TRUE(levels[0].roomFloor);
    EXPECT_NEAR(*levels[0].roomFloor, 1.2, 2e-6);
    const auto areas = measureFloorAreas(house.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].gross, 64, 1e-3) << "cut in the room, not in the floor construction";
}

TEST(GroundFloor, IsNamedSoOrDeclaresTheElevationNearestToZero) {
    const auto groundOf = [](std::vector<std::pair<std::string, double>> storeys) {
        House house;
        double level = 0;
        for (const auto& [name, elevation] : storeys) {
            const auto storey = house.addStorey(name, level, elevation);
            house.addOn(storey, "room in " + name, "BuildingRoom", {0, 0, level}, {8, 8, level + 2.5});
            level += 2.8;
        }
        return house.groundFloor();
    };
    EXPECT_EQ(groundOf({{"Keller", -2.8}, {"Erdgeschoss", 0}, {"Obergeschoss", 2.8}}), 1u);
    EXPECT_EQ(groundOf({{"-1", -2.8}, {"0", 0.02}, {"1", 2.8}}), 1u);
    EXPECT_EQ(groundOf({{"UG", 109.5}, {"Level 1", 112.3}, {"Level 2", 115.1}}), 1u) << "heights above the sea";
    EXPECT_EQ(groundOf({{"Lower ground floor", 0}, {"Ground floor", 2.8}}), 1u);
    EXPECT_EQ(groundOf({{"T/FDN", -1.25}, {"Level 1", 0}}), 1u);
    EXPECT_EQ(groundOf({{"A", 30}, {"B", 32.8}}), 0u);
    EXPECT_EQ(groundOf({{"A", 30}, {"Haus 2 EG", 32.8}, {"C", 35.6}}), 1u) << "the word at the end";
    EXPECT_EQ(groundOf({{"A", 30}, {"EG-Wohnung", 32.8}, {"C", 35.6}}), 1u) << "the word at the beginning";
    EXPECT_EQ(groundOf({{"A", 30}, {"Segel", 32.8}, {"Weg", 35.6}, {"Egon", 38.4}}), 0u) << "parts of other words";
    EXPECT_EQ(groundOf({{"A", -1.2}, {"B", 1.6}}), 0u) << "too far from 0";
    EXPECT_EQ(groundOf({{"A", -1.9}, {"B", 0.9}}), 1u);
}

TEST(GroundFloor, IsAboveTheStoreysBelowGround) {
    Boxes boxes;
    volume::test::addGroup(boxes.volume, "house", "Building").attributes = {
        {"storeysBelowGround", std::int64_t{1}, ""}};
    for (int n = 0; n < 3; ++n) boxes.addBox("room", "BuildingRoom", {0, 0, 2.8 * n}, {8, 8, 2.8 * n + 2.5});
    const auto levels = findLevels(boxes.volume);
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_TRUE(levels[1].isGround);
    EXPECT_NEAR(zeroLevel(levels), 2.8, 2e-6);
    EXPECT_EQ(zeroLevel({}), 0);
}

}  // namespace
}  // namespace svt::drawing
