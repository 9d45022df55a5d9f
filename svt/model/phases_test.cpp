#include <svt/model/phases.hpp>

#include <svt/model/classes.hpp>

#include <gtest/gtest.h>

namespace svt::model {
namespace {

// Adds the sides of a box with a material.
std::vector<SurfaceUse> addSides(BuildingModel& model, Vec3d low, Vec3d high, std::int32_t material) {
    static constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    std::vector<SurfaceUse> uses;
    for (const auto& corners : kCorners) {
        Polygon polygon;
        for (const int i : corners)
            polygon.points.push_back(
                {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
        polygon.ringEnds = {4};
        polygon.material = material;
        uses.push_back({model.addPolygon(std::move(polygon)), false});
    }
    return uses;
}

constexpr std::int32_t kNone = -1, kWood = 0, kPane = 1, kSteel = 2, kOtherPane = 3, kSillPart = 4;

BuildingModel modelWithMaterials() {
    BuildingModel model;
    model.materials = {{.name = "Holz"},
                       {.name = "Glass", .diffuse = {0, 0.5f, 0.75f}, .transparency = 0.9f},
                       {.name = "Stahl", .diffuse = {0.5f, 0.5f, 0.5f}},
                       {.name = "Glass", .diffuse = {0, 0.5f, 0.75f}, .transparency = 0.9f},
                       {.name = "Holz", .part = "Sill", .hasColor = false}};
    return model;
}

struct Part {
    double thickness;  // of a plate of one square metre
    std::int32_t material;
};

FeatureIndex addParts(BuildingModel& model, const std::string& className, const std::vector<Part>& parts,
                      FeatureIndex parent = kNoFeature) {
    Feature feature;
    feature.id = className + std::to_string(model.features.size());
    feature.className = className;
    Geometry geometry;
    geometry.kind = GeometryKind::Solid;
    double at = 0;
    for (const Part& part : parts) {
        geometry.solids.push_back({"", addSides(model, {0, at, 0}, {1, at + part.thickness, 1}, part.material), {}});
        at += 1;
    }
    feature.geometries.push_back(std::move(geometry));
    return model.addFeature(std::move(feature), parent);
}

std::string valueOf(const Feature& feature, std::string_view name) {
    for (const Attribute& attribute : feature.attributes)
        if (attribute.name == name) return toText(attribute.value);
    return "-";
}

TEST(Phases, ThePanesOfAWindowAreOnePhaseAndTheFrameStaysTheWindow) {
    BuildingModel model = modelWithMaterials();
    const FeatureIndex window = addParts(model, "Window", {{0.007, kPane}, {0.2, kWood}, {0.007, kOtherPane}});
    EXPECT_EQ(splitPhases(model), 1u);
    ASSERT_EQ(model.features[window].children.size(), 1u);
    EXPECT_EQ(model.features[window].geometries.front().solids.size(), 1u);
    EXPECT_EQ(valueOf(model.features[window], "phase"), "Holz");
    EXPECT_EQ(valueOf(model.features[window], "transparency"), "-");
    const Feature& pane = model.features[model.features[window].children.front()];
    EXPECT_EQ(pane.className, "WindowPhase");
    EXPECT_EQ(pane.name, "glass");
    EXPECT_EQ(valueOf(pane, "phase"), "glass");
    EXPECT_EQ(valueOf(pane, "style"), "Glass");
    EXPECT_EQ(valueOf(pane, "transparency"), "0.9");
    EXPECT_EQ(pane.geometries.front().solids.size(), 2u);
    EXPECT_EQ(pane.geometries.front().kind, GeometryKind::Solid);
    EXPECT_EQ(splitPhases(model), 0u);  // again
    EXPECT_EQ(valueOf(model.features[window], "phase"), "Holz");
}

TEST(Phases, HandlesAndNamedPartsArePhasesToo) {
    BuildingModel model = modelWithMaterials();
    const FeatureIndex door = addParts(model, "Door", {{0.05, kWood}, {0.01, kSteel}, {0.1, kSillPart}});
    EXPECT_EQ(splitPhases(model), 2u);
    EXPECT_EQ(valueOf(model.features[door], "phase"), "Sill");  // the largest part
    EXPECT_EQ(valueOf(model.features[model.features[door].children[0]], "phase"), "Holz");
    EXPECT_EQ(valueOf(model.features[model.features[door].children[1]], "phase"), "Stahl");
}

TEST(Phases, APartWithoutStyleSaysSo) {
    BuildingModel model = modelWithMaterials();
    const FeatureIndex door = addParts(model, "Door", {{0.2, kWood}, {0.1, kNone}});
    EXPECT_EQ(splitPhases(model), 1u);
    const Feature& leaf = model.features[model.features[door].children.front()];
    EXPECT_EQ(leaf.name, "unstyled");
    EXPECT_EQ(valueOf(leaf, "phase"), "unstyled");
    EXPECT_EQ(valueOf(leaf, "style"), "-");
}

TEST(Phases, ColoursOfWallsDoNotSplitThemButGlassDoes) {
    BuildingModel model = modelWithMaterials();
    addParts(model, "BuildingConstructiveElement", {{0.2, kWood}, {0.1, kSteel}, {0.1, kNone}});
    EXPECT_EQ(splitPhases(model), 0u);
    const FeatureIndex wall =
        addParts(model, "BuildingConstructiveElement", {{0.2, kWood}, {0.1, kSteel}, {0.1, kPane}});
    EXPECT_EQ(splitPhases(model), 1u);
    EXPECT_EQ(model.features[wall].geometries.front().solids.size(), 2u);
}

TEST(Phases, AnObjectOfGlassSaysSoAndSpacesAreNeverGlass) {
    BuildingModel model = modelWithMaterials();
    const FeatureIndex plate = addParts(model, "BuildingConstructiveElement", {{0.02, kPane}});
    const FeatureIndex room = addParts(model, "BuildingRoom", {{3, kPane}, {2, kWood}});
    EXPECT_EQ(splitPhases(model), 0u);
    EXPECT_EQ(valueOf(model.features[plate], "phase"), "glass");
    EXPECT_EQ(valueOf(model.features[plate], "transparency"), "0.9");
    EXPECT_TRUE(model.features[room].attributes.empty());
}

TEST(Phases, FacesThatAreClosedOnlyTogetherStayTogether) {
    BuildingModel model = modelWithMaterials();
    const FeatureIndex window = addParts(model, "Window", {{0.2, kWood}});
    Geometry& geometry = model.features[window].geometries.front();
    geometry.surfaces = geometry.solids.front().exterior;
    geometry.solids.clear();
    geometry.kind = GeometryKind::Surface;
    model.polygons[geometry.surfaces[2].polygon].material = kPane;
    EXPECT_EQ(splitPhases(model), 0u);
    // An open pane between open sheets of a frame is a part.
    BuildingModel open = modelWithMaterials();
    const FeatureIndex other = addParts(open, "Window", {{0.2, kWood}});
    Geometry& sheets = open.features[other].geometries.front();
    sheets.surfaces = {sheets.solids.front().exterior[2], sheets.solids.front().exterior[4]};
    sheets.solids.clear();
    sheets.kind = GeometryKind::Surface;
    open.polygons[sheets.surfaces[0].polygon].material = kPane;
    EXPECT_EQ(splitPhases(open), 1u);
}

TEST(Phases, OpaqueGlassOfAWindowCountsAsTransparentAndThatIsStated) {
    BuildingModel model;
    model.materials = {{.name = "Verglasung"}, {.name = "Rahmen"}};
    const FeatureIndex window = addParts(model, "Window", {{0.2, 1}, {0.01, 0}});
    EXPECT_EQ(splitPhases(model), 1u);
    const Feature& pane = model.features[model.features[window].children.front()];
    EXPECT_EQ(valueOf(pane, "transparency"), "0.7");
    EXPECT_EQ(valueOf(pane, "transparencyAssumed"), "true");
}

TEST(Phases, WholeWordsSayGlass) {
    for (const char* name : {"Glass", "Glas - Fenster", "Isolierglas 4/16/4", "Glazing", "Verre clair", "IFC_Glass_01"})
        EXPECT_TRUE(saysGlass(name)) << name;
    for (const char* name : {"Fiberglass Batt", "Glass wool", "Glaswolle", "Fibre glass", "Glasgow brick", "", "Holz"})
        EXPECT_FALSE(saysGlass(name)) << name;
}

TEST(Phases, AClassOfPhasesHasThePriorityOfItsObject) {
    EXPECT_EQ(phaseClassOf("Window"), "WindowPhase");
    EXPECT_TRUE(isPhase("WindowPhase"));
    EXPECT_FALSE(isPhase("Phase"));
    EXPECT_FALSE(isPhase("Window"));
    EXPECT_EQ(classRank("WindowPhase"), ClassRank::Filling);
    EXPECT_EQ(classRank("BuildingFurniturePhase"), ClassRank::Furniture);
    EXPECT_EQ(insideOf("BuildingFurniturePhase"), Inside::Declared);
}

}  // namespace
}  // namespace svt::model
