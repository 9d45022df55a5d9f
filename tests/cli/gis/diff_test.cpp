// `svt diff`: two states of a building, on generated models.
#include "../run_command.hpp"
#include "../small_model.hpp"

#include <svt/core/test_data_test.hpp>

#include <map>
#include <string>
#include <utility>

namespace svt::test {
namespace {

using nlohmann::json;

class Diff : public ::testing::Test {
protected:
    void sample(const std::string& file, std::vector<std::string> more) {
        more.insert(more.begin(), {"sample", "tower", "-o", file});
        runSvtWell(folder.path(), more);
    }
    CommandResult diff(const std::string& was, const std::string& is, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"diff", was, is, "--spacing", "0.2"});
        return runSvt(folder.path(), more);
    }
    TemporaryFolder folder;
};

TEST_F(Diff, OfOneModelIsEmpty) {
    sample("a.gml", {"--storeys", "1"});
    const CommandResult result = diff("a.gml", "a.gml");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out.find("changed"), std::string::npos) << result.out;
}

// The same building in another format has other ids and attributes, and no change in space.
TEST_F(Diff, IgnoresTheFormat) {
    sample("a.gml", {"--storeys", "1"});
    sample("b.ifc", {"--storeys", "1", "--format", "ifc"});
    const CommandResult result = diff("a.gml", "b.ifc", {"--json"});
    ASSERT_EQ(result.exitCode, 7) << result.err;
    const json compared = result.json();
    std::size_t objects = 0, others = 0;
    for (const json& row : compared["rows"]) {
        if (!row["geometry"].get<bool>() || row["old"].empty() || row["new"].empty()) continue;
        ++objects;
        EXPECT_FALSE(row["attributes"].empty() && row["properties"].empty()) << row;
        if (row["change"] == "same" || row["change"] == "reassigned") continue;
        ++others;
    }
    EXPECT_GT(objects, 50u);
    EXPECT_EQ(others, 0u);
}

TEST_F(Diff, CountsANewStorey) {
    sample("a.gml", {"--storeys", "1"});
    sample("b.gml", {"--storeys", "2"});
    const json compared = diff("a.gml", "b.gml", {"--json"}).json();
    std::map<std::string, double> volumes;
    for (const json& room :
         runSvtForJson(folder.path(), {"query", "b.gml", "class=BuildingRoom", "--spacing", "0.2", "--json"}))
        volumes[room["id"]] = room["volume"];
    std::size_t rooms = 0;
    for (const json& row : compared["rows"])
        if (row["change"] == "added" && row["class"] == "BuildingRoom") {
            ++rooms;
            EXPECT_TRUE(row["exact"].get<bool>());
            EXPECT_NEAR(row["added"].get<double>(), volumes.at(row["new"][0]), 1e-3) << row;
        }
    EXPECT_EQ(rooms, 20u);
}

// Each reason for the exit code is in the summary: the text and the JSON.
TEST_F(Diff, SummaryAndExitCodeAgree) {
    // A site without geometry, whose name says nothing of the boxes.
    const auto modelWith = [](const std::string& site) {
        std::string text = twoBoxes();
        const std::string member = "<cityObjectMember><grp:CityObjectGroup gml:id=\"" + site + "\"><gml:name>" + site +
                                   "</gml:name></grp:CityObjectGroup></cityObjectMember>";
        const std::size_t end = text.rfind("</CityModel>");
        EXPECT_NE(end, std::string::npos) << text;
        return text.insert(end, member);
    };
    writeText(folder / "a.gml", modelWith("north"));
    writeText(folder / "b.gml", modelWith("south"));
    const CommandResult result = diff("a.gml", "b.gml");
    EXPECT_EQ(result.exitCode, 7) << result.toString();
    EXPECT_NE(result.out.find("2 same; without geometry: 1 removed, 1 added"), std::string::npos) << result.out;
    const json summary = diff("a.gml", "b.gml", {"--json"}).json()["summary"];
    EXPECT_TRUE(summary["different"].get<bool>());
    EXPECT_EQ(summary["groups"], json::parse(R"({"same": 0, "added": 1, "removed": 1})"));
    EXPECT_EQ(summary["properties"], json::parse(R"({"class": 0, "name": 0, "storey": 0, "attributes": 0})"));
    EXPECT_EQ(summary["ambiguousGroups"], 0);
}

TEST_F(Diff, WritesTablesAndAVolume) {
    std::string other = twoBoxes();
    for (std::size_t at = 0; (at = other.find("right", at)) != std::string::npos;) other.replace(at, 5, "other");
    writeText(folder / "two.gml", twoBoxes());
    writeText(folder / "one.gml", other);
    const CommandResult result = runSvt(folder.path(), {"diff", "two.gml", "one.gml", "--spacing", "0.1", "-o", "d.csv",
                                                        "-o", "d.json", "-o", "d.svt"});
    EXPECT_EQ(result.exitCode, 0) << result.err;  // other ids are not a difference
    EXPECT_NE(readText(folder / "d.csv").find("same"), std::string::npos);
    EXPECT_NE(readText(folder / "d.csv").find("vectorZ,rotation,added"), std::string::npos);
    const json written = json::parse(readText(folder / "d.json"));
    EXPECT_EQ(written["summary"]["changes"]["same"], 2);
    EXPECT_FALSE(written["summary"]["different"].get<bool>());
    const json rows = runSvtForJson(folder.path(), {"query", "d.svt", "class=Building", "--json"});
    EXPECT_EQ(rows.size(), 2u);
}

// Whichever state is a .svt, the model is built on its samples.
TEST_F(Diff, ComparesAModelWithAVolume) {
    sample("a.gml", {"--storeys", "1"});
    runSvtWell(folder.path(),
               {"build", "a.gml", "-o", "a.svt", "--dimension", "70,60,50", "--vectors", "meshes", "-q"});
    for (const auto& [was, is] : {std::pair("a.svt", "a.gml"), std::pair("a.gml", "a.svt")}) {
        const CommandResult result = runSvt(folder.path(), {"diff", was, is, "-o", "d.svt"});
        EXPECT_EQ(result.exitCode, 0) << result.toString();
        EXPECT_EQ(result.err.find("sample positions"), std::string::npos) << result.err;
    }
}

TEST_F(Diff, AlignsShiftedModels) {
    const auto modelAt = [](double x, double y, double z) {
        std::string members;
        for (int n = 0; n < 3; ++n)
            members +=
                building("b" + std::to_string(n), solid(boxFaces(x + 10 * n, y, z, x + 10 * n + 4 + n, y + 6, z + 3)));
        return cityModel(members);
    };
    writeText(folder / "a.gml", modelAt(500000, 5400000, 100));
    writeText(folder / "b.gml", modelAt(500030.03, 5400000, 150));
    const CommandResult apart = diff("a.gml", "b.gml");
    EXPECT_EQ(apart.exitCode, 7);
    EXPECT_NE(apart.err.find("do not overlap in space"), std::string::npos) << apart.err;
    EXPECT_NE(apart.out.find("3 moved"), std::string::npos) << apart.out;
    // 3000 km apart, so that no volume has both. Rows need none.
    writeText(folder / "far.gml", modelAt(3500000, 5400000, 100));
    const CommandResult far = diff("a.gml", "far.gml", {"-o", "d.svt"});
    EXPECT_EQ(far.exitCode, 2) << far.toString();
    EXPECT_NE(far.err.find("use --align translation"), std::string::npos) << far.err;
    EXPECT_EQ(diff("a.gml", "far.gml").exitCode, 7);
    EXPECT_EQ(diff("a.gml", "far.gml", {"--align", "translation", "-o", "d.svt"}).exitCode, 0);
    const CommandResult aligned = diff("a.gml", "b.gml", {"--align", "translation"});
    EXPECT_EQ(aligned.exitCode, 0) << aligned.out;
    EXPECT_NE(aligned.err.find("is moved by -30.0300, "), std::string::npos) << aligned.err;
}

TEST_F(Diff, RefusesWhatCannotBeCompared) {
    sample("a.gml", {"--storeys", "1"});
    writeText(folder / "bad.gml", "<broken");
    EXPECT_EQ(diff("a.gml", "bad.gml").exitCode, 3);
    EXPECT_EQ(diff("a.gml", "missing.gml").exitCode, 3);
    writeText(folder / "nothing.gml", "");
    writeText(folder / "empty.gml", cityModel(""));
    for (const char* file : {"nothing.gml", "empty.gml"}) {
        const CommandResult result = diff(file, "a.gml");
        EXPECT_EQ(result.exitCode, 3) << result.toString();
        EXPECT_NE(result.err.find(file), std::string::npos) << result.err;
    }
    EXPECT_EQ(diff("a.gml", "a.gml", {"--tolerance", "0"}).exitCode, 2);
    EXPECT_EQ(diff("a.gml", "a.gml", {"-o", "d.png"}).exitCode, 2);
    EXPECT_EQ(diff("a.gml", "a.gml", {"-o", "a.gml"}).exitCode, 2);
}

}  // namespace
}  // namespace svt::test
