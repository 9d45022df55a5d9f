/// Floors of boxes: of rooms with recesses, of storeys with and without rooms and declared levels; of voxels to one
/// voxel.

#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/levels/two_storeys_test.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

TEST(StoreyFloors, StoreysComeFromTheLowestWithTheHeightsOfTheirRooms) {
    auto volume = twoStoreys();
    volume::test::addGroup(volume, "attic", "Storey", 0).name = "attic";
    const auto storeys = findStoreys(volume);
    ASSERT_EQ(storeys.size(), 2u);
    EXPECT_EQ(storeys[0].label, 1u);
    EXPECT_EQ(storeys[1].label, 4u);
    EXPECT_DOUBLE_EQ(storeys[0].floor, 0.375);
    EXPECT_DOUBLE_EQ(storeys[0].top, 2.375);
    EXPECT_DOUBLE_EQ(storeys[1].floor, 2.875);
    EXPECT_DOUBLE_EQ(storeys[1].top, 5.125);
    EXPECT_DOUBLE_EQ(storeys[0].bound, 0.25) << "one voxel";
}

// Adds a storey; putOnStorey() moves the last component onto it.
void addStorey(Boxes& boxes, const std::string& name) {
    volume::test::addGroup(boxes.volume, name, "Storey").name = name;
}

void putOnStorey(Boxes& boxes, std::uint32_t storey) { boxes.volume.labels.labels.back().parent = storey; }

// A loft whose hatch reaches 16 cm into the floor below it, as deep as the ceiling.
Boxes loft() {
    Boxes boxes;
    addStorey(boxes, "Attic");
    boxes.addBox("loft", "BuildingRoom", {0.5, 0.5, 5.56}, {8, 6, 8});
    putOnStorey(boxes, 0);
    boxes.addQuad({Vec3d{3, 3, 5.4}, Vec3d{3, 4, 5.4}, Vec3d{4, 4, 5.4}, Vec3d{4, 3, 5.4}});
    boxes.addBox("slab", "BuildingConstructiveElement", {0.5, 0.5, 5.36}, {8, 6, 5.56});
    putOnStorey(boxes, 0);
    return boxes;
}

TEST(StoreyFloors, ARoomDoesNotStandInTheRecessOfItsHatch) {
    const Boxes boxes = loft();
    const auto extents = labelExtents(boxes.volume);
    EXPECT_NEAR(extents[1].floor, 5.56, 2e-6);
    EXPECT_NEAR(extents[1].floorArea, 7.5 * 5.5, 1e-4);
    EXPECT_NEAR(extents[1].box.min.z, 5.4, 2e-6);
    EXPECT_EQ(extents[1].bound, 0);
    const auto heights = storeyHeights("Attic", boxes.volume);
    ASSERT_TRUE(heights);
    EXPECT_NEAR(heights->floor, 5.56, 2e-6);
    EXPECT_NEAR(heights->low, 5.4, 2e-6) << "all of the storey is above";
    EXPECT_NEAR(heights->top, 8, 2e-6);
    EXPECT_EQ(heights->bound, 0);
}

TEST(StoreyFloors, PlansStoreysAndAreasHaveOneFloor) {
    const Boxes boxes = loft();
    const auto storeys = findStoreys(boxes.volume);
    const auto levels = findLevels(boxes.volume);
    const auto plane = parseSectionPlane("storey=Attic+1.1", boxes.volume);
    ASSERT_EQ(storeys.size(), 1u);
    ASSERT_EQ(levels.size(), 1u);
    ASSERT_TRUE(plane);
    EXPECT_EQ(storeys[0].floor, levels[0].floor);
    EXPECT_NEAR(dot(plane->normal, plane->point - boxes.volume.grid.origin()), levels[0].floor + 1.1, 1e-12);
    const auto areas = measureFloorAreas(boxes.volume, levels);
    ASSERT_TRUE(areas);
    EXPECT_NEAR(areas->levels[0].gross, 7.5 * 5.5, 1e-4) << "cut above the slab, not within";
    EXPECT_TRUE(areas->levels[0].isExact);
}

TEST(StoreyFloors, WithoutRoomsAStoreyDeclaresItsFloor) {
    Boxes boxes;
    addStorey(boxes, "Base");
    boxes.addBox("foundation", "BuildingConstructiveElement", {0, 0, 0}, {8, 6, 1});
    putOnStorey(boxes, 0);
    boxes.addBox("wall", "BuildingConstructiveElement", {0, 0, 1}, {0.3, 6, 3.5});
    putOnStorey(boxes, 0);
    EXPECT_NEAR(storeyHeights("Base", boxes.volume)->floor, 0, 2e-6) << "the lowest point of its meshes";
    auto& attributes = boxes.volume.labels.labels[0].attributes;
    attributes.push_back({"elevation", 101.2, {}});
    EXPECT_NEAR(storeyHeights("Base", boxes.volume)->floor, 1.2, 2e-6);
    attributes.back().value = 1.2;
    EXPECT_NEAR(storeyHeights("Base", boxes.volume)->floor, 0, 2e-6) << "elsewhere than the storey is: not in the CRS";
}

void declareLevel(Boxes& boxes, double height) {
    boxes.volume.labels.labels[0].attributes.push_back({"modelElevation", 100 + height, "m"});
}

TEST(StoreyFloors, ADeclaredLevelCountsIfMostRoomsConfirmIt) {
    Boxes boxes;
    addStorey(boxes, "EG");
    declareLevel(boxes, 2);
    for (int n = 0; n < 4; ++n) {
        boxes.addBox("room", "BuildingRoom", {2.0 * n, 0, 2.02}, {2.0 * n + 2, 10, 4.5});
        putOnStorey(boxes, 0);
    }
    boxes.addBox("pit of the lift", "BuildingRoom", {8, 0, 0.75}, {9.5, 1.5, 4.5});
    putOnStorey(boxes, 0);
    const auto heights = storeyHeights("EG", boxes.volume);
    ASSERT_TRUE(heights);
    EXPECT_NEAR(heights->floor, 2, 1e-9) << "2 cm of floor finish are above it";
    EXPECT_NEAR(*heights->measured, 2.02, 2e-6);
    EXPECT_EQ(heights->source, FloorSource::Declared);
    EXPECT_FALSE(heights->disagrees());
    EXPECT_NEAR(heights->low, 0.75, 2e-6);
}

TEST(StoreyFloors, RoomsPrevailOverADeclaredLevelElsewhere) {
    Boxes boxes;
    addStorey(boxes, "EG");
    declareLevel(boxes, 1.4);
    boxes.addBox("room", "BuildingRoom", {0, 0, 2}, {8, 8, 4.5});
    putOnStorey(boxes, 0);
    const auto heights = storeyHeights("EG", boxes.volume);
    ASSERT_TRUE(heights);
    EXPECT_NEAR(heights->floor, 2, 2e-6);
    EXPECT_EQ(heights->source, FloorSource::Rooms);
    EXPECT_TRUE(heights->disagrees());
    Diagnostics log;
    reportStoreys(boxes.volume, log);
    ASSERT_EQ(log.count(Code::StoreyLevelDiffers), 1u);
    const std::string& message = log.items().front().message;
    EXPECT_NE(message.find("'EG' declares the level 101.40 m"), std::string::npos) << message;
    EXPECT_NE(message.find("most of its rooms stand at 102.00 m"), std::string::npos) << message;
    EXPECT_EQ(log.items().front().where.id, "EG");
}

// The model of a house: its storey holds the foundation, and neither rooms nor slabs.
TEST(StoreyFloors, AFoundationIsNotTheFloorOfItsStorey) {
    Boxes boxes;
    addStorey(boxes, "Ground");
    boxes.addBox("footing", "BuildingConstructiveElement", {0, 0, 0}, {8, 6, 2});
    putOnStorey(boxes, 0);
    boxes.addBox("wall", "BuildingConstructiveElement", {0, 0, 2}, {0.3, 6, 5});
    putOnStorey(boxes, 0);
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcWall"), ""});
    EXPECT_NEAR(storeyHeights("Ground", boxes.volume)->floor, 2, 2e-6) << "foot of the wall";
    declareLevel(boxes, 2.05);
    EXPECT_NEAR(storeyHeights("Ground", boxes.volume)->floor, 2.05, 1e-9);
    boxes.volume.labels.labels[0].attributes.back().value = 100.0 + 40;
    EXPECT_NEAR(storeyHeights("Ground", boxes.volume)->floor, 2, 2e-6) << "the storey does not reach this level";
    EXPECT_TRUE(storeyHeights("Ground", boxes.volume)->disagrees());
}

TEST(StoreyFloors, WithoutRoomsSlabsConfirmTheDeclaredLevel) {
    Boxes boxes;
    addStorey(boxes, "Level 2");
    const auto addSlab = [&](double top) {
        boxes.addBox("slab", "BuildingConstructiveElement", {0, 0, top - 0.2}, {8, 6, top});
        putOnStorey(boxes, 0);
        boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcSlab"), ""});
    };
    addSlab(3);
    EXPECT_EQ(storeyHeights("Level 2", boxes.volume)->source, FloorSource::Slabs);
    EXPECT_NEAR(storeyHeights("Level 2", boxes.volume)->floor, 3, 2e-6);
    addSlab(6);  // the ceiling
    declareLevel(boxes, 3.1);
    EXPECT_NEAR(storeyHeights("Level 2", boxes.volume)->floor, 3.1, 1e-9);
    boxes.volume.labels.labels[0].attributes.back().value = 100 + 2.2;
    EXPECT_NEAR(storeyHeights("Level 2", boxes.volume)->floor, 3, 2e-6);
    EXPECT_TRUE(storeyHeights("Level 2", boxes.volume)->disagrees());
}

// The slab ends at 1.5 m, known up to one voxel of 0.25 m: a level up to 0.3 m + 0.25 m away agrees with it.
TEST(StoreyFloors, ASlabOfVoxelsConfirmsALevelWithinItsBound) {
    const auto sourceAt = [](double level) {
        volume::SemanticVolume volume = volume::test::emptyVolume({5, 5, 21}, {0.25, 0.25, 0.25}, {100, 200, 30.125});
        volume::test::addGroup(volume, "b", "Building");
        volume::test::addGroup(volume, "s", "Storey", 0).attributes = {{"modelElevation", 30 + level, "m"}};
        volume::test::addObject(volume, "slab", "BuildingConstructiveElement", 1).attributes = {
            {"ifcType", std::string("IfcSlab"), ""}};
        volume::test::addObject(volume, "wall", "BuildingConstructiveElement", 1);
        volume::test::paint(volume, [](int i, int, int k) { return k >= 4 && k < 6 ? 1 : i == 0 ? 2 : 0; });
        return storeyHeights("s", volume)->source;
    };
    EXPECT_EQ(sourceAt(1.5), FloorSource::Declared);
    EXPECT_EQ(sourceAt(1.95), FloorSource::Declared);
    EXPECT_EQ(sourceAt(2.1), FloorSource::Slabs);
    EXPECT_EQ(sourceAt(1.05), FloorSource::Declared);
    EXPECT_EQ(sourceAt(0.9), FloorSource::Slabs);
}

// A flat of two storeys is a member of both. Its rooms belong to the storeys that they are members of.
TEST(StoreyFloors, ARoomBelongsToItsNearestStorey) {
    Boxes boxes;
    addStorey(boxes, "lower");
    addStorey(boxes, "upper");
    volume::test::addGroup(boxes.volume, "flat", "BuildingUnit").groups = {0, 1};
    boxes.addBox("hall", "BuildingRoom", {0, 0, 0}, {4, 4, 2.5});
    boxes.volume.labels.labels.back().groups = {2, 0};
    boxes.addBox("loft", "BuildingRoom", {0, 0, 3}, {8, 8, 5.5});
    boxes.volume.labels.labels.back().groups = {2, 1};
    EXPECT_EQ(storeysOfLabels(boxes.volume.labels), (std::vector<std::uint32_t>{0, 1, 0, 0, 1}));
    EXPECT_NEAR(storeyHeights("lower", boxes.volume)->floor, 0, 2e-6);
    EXPECT_NEAR(storeyHeights("upper", boxes.volume)->floor, 3, 2e-6);
}

}  // namespace
}  // namespace svt::drawing
