// `svt quantities`: take-offs of generated models and of small ones.
#include "../run_command.hpp"
#include "../small_model.hpp"

#include <svt/core/test_data_test.hpp>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace svt::test {
namespace {

using nlohmann::json;

class Quantities : public ::testing::Test {
protected:
    void sample(const std::string& file, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"sample", "house", "-o", file});
        runSvtWell(folder.path(), more);
    }
    json measure(const std::string& file, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"quantities", file, "--spacing", "0.1", "--json", "-q"});
        return runSvtForJson(folder.path(), more);
    }
    TemporaryFolder folder;
};

TEST_F(Quantities, HasTheDocumentedKeys) {
    sample("house.gml");
    const json report = measure("house.gml", {"--exterior"});
    const std::set<std::string> expected{"id",           "class",      "name",         "storey",
                                         "material",     "netVolume",  "grossVolume",  "sideArea",
                                         "topArea",      "bottomArea", "exteriorArea", "openingArea",
                                         "formworkArea", "trust",      "bound",        "exteriorCountedArea"};
    ASSERT_GT(report["rows"].size(), 50u);
    for (const json& row : report["rows"]) {
        std::set<std::string> keys;
        for (const auto& [key, value] : row.items()) keys.insert(key);
        EXPECT_EQ(keys, expected);
        EXPECT_NE(row["netVolume"], 0);
        EXPECT_TRUE(row["formworkArea"].is_null()) << "not asked for";
        EXPECT_FALSE(row["exteriorArea"].is_null()) << row;
    }
    EXPECT_FALSE(report["assumptions"].empty());
    EXPECT_EQ(report["total"]["objects"], report["rows"].size());
}

// Colours are those of the volume: of the materials of the file, or of the style.
TEST_F(Quantities, AddUpExteriorAreasByColour) {
    sample("house.gml");
    const json report = measure("house.gml", {"--exterior", "--by", "color"});
    ASSERT_GT(report["sums"].size(), 2u);
    double sum = 0, counted = 0;
    std::set<std::string> colors;
    for (const json& row : report["sums"]) {
        const std::string color = row["by"]["color"];
        EXPECT_TRUE(color.size() == 7 && color.front() == '#') << color;
        EXPECT_TRUE(colors.insert(color).second) << color;
        if (row["exteriorArea"].is_null()) continue;
        sum += row["exteriorArea"].get<double>();
        counted += row["exteriorCountedArea"].get<double>();
    }
    EXPECT_NEAR(sum, report["total"]["exteriorArea"], 1e-5);
    EXPECT_NEAR(counted, report["total"]["exteriorCountedArea"], 1e-5);
    EXPECT_LT(counted, 0.005 * sum) << "meshes divide nearly all faces";
}

// The model states its volumes; IFC and CityGML of one house have the same sums.
TEST_F(Quantities, AreThoseOfTheGeneratedHouse) {
    sample("house.gml");
    sample("house.ifc", {"--format", "ifc"});
    const json stated = measure("house.ifc", {"--stated"});
    std::size_t compared = 0;
    for (const json& row : stated["stated"]) {
        ASSERT_FALSE(row["measured"].is_null()) << row;
        ++compared;
        EXPECT_NEAR(row["difference"].get<double>(), 0, 1e-3 * row["stated"].get<double>()) << row;
    }
    EXPECT_GT(compared, 20u);
    const double gml = measure("house.gml")["total"]["netVolume"], ifc = measure("house.ifc")["total"]["netVolume"];
    EXPECT_NEAR(gml, ifc, 1e-4 * gml);
}

// Openings that are only holes of bodies count as those that the file names.
TEST_F(Quantities, NeedNoOpeningsInTheFile) {
    sample("house.ifc");
    sample("baked.ifc", {"--bake-openings"});
    EXPECT_EQ(readText(folder / "baked.ifc").find("IFCOPENINGELEMENT"), std::string::npos);
    const json named = measure("house.ifc"), baked = measure("baked.ifc");
    const auto isNear = [](const json& a, const json& b, double part) {
        if (a.is_null() || b.is_null()) return a.is_null() && b.is_null();
        return std::abs(a.get<double>() - b.get<double>()) <= part * std::abs(a.get<double>()) + 1e-6;
    };
    ASSERT_EQ(named["rows"].size(), baked["rows"].size());
    std::map<std::string, json> byId;
    for (const json& row : baked["rows"]) byId[row["id"]] = row;
    for (const json& row : named["rows"]) {
        const json& other = byId[row["id"]];
        EXPECT_TRUE(isNear(row["netVolume"], other["netVolume"], 1e-3)) << row << other;
        EXPECT_TRUE(isNear(row["grossVolume"], other["grossVolume"], 5e-3)) << row << other;
        EXPECT_TRUE(isNear(row["openingArea"], other["openingArea"], 1e-3)) << row << other;
    }
    for (const char* key : {"netVolume", "grossVolume", "openingArea", "sideArea", "outerArea"})
        EXPECT_TRUE(isNear(named["total"][key], baked["total"][key], 1e-3)) << key;
    EXPECT_EQ(named["total"]["unknown"], baked["total"]["unknown"]);
}

// The sides of a slab that stands in a body of soil touch no air, as in FZK-Haus as IFC, which has its site. The model
// without the soil has the whole slab.
TEST_F(Quantities, ExteriorAreasExcludeSoil) {
    const std::string slab = building("slab", solid(boxFaces(2, 2, 1, 8, 6, 2)));
    std::string soil = building("soil", solid(boxFaces(0, 0, 0, 2, 8, 2)));
    const auto outside = [&](const std::string& file, const std::string& text) {
        writeText(folder / file, cityModel(text));
        return measure(file, {"--where", "id=slab", "--exterior"})["exterior"][0];
    };
    const json alone = outside("alone.gml", slab), earth = outside("earth.gml", slab + soil);
    EXPECT_NEAR(alone["w"].get<double>(), 4, 0.01);
    EXPECT_NEAR(earth["w"].get<double>(), 0, 0.25);  // a strip of half a voxel
    EXPECT_NEAR(earth["e"].get<double>(), 4, 0.01);
    EXPECT_NEAR(earth["top"].get<double>(), 24, 0.01);
}

TEST_F(Quantities, SumsByKeysAddUp) {
    sample("house.gml");
    const json report = measure("house.gml", {"--by", "class,storey"});
    double sum = 0;
    std::size_t objects = 0;
    for (const json& group : report["sums"]) {
        EXPECT_EQ(group["by"].size(), 2u);
        sum += group["netVolume"].is_null() ? 0.0 : group["netVolume"].get<double>();
        objects += group["objects"].get<std::size_t>();
    }
    EXPECT_NEAR(sum, report["total"]["netVolume"].get<double>(), 1e-6);
    EXPECT_EQ(objects, report["rows"].size());
}

// Two buildings side by side, 4 x 6 x 3 m: the model has no components, so the buildings are measured.
TEST_F(Quantities, OfBuildings) {
    writeText(folder / "two.gml", twoBoxes());
    const json report = measure("two.gml", {"--exterior"});
    ASSERT_EQ(report["rows"].size(), 2u);
    for (const json& row : report["rows"]) {
        EXPECT_NEAR(row["netVolume"].get<double>(), 72, 1e-3);
        EXPECT_EQ(row["trust"], "exact");
        EXPECT_TRUE(row["grossVolume"].is_null()) << "a building has no openings";
        EXPECT_NEAR(row["topArea"].get<double>(), 24, 1e-3);
    }
}

TEST_F(Quantities, WritesFiles) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"quantities", "two.gml", "--spacing", "0.5", "-o", "q.csv"});
    const std::string csv = readText(folder / "q.csv");
    EXPECT_EQ(csv.find("id,class,name,storey,material,netVolume"), 0u) << csv;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3) << csv;
    runSvtWell(folder.path(), {"quantities", "two.gml", "--spacing", "0.5", "-o", "q.json"});
    EXPECT_EQ(json::parse(readText(folder / "q.json"))["rows"].size(), 2u);
}

TEST_F(Quantities, AnswersEmptyAndWrongQuestions) {
    writeText(folder / "two.gml", twoBoxes());
    const CommandResult empty =
        runSvt(folder.path(), {"quantities", "two.gml", "--spacing", "0.5", "--where", "class=Door"});
    EXPECT_EQ(empty.exitCode, 0);
    EXPECT_NE(empty.err.find("no objects are measured"), std::string::npos) << empty.err;
    EXPECT_NE(runSvt(folder.path(), {"quantities", "two.gml", "--where", "class="}).exitCode, 0);
    EXPECT_EQ(runSvt(folder.path(), {"quantities", "two.gml", "--between", "all"}).exitCode, 2);
    const CommandResult none =
        runSvt(folder.path(), {"quantities", "two.gml", "--spacing", "0.5", "--formwork", "class=Door"});
    EXPECT_NE(none.exitCode, 0);
    EXPECT_NE(none.err.find("class=Door"), std::string::npos) << none.err;
}

// Two cubes of 2 m beside each other: formwork has all faces but the two that touch. The third cube is not concrete.
TEST_F(Quantities, MeasureFormwork) {
    const auto cubeAt = [](const char* id, double x) { return building(id, solid(boxFaces(x, 0, 0, x + 2, 2, 2))); };
    writeText(folder / "cubes.gml", cityModel(cubeAt("a", 0) + cubeAt("b", 2) + cubeAt("c", 4)));
    const json report = measure("cubes.gml", {"--where", "class=Building", "--formwork", "id=a or id=b"});
    for (const json& row : report["rows"]) {
        if (row["id"] == "c")
            EXPECT_TRUE(row["formworkArea"].is_null()) << row;
        else
            EXPECT_NEAR(row["formworkArea"].get<double>(), 20, 0.1) << row;
    }
    EXPECT_NEAR(report["total"]["formworkArea"].get<double>(), 40, 0.2);
    EXPECT_NEAR(report["total"]["formworkTopArea"].get<double>(), 8, 0.1);
    EXPECT_EQ(report["total"]["unknown"]["formworkArea"], 1);
}

// A volume without meshes has volumes, and no areas.
TEST_F(Quantities, OfAVolumeWithoutMeshesHaveNoAreas) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5", "--vectors", "none"});
    const CommandResult result = runSvt(folder.path(), {"quantities", "two.svt", "--json"});
    EXPECT_NE(result.err.find("no meshes"), std::string::npos) << result.err;
    const json report = result.json();
    ASSERT_EQ(report["rows"].size(), 2u);
    for (const json& row : report["rows"]) {
        EXPECT_NEAR(row["netVolume"].get<double>(), 72, 1e-3);
        EXPECT_TRUE(row["topArea"].is_null() && row["openingArea"].is_null()) << row;
    }
}

// Walls, slabs and beams of the house: the areas of contacts are nearly those of the faces of both sides.
TEST_F(Quantities, MeasureContacts) {
    sample("house.gml");
    const json pairs = runSvtForJson(
        folder.path(), {"quantities", "house.gml", "--spacing", "0.05", "--json", "-q", "--between",
                        "class=BuildingConstructiveElement", "--between", "class=BuildingConstructiveElement"});
    ASSERT_GT(pairs.size(), 20u);
    double a = 0, b = 0;
    for (const json& pair : pairs) {
        a += pair["area"].get<double>();
        b += pair["areaOfB"].get<double>();
    }
    EXPECT_NEAR(a, b, 0.03 * a);
}

// Boxes of 2 m at one place or beside each other, as CityJSON. \param isOpen  surfaces without a bottom
std::string manyBoxes(int count, bool isApart, bool isOpen) {
    std::string objects, vertices;
    for (int n = 0; n < count; ++n) {
        const int x = isApart ? 3 * (n % 100) : 0, y = isApart ? 3 * (n / 100) : 0, v = 8 * n;
        for (const int z : {0, 2})
            for (const auto& [i, j] : {std::pair{0, 0}, {2, 0}, {2, 2}, {0, 2}})
                vertices += (vertices.empty() ? "[" : ",[") + std::to_string(x + i) + "," + std::to_string(y + j) +
                            "," + std::to_string(z) + "]";
        std::string faces;
        for (const auto& face :
             {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
            if (isOpen && face[1] != 1) continue;  // one wall
            faces += faces.empty() ? "[[" : ",[[";
            for (const int corner : face) faces += (faces.back() == '[' ? "" : ",") + std::to_string(v + corner);
            faces += "]]";
        }
        objects += (n == 0 ? "\"b" : ",\"b") + std::to_string(n) + R"(":{"type":"Building","geometry":[{"type":")" +
                   (isOpen ? "MultiSurface" : "Solid") + R"(","lod":"2","boundaries":[)" +
                   (isOpen ? faces : "[" + faces + "]") + "]}]}";
    }
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{)" +
           objects + "},\"vertices\":[" + vertices + "]}";
}

// Thousands of equal objects, at one place or apart, take no quadratic time: this test would not end in its limit.
TEST_F(Quantities, OfManyEqualObjects) {
    for (const bool isApart : {false, true}) {
        writeText(folder / "many.city.json", manyBoxes(10000, isApart, false));
        const json report = runSvtForJson(folder.path(), {"quantities", "many.city.json", "--spacing", "0.5", "--json",
                                                          "-q", "--exterior", "--formwork", "class=Building"});
        EXPECT_EQ(report["rows"].size(), 10000u);
        EXPECT_NEAR(report["total"]["netVolume"].get<double>(), isApart ? 80000 : 8, 0.01);
    }
}

TEST_F(Quantities, OfBadFilesAreAMessage) {
    writeText(folder / "empty.gml", "");
    writeText(folder / "cut.ifc", "ISO-10303-21;");
    for (const char* file : {"empty.gml", "cut.ifc", "missing.ifc"}) {
        const CommandResult result = runSvt(folder.path(), {"quantities", file, "--json"});
        EXPECT_NE(result.exitCode, 0) << file;
        EXPECT_TRUE(result.out.empty()) << file;
        EXPECT_NE(result.err.find("svt: error E"), std::string::npos) << result.toString();
    }
}

// Surfaces have areas, but no volume: null, never 0.
TEST_F(Quantities, OfSurfacesHaveNoVolume) {
    writeText(folder / "open.city.json", manyBoxes(2, true, true));
    const CommandResult result = runSvt(folder.path(), {"quantities", "open.city.json", "--spacing", "0.5", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.toString();
    const json report = json::parse(result.out);
    ASSERT_EQ(report["rows"].size(), 2u);
    for (const json& row : report["rows"]) {
        EXPECT_TRUE(row["netVolume"].is_null() && row["trust"].is_null() && row["bound"].is_null()) << row;
        EXPECT_NEAR(row["sideArea"].get<double>(), 4, 0.01) << row;
    }
    EXPECT_TRUE(report["total"]["netVolume"].is_null());
    EXPECT_NE(result.err.find("net volume of 2 of 2 objects is unknown"), std::string::npos) << result.toString();
}

// The space of a building that belongs to no room, here an attic, is the material behind its surfaces. No bound holds.
TEST_F(Quantities, OfMaterialBehindSurfacesAreAssumed) {
    const std::vector<Face> faces = boxFaces(0, 0, 0, 8, 6, 6);
    std::string inside;
    for (std::size_t n = 0; n < faces.size(); ++n) {
        const std::string kind = n == 0 ? "bldg:GroundSurface" : n == 1 ? "bldg:RoofSurface" : "bldg:WallSurface";
        inside += "<bldg:boundedBy><" + kind + "><bldg:lod4MultiSurface><gml:MultiSurface><gml:surfaceMember>" +
                  "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + faces[n] +
                  "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>" +
                  "</gml:MultiSurface></bldg:lod4MultiSurface></" + kind + "></bldg:boundedBy>";
    }
    inside += "<bldg:interiorRoom><bldg:Room gml:id='room'><bldg:lod4Solid>" +
              solid(boxFaces(0.3, 0.3, 0.3, 7.7, 5.7, 3)) + "</bldg:lod4Solid></bldg:Room></bldg:interiorRoom>";
    writeText(folder / "attic.gml", cityModel(building("b", solid(faces), inside)));
    const CommandResult result = runSvt(folder.path(), {"quantities", "attic.gml", "--spacing", "0.1", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.toString();
    const json report = json::parse(result.out);
    ASSERT_EQ(report["rows"].size(), 6u) << result.out;
    for (const json& row : report["rows"]) {
        EXPECT_EQ(row["trust"], "assumed");
        EXPECT_GT(row["netVolume"], 0);
        EXPECT_TRUE(row["bound"].is_null()) << row;
    }
    EXPECT_NEAR(report["total"]["netVolume"].get<double>(), 8 * 6 * 6 - 7.4 * 5.4 * 2.7, 6);
    EXPECT_TRUE(report["total"]["bound"].is_null());
    EXPECT_NE(result.err.find("the volumes of 6 boundary surfaces are assumed"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace svt::test
