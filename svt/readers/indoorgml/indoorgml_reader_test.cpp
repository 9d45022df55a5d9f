#include <svt/core/file.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/indoorgml/indoorgml_reader.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace svt::readers {
namespace {

Result<model::BuildingModel> readText(const std::string& text, Diagnostics* log = nullptr) {
    return readIndoorGml(std::as_bytes(std::span(text.data(), text.size())), "test.gml", {}, log);
}

std::string polygon(const std::string& positions, const std::string& id = "") {
    return "<gml:surfaceMember><gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
           "><gml:exterior><gml:LinearRing><gml:posList>" + positions +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}

// A box of 2 x 3 x 2.5 m from x on; its face at x and that at x + 2 can be those of a neighbour.
std::string box(double x, const std::string& westFace = "", const std::string& eastId = "") {
    const auto p = [&](int i) { return fmt::format("{} {} {} ", x + (i & 1) * 2, (i >> 1 & 1) * 3, (i >> 2) * 2.5); };
    const auto face = [&](int a, int b, int c, int d, const std::string& id = "") {
        return polygon(p(a) + p(b) + p(c) + p(d) + p(a), id);
    };
    return "<gml:Solid><gml:exterior><gml:Shell>" + face(4, 5, 7, 6) + face(0, 2, 3, 1) + face(0, 1, 5, 4) +
           face(2, 6, 7, 3) + (westFace.empty() ? face(0, 4, 6, 2) : westFace) + face(1, 3, 7, 5, eastId) +
           "</gml:Shell></gml:exterior></gml:Solid>";
}

std::string cell(const std::string& id, const std::string& kind, const std::string& solid,
                 const std::string& rest = "") {
    return "<core:cellSpaceMember><" + kind + " gml:id=\"" + id + "\">" + rest +
           "<core:cellSpaceGeometry><core:Geometry3D>" + solid + "</core:Geometry3D></core:cellSpaceGeometry></" +
           kind + "></core:cellSpaceMember>";
}

std::string document(const std::string& cells, const std::string& layers = "") {
    return "<?xml version=\"1.0\"?><core:IndoorFeatures xmlns:core=\"http://www.opengis.net/indoorgml/1.0/core\" "
           "xmlns:navi=\"http://www.opengis.net/indoorgml/1.0/navigation\" "
           "xmlns:gml=\"http://www.opengis.net/gml/3.2\" "
           "xmlns:xlink=\"http://www.w3.org/1999/xlink\"><core:primalSpaceFeatures><core:PrimalSpaceFeatures>" +
           cells + "</core:PrimalSpaceFeatures></core:primalSpaceFeatures>" + layers + "</core:IndoorFeatures>";
}

std::string attribute(const model::Feature& feature, const std::string& name) {
    for (const Attribute& a : feature.attributes)
        if (a.name == name) return toText(a.value);
    return "none";
}

// Signed volume of the first solid; NaN where it is not closed.
double indoorVolume(const model::BuildingModel& model, const model::Feature& feature) {
    std::vector<model::Polygon> faces;
    if (feature.geometries.empty() || feature.geometries[0].solids.empty()) return std::nan("");
    for (const model::SurfaceUse use : feature.geometries[0].solids[0].exterior) {
        std::vector<model::Polygon> face{model.polygons[use.polygon]};
        if (use.isReversed) ifc::turnOver(face);
        faces.push_back(face[0]);
    }
    return ifc::isClosed(faces) ? ifc::enclosedVolume(faces) : std::nan("");
}

// Rooms of 2.5 m in millimetres, without a CRS or a unit in the file.
TEST(IndoorGml, MillimetresNeedAStatement) {
    std::string solid = box(0);
    const std::string text = document(cell("a", "core:CellSpace", solid));
    std::string inMillimetres = text;
    for (std::size_t at = 0; (at = inMillimetres.find("2.5", at)) != std::string::npos; at += 4)
        inMillimetres.replace(at, 3, "2500");
    EXPECT_TRUE(readText(text));
    const auto doubtful = readText(inMillimetres);
    ASSERT_FALSE(doubtful);
    EXPECT_EQ(doubtful.error().code(), Code::UnitInDoubt);
    ReadOptions options;
    options.unit = 0.001;
    const auto model = readIndoorGml(std::as_bytes(std::span(inMillimetres.data(), inMillimetres.size())), "test.gml",
                                     options, nullptr);
    ASSERT_TRUE(model) << model.error().toString();
    EXPECT_NEAR(model->bounds(model->features[0].geometries[0]).max.z, 2.5, 1e-12);
}

TEST(IndoorGml, CellSpacesAreRoomsThatKnowTheirNeighbors) {
    const std::string shared =
        "<gml:surfaceMember><gml:OrientableSurface orientation=\"-\"><gml:baseSurface "
        "xlink:href=\"#wall\"/></gml:OrientableSurface></gml:surfaceMember>";
    Diagnostics log;
    const auto model = readText(
        document(cell("a", "core:CellSpace", box(0, "", "wall"),
                      "<gml:name>Kitchen</gml:name><core:duality xlink:href=\"#sa\"/>"
                      "<core:partialboundedBy><core:CellSpaceBoundary gml:id=\"b1\"><core:cellSpaceBoundaryGeometry>"
                      "<core:Geometry3D>" +
                          polygon("0 0 0 9 0 0 9 9 0") +
                          "</core:Geometry3D></core:cellSpaceBoundaryGeometry></core:CellSpaceBoundary></"
                          "core:partialboundedBy>") +
                     cell("b", "navi:GeneralSpace", box(2, shared), "<navi:function>corridor</navi:function>") +
                     cell("c", "navi:TransitionSpace", box(10)),
                 "<core:SpaceLayer gml:id=\"base\"><core:nodes>"
                 "<core:State gml:id=\"sa\"><core:duality xlink:href=\"#a\"/></core:State>"
                 "<core:State gml:id=\"sb\"><core:duality xlink:href=\"#b\"/></core:State></core:nodes>"
                 "<core:edges><core:Transition gml:id=\"t\"><core:connects xlink:href=\"#sa\"/>"
                 "<core:connects xlink:href=\"#sb\"/></core:Transition></core:edges></core:SpaceLayer>"),
        &log);
    ASSERT_TRUE(model) << model.error().message();
    ASSERT_EQ(model->features.size(), 7u);  // three rooms, a layer, two states, a transition
    const model::Feature &a = model->features[0], &b = model->features[1], &c = model->features[2];
    EXPECT_EQ(a.className, "BuildingRoom");
    EXPECT_EQ(a.name, "Kitchen");
    EXPECT_EQ(attribute(a, "state"), "sa");
    EXPECT_EQ(attribute(a, "connectsTo"), "b");
    EXPECT_EQ(attribute(b, "connectsTo"), "a");
    EXPECT_EQ(attribute(b, "function"), "corridor");
    EXPECT_EQ(attribute(b, "cellSpaceClass"), "GeneralSpace");
    EXPECT_EQ(attribute(c, "connectsTo"), "none");
    for (const model::Feature* room : {&a, &b, &c}) EXPECT_NEAR(indoorVolume(*model, *room), 15, 1e-9) << room->id;
    EXPECT_EQ(model->features[3].className, "CityObjectGroup");
    ASSERT_EQ(model->memberships.size(), 2u);
    EXPECT_EQ(model->polygons.size(), 6u + 5u + 6u);  // the wall between a and b is one polygon; boundaries have none
    EXPECT_EQ(log.items().size(), 0u);
}

std::string state(const std::string& id, const std::string& cellId, const std::string& position,
                  const std::string& transitions = "") {
    return "<core:stateMember><core:State gml:id=\"" + id + "\">" +
           (cellId.empty() ? "" : "<core:duality xlink:href=\"#" + cellId + "\"/>") + transitions +
           (position.empty()
                ? ""
                : "<core:geometry><gml:Point><gml:pos>" + position + "</gml:pos></gml:Point></core:geometry>") +
           "</core:State></core:stateMember>";
}

std::string transition(const std::string& id, const std::string& from, const std::string& to,
                       const std::string& rest = "") {
    return "<core:transitionMember><core:Transition gml:id=\"" + id + "\"><core:weight>2.5</core:weight>" +
           "<core:connects xlink:href=\"#" + from + "\"/><core:connects xlink:href=\"#" + to + "\"/>" + rest +
           "</core:Transition></core:transitionMember>";
}

std::string layer(const std::string& id, const std::string& nodes, const std::string& edges) {
    return "<core:spaceLayerMember><core:SpaceLayer gml:id=\"" + id + "\"><core:nodes>" + nodes +
           "</core:nodes><core:edges>" + edges + "</core:edges></core:SpaceLayer></core:spaceLayerMember>";
}

const model::Feature& indoorFeature(const model::BuildingModel& model, const std::string& id) {
    const auto found = std::find_if(model.features.begin(), model.features.end(),
                                    [&](const model::Feature& feature) { return feature.id == id; });
    EXPECT_NE(found, model.features.end()) << id;
    return *found;
}

std::vector<Vec3d> lineOf(const model::BuildingModel& model, const std::string& id) {
    for (const model::Polyline& line : model.lines)
        if (model.features[line.feature].id == id) return line.points;
    return {};
}

TEST(IndoorGml, WeightsThatAreNotNumbersAreReported) {
    for (const std::string bad : {"abc", "0x10", "2,5", "1 2"}) {
        std::string edge = transition("t1", "sa", "sb");
        edge.replace(edge.find("2.5"), 3, bad);
        Diagnostics log;
        const auto model = readText(document(cell("a", "core:CellSpace", box(0)) + cell("b", "core:CellSpace", box(2)),
                                             layer("walk", state("sa", "", "1 1 1") + state("sb", "", "3 1 1"), edge)),
                                    &log);
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_EQ(attribute(indoorFeature(*model, "t1"), "weight"), bad);
        EXPECT_EQ(log.count(Code::BadValue), 1u) << bad;
    }
}

// Two rooms side by side in one layer, and the first once more in a second layer.
TEST(IndoorGml, GraphsAreFeaturesWithLines) {
    Diagnostics log;
    const auto model = readText(
        document(
            cell("a", "core:CellSpace", box(0), "<core:duality xlink:href=\"#sa\"/>") +
                cell("b", "core:CellSpace", box(2), "<core:duality xlink:href=\"#sb\"/>"),
            layer("walk", state("sa", "a", "1 1 1", "<core:connects xlink:href=\"#t1\"/>") + state("sb", "b", "3 1 1"),
                  transition("t1", "sa", "sb",
                             "<core:geometry><gml:LineString><gml:pos>1 1 1</gml:pos><gml:pos>2 0.5 1</gml:pos>"
                             "<gml:pos>3 1 1</gml:pos></gml:LineString></core:geometry>") +
                      transition("t2", "sb", "sa")) +
                layer("roll", state("ra", "a", "0.5 1 1"), "") +
                "<core:InterLayerConnection gml:id=\"up\"><core:interConnects xlink:href=\"#sa\"/>"
                "<core:interConnects xlink:href=\"#ra\"/></core:InterLayerConnection>"),
        &log);
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(log.items().size(), 0u);
    const model::Feature& sa = indoorFeature(*model, "sa");
    EXPECT_EQ(sa.className, "State");
    EXPECT_EQ(attribute(sa, "duality"), "a");
    EXPECT_EQ(model->features[sa.parent].id, "walk");
    EXPECT_EQ(attribute(indoorFeature(*model, "ra"), "duality"), "a") << "a cell space may have a state in each layer";
    EXPECT_EQ(attribute(indoorFeature(*model, "a"), "state"), "ra; sa");
    const model::Feature& t1 = indoorFeature(*model, "t1");
    EXPECT_EQ(t1.className, "Transition");
    EXPECT_EQ(attribute(t1, "from"), "sa");
    EXPECT_EQ(attribute(t1, "to"), "sb");
    EXPECT_EQ(attribute(t1, "weight"), "2.5");
    EXPECT_EQ(lineOf(*model, "sa"), (std::vector<Vec3d>{{1, 1, 1}}));
    EXPECT_EQ(lineOf(*model, "t1"), (std::vector<Vec3d>{{1, 1, 1}, {2, 0.5, 1}, {3, 1, 1}}));
    EXPECT_EQ(lineOf(*model, "t2"), (std::vector<Vec3d>{{3, 1, 1}, {1, 1, 1}})) << "straight where it has no curve";
    EXPECT_EQ(lineOf(*model, "up"), (std::vector<Vec3d>{{1, 1, 1}, {0.5, 1, 1}}));
    EXPECT_EQ(attribute(indoorFeature(*model, "a"), "connectsTo"), "b") << "connections of layers lead nowhere";
    EXPECT_TRUE(std::is_sorted(model->lines.begin(), model->lines.end(),
                               [](const auto& x, const auto& y) { return x.feature < y.feature; }));
    EXPECT_EQ(model->memberships.size(), 3u);
}

TEST(IndoorGml, DescriptionsOfNamedValuesAreAttributes) {
    const auto model = readText(document(
        cell("a", "core:CellSpace", box(0), "<gml:description>storey=\"1. OG\":usage=\"office\"</gml:description>") +
        cell("b", "core:CellSpace", box(2), "<gml:description>a room of x=\"3\" m</gml:description>") +
        cell("c", "core:CellSpace", box(4), "<gml:description>storey=\"open</gml:description>")));
    ASSERT_TRUE(model);
    EXPECT_EQ(attribute(model->features[0], "storey"), "1. OG");
    EXPECT_EQ(attribute(model->features[0], "usage"), "office");
    EXPECT_EQ(attribute(model->features[0], "description"), "none");
    EXPECT_EQ(attribute(model->features[1], "description"), "a room of x=\"3\" m");
    EXPECT_EQ(attribute(model->features[2], "description"), "storey=\"open");
}

TEST(IndoorGml, LinksThatDoNotAgreeAreNamed) {
    const std::string a = cell("a", "core:CellSpace", box(0), "<core:duality xlink:href=\"#sa\"/>");
    const std::string b = cell("b", "core:CellSpace", box(2), "<core:duality xlink:href=\"#sb\"/>");
    const std::string bare = cell("b", "core:CellSpace", box(2));
    const auto count = [](const std::string& cells, const std::string& nodes, const std::string& edges = "") {
        Diagnostics log;
        EXPECT_TRUE(readText(document(cells, layer("l", nodes, edges)), &log));
        EXPECT_EQ(log.items().size(), log.count(Code::DualityBroken));
        return log.count(Code::DualityBroken);
    };
    EXPECT_EQ(count(a + bare, state("sa", "a", "") + state("sb", "b", "")), 0u);
    EXPECT_EQ(count(a, state("s2", "a", "")), 1u) << "no such state";
    EXPECT_EQ(count(a, state("sa", "", "")), 1u) << "the state has no duality";
    EXPECT_EQ(count(a + b, state("sa", "b", "") + state("sb", "a", "")), 2u) << "crosswise";
    EXPECT_EQ(count(a, state("sa", "a", "") + state("s2", "nothing", "")), 1u) << "no such cell space";
    EXPECT_EQ(count(a, state("sa", "a", "", "<core:connects xlink:href=\"#t9\"/>")), 1u) << "no such transition";
    EXPECT_EQ(count(a + b, state("sa", "a", "") + state("sb", "b", ""), transition("t", "sa", "s9")), 1u)
        << "no such state at an end";
    EXPECT_EQ(count(a + b, state("sa", "a", "", "<core:connects xlink:href=\"#t\"/>") + state("sb", "b", ""),
                    transition("t", "sb", "sb")),
              1u)
        << "a transition that leads elsewhere";
}

TEST(IndoorGml, CoordinatesOfTheGraphThatAreNoneAreLeftOut) {
    Diagnostics log;
    const auto model = readText(document(cell("a", "core:CellSpace", box(0)),
                                         layer("l", state("s", "a", "1 2") + state("t", "a", "1 2 x"), "")),
                                &log);
    ASSERT_TRUE(model);
    EXPECT_EQ(log.count(Code::BadCoordinate), 2u);
    EXPECT_TRUE(model->lines.empty());
}

TEST(IndoorGml, WhatIsWrongIsSaidAndTheRestIsRead) {
    std::string broken = box(2);
    broken.replace(broken.find("2 0 0 "), 6, "2 x 0 ");
    Diagnostics log;
    const auto model =
        readText(document(cell("a", "core:CellSpace", box(0)) + cell("a", "core:CellSpace", broken) +
                          cell("", "core:CellSpace", box(4, "<gml:surfaceMember xlink:href=\"#nothing\"/>"))),
                 &log);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->features.size(), 3u);
    EXPECT_NEAR(indoorVolume(*model, model->features[0]), 15, 1e-9);
    EXPECT_TRUE(std::isnan(indoorVolume(*model, model->features[1])));
    EXPECT_EQ(log.count(Code::DuplicateId), 1u);
    EXPECT_EQ(log.count(Code::MissingId), 1u);
    EXPECT_EQ(log.count(Code::BadCoordinate), 1u);
    EXPECT_EQ(log.count(Code::DanglingReference), 1u);
}

TEST(IndoorGml, RefusesWhatItCannotRead) {
    EXPECT_EQ(readText(document("")).error().code(), Code::EmptyModel);
    EXPECT_EQ(readText(document(cell("a", "core:CellSpace", box(0))).substr(0, 900)).error().code(), Code::BadXml);
    EXPECT_EQ(readText("<!DOCTYPE a [<!ENTITY b \"c\">]>" + document(cell("a", "core:CellSpace", box(0))).substr(21))
                  .error()
                  .code(),
              Code::DtdRefused);
    // Nesting far deeper than any stack.
    std::string deep = "<core:IndoorFeatures xmlns:core=\"x\">";
    for (int i = 0; i < 300'000; ++i) deep += "<a>";
    for (int i = 0; i < 300'000; ++i) deep += "</a>";
    EXPECT_EQ(readText(deep + "</core:IndoorFeatures>").error().code(), Code::EmptyModel);
}

TEST(IndoorGml, TheFzkHouse) {
    SVT_NEEDS_DATA(file, "fzk_haus_indoorgml.gml");
    Diagnostics log;
    const auto model = readModel(file, {}, &log);
    ASSERT_TRUE(model) << model.error().message();
    std::size_t rooms = 0, connected = 0;
    for (const model::Feature& feature : model->features) {
        if (feature.className != "BuildingRoom") continue;
        ++rooms;
        EXPECT_GT(std::abs(indoorVolume(*model, feature)), 0) << feature.id;
        connected += attribute(feature, "connectsTo") != "none" ? 1 : 0;
    }
    EXPECT_EQ(rooms, 24u);
    EXPECT_EQ(connected, 24u);
    EXPECT_EQ(log.count(Severity::Error), 0u);
}

}  // namespace
}  // namespace svt::readers
