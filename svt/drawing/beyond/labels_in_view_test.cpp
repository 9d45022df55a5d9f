/// The work for a plan of a tower does not grow with the number of storeys, and nothing visible is left out.

#include <svt/drawing/beyond/labels_in_view.hpp>
#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/exact/mesh_cut.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace svt::drawing {
namespace {

constexpr double kStorey = 3;  // metres

/// Storeys of 10 x 8 m: a slab of 0.3 m, four walls of 0.3 m between the slabs, and two cupboards.
Boxes towerOf(int storeys) {
    Boxes boxes;
    const auto wall = [&](const std::string& id, Vec3d low, Vec3d high) {
        boxes.addBox(id, "BuildingConstructiveElement", low, high);
    };
    for (int n = 0; n < storeys; ++n) {
        const double z = n * kStorey, top = z + kStorey;
        const std::string of = std::to_string(n);
        wall("slab" + of, {0, 0, z}, {10, 8, z + 0.3});
        wall("south" + of, {0, 0, z + 0.3}, {10, 0.3, top});
        wall("north" + of, {0, 7.7, z + 0.3}, {10, 8, top});
        wall("west" + of, {0, 0.3, z + 0.3}, {0.3, 7.7, top});
        wall("east" + of, {9.7, 0.3, z + 0.3}, {10, 7.7, top});
        boxes.addBox("cupboard" + of, "BuildingFurniture", {1, 1, z + 0.3}, {2, 2, z + 2});
        boxes.addBox("shelf" + of, "BuildingFurniture", {4, 1, z + 1.6}, {5, 2, z + 2});
    }
    return boxes;
}

SectionDrawing planOf(const Boxes& boxes, int storey, BeyondOptions beyond) {
    SectionOptions options;
    options.beyond = beyond;
    options.threads = 1;
    const Vec3d point = boxes.volume.grid.origin() + Vec3d{0, 0, storey * kStorey + 1.4};
    return *drawSection(boxes.volume, {{0, 0, 1}, point}, options);
}

std::size_t needed(const Boxes& boxes, int storey, bool looksAtCut, double depth) {
    const SectionDrawing plan = planOf(boxes, storey, {});
    const DrawingTables tables(boxes.volume);
    const std::vector<std::uint8_t> isDrawn(boxes.volume.labels.labels.size(), 1);
    const ViewOptions view{.looksAtCut = looksAtCut};
    MeshProjection projection(boxes.volume, plan.plane, plan.axes, isDrawn, view, tables);
    const auto labels = labelsInView(boxes.volume, plan, view, depth, tables, projection);
    return static_cast<std::size_t>(std::count(labels.begin(), labels.end(), 1));
}

std::size_t visited(const Boxes& boxes, int storey) {
    const SectionDrawing plan = planOf(boxes, storey, {});
    const DrawingTables tables(boxes.volume);
    return cutMeshes(boxes.volume.vectors, boxes.volume.grid.origin(), plan.axes, false, tables.runs()).visited;
}

std::vector<BeyondLine> aboveOf(const Boxes& boxes, int storey) {
    return planOf(boxes, storey, {.visible = true, .above = true, .depth = 4}).beyond;
}

TEST(LabelsInView, OfAPlanDoNotGrowWithTheStoreys) {
    const Boxes low = towerOf(20), high = towerOf(40);
    for (const int storey : {5, 15}) {
        EXPECT_EQ(needed(low, storey, true, 0), needed(high, storey, true, 0)) << storey;
        EXPECT_LE(needed(high, storey, true, 0), 3u * 7) << storey;
        EXPECT_LE(needed(high, storey, false, 4), 3u * 7) << storey;
        EXPECT_EQ(visited(low, storey), visited(high, storey)) << storey;
        EXPECT_LE(visited(high, storey), 7u * 12) << storey;
    }
}

// Only hidden labels are left out: a plan does not depend on storeys that it does not show.
TEST(LabelsInView, ChangeNothingInThePlan) {
    const std::vector<BeyondLine> few = aboveOf(towerOf(7), 5);
    EXPECT_FALSE(few.empty());
    EXPECT_EQ(aboveOf(towerOf(40), 5), few);
}

// A canopy high above, and a mast beside the tower, are seen from each plan below.
TEST(LabelsInView, KeepWhatProjects) {
    Boxes boxes = towerOf(40);
    boxes.addBox("canopy", "BuildingInstallation", {9, 3, 90.5}, {11, 5, 90.7});
    boxes.addBox("mast", "BuildingInstallation", {20, 3, 60}, {20.5, 3.5, 100});
    const auto lengthOf = [&](std::uint32_t label) {
        double length = 0;
        for (const BeyondLine& line : aboveOf(boxes, 5))
            if (line.label == label && line.kind == BeyondKind::Above)
                length += std::hypot(line.to.u - line.from.u, line.to.v - line.from.v);
        return length;
    };
    const auto labels = static_cast<std::uint32_t>(boxes.volume.labels.labels.size());
    EXPECT_NEAR(lengthOf(labels - 2), 1 + 2 + 1, 1e-4);
    EXPECT_NEAR(lengthOf(labels - 1), 4 * 0.5, 1e-4);
}

// A gap of 1 mm between slab and wall shows what is above.
TEST(LabelsInView, KeepWhatIsSeenThroughAGap) {
    Boxes boxes;
    for (const double x : {0.0, 5.001})
        boxes.addBox("slab" + std::to_string(x), "BuildingConstructiveElement", {x, 0, 3}, {x + 5, 8, 3.3});
    // None lies over another one.
    for (int n = 2; n < 20; ++n)
        boxes.addBox("beam" + std::to_string(n), "BuildingInstallation", {4, 0.35 * n, n * 3.0},
                     {6, 0.35 * n + 0.2, n * 3.0 + 0.2});
    EXPECT_EQ(needed(boxes, 0, true, 0), boxes.volume.labels.labels.size());
}

// A stair in a well: flights of 1.2 m on both sides of a gap of 0.4 m, through which nothing else is seen.
Boxes stairwellOf(int storeys) {
    Boxes boxes;
    for (int n = 0; n < storeys; ++n) {
        const double z = n * kStorey;
        const std::string of = std::to_string(n);
        boxes.addBox("slab" + of, "BuildingConstructiveElement", {0, 0, z}, {10, 8, z + 0.3});
        const auto label = static_cast<std::uint32_t>(boxes.volume.labels.labels.size());
        boxes.addBox("stair" + of, "BuildingInstallation", {12, 0, z}, {13.2, 4, z + 0.5});
        boxes.addBox("flight" + of, "BuildingInstallation", {13.6, 0, z + 1}, {14.8, 4, z + 1.5});
        // Both flights are one object, whose hull spans the gap.
        boxes.volume.labels.labels.pop_back();
        for (auto& triangle : boxes.volume.vectors.triangles) triangle.label = std::min(triangle.label, label);
    }
    return boxes;
}

TEST(LabelsInView, LeaveOutStairsBehindStairs) {
    const Boxes low = stairwellOf(20), high = stairwellOf(40);
    EXPECT_EQ(needed(low, 5, true, 0), needed(high, 5, true, 0));
    EXPECT_LE(needed(high, 5, true, 0), 3u * 2);
    EXPECT_FALSE(aboveOf(high, 5).empty());
    EXPECT_EQ(aboveOf(stairwellOf(9), 5), aboveOf(high, 5));
}

// Labels of equal storeys share the points of their hull.
TEST(DrawingTables, EqualStoreysHaveEqualShapes) {
    const Boxes low = towerOf(3), high = towerOf(30);
    const DrawingTables few(low.volume), many(high.volume);
    EXPECT_EQ(few.plans().shapes, many.plans().shapes);
    EXPECT_EQ(few.plans().points.size(), many.plans().points.size());
    EXPECT_EQ(many.plans().labels[0].shape, many.plans().labels[7].shape);
    EXPECT_NE(many.plans().labels[0].shape, many.plans().labels[1].shape);
}

}  // namespace
}  // namespace svt::drawing
