// Sums by keys count each cubic metre once: on generated models with known volumes, and compared with sections.
#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/svt_file.hpp>
#include <tests/cli/drawings/small_ifc.hpp>
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Volumes by the values of keys, joined with '/'; '-' stands for none.
std::map<std::string, double> sumsOf(const fs::path& folder, const std::string& model, const std::string& query,
                                     const std::string& keys, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"query", model, query, "--by", keys, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::map<std::string, double> sums;
    const json rows = runSvtForJson(folder, arguments);
    for (const json& row : rows) {
        std::string name;
        for (std::size_t at = 0; at <= keys.size();) {
            const std::size_t end = std::min(keys.find(',', at), keys.size());
            const json& value = row.at(keys.substr(at, end - at));
            name += (name.empty() ? "" : "/") + (value.is_null() ? std::string("-") : value.get<std::string>());
            at = end + 1;
        }
        if (!row.at("totalVolume").is_null()) sums[name] = row.at("totalVolume").get<double>();
    }
    return sums;
}

double totalOf(const std::map<std::string, double>& sums) {
    double total = 0;
    for (const auto& [name, volume] : sums) total += volume;
    return total;
}

// The volume of the union, from the areas of exact sections: Gauss points between the heights of all corners.
double unionVolume(const fs::path& file) {
    const auto volume = volume::readSvt(file);
    EXPECT_TRUE(volume);
    std::vector<double> heights;
    for (const auto& triangle : volume->vectors.triangles)
        for (const std::uint32_t corner : triangle.corners) heights.push_back(volume->vectors.position(corner, {}).z);
    std::sort(heights.begin(), heights.end());
    double sum = 0;
    const double gauss[] = {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)};
    for (std::size_t n = 0; n + 1 < heights.size(); ++n) {
        if (heights[n + 1] - heights[n] < 1e-5) continue;
        const double half = 0.5 * (heights[n + 1] - heights[n]);
        for (const double place : gauss) {
            const double at = heights[n] + (1 + place) * half;
            const auto drawing =
                drawing::drawSection(*volume, {{0, 0, 1}, volume->grid.origin() + Vec3d{0, 0, at}}, {});
            EXPECT_TRUE(drawing);
            if (drawing) sum += half * drawing->area;
        }
    }
    return sum;
}

// Two storeys: a wall of three layers, a post through wall and slab, a room with the post in it.
SmallIfc layeredHouse() {
    SmallIfc ifc;
    const int ground = ifc.storey("EG", 0, "0."), upper = ifc.storey("OG", 3, "3.");
    const int slab = ifc.box("SLAB", "slab", ground, {0, 0, -0.3}, {6, 5, 0});
    ifc.materials(slab, {"Concrete"});
    const int wall = ifc.box("WALL", "wall", ground, {0, 0, 0}, {6, 0.3, 3});
    ifc.layers(wall, {{"Brick", 0.1}, {"Insulation", 0.05}, {"Concrete", 0.15}});
    const int post = ifc.box("COLUMN", "post", ground, {2, 0.2, -0.1}, {2.2, 0.5, 3});
    ifc.materials(post, {"Steel"});
    ifc.box("SPACE", "room", ground, {0, 0.3, 0}, {6, 5, 2.8});
    const int above = ifc.box("WALL", "wall above", upper, {0, 0, 3}, {6, 0.3, 6});
    ifc.materials(above, {"Brick"});
    return ifc;
}

TEST(Sums, CountLayersWallsAndStoreysOnce) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", layeredHouse().text());
    for (const char* spacing : {"0.1", "0.35"}) {
        const std::vector<std::string> layers{"--layers", "--spacing", spacing};
        const auto byMaterial = sumsOf(folder.path(), "house.ifc", "all", "material", layers);
        // The post has its space in slab, wall and room.
        const double post = 0.2 * 0.3 * 3.1;
        std::map<std::string, double> expected{
            {"Brick", 6 * 0.1 * 3 + 6 * 0.3 * 3},
            {"Insulation", 6 * 0.05 * 3},
            {"Concrete", 6 * 0.15 * 3 - 0.2 * 0.1 * 3 + 6 * 5 * 0.3 - 0.2 * 0.3 * 0.1},
            {"Steel", post},
            {"-", 6 * 4.7 * 2.8 - 0.2 * 0.2 * 2.8}};
        ASSERT_EQ(byMaterial.size(), expected.size());
        for (const auto& [material, volume] : expected) EXPECT_NEAR(byMaterial.at(material), volume, 1e-4) << material;
        const double all = totalOf(expected);
        const auto byStorey = sumsOf(folder.path(), "house.ifc", "all", "material,storey", layers);
        EXPECT_EQ(byStorey.count("Brick/-"), 0u) << "every component has its storey";
        EXPECT_NEAR(byStorey.at("Brick/EG"), 6 * 0.1 * 3, 1e-4);
        EXPECT_NEAR(byStorey.at("Brick/OG"), 6 * 0.3 * 3, 1e-4);
        EXPECT_NEAR(byStorey.at("-/EG"), expected["-"], 1e-4);
        EXPECT_NEAR(totalOf(byStorey), all, 1e-4 * all);
        for (const char* keys : {"class", "class,storey", "storey", "ifcType", "nothing"})
            EXPECT_NEAR(totalOf(sumsOf(folder.path(), "house.ifc", "all", keys, layers)), all, 1e-4 * all) << keys;
        // The asked level: a wall with its layers.
        const auto walls = sumsOf(folder.path(), "house.ifc", "name~wall", "name,storey", layers);
        EXPECT_NEAR(walls.at("wall/EG"), 6 * 0.3 * 3 - 0.2 * 0.1 * 3, 1e-4);
        EXPECT_EQ(walls.size(), 2u);
    }
}

TEST(Sums, SayThatGroupsCountWithTheirParts) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", layeredHouse().text());
    const CommandResult sums =
        runSvt(folder.path(), {"query", "house.ifc", "all", "--by", "class", "--json", "--spacing", "0.1"});
    EXPECT_NE(sums.err.find("features count only with their parts"), std::string::npos) << sums.err;
    for (const json& row : sums.json()) {
        EXPECT_TRUE(row["class"] != "Storey" || (row["totalVolume"].is_null() && row["area"].is_null())) << row;
        EXPECT_TRUE(row["countedVolume"].is_null() || row["countedVolume"] == 0) << row;
    }
}

// One of the buildings has rooms, whose walls and slabs are counted in voxels, but the building is a closed solid.
TEST(Sums, OfWholeBuildingsAreTheirKnownVolumes) {
    const TemporaryFolder folder;
    prepare(folder.path(),
            {"sample", "city", "--profile", "berlin", "--buildings", "300", "--files", "4", "-o", "files"});
    for (const char* vectors : {"meshes", "none"}) {
        prepare(folder.path(),
                {"build", "files/00001.gml", "-o", "town.svt", "--spacing", "0.5", "--vectors", vectors});
        const auto sums = sumsOf(folder.path(), "town.svt", "class=Building", "id");
        int withRooms = 0, exact = 0;
        for (const json& row : runSvt(folder.path(), {"query", "town.svt", "class=Building", "--json"}).json()) {
            if (row["volumeSource"] != "meshes") continue;
            const double volume = row["volume"];
            EXPECT_NEAR(sums.at(row["id"]), volume, 1e-4 * volume) << row["id"];
            ++exact;
            withRooms += std::abs(row["totalVolume"].get<double>() - volume) > 1;
        }
        EXPECT_GT(exact, 50);
        EXPECT_GT(withRooms, 0) << "the sum of parts counted in voxels is another one";
    }
}

TEST(Sums, OfExtractedBuildingsAreThoseOfTheirCity) {
    const TemporaryFolder folder;
    prepare(folder.path(),
            {"sample", "city", "--profile", "berlin", "--buildings", "300", "--files", "4", "-o", "files"});
    runSvtWell(folder.path(), {"city", "plan", "files/00001.gml", "-o", "town", "--spacing", "0.5"});
    runSvtWell(folder.path(), {"city", "run", "town"});
    int withRooms = 0;
    for (const json& row : runSvt(folder.path(), {"query", "town", "class=Building", "--json"}).json()) {
        const double volume = row["volume"];
        if (row["volumeSource"] != "meshes" || std::abs(row["totalVolume"].get<double>() - volume) < 1) continue;
        ++withRooms;
        runSvtWell(folder.path(), {"city", "extract", "town", "-o", "one.svt", "--id", row["id"]});
        const json one = runSvt(folder.path(), {"query", "one.svt", "class=Building", "--json"}).json().at(0);
        EXPECT_EQ(one["volumeSource"], "meshes");
        EXPECT_NEAR(one["volume"], volume, 1e-4 * volume);
    }
    EXPECT_GT(withRooms, 0);
}

// A window with its panes is one feature; panes that are selected without their windows count by themselves.
TEST(Sums, CountAWindowWithItsPanesOnce) {
    TemporaryFolder folder;
    prepareHouse(folder.path(), "0.15");
    const auto countsOf = [&](const std::string& query, const std::string& keys) {
        std::map<std::string, std::size_t> counts;
        const json rows = runSvtForJson(folder.path(), {"query", "house.svt", query, "--by", keys, "--json"});
        for (const json& row : rows) counts[row.at(keys).is_null() ? "-" : row.at(keys)] = row.at("features");
        return counts;
    };
    const auto numberOf = [&](const std::string& query) {
        return runSvtForJson(folder.path(), {"query", "house.svt", query, "--json"}).size();
    };
    const auto counts = countsOf("all", "class");
    EXPECT_GT(numberOf("class=WindowPhase"), 0u);
    EXPECT_EQ(counts.at("Window"), numberOf("class=Window"));
    EXPECT_EQ(counts.at("Door"), numberOf("class=Door"));
    EXPECT_FALSE(counts.contains("WindowPhase"));
    EXPECT_EQ(countsOf("class=WindowPhase", "class").at("WindowPhase"), numberOf("class=WindowPhase"));
}

TEST(Sums, OfASampleHouseAreTheVolumeOfItsUnion) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "--format", "ifc", "-o", "house.ifc"});
    prepare(folder.path(), {"build", "house.ifc", "-o", "house.svt", "--spacing", "0.2", "--layers"});
    const double expected = unionVolume(folder / "house.svt");
    for (const char* keys : {"class", "material", "material,storey"})
        EXPECT_NEAR(totalOf(sumsOf(folder.path(), "house.svt", "all", keys)), expected, 1e-4 * expected) << keys;
}

TEST(Sums, OfTheFzkHouseAreTheVolumeOfItsUnion) {
    SVT_NEEDS_DATA(model, "fzk_haus.ifc");
    const TemporaryFolder folder;
    prepare(folder.path(), {"build", model.string(), "-o", "house.svt", "--spacing", "0.1"});
    const double expected = unionVolume(folder / "house.svt");
    for (const char* keys : {"class", "material,storey"})
        EXPECT_NEAR(totalOf(sumsOf(folder.path(), "house.svt", "all", keys)), expected, 1e-4 * expected) << keys;
}

}  // namespace
}  // namespace svt::test
