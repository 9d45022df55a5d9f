#include <svt/core/test_data_test.hpp>
#include <svt/readers/citygml/citygml_documents_test.hpp>

#include <map>
#include <set>

namespace svt::readers {
namespace {

using namespace gmltest;

const Attribute* attributeOf(const Feature& feature, std::string_view name) {
    for (const Attribute& attribute : feature.attributes)
        if (attribute.name == name) return &attribute;
    return nullptr;
}

std::string textOf(const Feature& feature, std::string_view name) {
    const Attribute* attribute = attributeOf(feature, name);
    return attribute == nullptr ? "(none)"
                                : toText(attribute->value) + (attribute->unit.empty() ? "" : " " + attribute->unit);
}

std::map<std::string, int> countByClass(const BuildingModel& model) {
    std::map<std::string, int> counts;
    for (const Feature& feature : model.features) ++counts[feature.className];
    return counts;
}

TEST(CityGmlReader, ReadsEveryVersion) {
    for (int version = 1; version <= 3; ++version) {
        const Reading reading =
            readMembers(version, building("b", lod2Surfaces(version, multiSurface(surfaceMember(square("p"))))));
        ASSERT_TRUE(reading.result) << reading.result.error().toString();
        EXPECT_EQ(reading.model().format, fmt::format("CityGML {}.0", version));
        EXPECT_EQ(reading.model().source, "test.gml");
        ASSERT_EQ(reading.model().features.size(), 1u);
        EXPECT_EQ(reading.feature("b").className, "Building");
        EXPECT_EQ(reading.feature("b").line, 3u);
        EXPECT_EQ(reading.model().roots, std::vector<model::FeatureIndex>{0});
    }
}

TEST(CityGmlReader, PrefixesDoNotMatterNamespacesDo) {
    const Reading reading = read(
        "\xEF\xBB\xBF<CityModel xmlns='http://www.opengis.net/citygml/2.0' xmlns:g=\"http://www.opengis.net/gml\" "
        "xmlns:ade='http://example.org/'>"
        "<cityObjectMember><b:Building xmlns:b='http://www.opengis.net/citygml/building/2.0' g:id='b'>"
        "<b:lod2MultiSurface><MultiSurface "
        "xmlns='http://www.opengis.net/gml'><surfaceMember><g:Polygon><exterior><LinearRing><posList>0 0 0 1 0 0 0 1 "
        "0</posList>"
        "</LinearRing></exterior></g:Polygon></surfaceMember></MultiSurface></b:lod2MultiSurface>"
        "<b:lod3MultiSurface><ade:MultiSurface/></b:lod3MultiSurface></b:Building></cityObjectMember></CityModel>");
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.model().polygons.size(), 1u);
    EXPECT_EQ(reading.feature("b").geometries.size(), 1u);
}

TEST(CityGmlReader, BuildingModuleOfVersion2IsReadWhole) {
    const std::string surfaces =
        "<bldg:lod4MultiSurface>" + multiSurface(surfaceMember(square(""))) + "</bldg:lod4MultiSurface>";
    const std::string geometry =
        "<bldg:lod4Geometry>" + multiSurface(surfaceMember(square(""))) + "</bldg:lod4Geometry>";
    const auto wall = [&](std::string_view property, std::string_view name, std::string_view more = "") {
        return fmt::format("<bldg:{0}><bldg:{1} gml:id=\"{1}\">{2}{3}</bldg:{1}></bldg:{0}>", property, name, surfaces,
                           more);
    };
    const auto object = [&](std::string_view property, std::string_view name, std::string_view more = "") {
        return fmt::format("<bldg:{0}><bldg:{1} gml:id=\"{1}\">{2}{3}</bldg:{1}></bldg:{0}>", property, name, geometry,
                           more);
    };
    std::string properties =
        "<bldg:lod0FootPrint>" + multiSurface(surfaceMember(square(""))) + "</bldg:lod0FootPrint><bldg:lod0RoofEdge>" +
        multiSurface(surfaceMember(square(""))) + "</bldg:lod0RoofEdge><bldg:lod1Solid>" +
        solid("", surfaceMember(square(""))) +
        "</bldg:lod1Solid><bldg:lod2MultiCurve><gml:MultiCurve/></"
        "bldg:lod2MultiCurve><bldg:lod2TerrainIntersection><gml:MultiCurve/></bldg:lod2TerrainIntersection>";
    properties += object("outerBuildingInstallation", "BuildingInstallation");
    properties += object("interiorBuildingInstallation", "IntBuildingInstallation");
    const std::string openings = wall("opening", "Window") + wall("opening", "Door");
    const std::string_view boundaries[] = {"RoofSurface",         "WallSurface",    "GroundSurface",
                                           "ClosureSurface",      "FloorSurface",   "OuterFloorSurface",
                                           "InteriorWallSurface", "CeilingSurface", "OuterCeilingSurface"};
    for (const std::string_view name : boundaries)
        properties += wall("boundedBy", name, name == "WallSurface" ? std::string_view(openings) : "");
    properties += object("interiorRoom", "Room", object("interiorFurniture", "BuildingFurniture"));
    properties += object("consistsOfBuildingPart", "BuildingPart");
    const Reading reading = readMembers(2, building("b", properties));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
    EXPECT_EQ(reading.model().features.size(), 17u);
    EXPECT_EQ(reading.feature("b").geometries.size(), 3u);
    EXPECT_EQ(reading.feature("b").children.size(), 13u);
    EXPECT_EQ(reading.feature("Room").className, "BuildingRoom");
    EXPECT_EQ(reading.feature("IntBuildingInstallation").className, "BuildingInstallation");
    EXPECT_EQ(reading.feature("Window").parent, reading.index("WallSurface"));
    EXPECT_EQ(reading.feature("BuildingFurniture").parent, reading.index("Room"));
    for (const Feature& feature : reading.model().features)
        EXPECT_EQ(feature.geometries.size(), feature.id == "b" ? 3u : 1u) << feature.id;
}

TEST(CityGmlReader, StoreysAndUnitsOfVersion3AreMembershipsWhereTheyPointAndParentsWhereTheyHold) {
    const std::string geometry = "<core:lod3Solid>" + solid("", surfaceMember(square(""))) + "</core:lod3Solid>";
    const Reading reading = readMembers(
        3,
        building(
            "b",
            "<bldg:buildingSubdivision><bldg:Storey gml:id=\"s\"><bldg:buildingRoom xlink:href=\"#r1\"/>"
            "<bldg:buildingRoom><bldg:BuildingRoom gml:id=\"r2\">" +
                geometry +
                "</bldg:BuildingRoom></bldg:buildingRoom>"
                "<bldg:buildingUnit><bldg:BuildingUnit gml:id=\"u\"><bldg:buildingRoom "
                "xlink:href=\"#r2\"/></bldg:BuildingUnit></bldg:buildingUnit></bldg:Storey></bldg:buildingSubdivision>"
                "<bldg:buildingRoom><bldg:BuildingRoom gml:id=\"r1\">" +
                geometry +
                "</bldg:BuildingRoom></bldg:buildingRoom>"
                "<bldg:buildingRoom xlink:href=\"#r2\"/>"
                "<bldg:buildingConstructiveElement><bldg:BuildingConstructiveElement gml:id=\"c\">" +
                geometry + "<con:filling><con:Window gml:id=\"win\">" + geometry +
                "<core:boundary><con:WindowSurface gml:id=\"ws\">" +
                lod2Surfaces(3, multiSurface(surfaceMember(square("")))) +
                "</con:WindowSurface></core:boundary></con:Window></con:filling>"
                "</bldg:BuildingConstructiveElement></bldg:buildingConstructiveElement>"
                "<core:boundary><con:WallSurface gml:id=\"w\"><con:fillingSurface><con:DoorSurface gml:id=\"d\">" +
                lod2Surfaces(3, multiSurface(surfaceMember(square("")))) +
                "</con:DoorSurface></con:fillingSurface></con:WallSurface></core:boundary>"));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
    EXPECT_EQ(reading.feature("r1").parent, reading.index("b"));
    EXPECT_EQ(reading.feature("r2").parent, reading.index("s"));
    EXPECT_EQ(reading.feature("win").parent, reading.index("c"));
    EXPECT_EQ(reading.feature("ws").parent, reading.index("win"));
    EXPECT_EQ(reading.feature("d").parent, reading.index("w"));
    const std::vector<model::Membership> expected{{reading.index("s"), reading.index("r1"), "buildingRoom"},
                                                  {reading.index("u"), reading.index("r2"), "buildingRoom"},
                                                  {reading.index("b"), reading.index("r2"), "buildingRoom"}};
    EXPECT_EQ(reading.model().memberships, expected);
}

TEST(CityGmlReader, GroupsKeepMembersWithTheirRoles) {
    const Reading two = readMembers(
        2, building("b", lod2Surfaces(2, multiSurface(surfaceMember(square(""))))) +
               member("<grp:CityObjectGroup "
                      "gml:id=\"g\"><grp:class>buildingSeparation</grp:class><grp:function>lodXStorey</grp:function>"
                      "<grp:groupMember role=\"main\" xlink:href=\"#b\"/><grp:groupMember "
                      "xlink:href=\"#nowhere\"/><grp:parent xlink:href=\"#b\"/></grp:CityObjectGroup>"));
    ASSERT_TRUE(two.result);
    EXPECT_EQ(two.model().memberships, (std::vector<model::Membership>{{two.index("g"), two.index("b"), "main"}}));
    EXPECT_EQ(textOf(two.feature("g"), "function"), "lodXStorey");
    EXPECT_EQ(textOf(two.feature("g"), "parent"), "#b");
    EXPECT_EQ(two.count(Code::DanglingReference), 1u);
    const Reading three = readMembers(
        3,
        building("b", lod2Surfaces(3, multiSurface(surfaceMember(square(""))))) +
            member("<grp:CityObjectGroup "
                   "gml:id=\"g\"><grp:groupMember><grp:Role><grp:role>main</grp:role><grp:groupMember "
                   "xlink:href=\"#b\"/></grp:Role></grp:groupMember>"
                   "<grp:groupMember><grp:Role><grp:role>side</grp:role><grp:groupMember><gen:GenericOccupiedSpace "
                   "gml:id=\"o\">" +
                   lod2Surfaces(3, multiSurface(surfaceMember(square("")))) +
                   "</gen:GenericOccupiedSpace></grp:groupMember></grp:Role></grp:groupMember></grp:CityObjectGroup>"));
    const std::vector<model::Membership> members{{three.index("g"), three.index("o"), "side"},
                                                 {three.index("g"), three.index("b"), "main"}};
    EXPECT_EQ(three.model().memberships, members);
    EXPECT_EQ(three.feature("o").parent, three.index("g"));
}

TEST(CityGmlReader, EveryModuleWithGeometryIsRead) {
    const std::string shape = multiSurface(surfaceMember(square("")));
    const auto with = [&](std::string_view prefix, std::string_view name, std::string_view property) {
        return member(
            fmt::format("<{0}:{1} gml:id=\"{1}\"><{0}:{2}>{3}</{0}:{2}></{0}:{1}>", prefix, name, property, shape));
    };
    const Reading reading = readMembers(
        2,
        with("brid", "Bridge", "lod2MultiSurface") + with("tun", "Tunnel", "lod2MultiSurface") +
            with("gen", "GenericCityObject", "lod1Geometry") + with("frn", "CityFurniture", "lod4Geometry") +
            with("veg", "SolitaryVegetationObject", "lod3Geometry") + with("veg", "PlantCover", "lod1MultiSurface") +
            with("luse", "LandUse", "lod0MultiSurface") + with("tran", "Road", "lod1MultiSurface") +
            with("wtr", "WaterBody", "lod1MultiSurface") +
            member("<dem:ReliefFeature gml:id=\"relief\"><dem:lod>3</dem:lod><dem:reliefComponent><dem:TINRelief "
                   "gml:id=\"tin\"><dem:lod>3</dem:lod><dem:extent>" +
                   square("") +
                   "</dem:extent><dem:tin><gml:TriangulatedSurface><gml:trianglePatches><gml:Triangle><gml:exterior>" +
                   ring("0 0 0 1 0 0 0 1 0 0 0 0") +
                   "</gml:exterior></gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface></dem:tin></"
                   "dem:TINRelief></dem:reliefComponent></dem:ReliefFeature>") +
            "<gml:featureMember><luse:LandUse gml:id=\"single\"/></gml:featureMember><gml:featureMembers><luse:LandUse "
            "gml:id=\"one\"/><luse:LandUse gml:id=\"two\"/></gml:featureMembers>");
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().features.size(), 14u);
    EXPECT_EQ(reading.model().polygons.size(), 10u) << "the extent is no surface";
    EXPECT_EQ(reading.feature("tin").geometries.at(0).lod, 3);
    EXPECT_EQ(reading.feature("GenericCityObject").className, "GenericOccupiedSpace");
    EXPECT_EQ(reading.model().roots.size(), 13u);
}

TEST(CityGmlReader, UnknownAdeFeaturesAndPropertiesAreNotLost) {
    const Reading reading =
        readMembers(2, building("b",
                                "<ade:owner>Ms. A</ade:owner><ade:area "
                                "uom=\"m2\">12.5</ade:area><ade:energy><ade:Demand><ade:kind>heat</ade:kind><ade:value "
                                "uom=\"kWh\">7</ade:value></ade:Demand></ade:energy>"
                                "<ade:zone><ade:ThermalZone><ade:lod2Solid>" +
                                    solid("", surfaceMember(square(""))) +
                                    "</ade:lod2Solid></ade:ThermalZone></ade:zone>"
                                    "<gml:strange><x/></gml:strange>") +
                           member("<ade:Parcel gml:id=\"parcel\"><ade:number>5</ade:number></ade:Parcel>"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(textOf(reading.feature("b"), "owner"), "Ms. A");
    EXPECT_EQ(textOf(reading.feature("b"), "area"), "12.5 m2");
    EXPECT_EQ(textOf(reading.feature("b"), "energy"), "7 kWh");
    EXPECT_EQ(textOf(reading.feature("b"), "energy/kind"), "heat");
    EXPECT_EQ(reading.feature("b/ThermalZone[1]").geometries.size(), 1u);
    EXPECT_EQ(textOf(reading.feature("parcel"), "number"), "5");
    EXPECT_EQ(reading.count(Code::UnknownElement), 1u) << reading.findings();
}

TEST(CityGmlReader, AttributesHaveTheirTypesAndUnits) {
    const Reading reading = readMembers(
        2,
        building(
            "b",
            "<gml:description>two &lt;flats&gt; &amp; more</gml:description><gml:name>Haus "
            "&#228;</gml:name><gml:name>second</gml:name><core:creationDate>2020-01-02</core:creationDate>"
            "<gen:stringAttribute name=\"s\"><gen:value>text</gen:value></gen:stringAttribute><gen:intAttribute "
            "name=\"i\"><gen:value>-7</gen:value></gen:intAttribute>"
            "<gen:doubleAttribute name=\"d\"><gen:value>2.5</gen:value></gen:doubleAttribute><gen:dateAttribute "
            "name=\"t\"><gen:value>2021-01-01</gen:value></gen:dateAttribute>"
            "<gen:uriAttribute name=\"u\"><gen:value>http://example.org</gen:value></gen:uriAttribute>"
            "<gen:measureAttribute name=\"m\"><gen:value "
            "uom=\"urn:ogc:def:uom:UCUM::m2\">3</gen:value></gen:measureAttribute>"
            "<gen:genericAttributeSet name=\"set\"><gen:stringAttribute "
            "name=\"a\"><gen:value>x</gen:value></gen:stringAttribute>"
            "<gen:genericAttributeSet name=\"inner\"><gen:intAttribute "
            "name=\"b\"><gen:value>1</gen:value></gen:intAttribute></gen:genericAttributeSet></gen:genericAttributeSet>"
            "<gen:intAttribute name=\"bad\"><gen:value>many</gen:value></gen:intAttribute>"
            "<bldg:class>1000</bldg:class><bldg:function>1010</bldg:function><bldg:function>1020</"
            "bldg:function><bldg:yearOfConstruction>1985</bldg:yearOfConstruction>"
            "<bldg:measuredHeight "
            "uom=\"#m\">9.5</bldg:measuredHeight><bldg:storeysAboveGround>2</"
            "bldg:storeysAboveGround><bldg:storeyHeightsAboveGround uom=\"m\">3.0 2.5</bldg:storeyHeightsAboveGround>"
            "<core:externalReference><core:informationSystem>sys</"
            "core:informationSystem><core:externalObject><core:name>n</core:name></core:externalObject></"
            "core:externalReference>"));
    const Feature& feature = reading.feature("b");
    EXPECT_EQ(feature.name, "Haus \xC3\xA4");
    EXPECT_EQ(textOf(feature, "description"), "two <flats> & more");
    EXPECT_EQ(textOf(feature, "name"), "second");
    EXPECT_EQ(attributeOf(feature, "s")->value, AttributeValue(std::string("text")));
    EXPECT_EQ(attributeOf(feature, "i")->value, AttributeValue(std::int64_t{-7}));
    EXPECT_EQ(attributeOf(feature, "d")->value, AttributeValue(2.5));
    EXPECT_EQ(textOf(feature, "t"), "2021-01-01");
    EXPECT_EQ(textOf(feature, "u"), "http://example.org");
    EXPECT_EQ(textOf(feature, "m"), "3 m2");
    EXPECT_EQ(textOf(feature, "set/a"), "x");
    EXPECT_EQ(attributeOf(feature, "set/inner/b")->value, AttributeValue(std::int64_t{1}));
    EXPECT_EQ(textOf(feature, "bad"), "many");
    EXPECT_EQ(reading.count(Code::BadValue), 1u);
    EXPECT_EQ(attributeOf(feature, "class")->value, AttributeValue(std::string("1000")));
    EXPECT_EQ(std::count_if(feature.attributes.begin(), feature.attributes.end(),
                            [](const Attribute& a) { return a.name == "function"; }),
              2);
    EXPECT_EQ(attributeOf(feature, "yearOfConstruction")->value, AttributeValue(std::int64_t{1985}));
    EXPECT_EQ(textOf(feature, "measuredHeight"), "9.5 m");
    EXPECT_EQ(textOf(feature, "storeyHeightsAboveGround"), "3.0 2.5 m");
    EXPECT_EQ(textOf(feature, "externalReference/informationSystem"), "sys");
}

TEST(CityGmlReader, AttributesOfVersion3) {
    const Reading reading = readMembers(
        3, building("b",
                    "<core:genericAttribute><gen:StringAttribute><gen:name>ifcType</gen:name><gen:value>IfcSlab</"
                    "gen:value></gen:StringAttribute></core:genericAttribute>"
                    "<core:genericAttribute><gen:GenericAttributeSet><gen:name>set</"
                    "gen:name><core:genericAttribute><gen:MeasureAttribute><gen:name>m</gen:name><gen:value "
                    "uom=\"m\">1.5</gen:value></gen:MeasureAttribute></core:genericAttribute></"
                    "gen:GenericAttributeSet></core:genericAttribute>"
                    "<core:genericAttribute><gen:CodeAttribute><gen:name>code</gen:name><gen:value>7</gen:value></"
                    "gen:CodeAttribute></core:genericAttribute>"
                    "<con:height><con:Height><con:status>measured</con:status><con:value "
                    "uom=\"m\">9.5</con:value></con:Height></con:height>"
                    "<core:volume><core:QualifiedVolume><core:volume "
                    "uom=\"m3\">12</core:volume><core:typeOfVolume>gross</core:typeOfVolume></core:QualifiedVolume></"
                    "core:volume>"
                    "<core:adeOfAbstractCityObject><ade:Props><ade:extra>yes</ade:extra></ade:Props></"
                    "core:adeOfAbstractCityObject>"));
    const Feature& feature = reading.feature("b");
    EXPECT_EQ(textOf(feature, "ifcType"), "IfcSlab");
    EXPECT_EQ(textOf(feature, "set/m"), "1.5 m");
    EXPECT_EQ(attributeOf(feature, "code")->value, AttributeValue(std::string("7")));
    EXPECT_EQ(textOf(feature, "height"), "9.5 m");
    EXPECT_EQ(textOf(feature, "height/status"), "measured");
    EXPECT_EQ(textOf(feature, "volume"), "12 m3");
    EXPECT_EQ(textOf(feature, "extra"), "yes");
}

// As in models of PLATEAU: floods that a river and the sea would cause.
TEST(CityGmlReader, RepeatedPropertiesAreRecords) {
    const auto flood = [](const char* type, const char* members) {
        return fmt::format("<ade:risk><ade:{0}>{1}</ade:{0}></ade:risk>", type, members);
    };
    const Reading reading = readMembers(
        2, building("b", flood("River", "<ade:depth uom=\"m\">0.5</ade:depth><ade:rank>1</ade:rank>") +
                             flood("River", "<ade:rank>3</ade:rank>") +
                             "<gen:genericAttributeSet name=\"s\"><gen:intAttribute name=\"a\"><gen:value>1</gen:value>"
                             "</gen:intAttribute></gen:genericAttributeSet>" +
                             flood("Tsunami", "<ade:depth uom=\"m\">2</ade:depth><ade:by>x</ade:by>") +
                             "<gen:genericAttributeSet name=\"s\"><gen:intAttribute name=\"b\"><gen:value>2</gen:value>"
                             "</gen:intAttribute></gen:genericAttributeSet>"
                             "<gen:stringAttribute name=\"k\"><gen:value>p</gen:value></gen:stringAttribute>"
                             "<gen:stringAttribute name=\"k\"><gen:value>q</gen:value></gen:stringAttribute>"
                             "<core:externalReference><core:informationSystem>sys</core:informationSystem>"
                             "<core:externalObject><core:name>n</core:name></core:externalObject>"
                             "</core:externalReference>"));
    std::string text;
    for (const AttributeList& list : attributeLists(reading.feature("b").attributes))
        text += std::string(list.name) + "=" + toText(list) + "\n";
    EXPECT_EQ(text,
              "risk/depth=[0.5,null,2]\nrisk/rank=[\"1\",\"3\",null]\ns/a=[1,null]\nrisk/by=[null,null,\"x\"]\n"
              "s/b=[null,2]\nk=[\"p\",\"q\"]\nexternalReference/informationSystem=sys\nexternalReference/name=n\n");
}

TEST(CityGmlReader, MissingAndDuplicateIdsBecomeUnique) {
    const std::string room = "<bldg:interiorRoom><bldg:Room/></bldg:interiorRoom>";
    const Reading reading = readMembers(2, member("<bldg:Building>" + room + room + "</bldg:Building>") +
                                               building("x", room) + building("x", "") + building("x", "") +
                                               building("x_2", "") + member("<bldg:Building gml_id=\"wrong\"/>"));
    ASSERT_TRUE(reading.result);
    std::vector<std::string> ids;
    for (const Feature& feature : reading.model().features) ids.push_back(feature.id);
    EXPECT_EQ(
        ids, (std::vector<std::string>{"Building[1]", "Building[1]/BuildingRoom[1]", "Building[1]/BuildingRoom[2]", "x",
                                       "x/BuildingRoom[1]", "x_3", "x_4", "x_2", "wrong"}));
    EXPECT_EQ(reading.count(Code::DuplicateId), 2u);
    EXPECT_EQ(reading.count(Code::MissingId), 3u) << "one per class, one for gml_id: " << reading.findings();
    EXPECT_EQ(reading.count(Code::NoGeometry), 7u);
    EXPECT_EQ(reading.count(Code::EmptyModel), 1u);
}

TEST(CityGmlReader, MaterialsOfTheFirstThemeGoToPolygons) {
    for (int version = 1; version <= 3; ++version) {
        const std::string_view surfaceData = version == 3 ? "surfaceData" : "surfaceDataMember";
        const std::string appearanceMember = version == 3 ? "core:appearanceMember" : "app:appearanceMember";
        const auto material = [&](std::string_view color, std::string_view targets) {
            std::string text = fmt::format(
                "<app:{0}><app:X3DMaterial "
                "gml:id=\"m{1}\"><gml:name>{1}</gml:name><app:diffuseColor>{2}</"
                "app:diffuseColor><app:transparency>0.25</app:transparency>",
                surfaceData, color.substr(0, 1), color);
            for (const char target : targets) text += fmt::format("<app:target>#{}</app:target>", target);
            return text + fmt::format("</app:X3DMaterial></app:{}>", surfaceData);
        };
        const auto appearance = [&](std::string_view theme, std::string_view content) {
            return fmt::format("<{0}><app:Appearance><app:theme>{1}</app:theme>{2}</app:Appearance></{0}>",
                               appearanceMember, theme, content);
        };
        const Reading reading = readMembers(
            version,
            appearance("empty", "") +
                appearance("rgb", material("1 0 0", "p") + material("0 1 0", "s") + material("0.5 0.5 0.5", "b")) +
                appearance("other", material("0 0 1", "pqr")) +
                building("b", lod2Surfaces(version, "<gml:MultiSurface gml:id=\"s\">" + surfaceMember(square("p")) +
                                                        surfaceMember(square("q")) + "</gml:MultiSurface>") +
                                  (version == 3 ? "<core:lod3MultiSurface>" : "<bldg:lod3MultiSurface>") +
                                  multiSurface(surfaceMember(square("r"))) +
                                  (version == 3 ? "</core:lod3MultiSurface>" : "</bldg:lod3MultiSurface>")));
        ASSERT_EQ(reading.model().polygons.size(), 3u) << reading.findings();
        ASSERT_EQ(reading.model().materials.size(), 3u);
        const auto colorOf = [&](int polygon) {
            return reading.model()
                .materials.at(static_cast<std::size_t>(reading.model().polygons[polygon].material))
                .diffuse;
        };
        EXPECT_EQ(colorOf(0), (Vec3f{1, 0, 0}));
        EXPECT_EQ(colorOf(1), (Vec3f{0, 1, 0}));
        EXPECT_EQ(colorOf(2), (Vec3f{0.5f, 0.5f, 0.5f}));
        EXPECT_EQ(reading.model().materials[0].transparency, 0.25f);
        EXPECT_EQ(reading.model().materials[0].name, "1");
    }
}

TEST(CityGmlReader, MaterialsMayStandAtTheObjectAndBeShared) {
    const Reading reading = readMembers(
        2, building("b",
                    "<app:appearance><app:Appearance><app:theme>t</app:theme><app:surfaceDataMember "
                    "xlink:href=\"#m\"/></app:Appearance></app:appearance>" +
                        lod2Surfaces(2, multiSurface(surfaceMember(square("p"))))) +
               "<app:appearanceMember><app:Appearance><app:theme>u</app:theme><app:surfaceDataMember><app:X3DMaterial "
               "gml:id=\"m\"><app:diffuseColor>0 0 1</app:diffuseColor><app:target>#p</app:target>"
               "</app:X3DMaterial></app:surfaceDataMember><app:surfaceDataMember><app:ParameterizedTexture/></"
               "app:surfaceDataMember></app:Appearance></app:appearanceMember>");
    ASSERT_EQ(reading.model().materials.size(), 1u);
    EXPECT_EQ(reading.model().polygons[0].material, 0);
    EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
}

// ---- coordinate reference systems

Reading readWithCrs(std::string_view srsName, std::string_view positions, std::string_view shape = "") {
    return readMembers(
        2, fmt::format("<gml:boundedBy><gml:Envelope srsName=\"{}\"><gml:lowerCorner>0 0 "
                       "0</gml:lowerCorner></gml:Envelope></gml:boundedBy>",
                       srsName) +
               building("b", lod2Surfaces(2, multiSurface(shape.empty() ? surfaceMember("<gml:Polygon><gml:exterior>" +
                                                                                        ring(positions) +
                                                                                        "</gml:exterior></gml:Polygon>")
                                                                        : std::string(shape)))));
}

TEST(CityGmlReader, DegreesOfNoKnownSystemAreRefusedWithARemedy) {
    EXPECT_EQ(readWithCrs("", "35.67 139.71 10 35.6701 139.71 10 35.6701 139.7101 20 35.67 139.71 10").code(),
              Code::GeographicCrs);
    EXPECT_TRUE(readWithCrs("", "0 0 0 8 0 0 8 8 3 0 0 0").result) << "metres near the origin";
    EXPECT_TRUE(readWithCrs("EPSG:4547", "0 0 0 8 0 0 8 8 3 0 0 0").result);
    EXPECT_EQ(readWithCrs("EPSG:4326", "458877 5438353 0 458887 5438353 0 458887 5438363 0").count(Code::BadValue), 1u);
}

TEST(CityGmlReader, NorthFirstCoordinatesAreExchanged) {
    // For Gauss-Krueger the magnitude decides, whatever axis order the form of the name implies.
    const std::string_view names[] = {"EPSG:31467", "urn:ogc:def:crs:EPSG::31467",
                                      "urn:ogc:def:crs,crs:EPSG:6.12:31467,crs:EPSG:6.12:5783"};
    for (const std::string_view name : names) {
        const Reading northFirst = readWithCrs(name, "5438353 3458877 0 5438363 3458877 0 5438353 3458887 0");
        EXPECT_TRUE(northFirst.model().crs.axesSwapped) << name;
        EXPECT_EQ(northFirst.model().crs.epsg, 31467);
        EXPECT_EQ(northFirst.model().polygons[0].points[1], (Vec3d{3458877, 5438363, 0}));
        EXPECT_FALSE(readWithCrs(name, "3458877 5438353 0 3458887 5438353 0 3458877 5438363 0").model().crs.axesSwapped)
            << name;
    }
    // Poland's PL-1992 is ambiguous by magnitude and by its area of use: the form of the name decides.
    EXPECT_TRUE(readWithCrs("urn:ogc:def:crs:EPSG::2180", "500000 600000 0 500010 600000 0 500000 600010 0")
                    .model()
                    .crs.axesSwapped);
    EXPECT_FALSE(readWithCrs("EPSG:2180", "500000 600000 0 500010 600000 0 500000 600010 0").model().crs.axesSwapped);
    const Reading east =
        readWithCrs("urn:ogc:def:crs:EPSG::25832", "458877 5438353 0 458887 5438353 0 458877 5438363 0");
    EXPECT_FALSE(east.model().crs.axesSwapped) << "east first by authority";
    EXPECT_EQ(east.count(Code::AxisOrder), 0u);
    const Reading north =
        readWithCrs("urn:ogc:def:crs:EPSG::25832", "5438353 458877 0 5438363 458877 0 5438353 458887 0");
    EXPECT_TRUE(north.model().crs.axesSwapped) << "possible only in this order";
    EXPECT_EQ(north.count(Code::AxisOrder), 1u) << north.findings();
}

TEST(CityGmlReader, TheOrientationOfRoofsDoesNotDecideTheAxisOrder) {
    const auto roofs = [](std::string_view positions, int count) {
        std::string members = "<gml:boundedBy><gml:Envelope srsName=\"urn:ogc:def:crs:EPSG::2180\"/></gml:boundedBy>";
        for (int n = 0; n < count; ++n)
            members += building(
                fmt::format("b{}", n),
                fmt::format("<bldg:boundedBy><bldg:RoofSurface gml:id=\"r{}\">", n) +
                    lod2Surfaces(2, multiSurface(surfaceMember("<gml:Polygon><gml:exterior>" + ring(positions) +
                                                               "</gml:exterior></gml:Polygon>"))) +
                    "</bldg:RoofSurface></bldg:boundedBy>");
        return readMembers(2, members);
    };
    const std::string_view up = "500000 600000 0 500010 600000 0 500000 600010 0",
                           down = "500000 600000 0 500000 600010 0 500010 600000 0";
    for (const std::string_view positions : {up, down})
        for (const int count : {1, 4}) {
            const Reading reading = roofs(positions, count);
            EXPECT_TRUE(reading.model().crs.axesSwapped) << "the name says north first";
            // With exchanged axes, roofs that look up as given look down. Several of them are a warning.
            EXPECT_EQ(reading.findings().find("face the wrong way") != std::string::npos, positions == up && count == 4)
                << reading.findings();
            EXPECT_NE(reading.findings().find("axes taken as north, east"), std::string::npos);
        }
}

TEST(CityGmlReader, DifferentCrsAreReportedNotMixedUp) {
    const auto surface = [](std::string_view name) {
        return fmt::format("<gml:MultiSurface srsName=\"{}\">{}</gml:MultiSurface>", name, surfaceMember(square("")));
    };
    const Reading reading =
        readMembers(2, building("b", lod2Surfaces(2, surface("EPSG:25832")) + "\n<bldg:lod3MultiSurface>" +
                                         surface("urn:ogc:def:crs:EPSG::25832") +
                                         "</bldg:lod3MultiSurface>\n<bldg:lod4MultiSurface>" + surface("EPSG:25833") +
                                         "</bldg:lod4MultiSurface>"));
    EXPECT_EQ(reading.model().crs.name, "EPSG:25832");
    ASSERT_EQ(reading.count(Code::MixedCrs), 1u) << reading.findings();
    EXPECT_EQ(reading.first(Code::MixedCrs)->where.line, 5u);
}

// ---- large files

std::string largeBuilding(int rooms, std::size_t padding) {
    std::string properties = "<gml:name>large</gml:name>";
    const std::string comment = padding == 0 ? "" : "<!-- " + std::string(padding, '<') + " -->";
    for (int i = 0; i < rooms; ++i)
        properties += fmt::format(
            "<bldg:interiorRoom><bldg:Room "
            "gml:id=\"r{0}\"><bldg:lod4Solid>{1}</bldg:lod4Solid></bldg:Room></bldg:interiorRoom>{2}",
            i,
            solid("", surfaceMember(square(fmt::format("p{}", i), i)) +
                          surfaceReference(fmt::format("#p{}", (i + 7) % rooms))),
            comment);
    std::string materials;
    for (int i = 0; i < rooms; ++i)
        materials += fmt::format(
            "<app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>{} 0 "
            "0</app:diffuseColor><app:target>#p{}</app:target></app:X3DMaterial></app:surfaceDataMember>{}",
            1.0 / (i + 1), i, comment);
    return cityModel(2, building("b", properties + "<bldg:yearOfConstruction>1985</bldg:yearOfConstruction>") +
                            building("second", "") + "<app:appearanceMember><app:Appearance><app:theme>t</app:theme>" +
                            materials + "</app:Appearance></app:appearanceMember>");
}

void expectEqual(const BuildingModel& a, const BuildingModel& b) {
    ASSERT_EQ(a.features.size(), b.features.size());
    for (std::size_t i = 0; i < a.features.size(); ++i) {
        EXPECT_EQ(a.features[i].id, b.features[i].id);
        EXPECT_EQ(a.features[i].parent, b.features[i].parent);
        EXPECT_EQ(a.features[i].children, b.features[i].children);
        EXPECT_EQ(a.features[i].attributes, b.features[i].attributes);
        EXPECT_EQ(a.features[i].name, b.features[i].name);
        EXPECT_EQ(a.features[i].line, b.features[i].line);
        ASSERT_EQ(a.features[i].geometries.size(), b.features[i].geometries.size());
        for (std::size_t k = 0; k < a.features[i].geometries.size(); ++k)
            for (std::size_t s = 0; s < a.features[i].geometries[k].solids.size(); ++s)
                EXPECT_EQ(a.features[i].geometries[k].solids[s].exterior,
                          b.features[i].geometries[k].solids[s].exterior);
    }
    EXPECT_EQ(a.roots, b.roots);
    EXPECT_EQ(a.memberships, b.memberships);
    ASSERT_EQ(a.polygons.size(), b.polygons.size());
    for (std::size_t i = 0; i < a.polygons.size(); ++i) {
        EXPECT_EQ(a.polygons[i].points, b.polygons[i].points);
        EXPECT_EQ(a.polygons[i].id, b.polygons[i].id);
        EXPECT_EQ(a.polygons[i].material, b.polygons[i].material);
    }
}

TEST(CityGmlReader, AFeatureThatIsCutIntoChunksIsTheSameFeature) {
    const std::string small = largeBuilding(100, 0);
    const std::string large = largeBuilding(100, 30000);
    ASSERT_LT(small.size(), 250u << 10);
    ASSERT_GT(large.size(), 5u << 20);
    const Reading whole = read(small);
    ASSERT_TRUE(whole.result);
    EXPECT_EQ(whole.model().features.size(), 102u);
    EXPECT_EQ(whole.feature("b").children.size(), 100u);
    EXPECT_EQ(textOf(whole.feature("b"), "yearOfConstruction"), "1985");
    EXPECT_EQ(whole.model().materials.size(), 100u);
    for (const int threads : {1, 2, 5}) {
        ReadOptions options;
        options.threads = threads;
        const Reading cut = read(large, options);
        ASSERT_TRUE(cut.result);
        expectEqual(whole.model(), cut.model());
        EXPECT_EQ(whole.diagnostics.items().size(), cut.diagnostics.items().size());
    }
}

TEST(CityGmlReader, LinesAreTrueInEveryChunk) {
    std::string members;
    for (int i = 0; i < 3000; ++i)
        members += building(fmt::format("b{}", i),
                            fmt::format("\n{}\n<!--{}-->", lod2Surfaces(2, multiSurface(surfaceMember(square("")))),
                                        std::string(300, 'x'))) +
                   "\n";
    members += building("last", lod2Surfaces(2, multiSurface(surfaceReference("#gone"))));
    const Reading reading = readMembers(2, members);
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.feature("b0").line, 3u);
    EXPECT_EQ(reading.feature("b2000").line, 3u + 3 * 2000);
    EXPECT_EQ(reading.first(Code::DanglingReference)->where.line, 3u + 3 * 3000);
}

TEST(CityGmlReader, ProgressIsToldAndCancelIsObeyed) {
    Progress progress;
    double last = 0;
    progress.report = [&](std::string_view, double fraction) { last = fraction; };
    ReadOptions options;
    options.progress = &progress;
    ASSERT_TRUE(read(largeBuilding(10, 0), options).result);
    EXPECT_GT(last, 0.9);
    progress.cancel = true;
    EXPECT_EQ(read(largeBuilding(10, 0), options).code(), Code::Cancelled);
}

// ---- real models

Reading readData(const std::filesystem::path& path) {
    Reading reading;
    reading.result = readModel(path, {}, &reading.diagnostics);
    return reading;
}

TEST(CityGmlReader, FzkHausHasItsSolids) {
    SVT_NEEDS_DATA(path, "fzk_haus_citygml3.gml");
    const Reading reading = readData(path);
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_TRUE(reading.diagnostics.items().empty()) << reading.findings();
    EXPECT_EQ(
        countByClass(reading.model()),
        (std::map<std::string, int>{
            {"Building", 1}, {"BuildingConstructiveElement", 79}, {"BuildingInstallation", 3}, {"BuildingRoom", 7}}));
    EXPECT_EQ(reading.model().polygons.size(), 21794u);
    std::set<std::string> names;
    int solids = 0;
    for (const Feature& feature : reading.model().features) {
        names.insert(feature.name);
        for (const Geometry& geometry : feature.geometries) solids += static_cast<int>(geometry.solids.size());
    }
    EXPECT_EQ(solids, 89);
    EXPECT_TRUE(names.count("Unterzug-1"));
    EXPECT_TRUE(names.count("Slab-033"));
    EXPECT_EQ(reading.model().crs.epsg, 25832);
    EXPECT_FALSE(reading.model().crs.axesSwapped);
    Box3d box;
    for (const model::Polygon& polygon : reading.model().polygons)
        for (const Vec3d& point : polygon.points) box.add(point);
    EXPECT_NEAR(box.size().x, 13.0, 1e-6);
    EXPECT_NEAR(box.size().y, 11.0, 1e-6);
    EXPECT_NEAR(box.size().z, 6.518, 1e-6);
}

TEST(CityGmlReader, Sig3dHouseResolvesEveryReference) {
    SVT_NEEDS_DATA(path, "sig3d_lod4_citygml2.gml");
    const Reading reading = readData(path);
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.count(Code::DanglingReference), 0u) << reading.findings();
    EXPECT_EQ(reading.diagnostics.count(Severity::Warning), 0u) << reading.findings();
    const auto counts = countByClass(reading.model());
    EXPECT_EQ(counts.at("BuildingRoom"), 1);
    EXPECT_EQ(counts.at("Window"), 4);
    EXPECT_EQ(counts.at("Door"), 2);
    EXPECT_EQ(counts.at("BuildingFurniture"), 1);
    int reversed = 0;
    int solids = 0;
    for (const Feature& feature : reading.model().features)
        for (const Geometry& geometry : feature.geometries)
            for (const model::Solid& solid : geometry.solids) {
                ++solids;
                for (const model::SurfaceUse use : solid.exterior) reversed += use.isReversed ? 1 : 0;
            }
    EXPECT_EQ(solids, 2);
    EXPECT_GT(reversed, 0);
}

TEST(CityGmlReader, HundredBuildingsAndBerlinAreComplete) {
    SVT_NEEDS_DATA(hundred, "100_buildings_lod2_citygml3.gml");
    const Reading first = readData(hundred);
    ASSERT_TRUE(first.result);
    EXPECT_EQ(countByClass(first.model()),
              (std::map<std::string, int>{
                  {"Building", 100}, {"GroundSurface", 100}, {"RoofSurface", 200}, {"WallSurface", 400}}));
    EXPECT_EQ(first.count(Code::DanglingReference), 0u);
    EXPECT_FALSE(first.model().crs.axesSwapped);
    SVT_NEEDS_DATA(berlin, "berlin_lod2_citygml1.gml");
    const Reading second = readData(berlin);
    ASSERT_TRUE(second.result);
    EXPECT_EQ(countByClass(second.model()).at("Building"), 61);
    EXPECT_EQ(second.model().polygons.size(), 1125u);
    EXPECT_EQ(second.model().crs.epsg, 25833);
}

}  // namespace
}  // namespace svt::readers
