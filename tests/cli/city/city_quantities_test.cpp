// `svt quantities` of a city: rows by building and sums by keys, with known answers.
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

class CityQuantities : public ::testing::Test {
protected:
    // 30 buildings apart from each other, and two that share a wall on the border of two tiles (x = 381 * 1024).
    void SetUp() override {
        for (int n = 0; n < 30; ++n)
            boxes.push_back({fmt::format("b{:02}", n), 388200 + 100 * n, 5820000, 10 + n % 2,
                             fmt::format(R"("attributes":{{"use":"{}"}},)", n % 2 == 0 ? "flats" : "shops")});
        boxes.push_back({"west", 390124, 5820500, 10, ""});
        boxes.push_back({"east", 390144, 5820500, 10, ""});
        std::filesystem::create_directories(folder / "files");
        writeText(folder / "files" / "a.city.jsonl", boxCity("https://www.opengis.net/def/crs/EPSG/0/25833", boxes));
        runSvtWell(folder.path(), {"city", "plan", "files", "-o", "town", "--spacing", "1", "-q"});
        runSvtWell(folder.path(), {"city", "run", "town", "-q"});
    }
    json measure(std::vector<std::string> more) {
        more.insert(more.begin(), {"quantities", "town", "--json", "-q"});
        return runSvtForJson(folder.path(), more);
    }
    static std::map<std::string, json> byId(const json& rows) {
        std::map<std::string, json> found;
        for (const json& row : rows) found[row["id"]] = row;
        return found;
    }
    std::vector<BoxBuilding> boxes;
    TemporaryFolder folder;
};

TEST_F(CityQuantities, OptionsOfModelsAreRefused) {
    const auto expectError = [&](std::vector<std::string> arguments, std::string_view text) {
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
    };
    for (const std::vector<std::string>& command : {std::vector<std::string>{"quantities", "town"},
                                                    {"query", "town", "class=Building"},
                                                    {"info", "town"},
                                                    {"render", "town", "-o", "p.png"}}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {"--spacing", "2"});
        expectError(arguments, "the tiles of this city are built already");
    }
    for (const char* option : {"--json", "--strict"}) expectError({"check", "town", option}, "the check of a city");
    expectError({"check", "town", "--report", "c.html"}, "the check of a city");
    EXPECT_EQ(runSvt(folder.path(), {"check", "town"}).exitCode, 0);
}

TEST_F(CityQuantities, HasARowPerBuilding) {
    const json report = measure({});
    ASSERT_EQ(report["rows"].size(), 32u);
    for (const auto& [id, row] : byId(report["rows"])) {
        const auto box =
            std::find_if(boxes.begin(), boxes.end(), [&, &wanted = id](const auto& b) { return b.id == wanted; });
        ASSERT_NE(box, boxes.end()) << id;
        EXPECT_NEAR(row["netVolume"].get<double>(), 400.0 * box->height, 0.01) << row;
        EXPECT_NEAR(row["topArea"].get<double>(), 400, 0.01);
        EXPECT_NEAR(row["sideArea"].get<double>(), 80.0 * box->height, 0.01) << "all sides, not one";
        EXPECT_TRUE(row["grossVolume"].is_null());
        EXPECT_EQ(row["trust"], "exact");
    }
    EXPECT_NEAR(report["total"]["netVolume"].get<double>(), 400.0 * (15 * 10 + 15 * 11 + 2 * 10), 0.1);
    EXPECT_FALSE(report["total"].contains("exterior"));
}

// The neighbour in the next tile counts: a shared wall touches no air.
TEST_F(CityQuantities, KnowsTheNeighboursInOtherTiles) {
    const json report = measure({"--exterior"});
    std::map<std::string, json> areas;
    for (const json& one : report["exterior"]) areas[one["id"]] = one;
    ASSERT_EQ(areas.size(), 32u);
    for (const char* way : {"n", "e", "s", "w"}) EXPECT_NEAR(areas["b00"][way].get<double>(), 200, 0.5) << way;
    EXPECT_NEAR(areas["b00"]["top"].get<double>(), 400, 0.5);
    // A strip of half a sample along the border of the contact may count as free.
    constexpr double kStrip = 0.5 * 2 * (20 + 10);
    EXPECT_LE(areas["west"]["e"].get<double>(), kStrip);
    EXPECT_LE(areas["east"]["w"].get<double>(), kStrip);
    EXPECT_NEAR(areas["west"]["w"].get<double>(), 200, 0.5);
    EXPECT_NEAR(areas["east"]["e"].get<double>(), 200, 0.5);
}

TEST_F(CityQuantities, SumsByKeys) {
    const json report = measure({"--by", "use", "--where", "use=flats or use=shops"});
    ASSERT_EQ(report["sums"].size(), 2u);
    EXPECT_EQ(report["sums"][0]["by"]["use"], "flats");
    EXPECT_EQ(report["sums"][0]["objects"], 15);
    EXPECT_NEAR(report["sums"][0]["netVolume"].get<double>(), 15 * 4000, 0.1);
    EXPECT_NEAR(report["sums"][1]["netVolume"].get<double>(), 15 * 4400, 0.1);
}

TEST_F(CityQuantities, WritesFiles) {
    const CommandResult csv = runSvt(folder.path(), {"quantities", "town", "-o", "rows.csv"});
    ASSERT_EQ(csv.exitCode, 0) << csv.toString();
    const std::string text = readText(folder / "rows.csv");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 33);
    EXPECT_EQ(text.substr(0, 14), "id,class,name,");
    ASSERT_EQ(runSvt(folder.path(), {"quantities", "town", "-o", "rows.json", "-q"}).exitCode, 0);
    EXPECT_EQ(json::parse(readText(folder / "rows.json"))["rows"], measure({})["rows"]);
    ASSERT_EQ(runSvt(folder.path(), {"quantities", "town", "-o", "rows.parquet", "-q"}).exitCode, 0);
    EXPECT_EQ(readText(folder / "rows.parquet").substr(0, 4), "PAR1");
    const CommandResult shown = runSvt(folder.path(), {"quantities", "town", "-q"});
    EXPECT_NE(shown.out.find("32 objects"), std::string::npos) << shown.toString();
    EXPECT_EQ(runSvt(folder.path(), {"quantities", "town", "-o", "rows.xlsx"}).exitCode, 2);
    EXPECT_EQ(runSvt(folder.path(), {"quantities", "town", "--stated"}).exitCode, 2);
    EXPECT_NE(runSvt(folder.path(), {"quantities", "town", "--where", "class="}).exitCode, 0);
}

TEST_F(CityQuantities, OfNothingHaveANote) {
    const CommandResult result = runSvt(folder.path(), {"quantities", "town", "--where", "class=Tunnel", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_TRUE(json::parse(result.out)["rows"].empty());
    EXPECT_NE(result.err.find("no objects are measured"), std::string::npos) << result.toString();
}

}  // namespace
}  // namespace svt::test
