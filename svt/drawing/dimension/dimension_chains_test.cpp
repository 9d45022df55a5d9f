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

// A window without a body leaves a gap in the wall behind the room: the room still ends there.
TEST(Dimensions, RoomsBeforeAGapInTheWallAreRooms) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.3, 0.3, 0}, {7.7, 5.7, 3});
    boxes.addBox("south-west", "BuildingConstructiveElement", {0, 0, 0}, {1, 0.3, 3});
    boxes.addBox("south-east", "BuildingConstructiveElement", {2.2, 0, 0}, {8, 0.3, 3});
    boxes.addBox("north", "BuildingConstructiveElement", {0, 5.7, 0}, {8, 6, 3});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0.3, 0}, {0.3, 5.7, 3});
    boxes.addBox("east", "BuildingConstructiveElement", {7.7, 0.3, 0}, {8, 5.7, 3});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Above), (Chains{{300, 7400, 300}, {8000}}));
    // A window that is a surface closes the gap: before, the chain below had stops of the wall behind the room.
    boxes.addLabel("window", "Window", volume::Filling::Surface, 0);
    boxes.addQuad({Vec3d{1, 0.1, 0.5}, {2.2, 0.1, 0.5}, {2.2, 0.1, 2.5}, {1, 0.1, 2.5}});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below), (Chains{{1000, 1200, 5800}, {300, 7400, 300}, {8000}}));
}

// A pane at the inner side of the wall does not end the room behind it.
TEST(Dimensions, PanesAtTheInnerSideOfAWallHaveNoStopsOfRooms) {
    Boxes boxes = house();
    boxes.addLabel("pane", "Window", volume::Filling::Surface, 0);
    boxes.addQuad({Vec3d{1, 0.35, 0.5}, {2.2, 0.35, 0.5}, {2.2, 0.35, 2.5}, {1, 0.35, 2.5}});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below),
              (Chains{{1000, 1200, 5800}, {300, 2700, 200, 4500, 300}, {8000}}));
}

// Without rooms in the model, the air in a niche beside a corner continues the air of the room.
TEST(Dimensions, NichesInWallsAlongTheSightAreNoAirOfRooms) {
    Boxes boxes;
    boxes.addBox("north", "BuildingConstructiveElement", {0, 5.8, 0}, {8, 6, 3});
    boxes.addBox("south", "BuildingConstructiveElement", {0, 0, 0}, {8, 0.2, 3});
    boxes.addBox("east", "BuildingConstructiveElement", {7.8, 0.2, 0}, {8, 5.8, 3});
    boxes.addBox("west, beside the corner", "BuildingConstructiveElement", {0, 5.5, 0}, {0.2, 5.8, 3});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0.2, 0}, {0.2, 4.5, 3});
    boxes.addBox("window", "Window", {0, 4.5, 0}, {0.05, 5.5, 3});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Above), (Chains{{200, 7600, 200}, {8000}}));
}

// A rafter that is let into the wall has no stops.
TEST(Dimensions, NotchesOfRaftersHaveNoStops) {
    Boxes boxes = house();
    boxes.addBox("rafter", "BuildingFurniture", {5, 5.8, 0}, {5.08, 6.2, 3});
    boxes.volume.labels.labels.back().volume = 1e-3;
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Above), (Chains{{300, 2700, 200, 4500, 300}, {8000}}));
}

// The plan of an attic cuts the roof where it happens to meet it, and beyond the gables.
TEST(Dimensions, RoofsAreNotMeasuredInPlansWithWalls) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0.3, 0.5, 0}, {7.7, 5.5, 3});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0.5, 0}, {0.3, 5.5, 3});
    boxes.addBox("east", "BuildingConstructiveElement", {7.7, 0.5, 0}, {8, 5.5, 3});
    boxes.addBox("roof 1", "BuildingConstructiveElement", {-0.5, 0, 0}, {8.5, 0.5, 3});
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcRoof"), ""});
    boxes.addBox("Dach-2", "BuildingConstructiveElement", {-0.5, 5.5, 0}, {8.5, 6, 3});
    boxes.volume.labels.labels.back().name = "Dach-2";
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcSlab"), ""});
    // A rafter between the roof and the gable.
    boxes.addBox("rafter", "BuildingConstructiveElement", {-0.2, 0.5, 0}, {0, 0.7, 3});
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcMember"), ""});
    const SectionDrawing drawing = planOf(boxes);
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Below).back(), (std::vector<long>{8000}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Left).back(), (std::vector<long>{5000}));
    // A roof over walls that are only those of a part of the house is measured.
    boxes.addBox("far roof", "BuildingConstructiveElement", {-0.5, 6, 0}, {20, 14, 3});
    boxes.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcRoof"), ""});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below).back(), (std::vector<long>{20500}));
}

// A handle of a door that reaches into the room is not a wall.
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

// A building of upright walls over a polygon.
Boxes prism(const std::vector<Vec3d>& corners) {
    Boxes boxes;
    boxes.addLabel("prism", "Building", volume::Filling::Solid, 1);
    const Vec3d up{0, 0, 3};
    const std::size_t count = corners.size();
    for (std::size_t n = 1; n + 2 < count; n += 2) {
        boxes.addQuad({corners[0], corners[(n + 2) % count], corners[n + 1], corners[n]});
        boxes.addQuad({corners[0] + up, corners[n] + up, corners[n + 1] + up, corners[(n + 2) % count] + up});
    }
    for (std::size_t n = 0; n < count; ++n) {
        const Vec3d p = corners[n], q = corners[(n + 1) % count];
        boxes.addQuad({p, q, q + up, p + up});
    }
    return boxes;
}

// Nobody measures the rectangle around a turned house.
TEST(Dimensions, TurnedBuildingsHaveNoChains) {
    const SectionDrawing drawing = planOf(prism({{3, 0.5, 0}, {6, 3.5, 0}, {3, 6.5, 0}, {0, 3.5, 0}}));
    EXPECT_TRUE(drawing.dimensions.empty());
    EXPECT_EQ(drawing.chainsLeftOut, ChainsLeftOut::TurnedWalls);
    const SectionDrawing* const one = &drawing;
    EXPECT_NE(leftOutChains(std::span(&one, 1)).find("--axes building"), std::string::npos);
}

// Six sides, no two of which are parallel or at a right angle.
TEST(Dimensions, BuildingsWithoutMainDirectionHaveTheirOverallLengthOnly) {
    const SectionDrawing drawing =
        planOf(prism({{2, 0, 0}, {5, 0.7, 0}, {6, 3, 0}, {4.5, 5.5, 0}, {1.5, 5, 0}, {0, 2.5, 0}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Below), (Chains{{6000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Left), (Chains{{5500}}));
    EXPECT_EQ(drawing.chainsLeftOut, ChainsLeftOut::No);
}

// A casing of 50 mm around the window, 25 mm before the wall, and a shutter on the east wall.
TEST(Dimensions, OpeningsAreGapsInWallsAndCasingsDoNotCount) {
    Boxes boxes = house();
    boxes.addBox("casing west", "Window", {0.95, -0.025, 0}, {1.0, 0.1, 3});
    boxes.addBox("casing east", "Window", {2.2, -0.025, 0}, {2.25, 0.1, 3});
    boxes.addBox("shutter", "Window", {8, 2, 0}, {8.05, 3, 3});
    boxes.addBox("box of the shutter", "Window", {-0.15, 2, 0}, {0, 3, 3});
    const SectionDrawing drawing = planOf(boxes);
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Below),
              (Chains{{1000, 1200, 5800}, {300, 2700, 200, 4500, 300}, {8000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Right), (Chains{{300, 5400, 300}, {6000}}));
    EXPECT_EQ(chainsOf(drawing, DimensionSide::Left), (Chains{{300, 5400, 300}, {6000}}));
}

// A partition that ends at the glass does not divide the opening.
TEST(Dimensions, AWallBehindAWindowIsNotItsCasing) {
    Boxes boxes = house();
    boxes.addBox("partition", "BuildingConstructiveElement", {1.4, 0.2, 0}, {1.6, 5.7, 3});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below).front(), (std::vector<long>{1000, 1200, 5800}));
}

// Through the gap between the leaves of a door one sees the wall at the other end of the room.
TEST(Dimensions, ASlitBetweenTwoLeavesIsNotAWall) {
    Boxes boxes = house();
    boxes.addBox("leaf", "Door", {4, 0, 0}, {4.798, 0.3, 3});
    boxes.addBox("other leaf", "Door", {4.802, 0, 0}, {5.6, 0.3, 3});
    boxes.volume.labels.labels[3].volume = 20;  // the wall is the larger one, so it gives way
    const auto chains = chainsOf(planOf(boxes), DimensionSide::Below);
    EXPECT_EQ(chains[1], (std::vector<long>{300, 2700, 200, 4500, 300}));
}

// The casings of a door in the east wall of one building project into the yard before another.
TEST(Dimensions, CasingsSeenFromTheirEdgeDoNotCount) {
    Boxes boxes = house();
    boxes.addBox("casing", "Door", {8, 2, 0}, {8.025, 3, 3});
    boxes.addBox("other house", "Building", {12, 0, 0}, {16, 6, 3});
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below),
              (Chains{{1000, 1200, 5800, 4000, 4000}, {300, 2700, 200, 4500, 300, 4000, 4000}, {16000}}));
}

void setType(Boxes& boxes, const std::string& ifcType, const std::string& name = "") {
    volume::Label& label = boxes.volume.labels.labels.back();
    label.attributes.push_back({"ifcType", ifcType, {}});
    label.name = name;
}

TEST(Dimensions, TreesPostsAndTerrainAreNotMeasured) {
    Boxes boxes = house();
    boxes.addBox("tree", "BuildingConstructiveElement", {-9, 1, 0}, {-8, 2, 3});
    setType(boxes, "IfcBuildingElementProxy", "M_RPC Tree - Deciduous:Siberian Crab Apple:356904");
    boxes.addBox("bush", "SolitaryVegetationObject", {12, 1, 0}, {13, 2, 3});
    boxes.addBox("post", "BuildingConstructiveElement", {2, -3, 0}, {2.2, -2.8, 3});
    setType(boxes, "IfcColumn");
    boxes.addBox("railing", "BuildingInstallation", {0, -3, 0}, {8, -2.9, 3});
    boxes.addBox("hill", "TINRelief", {-20, 8, 0}, {20, 20, 3});
    const SectionDrawing drawing = planOf(boxes), plain = planOf(house());
    for (const DimensionSide side :
         {DimensionSide::Below, DimensionSide::Right, DimensionSide::Above, DimensionSide::Left})
        EXPECT_EQ(chainsOf(drawing, side), chainsOf(plain, side));
}

TEST(Dimensions, AColumnInTheFacadeIsMeasured) {
    Boxes boxes = house();
    boxes.addBox("column", "BuildingConstructiveElement", {8, 0, 0}, {8.4, 0.4, 3});
    setType(boxes, "IfcColumn");
    EXPECT_EQ(chainsOf(planOf(boxes), DimensionSide::Below).back(), (std::vector<long>{8400}));
}

TEST(Dimensions, RoomsHaveTheirClearWidthAndDepth) {
    Boxes boxes = house();
    const SectionDrawing drawing = planOf(boxes);
    std::vector<std::pair<std::string, long>> lengths;
    for (const RoomDimension& dimension : drawing.roomDimensions) {
        const double length = std::hypot(dimension.to.u - dimension.from.u, dimension.to.v - dimension.from.v);
        lengths.emplace_back(boxes.volume.labels.labels[dimension.label].id, std::lround(1000 * length));
    }
    EXPECT_EQ(lengths, (std::vector<std::pair<std::string, long>>{
                           {"left", 2700}, {"left", 5400}, {"right", 4500}, {"right", 5400}}));
}

//   +--------------------+ 2.9
//   |  lintel            | 2.1   the window is 0.1 m higher and lower than the opening, behind it
//   |  opening           |
//   |  parapet           | 0.9
//   +--------------------+ 0     floor
TEST(Dimensions, SillAndHeadAreThoseOfTheOpeningInTheWall) {
    Boxes boxes;
    boxes.addBox("room", "BuildingRoom", {0, 0.3, 0}, {4, 4, 2.7});
    boxes.addBox("slab", "BuildingConstructiveElement", {0, 0, -0.2}, {4, 4, 0});
    boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {1, 0.3, 2.9});
    boxes.addBox("east", "BuildingConstructiveElement", {2, 0, 0}, {4, 0.3, 2.9});
    boxes.addBox("parapet", "BuildingConstructiveElement", {1, 0, 0}, {2, 0.3, 0.9});
    boxes.addBox("lintel", "BuildingConstructiveElement", {1, 0, 2.1}, {2, 0.3, 2.9});
    boxes.addBox("window", "Window", {1, 0.1, 0.85}, {2, 0.2, 2.15});
    SectionOptions options;
    options.dimensions = true;
    const auto drawing = drawSection(boxes.volume, {{0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 1.1}}, options);
    ASSERT_EQ(drawing->openings.size(), 1u);
    const OpeningHeights& opening = drawing->openings.front();
    EXPECT_NEAR(opening.sill, 0.9, 1e-5);
    EXPECT_NEAR(opening.head, 2.1, 1e-5);
    EXPECT_TRUE(opening.isExact);
    EXPECT_NEAR(opening.away.v, -1, 1e-9) << "outside";
    EXPECT_NEAR(opening.at.v, 0, 1e-3) << "on the outer face of the wall";
    // The section through the window: its heights are on the left, in the order of parapet, opening, lintel.
    const auto section =
        drawSection(boxes.volume, {{-1, 0, 0}, boxes.volume.grid.origin() + Vec3d{1.5, 0, 0}}, options);
    const Chains left = chainsOf(*section, section->axes.u.y > 0 ? DimensionSide::Left : DimensionSide::Right);
    ASSERT_FALSE(left.empty());
    EXPECT_EQ(left.front(), (std::vector<long>{1100, 1200, 800}));
}

// A threshold does not count as a sill.
TEST(Dimensions, DoorsHaveASillOnlyWhereOneSteps) {
    for (const double sill : {0.01, 0.2}) {
        Boxes boxes;
        boxes.addBox("room", "BuildingRoom", {0, 0.3, 0}, {4, 4, 2.7});
        boxes.addBox("slab", "BuildingConstructiveElement", {0, 0, -0.2}, {4, 4, 0});
        boxes.addBox("west", "BuildingConstructiveElement", {0, 0, 0}, {1, 0.3, 2.9});
        boxes.addBox("east", "BuildingConstructiveElement", {2, 0, 0}, {4, 0.3, 2.9});
        boxes.addBox("threshold", "BuildingConstructiveElement", {1, 0, 0}, {2, 0.3, sill});
        boxes.addBox("lintel", "BuildingConstructiveElement", {1, 0, 2.1}, {2, 0.3, 2.9});
        boxes.addBox("door", "Door", {1, 0.1, sill}, {2, 0.2, 2.1});
        SectionOptions options;
        options.dimensions = true;
        const auto drawing =
            drawSection(boxes.volume, {{0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 1.1}}, options);
        ASSERT_EQ(drawing->openings.size(), 1u);
        EXPECT_NEAR(drawing->openings.front().sill, sill > 0.05 ? sill : 0, 1e-5);
    }
}

//   2 storeys of 2.5 m clear height, slabs of 0.3 m, and a space in the open air on the roof
TEST(Dimensions, SectionsHaveClearHeightsStoreysAndTheWhole) {
    Boxes boxes;
    boxes.addBox("lower", "BuildingRoom", {0.3, 0.3, 0.3}, {5.7, 3.7, 2.8});
    boxes.addBox("upper", "BuildingRoom", {0.3, 0.3, 3.1}, {5.7, 3.7, 5.6});
    boxes.addBox("ground slab", "BuildingConstructiveElement", {0, 0, 0}, {6, 4, 0.3});
    boxes.addBox("slab", "BuildingConstructiveElement", {0, 0, 2.8}, {6, 4, 3.1});
    boxes.addBox("roof", "BuildingConstructiveElement", {0, 0, 5.6}, {6, 4, 6});
    boxes.addBox("flag", "BuildingInstallation", {2, 2, 6}, {2.1, 2.1, 9});
    boxes.addBox("roof terrace", "BuildingRoom", {0, 0, 6}, {6, 4, 9});
    for (const double z : {0.3, 3.1}) {
        boxes.addBox("west", "BuildingConstructiveElement", {0, 0, z}, {0.3, 4, z + 2.5});
        boxes.addBox("east", "BuildingConstructiveElement", {5.7, 0, z}, {6, 4, z + 2.5});
    }
    SectionOptions options;
    options.dimensions = true;
    const auto drawing =
        drawSection(boxes.volume, {{0, -1, 0}, boxes.volume.grid.origin() + Vec3d{0, 2.05, 0}}, options);
    EXPECT_EQ(chainsOf(*drawing, DimensionSide::Left), (Chains{{2500, 300, 2500}, {300, 2800, 2900}, {6000}}));
    EXPECT_TRUE(chainsOf(*drawing, DimensionSide::Right).empty());
    EXPECT_TRUE(drawing->roomDimensions.empty());
    // An elevation cuts nothing, and an oblique plane has no heights.
    const auto outside = drawSection(boxes.volume, *elevationPlane("south", boxes.volume), options);
    EXPECT_TRUE(outside->dimensions.empty());
    const auto oblique =
        drawSection(boxes.volume, {{0, 0.6, 0.8}, boxes.volume.grid.origin() + Vec3d{3, 2, 2}}, options);
    EXPECT_TRUE(oblique->dimensions.empty());
}

}  // namespace
}  // namespace svt::drawing
