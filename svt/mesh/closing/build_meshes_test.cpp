#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/edges.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::FeatureIndex;
using model::SurfaceUse;
using test::addBox;
using test::addBoxFeature;
using test::addFeature;
using test::addRings;
using test::boxRing;
using test::meshOf;
using test::Ring;
using test::solidOf;
using test::surfaceOf;

const Vec3d kLow{0, 0, 0}, kHigh{4, 3, 2};

MeshSet meshesOf(const BuildingModel& model, Diagnostics* log = nullptr, const MeshOptions& options = {}) {
    auto meshes = buildMeshes(model, options, log);
    EXPECT_TRUE(meshes) << meshes.error().toString();
    return meshes ? *meshes : MeshSet{};
}

TEST(BuildMeshes, ClosedBoxIsASolidWithItsVolume) {
    BuildingModel model;
    addBoxFeature(model, "Building", "house", kLow, kHigh);
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    ASSERT_EQ(meshes.objects.size(), 1u);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::Closed);
    EXPECT_TRUE(mesh.isSolid());
    EXPECT_EQ(mesh.vertices.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(mesh.volume, 24, 1e-12);
    EXPECT_NEAR(mesh.area, 52, 1e-12);
    EXPECT_EQ(mesh.bounds, (Box3d{kLow, kHigh}));
    EXPECT_EQ(mesh.lod, 3);
    EXPECT_FALSE(mesh.isAssembled);
    EXPECT_EQ(mesh.unmatchedEdges, 0u);
    EXPECT_TRUE(log.items().empty());
    EXPECT_EQ(meshes.triangleCount(), 12u);
    EXPECT_EQ(meshes.planes.size(), 2u);
}

TEST(BuildMeshes, WorldOriginIsWholeMetresAndKeepsTheShape) {
    BuildingModel model;
    const Vec3d world{458877.25, 5438353.5, -1.5};
    addBoxFeature(model, "Building", "house", kLow + world, kHigh + world);
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshes.origin, (Vec3d{458877, 5438353, -2}));
    EXPECT_NEAR(meshes.objects[0].volume, 24, 1e-9);
    EXPECT_EQ(meshes.objects[0].bounds.min, (Vec3d{0.25, 0.5, 0.5}));
}

TEST(BuildMeshes, BoxWithoutATopIsCapped) {
    BuildingModel model;
    addFeature(model, "BuildingRoom", "room", model::kNoFeature, {solidOf(addBox(model, kLow, kHigh, {test::kTop}))});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::Capped);
    EXPECT_NEAR(mesh.volume, 24, 1e-12);
    EXPECT_NEAR(mesh.area, 52, 1e-12);
    ASSERT_EQ(mesh.caps.size(), 1u);
    EXPECT_NEAR(mesh.caps[0].area, 12, 1e-12);
    EXPECT_EQ(mesh.caps[0].center, (Vec3d{2, 1.5, 2}));
    EXPECT_EQ(mesh.caps[0].ring.size(), 4u);
    EXPECT_EQ(mesh.leakCount, 4u);
    EXPECT_EQ(mesh.unmatchedEdges, 4u);
    EXPECT_EQ(mesh.leaks.size(), 4u);
    for (const Vec3d& leak : mesh.leaks) EXPECT_EQ(leak.z, 2);
    EXPECT_TRUE(mesh.openEdges.empty());
    ASSERT_EQ(log.items().size(), 1u);
    EXPECT_EQ(log.items()[0].code, Code::ShellCapped);
    EXPECT_EQ(log.items()[0].where.id, "room");
}

TEST(BuildMeshes, TwoHolesGetTwoCaps) {
    BuildingModel model;
    addFeature(model, "BuildingRoom", "room", model::kNoFeature,
               {solidOf(addBox(model, kLow, kHigh, {test::kTop, test::kBottom}))});
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(meshes.objects[0].caps.size(), 2u);
    EXPECT_NEAR(meshes.objects[0].volume, 24, 1e-12);
}

TEST(BuildMeshes, HoleAlmostInAPlaneIsCappedOthersStayOpen) {
    for (const auto& [lift, method] : {std::pair{0.04, ClosingMethod::Capped}, {1.5, ClosingMethod::Open}}) {
        // The top's corners do not lie in a plane; each side wall is a triangle more.
        BuildingModel model;
        const Ring top{{0, 0, 2}, {4, 0, 2}, {4, 3, 2 + lift}, {0, 3, 2}};
        std::vector<SurfaceUse> uses{{addRings(model, {boxRing(kLow, kHigh, test::kBottom)}), false}};
        const Ring plan{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
        for (std::size_t i = 0; i < 4; ++i)
            uses.push_back({addRings(model, {{plan[i], plan[(i + 1) % 4], top[(i + 1) % 4], top[i]}}), false});
        addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
        Diagnostics log;
        const MeshSet meshes = meshesOf(model, &log);
        const ObjectMesh& mesh = meshes.objects[0];
        EXPECT_EQ(mesh.closingMethod, method) << lift;
        EXPECT_EQ(log.count(method == ClosingMethod::Open ? Code::WindingFilled : Code::ShellCapped), 1u);
        EXPECT_EQ(mesh.openEdges.size(), method == ClosingMethod::Open ? 4u : 0u);
        EXPECT_EQ(mesh.volume > 0, mesh.isSolid());
        if (method == ClosingMethod::Open) {
            EXPECT_TRUE(mesh.caps.empty());
        }
    }
}

TEST(BuildMeshes, FaceThatOnlyTheNeighbourListsIsBorrowed) {
    BuildingModel model;
    addBoxFeature(model, "BuildingRoom", "kitchen", kLow, kHigh);
    addFeature(model, "BuildingRoom", "hall", model::kNoFeature,
               {solidOf(addBox(model, {4, 0, 0}, {9, 3, 2}, {test::kWest}))});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    const ObjectMesh* hall = meshOf(model, meshes, "hall");
    ASSERT_NE(hall, nullptr);
    EXPECT_EQ(hall->closingMethod, ClosingMethod::Complemented);
    EXPECT_EQ(hall->complementedFaces, 1u);
    EXPECT_NEAR(hall->volume, 30, 1e-12);
    EXPECT_TRUE(hall->caps.empty());
    EXPECT_EQ(meshOf(model, meshes, "kitchen")->closingMethod, ClosingMethod::Closed);
    EXPECT_EQ(log.count(Code::FacesComplemented), 1u);
}

TEST(BuildMeshes, WhatNeighboursCannotCloseIsCapped) {
    BuildingModel model;
    addBoxFeature(model, "BuildingRoom", "kitchen", kLow, kHigh);
    addFeature(model, "BuildingRoom", "hall", model::kNoFeature,
               {solidOf(addBox(model, {4, 0, 0}, {9, 3, 2}, {test::kWest, test::kTop}))});
    const MeshSet meshes = meshesOf(model);
    const ObjectMesh* hall = meshOf(model, meshes, "hall");
    EXPECT_EQ(hall->closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(hall->complementedFaces, 1u);
    EXPECT_EQ(hall->caps.size(), 1u);
    EXPECT_NEAR(hall->volume, 30, 1e-12);
}

// The walls and the roof of a block of 20 x 16 x 5 m around a court of 6 x 4 m, without a floor.
std::vector<SurfaceUse> addBlockWithCourt(BuildingModel& model) {
    const Vec3d low{0, 0, 0}, high{20, 16, 5}, courtLow{7, 6, 0}, courtHigh{13, 10, 5};
    std::vector<SurfaceUse> uses = addBox(model, low, high, {test::kBottom, test::kTop});
    for (const int side : {test::kSouth, test::kEast, test::kNorth, test::kWest}) {
        Ring ring = boxRing(courtLow, courtHigh, side);
        std::reverse(ring.begin(), ring.end());
        uses.push_back({addRings(model, {ring}), false});
    }
    Ring court = boxRing(courtLow, courtHigh, test::kTop);
    std::reverse(court.begin(), court.end());
    uses.push_back({addRings(model, {boxRing(low, high, test::kTop), court}), false});
    return uses;
}
constexpr double kBlockVolume = (20 * 16 - 6 * 4) * 5.0, kBlockPlan = 20 * 16 - 6 * 4;
constexpr double kBlockArea = 2 * kBlockPlan + (2 * 36 + 2 * 10) * 5.0;

TEST(BuildMeshes, CapOfAFloorLeavesOutTheCourt) {
    BuildingModel model;
    addFeature(model, "Building", "block", model::kNoFeature, {solidOf(addBlockWithCourt(model))});
    const MeshSet meshes = meshesOf(model);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::Capped);
    ASSERT_EQ(mesh.caps.size(), 1u);
    EXPECT_NEAR(mesh.caps[0].area, kBlockPlan, 1e-9);
    EXPECT_NEAR(mesh.volume, kBlockVolume, 1e-9);
    EXPECT_NEAR(mesh.area, kBlockArea, 1e-9) << "a cap over the court would count twice";
}

TEST(BuildMeshes, FloorOfACourtThatIsAFaceOfAnotherIsNotBorrowed) {
    BuildingModel model;
    addFeature(model, "Building", "block", model::kNoFeature, {solidOf(addBlockWithCourt(model))});
    addFeature(model, "Building", "paving", model::kNoFeature,
               {surfaceOf({{addRings(model, {boxRing({7, 6, 0}, {13, 10, 0}, test::kTop)}), false}})});
    const MeshSet meshes = meshesOf(model);
    const ObjectMesh* block = meshOf(model, meshes, "block");
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(block->complementedFaces, 0u);
    EXPECT_EQ(block->caps.size(), 1u);
    EXPECT_NEAR(block->volume, kBlockVolume, 1e-9);
    EXPECT_NEAR(block->area, kBlockArea, 1e-9);
}

// A pavilion in the court belongs to the solid: its floor is a cap of its own.
TEST(BuildMeshes, FloorInACourtHasItsOwnCap) {
    BuildingModel model;
    auto uses = addBlockWithCourt(model);
    for (const SurfaceUse& use : addBox(model, {9, 7, 0}, {11, 9, 3}, {test::kBottom})) uses.push_back(use);
    addFeature(model, "Building", "block", model::kNoFeature, {solidOf(uses)});
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(meshes.objects[0].caps.size(), 2u);
    EXPECT_NEAR(meshes.objects[0].volume, kBlockVolume + 12, 1e-9);
    EXPECT_NEAR(meshes.objects[0].area, kBlockArea + 2 * 4 + 24, 1e-9);
}

TEST(BuildMeshes, BoundarySurfaceAloneIsASheet) {
    BuildingModel model;
    addFeature(model, "WallSurface", "wall", model::kNoFeature,
               {surfaceOf({{addRings(model, {boxRing(kLow, kHigh, test::kSouth)}), false}})});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::Surface);
    EXPECT_FALSE(mesh.isSolid());
    EXPECT_TRUE(mesh.caps.empty());
    EXPECT_EQ(mesh.volume, 0);
    EXPECT_NEAR(mesh.area, 8, 1e-12);
    EXPECT_EQ(mesh.openEdges.size(), 4u);
    for (const Triangle& triangle : mesh.triangles) EXPECT_TRUE(std::isinf(triangle.thickness));
    EXPECT_TRUE(log.items().empty());
}

TEST(BuildMeshes, FlatFootprintIsASheetWithoutCaps) {
    BuildingModel model;
    addFeature(
        model, "Building", "house", model::kNoFeature,
        {surfaceOf({{addRings(model, {{{0, 0, 1}, {8, 0, 1}, {8, 3, 1}, {4, 3, 1}, {4, 6, 1}, {0, 6, 1}}}), false}},
                   0)});
    const MeshSet meshes = meshesOf(model);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::Surface);
    EXPECT_TRUE(mesh.caps.empty());
    EXPECT_NEAR(mesh.area, 36, 1e-12);
    EXPECT_EQ(mesh.lod, 0);
}

TEST(BuildMeshes, FootprintsThatTouchKeepTheirOwnFaces) {
    // The second one closes more edges of the first than it opens.
    BuildingModel model;
    const auto add = [&](const char* id, Ring ring) {
        addFeature(model, "Building", id, model::kNoFeature,
                   {surfaceOf({{addRings(model, {std::move(ring)}), false}}, 0)});
    };
    add("block", {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {4, 6, 0}, {4, 2, 0}, {2, 2, 0}, {2, 6, 0}, {0, 6, 0}});
    add("infill", {{2, 2, 0}, {4, 2, 0}, {4, 6, 0}, {2, 6, 0}});
    // The same area twice, as that of two zones.
    add("zone", {{10, 0, 0}, {14, 0, 0}, {14, 4, 0}, {10, 4, 0}});
    add("zone beneath", {{10, 0, 0}, {10, 4, 0}, {14, 4, 0}, {14, 0, 0}});
    const MeshSet meshes = meshesOf(model);
    for (const auto& [id, area] : {std::pair("block", 28.0), std::pair("infill", 8.0), std::pair("zone", 16.0),
                                   std::pair("zone beneath", 16.0)}) {
        const ObjectMesh& mesh = *meshOf(model, meshes, id);
        EXPECT_EQ(mesh.closingMethod, ClosingMethod::Surface);
        EXPECT_NEAR(mesh.area, area, 1e-12) << id;
        EXPECT_EQ(mesh.complementedFaces, 0u) << id;
    }
}

TEST(BuildMeshes, BuildingOfBoundarySurfacesAloneIsAssembled) {
    BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    const char* const classes[6] = {"GroundSurface", "RoofSurface", "WallSurface",
                                    "WallSurface",   "WallSurface", "WallSurface"};
    FeatureIndex wall = 0;
    for (int side = 0; side < 6; ++side) {
        std::vector<Ring> rings{boxRing(kLow, kHigh, side)};
        if (side == test::kSouth) rings.push_back({{1, 0, 0.5}, {1, 0, 1.5}, {2, 0, 1.5}, {2, 0, 0.5}});
        const FeatureIndex surface = addFeature(model, classes[side], "side-" + std::to_string(side), house,
                                                {surfaceOf({{addRings(model, rings), false}}, 2)});
        if (side == test::kSouth) wall = surface;
    }
    addFeature(model, "WindowSurface", "window", wall,
               {surfaceOf({{addRings(model, {{{1, 0, 0.5}, {2, 0, 0.5}, {2, 0, 1.5}, {1, 0, 1.5}}}), false}}, 2)});
    const MeshSet meshes = meshesOf(model);
    ASSERT_EQ(meshes.objects.size(), 8u);
    EXPECT_EQ(model.features[meshes.objects[0].feature].id, "house");  // tree order
    const ObjectMesh* mesh = meshOf(model, meshes, "house");
    EXPECT_TRUE(mesh->isAssembled);
    EXPECT_EQ(mesh->closingMethod, ClosingMethod::Closed);
    EXPECT_NEAR(mesh->volume, 24, 1e-12);
    EXPECT_NEAR(mesh->area, 52, 1e-12);
    EXPECT_EQ(mesh->lod, 2);
    for (int side = 0; side < 6; ++side)
        EXPECT_EQ(meshOf(model, meshes, "side-" + std::to_string(side))->closingMethod, ClosingMethod::Surface);
    EXPECT_EQ(meshOf(model, meshes, "window")->closingMethod, ClosingMethod::Surface);
}

TEST(BuildMeshes, FinestLevelOfEachFeatureIsTaken) {
    BuildingModel model;
    addFeature(model, "Building", "house", model::kNoFeature,
               {solidOf(addBox(model, kLow, {8, 8, 8}), 1), solidOf(addBox(model, kLow, kHigh), 2.2)});
    addFeature(model, "Building", "shed", model::kNoFeature, {solidOf(addBox(model, {10, 0, 0}, {11, 1, 1}), 1)});
    MeshSet meshes = meshesOf(model);
    EXPECT_NEAR(meshOf(model, meshes, "house")->volume, 24, 1e-12);
    EXPECT_EQ(meshOf(model, meshes, "house")->lod, 2.2);
    EXPECT_EQ(meshOf(model, meshes, "shed")->lod, 1);
    MeshOptions coarse;
    coarse.lod.lod = 1;
    meshes = meshesOf(model, nullptr, coarse);
    EXPECT_NEAR(meshOf(model, meshes, "house")->volume, 512, 1e-12);
}

TEST(BuildMeshes, CoarserSurfacesOfTheSameClassAreLeftOut) {
    BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    const auto add = [&](const char* className, const char* id, int side, double lod) {
        addFeature(model, className, id, house,
                   {surfaceOf({{addRings(model, {boxRing(kLow, kHigh, side)}), false}}, lod)});
    };
    add("WallSurface", "wall-2", test::kSouth, 2);
    add("WallSurface", "wall-3", test::kSouth, 3);
    add("RoofSurface", "roof-2", test::kTop, 2);
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    EXPECT_EQ(meshOf(model, meshes, "wall-2"), nullptr);
    EXPECT_NE(meshOf(model, meshes, "wall-3"), nullptr);
    EXPECT_NE(meshOf(model, meshes, "roof-2"), nullptr);  // no finer roof
    EXPECT_EQ(log.count(Code::NoGeometry), 1u);
}

// As in 3DBAG: the building has its registered outline at height 0, and its part has the solid.
TEST(BuildMeshes, OutlinesOfBuildingsWithPartsAreLeftOut) {
    for (const double lod : {1.0, 2.2, 0.0}) {
        BuildingModel model;
        const FeatureIndex house =
            addFeature(model, "Building", "house", model::kNoFeature,
                       {surfaceOf({{addRings(model, {{{0, 0, -1}, {6, 0, -1}, {6, 3, -1}, {0, 3, -1}}}), false}}, 0)});
        model::Geometry solid = solidOf(addBox(model, kLow, kHigh));
        solid.lod = lod;
        addFeature(model, "BuildingPart", "part", house, {solid});
        addFeature(model, "Building", "shed", model::kNoFeature,
                   {surfaceOf({{addRings(model, {{{9, 0, 0}, {12, 0, 0}, {12, 3, 0}}}), false}}, 0)});
        Diagnostics log;
        const MeshSet meshes = meshesOf(model, &log);
        EXPECT_EQ(meshOf(model, meshes, "house") == nullptr, lod >= 1) << lod;
        EXPECT_NE(meshOf(model, meshes, "part"), nullptr);
        EXPECT_NE(meshOf(model, meshes, "shed"), nullptr) << "it has nothing but its outline";
        EXPECT_EQ(log.count(Code::NoGeometry), lod >= 1 ? 1u : 0u);
    }
}

TEST(BuildMeshes, SharedWallIsOnePolygonUsedInBothDirections) {
    BuildingModel model;
    const auto kitchen = addBox(model, kLow, kHigh);
    auto hall = addBox(model, {4, 0, 0}, {9, 3, 2}, {test::kWest});
    hall.push_back({kitchen[test::kEast].polygon, true});
    addFeature(model, "BuildingRoom", "kitchen", model::kNoFeature, {solidOf(kitchen)});
    addFeature(model, "BuildingRoom", "hall", model::kNoFeature, {solidOf(hall)});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    EXPECT_EQ(meshOf(model, meshes, "hall")->closingMethod, ClosingMethod::Closed);
    EXPECT_NEAR(meshOf(model, meshes, "hall")->volume, 30, 1e-12);
    EXPECT_TRUE(log.items().empty());
}

TEST(BuildMeshes, PolygonUsedInBothDirectionsInOneShellCancels) {
    // Two boxes as one composite, with the wall between them listed from both sides.
    BuildingModel model;
    auto uses = addBox(model, kLow, kHigh);
    const SurfaceUse shared{uses[test::kEast].polygon, true};
    for (const SurfaceUse& use : addBox(model, {4, 0, 0}, {9, 3, 2}, {test::kWest})) uses.push_back(use);
    uses.push_back(shared);
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed);
    EXPECT_NEAR(meshes.objects[0].volume, 54, 1e-12);
}

TEST(BuildMeshes, DuplicateFacesAreUsedOnce) {
    for (const int kind : {0, 1, 2}) {
        BuildingModel model;
        auto uses = addBox(model, kLow, kHigh);
        if (kind == 0) uses.push_back(uses[test::kTop]);  // the same polygon
        Ring top = boxRing(kLow, kHigh, test::kTop);
        if (kind == 2) std::rotate(top.begin(), top.begin() + 1, top.end());  // the other diagonal
        if (kind != 0) uses.push_back({addRings(model, {top}), false});       // its twin
        addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
        Diagnostics log;
        const MeshSet meshes = meshesOf(model, &log);
        EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed) << kind;
        EXPECT_NEAR(meshes.objects[0].volume, 24, 1e-12) << kind;
        EXPECT_NEAR(meshes.objects[0].area, 52, 1e-12) << kind;
        EXPECT_EQ(log.count(Code::DuplicateFace), 1u) << kind;
    }
}

TEST(BuildMeshes, FaceThatLooksInwardsIsTurned) {
    BuildingModel model;
    auto uses = addBox(model, kLow, kHigh);
    uses[test::kTop].isReversed = true;
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed);
    EXPECT_EQ(meshes.objects[0].flippedFaces, 2u);
    EXPECT_EQ(meshes.objects[0].leakCount, 0u);
    EXPECT_NEAR(meshes.objects[0].volume, 24, 1e-12);
    EXPECT_EQ(log.count(Code::FaceFlipped), 1u);
}

TEST(BuildMeshes, ShellInsideOutIsTurned) {
    BuildingModel model;
    auto uses = addBox(model, kLow, kHigh);
    for (SurfaceUse& use : uses) use.isReversed = true;
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    EXPECT_NEAR(meshes.objects[0].volume, 24, 1e-12);
    EXPECT_EQ(meshes.objects[0].flippedFaces, 12u);
    EXPECT_EQ(log.count(Code::FaceFlipped), 1u);
}

TEST(BuildMeshes, VoidsAreTakenAwayWhicheverWayTheShellsFace) {
    for (const bool isExteriorReversed : {false, true})
        for (const bool isVoidReversed : {false, true}) {
            BuildingModel model;
            auto exterior = addBox(model, kLow, kHigh), hole = addBox(model, {1, 1, 0.5}, {2, 2, 1.5});
            for (SurfaceUse& use : exterior) use.isReversed = isExteriorReversed;
            for (SurfaceUse& use : hole) use.isReversed = isVoidReversed;
            model::Geometry geometry = solidOf(exterior);
            geometry.solids[0].interiors.push_back(hole);
            addFeature(model, "Building", "house", model::kNoFeature, {geometry});
            Diagnostics log;
            const MeshSet meshes = meshesOf(model, &log);
            EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed);
            EXPECT_NEAR(meshes.objects[0].volume, 23, 1e-12);
            EXPECT_EQ(meshes.objects[0].flippedFaces, (isExteriorReversed ? 12u : 0u) + (isVoidReversed ? 0u : 12u));
            EXPECT_EQ(log.count(Code::FaceFlipped), isVoidReversed && !isExteriorReversed ? 0u : 1u);
        }
}

TEST(BuildMeshes, VoidsWithFacesThatRunAgainstTheOthersAreTakenAway) {
    // A court of full height in a box. Any two faces of it are turned.
    for (std::size_t first = 0; first < 6; ++first)
        for (std::size_t second = 0; second < first; ++second) {
            BuildingModel model;
            const auto exterior = addBox(model, kLow, kHigh);
            auto court = addBox(model, {1, 1, 0}, {2, 2, 2});
            court[first].isReversed = !court[first].isReversed;
            court[second].isReversed = !court[second].isReversed;
            model::Geometry geometry = solidOf(exterior);
            geometry.solids[0].interiors.push_back(court);
            addFeature(model, "BuildingRoom", "hall", model::kNoFeature, {geometry});
            const MeshSet meshes = meshesOf(model);
            EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed);
            EXPECT_NEAR(meshes.objects[0].volume, 24 - 2, 1e-12) << first << " and " << second;
        }
}

TEST(BuildMeshes, EdgesThatMatchOnlyInPartsAreTJunctions) {
    // The south face in two pieces of 1.7 and 2.3 m.
    BuildingModel model;
    auto uses = addBox(model, kLow, kHigh, {test::kSouth});
    uses.push_back({addRings(model, {{{0, 0, 0}, {1.7, 0, 0}, {1.7, 0, 2}, {0, 0, 2}}}), false});
    uses.push_back({addRings(model, {{{1.7, 0, 0}, {4, 0, 0}, {4, 0, 2}, {1.7, 0, 2}}}), false});
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    Diagnostics log;
    const MeshSet meshes = meshesOf(model, &log);
    const ObjectMesh& mesh = meshes.objects[0];
    EXPECT_EQ(mesh.closingMethod, ClosingMethod::TJunctions);
    EXPECT_EQ(mesh.tJunctionCount, 2u);
    EXPECT_EQ(mesh.unmatchedEdges, 6u);
    EXPECT_EQ(mesh.leakCount, 0u);
    EXPECT_NEAR(mesh.volume, 24, 1e-12);
    EXPECT_EQ(log.count(Code::TJunction), 1u);
    EXPECT_EQ(log.count(Severity::Warning), 0u);
}

TEST(BuildMeshes, RoundedCornersAreStillClosed) {
    // Each face has its corners rounded differently, by up to a micrometre.
    BuildingModel model;
    std::vector<SurfaceUse> uses;
    for (int side = 0; side < 6; ++side) {
        Ring ring = boxRing(kLow, kHigh, side);
        for (std::size_t c = 0; c < 4; ++c)
            ring[c] = ring[c] + Vec3d{1e-6, -1e-6, 1e-6} * (double((side + int(c)) % 3) - 1);
        uses.push_back({addRings(model, {ring}), false});
    }
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshes.objects[0].closingMethod, ClosingMethod::Closed);
    EXPECT_EQ(meshes.objects[0].vertices.size(), 8u);
}

TEST(BuildMeshes, BadCoordinatesCostTheirPolygonOnly) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), 1e308, -std::numeric_limits<double>::infinity()}) {
        BuildingModel model;
        auto uses = addBox(model, kLow, kHigh);
        model.polygons[uses[test::kTop].polygon].points[2].z = bad;
        addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
        addBoxFeature(model, "Building", "shed", {10, 0, 0}, {11, 1, 1});
        Diagnostics log;
        const MeshSet meshes = meshesOf(model, &log);
        EXPECT_EQ(log.count(Code::BadCoordinate), 1u);
        EXPECT_EQ(meshOf(model, meshes, "house")->closingMethod, ClosingMethod::Capped);
        EXPECT_NEAR(meshOf(model, meshes, "house")->volume, 24, 1e-12);
        EXPECT_EQ(meshOf(model, meshes, "shed")->closingMethod, ClosingMethod::Closed);
        EXPECT_EQ(meshes.bounds, (Box3d{{0, 0, 0}, {11, 3, 2}}));
    }
}

TEST(BuildMeshes, NothingToMeshIsAnEmptyModel) {
    BuildingModel model;
    EXPECT_EQ(buildMeshes(model).error().code(), Code::EmptyModel);
    addFeature(model, "Building", "house");
    EXPECT_EQ(buildMeshes(model).error().code(), Code::EmptyModel);
    const double bad = std::numeric_limits<double>::quiet_NaN();
    addFeature(model, "Building", "shed", model::kNoFeature,
               {surfaceOf({{addRings(model, {{{0, 0, bad}, {1, 0, 0}, {1, 1, 0}}}), false}})});
    EXPECT_EQ(buildMeshes(model).error().code(), Code::EmptyModel);
}

TEST(BuildMeshes, DoorIsABodyWhereItsGeometryIsASolid) {
    BuildingModel model;
    addFeature(model, "Door", "body", model::kNoFeature, {solidOf(addBox(model, kLow, kHigh, {test::kTop}))});
    addFeature(model, "Door", "leaf", model::kNoFeature,
               {surfaceOf(addBox(model, {10, 0, 0}, {11, 1, 1}, {test::kTop}))});
    const MeshSet meshes = meshesOf(model);
    EXPECT_EQ(meshOf(model, meshes, "body")->closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(meshOf(model, meshes, "leaf")->closingMethod, ClosingMethod::Surface);
}

TEST(BuildMeshes, CancelStopsWithoutResult) {
    BuildingModel model;
    addBoxFeature(model, "Building", "house", kLow, kHigh);
    Progress progress;
    progress.cancel = true;
    MeshOptions options;
    options.progress = &progress;
    const auto meshes = buildMeshes(model, options);
    ASSERT_FALSE(meshes);
    EXPECT_EQ(meshes.error().code(), Code::Cancelled);
}

TEST(BuildMeshes, SameForAnyNumberOfThreads) {
    BuildingModel model;
    for (int n = 0; n < 60; ++n) {
        const Vec3d low{n % 8 * 4.0, n / 8 * 3.0, 0}, high = low + Vec3d{4, 3, 2 + 0.1 * (n % 5)};
        std::vector<int> without;
        if (n % 4 == 1) without = {test::kWest};
        if (n % 4 == 2) without = {test::kTop, test::kNorth};
        if (n % 4 == 3) without = {test::kTop};
        addFeature(model, "BuildingRoom", "room-" + std::to_string(n), model::kNoFeature,
                   {solidOf(addBox(model, low, high, without))});
    }
    MeshOptions one, many;
    one.threads = 1;
    many.threads = 4;
    Diagnostics oneLog, manyLog;
    const MeshSet a = meshesOf(model, &oneLog, one), b = meshesOf(model, &manyLog, many);
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t o = 0; o < a.objects.size(); ++o) {
        const ObjectMesh &s = a.objects[o], &t = b.objects[o];
        EXPECT_EQ(s.vertices, t.vertices);
        EXPECT_EQ(s.closingMethod, t.closingMethod);
        EXPECT_EQ(s.volume, t.volume);
        EXPECT_EQ(s.area, t.area);
        ASSERT_EQ(s.triangles.size(), t.triangles.size());
        for (std::size_t i = 0; i < s.triangles.size(); ++i) {
            EXPECT_EQ(s.triangles[i].corners, t.triangles[i].corners);
            EXPECT_EQ(s.triangles[i].plane, t.triangles[i].plane);
            EXPECT_EQ(s.triangles[i].thickness, t.triangles[i].thickness);
        }
    }
    ASSERT_EQ(a.planes.size(), b.planes.size());
    ASSERT_EQ(oneLog.items().size(), manyLog.items().size());
    for (std::size_t i = 0; i < oneLog.items().size(); ++i)
        EXPECT_EQ(oneLog.items()[i].toString(), manyLog.items()[i].toString());
    EXPECT_FALSE(oneLog.items().empty());
}

TEST(ClosureName, EveryClosureHasItsOwn) {
    EXPECT_EQ(closingMethodName(ClosingMethod::Closed), "closed");
    EXPECT_EQ(closingMethodName(ClosingMethod::TJunctions), "t-junctions");
    EXPECT_EQ(closingMethodName(ClosingMethod::Complemented), "complemented");
    EXPECT_EQ(closingMethodName(ClosingMethod::Capped), "capped");
    EXPECT_EQ(closingMethodName(ClosingMethod::Open), "open");
    EXPECT_EQ(closingMethodName(ClosingMethod::Surface), "surface");
}

// Boxes as the solids of one building.
BuildingModel modelOfSolids(const std::vector<std::pair<Vec3d, Vec3d>>& boxes) {
    BuildingModel model;
    model::Geometry geometry;
    geometry.kind = model::GeometryKind::Solid;
    geometry.lod = 3;
    for (const auto& [low, high] : boxes) {
        model::Solid solid;
        solid.exterior = addBox(model, low, high);
        geometry.solids.push_back(std::move(solid));
    }
    addFeature(model, "Building", "house", model::kNoFeature, {std::move(geometry)});
    return model;
}

TEST(BuildMeshes, SpaceThatSolidsShareCountsOnce) {
    const auto volumeOf = [](const std::vector<std::pair<Vec3d, Vec3d>>& boxes, std::size_t findings) {
        Diagnostics log;
        const MeshSet meshes = meshesOf(modelOfSolids(boxes), &log);
        EXPECT_EQ(log.count(Code::SolidsIntersect), findings);
        return meshes.objects.empty() ? -1 : meshes.objects[0].volume;
    };
    const std::pair<Vec3d, Vec3d> box{{0, 0, 0}, {4, 3, 2}};
    EXPECT_NEAR(volumeOf({box, {{3, 1, 0.5}, {6, 2, 1.5}}}, 1), 24 + 3 - 1, 1e-9);
    EXPECT_NEAR(volumeOf({box, {{1, 1, 0.5}, {2, 2, 1.5}}}, 1), 24, 1e-9) << "one within the other";
    EXPECT_NEAR(volumeOf({box, {{4, 0, 0}, {5, 3, 2}}}, 0), 30, 1e-9) << "they touch";
    EXPECT_NEAR(volumeOf({box, {{-1, 1, 0.5}, {5, 2, 1.5}}}, 1), 24 + 2, 1e-9) << "a cross, without corners inside";
    // Three that overlap each other.
    const MeshSet meshes = meshesOf(modelOfSolids({box, {{3, 1, 0.5}, {6, 2, 1.5}}, {{3.5, 1, 0.5}, {7, 2, 1.5}}}));
    EXPECT_EQ(meshes.objects[0].volume, 0);
    EXPECT_FALSE(meshes.objects[0].isVolumeKnown);
}

}  // namespace
}  // namespace svt::mesh
