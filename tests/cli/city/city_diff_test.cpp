// `svt diff` of two cities: only tiles that differ are compared, with known answers.
#include "../run_command.hpp"
#include "box_city.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace svt::test {
namespace {

using nlohmann::json;

constexpr const char* kUtm = "https://www.opengis.net/def/crs/EPSG/0/25833";

class CityDiff : public ::testing::Test {
protected:
    void SetUp() override {
        for (int n = 0; n < 100; ++n) boxes.push_back({fmt::format("b{:02}", n), 390000 + 40 * n, 5820000, 10, ""});
    }
    void make(const std::string& name, const std::vector<BoxBuilding>& buildings, const std::string& spacing = "1",
              const std::string& crs = kUtm) {
        std::filesystem::create_directories(folder / (name + "-files"));
        writeText(folder / (name + "-files") / "a.city.jsonl", boxCity(crs, buildings));
        runSvtWell(folder.path(), {"city", "plan", name + "-files", "-o", name, "--spacing", spacing, "-q"});
        runSvtWell(folder.path(), {"city", "run", name, "-q"});
    }
    // The rows by new id, or by the old one of removed buildings.
    std::map<std::string, json> rowsOf(const json& report) {
        std::map<std::string, json> rows;
        for (const json& row : report["rows"]) rows[row[row["new"].empty() ? "old" : "new"][0]] = row;
        return rows;
    }
    CommandResult diff(const std::vector<std::string>& more, int exitCode) {
        std::vector<std::string> words{"diff", "old", "new"};
        words.insert(words.end(), more.begin(), more.end());
        CommandResult result = runSvt(folder.path(), words);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        return result;
    }
    std::vector<BoxBuilding> boxes;
    TemporaryFolder folder;
};

TEST_F(CityDiff, EqualCitiesHaveNoDifferences) {
    make("old", boxes);
    make("new", boxes);
    const json report = json::parse(diff({"--json"}, 0).out);
    EXPECT_FALSE(report["summary"]["different"].get<bool>());
    EXPECT_TRUE(report["rows"].empty());
    EXPECT_EQ(report["summary"]["equalBuildings"], 100);
    EXPECT_EQ(report["summary"]["changedTiles"], 0);
    const CommandResult said = diff({}, 0);
    EXPECT_NE(said.out.find("no differences;"), std::string::npos) << said.toString();
    // Another order changes the bytes of tiles, and no object.
    std::filesystem::remove_all(folder / "new");
    std::reverse(boxes.begin(), boxes.end());
    make("new", boxes);
    const json other = json::parse(diff({"--json"}, 0).out);
    EXPECT_TRUE(other["rows"].empty());
    EXPECT_GT(other["summary"]["changedTiles"], 0);
}

TEST_F(CityDiff, FindsEachChangeInTheTilesThatDiffer) {
    make("old", boxes);
    boxes[5].height = 13;
    boxes[6].attributes = R"("attributes":{"roof":"flat"},)";
    boxes[8].north += 3;
    boxes[9].id = "renamed";
    boxes.push_back({"extra", 390000 + 40 * 7, 5820060, 5, ""});
    boxes.erase(boxes.begin() + 7);
    // To another tile, 2 km to the north.
    boxes.back().height = 5;
    BoxBuilding& mover = *std::find_if(boxes.begin(), boxes.end(), [](const BoxBuilding& b) { return b.id == "b50"; });
    mover.north += 2048;
    make("new", boxes);
    const json report = json::parse(diff({"--json"}, 7).out);
    const auto rows = rowsOf(report);
    EXPECT_EQ(rows.size(), 6u) << report.dump(1);
    EXPECT_EQ(rows.at("b05")["change"], "changed");
    EXPECT_NEAR(rows.at("b05")["added"].get<double>(), 3 * 400, rows.at("b05")["bound"].get<double>() + 1e-3);
    EXPECT_NEAR(rows.at("b05")["removed"].get<double>(), 0, 1e-3);
    EXPECT_EQ(rows.at("b06")["change"], "same");
    EXPECT_TRUE(rows.at("b06")["attributes"].contains("roof"));
    EXPECT_EQ(rows.at("b07")["change"], "removed");
    EXPECT_NEAR(rows.at("b07")["removed"].get<double>(), 4000, 1e-3);
    EXPECT_EQ(rows.at("b08")["change"], "moved");
    EXPECT_NEAR(rows.at("b08")["vector"][1].get<double>(), 3, 0.02);
    EXPECT_FALSE(rows.count("renamed")) << "a building that only has a new id has no row";
    EXPECT_EQ(rows.at("extra")["change"], "added");
    EXPECT_EQ(rows.at("b50")["change"], "moved") << "also from tile to tile";
    EXPECT_NEAR(rows.at("b50")["vector"][1].get<double>(), 2048, 0.02);
    const json& summary = report["summary"];
    EXPECT_EQ(summary["changes"]["moved"], 2);
    EXPECT_EQ(summary["changes"]["removed"], 1);
    EXPECT_FALSE(summary["changes"].contains("same")) << "the city has more equal objects than the tiles that differ";
    EXPECT_GT(summary["equalTiles"].get<int>(), 0);
    EXPECT_EQ(summary["apart"], 0);
    diff({"-o", "d.csv", "-o", "d.json", "-q"}, 7);
    const std::string csv = readText(folder / "d.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7) << csv;
    EXPECT_EQ(json::parse(readText(folder / "d.json")), report);
    EXPECT_EQ(diff({"--json", "--threads", "1"}, 7).out, diff({"--json", "--threads", "2"}, 7).out);
}

// A row of 100 houses moves by 300 m, so each tile gives buildings to the next one, and all tiles are connected.
TEST_F(CityDiff, FollowsBuildingsThroughManyTiles) {
    for (std::size_t n = 0; n < boxes.size(); ++n) {
        boxes[n].east = 390000 + 300 * int(n);
        boxes[n].height = 10 + int(n) % 3;
    }
    make("old", boxes);
    for (BoxBuilding& box : boxes) box.east += 300;
    boxes[40].height = 15;
    make("new", boxes);
    const json report = json::parse(diff({"--json"}, 7).out);
    EXPECT_GT(report["summary"]["apart"].get<int>(), 0);
    EXPECT_EQ(report["rows"].size(), 100u);
    for (const auto& [id, row] : rowsOf(report)) {
        EXPECT_EQ(row["old"], json::array({id}));
        EXPECT_EQ(row["new"], json::array({id}));
        EXPECT_EQ(row["change"], id == "b40" ? "changed" : "moved") << row;
        if (id != "b40") {
            ASSERT_TRUE(row["vector"].is_array()) << row;
            EXPECT_NEAR(row["vector"][0].get<double>(), 300, 0.02);
        }
    }
    EXPECT_EQ(report["summary"]["changes"]["moved"], 99);
    EXPECT_EQ(report["summary"]["changes"]["changed"], 1);
    EXPECT_EQ(report["summary"]["groups"], json::parse(R"({"added": 0, "removed": 0})"));
    EXPECT_NE(diff({}, 7).out.find("1 changed, 99 moved in "), std::string::npos);
}

TEST_F(CityDiff, RefusesWhatItCannotCompare) {
    boxes.resize(4);
    make("old", boxes);
    make("new", boxes, "0.5");
    EXPECT_NE(diff({}, 2).err.find("1 and 0.5 m between samples"), std::string::npos);
    std::filesystem::remove_all(folder / "new");
    make("new", boxes, "1", "https://www.opengis.net/def/crs/EPSG/0/25832");
    EXPECT_NE(diff({}, 2).err.find("reference systems"), std::string::npos);
    std::filesystem::remove_all(folder / "new");
    make("new", boxes);
    EXPECT_NE(diff({"-o", "d.html"}, 2).err.find("can be written as .csv and .json"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "d.html"));
    EXPECT_NE(diff({"--align", "translation"}, 2).err.find("--align"), std::string::npos);
    writeText(folder / "box.city.jsonl", boxCity(kUtm, boxes));
    const CommandResult mixed = runSvt(folder.path(), {"diff", "old", "box.city.jsonl"});
    EXPECT_EQ(mixed.exitCode, 2);
    EXPECT_NE(mixed.err.find("box.city.jsonl' is not a city"), std::string::npos) << mixed.err;
}

}  // namespace
}  // namespace svt::test
