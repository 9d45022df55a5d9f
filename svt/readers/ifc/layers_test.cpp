#include <svt/readers/ifc/ifc_documents_test.hpp>

#include <svt/readers/ifc_shape/body.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::readers {
namespace {

using namespace test;

model::BuildingModel readSplit(const std::string& text, Diagnostics& log) {
    ReadOptions options;
    options.splitLayers = true;
    auto model = readIfc(std::as_bytes(std::span(text.data(), text.size())), "test.ifc", options, &log);
    EXPECT_TRUE(model) << model.error().message();
    return model ? std::move(*model) : model::BuildingModel{};
}

std::vector<model::Polygon> facesOf(const model::BuildingModel& model, const model::Feature& feature) {
    std::vector<model::Polygon> faces;
    for (const model::Geometry& geometry : feature.geometries)
        for (const model::Solid& solid : geometry.solids)
            for (const model::SurfaceUse& use : solid.exterior) faces.push_back(model.polygons[use.polygon]);
    return faces;
}

std::string textOf(const model::Feature& feature, const std::string& name) {
    for (const Attribute& a : feature.attributes)
        if (a.name == name) return toText(a.value);
    return {};
}

const model::Feature& wallOf(const model::BuildingModel& model) {
    return *std::find_if(model.features.begin(), model.features.end(),
                         [](const model::Feature& feature) { return feature.id == "wall"; });
}

struct Part {
    std::string name, function;
    double volume;
    Box3d box;
};

// The layers below a feature, in their order, all of them closed.
std::vector<Part> partsOf(const model::BuildingModel& model, const std::string& id) {
    std::vector<Part> parts;
    for (const model::Feature& feature : model.features) {
        if (feature.parent == model::kNoFeature || model.features[feature.parent].id != id) continue;
        if (textOf(feature, "layer").empty()) continue;
        EXPECT_EQ(textOf(feature, "ifcType"), "IfcWall");
        EXPECT_EQ(textOf(feature, "Pset_WallCommon.IsExternal"), "true");
        EXPECT_EQ(textOf(feature, "BaseQuantities.NetVolume"), "");
        const auto faces = facesOf(model, feature);
        EXPECT_TRUE(ifc::isClosed(faces)) << feature.id;
        EXPECT_EQ(textOf(feature, "material"), feature.name);
        EXPECT_EQ(feature.id, id + "_layer" + textOf(feature, "layer"));
        parts.push_back({feature.name, textOf(feature, "function"), ifc::enclosedVolume(faces), ifc::boundsOf(faces)});
    }
    return parts;
}

// A wall along x, 4 m long and 3 m high, from y = -100 to y = 200 mm, with a door of 1 m x 2 m, of three layers.
std::string wall(const std::string& usage, const std::string& axis = "(#411,#412)", const std::string& extra = "") {
    return ifcFile(
        "#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n"
        "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102,#103));\n"
        "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#200));\n"
        "#103=IFCSHAPEREPRESENTATION(#20,'Axis','Curve2D',(#410));\n"
        "#410=IFCPOLYLINE(" +
            axis +
            ");\n"
            "#411=IFCCARTESIANPOINT((0.,0.));\n#412=IFCCARTESIANPOINT((4000.,0.));\n"
            "#413=IFCCARTESIANPOINT((2000.,300.));\n"
            "#200=IFCEXTRUDEDAREASOLID(#201,#14,#11,3000.);\n"
            "#201=IFCRECTANGLEPROFILEDEF(.AREA.,$,#202,4000.,300.);\n"
            "#202=IFCAXIS2PLACEMENT2D(#203,$);\n#203=IFCCARTESIANPOINT((2000.,50.));\n"
            "#110=IFCOPENINGELEMENT('door',$,$,$,$,#15,#111,$,$);\n#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#112));\n"
            "#112=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#113));\n"
            "#113=IFCEXTRUDEDAREASOLID(#114,#14,#11,2000.);\n"
            "#114=IFCRECTANGLEPROFILEDEF(.AREA.,$,#202,1000.,300.);\n"
            "#115=IFCRELVOIDSELEMENT('v',$,$,$,#100,#110);\n"
            "#301=IFCMATERIAL('plaster',$,$);\n#302=IFCMATERIAL('mineral wool',$,'Insulation');\n"
            "#303=IFCMATERIAL('brick',$,$);\n"
            "#311=IFCMATERIALLAYER(#301,20.,$,$,$,'Finish',$);\n#312=IFCMATERIALLAYER(#302,100.,$);\n"
            "#313=IFCMATERIALLAYER(#303,180.,.F.,'core',$,'LoadBearing',$);\n"
            "#314=IFCMATERIALLAYER(#301,0.,$,'foil',$,$,$);\n"
            "#320=IFCMATERIALLAYERSET((#311,#312,#314,#313),'Wall',$);\n"
            "#321=IFCMATERIALLAYERSETUSAGE(#320," +
            usage +
            ",$);\n"
            "#330=IFCPROPERTYSET('p',$,'Pset_WallCommon',$,(#331));\n"
            "#331=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n"
            "#332=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#100),#330);\n"
            "#333=IFCELEMENTQUANTITY('q',$,'BaseQuantities',$,$,(#334));\n"
            "#334=IFCQUANTITYVOLUME('NetVolume',$,$,3.,$);\n"
            "#335=IFCRELDEFINESBYPROPERTIES('rq',$,$,$,(#100),#333);\n"
            "#322=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#100),#321);\n" +
            extra,
        "#100");
}

TEST(IfcLayers, AWallIsSplitAlongItsSense) {
    Diagnostics log;
    const auto model = readSplit(wall(".AXIS2.,.POSITIVE.,-100."), log);
    const auto parts = partsOf(model, "wall");
    ASSERT_EQ(parts.size(), 3u);  // the foil has no body
    const double area = 4 * 3 - 1 * 2;
    EXPECT_EQ(parts[0].name, "plaster");
    EXPECT_EQ(parts[0].function, "Finish");
    EXPECT_NEAR(parts[0].volume, area * 0.02, 1e-12);
    EXPECT_NEAR(parts[0].box.min.y, -0.1, 1e-12);
    EXPECT_NEAR(parts[0].box.max.y, -0.08, 1e-12);
    EXPECT_EQ(parts[1].function, "Insulation");
    EXPECT_NEAR(parts[1].volume, area * 0.1, 1e-12);
    EXPECT_EQ(parts[2].name, "brick");
    EXPECT_NEAR(parts[2].volume, area * 0.18, 1e-12);
    EXPECT_NEAR(parts[2].box.max.y, 0.2, 1e-12);
    EXPECT_TRUE(facesOf(model, wallOf(model)).empty());
    EXPECT_EQ(log.count(Severity::Warning), 0u);
    EXPECT_EQ(log.count(Code::LayersSplit), 1u);
}

TEST(IfcLayers, ANegativeSenseTurnsTheOrder) {
    Diagnostics log;
    const auto parts = partsOf(readSplit(wall(".AXIS2.,.NEGATIVE.,200."), log), "wall");
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NEAR(parts[0].box.max.y, 0.2, 1e-12);
    EXPECT_NEAR(parts[0].box.min.y, 0.18, 1e-12);
    EXPECT_NEAR(parts[2].box.min.y, -0.1, 1e-12);
    EXPECT_EQ(log.count(Severity::Warning), 0u);
}

TEST(IfcLayers, WithoutTheOptionAWallIsWhole) {
    Diagnostics log;
    const auto model = readText(wall(".AXIS2.,.POSITIVE.,-100."), &log);
    ASSERT_TRUE(model);
    EXPECT_TRUE(partsOf(*model, "wall").empty());
    EXPECT_EQ(log.count(Code::LayersSplit), 0u);
}

TEST(IfcLayers, LayersBesideABodyAsThickAreMovedOntoItAndThatIsSaid) {
    Diagnostics log;
    const auto parts = partsOf(readSplit(wall(".AXIS2.,.POSITIVE.,0."), log), "wall");
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NEAR(parts[0].box.min.y, -0.1, 1e-12);
    EXPECT_EQ(log.count(Code::LayersNotSplit), 1u);
}

TEST(IfcLayers, WhatIsThickerThanItsLayersKeepsTheRest) {
    // Only plaster and wool: 0.12 of the 0.3 m.
    Diagnostics log;
    std::string text = wall(".AXIS2.,.POSITIVE.,-100.");
    const std::string set = "(#311,#312,#314,#313)";
    text.replace(text.find(set), set.size(), "(#311,#312)");
    const auto model = readSplit(text, log);
    EXPECT_EQ(partsOf(model, "wall").size(), 2u);
    EXPECT_NEAR(ifc::enclosedVolume(facesOf(model, wallOf(model))), 10 * 0.18, 1e-12);
    EXPECT_EQ(log.count(Code::LayersNotSplit), 1u);
}

TEST(IfcLayers, WhatCannotBeSplitIsNamedAndStaysWhole) {
    const std::string set = "#321=IFCMATERIALLAYERSETUSAGE(#320,.AXIS2.,.POSITIVE.,-100.,$);";
    std::string withoutUsage = wall(".AXIS2.,.POSITIVE.,-100.");
    withoutUsage.replace(withoutUsage.find("(#100),#321"), 11, "(#100),#320");
    struct Case {
        std::string text, why;
    };
    for (const Case& c : {Case{wall(".AXIS2.,.POSITIVE.,-100.", "(#411,#413,#412)"), "its axis is not straight"},
                          Case{withoutUsage, "its layer set has no usage"},
                          Case{wall(".AXIS1.,.POSITIVE.,90000."), "its layers lie beside its body"}}) {
        Diagnostics log;
        const auto model = readSplit(c.text, log);
        EXPECT_TRUE(partsOf(model, "wall").empty()) << c.why;
        ASSERT_EQ(log.count(Code::LayersNotSplit), 1u) << c.why;
        bool isSaid = false;
        for (const Diagnostic& finding : log.items()) isSaid |= finding.message.find(c.why) != std::string::npos;
        EXPECT_TRUE(isSaid) << c.why;
        EXPECT_NEAR(ifc::enclosedVolume(facesOf(model, wallOf(model))), 10 * 0.3, 1e-12);
    }
}

TEST(IfcLayers, AWallThatStandsAskewIsSplitAlongItsLine) {
    // The same wall with its axis turned by 90 degrees: layers then follow each other along x.
    Diagnostics log;
    std::string text = wall(".AXIS2.,.POSITIVE.,0.", "(#411,#414)", "#414=IFCCARTESIANPOINT((0.,4000.));\n");
    const std::string thin = "IFCMATERIALLAYER(#303,180.";
    text.replace(text.find(thin), thin.size(), "IFCMATERIALLAYER(#303,3880.");
    const auto parts = partsOf(readSplit(text, log), "wall");
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NEAR(parts[0].box.size().x, 0.02, 1e-9);
    EXPECT_NEAR(parts[0].volume, 0.02 * 0.3 * 3, 1e-12);
}

}  // namespace
}  // namespace svt::readers
