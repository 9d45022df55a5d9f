#include <svt/mesh/closing/gaps.hpp>
#include <svt/mesh/closing/holes.hpp>
#include <svt/mesh/closing/orient_faces.hpp>
#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/edges.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::FeatureIndex;
using model::Orientation;
using test::addBox;
using test::addFeature;
using test::addRings;
using test::boxRing;
using test::Ring;
using test::solidOf;
using test::surfaceOf;

const Vec3d kBoxLow{0, 0, 0}, kBoxHigh{4, 3, 2};

// Adds a ring with vertices of its own.
void addLoose(ObjectMesh& mesh, const Ring& ring) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < ring.size(); ++i) corners.push_back(i);
    test::append(mesh, test::meshOfRings(ring, {corners}));
}

// The sides of the box without those in `without`, each with vertices of its own and moved by `off` of its side number.
ObjectMesh looseBox(const std::vector<int>& without, const std::function<Vec3d(int)>& off) {
    ObjectMesh mesh;
    for (int side = 0; side < 6; ++side) {
        if (std::find(without.begin(), without.end(), side) != without.end()) continue;
        Ring ring = boxRing(kBoxLow, kBoxHigh, side);
        for (Vec3d& corner : ring) corner = corner + off(side);
        addLoose(mesh, ring);
    }
    mesh.openEdges = findOpenEdges(mesh.triangles);
    return mesh;
}

// The same with common vertices.
ObjectMesh boxWithout(const std::vector<int>& without) {
    static constexpr std::uint32_t kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                     {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    std::vector<std::vector<std::uint32_t>> rings;
    for (int side = 0; side < 6; ++side)
        if (std::find(without.begin(), without.end(), side) == without.end())
            rings.emplace_back(kCorners[side], kCorners[side] + 4);
    ObjectMesh mesh = test::meshOfRings(test::boxMesh(kBoxLow, kBoxHigh).vertices, rings);
    mesh.openEdges = findOpenEdges(mesh.triangles);
    return mesh;
}

void turn(ObjectMesh& mesh, std::size_t triangle) {
    std::swap(mesh.triangles[triangle].corners[1], mesh.triangles[triangle].corners[2]);
}

TEST(OrientFaces, LooseFacesAreTurnedOutwardsByRays) {
    for (unsigned turned = 0; turned < 64; ++turned) {
        ObjectMesh mesh = looseBox({}, [](int) { return Vec3d{}; });
        const std::vector<Triangle> right = mesh.triangles;
        for (std::size_t side = 0; side < 6; ++side)
            if (turned >> side & 1u) {
                turn(mesh, side * 2);
                turn(mesh, side * 2 + 1);
            }
        (void)orientFaces(mesh, {});
        for (std::size_t t = 0; t < right.size(); ++t) EXPECT_EQ(mesh.triangles[t].corners, right[t].corners) << turned;
    }
}

TEST(OrientFaces, MeaningDecidesWhatRaysSeeFromBothSides) {
    // A lone face sees nothing on either side.
    for (const Orientation orientation : {Orientation::Any, Orientation::Up, Orientation::Down}) {
        ObjectMesh mesh;
        addLoose(mesh, boxRing(kBoxLow, kBoxHigh, test::kTop));
        const std::vector<Orientation> orientations(mesh.triangles.size(), orientation);
        EXPECT_EQ(orientFaces(mesh, orientations), orientation == Orientation::Down ? 2u : 0u);
    }
}

TEST(OrientFaces, UndersideOfARoofLooksDownAllTheSame) {
    // A roof slab of loose faces: all of them are called RoofSurface.
    ObjectMesh mesh = looseBox({}, [](int) { return Vec3d{}; });
    const std::vector<Orientation> orientations(mesh.triangles.size(), Orientation::Up);
    EXPECT_EQ(orientFaces(mesh, orientations), 0u);
}

TEST(EnclosesVolume, IsTrueForABoxWithGapsAndFalseForFences) {
    EXPECT_TRUE(enclosesVolume(boxWithout({test::kTop})));
    EXPECT_TRUE(enclosesVolume(looseBox({}, [](int side) { return Vec3d{0.02, 0.01, -0.02} * double(side % 3); })));
    EXPECT_FALSE(enclosesVolume(boxWithout({test::kTop, test::kBottom, test::kEast, test::kNorth})));
    EXPECT_FALSE(enclosesVolume(boxWithout({test::kTop, test::kBottom, test::kEast, test::kNorth, test::kWest})));
    EXPECT_FALSE(enclosesVolume(ObjectMesh{}));
}

TEST(JoinGaps, FacesThatNearlyMeetAreJoined) {
    for (const double distance : {0.0005, 0.005, 0.02}) {
        ObjectMesh mesh = looseBox({}, [&](int side) {
            return Vec3d{double(side % 3) - 1, double(side % 2) - 0.5, double((side + 1) % 3) - 1} * distance;
        });
        EXPECT_EQ(mesh.openEdges.size(), 24u);
        EXPECT_EQ(joinGaps(mesh), 24u);
        EXPECT_TRUE(mesh.openEdges.empty());
        EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 24 * distance * 4);
    }
}

TEST(JoinGaps, HolesAreNotPulledTogether) {
    ObjectMesh mesh = boxWithout({test::kTop});
    EXPECT_EQ(joinGaps(mesh), 0u);
    EXPECT_EQ(mesh.openEdges.size(), 4u);
    EXPECT_EQ(mesh.vertices, test::boxMesh(kBoxLow, kBoxHigh).vertices);
}

TEST(BridgeLoops, GroundBelowTheWallsIsJoinedToThem) {
    ObjectMesh mesh = boxWithout({test::kBottom});
    addLoose(mesh, boxRing({0.2, 0.1, -0.3}, {3.9, 2.9, 0}, test::kBottom));
    mesh.openEdges = findOpenEdges(mesh.triangles);
    EXPECT_EQ(bridgeLoops(mesh), 1u);
    EXPECT_TRUE(mesh.openEdges.empty());
    const double volume = signedVolume(mesh.vertices, mesh.triangles);
    EXPECT_GT(volume, 24 + 0.3 * 3.7 * 2.8);
    EXPECT_LT(volume, 24 + 0.3 * 4 * 3);
}

TEST(BridgeLoops, RoofAboveTheGroundGetsItsWalls) {
    ObjectMesh mesh = boxWithout({test::kSouth, test::kEast, test::kNorth, test::kWest});
    EXPECT_EQ(bridgeLoops(mesh), 1u);
    EXPECT_TRUE(mesh.openEdges.empty());
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
}

TEST(BridgeLoops, EndsOfOneTubeAreNotJoined) {
    ObjectMesh mesh;
    test::append(mesh, test::boxMesh({0, 0, 0}, {4, 3, 0.2}));
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.vertices[t.corners[0]].z == mesh.vertices[t.corners[1]].z &&
               mesh.vertices[t.corners[1]].z == mesh.vertices[t.corners[2]].z;
    });
    mesh.openEdges = findOpenEdges(mesh.triangles);
    EXPECT_EQ(mesh.openEdges.size(), 8u);
    EXPECT_EQ(bridgeLoops(mesh), 0u);
}

TEST(CapHoles, MissingWallAndGroundAreTwoCaps) {
    for (const std::vector<int>& without :
         {std::vector<int>{test::kBottom, test::kSouth}, {test::kTop, test::kWest}, {test::kEast, test::kNorth}}) {
        ObjectMesh mesh = boxWithout(without);
        EXPECT_EQ(mesh.openEdges.size(), 6u);
        capHoles(mesh, 0.05);
        EXPECT_TRUE(mesh.openEdges.empty());
        EXPECT_EQ(mesh.caps.size(), 2u);
        EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
    }
}

TEST(CapHoles, MissingCornerIsFoundWhereThreePlanesMeet) {
    for (const std::vector<int>& without :
         {std::vector<int>{test::kBottom, test::kSouth, test::kWest}, {test::kTop, test::kNorth, test::kEast}}) {
        ObjectMesh mesh = boxWithout(without);
        capHoles(mesh, 0.05);
        EXPECT_TRUE(mesh.openEdges.empty());
        EXPECT_EQ(mesh.caps.size(), 3u);
        EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-9);
    }
}

TEST(CapHoles, MissingGroundBetweenTwoMissingWallsIsThreeCaps) {
    ObjectMesh mesh = boxWithout({test::kBottom, test::kWest, test::kEast});
    capHoles(mesh, 0.05);
    EXPECT_TRUE(mesh.openEdges.empty());
    EXPECT_EQ(mesh.caps.size(), 3u);
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.triangles), 24, 1e-12);
}

TEST(CapHoles, BorderOfASingleFaceIsNoHole) {
    ObjectMesh mesh;
    addLoose(mesh, {{0, 0, 1}, {8, 0, 1}, {8, 3, 1}, {4, 3, 1}, {4, 6, 1}, {0, 6, 1}});
    mesh.openEdges = findOpenEdges(mesh.triangles);
    const std::size_t triangles = mesh.triangles.size();
    capHoles(mesh, 0.05);
    EXPECT_EQ(mesh.triangles.size(), triangles);
    EXPECT_TRUE(mesh.caps.empty());
}

const ObjectMesh* objectOf(const BuildingModel& model, const MeshSet& meshes, const std::string& id) {
    return test::meshOf(model, meshes, id);
}

TEST(ClosedShells, GroundThatLooksUpAndSharesNoEdgeIsTurned) {
    // As in the open data of some cities: the ground is wider than the walls and faces up.
    BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    const char* const classes[6] = {"", "RoofSurface", "WallSurface", "WallSurface", "WallSurface", "WallSurface"};
    for (int side = 1; side < 6; ++side)
        addFeature(model, classes[side], "side-" + std::to_string(side), house,
                   {surfaceOf({{addRings(model, {boxRing(kBoxLow, kBoxHigh, side)}), false}}, 2)});
    Ring ground = boxRing({-0.02, -0.03, 0}, {4.01, 3.02, 2}, test::kBottom);
    std::reverse(ground.begin(), ground.end());
    addFeature(model, "GroundSurface", "ground", house, {surfaceOf({{addRings(model, {ground}), false}}, 2)});
    const auto meshes = buildMeshes(model);
    ASSERT_TRUE(meshes);
    const ObjectMesh* mesh = objectOf(model, *meshes, "house");
    EXPECT_TRUE(mesh->isSolid());
    EXPECT_NEAR(mesh->volume, 24, 0.3);
    EXPECT_GE(mesh->flippedFaces, 2u);
}

TEST(ClosedShells, BoundarySurfacesAreTurnedWithTheirShell) {
    BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    for (int side = 0; side < 6; ++side) {
        Ring ring = boxRing(kBoxLow, kBoxHigh, side);
        if (side == test::kSouth) std::reverse(ring.begin(), ring.end());
        addFeature(model, "WallSurface", "side-" + std::to_string(side), house,
                   {surfaceOf({{addRings(model, {ring}), false}}, 2)});
    }
    const auto meshes = buildMeshes(model);
    ASSERT_TRUE(meshes);
    EXPECT_NEAR(objectOf(model, *meshes, "house")->volume, 24, 1e-12);
    for (int side = 0; side < 6; ++side) {
        const ObjectMesh* sheet = objectOf(model, *meshes, "side-" + std::to_string(side));
        const Triangle& t = sheet->triangles[0];
        const Vec3d a = sheet->vertices[t.corners[0]];
        const Vec3d normal = cross(sheet->vertices[t.corners[1]] - a, sheet->vertices[t.corners[2]] - a);
        EXPECT_GT(dot(normal, a - Vec3d{2, 1.5, 1}), 0) << side;
    }
}

TEST(ClosedShells, SolidsOfOneObjectAreClosedOneByOne) {
    // A frame around a pane: edges where they touch have four uses. One face of the pane is turned, one is missing.
    BuildingModel model;
    model::Geometry geometry = solidOf(addBox(model, {0, 0, 0}, {1, 1, 1}));
    auto second = addBox(model, {1, 0, 0}, {2, 1, 1}, {test::kTop});
    second[2].isReversed = true;
    geometry.solids.push_back({"", second, {}});
    addFeature(model, "Building", "house", model::kNoFeature, {geometry});
    const auto meshes = buildMeshes(model);
    ASSERT_TRUE(meshes);
    EXPECT_EQ(meshes->objects[0].closingMethod, ClosingMethod::Capped);
    EXPECT_EQ(meshes->objects[0].caps.size(), 1u);
    EXPECT_NEAR(meshes->objects[0].volume, 2, 1e-12);
}

TEST(ClosedShells, WhatNeedNotBeABodyStaysASheet) {
    for (const char* const name : {"SolitaryVegetationObject", "GenericOccupiedSpace", "Bridge"}) {
        BuildingModel model;
        addFeature(model, name, "open", model::kNoFeature, {surfaceOf(addBox(model, kBoxLow, kBoxHigh, {test::kTop}))});
        addFeature(model, name, "solid", model::kNoFeature,
                   {solidOf(addBox(model, {10, 0, 0}, {14, 3, 2}, {test::kTop}))});
        const auto meshes = buildMeshes(model);
        ASSERT_TRUE(meshes);
        EXPECT_EQ(objectOf(model, *meshes, "open")->closingMethod, ClosingMethod::Surface) << name;
        EXPECT_EQ(objectOf(model, *meshes, "solid")->closingMethod, ClosingMethod::Capped) << name;
    }
}

TEST(ClosedShells, OpenShellHasAnEstimateOfItsVolume) {
    BuildingModel model;
    std::vector<model::SurfaceUse> uses{{addRings(model, {boxRing(kBoxLow, kBoxHigh, test::kBottom)}), false}};
    const Ring plan{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}, warped{{0, 0, 2}, {4, 0, 3}, {4, 3, 2}, {0, 3, 3}};
    for (std::size_t i = 0; i < 4; ++i)
        uses.push_back({addRings(model, {{plan[i], plan[(i + 1) % 4], warped[(i + 1) % 4], warped[i]}}), false});
    addFeature(model, "Building", "house", model::kNoFeature, {solidOf(uses)});
    const auto meshes = buildMeshes(model);
    ASSERT_TRUE(meshes);
    EXPECT_EQ(meshes->objects[0].closingMethod, ClosingMethod::Open);
    EXPECT_EQ(meshes->objects[0].volume, 0);
    EXPECT_NEAR(meshes->objects[0].enclosedVolume, 30, 1e-9);
}

}  // namespace
}  // namespace svt::mesh
