#include <svt/readers/ifc/ifc_documents_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace svt::readers {
namespace {

using namespace test;

const model::Feature* find(const model::BuildingModel& model, const std::string& id) {
    for (const model::Feature& feature : model.features)
        if (feature.id == id) return &feature;
    return nullptr;
}

std::string attribute(const model::Feature& feature, const std::string& name) {
    for (const Attribute& a : feature.attributes)
        if (a.name == name) return toText(a.value) + (a.unit.empty() ? "" : " " + a.unit);
    return "none";
}

Box3d bounds(const model::BuildingModel& model, const model::Feature& feature) {
    return feature.geometries.empty() ? Box3d{} : model.bounds(feature.geometries[0]);
}

const char* const kBox =
    "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
    "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#103));\n"
    "#103=IFCEXTRUDEDAREASOLID(#104,#14,#11,1000.);\n"
    "#104=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);\n";

TEST(IfcReader, TheTreeAndItsClasses) {
    Diagnostics log;
    const auto model = readText(
        ifcFile(
            std::string("#100=IFCWALLSTANDARDCASE('wall',$,'W1','a wall','Basic',#15,#101,'tag7');\n"
                        "#110=IFCDOOR('door',$,'D1',$,$,#15,#101,$,$,$);\n#111=IFCPUMP('pump',$,$,$,$,#15,#101,$,$);\n"
                        "#112=IFCSPACE('space',$,'1.01',$,$,#15,#101,'Kitchen',$,$);\n"
                        "#113=IFCRELAGGREGATES('r',$,$,$,#32,(#112));\n"
                        "#114=IFCANNOTATION('note',$,$,$,$,#15,#101);\n#115=IFCNEWTHING('thing',$,$,$,$,#15,#101);\n"
                        "#116=IFCBUILDINGELEMENTPART('part',$,$,$,$,#15,#101,$);\n"
                        "#117=IFCRELAGGREGATES('r2',$,$,$,#100,(#116));\n"
                        "#118=IFCZONE('zone',$,'Zone A',$,$);\n"
                        "#119=IFCRELASSIGNSTOGROUP('r3',$,$,$,(#112),$,#118);\n") +
                kBox,
            "#100,#110,#111,#115"),
        &log);
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->format, "IFC 4");
    EXPECT_EQ(model->name, "Project");
    std::string tree;
    for (const model::FeatureIndex f : model->treeOrder()) {
        const model::Feature& feature = model->features[f];
        tree += feature.id + ":" + feature.className +
                (feature.parent == model::kNoFeature ? "" : "<" + model->features[feature.parent].id) + " ";
    }
    EXPECT_EQ(tree,
              "0site:GenericLogicalSpace 0building:Building<0site 0storey:Storey<0building "
              "wall:BuildingConstructiveElement<0storey part:BuildingConstructiveElement<wall door:Door<0storey "
              "pump:BuildingInstallation<0storey space:BuildingRoom<0storey thing:GenericOccupiedSpace<0storey "
              "note:Annotation zone:CityObjectGroup ");
    const model::Feature* wall = find(*model, "wall");
    ASSERT_NE(wall, nullptr);
    EXPECT_EQ(wall->name, "W1");
    EXPECT_EQ(attribute(*wall, "ifcType"), "IfcWallStandardCase");
    EXPECT_EQ(attribute(*wall, "description"), "a wall");
    EXPECT_EQ(attribute(*wall, "tag"), "tag7");
    EXPECT_EQ(attribute(*find(*model, "space"), "longName"), "Kitchen");
    ASSERT_EQ(model->memberships.size(), 1U);
    EXPECT_EQ(model->features[model->memberships[0].member].id, "space");
    EXPECT_EQ(log.count(Code::UnknownElement), 1U);
    ASSERT_EQ(log.count(Code::ProductsRead), 1U);
    EXPECT_EQ(log.items().back().message, "7 of 7 products with a shape were read, 0 of them in part");
}

TEST(IfcReader, SpacesByTheirLongNamesLayersAndComplexProperties) {
    const auto model =
        readText(ifcFile(std::string("#100=IFCSPACE('space',$,'1.01',$,$,#15,#101,'Kitchen',$,$);\n"
                                     "#110=IFCSPACE('unnamed',$,'1.02',$,$,#15,#101,$,$,$);\n"
                                     "#111=IFCSPATIALZONE('flat',$,'A',$,$,#15,#101,'Flat A',.OCCUPANCY.);\n"
                                     "#112=IFCSPATIALZONE('fire',$,'F',$,$,#15,#101,$,.FIRESAFETY.);\n"
                                     "#120=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(#102),$);\n"
                                     "#121=IFCPRESENTATIONLAYERWITHSTYLE('A-ITEM',$,(#103),$,.T.,.F.,.F.,());\n"
                                     "#130=IFCPROPERTYSET('p',$,'Set',$,(#131));\n"
                                     "#131=IFCCOMPLEXPROPERTY('Door',$,'usage',(#132,#133));\n"
                                     "#132=IFCPROPERTYSINGLEVALUE('Width',$,IFCPOSITIVELENGTHMEASURE(900.),$);\n"
                                     "#133=IFCCOMPLEXPROPERTY('Self',$,'usage',(#133));\n"
                                     "#134=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#100),#130);\n") +
                             kBox,
                         "#100,#110,#111,#112"));
    ASSERT_TRUE(model);
    const model::Feature& space = *find(*model, "space");
    EXPECT_EQ(space.name, "Kitchen");
    EXPECT_EQ(attribute(space, "number"), "1.01");
    EXPECT_EQ(attribute(space, "presentationLayer"), "A-WALL; A-ITEM");
    EXPECT_EQ(attribute(space, "Set.Door.Width"), "0.9 m");
    EXPECT_EQ(find(*model, "unnamed")->name, "1.02");
    EXPECT_EQ(find(*model, "flat")->className, "BuildingUnit");
    EXPECT_EQ(find(*model, "flat")->name, "Flat A");
    EXPECT_EQ(find(*model, "fire")->className, "GenericLogicalSpace");
}

TEST(IfcReader, PredefinedTypesStandWhereEachClassHasThem) {
    constexpr std::pair<const char*, const char*> kTypes[] = {
        {"DECK", "IFCSLAB('DECK',$,$,$,$,#15,#101,$,.DECK.)"},
        {"GABLE_ROOF", "IFCROOF('GABLE_ROOF',$,$,$,$,#15,#101,$,.GABLE_ROOF.)"},
        {"GATE", "IFCDOOR('GATE',$,$,$,$,#15,#101,$,2000.,900.,.GATE.,.SWING_LEFT.,$)"},
        {"SKYLIGHT", "IFCWINDOW('SKYLIGHT',$,$,$,$,#15,#101,$,900.,900.,.SKYLIGHT.,$,$)"},
        {"WINDER", "IFCSTAIRFLIGHT('WINDER',$,$,$,$,#15,#101,$,9,8,170.,290.,.WINDER.)"},
        {"TRUSS", "IFCELEMENTASSEMBLY('TRUSS',$,$,$,$,#15,#101,$,.SITE.,.TRUSS.)"},
        {"STUD", "IFCREINFORCINGBAR('STUD',$,$,$,$,#15,#101,$,'B500',12.,$,$,.STUD.,.PLAIN.)"},
        {"USERDEFINED", "IFCREINFORCINGMESH('USERDEFINED',$,$,$,$,#15,#101,$,$,$,$,6.,6.,28.,28.,1.,1.,.USERDEFINED.)"},
        {"STRAND", "IFCTENDON('STRAND',$,$,$,$,#15,#101,$,$,.STRAND.,$,$,$,$,$,$,$,$)"},
        {"BOLT", "IFCMECHANICALFASTENER('BOLT',$,$,$,$,#15,#101,$,8.,80.,.BOLT.)"},
        {"RADIAL", "IFCGRID('RADIAL',$,$,$,$,#15,#101,(#10),(#10),$,.RADIAL.)"},
        {"SURVEY", "IFCANNOTATION('SURVEY',$,$,$,$,#15,#101,.SURVEY.)"}};
    std::string records = kBox, contained;
    for (int id = 500; const auto& [type, product] : kTypes) {
        records += fmt::format("#{}={};\n", id, product);
        contained += fmt::format("{}#{}", contained.empty() ? "" : ",", id++);
    }
    const auto model = readText(ifcFile(records, contained, "IFC4X3_ADD2"));
    ASSERT_TRUE(model);
    for (const auto& [type, product] : kTypes)
        EXPECT_EQ(attribute(*find(*model, type), "predefinedType"), type) << product;
}

// 3 m along an L of 2 m in x and 4 m in y, a metre to the left, half a metre up.
TEST(IfcReader, LinearPlacementsGoAlongACurve) {
    const auto model =
        readText(ifcFile(std::string("#100=IFCWALL('wall',$,'Wall',$,$,#110,#101,$,$);\n"
                                     "#110=IFCLINEARPLACEMENT($,#111,$);\n#111=IFCAXIS2PLACEMENTLINEAR(#112,$,$);\n"
                                     "#112=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(3000.),1000.,500.,$,#113);\n"
                                     "#113=IFCPOLYLINE((#10,#114,#115));\n#114=IFCCARTESIANPOINT((2000.,0.,0.));\n"
                                     "#115=IFCCARTESIANPOINT((2000.,4000.,0.));\n") +
                             kBox,
                         "#100", "IFC4X3_ADD2"));
    ASSERT_TRUE(model);
    const Box3d box = bounds(*model, *find(*model, "wall"));
    // The profile of 0.2 x 0.3 m stands across the second leg, turned by a quarter.
    EXPECT_NEAR(box.center().x, 1, 1e-12);
    EXPECT_NEAR(box.center().y, 1, 1e-12);
    EXPECT_NEAR(box.min.z, 0.5, 1e-12);
    EXPECT_NEAR(box.size().x, 0.3, 1e-12);
    EXPECT_NEAR(box.size().y, 0.2, 1e-12);
}

TEST(IfcReader, PlacementsAndUnits) {
    const std::string records = std::string(
                                    "#100=IFCWALL('wall',$,$,$,$,#40,#101,$,$);\n#40=IFCLOCALPLACEMENT(#41,#42);\n"
                                    "#42=IFCAXIS2PLACEMENT3D(#43,#11,#13);\n#43=IFCCARTESIANPOINT((1000.,0.,0.));\n"
                                    "#41=IFCLOCALPLACEMENT($,#44);\n#44=IFCAXIS2PLACEMENT3D(#45,$,$);\n"
                                    "#45=IFCCARTESIANPOINT((0.,2000.,500.));\n") +
                                kBox;
    const auto model = readText(ifcFile(records, "#100"));
    ASSERT_TRUE(model);
    const Box3d box = bounds(*model, *find(*model, "wall"));
    // Turned by a quarter: x of the profile points north.
    EXPECT_NEAR(box.min.x, 1 - 0.15, 1e-12);
    EXPECT_NEAR(box.max.x, 1 + 0.15, 1e-12);
    EXPECT_NEAR(box.min.y, 2 - 0.1, 1e-12);
    EXPECT_NEAR(box.max.z, 1.5, 1e-12);
    const auto feet = readText(ifcFile(records, "#100", "IFC2X3",
                                       "#3=IFCCONVERSIONBASEDUNIT(#7,.LENGTHUNIT.,'FOOT',#8);\n"
                                       "#7=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
                                       "#8=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#9);\n"
                                       "#9=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);"));
    ASSERT_TRUE(feet);
    EXPECT_EQ(feet->format, "IFC 2x3");
    EXPECT_NEAR(bounds(*feet, *find(*feet, "wall")).max.z, 1500 * 0.3048, 1e-9);
}

TEST(IfcReader, PropertiesQuantitiesTypesAndMaterials) {
    const auto model = readText(ifcFile(
        std::string(
            "#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n#200=IFCRELDEFINESBYPROPERTIES('a',$,$,$,(#100),#201);\n"
            "#201=IFCPROPERTYSET('b',$,'Pset_WallCommon',$,(#202,#203,#204,#205));\n"
            "#202=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n"
            "#203=IFCPROPERTYSINGLEVALUE('Reference',$,IFCIDENTIFIER('W-1'),$);\n"
            "#204=IFCPROPERTYSINGLEVALUE('Width',$,IFCPOSITIVELENGTHMEASURE(300.),$);\n"
            "#205=IFCPROPERTYENUMERATEDVALUE('Status',$,(IFCLABEL('NEW'),IFCLABEL('OLD')),$);\n"
            "#210=IFCRELDEFINESBYPROPERTIES('c',$,$,$,(#100),#211);\n"
            "#211=IFCELEMENTQUANTITY('d',$,'BaseQuantities',$,$,(#212,#213));\n"
            "#212=IFCQUANTITYVOLUME('NetVolume',$,$,0.06);\n#213=IFCQUANTITYLENGTH('Length',$,$,4000.);\n"
            "#220=IFCRELDEFINESBYTYPE('e',$,$,$,(#100),#221);\n"
            "#221=IFCWALLTYPE('f',$,'Type 30',$,$,(#222),$,$,$,.STANDARD.);\n"
            "#222=IFCPROPERTYSET('g',$,'Pset_WallCommon',$,(#223,#224));\n"
            "#223=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.F.),$);\n"
            "#224=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F90'),$);\n"
            "#230=IFCRELASSOCIATESMATERIAL('h',$,$,$,(#100),#231);\n"
            "#231=IFCMATERIALLAYERSETUSAGE(#232,.AXIS2.,.POSITIVE.,0.,$);\n"
            "#232=IFCMATERIALLAYERSET((#233,#234),$,$);\n#233=IFCMATERIALLAYER(#235,200.,$,$,$,$,$);\n"
            "#234=IFCMATERIALLAYER(#236,100.,$,$,$,$,$);\n#235=IFCMATERIAL('Stahlbeton',$,$);\n"
            "#236=IFCMATERIAL('D\\X2\\00E4\\X0\\mmung',$,$);\n"
            "#240=IFCRELASSOCIATESCLASSIFICATION('i',$,$,$,(#100),#241);\n"
            "#241=IFCCLASSIFICATIONREFERENCE($,'330','Walls',$,$,$);\n") +
            kBox,
        "#100"));
    ASSERT_TRUE(model);
    const model::Feature& wall = *find(*model, "wall");
    EXPECT_EQ(attribute(wall, "Pset_WallCommon.IsExternal"), "true");  // its own, not that of the type
    EXPECT_EQ(attribute(wall, "Pset_WallCommon.FireRating"), "F90");
    EXPECT_EQ(attribute(wall, "Pset_WallCommon.Reference"), "W-1");
    EXPECT_EQ(attribute(wall, "Pset_WallCommon.Width"), "0.3 m");
    EXPECT_EQ(attribute(wall, "Pset_WallCommon.Status"), "NEW, OLD");
    EXPECT_EQ(attribute(wall, "BaseQuantities.NetVolume"), "0.06 m3");
    EXPECT_EQ(attribute(wall, "BaseQuantities.Length"), "4 m");
    EXPECT_EQ(attribute(wall, "type"), "Type 30");
    EXPECT_EQ(attribute(wall, "material"), "Stahlbeton; D\u00e4mmung");
    EXPECT_EQ(attribute(wall, "materialLayers"), "Stahlbeton 0.2 m; D\u00e4mmung 0.1 m");
    EXPECT_EQ(attribute(wall, "classification"), "330 Walls");
}

TEST(IfcReader, StylesBecomeMaterials) {
    const std::string style =
        "#301=IFCSURFACESTYLE('red',.BOTH.,(#302));\n#302=IFCSURFACESTYLERENDERING(#303,0.25,$,$,$,$,$,$,"
        ".FLAT.);\n#303=IFCCOLOURRGB($,1.,0.5,0.);\n";
    const auto model = readText(ifcFile(
        "#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n#300=IFCSTYLEDITEM(#103,(#301),$);\n" + style + kBox, "#100"));
    ASSERT_TRUE(model);
    ASSERT_EQ(model->materials.size(), 1U);
    EXPECT_EQ(model->materials[0].name, "red");
    EXPECT_FLOAT_EQ(model->materials[0].diffuse.y, 0.5F);
    EXPECT_FLOAT_EQ(model->materials[0].transparency, 0.25F);
    for (const model::Polygon& polygon : model->polygons) EXPECT_EQ(polygon.material, 0);
    const auto byMaterial = readText(
        ifcFile("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n#230=IFCRELASSOCIATESMATERIAL('h',$,$,$,(#100),#235);\n"
                "#235=IFCMATERIAL('brick',$,$);\n#236=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#237),#235);\n"
                "#237=IFCSTYLEDREPRESENTATION(#20,$,$,(#238));\n#238=IFCSTYLEDITEM($,(#239),$);\n"
                "#239=IFCPRESENTATIONSTYLEASSIGNMENT((#301));\n" +
                    style + kBox,
                "#100"));
    ASSERT_TRUE(byMaterial);
    for (const model::Polygon& polygon : byMaterial->polygons) EXPECT_EQ(polygon.material, 0);
}

TEST(IfcReader, ShapeAspectsNamePartsAndTheirConstituentsColorThem) {
    const auto model = readText(ifcFile(
        "#100=IFCWINDOW('window',$,$,$,$,#15,#101,$,1000.,1000.,$,$,$);\n"
        "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
        "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#200,#201,#202));\n"
        "#200=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);\n#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,60.,80.);\n"
        "#201=IFCEXTRUDEDAREASOLID(#301,#14,#11,1000.);\n#301=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,1000.,7.);\n"
        "#202=IFCEXTRUDEDAREASOLID(#302,#14,#11,20.);\n#302=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,10.,10.);\n"
        "#400=IFCSHAPEASPECT((#402),'Framing',$,.T.,#101);\n#401=IFCSHAPEASPECT((#403),'Glazing',$,.T.,#101);\n"
        "#402=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#200));\n"
        "#403=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#201));\n"
        "#410=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#100),#411);\n"
        "#411=IFCMATERIALCONSTITUENTSET('set',$,(#412,#413));\n"
        "#412=IFCMATERIALCONSTITUENT('Framing',$,#414,$,$);\n#413=IFCMATERIALCONSTITUENT('Glazing',$,#415,$,$);\n"
        "#414=IFCMATERIAL('oak',$,$);\n#415=IFCMATERIAL('float glass',$,$);\n"
        "#420=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#421),#415);\n"
        "#421=IFCSTYLEDREPRESENTATION(#20,$,$,(#422));\n#422=IFCSTYLEDITEM($,(#423),$);\n"
        "#423=IFCSURFACESTYLE('blue',.BOTH.,(#424));\n#424=IFCSURFACESTYLESHADING(#425,0.8);\n"
        "#425=IFCCOLOURRGB($,0.,0.,1.);\n",
        "#100"));
    ASSERT_TRUE(model);
    const auto& solids = model->features.back().geometries.front().solids;
    ASSERT_EQ(solids.size(), 3u);
    const auto materialOf = [&](std::size_t solid) {
        const std::int32_t number = model->polygons[solids[solid].exterior.front().polygon].material;
        return number < 0 ? model::Material{} : model->materials[static_cast<std::size_t>(number)];
    };
    EXPECT_EQ(materialOf(0).part, "Framing");
    EXPECT_EQ(materialOf(0).name, "oak");
    EXPECT_FALSE(materialOf(0).hasColor);
    EXPECT_EQ(materialOf(1).part, "Glazing");
    EXPECT_EQ(materialOf(1).name, "float glass");
    EXPECT_EQ(materialOf(1).diffuse, (Vec3f{0, 0, 1}));
    EXPECT_FLOAT_EQ(materialOf(1).transparency, 0.8F);
    EXPECT_EQ(materialOf(2).part, "");
}

TEST(IfcReader, FacesHaveColorsOfTheirOwn) {
    const auto model =
        readText(ifcWithItem("#200=IFCTRIANGULATEDFACESET(#201,$,.T.,((1,3,2),(1,2,4),(2,2,4),(2,3,4),(3,1,4)),$);\n"
                             "#201=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1000.,0.,0.),(0.,1000.,0.),(0.,0.,1000.)));\n"
                             "#210=IFCINDEXEDCOLOURMAP(#200,0.75,#211,(1,2,1,2,9));\n"
                             "#211=IFCCOLOURRGBLIST(((1.,0.,0.),(0.,0.,1.)));\n"));
    ASSERT_TRUE(model);
    ASSERT_EQ(model->polygons.size(), 4u);  // the third has no area
    ASSERT_EQ(model->materials.size(), 2u);
    EXPECT_EQ(model->materials[1].diffuse, (Vec3f{0, 0, 1}));
    EXPECT_FLOAT_EQ(model->materials[0].transparency, 0.25F);
    std::vector<std::int32_t> colors;
    for (const model::Polygon& polygon : model->polygons) colors.push_back(polygon.material);
    EXPECT_EQ(colors, (std::vector<std::int32_t>{0, 1, 1, -1}));
}

TEST(IfcReader, RigidOperationsAndTables) {
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#50=IFCRIGIDOPERATION(#20,#51,IFCLENGTHMEASURE(457850.),"
                                                    "IFCLENGTHMEASURE(5439000.),110.);\n"
                                                    "#51=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#52);\n"
                                                    "#52=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
                                                    "#60=IFCPROPERTYSET('p',$,'Set',$,(#61));\n"
                                                    "#61=IFCPROPERTYTABLEVALUE('Sound',$,(IFCREAL(125.),IFCREAL(250.)),"
                                                    "(IFCLABEL('low'),IFCLABEL('high')),$,$,$,$);\n"
                                                    "#62=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#100),#60);\n") +
                                            kBox,
                                        "#100", "IFC4X3_ADD2"));
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->crs.epsg, 25832);
    const model::Feature& wall = *find(*model, "wall");
    EXPECT_NEAR(bounds(*model, wall).center().x, 457850, 1e-8);
    EXPECT_NEAR(bounds(*model, wall).min.z, 110, 1e-8);
    EXPECT_EQ(attribute(wall, "Set.Sound"), "125.: low, 250.: high");
}

TEST(IfcReader, RigidOperationsInAnglesAreAWarning) {
    Diagnostics findings;
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#50=IFCRIGIDOPERATION(#20,#51,IFCPLANEANGLEMEASURE(11.5),"
                                                    "IFCPLANEANGLEMEASURE(48.1),110.);\n"
                                                    "#51=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);\n") +
                                            kBox,
                                        "#100", "IFC4X3_ADD2"),
                                &findings);
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->crs.epsg, 0);
    ASSERT_EQ(findings.count(Code::BadValue), 1u);
}

TEST(IfcReader, DoorsKnowWhatTheyFill) {
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#110=IFCDOOR('door',$,$,$,$,#15,#101,$,$,$);\n"
                                                    "#111=IFCOPENINGELEMENT('hole',$,$,$,$,#15,$,$,$);\n"
                                                    "#112=IFCRELVOIDSELEMENT('a',$,$,$,#100,#111);\n"
                                                    "#113=IFCRELFILLSELEMENT('b',$,$,$,#111,#110);\n") +
                                            kBox,
                                        "#100"));
    ASSERT_TRUE(model);
    const model::Feature& door = *find(*model, "door");
    EXPECT_EQ(attribute(door, "fills"), "wall");
    EXPECT_EQ(model->features[door.parent].id, "wall");  // nothing else contains it
    EXPECT_EQ(find(*model, "hole"), nullptr);
}

TEST(IfcReader, GridsPlaceProducts) {
    const std::string grid =
        "#60=IFCGRID('grid',$,$,$,$,#61,$,(#63),(#64),$,$);\n#61=IFCLOCALPLACEMENT($,#62);\n"
        "#62=IFCAXIS2PLACEMENT3D(#65,$,$);\n#65=IFCCARTESIANPOINT((0.,0.,3000.));\n"
        "#63=IFCGRIDAXIS('A',#66,.T.);\n#64=IFCGRIDAXIS('1',#67,.T.);\n#66=IFCPOLYLINE((#70,#71));\n"
        "#67=IFCPOLYLINE((#72,#73));\n#70=IFCCARTESIANPOINT((0.,5000.));\n#71=IFCCARTESIANPOINT((9000.,5000.));\n"
        "#72=IFCCARTESIANPOINT((7000.,0.));\n#73=IFCCARTESIANPOINT((7000.,9000.));\n"
        "#68=IFCVIRTUALGRIDINTERSECTION((#63,#64),(100.,0.,0.));\n";
    for (const char* placement : {"#40=IFCGRIDPLACEMENT(#68,$);\n", "#40=IFCGRIDPLACEMENT(#61,#68,$);\n"}) {
        const auto model =
            readText(ifcFile("#100=IFCCOLUMN('column',$,$,$,$,#40,#101,$,$);\n" + grid + placement + kBox, "#100"));
        ASSERT_TRUE(model);
        const Vec3d center = bounds(*model, *find(*model, "column")).center();
        EXPECT_NEAR(center.x, 7, 1e-12);
        EXPECT_NEAR(center.y, 5.1, 1e-12);
        EXPECT_NEAR(center.z, 3.5, 1e-12);
    }
}

TEST(IfcReader, PlacementsThatCannotBeReadAreTold) {
    const char* const kParallel =
        "#40=IFCGRIDPLACEMENT(#68,$);\n#68=IFCVIRTUALGRIDINTERSECTION((#63,#63),(0.,0.,0.));\n"
        "#63=IFCGRIDAXIS('A',#66,.T.);\n#66=IFCPOLYLINE((#70,#71));\n#70=IFCCARTESIANPOINT((0.,5000.));\n"
        "#71=IFCCARTESIANPOINT((9000.,5000.));\n";
    const std::pair<const char*, const char*> cases[] = {
        {kParallel, "on a grid"},
        {"#40=IFCLOCALPLACEMENT(#41,#14);\n#41=IFCLOCALPLACEMENT(#40,#14);\n", "in a circle: #40"},
        {"#40=IFCLOCALPLACEMENT($,#999);\n", "which the file lacks"},
        {"#40=IFCLOCALPLACEMENT(#999,#14);\n", "attribute 1 of #40"},
        {"#40=IFCDIRECTION((1.,0.,0.));\n", "of the type"},
        {"", "#40, to which attribute 6 of #100 IFCCOLUMN refers and which the file lacks"},
    };
    for (const auto& [placement, words] : cases) {
        Diagnostics log;
        const auto model = readText(
            ifcFile(std::string("#100=IFCCOLUMN('column',$,$,$,$,#40,#101,$,$);\n") + placement + kBox, "#100"), &log);
        ASSERT_TRUE(model) << words;
        const auto found = std::ranges::find(log.items(), Code::ReadInPart, &Diagnostic::code);
        ASSERT_NE(found, log.items().end()) << words;
        EXPECT_NE(found->message.find(words), std::string::npos) << found->message;
    }
}

void expectWallOnTheMap(const model::BuildingModel& model, double height) {
    EXPECT_EQ(model.crs.epsg, 25832);
    const Box3d box = bounds(model, *find(model, "wall"));
    EXPECT_NEAR(box.min.x, 457850 - 0.15, 1e-8);
    EXPECT_NEAR(box.max.y, 5439000 + 0.1, 1e-8);
    EXPECT_NEAR(box.max.z, height + 1, 1e-9);
}

TEST(IfcReader, MapConversionMovesToTheMap) {
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#50=IFCMAPCONVERSION(#20,#51,457850.,5439000.,110.,0.,1.,1.);\n"
                                                    "#51=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#52);\n"
                                                    "#52=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n") +
                                            kBox,
                                        "#100"));
    ASSERT_TRUE(model) << model.error().message();
    expectWallOnTheMap(*model, 110);
    EXPECT_EQ(attribute(*find(*model, "0site"), "elevation"), "0.1 m");
    EXPECT_EQ(attribute(*find(*model, "0site"), "latitude").substr(0, 8), "49.09972");
}

// A wall, and property sets of georeferencing on the site. `conversion` and `crs` are lists of properties (name, value).
std::string ifcWithMapSets(const std::vector<std::pair<std::string, std::string>>& conversion,
                           const std::vector<std::pair<std::string, std::string>>& crs, const std::string& more = "") {
    std::string text = std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n") + kBox + more;
    const auto addSet = [&](int number, const char* name, const auto& properties) {
        std::string list;
        for (std::size_t n = 0; n < properties.size(); ++n) {
            const int own = number + 10 + int(n);
            list += fmt::format("{}#{}", n == 0 ? "" : ",", own);
            text += fmt::format("#{}=IFCPROPERTYSINGLEVALUE('{}',$,{},$);\n", own, properties[n].first,
                                properties[n].second);
        }
        text += fmt::format("#{}=IFCPROPERTYSET('set{}',$,'{}',$,({}));\n", number, number, name, list);
        text += fmt::format("#{}=IFCRELDEFINESBYPROPERTIES('rel{}',$,$,$,(#30),#{});\n", number + 1, number, number);
    };
    addSet(700, "ePSet_MapConversion", conversion);
    if (!crs.empty()) addSet(800, "ePSet_ProjectedCRS", crs);
    return ifcFile(text, "#100", "IFC2X3");
}

const std::vector<std::pair<std::string, std::string>> kMapSet{{"Eastings", "IFCLENGTHMEASURE(457850000.)"},
                                                               {"Northings", "IFCLENGTHMEASURE(5439000000.)"},
                                                               {"OrthogonalHeight", "IFCLENGTHMEASURE(110000.)"},
                                                               {"XAxisAbscissa", "IFCREAL(0.)"},
                                                               {"XAxisOrdinate", "IFCREAL(1.)"},
                                                               {"Scale", "IFCREAL(1.)"}};
const std::vector<std::pair<std::string, std::string>> kCrsSet{{"Name", "IFCLABEL('EPSG:25832')"}};

TEST(IfcReader, PropertySetsMoveToTheMap) {
    std::vector<std::pair<std::string, std::string>> plain{
        {"Eastings", "IFCREAL(457850.)"}, {"Northings", "IFCREAL(5439000.)"}, {"OrthogonalHeight", "IFCREAL(110.)"},
        {"XAxisAbscissa", "IFCREAL(0.)"}, {"XAxisOrdinate", "IFCREAL(2.)"},   {"TargetCRS", "IFCLABEL('EPSG:25832')"}};
    auto inMetres = kMapSet;
    for (std::size_t n = 0; n < 3; ++n) inMetres[n].second = "IFCLENGTHMEASURE(" + plain[n].second.substr(8);
    // Lengths in millimetres of the project, plain numbers, and lengths in the unit of the map.
    for (const std::string& text :
         {ifcWithMapSets(kMapSet, kCrsSet), ifcWithMapSets(plain, {}),
          ifcWithMapSets(inMetres, {{"Name", "IFCLABEL('EPSG:25832')"}, {"MapUnit", "IFCLABEL('METRE')"}})}) {
        Diagnostics log;
        const auto model = readText(text, &log);
        ASSERT_TRUE(model) << model.error().message();
        expectWallOnTheMap(*model, 110);
        EXPECT_EQ(std::ranges::count(log.items(), Code::BadValue, &Diagnostic::code), 0);
    }
}

TEST(IfcReader, PropertySetsWithoutAHeightSayWhatIsAssumed) {
    auto flat = kMapSet;
    flat.erase(flat.begin() + 2);
    Diagnostics log;
    const auto model = readText(ifcWithMapSets(flat, kCrsSet), &log);
    ASSERT_TRUE(model) << model.error().message();
    expectWallOnTheMap(*model, 0);
    const auto found = std::ranges::find(log.items(), Code::BadValue, &Diagnostic::code);
    ASSERT_NE(found, log.items().end());
    EXPECT_NE(found->message.find("OrthogonalHeight; 0 is assumed"), std::string::npos) << found->message;
}

TEST(IfcReader, PropertySetsThatContradictAreAFinding) {
    const auto findingsOf = [](const std::string& text, std::string& words) {
        Diagnostics log;
        auto model = readText(text, &log);
        EXPECT_TRUE(model);
        words.clear();
        for (const Diagnostic& item : log.items())
            if (item.code == Code::BadValue && item.severity == Severity::Warning) words += item.message + "\n";
        return std::move(*model);
    };
    const auto entity = [](const std::string& eastings) {
        return "#50=IFCMAPCONVERSION(#20,#51," + eastings +
               ",5439000.,110.,0.,1.,1.);\n#51=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#52);\n"
               "#52=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n";
    };
    std::string words;
    (void)findingsOf(ifcWithMapSets(kMapSet, kCrsSet, entity("457850.")), words);
    EXPECT_EQ(words, "");
    const auto other = findingsOf(ifcWithMapSets(kMapSet, kCrsSet, entity("457950.")), words);
    EXPECT_NE(words.find("IfcMapConversion and ePSet_MapConversion differ: origin (457950.000"), std::string::npos)
        << words;
    EXPECT_NEAR(bounds(other, *find(other, "wall")).min.x, 457950 - 0.15, 1e-8);
    (void)findingsOf(ifcWithMapSets(kMapSet, {{"Name", "IFCLABEL('EPSG:25833')"}}, entity("457850.")), words);
    EXPECT_NE(words.find("CRS 'EPSG:25832' and 'EPSG:25833'"), std::string::npos) << words;
    auto broken = kMapSet;
    broken[1].second = "IFCLABEL('north')";
    const auto local = findingsOf(ifcWithMapSets(broken, kCrsSet), words);
    EXPECT_NE(words.find("lacks a number for Eastings or Northings"), std::string::npos) << words;
    EXPECT_EQ(local.crs.epsg, 0);
}

// The attribute modelElevation of a storey at `place` metres in a building at `building` metres.
double levelOfStorey(double building, double place, const std::string& elevation, const std::string& more = "") {
    const auto placed = [](int number, double height) {
        return fmt::format(
            "#{0}=IFCLOCALPLACEMENT($,#{1});\n#{1}=IFCAXIS2PLACEMENT3D(#{2},$,$);\n"
            "#{2}=IFCCARTESIANPOINT((0.,0.,{3:.1f}));\n",
            number, number + 1, number + 2, 1000 * height);
    };
    std::string text = ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n") + kBox +
                                   placed(60, building) + placed(70, place) + more,
                               "#100");
    const auto replace = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace("'House',$,$,#15", "'House',$,$,#60");
    replace("'EG',$,$,#15,$,$,.ELEMENT.,0.)", "'EG',$,$,#70,$,$,.ELEMENT.," + elevation + ")");
    const auto model = readText(text);
    EXPECT_TRUE(model) << model.error().message();
    if (!model) return -1;
    for (const Attribute& a : find(*model, "0storey")->attributes)
        if (a.name == "modelElevation") return std::get<double>(a.value);
    return -1;
}

TEST(IfcReader, TheLevelOfAStoreyIsInTheCoordinatesOfTheModel) {
    EXPECT_NEAR(levelOfStorey(0, 3, "3000."), 3, 1e-9);
    EXPECT_NEAR(levelOfStorey(112, 115, "3000."), 115, 1e-9) << "relative to the building";
    EXPECT_NEAR(levelOfStorey(112, 115, "115000."), 115, 1e-9) << "above the sea";
    EXPECT_NEAR(levelOfStorey(112, 112, "3000."), 115, 1e-9) << "storeys that are not placed";
    EXPECT_NEAR(levelOfStorey(112, 112, "112000."), 112, 1e-9) << "the ground floor, above the sea";
    EXPECT_NEAR(levelOfStorey(0, 3, "$"), 3, 1e-9);
    EXPECT_NEAR(levelOfStorey(0, 3, "3000.",
                              "#50=IFCMAPCONVERSION(#20,#51,457850.,5439000.,110.,1.,0.,1.);\n"
                              "#51=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#52);\n"
                              "#52=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"),
                113, 1e-9);
}

TEST(IfcReader, TrueNorthOfThreeRatiosIsReadOrUnknown) {
    const auto northOf = [](const std::string& ratios, std::string& findings) {
        std::string text = ifcFile(
            "#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n#41=IFCDIRECTION((" + ratios + "));\n" + std::string(kBox),
            "#100");
        const std::string context = "1.E-05,#14,$);";
        text.replace(text.find(context), context.size(), "1.E-05,#14,#41);");
        Diagnostics log;
        const auto model = readText(text, &log);
        EXPECT_TRUE(model);
        for (const Diagnostic& d : log.items()) findings += d.toString();
        std::optional<double> north;
        for (const model::Feature& feature : model->features)
            for (const Attribute& a : feature.attributes)
                if (a.name == "trueNorth") north = std::get<double>(a.value);
        return north;
    };
    std::string findings;
    const auto counted = northOf("2.,6.12303176911189E-17,1.", findings);
    ASSERT_TRUE(counted);
    EXPECT_NEAR(*counted, 0, 1e-9);
    EXPECT_NE(findings.find("three ratios"), std::string::npos) << findings;
    findings.clear();
    EXPECT_FALSE(northOf("0.,0.6,0.8", findings));
    EXPECT_NE(findings.find("not level"), std::string::npos) << findings;
    findings.clear();
    EXPECT_NEAR(northOf("0.,1.,0.", findings).value_or(9), 0, 1e-9) << "a level direction of three ratios";
    EXPECT_EQ(findings.find("true north"), std::string::npos) << findings;
}

TEST(IfcReader, TrueNorthTurnsWithTheMap) {
    const auto northOf = [](const std::string& conversion, const std::string& site = "") {
        std::string text = ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                               "#40=IFCDIRECTION((0.,1.));\n#41=IFCDIRECTION((1.,0.));\n") +
                                       conversion + kBox,
                                   "#100");
        const std::string context = "1.E-05,#14,$);";
        text.replace(text.find(context), context.size(), "1.E-05,#14,#41);");
        if (!site.empty()) text.replace(text.find("#30=IFCSITE("), 12, site);
        const auto model = readText(text);
        EXPECT_TRUE(model) << model.error().message();
        std::vector<std::pair<std::string, double>> found;
        for (const model::Feature& feature : model->features)
            for (const Attribute& a : feature.attributes)
                if (a.name == "trueNorth") found.emplace_back(feature.id, std::get<double>(a.value));
        return found;
    };
    const std::string crs = "#51=IFCPROJECTEDCRS('Local grid',$,$,$,$,$,$);\n";
    const auto plain = northOf("");
    ASSERT_EQ(plain.size(), 1u);
    EXPECT_EQ(plain[0].first, "0site");
    EXPECT_NEAR(plain[0].second, 90, 1e-9);
    // The x axis of the project points to (0.6, 0.8) on the map, and so does true north.
    const auto turned = northOf("#50=IFCMAPCONVERSION(#20,#51,0.,0.,0.,0.6,0.8,1.);\n" + crs);
    ASSERT_EQ(turned.size(), 1u);
    EXPECT_NEAR(turned[0].second, std::atan2(0.6, 0.8) * 180 / std::numbers::pi, 1e-9);
    const auto withoutSite = northOf("", "#30=IFCSPATIALZONE(");
    ASSERT_EQ(withoutSite.size(), 1u);
    EXPECT_EQ(withoutSite[0].first, "0building");
}

TEST(IfcReader, MissingAndRepeatedIds) {
    Diagnostics log;
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#110=IFCWALL('wall',$,$,$,$,#15,#101,$,$);\n"
                                                    "#111=IFCWALL($,$,$,$,$,#15,#101,$,$);\n") +
                                            kBox,
                                        "#100,#110,#111"),
                                &log);
    ASSERT_TRUE(model);
    EXPECT_NE(find(*model, "wall_2"), nullptr);
    EXPECT_NE(find(*model, "IfcWall_111"), nullptr);
    EXPECT_EQ(log.count(Code::DuplicateId), 1U);
    EXPECT_EQ(log.count(Code::MissingId), 1U);
}

TEST(IfcReader, CirclesInTheTreeEnd) {
    Diagnostics log;
    const auto model = readText(ifcFile(std::string("#100=IFCWALL('a',$,$,$,$,#40,#101,$,$);\n"
                                                    "#110=IFCWALL('b',$,$,$,$,#15,#101,$,$);\n"
                                                    "#111=IFCRELAGGREGATES('r',$,$,$,#100,(#110));\n"
                                                    "#112=IFCRELAGGREGATES('r',$,$,$,#110,(#100));\n"
                                                    "#40=IFCLOCALPLACEMENT(#40,#14);\n") +
                                        kBox),
                                &log);
    ASSERT_TRUE(model);
    EXPECT_NE(find(*model, "a"), nullptr);
    EXPECT_NE(find(*model, "b"), nullptr);
    EXPECT_EQ(log.count(Code::ReferenceCycle), 2U);  // of the products, and of the placement
}

TEST(IfcReader, RefusesWhatIsNoIfc) {
    const auto other = readText(ifcFile("", "", "AUTOMOTIVE_DESIGN"));
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code(), Code::UnknownVersion);
    EXPECT_NE(other.error().message().find("AUTOMOTIVE_DESIGN"), std::string::npos);
    EXPECT_EQ(readText("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n#1=IFCPERSON($);\nENDSEC;\n"
                       "END-ISO-10303-21;\n")
                  .error()
                  .code(),
              Code::EmptyModel);
    EXPECT_TRUE(looksLikeIfc(std::as_bytes(std::span("\xEF\xBB\xBF\n ISO-10303-21;", 17))));
    EXPECT_FALSE(looksLikeIfc(std::as_bytes(std::span("<ifcXML>", 8))));
}

TEST(Ifc, CurvesOfAnnotationsAreLines) {
    Diagnostics log;
    const auto model = readText(
        ifcFile("#100=IFCANNOTATION('note',$,'Dimension',$,$,#101,#110);\n"
                "#101=IFCLOCALPLACEMENT(#15,#102);\n#102=IFCAXIS2PLACEMENT3D(#103,$,$);\n"
                "#103=IFCCARTESIANPOINT((1000.,2000.,3000.));\n"
                "#110=IFCPRODUCTDEFINITIONSHAPE($,$,(#111));\n"
                "#111=IFCSHAPEREPRESENTATION(#20,'Annotation','Annotation2D',(#120,#130,#140));\n"
                "#120=IFCGEOMETRICCURVESET((#121,#124));\n#121=IFCPOLYLINE((#16,#122));\n"
                "#122=IFCCARTESIANPOINT((500.,0.));\n#124=IFCCIRCLE(#17,1000.);\n"
                "#130=IFCMAPPEDITEM(#131,#132);\n#131=IFCREPRESENTATIONMAP(#14,#133);\n"
                "#132=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#134,2.,$);\n#134=IFCCARTESIANPOINT((0.,0.,1000.));\n"
                "#133=IFCSHAPEREPRESENTATION(#20,'Annotation','Curve2D',(#121));\n"
                "#140=IFCTEXTLITERAL('4.20',#17,.LEFT.);\n"
                "#200=IFCWALL('wall',$,'Wall',$,$,#15,#201,$,$);\n#201=IFCPRODUCTDEFINITIONSHAPE($,$,(#202,#203));\n"
                "#202=IFCSHAPEREPRESENTATION(#20,'Axis','Curve2D',(#121));\n"
                "#203=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#204));\n#204=IFCBLOCK(#14,1000.,1000.,1000.);\n",
                "#100,#200"),
        &log);
    ASSERT_TRUE(model) << model.error().message();
    ASSERT_EQ(model->lines.size(), 3u) << "the axis of a wall that has a body is none of it";
    for (const model::Polyline& line : model->lines) {
        const model::Feature& feature = model->features[line.feature];
        EXPECT_EQ(feature.id, "note");
        EXPECT_EQ(feature.className, "Annotation");
    }
    EXPECT_EQ(model->lines[0].points, (std::vector<Vec3d>{{1, 2, 3}, {1.5, 2, 3}}));
    EXPECT_GE(model->lines[1].points.size(), 49u);
    for (const Vec3d& p : model->lines[1].points) EXPECT_NEAR(length(p - Vec3d{1, 2, 3}), 1, 1e-9);
    EXPECT_EQ(model->lines[2].points, (std::vector<Vec3d>{{1, 2, 4}, {2, 2, 4}})) << "twice as large, a metre higher";
    EXPECT_EQ(log.count(Code::ReadInPart), 1u) << "the text is no line";
    EXPECT_EQ(log.count(Severity::Warning), 0u);
}

TEST(Ifc, MappedCurvesThatContainThemselvesEnd) {
    const auto model = readText(
        ifcFile("#100=IFCANNOTATION('note',$,'Loop',$,$,#15,#110);\n#110=IFCPRODUCTDEFINITIONSHAPE($,$,(#111));\n"
                "#111=IFCSHAPEREPRESENTATION(#20,'Annotation','Annotation2D',(#130,#130));\n"
                "#130=IFCMAPPEDITEM(#131,#132);\n#131=IFCREPRESENTATIONMAP(#14,#111);\n"
                "#132=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#10,1.,$);\n"
                "#200=IFCWALL('wall',$,'Wall',$,$,#15,#201,$,$);\n#201=IFCPRODUCTDEFINITIONSHAPE($,$,(#203));\n"
                "#203=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#204));\n#204=IFCBLOCK(#14,1000.,1000.,1000.);\n",
                "#100,#200"));
    ASSERT_TRUE(model);
    EXPECT_TRUE(model->lines.empty());
}

TEST(DrawingFacts, AreAttributesInMetres) {
    std::string file = ifcFile(
        "#100=IFCDOOR('door',$,'D',$,$,#15,$,$,2010.,885.,.DOOR.,.SINGLE_SWING_LEFT.,$);\n"
        "#101=IFCWINDOW('window',$,'W',$,$,#15,$,$,1200.,0.,$,$,$);\n"
        "#102=IFCSTAIRFLIGHT('flight',$,'S',$,$,#15,$,$,16,15,175.,280.,.STRAIGHT.);\n"
        "#103=IFCGRID('grid',$,'G',$,$,#15,$,(#110),(#111),$,$);\n"
        "#110=IFCGRIDAXIS('A',#112,.T.);\n"
        "#111=IFCGRIDAXIS('1',#999,.T.);\n"
        "#112=IFCPOLYLINE((#113,#114));\n"
        "#113=IFCCARTESIANPOINT((-1000.,0.));\n"
        "#114=IFCCARTESIANPOINT((9000.,500.));\n"
        "#115=IFCDOORLININGPROPERTIES('lining',$,'L',$,100.,50.,$,$,$,$,$,$,$,$,$,$,$);\n"
        "#116=IFCDOORTYPE('type',$,'T',$,$,(#115),$,$,$,.DOOR.,.SINGLE_SWING_LEFT.,$,$);\n"
        "#117=IFCRELDEFINESBYTYPE('relation',$,$,$,(#100),#116);\n"
        "#120=IFCPOSTALADDRESS($,$,$,'Hall 2',('Lake Road 3'),$,'Town','ZH\\X\\0D','8001','CH');\n",
        "#100,#101,#102,#103");
    const auto replace = [&](const std::string& from, const std::string& to) {
        file.replace(file.find(from), from.size(), to);
    };
    replace(".ELEMENT.,$,$,$);\n#32", ".ELEMENT.,$,$,#120);\n#32");
    replace("$,'Project',$,$,$,$,(#20)", "$,'P-7',$,$,'Town hall',$,(#20)");
    const auto model = readText(file);
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(attribute(*find(*model, "door"), "overallWidth"), "0.885 m");
    EXPECT_EQ(attribute(*find(*model, "door"), "overallHeight"), "2.01 m");
    EXPECT_EQ(attribute(*find(*model, "door"), "liningThickness"), "0.05 m");
    EXPECT_EQ(attribute(*find(*model, "window"), "overallHeight"), "1.2 m");
    EXPECT_EQ(attribute(*find(*model, "window"), "overallWidth"), "none");
    EXPECT_EQ(attribute(*find(*model, "flight"), "numberOfRisers"), "16");
    EXPECT_EQ(attribute(*find(*model, "flight"), "riserHeight"), "0.175 m");
    EXPECT_EQ(attribute(*find(*model, "0building"), "address"), "Hall 2, Lake Road 3, 8001 Town, ZH, CH");
    EXPECT_EQ(attribute(*find(*model, "0site"), "projectName"), "Town hall");
    EXPECT_EQ(model->name, "P-7");
    EXPECT_EQ(attribute(*find(*model, "grid"), "axis A"), "-1.000000 0.000000 0.000000, 9.000000 0.500000 0.000000 m");
    EXPECT_EQ(attribute(*find(*model, "grid"), "axis 1"), "none");
}

// A quarter of a circle of 4 m from the east to the north, and a polyline with a bend.
TEST(DrawingFacts, CurvedAxesOfGridsHaveAllTheirPoints) {
    const auto model = readText(ifcFile(
        "#103=IFCGRID('grid',$,'G',$,$,#15,$,(#110),(#111),$,$);\n"
        "#110=IFCGRIDAXIS('A',#112,.T.);\n#111=IFCGRIDAXIS('1',#120,.T.);\n"
        "#112=IFCTRIMMEDCURVE(#113,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(1.5707963267949)),.T.,.PARAMETER.);\n"
        "#113=IFCCIRCLE(#17,4000.);\n#120=IFCPOLYLINE((#121,#122,#123));\n"
        "#121=IFCCARTESIANPOINT((0.,0.));\n#122=IFCCARTESIANPOINT((5000.,0.));\n"
        "#123=IFCCARTESIANPOINT((5000.,3000.));\n",
        "#103"));
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(attribute(*find(*model, "grid"), "axis 1"),
              "0.000000 0.000000 0.000000, 5.000000 0.000000 0.000000, 5.000000 3.000000 0.000000 m");
    const std::string arc = attribute(*find(*model, "grid"), "axis A");
    EXPECT_TRUE(arc.starts_with("4.000000 0.000000 0.000000, ")) << arc;
    EXPECT_TRUE(arc.ends_with(", 0.000000 4.000000 0.000000 m")) << arc;
    EXPECT_GE(std::count(arc.begin(), arc.end(), ','), 12) << arc;
}

}  // namespace
}  // namespace svt::readers
