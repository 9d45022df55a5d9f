/// Drawings cropped to the building: terrain ends beside it, and the building keeps every part.

#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/exact/boxes_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace svt::drawing {
namespace {

std::pair<PlanePoint, PlanePoint> extentOfBorders(const SectionDrawing& drawing) {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const SectionBorder& border : drawing.borders)
        for (const PlanePoint p : border.points) {
            low = {std::min(low.u, p.u), std::min(low.v, p.v)};
            high = {std::max(high.u, p.u), std::max(high.v, p.v)};
        }
    return {low, high};
}

Boxes houseInItsGarden() {
    Boxes boxes;
    boxes.addBox("house", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addBox("terrace", "BuildingInstallation", {8, 0, 0}, {12, 6, 3});
    boxes.addBox("terrain", "TINRelief", {-50, -50, 0}, {-0.5, 60, 3});
    boxes.addBox("tree", "SolitaryVegetationObject", {30, 2, 0}, {31, 3, 3});
    return boxes;
}

TEST(BuildingCrop, TerrainEndsBesideTheBuilding) {
    const Boxes boxes = houseInItsGarden();
    const SectionDrawing drawing = boxes.cut({0, 0, 1}, {0, 0, 1});
    const SectionDrawing cropped = croppedToBuilding(drawing, boxes.volume);
    // 12 x 6 m with a margin of 1 m.
    const auto [low, high] = extentOfBorders(cropped);
    EXPECT_NEAR(low.u, -0.5, 1e-5) << "the edge of the terrain";
    EXPECT_NEAR(low.v, -1, 1e-5);
    EXPECT_NEAR(high.u, 12, 1e-5);
    EXPECT_NEAR(high.v, 7, 1e-5);
    for (const SectionComponent& component : cropped.components) {
        const std::string& id = boxes.volume.labels.labels[component.label].id;
        const double area = id == "house" ? 48 : id == "terrace" ? 24 : id == "terrain" ? 0.5 * 8 : 0;
        EXPECT_NEAR(component.area, area, 1e-4) << id;
    }
}

// The crop ends at 13 m: a plan has whole trees only, a section cuts them off.
TEST(BuildingCrop, PlansHaveWholeTreesOnly) {
    Boxes boxes = houseInItsGarden();
    boxes.addBox("near", "SolitaryVegetationObject", {12.2, 1, 0}, {12.8, 2, 3});
    boxes.addBox("at the edge", "SolitaryVegetationObject", {12.2, 3, 0}, {13.8, 4, 3});
    boxes.addBox("hedge", "PlantCover", {12.2, 5, 0}, {13.8, 6, 3});
    const auto areaOf = [&](const SectionDrawing& drawing, const std::string& id) {
        for (const SectionComponent& component : drawing.components)
            if (boxes.volume.labels.labels[component.label].id == id) return component.area;
        return 0.0;
    };
    const SectionDrawing plan = croppedToBuilding(boxes.cut({0, 0, 1}, {0, 0, 1}), boxes.volume);
    EXPECT_NEAR(areaOf(plan, "near"), 0.6, 1e-4);
    EXPECT_EQ(areaOf(plan, "at the edge"), 0);
    EXPECT_NEAR(areaOf(plan, "hedge"), 0.8, 1e-4);
    for (const SectionBorder& border : plan.borders)
        for (const std::uint32_t label : {border.left, border.right})
            EXPECT_NE(label == volume::kNoLabel ? "" : boxes.volume.labels.labels[label].id, "at the edge");
    const SectionDrawing section = croppedToBuilding(boxes.cut({0, -1, 0}, {0, 3.5, 0}), boxes.volume);
    EXPECT_NEAR(areaOf(section, "at the edge"), 0.8 * 3, 1e-4);
}

TEST(BuildingCrop, WithoutSurroundingsOrWithoutABuildingNothingChanges) {
    Boxes house, hill;
    house.addBox("house", "Building", {0, 0, 0}, {8, 6, 3});
    hill.addBox("hill", "TINRelief", {0, 0, 0}, {80, 60, 3});
    for (const Boxes* boxes : {&house, &hill}) {
        const SectionDrawing drawing = boxes->cut({0, 0, 1}, {0, 0, 1});
        const SectionDrawing cropped = croppedToBuilding(drawing, boxes->volume);
        ASSERT_EQ(cropped.borders.size(), drawing.borders.size());
        EXPECT_EQ(cropped.borders.front().points, drawing.borders.front().points);
        EXPECT_EQ(cropped.components.front().area, drawing.components.front().area);
    }
}

// A house of 8 x 6 m with walls on a storey, label 1.
Boxes houseOnAStorey() {
    Boxes boxes;
    volume::test::addGroup(boxes.volume, "building", "Building");
    volume::test::addGroup(boxes.volume, "storey", "Storey", 0);
    for (const auto& [id, low, high] : {std::tuple("south", Vec3d{0, 0, 0}, Vec3d{8, 0.3, 3}),
                                        std::tuple("north", Vec3d{0, 5.7, 0}, Vec3d{8, 6, 3})}) {
        boxes.addBox(id, "BuildingConstructiveElement", low, high);
        boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcWall"), ""});
        boxes.volume.labels.labels.back().parent = 1;
    }
    return boxes;
}

void addTyped(Boxes& boxes, const char* id, const char* type, Vec3d low, Vec3d high) {
    boxes.addBox(id, "BuildingConstructiveElement", low, high);
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string(type), ""});
}

TEST(BuildingCrop, SmallPartsAwayFromTheBuildingDecideNoScale) {
    Boxes boxes = houseOnAStorey();
    addTyped(boxes, "geo-reference", "IfcBuildingElementProxy", {2, -35, 0}, {2.5, -34.5, 3});
    addTyped(boxes, "bench", "IfcFurniture", {8.5, 2, 0}, {9.5, 3, 3});
    addTyped(boxes, "bench beside it", "IfcFurniture", {11, 2, 0}, {12, 3, 3});
    addTyped(boxes, "pavilion", "IfcBuildingElementProxy", {20, 0, 0}, {24, 4, 3});
    EXPECT_EQ(partsAwayFromBuilding(boxes.volume), std::vector<std::uint32_t>{4});
    const auto [low, high] = extentOfBorders(croppedToBuilding(boxes.cut({0, 0, 1}, {0, 0, 1}), boxes.volume));
    EXPECT_NEAR(low.v, 0, 1e-5);
    EXPECT_NEAR(high.u, 24, 1e-5) << "large parts belong to the building";
}

TEST(BuildingCrop, APlotEndsBesideTheBuildingAndASlabOfTheSiteDoesNot) {
    Boxes boxes = houseOnAStorey();
    addTyped(boxes, "plot", "IfcSlab", {-20, -20, 0}, {20, 30, 3});
    addTyped(boxes, "slab", "IfcSlab", {0, 0, 0}, {9, 6.5, 3});
    const SectionDrawing drawing = boxes.cut({0, 0, 1}, {0, 0, 1});
    const auto [low, high] = extentOfBorders(croppedToBuilding(drawing, boxes.volume));
    EXPECT_NEAR(low.u, 0, 1e-5) << "the edges of the plot are cut off";
    EXPECT_NEAR(high.u, 9, 1e-5);
    EXPECT_NEAR(high.v, 6.5, 1e-5);
    EXPECT_TRUE(partsAwayFromBuilding(boxes.volume).empty());
}

}  // namespace
}  // namespace svt::drawing
