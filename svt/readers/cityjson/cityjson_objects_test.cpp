#include <svt/readers/citygml/citygml_reader.hpp>
#include <svt/readers/cityjson/cityjson_documents_test.hpp>

#include <algorithm>

namespace svt::readers::test {
namespace {

TEST(CityJsonSemantics, SurfacesBecomeChildrenThatShareThePolygons) {
    const Reading reading = read(withGeometry(cube(
        R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface","slope":35.5},{"type":"WallSurface"},)"
        R"({"type":"WallSurface","name":"north"},{"type":"ClosureSurface"}],"values":[[0,1,2,3,2,null]]})")));
    ASSERT_TRUE(reading.result);
    const BuildingModel& model = reading.model();
    EXPECT_EQ(model.polygons.size(), 6u);
    ASSERT_EQ(model.features.size(), 5u);
    EXPECT_EQ(model.features[0].children, (std::vector<model::FeatureIndex>{1, 2, 3, 4}));
    EXPECT_EQ(model.features[0].geometries[0].solids[0].exterior.size(), 6u);
    const Feature* wall = find(model, "b/WallSurface[1]");
    ASSERT_NE(wall, nullptr);
    EXPECT_EQ(wall->className, "WallSurface");
    ASSERT_EQ(wall->geometries.size(), 1u);
    EXPECT_EQ(wall->geometries[0].kind, GeometryKind::Surface);
    EXPECT_EQ(wall->geometries[0].lod, 2.2);
    EXPECT_EQ(wall->geometries[0].surfaces, (std::vector<model::SurfaceUse>{{2, false}, {4, false}}));
    ASSERT_NE(find(model, "b/WallSurface[2]"), nullptr);
    EXPECT_EQ(find(model, "b/WallSurface[2]")->name, "north");
    EXPECT_EQ(attribute(*find(model, "b/RoofSurface[1]"), "slope"), "35.5");
    EXPECT_EQ(find(model, "b/ClosureSurface[1]"), nullptr) << "owns no polygon";
}

TEST(CityJsonSemantics, WindowStandsUnderItsWall) {
    // The window comes first and is linked once by `children` and once by `parent`; the roof contains only the
    // skylight.
    const Reading reading = read(withGeometry(cube(
        R"(,"semantics":{"surfaces":[{"type":"Window","id":"w1"},{"type":"WallSurface","children":[0]},)"
        R"({"type":"Door","parent":1},{"type":"RoofSurface"},{"type":"Window","parent":3}],"values":[[0,1,2,4,null,null]]})")));
    ASSERT_TRUE(reading.result);
    const BuildingModel& model = reading.model();
    ASSERT_EQ(model.features.size(), 6u);
    const auto parentId = [&](std::string_view id) { return model.features[find(model, id)->parent].id; };
    EXPECT_EQ(parentId("b/WallSurface[1]"), "b");
    EXPECT_EQ(parentId("w1"), "b/WallSurface[1]");
    EXPECT_EQ(parentId("b/Door[1]"), "b/WallSurface[1]");
    EXPECT_EQ(parentId("b/Window[2]"), "b/RoofSurface[1]");
    EXPECT_TRUE(find(model, "b/RoofSurface[1]")->geometries.empty());
    EXPECT_EQ(attribute(*find(model, "w1"), "id"), "(absent)");
    for (std::size_t i = 0; i < model.features.size(); ++i)
        if (model.features[i].parent != model::kNoFeature) {
            EXPECT_LT(model.features[i].parent, i);
        }
}

TEST(CityJsonSemantics, SameIdInTwoLevelsIsOneFeature) {
    const std::string semantics = R"(,"semantics":{"surfaces":[{"type":"RoofSurface","id":"roof"}],"values":)";
    const Reading reading =
        read(withGeometry(cube(semantics + "[[0,null,null,null,null,null]]}") +
                          R"(,{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,3,2]]])" + semantics + "[0]}}"));
    ASSERT_TRUE(reading.result);
    ASSERT_EQ(reading.model().features.size(), 2u);
    const Feature& roof = reading.model().features[1];
    ASSERT_EQ(roof.geometries.size(), 2u);
    EXPECT_EQ(roof.geometries[0].surfaces, (std::vector<model::SurfaceUse>{{0, false}}));
    EXPECT_EQ(roof.geometries[1].surfaces, (std::vector<model::SurfaceUse>{{6, false}}));
    EXPECT_EQ(roof.geometries[1].lod, 1);
}

TEST(CityJsonSemantics, ValuesFollowTheNestingOfEveryType) {
    const std::string surfaces = R"("semantics":{"surfaces":[{"type":"WallSurface"},{"type":"RoofSurface"}],"values":)";
    const std::string shell(kCubeShell);
    const auto usesOfRoof = [&](const std::string& geometry) {
        const Reading reading = read(withGeometry(geometry));
        EXPECT_TRUE(reading.diagnostics.items().empty());
        std::vector<std::uint32_t> polygons;
        if (const Feature* roof = reading.result ? find(reading.model(), "b/RoofSurface[1]") : nullptr)
            for (const auto& use : roof->geometries[0].surfaces) polygons.push_back(use.polygon);
        return polygons;
    };
    EXPECT_EQ(
        usesOfRoof(R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,1,3]]],)" + surfaces + "[null,1]}}"),
        std::vector<std::uint32_t>{1});
    EXPECT_EQ(usesOfRoof(R"({"type":"Solid","lod":"2","boundaries":[)" + shell + "," + shell + "]," + surfaces +
                         "[null,[0,1,1,0,0,0]]}}"),
              (std::vector<std::uint32_t>{7, 8}));
    EXPECT_EQ(usesOfRoof(R"({"type":"CompositeSolid","lod":"2","boundaries":[[)" + shell + "],[" + shell + "]]," +
                         surfaces + "[[[0,1,0,0,0,0]],[[1,0,0,0,0,0]]]}}"),
              (std::vector<std::uint32_t>{1, 6}));
}

TEST(CityJsonSemantics, BadReferencesAreReported) {
    const Reading reading = read(withGeometry(cube(
        R"(,"semantics":{"surfaces":[{"type":"WallSurface","parent":1},{"type":"WallSurface","parent":0},{"type":"Door","parent":77},"x"],)"
        R"("values":[[0,1,2,3,9,-1]]})")));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.diagnostics.count(Code::ReferenceCycle), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::DanglingReference), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::BadIndex), 2u);
    EXPECT_EQ(reading.model().features[0].geometries[0].solids[0].exterior.size(), 6u);
    EXPECT_EQ(reading.model().features.size(), 4u);
    EXPECT_EQ(reading.model().features[1].id, "b/WallSurface[1]");
    EXPECT_EQ(reading.model().features[2].parent, 1u);
}

/// A tetrahedron with a ground, two walls and a roof, in both formats.
TEST(CityJsonSemantics, SolidWithSurfacesGivesWhatCityGmlGives) {
    const std::string corner[] = {"1000 2000 0 ", "1004 2000 0 ", "1000 2003 0 ", "1000 2000 5 "};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const char* types[4] = {"GroundSurface", "WallSurface", "WallSurface", "RoofSurface"};
    std::string gml =
        R"(<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" )"
        R"(xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink"><cityObjectMember>)"
        R"(<bldg:Building gml:id="b"><bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>)";
    for (int k = 0; k < 4; ++k) gml += "<gml:surfaceMember xlink:href=\"#p" + std::to_string(k) + "\"/>";
    gml += "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
    std::string json;
    for (int k = 0; k < 4; ++k) {
        const int* f = faces[k];
        gml += "<bldg:boundedBy><bldg:" + std::string(types[k]) + " gml:id=\"s" + std::to_string(k) +
               "\"><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id=\"p" +
               std::to_string(k) + "\"><gml:exterior><gml:LinearRing><gml:posList>" + corner[f[0]] + corner[f[1]] +
               corner[f[2]] + corner[f[0]] +
               "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>"
               "</bldg:lod2MultiSurface></bldg:" +
               types[k] + "></bldg:boundedBy>";
        json += std::string(k == 0 ? "" : ",") + R"({"type":")" + types[k] + R"(","id":"s)" + std::to_string(k) + "\"}";
    }
    gml += "</bldg:Building></cityObjectMember></CityModel>";
    const Reading reading = read(
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[1000,2000,0]},"CityObjects":{"b":)"
        R"({"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[[[[0,2,1]],[[0,1,3]],[[0,3,2]],[[1,2,3]]]],)"
        R"("semantics":{"values":[[0,1,2,3]],"surfaces":[)" +
        json + R"(]}}]}},"vertices":[[0,0,0],[4,0,0],[0,3,0],[0,0,5]]})");
    const auto other = readCityGml(bytesOf(gml), "house.gml");
    ASSERT_TRUE(reading.result && other);
    const BuildingModel& model = reading.model();
    ASSERT_EQ(model.features.size(), other->features.size());
    const auto pointsOf = [](const BuildingModel& source, const std::vector<model::SurfaceUse>& uses) {
        std::vector<std::vector<Vec3d>> points;
        for (const auto& use : uses) points.push_back(source.polygons[use.polygon].points);
        return points;
    };
    for (std::size_t i = 0; i < model.features.size(); ++i) {
        const Feature &a = model.features[i], &b = other->features[i];
        EXPECT_EQ(a.id, b.id);
        EXPECT_EQ(a.className, b.className);
        EXPECT_EQ(a.parent, b.parent);
        ASSERT_EQ(a.geometries.size(), 1u);
        ASSERT_EQ(b.geometries.size(), 1u);
        EXPECT_EQ(a.geometries[0].kind, b.geometries[0].kind);
        EXPECT_EQ(a.geometries[0].lod, b.geometries[0].lod);
        EXPECT_EQ(pointsOf(model, a.geometries[0].surfaces), pointsOf(*other, b.geometries[0].surfaces));
        ASSERT_EQ(a.geometries[0].solids.size(), b.geometries[0].solids.size());
        for (std::size_t k = 0; k < a.geometries[0].solids.size(); ++k)
            EXPECT_EQ(pointsOf(model, a.geometries[0].solids[k].exterior),
                      pointsOf(*other, b.geometries[0].solids[k].exterior));
    }
    EXPECT_EQ(model.polygons.size(), other->polygons.size());
}

TEST(CityJsonMaterial, DefaultThemeWinsElseTheFirstInTheAlphabet) {
    const std::string appearance =
        R"(,"appearance":{"materials":[{"name":"a","diffuseColor":[0.25,0.5,1]},{"name":"b","transparency":0.5}])";
    const std::string surfaces =
        R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,1,3]],[[0,1,5]]],"material":)"
        R"({"winter":{"value":0},"summer":{"values":[1,null,0]}}})";
    const auto materials = [&](const std::string& more) {
        const Reading reading = read(withGeometry(surfaces, more));
        std::vector<int> numbers;
        if (reading.result)
            for (const auto& polygon : reading.model().polygons) numbers.push_back(polygon.material);
        return numbers;
    };
    EXPECT_EQ(materials(appearance + "}"), (std::vector<int>{1, -1, 0}));
    EXPECT_EQ(materials(appearance + R"(,"default-theme-material":"winter"})"), (std::vector<int>{0, 0, 0}));
    EXPECT_EQ(materials(appearance + R"(,"default-theme-material":"spring"})"), (std::vector<int>{1, -1, 0}));
    const Reading reading = read(withGeometry(surfaces, appearance + "}"));
    ASSERT_EQ(reading.model().materials.size(), 2u);
    EXPECT_EQ(reading.model().materials[0].diffuse, (Vec3f{0.25f, 0.5f, 1}));
    EXPECT_EQ(reading.model().materials[1].name, "b");
    EXPECT_EQ(reading.model().materials[1].transparency, 0.5f);
}

TEST(CityJsonMaterial, IndexOutOfRangeIsReported) {
    const Reading reading = read(
        withGeometry(R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]],"material":{"t":{"values":[5]}}})"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().polygons[0].material, -1);
    EXPECT_EQ(reading.diagnostics.count(Code::BadIndex), 1u);
}

TEST(CityJsonObjects, ChildrenFollowTheirParentsListAndMayStandFirst) {
    const Reading reading = read(
        document(R"({"room2":{"type":"BuildingRoom","parents":["b"]},"late":{"type":"BuildingRoom","parents":["b"]},)"
                 R"("tree":{"type":"SolitaryVegetationObject"},"b":{"type":"Building","children":["room1","room2"]},)"
                 R"("room1":{"type":"Room","parents":["b"]}})"));
    ASSERT_TRUE(reading.result);
    const BuildingModel& model = reading.model();
    EXPECT_TRUE(reading.diagnostics.items().empty());
    std::vector<std::string> ids;
    for (const Feature& feature : model.features) ids.push_back(feature.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"tree", "b", "room1", "room2", "late"}));
    EXPECT_EQ(model.roots, (std::vector<model::FeatureIndex>{0, 1}));
    EXPECT_EQ(find(model, "room1")->className, "BuildingRoom");
    const auto order = model.treeOrder();
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(CityJsonObjects, GroupsAndFurtherParentsAreMemberships) {
    const Reading reading = read(document(
        R"({"g":{"type":"CityObjectGroup","children":["r","b"],"children_roles":["kitchen",null]},"b":{"type":"Building","children":["r","s"]},)"
        R"("s":{"type":"BuildingStorey","parents":["b"],"children":["r"]},"r":{"type":"BuildingRoom","parents":["g","b","s"]}})"));
    ASSERT_TRUE(reading.result);
    const BuildingModel& model = reading.model();
    const auto index = [&](std::string_view id) {
        return static_cast<model::FeatureIndex>(find(model, id) - model.features.data());
    };
    EXPECT_EQ(find(model, "r")->parent, index("b"));
    EXPECT_EQ(find(model, "s")->className, "Storey");
    EXPECT_EQ(model.memberships,
              (std::vector<model::Membership>{
                  {index("g"), index("r"), "kitchen"}, {index("g"), index("b"), ""}, {index("s"), index("r"), ""}}));
    EXPECT_EQ(model.roots, (std::vector<model::FeatureIndex>{index("g"), index("b")}));
}

TEST(CityJsonObjects, MembersOfVersionOneGroupsAreRead) {
    const Reading reading =
        read(document(R"({"g":{"type":"CityObjectGroup","members":["b"]},"b":{"type":"Building"}})", "", "1.0"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().memberships, (std::vector<model::Membership>{{0, 1, ""}}));
}

TEST(CityJsonObjects, AttributesKeepTypeNestingAndUnit) {
    const Reading reading = read(document(
        R"({"b":{"type":"Building","attributes":{"name":"Haus \u00e4","storeys":2,"height":9.5,"old":false,"none":null,)"
        R"("owner":{"name":"Eva","since":{"year":1985}},"tags":["a",{"b":1}],"area":{"value":120.5,"uom":"m2"}},)"
        R"("address":[{"Locality":"Graz","location":{"type":"MultiPoint"}},{"Locality":"Wien"}],"+noise":{"db":55}},)"
        R"("c":{"type":"+Kiosk","attributes":{"gml:name":"K"}}})"));
    ASSERT_TRUE(reading.result);
    const Feature& b = reading.model().features[0];
    EXPECT_EQ(b.name, "Haus \u00e4");
    EXPECT_EQ(attribute(b, "name"), "Haus \u00e4");
    EXPECT_EQ(b.attributes[1].value, AttributeValue(std::int64_t{2}));
    EXPECT_EQ(b.attributes[2].value, AttributeValue(9.5));
    EXPECT_EQ(b.attributes[3].value, AttributeValue(false));
    EXPECT_EQ(attribute(b, "none"), "(absent)");
    EXPECT_EQ(attribute(b, "owner/name"), "Eva");
    EXPECT_EQ(attribute(b, "owner/since/year"), "1985");
    EXPECT_EQ(attribute(b, "tags"), R"(["a",{"b":1}])");
    EXPECT_EQ(attribute(b, "area"), "120.5m2");
    EXPECT_EQ(attribute(b, "address/Locality"), "Graz");
    EXPECT_EQ(toText(attributeLists(b.attributes).back()), "55");
    for (const AttributeList& list : attributeLists(b.attributes))
        if (list.name == "address/Locality") {
            EXPECT_EQ(toText(list), R"(["Graz","Wien"])");
        }
    EXPECT_EQ(attribute(b, "+noise/db"), "55");
    EXPECT_EQ(reading.model().features[1].className, "+Kiosk");
    EXPECT_EQ(reading.model().features[1].name, "K");
    EXPECT_TRUE(reading.diagnostics.items().empty());
}

TEST(CityJsonObjects, ArraysAreListsAndRecords) {
    const Reading reading = read(document(
        R"({"b":{"type":"Building","attributes":{"years":[1985,2001,null,2010],"one":[7],"empty":[],"grid":[[1],[2]],)"
        R"("floods":[{"depth":0.5,"rank":1},{"rank":3},{"depth":2,"by":{"name":"x"}}],)"
        R"("heights":[{"value":3,"uom":"m"},{"value":4,"uom":"m"}],"deep":[{"a":[{"b":1},{"b":2}]}]}}})"));
    ASSERT_TRUE(reading.result);
    std::string text;
    for (const AttributeList& list : attributeLists(reading.model().features[0].attributes))
        text += std::string(list.name) + "=" + toText(list) + "\n";
    EXPECT_EQ(text,
              "years=[1985,2001,2010]\none=7\nempty=[]\ngrid=[[1],[2]]\nfloods/depth=[0.5,null,2]\n"
              "floods/rank=[1,3,null]\nfloods/by/name=[null,null,\"x\"]\nheights=[3,4]\n"
              "deep=[{\"a\":[{\"b\":1},{\"b\":2}]}]\n");
}

TEST(CityJsonObjects, LongArraysStayText) {
    std::string numbers = "1";
    for (int n = 0; n < 5000; ++n) numbers += ",1";
    const Reading reading = read(document(R"({"b":{"type":"Building","attributes":{"x":[)" + numbers + "]}}}"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().features[0].attributes.size(), 1u);
}

TEST(CityJsonObjects, DeepAttributesDoNotMultiplyTheirPath) {
    std::string value = R"({"leaf":1})";
    for (int i = 0; i < 100; ++i) value = R"({"aaaaaaaaaaaaaaaaaaaaaaaa":)" + value + "}";
    const Reading reading = read(document(R"({"b":{"type":"Building","attributes":{"x":)" + value + "}}}"));
    ASSERT_TRUE(reading.result);
    ASSERT_EQ(reading.model().features[0].attributes.size(), 1u);
    EXPECT_LT(reading.model().features[0].attributes[0].name.size(), 400u);
}

TEST(CityJsonObjects, BrokenHierarchyIsReportedAndRepaired) {
    const Reading reading = read(document(
        R"({"a":{"type":"Building","children":["gone"],"parents":["c"]},"c":{"type":"BuildingPart","parents":["a"]},)"
        R"("d":{"type":"BuildingPart","parents":["nobody"]},"e":{"type":"Building","parents":["e"]},"a":{"type":"Bridge"},"f":{"type":"Blimp"}})"));
    ASSERT_TRUE(reading.result);
    const BuildingModel& model = reading.model();
    EXPECT_EQ(reading.diagnostics.count(Code::DanglingReference), 2u);
    EXPECT_EQ(reading.diagnostics.count(Code::ReferenceCycle), 2u);
    EXPECT_EQ(reading.diagnostics.count(Code::DuplicateId), 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::UnknownElement), 1u);
    ASSERT_EQ(model.features.size(), 5u);
    EXPECT_EQ(model.features[0].id, "a");
    EXPECT_EQ(model.features[0].className, "Building");
    EXPECT_EQ(model.features[1].parent, 0u);
    EXPECT_TRUE(model.memberships.empty());
    for (const Diagnostic& item : reading.diagnostics.items()) EXPECT_EQ(item.where.file, "test.city.json");
    EXPECT_FALSE(reading.diagnostics.items().front().where.id.empty());
}

// The places of all ids in `parents` and `children`.
std::vector<std::pair<std::size_t, std::size_t>> linksOf(const std::string& text) {
    std::vector<std::pair<std::size_t, std::size_t>> links;
    for (const std::string_view list : {R"("parents":[)", R"("children":[)"})
        for (std::size_t at = text.find(list); at != std::string::npos; at = text.find(list, at)) {
            const std::size_t end = text.find(']', at);
            for (at = text.find('"', at + list.size()); at < end; at = text.find('"', at + 1)) {
                const std::size_t quote = text.find('"', at + 1);
                links.emplace_back(at + 1, quote - at - 1);
                at = quote;
            }
            at = end;
        }
    return links;
}

// Four levels by `children`, three by `parents`, and two groups, one within the other.
TEST(CityJsonObjects, EveryLinkMayCloseACircle) {
    const std::vector<std::string> ids{"b", "p", "i", "j", "s", "r", "f", "g", "h"};
    const std::string text = document(
        R"({"b":{"type":"Building","children":["p","s"]},"p":{"type":"BuildingPart","children":["i"]},)"
        R"("i":{"type":"BuildingInstallation","children":["j"]},"j":{"type":"BuildingInstallation"},"s":{"type":"BuildingStorey"},)"
        R"("r":{"type":"BuildingRoom","parents":["s","b"]},"f":{"type":"BuildingFurniture","parents":["r"]},)"
        R"("g":{"type":"CityObjectGroup","children":["b","f","h"]},)"
        R"("h":{"type":"CityObjectGroup","parents":["g"],"children":["r"]}})");
    ASSERT_TRUE(read(text).diagnostics.items().empty());
    const auto links = linksOf(text);
    ASSERT_EQ(links.size(), 12u);
    std::size_t named = 0;
    for (const auto& [at, size] : links)
        for (const std::string& id : ids) {
            std::string changed = text;
            const Reading reading = read(changed.replace(at, size, id));
            ASSERT_TRUE(reading.result) << changed;
            const BuildingModel& model = reading.model();
            ASSERT_EQ(model.features.size(), ids.size()) << changed;
            EXPECT_EQ(model.treeOrder().size(), ids.size()) << changed;
            for (std::size_t n = 0; n < ids.size(); ++n) {
                const auto parent = model.features[n].parent;
                EXPECT_TRUE(parent == model::kNoFeature || parent < n) << changed;
            }
            EXPECT_LE(model.memberships.size(), links.size()) << changed;
            named += reading.diagnostics.count(Code::ReferenceCycle);
        }
    // b as the child of itself in place of p and of s, of p and of i; r and f as their own parents, and f as that of r.
    EXPECT_EQ(named, 7u);
}

TEST(CityJsonObjects, AnEmptyIdIsReplaced) {
    const Reading reading = read(document(
        R"({"Building[1]":{"type":"Building"},"":{"type":"Building","children":["p"]},"p":{"type":"BuildingPart","parents":[""]}})"));
    ASSERT_TRUE(reading.result);
    ASSERT_EQ(reading.model().features.size(), 3u);
    EXPECT_EQ(reading.model().features[1].id, "Building[2]");
    EXPECT_EQ(reading.model().features[2].parent, 1u);
    EXPECT_EQ(reading.diagnostics.count(Code::MissingId), 1u);
}

TEST(CityJsonObjects, LongChainOfParentsIsNoRecursion) {
    std::string objects = R"({"0":{"type":"Building"})";
    for (int i = 1; i < 20000; ++i)
        objects +=
            ",\"" + std::to_string(i) + R"(":{"type":"BuildingPart","parents":[")" + std::to_string(i - 1) + "\"]}";
    const Reading reading = read(document(objects + "}"));
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().features.back().id, "19999");
    EXPECT_EQ(reading.model().treeOrder().size(), 20000u);
}

}  // namespace
}  // namespace svt::readers::test
