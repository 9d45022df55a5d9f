#include <svt/model/building_model.hpp>

#include <gtest/gtest.h>

namespace svt::model {
namespace {

Feature named(const char* id) {
    Feature feature;
    feature.id = id;
    return feature;
}

Geometry geometryOf(GeometryKind kind, double lod) {
    Geometry geometry;
    geometry.kind = kind;
    geometry.lod = lod;
    if (kind == GeometryKind::Solid)
        geometry.solids.emplace_back();
    else
        geometry.surfaces.push_back({0, false});
    return geometry;
}

TEST(BuildingModel, TreeOrderIsDepthFirstWithChildrenInDocumentOrder) {
    BuildingModel model;
    const auto house = model.addFeature(named("house"), kNoFeature);
    const auto tree = model.addFeature(named("tree"), kNoFeature);
    const auto ground = model.addFeature(named("ground floor"), house);
    const auto upper = model.addFeature(named("upper floor"), house);
    const auto kitchen = model.addFeature(named("kitchen"), ground);
    const auto bath = model.addFeature(named("bath"), upper);
    const auto hall = model.addFeature(named("hall"), ground);
    EXPECT_EQ(model.treeOrder(), (std::vector<FeatureIndex>{house, ground, kitchen, hall, upper, bath, tree}));
    EXPECT_EQ(model.roots, (std::vector<FeatureIndex>{house, tree}));
    EXPECT_EQ(model.features[kitchen].parent, ground);
    EXPECT_EQ(model.features[house].parent, kNoFeature);
    EXPECT_TRUE(BuildingModel().treeOrder().empty());
}

TEST(BuildingModel, TreeOrderOfAVeryDeepTreeIsNoRecursion) {
    BuildingModel model;
    FeatureIndex parent = kNoFeature;
    for (int i = 0; i < 200000; ++i) parent = model.addFeature({}, parent);
    EXPECT_EQ(model.treeOrder().size(), 200000u);
}

TEST(BuildingModel, BoundsHoldAllShellsAndSurfaces) {
    BuildingModel model;
    Polygon low, high, far;
    low.points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
    high.points = {{0, 0, 5}, {1, 0, 5}, {1, 2, 5}};
    far.points = {{-3, 0, 1}, {0, 0, 1}, {0, 1, 1}};
    Geometry geometry;
    geometry.kind = GeometryKind::Solid;
    geometry.solids.resize(1);
    geometry.solids[0].exterior = {{model.addPolygon(low), false}, {model.addPolygon(high), true}};
    geometry.solids[0].interiors = {{{model.addPolygon(far), false}}};
    EXPECT_EQ(model.bounds(geometry).min, (Vec3d{-3, 0, 0}));
    EXPECT_EQ(model.bounds(geometry).max, (Vec3d{1, 2, 5}));
    EXPECT_TRUE(model.bounds(Geometry()).isEmpty());
}

TEST(LodChoice, FinestTakesTheHighestLevel) {
    Feature feature;
    EXPECT_EQ(LodChoice::finest().choose(feature), -1);
    feature.geometries = {geometryOf(GeometryKind::Solid, 1), geometryOf(GeometryKind::Surface, 3),
                          geometryOf(GeometryKind::Solid, 2.2)};
    EXPECT_EQ(LodChoice::finest().choose(feature), 1);
}

TEST(LodChoice, SolidsComeBeforeSurfacesOfTheSameLevel) {
    Feature feature;
    feature.geometries = {geometryOf(GeometryKind::Surface, 2), geometryOf(GeometryKind::Solid, 2),
                          geometryOf(GeometryKind::Surface, 2)};
    EXPECT_EQ(LodChoice::finest().choose(feature), 1);
}

TEST(LodChoice, WholeLevelTakesItsRefinementsARefinedOneDoesNot) {
    Feature feature;
    feature.geometries = {geometryOf(GeometryKind::Solid, 1.2), geometryOf(GeometryKind::Solid, 2.0),
                          geometryOf(GeometryKind::Solid, 2.2), geometryOf(GeometryKind::Solid, 3)};
    EXPECT_EQ((LodChoice{2}.choose(feature)), 2);
    EXPECT_EQ((LodChoice{2.1}.choose(feature)), 1);
    EXPECT_EQ((LodChoice{2.2}.choose(feature)), 2);
    EXPECT_EQ((LodChoice{1}.choose(feature)), 0);
    EXPECT_EQ((LodChoice{4}.choose(feature)), 3);
    EXPECT_EQ((LodChoice{0}.choose(feature)), -1);
}

TEST(LodChoice, UnstatedLevelIsTheCoarsestAndEmptyGeometryIsNone) {
    Feature feature;
    feature.geometries = {geometryOf(GeometryKind::Surface, -1), Geometry()};
    feature.geometries[1].lod = 3;
    EXPECT_EQ(LodChoice::finest().choose(feature), 0);
    EXPECT_EQ((LodChoice{0}.choose(feature)), 0);
    feature.geometries.push_back(geometryOf(GeometryKind::Surface, 0));
    EXPECT_EQ(LodChoice::finest().choose(feature), 2);
}

}  // namespace
}  // namespace svt::model
