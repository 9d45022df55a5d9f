#include <svt/analyze/legal_units.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::analyze {
namespace {

using volume::Filling;
using volume::kNoLabel;

//   Plan of 0.25 m voxels, y up; walls of one voxel:
//
//        west | east           west is reached by a door of the corridor, east by none
//        -D---+----
//        corridor
volume::SemanticVolume twoFlats(bool hasDoor = true) {
    volume::SemanticVolume volume = volume::test::emptyVolume({24, 20, 12}, {0.25, 0.25, 0.25});
    const auto add = [&](const char* id, const char* className, std::uint32_t parent) {
        volume::Label& label = volume::test::addObject(volume, id, className, parent);
        label.filling = Filling::Solid;
    };
    add("building", "Building", kNoLabel);
    add("storey", "Storey", 0);
    add("west", "BuildingUnit", 1);
    add("east", "BuildingUnit", 1);
    add("corridor", "BuildingRoom", 1);
    add("wall", "BuildingConstructiveElement", 1);
    add("door", "Door", 5);
    std::vector<volume::test::PaintedBox> boxes{{6, {0, 0, 0}, {24, 20, 12}},
                                                {3, {0, 8, 0}, {12, 20, 12}},
                                                {4, {13, 8, 0}, {24, 20, 12}},
                                                {5, {0, 0, 0}, {24, 7, 12}}};
    if (hasDoor) boxes.push_back({7, {2, 7, 0}, {6, 8, 8}});
    volume::test::paintBoxes(volume, boxes);
    for (volume::Label& label : volume.labels.labels) label.volume = double(label.voxels) / 64;
    return volume;
}

LegalUnits check(const volume::SemanticVolume& volume) {
    return checkLegalUnits(volume, findContacts(volume.columns, volume.grid, volume.labels, 1));
}

TEST(LegalUnits, ADoorReachesThemFromACommonPart) {
    const LegalUnits found = check(twoFlats());
    ASSERT_EQ(found.units.size(), 2u);
    EXPECT_EQ(found.units[0].access, UnitAccess::Common);
    EXPECT_EQ(found.units[1].access, UnitAccess::None);
    EXPECT_TRUE(found.overlaps.empty());
    EXPECT_TRUE(found.gaps.empty());
    EXPECT_EQ(check(twoFlats(false)).units[0].access, UnitAccess::Unknown) << "a model without doors";
}

TEST(LegalUnits, ADoorMayStandInADeepNiche) {
    volume::SemanticVolume volume = twoFlats();
    // The wall around the door is three voxels deep, the leaf one, with air in front of it and behind it.
    volume::test::paintBoxes(volume, {{6, {0, 0, 0}, {24, 20, 12}},
                                      {3, {0, 10, 0}, {12, 20, 12}},
                                      {4, {13, 10, 0}, {24, 20, 12}},
                                      {5, {0, 0, 0}, {24, 7, 12}},
                                      {0, {2, 7, 0}, {6, 10, 8}},
                                      {7, {2, 8, 0}, {6, 9, 8}}});
    EXPECT_EQ(check(volume).units[0].access, UnitAccess::Common);
}

// A leaf that is half as thick as it is wide has a thin side; a thicker one has none.
TEST(LegalUnits, ADoorHasAThinSide) {
    const auto accessOf = [](int thickness) {
        volume::SemanticVolume volume = twoFlats();
        volume::test::paintBoxes(volume, {{6, {0, 0, 0}, {24, 20, 12}},
                                          {3, {0, 11, 0}, {12, 20, 12}},
                                          {4, {13, 11, 0}, {24, 20, 12}},
                                          {5, {0, 0, 0}, {24, 7, 12}},
                                          {0, {2, 7, 0}, {6, 11, 8}},
                                          {7, {2, 8, 0}, {6, 8 + thickness, 8}}});
        return check(volume).units[0].access;
    };
    EXPECT_EQ(accessOf(2), UnitAccess::Common);
    EXPECT_NE(accessOf(3), UnitAccess::Common);
}

TEST(LegalUnits, CommonUnitsSaySoAndADoorMayLeadOutside) {
    volume::SemanticVolume volume = twoFlats();
    volume.labels.labels[3].attributes.push_back({"function", std::string("Gemeinschaftsraum"), ""});
    volume.labels.labels[4].className = "BuildingConstructiveElement";
    LegalUnits found = check(volume);
    EXPECT_TRUE(found.units[1].isCommon);
    EXPECT_EQ(found.units[0].access, UnitAccess::None) << "its door leads to material";
    volume::test::paintBoxes(volume, {{6, {0, 7, 0}, {24, 20, 12}},
                                      {3, {0, 8, 0}, {12, 20, 12}},
                                      {4, {13, 8, 0}, {24, 20, 12}},
                                      {7, {2, 7, 0}, {6, 8, 8}}});
    EXPECT_EQ(check(volume).units[0].access, UnitAccess::Outside);
    volume.labels.labels[3].attributes.clear();
    EXPECT_EQ(check(volume).units[0].access, UnitAccess::Unknown) << "no common part at all";
}

TEST(LegalUnits, TouchingSpacesNeedNoDoor) {
    volume::SemanticVolume volume = twoFlats(false);
    volume::test::paintBoxes(volume, {{6, {0, 0, 0}, {24, 20, 12}},
                                      {3, {0, 7, 0}, {12, 20, 12}},
                                      {4, {13, 8, 0}, {24, 20, 12}},
                                      {5, {0, 0, 0}, {24, 7, 12}}});
    EXPECT_EQ(check(volume).units[0].access, UnitAccess::Common);
}

TEST(LegalUnits, OverlapsAreThoseOfTheSolidsOrOfTheRooms) {
    volume::SemanticVolume volume = twoFlats();
    volume.labels.overlaps = {{2, 3, 160, false}, {2, 5, 64, false}};
    LegalUnits found = check(volume);
    ASSERT_EQ(found.overlaps.size(), 1u) << "a wall in a flat is not an overlap of units";
    EXPECT_EQ(found.overlaps[0].a, 2u);
    EXPECT_EQ(found.overlaps[0].b, 3u);
    EXPECT_DOUBLE_EQ(found.overlaps[0].volume, 2.5);
    EXPECT_TRUE(std::isinf(found.overlaps[0].bound));
    // The east unit is a group without a body; its room overlaps with the west unit.
    volume::test::addObject(volume, "room", "BuildingRoom").filling = Filling::Solid;
    volume::Label &east = volume.labels.labels[3], &room = volume.labels.labels[7];
    std::swap(east.first, room.first);
    east.count = 0;
    east.filling = Filling::None;
    east.voxels = 0;
    east.volume = 0;
    room.groups = {3};
    room.voxels = room.first > 0 ? 1 : 0;
    volume.labels.overlaps = {{2, 7, 128, false}};
    found = check(volume);
    ASSERT_EQ(found.overlaps.size(), 1u);
    EXPECT_DOUBLE_EQ(found.overlaps[0].volume, 2.0);
    // A room of both units is shared: not an overlap.
    room.groups = {2, 3};
    EXPECT_TRUE(check(volume).overlaps.empty());
}

TEST(LegalUnits, AStoreyHasNoSpaceOfItsOwn) {
    volume::SemanticVolume volume = twoFlats();
    volume::test::paintBoxes(volume, {{6, {0, 0, 0}, {24, 20, 12}},
                                      {3, {0, 8, 0}, {12, 20, 12}},
                                      {4, {13, 8, 0}, {24, 20, 12}},
                                      {5, {0, 0, 0}, {24, 7, 12}},
                                      {7, {2, 7, 0}, {6, 8, 8}},
                                      {2, {14, 9, 0}, {18, 13, 12}}});
    LegalUnits found = check(volume);
    ASSERT_EQ(found.gaps.size(), 1u);
    EXPECT_EQ(found.gaps[0].storey, 1u);
    EXPECT_DOUBLE_EQ(found.gaps[0].volume, 3);
    EXPECT_EQ(found.gaps[0].box, (SampleBox{{14, 9, 0}, {17, 12, 11}}));
    // Single voxels come from rounding.
    volume.labels.labels[1].voxels = 26;
    EXPECT_TRUE(check(volume).gaps.empty());
}

TEST(LegalUnits, AModelWithoutUnitsHasNone) {
    volume::SemanticVolume volume = twoFlats();
    for (volume::Label& label : volume.labels.labels)
        if (label.className == "BuildingUnit") label.className = "BuildingRoom";
    EXPECT_TRUE(check(volume).units.empty());
}

}  // namespace
}  // namespace svt::analyze
