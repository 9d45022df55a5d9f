/// Floors of boxes: of rooms with recesses, of storeys with and without rooms; of voxels to one voxel.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/section/two_storeys_test.hpp>
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

// A storey; what is added from here on stands on it.
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

}  // namespace
}  // namespace svt::drawing
