/// Bodies in the plane, and exact drawings of boxes whose areas are known.

#include <svt/drawing/exact/body_cells.hpp>
#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/plane/region_areas_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kTestUnit = 1e-5;

/// Areas (m2) of the bodies in a square of 1 m.
std::map<std::uint32_t, double> bodyAreas(const std::vector<BodyFace>& faces) {
    const plane::TestRing square{{0, 0}, {100000, 0}, {100000, 100000}, {0, 100000}};
    std::vector<MaterialEdge> material;
    for (std::size_t n = 0; n < 4; ++n) material.emplace_back(square[n], square[(n + 1) % 4]);
    std::vector<plane::ClaimSegment> segments =
        divideBodies(faces, material, {{kTestUnit, 0, 0}, {0, kTestUnit, 0}}, kTestUnit);
    for (plane::ClaimSegment& body : segments) body.claim += 1;
    // What lies around the material belongs to claim 0.
    plane::addRing({{-9000000, -9000000}, {9000000, -9000000}, {9000000, 9000000}, {-9000000, 9000000}}, 0, segments);
    for (std::size_t n = 0; n < 4; ++n) segments.push_back({square[(n + 1) % 4], square[n], 0, 1});
    std::map<std::uint32_t, double> areas;
    for (const auto& [claim, area] : plane::areasOf(segments, 2))
        if (claim != 0) areas[claim - 1] = area * kTestUnit * kTestUnit;
    return areas;
}

TEST(BodyCells, ACornerOfTwoWallsIsMitred) {
    // Surfaces along the left and the lower side of the material: the border is the diagonal.
    const auto areas = bodyAreas({{{0, 0, -5}, {0, 1, -5}, {0, 1, 5}, 0},
                                  {{0, 0, -5}, {0, 1, 5}, {0, 0, 5}, 0},
                                  {{0, 0, -5}, {1, 0, -5}, {1, 0, 5}, 1},
                                  {{0, 0, -5}, {1, 0, 5}, {0, 0, 5}, 1}});
    EXPECT_NEAR(areas.at(0), 0.5, 2e-4);
    EXPECT_NEAR(areas.at(1), 0.5, 2e-4);
}

TEST(BodyCells, BetweenAWallAndAPostTheBorderIsAParabola) {
    const auto areas = bodyAreas({{{0, -9, -5}, {0, 9, -5}, {0, 9, 5}, 0},
                                  {{0, -9, -5}, {0, 9, 5}, {0, -9, 5}, 0},
                                  {{1, 0.5, -5}, {1, 0.5, 0}, {1, 0.5, 5}, 1}});
    // x = (1 + (y - 1/2)^2) / 2
    EXPECT_NEAR(areas.at(0), 0.5 + 1.0 / 24, 2e-5);
    EXPECT_NEAR(areas.at(1), 0.5 - 1.0 / 24, 2e-5);
}

double areaOf(const SectionDrawing& drawing, std::uint32_t label) {
    for (const SectionComponent& component : drawing.components)
        if (component.label == label) return component.area;
    return 0;
}

TEST(ExactSection, BoxesHaveTheirAreasByPriority) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0.2}, {7.7, 5.7, 2.8});
    boxes.addBox("table", "BuildingFurniture", {1, 1, 0.2}, {2.5, 1.7, 0.9});
    const SectionDrawing plan = boxes.cut({0, 0, 1}, {0, 0, 0.5});
    ASSERT_EQ(plan.components.size(), 3u);
    EXPECT_NEAR(areaOf(plan, 2), 1.5 * 0.7, 2e-5);
    EXPECT_NEAR(areaOf(plan, 1), 7.4 * 5.4 - 1.5 * 0.7, 1e-4);
    EXPECT_NEAR(areaOf(plan, 0), 48 - 7.4 * 5.4, 1e-4);
    for (const SectionComponent& component : plan.components) {
        EXPECT_TRUE(component.isExact);
        EXPECT_LT(component.areaBound, 1e-3);
        ASSERT_EQ(component.polygons.size(), 1u);
        EXPECT_EQ(component.polygons[0].outer.size(), 4u);
    }
    EXPECT_EQ(plan.borders.size(), 3u);
    // An oblique plane: the building's area by its projection.
    const SectionDrawing oblique = boxes.cut({0, 0.6, 0.8}, {4, 3, 1.5});
    EXPECT_NEAR(oblique.area, 8 * (3 / 0.6), 1e-4);
}

TEST(ExactSection, APlaneInFacesDrawsWhatIsKept) {
    Boxes boxes;
    boxes.addBox("lower", "WallSurface", {0, 0, 0}, {4, 4, 2});
    boxes.addBox("upper", "WallSurface", {0, 0, 2}, {3, 3, 4});
    const SectionDrawing below = boxes.cut({0, 0, 1}, {0, 0, 2}), above = boxes.cut({0, 0, -1}, {0, 0, 2});
    EXPECT_GT(below.edgesInPlane, 0u);
    EXPECT_EQ(below.planeShift, 0);
    EXPECT_NEAR(below.area, 16, 1e-4);
    EXPECT_NEAR(areaOf(below, 0), 16, 1e-4);
    EXPECT_NEAR(above.area, 9, 1e-4);
    EXPECT_NEAR(areaOf(above, 1), 9, 1e-4);
    // Nearly in the plane: moved clear of it.
    const SectionDrawing near = boxes.cut({0, 0, 1}, {0, 0, 2.0001});
    EXPECT_GT(near.planeShift, 0);
    EXPECT_NEAR(areaOf(near, 0), 16, 1e-4);
    Diagnostics log;
    reportSection(near, boxes.volume, log);
    EXPECT_EQ(log.count(Severity::Note), 1u);
}

TEST(ExactSection, SheetsAreLinesWhereNothingFinerCoversThem) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    boxes.addLabel("wall", "WallSurface", volume::Filling::Surface, 0);
    boxes.addQuad({Vec3d{0, 0, 0}, Vec3d{8, 0, 0}, Vec3d{8, 0, 3}, Vec3d{0, 0, 3}});
    boxes.addBox("door", "Door", {2, -0.1, 0}, {3, 0.1, 2});
    const SectionDrawing plan = boxes.cut({0, 0, 1}, {0, 0, 1.03});
    double length = 0;
    for (const SectionComponent& component : plan.components)
        if (component.label == 1) length = component.lineLength;
    EXPECT_NEAR(length, 7, 1e-4);
    EXPECT_EQ(plan.lines.size(), 2u);
    EXPECT_NEAR(areaOf(plan, 0), 48 - 0.1, 1e-4);
    EXPECT_NEAR(areaOf(plan, 1), 0, 0);
}

TEST(ExactSection, DrawingsOfMeshesCanBeRefused) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    SectionOptions options;
    options.useMeshes = false;
    const SectionPlane plane{{0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 1}};
    SectionDrawing drawing = *drawSection(boxes.volume, plane, options);
    EXPECT_TRUE(drawing.components.empty());
    // What was wished for is not told; what did not succeed is, and shells are not blamed for it.
    drawing.components.emplace_back();
    Diagnostics log;
    reportSection(drawing, boxes.volume, log);
    EXPECT_TRUE(log.items().empty());
    drawing.isUnsettled = true;
    reportSection(drawing, boxes.volume, log);
    ASSERT_EQ(log.items().size(), 1u);
    EXPECT_EQ(log.items()[0].code, Code::DrawnByVoxels);
    EXPECT_EQ(log.items()[0].message.find("open"), std::string::npos);
    EXPECT_TRUE(boxes.cut({0, 0, 1}, {0, 0, 1}).isFromMeshes);
}

TEST(ExactSection, UncertainAreasComeWithARemedyThatIsNotInUse) {
    Boxes boxes;
    boxes.addBox("building", "Building", {0, 0, 0}, {8, 6, 3});
    SectionDrawing drawing;
    SectionComponent component;
    component.area = 1;
    component.areaBound = 2;
    const auto messageOf = [&](bool isFromMeshes, bool isExact) {
        component.isExact = isExact;
        drawing.components = {component};
        drawing.isFromMeshes = isFromMeshes;
        Diagnostics log;
        reportSection(drawing, boxes.volume, log);
        for (const Diagnostic& item : log.items())
            if (item.code == Code::UncertainArea) return item.message;
        return std::string();
    };
    EXPECT_NE(messageOf(false, false).find("give the model itself"), std::string::npos);
    EXPECT_EQ(messageOf(true, false).find("the model itself"), std::string::npos) << "its meshes were cut already";
    EXPECT_NE(messageOf(true, false).find("shells are open"), std::string::npos);
    EXPECT_EQ(messageOf(true, true).find("spacing"), std::string::npos) << "voxels do not decide an exact area";
    EXPECT_NE(messageOf(true, true).find("move the plane"), std::string::npos);
}

}  // namespace
}  // namespace svt::drawing
