// A city from files to a volume of a part of it, as a user makes it.
#include "run_command.hpp"

#include <nlohmann/json.hpp>

#include <map>

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
                          json = read("city.json");
        std::filesystem::remove_all(folder / profile / "packs");
        runWell({"city", "task", profile, "0", "--of", "1", "--threads", "2"});
        runWell({"city", "merge", profile});
        EXPECT_EQ(read("packs/00000.svtp"), pack);
        EXPECT_EQ(read("index.bin"), index);
        EXPECT_EQ(read("ids.bin"), ids);
        EXPECT_EQ(read("city.json"), json);
    }
}

// What the city holds of a building is what `svt build` makes of the file on the same grid.
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
        for (const char* name : {"plan/plan.json", "city.json", "index.bin", "ids.bin", "packs.bin"})
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
    EXPECT_NE(planOf("city", 4, true).find("0 features are new or changed, 0 gone"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "city/city.json"));
    planOf("city", 6, true);
    EXPECT_FALSE(std::filesystem::exists(folder / "city/city.json"));
    const nlohmann::json status = runSvtForJson(folder.path(), {"city", "status", "city", "--json"});
    EXPECT_FALSE(status.at("missing").empty());
    EXPECT_LT(status.at("missing").size(), status.at("packs").get<std::size_t>());
    runWell({"city", "run", "city", "-q"});
    expectSame(6);
    std::string text = readText(folder / file(2));
    const std::size_t at = text.find("<bldg:measuredHeight");
    ASSERT_NE(at, std::string::npos);
    text.insert(text.find('>', at) + 1, "1");
    writeText(folder / file(2), text);
    EXPECT_NE(planOf("city", 6, true).find("1 features are new or changed, 1 gone; 0 tiles are new, 1 changed, 0 gone"),
              std::string::npos);
    EXPECT_EQ(runSvtForJson(folder.path(), {"city", "status", "city", "--json"}).at("missing").size(), 1u);
    runWell({"city", "run", "city", "-q"});
    expectSame(6);
    planOf("city", 3, true);
    runWell({"city", "run", "city", "-q"});
    expectSame(3);
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

}  // namespace
}  // namespace svt::test
