// Cities of files with other reference systems, dates and ids than expected, and of files that change.
#include "../run_command.hpp"
#include "box_city.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace svt::test {
namespace {

// Boxes in a row from `east` on, the ids `name` and a number.
std::string boxesOf(const std::string& crs, const std::string& name, int count, int east, int north,
                    const std::string& attributes = "") {
    std::vector<BoxBuilding> buildings;
    for (int n = 0; n < count; ++n)
        buildings.push_back({fmt::format("{}{}", name, n), east + 40 * n, north, 10, attributes});
    return boxCity(crs, buildings);
}

class CitySources : public ::testing::Test {
protected:
    CommandResult run(const std::vector<std::string>& arguments) { return runSvt(folder.path(), arguments); }
    CommandResult plan(std::vector<std::string> rest = {}) {
        std::vector<std::string> arguments{"city", "plan", "files", "-o", "town", "--spacing", "1"};
        arguments.insert(arguments.end(), rest.begin(), rest.end());
        return run(arguments);
    }
    void write(const std::string& name, const std::string& text) {
        std::filesystem::create_directories(folder / "files");
        writeText(folder / "files" / name, text);
    }
    std::string crsOfPlan() { return nlohmann::json::parse(readText(folder / "town/plan/plan.json")).at("crsName"); }
    TemporaryFolder folder;
};

constexpr const char* kDutch = "https://www.opengis.net/def/crs/EPSG/0/28992";
constexpr const char* kDutchCompound = "https://www.opengis.net/def/crs/EPSG/0/7415";

// The horizontal part of a compound that comes first is the CRS of the city.
TEST_F(CitySources, ACompoundCrsKeepsFilesOfItsHorizontalPart) {
    write("a.city.jsonl", boxesOf(kDutchCompound, "a", 4, 121000, 487000));
    write("b.city.jsonl", boxesOf(kDutch, "b", 8, 121500, 487000));
    const CommandResult planned = plan();
    EXPECT_EQ(planned.exitCode, 0) << planned.toString();
    EXPECT_NE(planned.out.find("12 features"), std::string::npos) << planned.toString();
    EXPECT_NE(planned.out.find(" 0 left out"), std::string::npos) << planned.toString();
    const auto written = nlohmann::json::parse(readText(folder / "town/plan/plan.json"));
    EXPECT_EQ(written.at("crs"), 28992);
}

TEST_F(CitySources, TheGivenCrsStays) {
    write("a.city.jsonl", boxesOf(kDutch, "a", 3, 121000, 487000));
    for (const std::string crs : {"EPSG:28992", "EPSG:7415", "RD New"}) {
        const CommandResult planned = plan({"--crs", crs});
        ASSERT_EQ(planned.exitCode, 0) << planned.toString();
        EXPECT_EQ(crsOfPlan(), kDutch) << crs;
        std::filesystem::remove_all(folder / "town");
    }
    const CommandResult other = plan({"--crs", "EPSG:25831"});
    if (other.exitCode != 0) GTEST_SKIP() << "PROJ is not there: " << other.toString();
    EXPECT_EQ(crsOfPlan(), "EPSG:25831 (from EPSG:28992)");
}

TEST_F(CitySources, AreAnErrorIfTooManyFeaturesWouldBeLeftOut) {
    write("a.city.jsonl", boxesOf(kDutch, "a", 4, 121000, 487000));
    write("b.city.jsonl", boxesOf("", "b", 8, 121500, 487000));
    // Without a CRS, the second file cannot be brought into another one.
    const CommandResult refused = plan({"--crs", "EPSG:28992"});
    EXPECT_EQ(refused.exitCode, 3) << refused.toString();
    EXPECT_NE(refused.err.find("E612 ManySkipped: 8 of 12 features"), std::string::npos) << refused.toString();
    EXPECT_FALSE(std::filesystem::exists(folder / "town/plan/plan.json"));
    const CommandResult allowed = plan({"--crs", "EPSG:28992", "--max-left-out", "70"});
    EXPECT_EQ(allowed.exitCode, 0) << allowed.toString();
}

TEST_F(CitySources, APlaceOutsideOfTheAreaOfTheCrsIsAWarning) {
    write("a.city.jsonl", boxesOf("https://www.opengis.net/def/crs/EPSG/0/25832", "a", 3, 121000, 487000));
    const CommandResult planned = plan();
    EXPECT_EQ(planned.exitCode, 0) << planned.toString();
    EXPECT_NE(planned.err.find("E129 OutsideArea"), std::string::npos) << planned.toString();
}

TEST_F(CitySources, AFileWhoseUnitIsInDoubtIsLeftOut) {
    write("a.city.jsonl", boxesOf(kDutch, "a", 8, 121000, 487000));
    write("b.city.jsonl", boxCity("", {{"b0", 0, 0, 9000}, {"b1", 40, 0, 9000}}));
    const CommandResult planned = plan();
    EXPECT_EQ(planned.exitCode, 0) << planned.toString();
    EXPECT_NE(planned.out.find("8 features of 2 files"), std::string::npos) << planned.toString();
    EXPECT_NE(planned.out.find(" 2 left out"), std::string::npos) << planned.toString();
    EXPECT_NE(planned.err.find("E127 UnitInDoubt"), std::string::npos) << planned.toString();
    EXPECT_NE(planned.err.find("b.city.jsonl: all 2 features of the file are left out: half of the buildings are 9000"),
              std::string::npos)
        << planned.toString();
    std::filesystem::remove_all(folder / "town");
    const CommandResult refused = plan({"--max-left-out", "10"});
    EXPECT_EQ(refused.exitCode, 3) << refused.toString();
    EXPECT_NE(refused.err.find("E612 ManySkipped: 2 of 10 features"), std::string::npos) << refused.toString();
}

TEST_F(CitySources, OneIdWithTwoContentsIsAnErrorOfCheck) {
    write("a.city.jsonl", boxesOf(kDutch, "x", 3, 121000, 487000));
    write("b.city.jsonl", boxesOf(kDutch, "x", 2, 121000, 487500));
    const CommandResult planned = plan();
    ASSERT_EQ(planned.exitCode, 0) << planned.toString();
    EXPECT_NE(planned.err.find("E611 IdConflict"), std::string::npos) << planned.toString();
    ASSERT_EQ(run({"city", "run", "town"}).exitCode, 0);
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "info", "town", "--json"}).at("buildings"), 3);
    const CommandResult checked = run({"check", "town"});
    EXPECT_EQ(checked.exitCode, 4) << checked.toString();
    EXPECT_NE(checked.err.find("error E611 IdConflict"), std::string::npos) << checked.toString();
    EXPECT_NE(checked.err.find("'x1'"), std::string::npos) << checked.toString();
}

TEST_F(CitySources, EndedFeaturesAreLeftOut) {
    write("a.city.jsonl",
          boxesOf(kDutch, "now", 3, 121000, 487000) +
              boxesOf(kDutch, "old", 2, 121000, 487500, R"("attributes":{"terminationDate":"2012-03-04"},)")
                  .substr(boxesOf(kDutch, "", 0, 0, 0).size()));
    const CommandResult planned = plan();
    EXPECT_NE(planned.out.find("3 features"), std::string::npos) << planned.toString();
    EXPECT_NE(planned.err.find("E128 FeatureEnded"), std::string::npos) << planned.toString();
    ASSERT_EQ(run({"city", "run", "town"}).exitCode, 0);
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "info", "town", "--json"}).at("buildings"), 3);
    std::filesystem::remove_all(folder / "town");
    EXPECT_NE(plan({"--date", "2012-03-03"}).out.find("5 features"), std::string::npos);
    ASSERT_EQ(run({"city", "run", "town"}).exitCode, 0);
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "info", "town", "--json"}).at("buildings"), 5);
    EXPECT_EQ(plan({"--date", "yesterday"}).exitCode, 2);
}

TEST_F(CitySources, ChangedAndRemovedFilesAreNamedByStatus) {
    write("a.city.jsonl", boxesOf(kDutch, "a", 3, 121000, 487000));
    write("b.city.jsonl", boxesOf(kDutch, "b", 3, 121000, 487500));
    write("c.city.jsonl", boxesOf(kDutch, "c", 3, 121000, 488000));
    ASSERT_EQ(plan().exitCode, 0);
    const auto changedFiles = [&] {
        return runSvtForJson(folder.path(), {"city", "status", "town", "--json"}).at("changedFiles");
    };
    EXPECT_EQ(changedFiles().size(), 0u);
    const auto later = std::filesystem::file_time_type::clock::now() + std::chrono::seconds(10);
    // Touched, but the same.
    std::filesystem::last_write_time(folder / "files/a.city.jsonl", later);
    EXPECT_EQ(changedFiles().size(), 0u);
    // Changed within the same size.
    std::string text = readText(folder / "files/b.city.jsonl");
    text.replace(text.find("487500,10"), 9, "487500,12");
    write("b.city.jsonl", text);
    std::filesystem::last_write_time(folder / "files/b.city.jsonl", later);
    std::filesystem::remove(folder / "files/c.city.jsonl");
    const nlohmann::json changed = changedFiles();
    ASSERT_EQ(changed.size(), 2u) << changed;
    EXPECT_TRUE(changed[0].at("file").get<std::string>().ends_with("b.city.jsonl"));
    EXPECT_EQ(changed[0].at("isRemoved"), false);
    EXPECT_EQ(changed[1].at("isRemoved"), true);
    const CommandResult status = run({"city", "status", "town"});
    EXPECT_NE(status.out.find("--update"), std::string::npos) << status.toString();
    EXPECT_NE(status.out.find("removed since the plan"), std::string::npos) << status.toString();
}

TEST_F(CitySources, AFolderThatIsNotBuiltTellsTheNextStep) {
    write("a.city.jsonl", boxesOf(kDutch, "a", 3, 121000, 487000));
    ASSERT_EQ(plan().exitCode, 0);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", "town"}, {"render", "town", "-o", "x.png"}, {"city", "info", "town"}}) {
        const CommandResult result = run(command);
        EXPECT_EQ(result.exitCode, 3) << result.toString();
        EXPECT_NE(result.err.find("'svt city run town' builds it"), std::string::npos) << result.toString();
    }
}

// Names that --crs understands work in exports as well.
TEST_F(CitySources, NamesOfReferenceSystemsReachTheOutputs) {
    const std::pair<std::string, int> names[] = {{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", 25832},
                                                 {"http://www.opengis.net/gml/srs/epsg.xml#25832", 25832},
                                                 {"EPSG:5555", 25832}};
    for (const auto& [name, code] : names) {
        writeText(folder / "boxes.city.jsonl", boxesOf(name, "a", 2, 691000, 5335000));
        ASSERT_EQ(run({"build", "boxes.city.jsonl", "-o", "boxes.svt", "--spacing", "1", "-q"}).exitCode, 0) << name;
        ASSERT_EQ(run({"query", "boxes.svt", "all", "-o", "boxes.geojson"}).exitCode, 0) << name;
        EXPECT_NE(readText(folder / "boxes.geojson").find(fmt::format("EPSG::{}", code)), std::string::npos) << name;
        const CommandResult tiles = run({"convert", "boxes.svt", "boxes.3dtiles"});
        EXPECT_EQ(tiles.exitCode, 0) << tiles.toString();
        // The output says whether PROJ has the grid, or that the CRS does not name its heights.
        EXPECT_TRUE(tiles.err.find("the height of the geoid (EPSG:") != std::string::npos ||
                    tiles.err.find(code == 25832 && name.starts_with("http")
                                       ? "does not say from where they count"
                                       : "PROJ has no grid for EPSG:") != std::string::npos)
            << tiles.toString();
        std::filesystem::remove_all(folder / "boxes.3dtiles");
    }
    writeText(folder / "swiss.city.jsonl", boxesOf("CH1903+", "a", 2, 2600000, 1200000));
    ASSERT_EQ(run({"build", "swiss.city.jsonl", "-o", "swiss.svt", "--spacing", "1", "-q"}).exitCode, 0);
    ASSERT_EQ(run({"query", "swiss.svt", "all", "-o", "swiss.geojson"}).exitCode, 0);
    EXPECT_NE(readText(folder / "swiss.geojson").find("EPSG::2056"), std::string::npos);
}

TEST_F(CitySources, TheOrderOfTheAxesAndTheUnitCanBeStated) {
    writeText(folder / "a.city.jsonl", boxesOf("", "a", 2, 0, 500));
    ASSERT_EQ(
        run({"build", "a.city.jsonl", "-o", "a.svt", "--spacing", "1", "--axis-order", "north-east", "-q"}).exitCode,
        0);
    const auto size = runSvtForJson(folder.path(), {"info", "a.svt", "--json"}).at("grid").at("dimension");
    EXPECT_GT(size.at(1).get<int>(), size.at(0).get<int>()) << "the row runs north";
    ASSERT_EQ(run({"build", "a.city.jsonl", "-o", "b.svt", "--spacing", "0.1", "--unit", "dm", "-q"}).exitCode, 0);
    const auto objects = runSvtForJson(folder.path(), {"info", "b.svt", "--json"}).at("objects");
    EXPECT_NEAR(objects.at(0).at("volume").get<double>(), 4, 1e-6) << "2 x 2 x 1 m";
    EXPECT_EQ(run({"build", "a.city.jsonl", "-o", "c.svt", "--axis-order", "up"}).exitCode, 2);
    EXPECT_EQ(run({"build", "a.city.jsonl", "-o", "c.svt", "--unit", "parsec"}).exitCode, 2);
}

}  // namespace
}  // namespace svt::test
