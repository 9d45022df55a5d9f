#include <svt/analyze/outside_faces.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

using volume::test::paintBoxes;

// A box of walls, 1 voxel thick, around 6 x 4 x 4 voxels of air, on a slab and under a roof.
volume::SemanticVolume hollowBox(bool hasRoom) {
    auto volume = volume::test::emptyVolume({12, 10, 10}, {0.5, 0.25, 1});
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement");
    volume::test::addObject(volume, "room", "BuildingRoom");
    paintBoxes(volume, {{1, {2, 2, 2}, {10, 8, 8}}, {hasRoom ? 2u : 0u, {3, 3, 3}, {9, 7, 7}}});
    return volume;
}

std::vector<SideArea> sidesOf(const volume::SemanticVolume& volume) {
    return findSideAreas(volume.columns, volume.grid, volume.labels.labelOfScalar(), volume.labels.labels.size());
}

TEST(OutsideFaces, AreThoseTowardsAirThatReachesTheBorder) {
    // Faces across x have 0.25 x 1 m, those across y 0.5 x 1 m.
    const double outer = 2 * (6 * 6 * 0.25 + 8 * 6 * 0.5), inner = 2 * (4 * 4 * 0.25 + 6 * 4 * 0.5);
    for (const bool hasRoom : {true, false}) {
        const auto sides = sidesOf(hollowBox(hasRoom));
        EXPECT_DOUBLE_EQ(sides[0].outside, outer) << hasRoom;
        EXPECT_DOUBLE_EQ(sides[0].whole, outer + inner) << hasRoom;
        EXPECT_DOUBLE_EQ(sides[1].outside, 0);
        EXPECT_DOUBLE_EQ(sides[1].whole, hasRoom ? inner : 0);
    }
}

TEST(OutsideFaces, AreOnBothSidesOfAWallWhereAirGetsIn) {
    auto volume = hollowBox(false);
    paintBoxes(volume, {{1, {2, 2, 2}, {10, 8, 8}}, {0, {3, 3, 3}, {9, 7, 7}}, {0, {5, 4, 7}, {6, 5, 8}}});
    const SideArea side = sidesOf(volume)[0];
    EXPECT_DOUBLE_EQ(side.outside, side.whole);
}

TEST(OutsideFaces, TheSpaceBeyondTheGridIsOutside) {
    auto volume = volume::test::emptyVolume({4, 3, 2}, {1, 1, 1});
    volume::test::addObject(volume, "block", "Building");
    paintBoxes(volume, {{1, {0, 0, 0}, {4, 3, 2}}});
    const SideArea side = sidesOf(volume)[0];
    EXPECT_DOUBLE_EQ(side.outside, 2 * (4 + 3) * 2);
    EXPECT_DOUBLE_EQ(side.whole, side.outside);
}

}  // namespace
}  // namespace svt::analyze
