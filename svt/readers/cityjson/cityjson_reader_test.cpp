#include <svt/readers/cityjson/cityjson_documents_test.hpp>

#include <svt/core/test_data_test.hpp>
#include <svt/readers/citygml/citygml_reader.hpp>

#include <set>

namespace svt::readers::test {
namespace {

TEST(CityJsonFormat, IsRecognizedByItsBeginning) {
    EXPECT_TRUE(looksLikeCityJson(bytesOf(document("{}"))));
    EXPECT_TRUE(looksLikeCityJson(bytesOf("\xEF\xBB\xBF \r\n\t{ \"type\" : \"CityJSON\"")));
    EXPECT_TRUE(looksLikeCityJson(bytesOf("{\"CityObjects\":{")));
    EXPECT_TRUE(looksLikeCityJson(bytesOf("{\"vertices\":[[1,2,3]")));
    EXPECT_TRUE(looksLikeCityJson(bytesOf("{\"type\":\"CityJSONFeature\",\"id\":\"a\"")));
    EXPECT_FALSE(looksLikeCityJson(bytesOf("")));
    EXPECT_FALSE(looksLikeCityJson(bytesOf("<CityModel/>")));
    EXPECT_FALSE(looksLikeCityJson(bytesOf("{\"type\":\"FeatureCollection\",\"features\":[]}")));
    EXPECT_FALSE(looksLikeCityJson(bytesOf("[\"CityJSON\"]")));
    EXPECT_FALSE(looksLikeCityJson(bytesOf("{" + std::string(4096, ' ') + "\"CityJSON\"")));
}

TEST(CityJsonReader, SolidHasTransformedVerticesWithEqualBits) {
    const Reading reading = read(withGeometry(cube()));
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    const BuildingModel& model = reading.model();
    EXPECT_TRUE(reading.diagnostics.items().empty());
    EXPECT_EQ(model.format, "CityJSON 2.0");
    EXPECT_EQ(model.source, "test.city.json");
    ASSERT_EQ(model.features.size(), 1u);
    ASSERT_EQ(model.features[0].geometries.size(), 1u);
    const model::Geometry& geometry = model.features[0].geometries[0];
    EXPECT_EQ(geometry.kind, GeometryKind::Solid);
    EXPECT_EQ(geometry.lod, 2.2);
    ASSERT_EQ(geometry.solids.size(), 1u);
    EXPECT_EQ(geometry.solids[0].exterior.size(), 6u);
    EXPECT_TRUE(geometry.solids[0].interiors.empty());
    ASSERT_EQ(model.polygons.size(), 6u);
    EXPECT_EQ(
        model.polygons[0].points,
        (std::vector<Vec3d>{{1000, 2000, 3000}, {1000, 2000.5, 3000}, {1000.5, 2000.5, 3000}, {1000.5, 2000, 3000}}));
    EXPECT_EQ(model.polygons[0].ringEnds, std::vector<std::uint32_t>{4});
    std::set<Vec3d> corners;
    for (const auto& polygon : model.polygons) corners.insert(polygon.points.begin(), polygon.points.end());
    EXPECT_EQ(corners.size(), 8u);
}

TEST(CityJsonReader, SolidKeepsInnerShells) {
    const std::string shell(kCubeShell);
    const Reading reading =
        read(withGeometry(R"({"type":"Solid","lod":1,"boundaries":[)" + shell + "," + shell + "]}"));
    ASSERT_TRUE(reading.result);
    const model::Geometry& geometry = reading.model().features[0].geometries[0];
    EXPECT_EQ(geometry.lod, 1);
    ASSERT_EQ(geometry.solids.size(), 1u);
    EXPECT_EQ(geometry.solids[0].exterior.size(), 6u);
    ASSERT_EQ(geometry.solids[0].interiors.size(), 1u);
    EXPECT_EQ(geometry.solids[0].interiors[0].front().polygon, 6u);
}

TEST(CityJsonReader, CompositeAndMultiSolidsAreListsOfSolids) {
    const std::string solid = "[" + std::string(kCubeShell) + "]";
    for (const std::string type : {"CompositeSolid", "MultiSolid"}) {
        const Reading reading =
            read(withGeometry(R"({"type":")" + type + R"(","lod":"3","boundaries":[)" + solid + "," + solid + "]}"));
        ASSERT_TRUE(reading.result);
        ASSERT_EQ(reading.model().features[0].geometries.size(), 1u) << type;
        EXPECT_EQ(reading.model().features[0].geometries[0].solids.size(), 2u) << type;
        EXPECT_EQ(reading.model().features[0].geometries[0].isComposite, type == "CompositeSolid");
        EXPECT_TRUE(reading.diagnostics.items().empty()) << type;
    }
}

TEST(CityJsonReader, SurfacesKeepHoles) {
    for (const std::string type : {"CompositeSurface", "MultiSurface"}) {
        const Reading reading = read(
            withGeometry(R"({"type":")" + type + R"(","lod":"2","boundaries":[[[0,1,3,2],[4,5,7]],[[4,5,7,6]]]})"));
        ASSERT_TRUE(reading.result);
        const model::Geometry& geometry = reading.model().features[0].geometries[0];
        EXPECT_EQ(geometry.kind, GeometryKind::Surface);
        EXPECT_EQ(geometry.isComposite, type == "CompositeSurface");
        ASSERT_EQ(geometry.surfaces.size(), 2u);
        EXPECT_EQ(reading.model().polygons[0].ringEnds, (std::vector<std::uint32_t>{4, 7}));
    }
}

TEST(CityJsonReader, PointsAndLinesBoundNothing) {
    const Reading reading = read(withGeometry(
        R"({"type":"MultiPoint","lod":"1","boundaries":[0,1]},{"type":"MultiLineString","lod":"1","boundaries":[[0,1]]})"));
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.model().features[0].geometries.empty());
    EXPECT_TRUE(reading.diagnostics.items().empty());
}

TEST(CityJsonReader, EveryLevelOfDetailStays) {
    const Reading reading =
        read(withGeometry(cube() + R"(,{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,3,2]]]})" +
                          R"(,{"type":"MultiSurface","lod":"fine","boundaries":[[[0,1,3,2]]]})"));
    ASSERT_TRUE(reading.result);
    const auto& geometries = reading.model().features[0].geometries;
    ASSERT_EQ(geometries.size(), 3u);
    EXPECT_EQ(geometries[0].lod, 2.2);
    EXPECT_EQ(geometries[1].lod, 0);
    EXPECT_EQ(geometries[2].lod, -1);
    EXPECT_EQ(reading.diagnostics.count(Code::BadValue), 1u);
}

TEST(CityJsonReader, TemplateIsWrittenOutThroughMatrixAndAnchor) {
    const Reading reading = read(withGeometry(
        R"({"type":"GeometryInstance","template":0,"boundaries":[1],"transformationMatrix":[2,0,0,10, 0,0,-1,0, 0,1,0,0, 0,0,0,1]})",
        R"(,"geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2.1","boundaries":[[[0,1,2]]]}],)"
        R"("vertices-templates":[[0,0,0],[1,0,0],[0,0.25,3]]})"));
    ASSERT_TRUE(reading.result);
    ASSERT_EQ(reading.model().features[0].geometries.size(), 1u);
    EXPECT_EQ(reading.model().features[0].geometries[0].lod, 2.1);
    // vertex 1 = (1000.5, 2000, 3000); p -> (2x + 10, -z, y)
    EXPECT_EQ(reading.model().polygons[0].points,
              (std::vector<Vec3d>{{1010.5, 2000, 3000}, {1012.5, 2000, 3000}, {1010.5, 1997, 3000.25}}));
}

TEST(CityJsonVersion, OneAndTwoAreReadOthersNot) {
    EXPECT_EQ(read(document("{}", "", "1.1")).model().format, "CityJSON 1.1");
    EXPECT_TRUE(read(document("{}", "", "1.0.3")).diagnostics.items().empty());
    const Reading next = read(document("{}", "", "2.1"));
    ASSERT_TRUE(next.result);
    EXPECT_EQ(next.diagnostics.count(Severity::Note), 1u);
    for (const char* version : {"0.9", "3.0", "two"}) {
        const Reading reading = read(document("{}", "", version));
        ASSERT_FALSE(reading.result) << version;
        EXPECT_EQ(reading.result.error().code(), Code::UnknownVersion);
    }
    const Reading none =
        read(R"({"type":"CityJSON","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})");
    ASSERT_TRUE(none.result);
    EXPECT_EQ(none.diagnostics.count(Code::UnknownVersion), 1u);
}

TEST(CityJsonVersion, OneZeroWithoutTransformHasRealVertices) {
    const Reading reading = read(
        R"({"type":"CityJSON","version":"1.0","CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":2,)"
        R"("boundaries":[[[0,1,2]]]}]}},"vertices":[[500.125,0,0],[501,0,0],[0,1,0]]})");
    ASSERT_TRUE(reading.result);
    EXPECT_TRUE(reading.diagnostics.items().empty());
    EXPECT_EQ(reading.model().polygons[0].points[0], (Vec3d{500.125, 0, 0}));
    EXPECT_EQ(reading.model().features[0].geometries[0].lod, 2);
}

TEST(CityJsonCrs, EpsgCodeIsFoundInEveryForm) {
    const auto epsg = [](const std::string& name) {
        return read(document("{}", R"(,"metadata":{"title":"T","referenceSystem":")" + name + "\"}")).model().crs.epsg;
    };
    EXPECT_EQ(epsg("https://www.opengis.net/def/crs/EPSG/0/7415"), 28992) << "the part in plan";
    EXPECT_EQ(epsg("urn:ogc:def:crs:EPSG::28992"), 28992);
    EXPECT_EQ(epsg("urn:ogc:def:crs:EPSG:6.12:3068"), 3068);
    EXPECT_EQ(epsg("EPSG:25832"), 25832);
    EXPECT_EQ(epsg("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"), 25832);
    EXPECT_EQ(epsg("local"), 0);
    EXPECT_EQ(read(document("{}", R"(,"metadata":{"title":"T"})")).model().name, "T");
}

TEST(CityJsonCrs, DegreesOfNoKnownSystemAreRefusedAndLocalMetresAreNot) {
    const auto codeOf = [](std::string_view system, std::string_view vertices) {
        const Reading reading = read(
            R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"metadata":{"referenceSystem":")" +
            std::string(system) +
            R"("},"CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)"
            R"("boundaries":[[[0,1,2]]]}]}},"vertices":)" +
            std::string(vertices) + "}");
        return reading.result ? Code::Internal : reading.result.error().code();
    };
    const std::string_view degrees = "[[139.71,35.67,10],[139.7101,35.67,12],[139.71,35.6701,14]]";
    const std::string_view metres = "[[0,0,0],[10,0,0],[10,8,3]]";
    EXPECT_EQ(codeOf("https://www.opengis.net/def/crs/EPSG/0/6697", degrees), Code::Internal) << "can be projected";
    EXPECT_EQ(codeOf("", degrees), Code::GeographicCrs) << "a height of 4 over an extent of 0.0001";
    EXPECT_EQ(codeOf("", metres), Code::Internal);
    EXPECT_EQ(codeOf("https://www.opengis.net/def/crs/EPSG/0/25832", metres), Code::Internal);
    EXPECT_EQ(codeOf("https://www.opengis.net/def/crs/EPSG/0/4326", "[[1000,0,0],[1010,0,0],[1010,8,3]]"),
              Code::Internal);
}

TEST(CityJsonCrs, TemplatesKeepTheirMetresAmongDegrees) {
    const Reading reading = read(
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"metadata":{"referenceSystem":)"
        R"("https://www.opengis.net/def/crs/EPSG/0/4979"},"CityObjects":{"b":{"type":"CityFurniture","geometry":[)"
        R"({"type":"GeometryInstance","template":0,"boundaries":[0],)"
        R"("transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}},"vertices":[[11.5755,48.1374,520]],)"
        R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],)"
        R"("vertices-templates":[[0,0,0],[3,0,0],[0,2,5]]}})");
    ASSERT_EQ(reading.model().polygons.size(), 1u);
    const std::vector<Vec3d>& points = reading.model().polygons[0].points;
    EXPECT_EQ(reading.model().crs.epsg, 32632);
    EXPECT_NEAR(points[0].x, 691603.0320, 1e-3);
    EXPECT_NEAR(points[0].y, 5334780.0309, 1e-3);
    EXPECT_NEAR(length(points[1] - points[0]), 3, 2e-3);
    EXPECT_GT(points[1].x, points[0].x + 2.9);
    EXPECT_NEAR(points[2].z, 525, 1e-9);
}

TEST(CityJsonCrs, NorthFirstIsExchangedOnlyWhereTheCoordinatesProveIt) {
    const auto firstPoint = [](std::string_view vertices) {
        const Reading reading =
            read(R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},)"
                 R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/31467"},)"
                 R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)"
                 R"("boundaries":[[[0,1,2]]]}]}},"vertices":)" +
                 std::string(vertices) + "}");
        EXPECT_EQ(reading.model().crs.axesSwapped, !reading.diagnostics.items().empty());
        return reading.model().polygons[0].points[0];
    };
    EXPECT_EQ(firstPoint("[[3450000,5400000,1],[3450010,5400000,1],[3450000,5400010,1]]"),
              (Vec3d{3450000, 5400000, 1}));
    EXPECT_EQ(firstPoint("[[5400000,3450000,1],[5400010,3450000,1],[5400000,3450010,1]]"),
              (Vec3d{3450000, 5400000, 1}));
}

TEST(CityJson, TransformScalesAndMovesEachAxisByItsOwnNumber) {
    const Reading reading =
        read(R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.5,0.25,0.125],"translate":[100,200,300]},)"
             R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",)"
             R"("boundaries":[[[0,1,2]]]}]}},"vertices":[[8,8,8],[16,8,8],[8,16,24]]})");
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    EXPECT_EQ(reading.model().polygons[0].points,
              (std::vector<Vec3d>{{104, 202, 301}, {108, 202, 301}, {104, 204, 303}}));
}

TEST(CityJsonSeq, LinesHaveLocalVerticesAndTheTransformOfTheHead) {
    const Reading reading = read(sequence());
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    const BuildingModel& model = reading.model();
    EXPECT_TRUE(reading.diagnostics.items().empty());
    EXPECT_EQ(model.format, "CityJSONSeq 2.0");
    ASSERT_EQ(model.features.size(), 3u);
    EXPECT_EQ(model.features[1].parent, 0u);
    EXPECT_EQ(model.features[0].line, 2u);
    EXPECT_EQ(model.features[2].line, 4u);
    ASSERT_EQ(model.polygons.size(), 3u);
    EXPECT_EQ(model.polygons[0].points[0], (Vec3d{1000, 2000, 3000}));
    EXPECT_EQ(model.polygons[1].points[0], (Vec3d{1002, 2000, 3000}));
    EXPECT_EQ(model.polygons[2].points[0], (Vec3d{1002, 2001, 3000}));
    const auto materialOf = [&](std::size_t i) {
        return model.materials.at(static_cast<std::size_t>(model.polygons[i].material)).name;
    };
    EXPECT_EQ(materialOf(0), "stone");
    EXPECT_EQ(materialOf(1), "glass");
    EXPECT_EQ(materialOf(2), "stone");
}

TEST(CityJsonSeq, BadLinesAreReportedWithTheirNumberAndLeftOut) {
    const Reading reading =
        read(sequence() + "{\"type\":\"CityJSONFeature\",\"CityObjects\":{}\n" + "{\"type\":\"Feature\"}\n" +
             R"({"type":"CityJSONFeature","CityObjects":{"z":{"type":"Building"}},"vertices":[]})");
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().features.size(), 4u);
    ASSERT_EQ(reading.diagnostics.count(Code::BadJson), 2u);
    EXPECT_EQ(reading.diagnostics.items()[0].where.line, 5u);
    EXPECT_EQ(reading.diagnostics.items()[1].where.line, 6u);
    EXPECT_EQ(reading.diagnostics.items()[1].severity, Severity::Error);
}

TEST(CityJsonSeq, MaterialsOfManyLinesStandOnce) {
    std::string text = sequence();
    const std::string line = text.substr(text.rfind("{\"type\":\"CityJSONFeature\""));
    for (int i = 0; i < 100; ++i) {
        std::string more = line;
        more.replace(more.find("\"b\":"), 4, "\"b" + std::to_string(i) + "\":");
        text += more;
    }
    const Reading reading = read(text);
    ASSERT_TRUE(reading.result);
    EXPECT_EQ(reading.model().materials.size(), 3u);
    EXPECT_EQ(reading.model().features.size(), 103u);
}

bool areEqual(const BuildingModel& a, const BuildingModel& b) {
    if (a.features.size() != b.features.size() || a.polygons.size() != b.polygons.size()) return false;
    for (std::size_t i = 0; i < a.polygons.size(); ++i)
        if (a.polygons[i].points != b.polygons[i].points || a.polygons[i].material != b.polygons[i].material)
            return false;
    for (std::size_t i = 0; i < a.features.size(); ++i) {
        const Feature &f = a.features[i], &g = b.features[i];
        if (f.id != g.id || f.parent != g.parent || f.children != g.children || f.attributes != g.attributes)
            return false;
    }
    return a.memberships == b.memberships;
}

TEST(CityJsonReader, ThreadsDoNotChangeTheResult) {
    std::string text = sequence();
    for (int i = 0; i < 400; ++i)
        text +=
            R"({"type":"CityJSONFeature","CityObjects":{"n)" + std::to_string(i) +
            R"(":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]],[[0,1,9]]]}]}},"vertices":[[)" +
            std::to_string(i) + ",0,0],[6,0,0],[4,2,0]]}\n";
    ReadOptions one, four;
    one.threads = 1;
    four.threads = 4;
    const Reading a = read(text, one), b = read(text, four);
    ASSERT_TRUE(a.result && b.result);
    EXPECT_TRUE(areEqual(a.model(), b.model()));
    ASSERT_EQ(a.diagnostics.items().size(), b.diagnostics.items().size());
    for (std::size_t i = 0; i < a.diagnostics.items().size(); ++i)
        EXPECT_EQ(a.diagnostics.items()[i].toString(), b.diagnostics.items()[i].toString());
}

TEST(CityJsonReader, CancelStopsIt) {
    Progress progress;
    progress.cancel = true;
    ReadOptions options;
    options.progress = &progress;
    for (const std::string& text : {withGeometry(cube()), sequence()}) {
        const Reading reading = read(text, options);
        ASSERT_FALSE(reading.result);
        EXPECT_EQ(reading.result.error().code(), Code::Cancelled);
    }
}

TEST(CityJsonFiles, FzkHausHasItsEightyNineSolids) {
    SVT_NEEDS_DATA(path, "fzk_haus.city.json");
    const std::string text = readFile(path);
    const Reading reading = read(text);
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    const BuildingModel& model = reading.model();
    EXPECT_TRUE(reading.diagnostics.items().empty());
    EXPECT_EQ(model.crs.epsg, 25832);
    EXPECT_EQ(model.name, "FZK-Haus");
    ASSERT_EQ(model.features.size(), 90u);
    EXPECT_EQ(model.roots.size(), 1u);
    EXPECT_EQ(model.features[0].children.size(), 89u);
    EXPECT_EQ(model.polygons.size(), 21794u);
    Box3d box;
    int solids = 0;
    for (const Feature& feature : model.features)
        for (const auto& geometry : feature.geometries) {
            solids += static_cast<int>(geometry.solids.size());
            box.add(model.bounds(geometry));
        }
    EXPECT_EQ(solids, 89);
    EXPECT_NEAR(box.size().x, 13.0, 0.01);
    EXPECT_NEAR(box.size().y, 11.0, 0.01);
    EXPECT_NEAR(box.size().z, 6.518, 0.001);
}

TEST(CityJsonFiles, FzkHausEqualsItsCityGml) {
    SVT_NEEDS_DATA(path, "fzk_haus.city.json");
    SVT_NEEDS_DATA(gmlPath, "fzk_haus_citygml3.gml");
    const Reading reading = read(readFile(path));
    ASSERT_TRUE(reading.result);
    const std::string xml = readFile(gmlPath);
    const auto gml = readCityGml(bytesOf(xml), "house.gml");
    ASSERT_TRUE(gml);
    ASSERT_EQ(gml->features.size(), reading.model().features.size());
    for (const Feature& feature : reading.model().features) {
        const Feature* other = find(*gml, feature.id);
        ASSERT_NE(other, nullptr) << feature.id;
        EXPECT_EQ(other->className, feature.className);
        EXPECT_EQ(other->name, feature.name);
        ASSERT_EQ(other->geometries.size(), feature.geometries.size());
        if (feature.geometries.empty()) continue;
        const auto &shell = feature.geometries[0].solids[0].exterior,
                   &otherShell = other->geometries[0].solids[0].exterior;
        EXPECT_EQ(shell.size(), otherShell.size());
        const Box3d box = reading.model().bounds(feature.geometries[0]), otherBox = gml->bounds(other->geometries[0]);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(box.min[axis], otherBox.min[axis], 1e-3);
            EXPECT_NEAR(box.max[axis], otherBox.max[axis], 1e-3);
        }
    }
}

TEST(CityJsonFiles, FakeCompleteHasEveryConstruct) {
    SVT_NEEDS_DATA(path, "cityjson_fake_complete.city.json");
    const Reading reading = read(readFile(path));
    ASSERT_TRUE(reading.result) << reading.result.error().toString();
    const BuildingModel& model = reading.model();
    std::string found;
    for (const Diagnostic& item : reading.diagnostics.items()) found += item.toString() + "\n";
    EXPECT_EQ(reading.diagnostics.items().size(), reading.diagnostics.count(Code::OutsideArea)) << found;
    std::vector<std::string> ids;
    for (const Feature& feature : model.features) ids.push_back(feature.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"id-3", "id-1", "id-1/RoofSurface[1]", "id-1/+PatioDoor[1]", "a-tree",
                                             "my-neighbourhood"}));
    EXPECT_EQ(model.features[3].parent, 2u);
    EXPECT_EQ(model.memberships,
              (std::vector<model::Membership>{{5, 1, "residential building"}, {5, 0, "voting location"}}));
    const model::Geometry& solid = model.features[1].geometries[0];
    EXPECT_EQ(solid.lod, 2.1);
    EXPECT_EQ(solid.solids[0].exterior.size(), 4u);
    EXPECT_EQ(solid.solids[0].interiors.size(), 1u);
    EXPECT_EQ(model.features[4].geometries[0].surfaces.size(), 3u);
    EXPECT_EQ(model.materials.size(), 2u);
    EXPECT_EQ(model.polygons[0].material, 0);
    EXPECT_EQ(model.polygons[3].material, -1);
    EXPECT_EQ(model.crs.epsg, 2355);
    EXPECT_EQ(attribute(model.features[1], "address/Country"), "Canada");
}

}  // namespace
}  // namespace svt::readers::test
