// Tables for GIS: footprints, volumes and attributes of generated models whose figures are known.
#include "../run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace svt::test {
namespace {

using nlohmann::json;

// Counter-clockwise rings of x, y as a polygon of CityGML at height z.
std::string polygon(const std::vector<std::vector<std::array<double, 2>>>& rings, double z) {
    std::string text = "<gml:surfaceMember><gml:Polygon>";
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const char* side = r == 0 ? "exterior" : "interior";
        text += fmt::format("<gml:{}><gml:LinearRing><gml:posList>", side);
        for (std::size_t n = 0; n <= rings[r].size(); ++n) {
            const auto& [x, y] = rings[r][n % rings[r].size()];
            text += fmt::format("{} {} {} ", x + 391000, y + 5820000, z);
        }
        text += fmt::format("</gml:posList></gml:LinearRing></gml:{}>", side);
    }
    return text + "</gml:Polygon></gml:surfaceMember>";
}

std::string surface(const char* className, const std::string& polygons) {
    return fmt::format(
        "<bldg:boundedBy><bldg:{0}><bldg:lod2MultiSurface><gml:MultiSurface>{1}</gml:MultiSurface>"
        "</bldg:lod2MultiSurface></bldg:{0}></bldg:boundedBy>",
        className, polygons);
}

// A wall from (x0, y0) to (x1, y1), z from 0 to `top`.
std::string wall(double x0, double y0, double x1, double y1, double top) {
    const auto at = [](double x, double y, double z) { return fmt::format("{} {} {} ", x + 391000, y + 5820000, z); };
    return "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + at(x0, y0, 0) +
           at(x1, y1, 0) + at(x1, y1, top) + at(x0, y0, top) + at(x0, y0, 0) +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}

// Walls of a box without that in the south if it is open, floor and roof.
std::string facesOfBox(double x0, double y0, double x1, double y1, double top, bool hasSouth = true) {
    return polygon({{{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}}}, 0) +
           polygon({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, top) + (hasSouth ? wall(x0, y0, x1, y0, top) : "") +
           wall(x1, y0, x1, y1, top) + wall(x1, y1, x0, y1, top) + wall(x0, y1, x0, y0, top);
}

std::string lod2Solid(const std::string& faces) {
    return "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + faces +
           "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
}

std::string buildingMember(const char* id, const std::string& content, const char* element = "Building") {
    return fmt::format("<bldg:{0} gml:id=\"{1}\">{2}</bldg:{0}>", element, id, content);
}

std::string flood(const char* members) {
    return fmt::format("<ade:flood><ade:RiverFlood>{}</ade:RiverFlood></ade:flood>", members);
}

// Four buildings: one around a court whose roof is larger than its ground; one of two parts side by side, the second with
// a ground surface, the first without; one that is a solid with a gap; one with several values of attributes.
std::string town() {
    const std::vector<std::vector<std::array<double, 2>>> court = {{{0, 0}, {0, 10}, {12, 10}, {12, 0}},
                                                                   {{4, 4}, {8, 4}, {8, 7}, {4, 7}}};
    std::string text =
        "<?xml version=\"1.0\"?><core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
        "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
        "xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\" xmlns:ade=\"http://example.org/ade\">"
        "<gml:boundedBy><gml:Envelope srsName=\"urn:ogc:def:crs:EPSG::25833\" srsDimension=\"3\"><gml:lowerCorner>"
        "391000 5820000 0</gml:lowerCorner><gml:upperCorner>391080 5820020 9</gml:upperCorner></gml:Envelope>"
        "</gml:boundedBy>";
    const auto add = [&](const std::string& object) {
        text += "<core:cityObjectMember>" + object + "</core:cityObjectMember>";
    };
    add(buildingMember("court", surface("GroundSurface", polygon(court, 0)) +
                                    surface("RoofSurface", polygon({{{-1, -1}, {13, -1}, {13, 11}, {-1, 11}}}, 6))));
    const auto part = [&](const char* id, const std::string& content) {
        return "<bldg:consistsOfBuildingPart>" + buildingMember(id, content, "BuildingPart") +
               "</bldg:consistsOfBuildingPart>";
    };
    add(buildingMember(
        "pair", part("west", lod2Solid(facesOfBox(20, 0, 25, 8, 4))) +
                    part("east", lod2Solid(facesOfBox(25, 0, 31, 8, 6)) +
                                     surface("GroundSurface", polygon({{{25, 0}, {25, 8}, {31, 8}, {31, 0}}}, 0)))));
    add(buildingMember("floods",
                       "<gen:stringAttribute name=\"use\"><gen:value>shop</gen:value></gen:stringAttribute>"
                       "<gen:stringAttribute name=\"use\"><gen:value>flat, small</gen:value></gen:stringAttribute>" +
                           flood("<ade:depth uom=\"m\">0.5</ade:depth><ade:rank>1</ade:rank>") +
                           flood("<ade:rank>3</ade:rank>") + lod2Solid(facesOfBox(40, 0, 44, 5, 3))));
    add(buildingMember("dry", flood("<ade:depth uom=\"m\">0.25</ade:depth><ade:rank>1</ade:rank>") +
                                  lod2Solid(facesOfBox(50, 0, 52, 2, 3))));
    return text + "</core:CityModel>";
}

double areaOf(const json& ring) {
    double twice = 0;
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
        twice += (ring[n][0].get<double>() - ring[0][0].get<double>()) *
                     (ring[n + 1][1].get<double>() - ring[0][1].get<double>()) -
                 (ring[n][1].get<double>() - ring[0][1].get<double>()) *
                     (ring[n + 1][0].get<double>() - ring[0][0].get<double>());
    return twice / 2;
}

double areaOfGeometry(const json& geometry) {
    double area = 0;
    const json polygons =
        geometry["type"] == "Polygon" ? json::array({geometry["coordinates"]}) : geometry["coordinates"];
    for (const json& rings : polygons)
        for (const json& ring : rings) area += areaOf(ring);
    return area;
}

class GisTables : public ::testing::Test {
protected:
    GisTables() { writeText(folder / "town.gml", town()); }

    std::map<std::string, json> featuresOf(const std::string& file) const {
        std::map<std::string, json> features;
        const json layer = json::parse(readText(folder / file));
        for (const json& feature : layer.at("features")) features[feature.at("properties").at("id")] = feature;
        return features;
    }

    TemporaryFolder folder;
};

TEST_F(GisTables, HaveTrueFootprints) {
    // Of the file, and of a volume at a spacing that says nothing about the outlines.
    runSvtWell(folder.path(), {"convert", "town.gml", "a.geojson", "--select", "class=Building", "--roofs"});
    runSvtWell(folder.path(), {"build", "town.gml", "-o", "town.svt", "--spacing", "0.9"});
    runSvtWell(folder.path(), {"convert", "town.svt", "b.geojson", "--select", "class=Building or class=BuildingPart"});
    for (const char* file : {"a.geojson", "b.geojson"}) {
        auto features = featuresOf(file);
        const std::pair<const char*, double> expected[] = {
            {"court", 120 - 12}, {"pair", 88}, {"floods", 20}, {"dry", 4}};
        for (const auto& [id, area] : expected) {
            EXPECT_NEAR(areaOfGeometry(features[id]["geometry"]), area, 1e-4) << file << " " << id;
            EXPECT_NEAR(features[id]["properties"]["area"].get<double>(), area, 1e-4) << file << " " << id;
        }
        EXPECT_EQ(features["court"]["geometry"]["coordinates"].size(), 2u) << "the court is a hole";
        EXPECT_EQ(features["court"]["properties"]["footprint"], "ground surfaces");
        EXPECT_EQ(features["pair"]["properties"]["footprint"], "ground surfaces and meshes");
        EXPECT_EQ(features["floods"]["properties"]["footprint"], "meshes");
    }
    EXPECT_NEAR(areaOfGeometry(featuresOf("a.roofs.geojson")["court"]["geometry"]), 14 * 12, 1e-4);
    EXPECT_NEAR(featuresOf("a.geojson")["court"]["properties"]["roofArea"].get<double>(), 14 * 12, 1e-4);
    // Without meshes, the footprints are those of voxels, and the column says so.
    runSvtWell(folder.path(), {"build", "town.gml", "-o", "bare.svt", "--spacing", "0.5", "--vectors", "none"});
    runSvtWell(folder.path(), {"query", "bare.svt", "id=floods", "-o", "bare.geojson"});
    const json bare = featuresOf("bare.geojson")["floods"];
    EXPECT_EQ(bare["properties"]["footprint"], "voxels");
    EXPECT_NEAR(areaOfGeometry(bare["geometry"]), bare["properties"]["area"].get<double>(), 1e-4);
}

TEST_F(GisTables, VolumesIncludePartsAndSayWhereTheyComeFrom) {
    const json rows = runSvtForJson(
        folder.path(), {"query", "town.gml", "class=Building or class=BuildingPart", "--sort", "volume", "--json"});
    std::map<std::string, json> row;
    for (const json& each : rows) row[each["id"]] = each;
    EXPECT_NEAR(row["pair"]["volume"].get<double>(), 5 * 8 * 4 + 6 * 8 * 6, 1e-6) << "as its voxels and area";
    EXPECT_EQ(row["pair"]["volumeSource"], "meshes");
    EXPECT_EQ(row["pair"]["volumeBound"], 0.0);
    EXPECT_EQ(rows[0]["id"], "pair");
    for (const json& each : rows) EXPECT_NE(each["volume"], 0) << each;
    const json selected = runSvtForJson(folder.path(), {"query", "town.gml", "volume>440", "--json"});
    ASSERT_EQ(selected.size(), 1u);
    EXPECT_EQ(selected[0]["id"], "pair");
    EXPECT_NEAR(selected[0]["volume"].get<double>(), 448, 1e-6);
}

// A house of 10 x 8 x 4 m with a window in a wall, and a block around a court that has neither floor nor ground surface.
TEST_F(GisTables, AreasOfFacesAreThoseOfTheModel) {
    const std::string hole = "<bldg:opening><bldg:Window><bldg:lod3MultiSurface><gml:MultiSurface>" +
                             wall(2, 0, 4, 0, 1.5) +
                             "</gml:MultiSurface></bldg:lod3MultiSurface></bldg:Window></bldg:opening>";
    std::string south = surface("WallSurface", wall(0, 0, 10, 0, 4));
    south.insert(south.find("</bldg:WallSurface>"), hole);
    const std::string model = town();
    writeText(
        folder / "house.gml",
        model.substr(0, model.find("<core:cityObjectMember>")) + "<core:cityObjectMember>" +
            buildingMember("house", surface("RoofSurface", polygon({{{0, 0}, {10, 0}, {10, 8}, {0, 8}}}, 4)) + south +
                                        surface("WallSurface", wall(10, 0, 10, 8, 4) + wall(10, 8, 0, 8, 4)) +
                                        surface("WallSurface", wall(0, 8, 0, 0, 4)) +
                                        surface("GroundSurface", polygon({{{0, 0}, {0, 8}, {10, 8}, {10, 0}}}, 0))) +
            "</core:cityObjectMember></core:CityModel>");
    const json rows = runSvtForJson(
        folder.path(), {"query", "house.gml", "class=Building or class=RoofSurface", "--with", "faces", "--json"});
    ASSERT_EQ(rows.size(), 2u) << rows;
    const json& faces = rows[0]["faces"];
    EXPECT_NEAR(faces["roof"].get<double>(), 80, 1e-4);
    EXPECT_NEAR(faces["wall"].get<double>(), 144, 1e-4);
    EXPECT_NEAR(faces["ground"].get<double>(), 80, 1e-4);
    EXPECT_NEAR(faces["window"].get<double>(), 3, 1e-4);
    EXPECT_TRUE(faces["door"].is_null()) << "the house has none";
    EXPECT_NEAR(rows[1]["faces"]["roof"].get<double>(), 80, 1e-4);
    EXPECT_TRUE(rows[1]["faces"]["wall"].is_null());
    // Without meshes, no area is known.
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "bare.svt", "--spacing", "0.5", "--vectors", "none"});
    const json bare =
        runSvtForJson(folder.path(), {"query", "bare.svt", "class=Building", "--with", "faces", "--json"});
    for (const char* kind : {"roof", "wall", "ground", "window", "door"}) EXPECT_TRUE(bare[0]["faces"][kind].is_null());
    const std::string csv =
        runSvtWell(folder.path(), {"query", "bare.svt", "class=Building", "--with", "faces", "--csv"});
    EXPECT_NE(csv.find("roofFaces,wallFaces,groundFaces,windowFaces,doorFaces"), std::string::npos) << csv;
}

TEST_F(GisTables, FootprintsLeaveOutCourtsWithoutAFloor) {
    std::string faces = polygon({{{0, 0}, {14, 0}, {14, 12}, {0, 12}}, {{4, 4}, {4, 7}, {8, 7}, {8, 4}}}, 5);
    const std::array<std::array<double, 2>, 4> outer{{{0, 0}, {14, 0}, {14, 12}, {0, 12}}};
    const std::array<std::array<double, 2>, 4> inner{{{4, 4}, {4, 7}, {8, 7}, {8, 4}}};
    for (const auto& ring : {outer, inner})
        for (std::size_t n = 0; n < 4; ++n)
            faces += wall(ring[n][0], ring[n][1], ring[(n + 1) % 4][0], ring[(n + 1) % 4][1], 5);
    const std::string paving = "<bldg:lod2MultiSurface><gml:MultiSurface>" +
                               polygon({{{4, 4}, {8, 4}, {8, 7}, {4, 7}}}, 0) +
                               "</gml:MultiSurface></bldg:lod2MultiSurface>";
    const std::string model = town(), head = model.substr(0, model.find("<core:cityObjectMember>"));
    const auto member = [](const std::string& text) {
        return "<core:cityObjectMember>" + text + "</core:cityObjectMember>";
    };
    for (const std::string& other : {std::string(), member(buildingMember("paving", paving))}) {
        writeText(folder / "block.gml",
                  head + member(buildingMember("block", lod2Solid(faces))) + other + "</core:CityModel>");
        runSvtWell(folder.path(), {"convert", "block.gml", "block.geojson", "--select", "id=block"});
        const json block = featuresOf("block.geojson")["block"];
        EXPECT_NEAR(areaOfGeometry(block["geometry"]), 14 * 12 - 12, 1e-4);
        EXPECT_NEAR(block["properties"]["volume"].get<double>(), (14 * 12 - 12) * 5, 1e-3);
    }
}

// A box that only leaves out a layer of background, and a selection of everything, change no volume.
TEST_F(GisTables, VolumesOfPartsCountRoomsOnce) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.gml"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "whole.svt", "--spacing", "0.1"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "box.svt", "--spacing", "0.1", "--box",
                               "499999.64,5399997.64,99,500030,5400030,130"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "selected.svt", "--spacing", "0.1", "--only", "all"});
    const auto volumesOf = [&](const char* file) {
        const json rows =
            runSvtForJson(folder.path(), {"query", file, "class=Building or class=BuildingRoom", "--json"});
        std::map<std::string, std::array<json, 3>> volumes;
        for (const json& row : rows) volumes[row["id"]] = {row["volume"], row["totalVolume"], row["volumeBound"]};
        return volumes;
    };
    const auto whole = volumesOf("whole.svt");
    EXPECT_GT(whole.size(), 5u);
    EXPECT_EQ(volumesOf("box.svt"), whole);
    EXPECT_EQ(volumesOf("selected.svt"), whole);
    const std::string text = runSvt(folder.path(), {"query", "whole.svt", "class=Building"}).out;
    for (const char* heading : {"total m3", "best m3", "+- m3", "best m3 from"})
        EXPECT_NE(text.find(heading), std::string::npos) << heading;
}

TEST_F(GisTables, KeepSeveralValuesOfAnAttribute) {
    const json depths = {0.5, nullptr}, ranks = {"1", "3"}, uses = {"shop", "flat, small"};
    for (const char* file : {"f.geojson", "f.csv", "f.gpkg", "f.parquet"})
        runSvtWell(folder.path(), {"query", "town.gml", "class=Building", "-o", file});
    const json floods = featuresOf("f.geojson")["floods"]["properties"];
    EXPECT_EQ(floods["flood/depth"], depths);
    EXPECT_EQ(floods["flood/rank"], ranks);
    EXPECT_EQ(floods["use"], uses);
    EXPECT_EQ(featuresOf("f.geojson")["dry"]["properties"]["flood/depth"], 0.25) << "one value keeps its type";
    const std::string csv = readText(folder / "f.csv");
    EXPECT_NE(csv.find("\"[0.5,null]\",\"[\"\"1\"\",\"\"3\"\"]\""), std::string::npos) << csv;
    // The same rule in JSON, and in the table of objects.
    const json printed = runSvtForJson(folder.path(), {"query", "town.gml", "id=floods", "--json"});
    EXPECT_EQ(printed[0]["attributes"]["flood/depth"], depths);
    EXPECT_EQ(printed[0]["attributes"]["flood/rank"], ranks);
    runSvtWell(folder.path(), {"convert", "town.gml", "objects.csv"});
    EXPECT_NE(readText(folder / "objects.csv").find("\"[0.5,null]\""), std::string::npos);
    // Any value counts.
    const auto idsOf = [&](const char* query) {
        std::vector<std::string> ids;
        for (const json& row : runSvtForJson(folder.path(), {"query", "town.gml", query, "--json"}))
            ids.push_back(row["id"]);
        return ids;
    };
    using Ids = std::vector<std::string>;
    EXPECT_EQ(idsOf("flood/rank>=3"), Ids{"floods"});
    EXPECT_EQ(idsOf("flood/rank=1"), (Ids{"floods", "dry"}));
    EXPECT_EQ(idsOf("flood/rank!=1"), Ids{"floods"});
    EXPECT_EQ(idsOf("use='flat, small'"), Ids{"floods"});
}

TEST_F(GisTables, ListTheValuesInATableOfTheirOwn) {
    runSvtWell(folder.path(), {"query", "town.gml", "class=Building", "-o", "f.gpkg", "--roofs"});
    const std::string script =
        "import sqlite3; c = sqlite3.connect('f.gpkg'); "
        "print(c.execute('select feature, name, record, position, value, unit from attribute_values order by fid')"
        ".fetchall()); "
        "print(c.execute('select v.value from attribute_values v join features f on f.fid = v.feature_fid "
        "where f.id = ? and v.name = ?', ('floods', 'use')).fetchall()); "
        "print(c.execute('select table_name, data_type from gpkg_contents order by 1').fetchall()); "
        "print(c.execute('select geometry_type_name from gpkg_geometry_columns').fetchall())";
    const ShellResult said = runShell(folder.path(), "python3 -c \"" + script + "\"");
    if (said.isMissing()) GTEST_SKIP() << said.text;
    EXPECT_EQ(said.text,
              "[('floods', 'use', 1, 1, 'shop', None), ('floods', 'use', 1, 2, 'flat, small', None), "
              "('floods', 'flood/depth', 1, 1, '0.5', 'm'), ('floods', 'flood/rank', 1, 1, '1', None), "
              "('floods', 'flood/rank', 2, 2, '3', None)]\n"
              "[('shop',), ('flat, small',)]\n"
              "[('attribute_values', 'attributes'), ('features', 'features'), ('roofs', 'features')]\n"
              "[('MULTIPOLYGON',), ('MULTIPOLYGON',)]\n");
    runSvtWell(folder.path(), {"query", "town.gml", "class=Building", "-o", "f.parquet", "--roofs"});
    for (const char* file : {"f.parquet", "f.roofs.parquet", "f.attributes.parquet"})
        EXPECT_EQ(readText(folder / file).substr(0, 4), "PAR1") << file;
}

}  // namespace
}  // namespace svt::test
