/// Chains of a house of boxes whose lengths are known.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::drawing {
namespace {

//   +=====================+   6.0
//   |         |           |
//   |  left   |   right   |         walls of 0.3 m, the one between the rooms 0.2 m
//   |         |           |
//   +===[  ]==+===========+   0.0   a window from 1.0 to 2.2 m, 0.1 m thick in the middle of the wall
//   0                     8
Boxes house() {
    Boxes boxes;
    boxes.addBox("left", "BuildingRoom", {0.3, 0.3, 0}, {3.0, 5.7, 3});
    boxes.addBox("right", "BuildingRoom", {3.2, 0.3, 0}, {7.7, 5.7, 3});
    boxes.addBox("south-west", "BuildingConstructiveElement", {0, 0, 0}, {1, 0.3, 3});
    boxes.addBox("south-east", "BuildingConstructiveElement", {2.2, 0, 0}, {8, 0.3, 3});
    boxes.addBox("window", "Window", {1, 0.1, 0}, {2.2, 0.2, 3});
    boxes.addBox("north", "BuildingConstructiveElement", {0, 5.7, 0}, {8, 6, 3});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0.3, 0}, {0.3, 5.7, 3});
    boxes.addBox("east", "BuildingConstructiveElement", {7.7, 0.3, 0}, {8, 5.7, 3});
    boxes.addBox("between", "BuildingConstructiveElement", {3, 0.3, 0}, {3.2, 5.7, 3});
    boxes.addBox("table", "BuildingFurniture", {0.3, 0.3, 0}, {2, 1, 3});
    return boxes;
}

SectionDrawing planOf(const Boxes& boxes) {
    SectionOptions options;
    options.dimensions = true;
    return *drawSection(boxes.volume, {{0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 1.2}}, options);
}

/// The chains of a side from the building outwards, lengths in millimetres.
std::vector<std::vector<long>> chainsOf(const SectionDrawing& drawing, DimensionSide side) {
    std::vector<std::vector<long>> chains;
    for (const DimensionChain& chain : drawing.dimensions) {
        if (chain.side != side) continue;
        EXPECT_EQ(chain.row, static_cast<int>(chains.size()));
        chains.emplace_back();
        for (std::size_t n = 0; n + 1 < chain.stops.size(); ++n)
            chains.back().push_back(std::lround(1000 * (chain.stops[n + 1] - chain.stops[n])));
    }
    return chains;
}

using Chains = std::vector<std::vector<long>>;

TEST(Dimensions, OpeningsRoomsAndOverallFromTheSideThatHasThem) {
    const SectionDrawing drawing = planOf(house());
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Below),
              (Chains{{1000, 1200, 5800}, {300, 2700, 200, 4500, 300}, {8000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Above), (Chains{{300, 2700, 200, 4500, 300}, {8000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Left), (Chains{{300, 5400, 300}, {6000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Right), (Chains{{300, 5400, 300}, {6000}}));
}

// The niche of a window near the corner is open towards the room, but no room begins there.
TEST(Dimensions, NichesInWallsAlongTheSightAreNoRooms) {
    Boxes boxes = house();
    const SectionDrawing drawing = planOf(boxes);
    // Seen from the west: the south wall is 0.3 m thick, though behind the window air begins at 0.2 m.
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Left).front(), (std::vector<long>{300, 5400, 300}));
}

// A handle of a door that reaches into the room is no wall.
TEST(Dimensions, WhatIsNarrowDividesNothing) {
    Boxes boxes = house();
    boxes.addBox("handle", "Window", {1.6, 0.2, 0}, {1.61, 5.7, 3});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below),
              (Chains{{1000, 1200, 5800}, {300, 2700, 200, 4500, 300}, {8000}}));
}

TEST(Dimensions, StepsOfTheFaceHaveStops) {
    Boxes boxes;
    boxes.addBox("a", "Building", {0, 0, 0}, {3, 4, 3});
    boxes.addBox("b", "Building", {3, 1, 0}, {7, 4, 3});
    const SectionDrawing drawing = planOf(boxes);
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Below), (Chains{{3000, 4000}, {7000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Above), (Chains{{7000}}));
}

TEST(Dimensions, ObliqueBuildingsHaveTheirOverallLengthOnly) {
    Boxes boxes;
    boxes.addLabel("turned", "Building", volume::Filling::Solid, 1);
    const Vec3d a{3, 0.5, 0}, b{6, 3.5, 0}, c{3, 6.5, 0}, d{0, 3.5, 0}, up{0, 0, 3};
    boxes.addQuad({a, d, c, b});
    boxes.addQuad({a + up, b + up, c + up, d + up});
    const std::array<Vec3d, 4> corners{a, b, c, d};
    for (std::size_t n = 0; n < 4; ++n) {
        const Vec3d p = corners[n], q = corners[(n + 1) % 4];
        boxes.addQuad({p, q, q + up, p + up});
    }
    const SectionDrawing drawing = planOf(boxes);
    for (const DimensionSide side :
         {DimensionSide::Below, DimensionSide::Right, DimensionSide::Above, DimensionSide::Left})
        EXPECT_EQ(chainsOf(drawing, side), (Chains{{6000}}));
}

TEST(Dimensions, UprightSectionsHaveNone) {
    const Boxes boxes = house();
    SectionOptions options;
    options.dimensions = true;
    const auto drawing = drawSection(boxes.volume, {{1, 0, 0}, boxes.volume.grid.origin() + Vec3d{4, 0, 0}}, options);
    EXPECT_TRUE(drawing->dimensions.empty());
}

}  // namespace
}  // namespace svt::drawing
