// `svt section`: drawings that other programs can open, their areas, and clear errors.
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <cmath>
#include <map>
#include <regex>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

/// Two boxes side by side, 4 x 6 x 3 m each, as a volume of 0.1 m in `folder`.
void buildBoxes(const fs::path& folder) {
    writeText(folder / "boxes.gml", twoBoxes());
    prepare(folder, {"build", "boxes.gml", "-o", "boxes.svt", "--spacing", "0.1"});
}

/// The generated house, 0.1 m.
void buildHouse(const fs::path& folder) { prepareHouse(folder, "0.1"); }

double ringArea(const nlohmann::json& ring) {
    double area = 0;
    for (std::size_t n = 0; n + 1 < ring.size(); ++n) {
        // Relative to the first point: coordinates are large.
        const double ax = ring[n][0].get<double>() - ring[0][0].get<double>();
        const double ay = ring[n][1].get<double>() - ring[0][1].get<double>();
        const double bx = ring[n + 1][0].get<double>() - ring[0][0].get<double>();
        const double by = ring[n + 1][1].get<double>() - ring[0][1].get<double>();
        area += 0.5 * (ax * by - ay * bx);
    }
    return area;
}

// A section of the generated IFC house from south to north, 9.9 m from its eaves: areas of the layers in closed form.
TEST(Section, LayersOfIfcAreCutAndHatched) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.ifc"});
    const auto drawn = runSvtForJson(folder.path(), {"section", "house.ifc", "--layers", "--spacing", "0.1", "--plane",
                                                     "x<9.9", "-o", "layers.svg", "--json"});
    std::map<std::string, double> areas;
    for (const auto& component : drawn["components"])
        areas[component["name"].get<std::string>()] += component["area"].get<double>();
    EXPECT_NEAR(areas["screed"], 9 * (0.05 + 0.05), 1e-4);
    EXPECT_NEAR(areas["EPS insulation"], 9 * (0.06 + 0.02), 1e-4);
    EXPECT_NEAR(areas["reinforced concrete"], 9 * (0.14 + 0.13), 1e-4);
    EXPECT_NEAR(areas["gypsum board"], 2 * 0.0125 * 2.76, 1e-4);
    EXPECT_EQ(areas.count("Exterior wall north, ground floor"), 0u);
    const std::string svg = readText(folder.path() / "layers.svg");
    for (const char* hatch : {"url(#masonry)", "url(#insulation)", "url(#reinforced-concrete)", "url(#concrete)"})
        EXPECT_NE(svg.find(hatch), std::string::npos) << hatch;
    const auto whole = runSvtForJson(
        folder.path(), {"section", "house.ifc", "--spacing", "0.1", "--plane", "x<9.9", "-o", "whole.svg", "--json"});
    double sum = 0;
    for (const auto& component : whole["components"])
        if (component["name"] == "Exterior wall north, ground floor") sum += component["area"].get<double>();
    EXPECT_NEAR(sum, 0.365 * 2.76, 1e-4);
}

TEST(Section, TableHasTheAreasOfTheBoxes) {
    const TemporaryFolder folder;
    buildBoxes(folder.path());
    const auto plan = runSvtForJson(folder.path(), {"section", "boxes.svt", "--plane", "z=1", "--json"});
    ASSERT_EQ(plan["components"].size(), 2u);
    for (const auto& component : plan["components"]) {
        EXPECT_LE(std::abs(component["area"].get<double>() - 24), component["areaBound"].get<double>());
        EXPECT_LT(component["areaBound"].get<double>(), 1e-3);
        EXPECT_EQ(component["exact"], true);
        EXPECT_EQ(component["class"], "Building");
        EXPECT_EQ(component["polygons"], 1);
    }
    ASSERT_EQ(plan["classes"].size(), 1u);
    EXPECT_EQ(plan["classes"][0]["components"], 2);
    EXPECT_NEAR(plan["classes"][0]["area"].get<double>(), plan["area"].get<double>(), 1e-5);
    const auto upright = runSvtForJson(folder.path(), {"section", "boxes.svt", "--plane", "y<3", "--json"});
    for (const auto& component : upright["components"])
        EXPECT_LE(std::abs(component["area"].get<double>() - 12), component["areaBound"].get<double>());
    // The middle of the grid if there is no storey.
    const auto middle = runSvtForJson(folder.path(), {"section", "boxes.svt", "--json"});
    EXPECT_NEAR(middle["plane"]["origin"][2].get<double>() - plan["plane"]["origin"][2].get<double>(), 0.55, 1e-6);
    runSvtWell(folder.path(), {"section", "boxes.svt", "--table", "t.csv", "--table", "t.json"});
    EXPECT_EQ(nlohmann::json::parse(readText(folder / "t.json")), middle);
    EXPECT_EQ(readText(folder / "t.csv")
                  .rfind("kind,id,class,name,polygons,area_m2,area_bound_m2,exact,line_length_m\r\n", 0),
              0u);
}

TEST(Section, VolumesWithoutMeshesAreCutByVoxels) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "boxes.svt", "--spacing", "0.1", "--vectors", "none"});
    const auto plan = runSvtForJson(folder.path(), {"section", "boxes.svt", "--plane", "z=1", "--json"});
    ASSERT_EQ(plan["components"].size(), 2u);
    for (const auto& component : plan["components"]) {
        EXPECT_EQ(component["exact"], false);
        EXPECT_GT(component["areaBound"].get<double>(), 0.1);
    }
    // From the model it is exact at any spacing.
    const auto exact =
        runSvtForJson(folder.path(), {"section", "boxes.gml", "--plane", "z=1", "--json", "--spacing", "0.5"});
    ASSERT_EQ(exact["components"].size(), 2u);
    for (const auto& component : exact["components"]) EXPECT_NEAR(component["area"].get<double>(), 24, 1e-3);
}

TEST(Section, SheetsAreLinesInAllFormats) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "plan.dxf", "-o", "plan.geojson", "-o", "plan.svg",
                               "--show", "class=ClosureSurface"});
    const auto drawn = nlohmann::json::parse(readText(folder / "plan.geojson"));
    ASSERT_GE(drawn["features"].size(), 1u);
    for (const auto& feature : drawn["features"]) {
        EXPECT_EQ(feature["geometry"]["type"], "MultiLineString");
        EXPECT_EQ(feature["properties"]["area"], 0);
        EXPECT_EQ(feature["properties"]["exact"], true);
    }
    EXPECT_NE(readText(folder / "plan.dxf").find("LWPOLYLINE"), std::string::npos);
    EXPECT_NE(readText(folder / "plan.svg").find("class=\"thin dashed ClosureSurface\""), std::string::npos);
}

TEST(Section, DefaultIsAboveTheLowestStoreysFloor) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    const auto byDefault = runSvtForJson(folder.path(), {"section", "house.svt", "--json"});
    const auto named =
        runSvtForJson(folder.path(), {"section", "house.svt", "--json", "--plane", "storey=house_storey_0+1.1"});
    EXPECT_EQ(byDefault, named);
    const auto names = byDefault.dump();
    EXPECT_NE(names.find("Kitchen"), std::string::npos);
    const auto noRooms = runSvtForJson(folder.path(), {"section", "house.svt", "--json", "--no-rooms"});
    EXPECT_EQ(noRooms.dump().find("BuildingRoom"), std::string::npos);
    const auto shown = runSvtForJson(folder.path(), {"section", "house.svt", "--json", "--show", "class=BuildingRoom",
                                                     "--hide", "name=Kitchen", "--min-area", "5"});
    for (const auto& component : shown["components"]) {
        EXPECT_EQ(component["class"], "BuildingRoom");
        EXPECT_NE(component["name"], "Kitchen");
        EXPECT_GE(component["area"].get<double>(), 5);
    }
}

TEST(Section, SameBytesForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    for (const char* threads : {"1", "4"})
        runSvtWell(folder.path(), {"section", "house.svt", "--plane", "0.3,0.5,0.4,-6", "--threads", threads, "-o",
                                   std::string(threads) + ".svg", "-o", std::string(threads) + ".dxf", "-o",
                                   std::string(threads) + ".geojson"});
    for (const char* extension : {".svg", ".dxf", ".geojson"}) {
        const std::string one = readText(folder / (std::string("1") + extension));
        EXPECT_GT(one.size(), 1000u);
        EXPECT_EQ(one, readText(folder / (std::string("4") + extension)));
    }
}

TEST(Section, SvgIsXmlToScaleAndCanBeDrawn) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "a.svg", "-o", "b.svg"});
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "large.svg", "--scale", "1:50"});
    const std::string svg = readText(folder / "a.svg");
    EXPECT_EQ(svg, readText(folder / "b.svg"));
    for (const char* part :
         {"class=\"BuildingRoom\"", "data-id=\"house_kitchen\"", "<title>house_kitchen: Kitchen</title>",
          ">Kitchen</text>", "1:100", "class=\"bold\"", "url(#masonry)"})
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    const auto widthOf = [](const std::string& text) {
        std::smatch match;
        return std::regex_search(text, match, std::regex("width=\"([0-9.]+)mm\"")) ? std::stod(match[1]) : 0.0;
    };
    // Twice as wide, between margins of 10 mm.
    EXPECT_NEAR(widthOf(readText(folder / "large.svg")) - 20, 2 * (widthOf(svg) - 20), 0.01);
    if (!hasProgram("xmllint --version") || !hasProgram("rsvg-convert --version"))
        GTEST_SKIP() << "no xmllint or rsvg-convert here";
    runShellWell(folder.path(), "xmllint --noout a.svg");
    runShellWell(folder.path(), "rsvg-convert a.svg -o a.png");
    EXPECT_GT(fs::file_size(folder / "a.png"), 5000u);
}

TEST(Section, GeojsonHasAreasInTheModelsCrs) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "plan.geojson", "--hide", "class=ClosureSurface"});
    const auto drawn = nlohmann::json::parse(readText(folder / "plan.geojson"));
    EXPECT_GT(drawn["features"].size(), 20u);
    int polygons = 0;
    for (const auto& feature : drawn["features"]) {
        if (feature["geometry"]["type"] != "MultiPolygon") continue;  // sheets
        ++polygons;
        double area = 0;
        for (const auto& polygon : feature["geometry"]["coordinates"]) {
            EXPECT_GT(ringArea(polygon[0]), 0);  // counter-clockwise
            for (const auto& ring : polygon) {
                EXPECT_EQ(ring.front(), ring.back());
                area += ringArea(ring);
            }
        }
        EXPECT_NEAR(area, feature["properties"]["area"].get<double>(), 1e-4) << feature["id"];
    }
    if (!hasProgram("ogrinfo --version")) GTEST_SKIP() << "no ogrinfo here";
    const std::string info = runShellWell(folder.path(), "ogrinfo -al -so plan.geojson");
    EXPECT_NE(info.find("Feature Count: " + std::to_string(drawn["features"].size())), std::string::npos) << info;
    EXPECT_NE(info.find("25832"), std::string::npos) << info;
    EXPECT_NE(info.find("area: Real"), std::string::npos) << info;
    // OGR's own areas.
    const std::string query = "SELECT id, area, OGR_GEOM_AREA AS g FROM \"" + drawn["name"].get<std::string>() + "\"";
    const std::string rows =
        runShellWell(folder.path(), "ogr2ogr -f CSV /vsistdout/ plan.geojson -sql '" + query + "'");
    const std::regex row(R"row(\n"?([^,"]+)"?,([0-9.]+),([0-9.]+))row");
    int count = 0;
    for (auto at = std::sregex_iterator(rows.begin(), rows.end(), row); at != std::sregex_iterator(); ++at, ++count)
        EXPECT_NEAR(std::stod((*at)[2]), std::stod((*at)[3]), 1e-3) << (*at)[1];
    EXPECT_GT(polygons, 20);
    EXPECT_GE(count, polygons) << rows;
}

TEST(Section, UprightGeojsonLiesOnThePlane) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "cut.geojson", "--plane", "0.6,0.8,0.1,-8", "--hide",
                               "class=ClosureSurface"});
    const auto drawn = nlohmann::json::parse(readText(folder / "cut.geojson"));
    const auto vectorOf = [&](const char* key, int n) { return drawn["plane"][key][n].get<double>(); };
    for (const auto& feature : drawn["features"]) {
        if (feature["geometry"]["type"] != "MultiPolygon") continue;
        for (const auto& polygon : feature["geometry"]["coordinates"])
            for (const auto& ring : polygon)
                for (const auto& p : ring) {
                    double height = 0;
                    for (int n = 0; n < 3; ++n)
                        height += vectorOf("normal", n) * (p[std::size_t(n)].get<double>() - vectorOf("origin", n));
                    ASSERT_NEAR(height, 0, 5e-6);
                }
    }
}

TEST(Section, DxfIsReadByOgr) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "plan.dxf", "-o", "plan.geojson", "--hide",
                               "class=BuildingFurniture", "--hide", "class=ClosureSurface"});
    if (!hasProgram("ogrinfo --version")) GTEST_SKIP() << "no ogrinfo here";
    runShellWell(folder.path(), "ogr2ogr -f GeoJSON dxf.json plan.dxf");
    const auto dxf = nlohmann::json::parse(readText(folder / "dxf.json"));
    const auto drawing = nlohmann::json::parse(readText(folder / "plan.geojson"));
    std::map<std::string, double> expected, found;
    for (const auto& feature : drawing["features"])
        if (feature["geometry"]["type"] == "MultiPolygon")
            expected[feature["properties"]["class"]] += feature["properties"]["area"].get<double>();
    // Hatches have the whole outlines. Polylines are open where walls of one material join.
    std::map<std::string, std::size_t> lines;
    bool hasKitchen = false, hasArea = false;
    for (const auto& feature : dxf["features"]) {
        const auto& geometry = feature["geometry"];
        const std::string layer = feature["properties"]["Layer"];
        const std::string className = layer.substr(0, layer.find('_'));  // class, function, rest
        if (geometry["type"] == "LineString") {
            ++lines[className];
        } else if (layer.ends_with("_HATCH")) {
            ASSERT_EQ(geometry["type"], "Polygon") << layer;
            found[className] += ringArea(geometry["coordinates"][0]);
            for (std::size_t hole = 1; hole < geometry["coordinates"].size(); ++hole)
                found[className] -= std::abs(ringArea(geometry["coordinates"][hole]));
        } else {
            EXPECT_EQ(layer, "TEXT");
            const std::string text = feature["properties"]["Text"];
            hasKitchen = hasKitchen || text == "Kitchen";
            hasArea = hasArea || text.ends_with(" m\u00B2");  // the code page is interpreted correctly
        }
    }
    EXPECT_TRUE(hasKitchen && hasArea);
    for (const auto& [name, area] : expected) {
        EXPECT_GT(lines[name], 0u) << name;
        if (found.contains(name)) {
            EXPECT_NEAR(found[name], area, 1e-3) << name;
        }
    }
    EXPECT_TRUE(found.contains("BuildingConstructiveElement"));
}

// The boxes of 4 x 6 x 3 m stand side by side along x.
TEST(Section, ElevationsShowTheOutsideAndSectionsWhatIsBeyond) {
    const TemporaryFolder folder;
    buildBoxes(folder.path());
    runSvtWell(folder.path(), {"section", "boxes.svt", "-o", "n.geojson", "-o", "n.svg", "--elevation", "south"});
    const auto outside = nlohmann::json::parse(readText(folder / "n.geojson"));
    EXPECT_EQ(outside["name"], "Elevation from the south");
    EXPECT_NE(readText(folder / "n.svg").find("Elevation from the south, 1:100"), std::string::npos);
    double length = 0;
    for (const auto& feature : outside["features"]) {
        EXPECT_EQ(feature["properties"]["beyond"], "visible");
        for (const auto& line : feature["geometry"]["coordinates"])
            length += std::hypot(line[0][0].get<double>() - line[1][0].get<double>(),
                                 line[0][2].get<double>() - line[1][2].get<double>());
    }
    // Outline of 8 x 3 m, and the joint of two buildings.
    EXPECT_NEAR(length, 2 * 8 + 3 * 3, 1e-3);
    // A plane through the first box alone: nothing of it is seen beyond, but for the second box.
    runSvtWell(folder.path(), {"section", "boxes.svt", "-o", "x.svg", "--plane", "x<1", "--beyond"});
    EXPECT_EQ(readText(folder / "x.svg").find("class=\"beyond"), std::string::npos);
    runSvtWell(folder.path(), {"section", "boxes.svt", "-o", "x.dxf", "-o", "x.svg", "--plane", "x<1", "--hidden"});
    EXPECT_EQ(readText(folder / "x.svg").find("class=\"beyond visible"), std::string::npos);
}

TEST(Section, PlansOfTheHouseShowWhatIsBelowAndAbove) {
    const TemporaryFolder folder;
    buildHouse(folder.path());
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "p.svg", "-o", "p.dxf", "--plane", "z=1.5", "--beyond",
                               "--hidden", "--above"});
    const std::string svg = readText(folder / "p.svg"), dxf = readText(folder / "p.dxf");
    for (const char* kind : {"visible", "hidden", "above"})
        EXPECT_NE(svg.find(std::string(" class=\"beyond ") + kind), std::string::npos) << kind;
    EXPECT_NE(svg.find("data-id=\"house_sofa"), std::string::npos);
    for (const char* layer : {"BEYOND_VISIBLE", "BEYOND_HIDDEN", "BEYOND_ABOVE", "ACAD_ISO02W100", "ACAD_ISO05W100"})
        EXPECT_NE(dxf.find(layer), std::string::npos) << layer;
    runSvtWell(folder.path(), {"section", "house.svt", "-o", "q.svg", "--plane", "z=1.5", "--beyond", "--hidden",
                               "--above", "--threads", "1"});
    EXPECT_EQ(svg, readText(folder / "q.svg"));
    if (!hasProgram("ogrinfo --version")) GTEST_SKIP() << "no ogrinfo";
    const std::string seen = runShellWell(folder.path(), "ogrinfo -q -al p.dxf");
    EXPECT_NE(seen.find("BEYOND_HIDDEN"), std::string::npos);
    EXPECT_EQ(seen.find("ERROR"), std::string::npos);
}

TEST(Section, WithoutMeshesNothingIsBeyond) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    prepare(folder.path(), {"build", "boxes.gml", "-o", "v.svt", "--spacing", "0.1", "--vectors", "none"});
    const CommandResult result = runSvt(folder.path(), {"section", "v.svt", "-o", "d.svg", "--beyond"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("E509 NoMeshes: v.svt: "), std::string::npos)
        << "the file, not its model: " << result.toString();
}

TEST(Section, ErrorsSayWhatToDo) {
    const TemporaryFolder folder;
    buildBoxes(folder.path());
    struct Case {
        std::vector<std::string> arguments;
        int exitCode;
        const char* expected;
    };
    const Case cases[] = {
        {{"-o", "d.png"}, 2, "\\.svg, \\.pdf, \\.dxf, \\.geojson"},
        {{}, 2, "nothing to write"},
        {{"-o", "d.svg", "--plane", "z=99"}, 2, "E503 BadSection.*does not meet the volume.*from"},
        {{"-o", "d.svg", "--plane", "q=1"}, 2, "E503 BadSection.*expected z=1.2"},
        {{"-o", "d.svg", "--plane", "0,0,0,1"}, 2, "normal is zero"},
        {{"-o", "d.svg", "--plane", "storey=EG+1"}, 2, "E902|storey"},
        {{"-o", "d.svg", "--scale", "1:0"}, 2, "--scale '1:0'.*1:N"},
        {{"-o", "d.svg", "--scale", "nan"}, 2, "--scale 'nan'"},
        {{"-o", "d.svg", "--hide", "all"}, 2, "E503 BadSection.*cuts no visible feature"},
        {{"-o", "d.svg", "--hide", "class="}, 2, "E901 BadQuery"},
        {{"-o", "d.svg", "--min-area", "-1"}, 2, "min-area"},
        {{"-o", "d.svg", "--elevation", "up"}, 2, "elevation"},
        {{"-o", "d.svg", "--elevation", "north", "--plane", "z=1"}, 2, "--plane and --elevation exclude each other"},
        {{"-o", "missing/d.svg"}, 5, "E404 CannotWrite"},
        {{"--table", "t.txt"}, 2, "\\.json, \\.csv"},
    };
    for (const Case& c : cases) {
        std::vector<std::string> arguments{"section", "boxes.svt"};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, c.exitCode) << result.toString();
        EXPECT_TRUE(std::regex_search(result.err, std::regex(c.expected))) << c.expected << "\n" << result.toString();
        EXPECT_FALSE(fs::exists(folder / "d.svg"));
    }
}

TEST(Section, OfNothingIsAnEmptyDrawingAndSaysSo) {
    const TemporaryFolder folder;
    buildBoxes(folder.path());
    for (const char* const file : {"d.svg", "d.dxf", "d.geojson"}) {
        const CommandResult result =
            runSvt(folder.path(), {"section", "boxes.svt", "-o", file, "--show", "class=Bilding"});
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        EXPECT_NE(result.err.find("the query 'class=Bilding' selects nothing"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find("nothing is drawn"), std::string::npos) << result.err;
        EXPECT_TRUE(fs::exists(folder / file));
    }
    // What is to be hidden and is not there hides nothing.
    const CommandResult hidden = runSvt(folder.path(), {"section", "boxes.svt", "-o", "h.svg", "--hide", "id=none"});
    EXPECT_EQ(hidden.exitCode, 0) << hidden.toString();
    EXPECT_NE(hidden.err.find("the query 'id=none' selects nothing"), std::string::npos) << hidden.err;
    EXPECT_EQ(hidden.err.find("nothing is drawn"), std::string::npos) << hidden.err;
    const CommandResult plain = runSvt(folder.path(), {"section", "boxes.svt", "-o", "p.svg"});
    EXPECT_EQ(test::readText(folder / "h.svg"), test::readText(folder / "p.svg"));
}

}  // namespace
}  // namespace svt::test
