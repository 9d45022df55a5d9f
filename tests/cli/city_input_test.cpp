// The folder of a city as the input of other commands: the same answers as from all of it in one volume.
#include "run_command.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace svt::test {
namespace {

const Limits kLong = [] {
    Limits limits;
    limits.seconds = 120;
    return limits;
}();

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

    const auto json = [&](const std::vector<std::string>& arguments) {
        return runSvtForJson(folder.path(), arguments);
    };
    const auto largest = json({"query", "city", "class=Building", "--sort", "height", "--first", "5", "--json"});
    ASSERT_EQ(largest.size(), 5u);
    const auto same = json({"query", "all.svt", "class=Building", "--sort", "height", "--first", "5", "--json"});
    for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(largest[n].at("id"), same[n].at("id"));
    for (std::size_t n = 1; n < 5; ++n) EXPECT_GE(largest[n - 1].at("height"), largest[n].at("height"));

    // What a plane cuts is what reaches over it.
    const double middle = (largest[4].at("lowest").get<double>() + largest[4].at("highest").get<double>()) / 2 + 0.25;
    const std::string plane = "z=abs(" + std::to_string(middle) + ")";
    std::size_t expected = 0;
    const auto all = json({"query", "city", "class=Building", "--json"});
    ASSERT_EQ(all.size(), 64u);
    for (const auto& row : all) expected += row.at("lowest") < middle && row.at("highest") > middle;
    EXPECT_GT(expected, 0u);
    EXPECT_EQ(json({"query", "city", "class=Building", "--cut", plane, "--json"}).size(), expected);

    double volume = 0, sum = 0;
    for (const auto& row : all) volume += row.at("volume").get<double>();
    std::size_t count = 0;
    for (const auto& row : json({"query", "city", "class=Building", "--by", "roofType", "--json"})) {
        sum += row.at("volume").get<double>();
        count += row.at("features").get<std::size_t>();
    }
    EXPECT_EQ(count, 64u);
    EXPECT_NEAR(sum, volume, 1e-6 * volume);
}

TEST_F(CityInput, WritesOutlinesThatHaveTheArea) {
    runWell({"query", "city", "class=Building", "-o", "b.geojson", "-q"});
    const nlohmann::json layer = nlohmann::json::parse(readText(folder / "b.geojson"));
    EXPECT_EQ(layer.at("crs").at("properties").at("name"), "urn:ogc:def:crs:EPSG::25833");
    ASSERT_EQ(layer.at("features").size(), 64u);
    for (const auto& feature : layer.at("features")) {
        const auto& ring = feature.at("geometry").at("coordinates").at(0);
        ASSERT_GE(ring.size(), 4u);
        EXPECT_EQ(ring.front(), ring.back());
        double twice = 0;
        for (std::size_t n = 1; n < ring.size(); ++n)
            twice += (ring[n - 1][0].get<double>() - ring[0][0].get<double>()) *
                         (ring[n][1].get<double>() - ring[0][1].get<double>()) -
                     (ring[n][0].get<double>() - ring[0][0].get<double>()) *
                         (ring[n - 1][1].get<double>() - ring[0][1].get<double>());
        const double area = feature.at("properties").at("area");
        EXPECT_GE(twice / 2, area - 1e-6) << feature.at("properties").at("id") << ": a hull holds what it is around";
        EXPECT_LE(twice / 2, 3 * area + 10);
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
