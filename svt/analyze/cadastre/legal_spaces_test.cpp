#include <svt/analyze/cadastre/plane_overlay.hpp>
#include <svt/analyze/land_administration.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace svt::analyze {
namespace {

using volume::Filling;
using volume::kNoLabel;

// Adds the closed mesh of a box, metres from the lower corner of the grid, to a label.
void addBox(volume::SemanticVolume& volume, std::uint32_t label, Vec3d low, Vec3d high) {
    auto& parts = volume.vectors;
    const auto first = static_cast<std::uint32_t>(parts.points.size());
    for (int n = 0; n < 8; ++n) {
        Vec3i point;
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<std::int32_t>(
                std::lround(((n >> axis & 1) != 0 ? high[axis] : low[axis]) / volume::VectorParts::kFinestUnit));
        parts.points.push_back(point);
    }
    constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : kFaces) {
        parts.triangles.push_back({label, {first + face[0], first + face[1], first + face[2]}});
        parts.triangles.push_back({label, {first + face[0], first + face[2], first + face[3]}});
    }
    volume.labels.labels[label].filling = Filling::Solid;
}

volume::SemanticVolume emptyHouse() {
    volume::SemanticVolume volume = volume::test::emptyVolume({40, 40, 20}, {0.5, 0.5, 0.5}, {1000, 2000, 100});
    volume::test::addGroup(volume, "house", "Building");
    return volume;
}

// Units of boxes of 4 x 6 x 3 m, one per corner.
volume::SemanticVolume unitsAt(const std::vector<Vec3d>& corners) {
    volume::SemanticVolume volume = emptyHouse();
    for (std::size_t n = 0; n < corners.size(); ++n)
        volume::test::addObject(volume, "unit" + std::to_string(n), "BuildingUnit", 0);
    for (std::uint32_t n = 0; n < corners.size(); ++n) addBox(volume, n + 1, corners[n], corners[n] + Vec3d{4, 6, 3});
    return volume;
}

LegalSpaces spacesOf(const volume::SemanticVolume& volume) { return makeLegalSpaces(volume, unitsOf(volume.labels)); }

const SpaceRelation* relationOf(const LegalSpaces& spaces, SpaceRelationKind kind, std::uint32_t a = 0,
                                std::uint32_t b = 1) {
    for (const SpaceRelation& relation : spaces.relations)
        if (relation.kind == kind && relation.a == a && relation.b == b) return &relation;
    return nullptr;
}

TEST(LegalSpaces, ThatTouchShareTheFaceBetweenThemAsOnePolygon) {
    // The second box is moved along the wall: 4 x 3 m are shared, and two strips of 2 x 3 m are not.
    const LegalSpaces spaces = spacesOf(unitsAt({{1, 1, 1}, {5, 3, 1}}));
    ASSERT_EQ(spaces.spaces.size(), 2u);
    EXPECT_EQ(spaces.spaces[0].body, SpaceBody::Solid);
    EXPECT_NEAR(*spaces.spaces[0].bodyVolume, 72, 1e-6);
    ASSERT_EQ(spaces.relations.size(), 1u);
    const SpaceRelation& shared = spaces.relations[0];
    EXPECT_EQ(shared.kind, SpaceRelationKind::SharedFace);
    EXPECT_TRUE(shared.isExact);
    EXPECT_NEAR(*shared.area, 12, 1e-5);
    ASSERT_EQ(shared.faces.size(), 1u);
    const BoundaryFace& face = spaces.faces[shared.faces[0]];
    EXPECT_EQ(face.minus, 0u);
    EXPECT_EQ(face.plus, 1u);
    EXPECT_NEAR(face.normal.x, 1, 1e-9) << "points to the plus side";
    EXPECT_EQ(face.direction, FaceDirection::Side);
    EXPECT_NEAR(face.low, 101, 1e-5);
    EXPECT_NEAR(face.high, 104, 1e-5);
    ASSERT_EQ(face.rings.size(), 1u);
    EXPECT_EQ(face.rings[0].size(), 4u);
    for (const Vec3d& p : face.rings[0]) EXPECT_NEAR(p.x, 1005, 1e-5);
    // Five whole faces of each box, and the rest of the wall of each, in one piece.
    std::map<std::uint32_t, int> alone;
    std::map<std::uint32_t, double> area;
    for (const BoundaryFace& f : spaces.faces) {
        if (f.plus == kNoSpace) ++alone[f.minus];
        area[f.minus] += f.area;
        if (f.plus != kNoSpace) area[f.plus] += f.area;
    }
    EXPECT_EQ(alone[0], 6);
    EXPECT_EQ(alone[1], 6);
    EXPECT_NEAR(area[0], 2 * (12 + 18 + 24), 1e-4) << "the faces of a space are its whole boundary";
    EXPECT_NEAR(area[1], 2 * (12 + 18 + 24), 1e-4);
}

TEST(LegalSpaces, OverlapByTheVolumeOfTheirSolids) {
    const LegalSpaces spaces = spacesOf(unitsAt({{1, 1, 1}, {4.99, 1, 1}}));
    const SpaceRelation* overlap = relationOf(spaces, SpaceRelationKind::Overlap);
    ASSERT_NE(overlap, nullptr);
    EXPECT_NEAR(*overlap->volume, 0.01 * 6 * 3, 1e-5) << "thinner than a voxel";
    EXPECT_LT(overlap->bound, 1e-3);
    EXPECT_TRUE(overlap->isExact);
    EXPECT_EQ(spacesOf(unitsAt({{1, 1, 1}, {5, 1, 1}})).relations.size(), 1u) << "they touch, and do not overlap";
}

TEST(LegalSpaces, AreSeparatedByGapsWithOrWithoutAWall) {
    volume::SemanticVolume volume = unitsAt({{1, 1, 1}, {5.25, 1, 1}});
    const LegalSpaces open = spacesOf(volume);
    const SpaceRelation* gap = relationOf(open, SpaceRelationKind::Gap);
    ASSERT_NE(gap, nullptr);
    EXPECT_NEAR(*gap->area, 18, 1e-4);
    EXPECT_NEAR(gap->narrowest, 0.25, 1e-6);
    EXPECT_NEAR(gap->widest, 0.25, 1e-6);
    EXPECT_TRUE(gap->isOpen);
    EXPECT_TRUE(gap->between.empty());
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement", 0);
    volume::test::addObject(volume, "door", "Door", 3);
    volume::test::paintBoxes(volume, {{3, {9, 0, 0}, {12, 40, 20}}, {4, {9, 4, 2}, {12, 8, 7}}});
    const LegalSpaces filled = spacesOf(volume);
    gap = relationOf(filled, SpaceRelationKind::Gap);
    ASSERT_NE(gap, nullptr);
    EXPECT_FALSE(gap->isOpen);
    EXPECT_EQ(gap->between, (std::vector<std::uint32_t>{3, 4})) << "the wall and the door in it";
    // Further apart than the limit.
    EXPECT_TRUE(spacesOf(unitsAt({{1, 1, 1}, {5.7, 1, 1}})).relations.empty());
}

TEST(LegalSpaces, OneAboveTheOtherShareACeiling) {
    const LegalSpaces spaces = spacesOf(unitsAt({{1, 1, 1}, {1, 1, 4}}));
    const SpaceRelation* shared = relationOf(spaces, SpaceRelationKind::SharedFace);
    ASSERT_NE(shared, nullptr);
    EXPECT_EQ(spaces.faces[shared->faces[0]].direction, FaceDirection::Up);
    EXPECT_NEAR(*shared->area, 24, 1e-4);
    for (const LegalSpace& space : spaces.spaces) {
        ASSERT_EQ(space.outline.size(), 1u);
        EXPECT_NEAR(space.outline[0].area, 24, 1e-4);
        EXPECT_EQ(space.outline[0].outer.size(), 4u);
    }
}

TEST(LegalSpaces, WithoutASolidAreTheirRooms) {
    volume::SemanticVolume volume = emptyHouse();
    volume::test::addGroup(volume, "flat", "BuildingUnit", 0);
    volume::test::addObject(volume, "a", "BuildingRoom", 1);
    volume::test::addObject(volume, "b", "BuildingRoom", 1);
    addBox(volume, 2, {1, 1, 1}, {5, 7, 4});
    addBox(volume, 3, {5, 1, 1}, {9, 7, 4});
    const LegalSpaces spaces = spacesOf(volume);
    ASSERT_EQ(spaces.spaces.size(), 1u);
    EXPECT_EQ(spaces.spaces[0].body, SpaceBody::Parts);
    EXPECT_EQ(spaces.spaces[0].solids.size(), 2u);
    EXPECT_NEAR(*spaces.spaces[0].bodyVolume, 144, 1e-5);
    EXPECT_EQ(spaces.faces.size(), 6u) << "the face between the rooms is inside";
    ASSERT_EQ(spaces.spaces[0].outline.size(), 1u);
    EXPECT_NEAR(spaces.spaces[0].outline[0].area, 48, 1e-4);
}

TEST(LegalSpaces, WithoutSolidsAreTheirVoxelsWithHoles) {
    volume::SemanticVolume volume = emptyHouse();
    volume::test::addObject(volume, "ring", "BuildingUnit", 0);
    // 6 x 6 m with a court of 2 x 2 m.
    volume::test::paintBoxes(volume, {{1, {4, 4, 2}, {16, 16, 8}}, {0, {8, 8, 2}, {12, 12, 8}}});
    const LegalSpaces spaces = spacesOf(volume);
    ASSERT_EQ(spaces.spaces.size(), 1u);
    const LegalSpace& space = spaces.spaces[0];
    EXPECT_EQ(space.body, SpaceBody::Voxels);
    EXPECT_NEAR(*space.bodyVolume, (36 - 4) * 3, 1e-6);
    ASSERT_EQ(space.outline.size(), 1u);
    EXPECT_NEAR(space.outline[0].area, 32, 1e-4);
    ASSERT_EQ(space.outline[0].holes.size(), 1u);
    EXPECT_NEAR(space.box.min.x, 1000 + 4 * 0.5 - 0.25, 1e-9);
    EXPECT_EQ(spaces.faces.size(), 10u) << "boxes are joined: top, bottom, four outer and four inner walls";
    LegalSpaceOptions few;
    few.maxBoxes = 2;
    const LegalSpaces limited = makeLegalSpaces(volume, unitsOf(volume.labels), few);
    EXPECT_EQ(limited.withoutFaces, (std::vector<std::uint32_t>{0}));
    EXPECT_FALSE(limited.spaces[0].bodyVolume) << "unknown, not 0";
}

TEST(LegalSpaces, ThatContainEachOtherHaveNoRelation) {
    volume::SemanticVolume volume = emptyHouse();
    volume::test::addObject(volume, "storey", "Storey", 0);
    volume::test::addObject(volume, "flat", "BuildingUnit", 1);
    addBox(volume, 1, {1, 1, 1}, {9, 7, 4});
    addBox(volume, 2, {1, 1, 1}, {5, 7, 4});
    const std::vector<std::uint32_t> labels{1, 2};
    const LegalSpaces spaces = makeLegalSpaces(volume, labels);
    EXPECT_TRUE(spaces.relations.empty());
    double flat = 0;
    for (const BoundaryFace& face : spaces.faces) flat += face.minus == 1 ? face.area : 0;
    EXPECT_NEAR(flat, 2 * (12 + 18 + 24), 1e-4) << "its faces in those of the storey are its own, too";
}

TEST(PlaneOverlay, SeparatesWhatSeveralClaimsCover) {
    PlaneOverlay overlay(100, 1e-4);
    overlay.add({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0);
    overlay.add({{4, 4}, {4, 6}, {6, 6}, {6, 4}}, 0);  // a hole: clockwise
    overlay.add({{5, -5}, {15, -5}, {15, 15}, {5, 15}}, 7);
    const auto regions = overlay.run();
    ASSERT_TRUE(regions);
    std::map<std::vector<std::uint32_t>, double> area;
    for (const OverlayRegion& region : *regions)
        for (const OverlayPolygon& polygon : region.polygons) {
            area[region.claims] += polygon.area;
            EXPECT_FALSE(pointsInside(polygon).empty());
            for (const OverlayPoint& inside : pointsInside(polygon)) {
                EXPECT_TRUE(inside[0] > 0 && inside[0] < 15) << inside[0];
                EXPECT_FALSE(inside[0] > 4 && inside[0] < 5 && inside[1] > 4 && inside[1] < 6) << "the hole";
            }
        }
    EXPECT_NEAR((area[{0}]), 50 - 2, 1e-6);
    EXPECT_NEAR((area[{0, 7}]), 50 - 2, 1e-6);
    EXPECT_NEAR((area[{7}]), 200 - 50 + 2, 1e-6);
}

TEST(PlaneOverlay, KeepsRingsThatTouchInAPointApart) {
    PlaneOverlay overlay(100, 1e-4);
    overlay.add({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 1);
    overlay.add({{4, 4}, {8, 4}, {8, 8}, {4, 8}}, 1);
    const auto regions = overlay.run();
    ASSERT_TRUE(regions && regions->size() == 1);
    ASSERT_EQ((*regions)[0].polygons.size(), 2u);
    for (const OverlayPolygon& polygon : (*regions)[0].polygons) {
        EXPECT_EQ(polygon.outer.size(), 4u);
        EXPECT_NEAR(polygon.area, 16, 1e-6);
    }
}

TEST(LandAdministration, HasSharesAsFractions) {
    EXPECT_EQ(shareOf(1), (RightShare{1, 1}));
    EXPECT_EQ(shareOf(0.5), (RightShare{1, 2}));
    EXPECT_EQ(shareOf(1.0 / 3), (RightShare{1, 3}));
    EXPECT_EQ(shareOf(6874.0 / 23548), (RightShare{491, 1682}));
    EXPECT_EQ(shareOf(0.123456), (RightShare{1929, 15625}));
    EXPECT_FALSE(shareOf(std::sqrt(0.5)));
}

TEST(LandAdministration, TakesPartiesFromAttributesOrATable) {
    volume::SemanticVolume volume = unitsAt({{1, 1, 1}, {5, 1, 1}, {9, 1, 1}});
    volume.source = "model.gml";
    volume.labels.labels[1].attributes.push_back({"owner", std::string("Ada")});
    volume.labels.labels[3].attributes.push_back({"Owner", std::string("Ada")});
    auto all = makeLandAdministration(volume, nullptr, {});
    ASSERT_TRUE(all) << all.error().toString();
    EXPECT_EQ(all->parties, (std::vector<std::string>{"Ada"}));
    EXPECT_EQ(all->spaces.spaces.size(), 3u);
    ASSERT_EQ(all->units.size(), 2u);
    EXPECT_EQ(all->units[1].space, 2u);
    EXPECT_EQ(all->partyFile, "model.gml");

    const auto table = parseOwners("unit1,Ada,1/3\nunit1,Bob,2/3\nhouse,all\n", "t.csv", volume.labels);
    ASSERT_TRUE(table) << table.error().toString();
    all = makeLandAdministration(volume, &*table, "t.csv");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->parties, (std::vector<std::string>{"Ada", "Bob", "all"}));
    EXPECT_EQ(all->spaces.spaces.size(), 4u) << "the house and its three units";
    ASSERT_EQ(all->rights.size(), 3u);
    EXPECT_EQ(all->units[all->rights[1].unit].label, 2u);
    EXPECT_EQ(all->rights[1].share, (RightShare{1, 3}));
    EXPECT_EQ(all->partySource, PartySource::Table);

    for (volume::Label& label : volume.labels.labels) label.className = "BuildingRoom";
    EXPECT_EQ(makeLandAdministration(volume, nullptr, {}).error().code(), Code::NothingSelected);
}

}  // namespace
}  // namespace svt::analyze
