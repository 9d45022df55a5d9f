// A city from files to a volume of a part of it, as a user makes it.
#include "run_command.hpp"

#include <svt/core/vec.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace svt::test {
namespace {

const Limits kLong = [] {
    Limits limits;
    limits.seconds = 120;
    return limits;
}();

class CityFolder : public ::testing::Test {
protected:
    CommandResult run(const std::vector<std::string>& arguments) { return runSvt(folder.path(), arguments, kLong); }
    void runWell(const std::vector<std::string>& arguments) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
    }
    void plan(const std::string& profile = "berlin", const std::string& city = "city") {
        runWell({"sample", "city", "--profile", profile, "--buildings", "64", "--files", "2", "-o", "files"});
        runWell({"city", "plan", "files", "-o", city, "--spacing", "1", "-q"});
    }
    TemporaryFolder folder;
};

TEST_F(CityFolder, IsPlannedRunAndExtracted) {
    plan();
    runWell({"city", "run", "city", "--jobs", "2"});
    const nlohmann::json info = runSvtForJson(folder.path(), {"city", "info", "city", "--json"});
    EXPECT_EQ(info.at("buildings"), 64);
    EXPECT_EQ(info.at("missingPacks"), 0);
    EXPECT_EQ(info.at("crs"), "EPSG:25833");
    runWell({"city", "extract", "city", "-o", "one.svt", "--id", "BLDG_0000000100000005"});
    const nlohmann::json one = runSvtForJson(folder.path(), {"info", "one.svt", "--json"});
    EXPECT_EQ(one.at("objects").at(0).at("id"), "BLDG_0000000100000005");
    for (const auto& object : one.at("objects"))
        EXPECT_TRUE(object.at("id").get<std::string>().starts_with("BLDG_0000000100000005")) << object;
    runWell(
        {"city", "extract", "city", "-o", "coarse.svt", "--detail", "1", "--box=384000,5811000,0,386000,5813000,500"});
    runWell({"render", "coarse.svt", "-o", "town.png", "--size", "160,120"});
    const nlohmann::json status = runSvtForJson(folder.path(), {"city", "status", "city", "--json", "--proven"});
    EXPECT_TRUE(status.at("missing").empty());
}

TEST_F(CityFolder, HasTheSameBytesHoweverItsTasksAreRun) {
    for (const std::string profile : {"berlin", "3dbag"}) {
        plan(profile, profile);
        runWell({"city", "run", profile, "--jobs", "3"});
        const auto read = [&](const char* name) { return readText(folder / profile / name); };
        const std::string pack = read("packs/00000.svtp"), index = read("index.bin"), ids = read("ids.bin"),
                          words = read("words.bin"), catalog = read("city.json");
        std::filesystem::remove_all(folder / profile / "packs");
        runWell({"city", "task", profile, "0", "--of", "1", "--threads", "2"});
        runWell({"city", "merge", profile});
        EXPECT_EQ(read("packs/00000.svtp"), pack);
        EXPECT_EQ(read("index.bin"), index);
        EXPECT_EQ(read("ids.bin"), ids);
        EXPECT_EQ(read("words.bin"), words);
        EXPECT_EQ(read("city.json"), catalog);
    }
}

TEST_F(CityFolder, BecomesTilesWithAFeatureForEachBuilding) {
    plan();
    runWell({"city", "run", "city", "-q"});
    runWell({"convert", "city", "city.3dtiles", "--threads", "1"});
    const auto tiles = nlohmann::json::parse(readText(folder / "city.3dtiles/tileset.json"));
    EXPECT_EQ(tiles.at("asset").at("version"), "1.1");
    const auto& root = tiles.at("root");
    EXPECT_EQ(root.at("implicitTiling").at("subdivisionScheme"), "QUADTREE");
    EXPECT_TRUE(std::filesystem::exists(folder / "city.3dtiles/subtrees/0/0/0.subtree"));
    // The frame is at the middle of the root, which stands on the corner that is told. By cs2cs, of the corner at
    // 384000, 5811200 and 2048 m: echo 385024 5812224 34 | cs2cs EPSG:25833 EPSG:4978
    const auto& corner = tiles.at("asset").at("extras").at("origin");
    const double side = 2 * root.at("boundingVolume").at("box")[3].get<double>();
    const Vec3d middle{corner[0].get<double>() + side / 2, corner[1].get<double>() + side / 2, 0};
    EXPECT_EQ(std::fmod(corner[0].get<double>(), 1024), 0);
    EXPECT_GE(side, 1024);
    EXPECT_LT(std::hypot(middle.x - 385024, middle.y - 5812224), 3000);
    // The same bytes for any number of threads.
    runWell({"convert", "city", "again.3dtiles", "--threads", "3"});
    std::size_t count = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder / "city.3dtiles")) {
        if (!file.is_regular_file() || file.path().extension() == ".json") continue;
        ++count;
        const auto same = folder / "again.3dtiles" / std::filesystem::relative(file, folder / "city.3dtiles");
        EXPECT_EQ(readText(file.path()), readText(same)) << same;
    }
    EXPECT_GE(count, 2u);
    // What is there is kept; what is for volumes is refused, and so is what a city does not become.
    EXPECT_EQ(run({"convert", "city", "city.3dtiles"}).exitCode, 5);
    EXPECT_EQ(run({"convert", "city", "x.3dtiles", "--voxels"}).exitCode, 2);
    EXPECT_EQ(run({"convert", "city", "x.3dtiles", "--select", "class=Building"}).exitCode, 2);
    EXPECT_EQ(run({"convert", "city", "x.obj"}).exitCode, 2);
    EXPECT_EQ(run({"convert", "city", "x.contacts.csv"}).exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "x.3dtiles"));
    // At a given place, and of detail 1 as the finest.
    runWell({"convert", "city", "one.3dtiles", "--level", "1", "--place", "49.1,8.44,110"});
    std::string said;
    if (!isRun(folder.path(), nodeOf("city_tiles.mjs") + "city.3dtiles 64", said)) GTEST_SKIP() << said;
    (void)isRun(folder.path(), nodeOf("city_tiles.mjs") + "one.3dtiles 64", said);
}

TEST_F(CityFolder, IsShownByCesium) {
    plan();
    runWell({"city", "run", "city", "-q"});
    runWell({"convert", "city", "city.3dtiles"});
    std::string said;
    const auto tiles = nlohmann::json::parse(readText(folder / "city.3dtiles/tileset.json"));
    const auto& box = tiles.at("root").at("boundingVolume").at("box");
    const auto& corner = tiles.at("asset").at("extras").at("origin");
    const std::string place = std::to_string(corner[0].get<double>() + box[3].get<double>()) + " " +
                              std::to_string(corner[1].get<double>() + box[7].get<double>()) + " " +
                              std::to_string(corner[2].get<double>() + box[2].get<double>());
    const ShellResult degrees = runShell(folder.path(), "echo " + place + " | cs2cs -f %.8f EPSG:25833 EPSG:4979");
    if (degrees.exitCode != 0) GTEST_SKIP() << "cs2cs is not there";
    std::istringstream numbers(degrees.text);
    std::string latitude, longitude, height;
    numbers >> latitude >> longitude >> height;
    if (!isRun(folder.path(),
               nodeOf("cesium.mjs") + "city.3dtiles " + longitude + " " + latitude + " " + height + " Building", said))
        GTEST_SKIP() << said;
}

TEST_F(CityFolder, BecomesTablesForGis) {
    plan();
    runWell({"city", "run", "city", "-q"});
    for (const char* file : {"b.geojson", "b.gpkg", "b.parquet", "b.csv"}) runWell({"convert", "city", file});
    const auto features = nlohmann::json::parse(readText(folder / "b.geojson")).at("features");
    ASSERT_EQ(features.size(), 64u);
    for (const auto& feature : features) {
        const auto& properties = feature.at("properties");
        EXPECT_EQ(properties.at("class"), "Building");
        EXPECT_GT(properties.at("volume").get<double>(), 0);
        EXPECT_GT(properties.at("height").get<double>(), 0);
        EXPECT_TRUE(properties.contains("function")) << properties;
        // Some buildings have parts that stand apart.
        EXPECT_NE(feature.at("geometry").at("type").get<std::string>().find("Polygon"), std::string::npos);
        EXPECT_NE(properties.at("footprint"), "voxels") << "tiles keep the faces of footprints";
    }
    EXPECT_EQ(readText(folder / "b.parquet").substr(0, 4), "PAR1");
    // svt query has the same rows, also of one volume.
    runWell({"query", "city", "class=Building", "-o", "q.parquet"});
    EXPECT_EQ(readText(folder / "q.parquet"), readText(folder / "b.parquet"));
    runWell({"city", "extract", "city", "-o", "one.svt", "--id", "BLDG_0000000100000005"});
    runWell({"convert", "one.svt", "one.geojson", "--select", "class=Building"});
    EXPECT_EQ(nlohmann::json::parse(readText(folder / "one.geojson")).at("features").size(), 1u);
    const ShellResult layers = runShell(folder.path(), "ogrinfo -so b.gpkg features");
    if (layers.exitCode == 0) {
        EXPECT_NE(layers.text.find("Feature Count: 64"), std::string::npos);
    }
    std::string said;
    if (!isRun(folder.path(), nodeOf("geoparquet.mjs") + "b.parquet b.geojson 25833", said)) GTEST_SKIP() << said;
}

// What the city holds of a building is what `svt build` makes of the file on the same grid.
TEST_F(CityFolder, IsSearchedByWords) {
    plan("berlin", "town");
    runWell({"city", "run", "town"});
    const auto jsonOf = [&](const std::vector<std::string>& arguments) {
        return runSvtForJson(folder.path(), arguments);
    };
    const auto json = jsonOf({"city", "find", "town", "roofType=1000", "--json"});
    const auto count = json.at("count").get<std::size_t>();
    EXPECT_GT(count, 0u);
    EXPECT_EQ(json.at("buildings").size(), std::min<std::size_t>(count, 100));
    // `svt query` reads every tile, without the index.
    const auto rows = jsonOf({"query", "town", "roofType=1000", "--json"});
    std::set<std::string> ids;
    for (const auto& row : rows) ids.insert(row.at("id").get<std::string>());
    EXPECT_EQ(ids.size(), count);
    for (const auto& building : json.at("buildings")) EXPECT_TRUE(ids.contains(building.at("id"))) << building;
    const CommandResult few = run({"city", "find", "town", "class=building", "rooftype=1", "--most", "2"});
    EXPECT_NE(few.err.find("the first 2 are listed"), std::string::npos) << few.err;
    EXPECT_EQ(run({"city", "find", "town", "..."}).exitCode, 2);
    EXPECT_EQ(jsonOf({"city", "find", "town", "nobody", "--json"}).at("count"), 0);
    // As the shell passes name="Sample house" house.
    runWell({"sample", "house", "-o", "house.gml"});
    runWell({"city", "plan", "house.gml", "-o", "one", "--spacing", "1", "-q"});
    runWell({"city", "run", "one"});
    EXPECT_EQ(jsonOf({"city", "find", "one", "name=Sample house", "function=res", "--json"}).at("count"), 1);
    EXPECT_EQ(jsonOf({"city", "find", "one", "name=\"Sample house\" gable", "--json"}).at("count"), 1);
    EXPECT_EQ(jsonOf({"city", "find", "one", "name=Sample", "house", "--json"}).at("count"), 0) << "not the whole name";
}

TEST_F(CityFolder, HasTheVoxelsOfTheWholeModel) {
    runWell({"sample", "city", "--profile", "3dbag", "--buildings", "64", "-o", "files"});
    runWell({"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
    runWell({"city", "run", "city", "-q"});
    runWell({"city", "extract", "city", "-o", "all.svt", "--box=0,0,-100,1e6,1e6,1000"});
    runWell({"build", "files/00000.city.jsonl", "-o", "whole.svt", "--grid-of", "all.svt", "-q"});
    const auto voxels = [&](const char* name) {
        std::map<std::string, std::uint64_t> result;
        const nlohmann::json info = runSvtForJson(folder.path(), {"info", name, "--json"});
        for (const auto& object : info.at("objects")) result[object.at("id")] = object.at("voxels");
        return result;
    };
    const auto city = voxels("all.svt");
    EXPECT_GT(city.size(), 64u);
    EXPECT_EQ(city, voxels("whole.svt"));
}

TEST_F(CityFolder, SaysWhatIsMissingAndGoesOn) {
    plan();
    CommandResult result = run({"city", "merge", "city"});
    EXPECT_EQ(result.exitCode, 3) << result.toString();
    EXPECT_NE(result.err.find("E605 CityIncomplete"), std::string::npos) << result.toString();
    result = run({"city", "status", "city"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.out.find("svt city run city"), std::string::npos) << result.toString();
    result = run({"city", "info", "city"});
    EXPECT_NE(result.err.find("E604 BadCity"), std::string::npos) << result.toString();
    runWell({"city", "run", "city"});
    std::filesystem::resize_file(folder / "city/packs/00000.svtp", 1000);
    result = run({"city", "extract", "city", "-o", "x.svt", "--id", "BLDG_0000000100000005"});
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.err.find("E603 BadPack"), std::string::npos) << result.toString();
    EXPECT_FALSE(std::filesystem::exists(folder / "x.svt"));
    runWell({"city", "run", "city"});
    runWell({"city", "extract", "city", "-o", "x.svt", "--id", "BLDG_0000000100000005"});
}

// A district more, a building changed, a district less: the bytes of a new plan of everything, and few packs built.
TEST_F(CityFolder, IsUpdated) {
    runWell({"sample", "city", "--buildings", "600", "--files", "6", "-o", "all", "-q"});
    const auto file = [](int n) { return "all/0000" + std::to_string(n) + ".gml"; };
    const auto planOf = [&](const std::string& city, int files, bool isUpdate) {
        std::vector<std::string> arguments{"city", "plan", "-o", city, "--spacing", "1", "--pack-seconds", "0.05"};
        if (isUpdate) arguments.emplace_back("--update");
        for (int n = 0; n < files; ++n) arguments.push_back(file(n));
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        return result.out;
    };
    const auto expectSame = [&](int files) {
        std::filesystem::remove_all(folder / "new");
        planOf("new", files, false);
        runWell({"city", "run", "new", "-q"});
        for (const char* name : {"plan/plan.json", "city.json", "index.bin", "ids.bin", "words.bin", "packs.bin"})
            EXPECT_EQ(readText(folder / "city" / name), readText(folder / "new" / name)) << name;
        std::size_t packs = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "city/packs")) {
            EXPECT_EQ(readText(entry.path()), readText(folder / "new/packs" / entry.path().filename()));
            ++packs;
        }
        EXPECT_GT(packs, 3u);
    };
    EXPECT_EQ(run({"city", "plan", file(0), "-o", "city", "--update"}).exitCode, 3);
    planOf("city", 4, false);
    runWell({"city", "run", "city", "-q"});
    EXPECT_NE(planOf("city", 4, true).find("0 features are new, 0 changed, 0 gone"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "city/city.json"));
    EXPECT_NE(planOf("city", 6, true).find("200 features are new, 0 changed, 0 gone"), std::string::npos);
    // The city before the update stays readable until all packs are done.
    const auto buildings = [&] {
        return runSvtForJson(folder.path(), {"city", "info", "city", "--json"}).at("buildings");
    };
    EXPECT_EQ(buildings(), 400);
    runWell({"city", "extract", "city", "-o", "before.svt", "--id", "BLDG_0000000100000005"});
    const nlohmann::json status = runSvtForJson(folder.path(), {"city", "status", "city", "--json"});
    EXPECT_FALSE(status.at("missing").empty());
    EXPECT_LT(status.at("missing").size(), status.at("packs").get<std::size_t>());
    EXPECT_EQ(status.at("isUpdate"), true);
    EXPECT_EQ(run({"city", "merge", "city"}).exitCode, 3) << "E605";
    EXPECT_EQ(buildings(), 400);
    const int oneTask = static_cast<int>(status.at("missing").at(0).get<std::uint32_t>());
    runWell(
        {"city", "task", "city", std::to_string(oneTask), "--of", std::to_string(status.at("packs").get<int>()), "-q"});
    EXPECT_EQ(buildings(), 400);
    runWell({"city", "run", "city", "-q"});
    EXPECT_EQ(buildings(), 600);
    EXPECT_FALSE(std::filesystem::exists(folder / "city/update"));
    expectSame(6);
    std::string text = readText(folder / file(2));
    const std::size_t at = text.find("<bldg:measuredHeight");
    ASSERT_NE(at, std::string::npos);
    text.insert(text.find('>', at) + 1, "1");
    writeText(folder / file(2), text);
    EXPECT_NE(planOf("city", 6, true).find("0 features are new, 1 changed, 0 gone; 0 tiles are new, 1 changed, 0 gone"),
              std::string::npos);
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "status", "city", "--json"}).at("missing").size(), 1u);
    runWell({"city", "run", "city", "-q"});
    expectSame(6);
    EXPECT_NE(planOf("city", 3, true).find("0 features are new, 0 changed, 344 gone"), std::string::npos);
    // An update of an update that was never built.
    planOf("city", 4, true);
    planOf("city", 3, true);
    runWell({"city", "run", "city", "-q"});
    expectSame(3);
}

// A box as a building of CityJSON; x and y of its lower corner.
std::string boxOfCityJson(const std::string& id, int x, int y) {
    std::string corners;
    for (const int z : {0, 10})
        for (const auto& [i, j] : {std::pair{0, 0}, {20, 0}, {20, 20}, {0, 20}})
            corners += (corners.empty() ? "[" : ",[") + std::to_string(x + i) + "," + std::to_string(y + j) + "," +
                       std::to_string(z) + "]";
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
           R"(":{"type":"Building","geometry":[{"type":"Solid","lod":"1","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],)" +
           R"([[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}},"vertices":[)" + corners + "]}\n";
}

// Two boxes share 2 x 20 x 10 m in a tile, two others 4 x 20 x 10 m over the border at 1024 m.
TEST_F(CityFolder, FindsWhatTwoBuildingsClaim) {
    std::string text = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},)"
                       R"("CityObjects":{},"vertices":[]})"
                       "\n";
    text += boxOfCityJson("west", 1002, 100) + boxOfCityJson("east", 1018, 100);
    text += boxOfCityJson("first", 100, 100) + boxOfCityJson("second", 118, 100) + boxOfCityJson("alone", 200, 100);
    std::filesystem::create_directories(folder / "files");
    writeText(folder / "files/a.city.jsonl", text);
    runWell({"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
    runWell({"city", "run", "city", "-q"});
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "info", "city", "--json"}).at("tiles"), 2);
    const auto pairs = [&](const std::string& query) {
        std::map<std::string, double> found;
        for (const auto& row : runSvtForJson(folder.path(), {"query", "city", query, "--overlaps", "--json"})) {
            const std::string a = row.at("a"), b = row.at("b");
            found[std::min(a, b) + " " + std::max(a, b)] = row.at("volume");
        }
        return found;
    };
    using Found = std::map<std::string, double>;
    EXPECT_EQ(pairs("class=Building"), (Found{{"east west", 800}, {"first second", 400}}));
    EXPECT_EQ(pairs("id=east"), (Found{{"east west", 800}}));
    EXPECT_EQ(pairs("id=alone"), Found{});
    // Of solids without holes none leaks.
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "city", "all", "--leaks", "--json"}).size(), 0u);
}

TEST_F(CityFolder, RefusesWhatMakesNoSense) {
    plan();
    runWell({"city", "run", "city"});
    const auto expect = [&](const std::vector<std::string>& arguments, int exitCode, std::string_view message) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(message), std::string::npos) << message << ": " << result.toString();
    };
    expect({"city", "extract", "city", "-o", "x.svt"}, 2, "--tile, --box or --id");
    expect({"city", "extract", "city", "-o", "x.svt", "--tile", "9/1"}, 2, "LEVEL/X/Y");
    expect({"city", "extract", "city", "-o", "x.svt", "--tile", "9/1/1"}, 2, "E902");
    expect({"city", "extract", "city", "-o", "x.svt", "--id", "nobody"}, 2, "E902");
    expect({"city", "extract", "city", "-o", "x.svt", "--box=3,0,0,2,1,1"}, 2, "--box");
    expect({"city", "extract", "city", "-o", "x.svt", "--detail", "9", "--box=0,0,0,1,1,1"}, 2, "E904");
    expect({"city", "extract", "city", "-o", "x.svt", "--detail", "2", "--id", "x"}, 2, "E904");
    expect({"city", "run", "city", "--print"}, 2, "E904");
    expect({"city", "run", "city", "--engine", "kubernetes"}, 2, "--print");
    expect({"city", "task", "city", "7"}, 2, "E904");
    expect({"city", "plan", "files", "-o", "files", "--spacing", "1"}, 5, "E408");
    expect({"city", "plan", "nowhere", "-o", "other"}, 3, "E101");
    expect({"city", "run", "files"}, 3, "E601 BadPlan");
    expect({"sample", "city", "--buildings", "20", "--files", "3", "-o", "more"}, 2, "E904");
    expect({"city"}, 2, "svt city plan");
    expect({"city", "plans"}, 2, "svt city plan");
}

// The folder of a city as the input of other commands: the same answers as from all of it in one volume.
class CityInput : public ::testing::Test {
protected:
    void SetUp() override {
        runWell({"sample", "city", "--profile", "berlin", "--buildings", "64", "--files", "2", "-o", "files"});
        runWell({"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
        runWell({"city", "run", "city", "-q"});
        runWell({"city", "extract", "city", "-o", "all.svt", "--box=0,0,-1000,1e6,1e7,1000"});
    }
    CommandResult run(const std::vector<std::string>& arguments) { return runSvt(folder.path(), arguments, kLong); }
    std::string runWell(const std::vector<std::string>& arguments) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        return result.out;
    }
    std::vector<std::string> sortedLines(const char* name) {
        std::vector<std::string> lines;
        std::istringstream text(readText(folder / name));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        std::sort(lines.begin(), lines.end());
        return lines;
    }
    TemporaryFolder folder;
};

TEST_F(CityInput, AnswersQueriesAsOneVolume) {
    EXPECT_EQ(runSvtForJson(folder.path(), {"info", "city", "--json"}).at("buildings"), 64);
    runWell({"query", "city", "class=Building", "-o", "tiles.csv", "-q"});
    runWell({"query", "all.svt", "class=Building", "-o", "whole.csv", "-q"});
    const std::vector<std::string> tiles = sortedLines("tiles.csv"), whole = sortedLines("whole.csv");
    ASSERT_EQ(tiles.size(), 65u);
    ASSERT_EQ(whole.size(), 65u);
    std::size_t equal = 0;
    for (std::size_t n = 0; n < 65; ++n) {
        // Up to the m2 all is the same. Of samples that buildings of two tiles fill, one of them has each in one volume.
        const auto head = [](const std::string& line) {
            std::size_t end = 0;
            for (int comma = 0; comma < 4; ++comma) end = line.find(',', end) + 1;
            return line.substr(0, end);
        };
        EXPECT_EQ(head(tiles[n]), head(whole[n]));
        equal += tiles[n] == whole[n];
    }
    EXPECT_GE(equal, 60u);
    runWell({"convert", "city", "converted.csv", "-q"});
    EXPECT_EQ(tiles, sortedLines("converted.csv"));

    const auto jsonOf = [&](const std::vector<std::string>& arguments) {
        return runSvtForJson(folder.path(), arguments);
    };
    const auto largest = jsonOf({"query", "city", "class=Building", "--sort", "height", "--first", "5", "--json"});
    ASSERT_EQ(largest.size(), 5u);
    const auto same = jsonOf({"query", "all.svt", "class=Building", "--sort", "height", "--first", "5", "--json"});
    for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(largest[n].at("id"), same[n].at("id"));
    for (std::size_t n = 1; n < 5; ++n) EXPECT_GE(largest[n - 1].at("height"), largest[n].at("height"));

    // What a plane cuts is what reaches over it.
    const double middle = (largest[4].at("lowest").get<double>() + largest[4].at("highest").get<double>()) / 2 + 0.25;
    const std::string plane = "z=abs(" + std::to_string(middle) + ")";
    std::size_t expected = 0;
    const auto all = jsonOf({"query", "city", "class=Building", "--json"});
    ASSERT_EQ(all.size(), 64u);
    for (const auto& row : all) expected += row.at("lowest") < middle && row.at("highest") > middle;
    EXPECT_GT(expected, 0u);
    EXPECT_EQ(jsonOf({"query", "city", "class=Building", "--cut", plane, "--json"}).size(), expected);

    double volume = 0, sum = 0;
    for (const auto& row : all) volume += row.at("volume").get<double>();
    std::size_t count = 0;
    for (const auto& row : jsonOf({"query", "city", "class=Building", "--by", "roofType", "--json"})) {
        sum += row.at("volume").get<double>();
        count += row.at("features").get<std::size_t>();
    }
    EXPECT_EQ(count, 64u);
    EXPECT_NEAR(sum, volume, 1e-6 * volume);
}

// The footprints are exact: they do not depend on the spacing of the tiles.
TEST_F(CityInput, WritesFootprintsThatHaveTheArea) {
    runWell({"query", "city", "class=Building", "-o", "b.geojson", "-q"});
    std::vector<std::string> build{"build", "-o", "exact.svt", "--spacing", "2"};
    for (const auto& file : std::filesystem::directory_iterator(folder / "files"))
        build.push_back(file.path().string());
    runWell(build);
    runWell({"query", "exact.svt", "class=Building", "-o", "exact.geojson", "-q"});
    std::map<std::string, double> exact;
    const nlohmann::json whole = nlohmann::json::parse(readText(folder / "exact.geojson"));
    for (const auto& feature : whole.at("features"))
        exact[feature.at("properties").at("id")] = feature.at("properties").at("area");
    const nlohmann::json layer = nlohmann::json::parse(readText(folder / "b.geojson"));
    EXPECT_EQ(layer.at("crs").at("properties").at("name"), "urn:ogc:def:crs:EPSG::25833");
    ASSERT_EQ(layer.at("features").size(), 64u);
    for (const auto& feature : layer.at("features")) {
        const auto& geometry = feature.at("geometry");
        std::vector<nlohmann::json> rings;
        for (const auto& part : geometry.at("coordinates"))
            if (geometry.at("type") == "Polygon")
                rings.push_back(part);
            else
                rings.insert(rings.end(), part.begin(), part.end());
        double sum = 0;
        for (const auto& ring : rings) {
            ASSERT_GE(ring.size(), 4u);
            EXPECT_EQ(ring.front(), ring.back());
            for (std::size_t n = 1; n < ring.size(); ++n)
                sum += ((ring[n - 1][0].get<double>() - ring[0][0].get<double>()) *
                            (ring[n][1].get<double>() - ring[0][1].get<double>()) -
                        (ring[n][0].get<double>() - ring[0][0].get<double>()) *
                            (ring[n - 1][1].get<double>() - ring[0][1].get<double>())) /
                       2;
        }
        const double area = feature.at("properties").at("area");
        const std::string id = feature.at("properties").at("id");
        EXPECT_NEAR(sum, area, 1e-6 * area) << id;
        EXPECT_NEAR(exact.at(id), area, 1e-6 * area) << id;
    }
    runWell({"query", "city", "class=Building", "-o", "b.gpkg", "-q"});
    EXPECT_TRUE(readText(folder / "b.gpkg").starts_with("SQLite format 3"));
}

TEST_F(CityInput, IsCutWithoutSeams) {
    const nlohmann::json tiles = runSvtForJson(folder.path(), {"section", "city", "--plane", "z=abs(40)", "--json"});
    const nlohmann::json whole = runSvtForJson(folder.path(), {"section", "all.svt", "--plane", "z=abs(40)", "--json"});
    EXPECT_GT(whole.at("area").get<double>(), 100);
    EXPECT_NEAR(tiles.at("area").get<double>(), whole.at("area").get<double>(), 0.002 * whole.at("area").get<double>());
    EXPECT_NE(run({"section", "city", "-o", "x.svg"}).exitCode, 0) << "no plane";
    EXPECT_NE(run({"section", "city", "-o", "x.svg", "--elevation", "south"}).exitCode, 0);
}

TEST_F(CityInput, IsDrawnFromAnywhere) {
    runWell({"render", "city", "-o", "far.png", "--size", "160x120"});
    runWell({"render", "city", "-o", "near.png", "--size", "160x120", "--around", "id=BLDG_0000000100000005"});
    runWell({"render", "city", "-o", "shell.png", "--size", "160x120", "--shell", "building"});
    runWell({"render", "city", "-o", "sun.png", "--size", "160x120", "--sun", "2026-06-21 15:00"});
    runWell({"render", "city", "-o", "lens.png", "--size", "160x120", "--lens", "view(0.5,0.5,0.35)", "--section",
             "z=abs(40)"});
    // In detail 3 and coarser there are mixtures; they take the colours of the style, and are hidden with their classes.
    const std::vector<std::string> whole{"render", "city", "--size", "40x30", "--samples", "1"};
    const auto draw = [&](const char* name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = whole;
        arguments.insert(arguments.end(), {"-o", name});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        return result.toString();
    };
    draw("plain.png", {});
    draw("blue.png", {"--color", "class=RoofSurface:#0000ff"});
    EXPECT_NE(readText(folder / "plain.png"), readText(folder / "blue.png"));
    EXPECT_NE(draw("hidden.png", {"--hide", "class~'Building|Surface|Window|Door|Closure|Installation'"})
                  .find("nothing is visible"),
              std::string::npos);
    runWell({"render", "city", "-o", "again.png", "--size", "160x120", "--threads", "1"});
    EXPECT_EQ(readText(folder / "far.png"), readText(folder / "again.png")) << "for any number of threads";
    EXPECT_NE(readText(folder / "far.png"), readText(folder / "near.png"));
    const CommandResult refused = run({"render", "city", "-o", "x.png", "--explode", "3"});
    EXPECT_EQ(refused.exitCode, 2) << refused.toString();
}

TEST_F(CityInput, IsCheckedTileByTile) {
    EXPECT_NE(runWell({"check", "city"}).find("0 are damaged; 64 buildings"), std::string::npos);
    std::string pack = readText(folder / "city/packs/00000.svtp");
    for (std::size_t at = 200; at < 300; ++at) pack[at] ^= 0x55;
    writeText(folder / "city/packs/00000.svtp", pack);
    const CommandResult damaged = run({"check", "city"});
    EXPECT_EQ(damaged.exitCode, 4) << damaged.toString();
    EXPECT_NE(damaged.toString().find("E603"), std::string::npos) << damaged.toString();
}

}  // namespace
}  // namespace svt::test
