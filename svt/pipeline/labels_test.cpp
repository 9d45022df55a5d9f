#include <svt/mesh/models_test.hpp>
#include <svt/pipeline/labels.hpp>

#include <gtest/gtest.h>

namespace svt::pipeline {
namespace {

using model::FeatureIndex;
using test::addBoxFeature;
using test::addFeature;

LabelledObjects labelsOf(model::BuildingModel& model, const StyleSheet& style = defaultStyle(false)) {
    const auto meshes = mesh::buildMeshes(model);
    EXPECT_TRUE(meshes);
    addCapFeatures(model, *meshes);
    const StyleSheet* sheets[] = {&style};
    auto labelled = makeLabels(model, *meshes, sheets);
    EXPECT_TRUE(labelled);
    return *labelled;
}

std::uint32_t indexOf(const LabelledObjects& labelled, const std::string& id) {
    for (std::uint32_t l = 0; l < labelled.table.labels.size(); ++l)
        if (labelled.table.labels[l].id == id) return l;
    ADD_FAILURE() << "no label " << id;
    return 0;
}

const volume::Label& labelOf(const LabelledObjects& labelled, const std::string& id) {
    return labelled.table.labels[indexOf(labelled, id)];
}

// A house with two storeys, two rooms in each, one of them with a table; and a shed. Not added in tree order.
model::BuildingModel village() {
    model::BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    addBoxFeature(model, "Building", "shed", {20, 0, 0}, {22, 2, 2});
    const FeatureIndex ground = addFeature(model, "Storey", "ground", house),
                       upper = addFeature(model, "Storey", "upper", house);
    addBoxFeature(model, "BuildingRoom", "hall", {0, 0, 0}, {4, 3, 2}, ground);
    addBoxFeature(model, "BuildingRoom", "attic", {0, 0, 2}, {4, 3, 4}, upper);
    const FeatureIndex kitchen = addBoxFeature(model, "BuildingRoom", "kitchen", {4, 0, 0}, {8, 3, 2}, ground);
    addBoxFeature(model, "BuildingFurniture", "table", {5, 1, 0}, {6, 2, 1}, kitchen);
    return model;
}

TEST(MakeLabels, TreeOrderGivesEverySubtreeOneRange) {
    model::BuildingModel model = village();
    const LabelledObjects labelled = labelsOf(model);
    std::vector<std::string> ids;
    for (const volume::Label& label : labelled.table.labels) ids.push_back(label.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"house", "ground", "hall", "kitchen", "table", "upper", "attic", "shed"}));
    EXPECT_EQ(labelOf(labelled, "house").subtreeEnd, 7u);
    EXPECT_EQ(labelOf(labelled, "ground").subtreeEnd, 5u);
    EXPECT_EQ(labelOf(labelled, "shed").subtreeEnd, 8u);
    EXPECT_EQ(labelOf(labelled, "table").parent, indexOf(labelled, "kitchen"));
    EXPECT_EQ(labelOf(labelled, "house").parent, volume::kNoLabel);
    // Scalars of any subtree are contiguous and contain those of no other feature.
    const auto& labels = labelled.table.labels;
    volume::Scalar next = 1;
    for (const volume::Label& label : labels) {
        if (label.count == 0) continue;
        EXPECT_EQ(label.first, next) << label.id;
        next += label.count;
    }
    EXPECT_EQ(next, labelled.table.scalarCount());
}

TEST(MakeLabels, OnlyFeaturesWithGeometryOwnScalars) {
    model::BuildingModel model = village();
    const LabelledObjects labelled = labelsOf(model);
    EXPECT_EQ(labelOf(labelled, "house").count, 0u);
    EXPECT_EQ(labelOf(labelled, "house").filling, volume::Filling::None);
    EXPECT_EQ(labelOf(labelled, "hall").first, 1u);
    EXPECT_EQ(labelOf(labelled, "hall").filling, volume::Filling::Solid);
    EXPECT_NEAR(labelOf(labelled, "hall").volume, 24, 1e-12);
    EXPECT_EQ(labelled.table.scalarCount(), 6u);
    ASSERT_EQ(labelled.claims.size(), 5u);
    for (std::size_t o = 0; o < labelled.claims.size(); ++o)
        EXPECT_EQ(labelled.claims[o].scalar, labelled.table.labels[labelled.labelOfObject[o]].first);
    EXPECT_TRUE(labelled.patterns.empty());
    EXPECT_TRUE(labelled.table.phaseColors.empty());
}

TEST(MakeLabels, FurnitureComesBeforeRooms) {
    model::BuildingModel model = village();
    const LabelledObjects labelled = labelsOf(model);
    std::map<std::string, int> rank;
    for (const voxelize::ObjectClaim& claim : labelled.claims) rank[claim.id] = claim.rank;
    EXPECT_LT(rank["table"], rank["kitchen"]);
    EXPECT_LT(rank["kitchen"], rank["shed"]);
}

TEST(MakeLabels, PatternGivesOneScalarPerPhase) {
    model::BuildingModel model = village();
    const auto style = parseStyleSheet(R"({"rules": [{"select": "all", "color": "white"},
        {"select": "id=hall", "pattern": {"type": "concrete", "colors": ["red", "lime", "blue"]}},
        {"select": "id=house", "pattern": {"type": "brick"}}]})",
                                       {});
    ASSERT_TRUE(style);
    const LabelledObjects labelled = labelsOf(model, *style);
    EXPECT_EQ(labelOf(labelled, "hall").first, 1u);
    EXPECT_EQ(labelOf(labelled, "hall").count, 3u);
    EXPECT_EQ(labelOf(labelled, "kitchen").first, 4u);
    EXPECT_EQ(labelOf(labelled, "house").count, 0u);  // no geometry, so nothing to pattern
    ASSERT_EQ(labelled.patterns.size(), 1u);
    EXPECT_EQ(labelled.patterns[0].first, 1u);
    ASSERT_EQ(labelled.table.phaseColors.size(), labelled.table.scalarCount());
    EXPECT_EQ(labelled.table.phaseColors[1], (Vec3f{1, 0, 0}));
    EXPECT_EQ(labelled.table.phaseColors[3], (Vec3f{0, 0, 1}));
    EXPECT_EQ(labelled.table.phaseColors[4], (Vec3f{1, 1, 1}));
}

TEST(MakeLabels, MembersKnowTheirGroups) {
    model::BuildingModel model = village();
    const FeatureIndex unit = addFeature(model, "BuildingUnit", "flat", 0);
    model.memberships = {{unit, 6, ""}, {unit, 4, ""}, {unit, 6, "again"}};
    const LabelledObjects labelled = labelsOf(model);
    const std::uint32_t flat = indexOf(labelled, "flat");
    EXPECT_EQ(labelOf(labelled, "kitchen").groups, std::vector<std::uint32_t>{flat});
    EXPECT_EQ(labelOf(labelled, "hall").groups, std::vector<std::uint32_t>{flat});
    EXPECT_TRUE(labelOf(labelled, "attic").groups.empty());
}

TEST(MakeLabels, MaterialOfMostPolygonsColoursTheObject) {
    model::BuildingModel model = village();
    model.materials = {{.name = "stone", .diffuse = {0.1f, 0.2f, 0.3f}},
                       {.name = "glass", .diffuse = {0.4f, 0.5f, 0.6f}}};
    const auto& uses = model.features[4].geometries[0].solids[0].exterior;  // hall
    for (std::size_t u = 0; u < uses.size(); ++u) model.polygons[uses[u].polygon].material = u < 2 ? 0 : u < 5 ? 1 : -1;
    EXPECT_EQ(labelOf(labelsOf(model), "hall").color, (Vec3f{0.4f, 0.5f, 0.6f}));
}

TEST(AddCapFeatures, CapIsAClosureSurfaceWithItsArea) {
    model::BuildingModel model;
    addFeature(model, "BuildingRoom", "room", model::kNoFeature,
               {test::solidOf(test::addBox(model, {0, 0, 0}, {4, 3, 2}, {test::kTop, test::kWest}))});
    // A corner of the hole is lifted, so that it lies in no planes.
    for (model::Polygon& polygon : model.polygons)
        for (Vec3d& point : polygon.points)
            if (point == Vec3d{4, 3, 2}) point.z = 3.5;
    addBoxFeature(model, "BuildingRoom", "next", {8, 0, 0}, {9, 1, 1});
    LabelledObjects labelled = labelsOf(model);
    EXPECT_EQ(labelOf(labelled, "room").filling, volume::Filling::Winding);
    model = {};
    addFeature(model, "BuildingRoom", "room", model::kNoFeature,
               {test::solidOf(test::addBox(model, {0, 0, 0}, {4, 3, 2}, {test::kTop}))});
    addBoxFeature(model, "BuildingRoom", "next", {8, 0, 0}, {9, 1, 1});
    labelled = labelsOf(model);
    const volume::Label& cap = labelOf(labelled, "room_cap_1");
    EXPECT_EQ(cap.className, "ClosureSurface");
    EXPECT_EQ(cap.count, 0u);
    EXPECT_EQ(cap.parent, indexOf(labelled, "room"));
    ASSERT_EQ(cap.attributes.size(), 2u);
    EXPECT_EQ(cap.attributes[1].name, "area");
    EXPECT_NEAR(std::get<double>(cap.attributes[1].value), 12, 1e-12);
    EXPECT_EQ(cap.attributes[1].unit, "m2");
    EXPECT_EQ(labelOf(labelled, "room").filling, volume::Filling::Capped);
    EXPECT_EQ(labelOf(labelled, "room").subtreeEnd, 2u);
}

TEST(AddCapFeatures, ModelBuiltAgainGetsNoSecondCap) {
    model::BuildingModel model;
    addFeature(model, "BuildingRoom", "room", model::kNoFeature,
               {test::solidOf(test::addBox(model, {0, 0, 0}, {4, 3, 2}, {test::kTop}))});
    (void)labelsOf(model);
    EXPECT_EQ(labelsOf(model).table.labels.size(), 2u);
    EXPECT_EQ(model.features.size(), 2u);
}

// A file may have surfaces of its own for each level of detail, as those of 3D BAG.
TEST(MakeLabels, SurfacesOfOtherLevelsOfDetailAreLeftOut) {
    model::BuildingModel model;
    const FeatureIndex house = addFeature(model, "Building", "house");
    for (const double lod : {1.0, 2.0}) {
        const auto box = test::addBox(model, {0, 0, 0}, {4, 3, 4 - lod});
        model.features[house].geometries.push_back(test::solidOf(box, lod));
        addFeature(model, "RoofSurface", lod == 1 ? "coarse" : "fine", house, {test::surfaceOf({box[1]}, lod)});
    }
    addFeature(model, "WallSurface", "without geometry", house);
    const LabelledObjects labelled = labelsOf(model);
    std::vector<std::string> ids;
    for (const volume::Label& label : labelled.table.labels) ids.push_back(label.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"house", "fine", "without geometry"}));
}

}  // namespace
}  // namespace svt::pipeline
