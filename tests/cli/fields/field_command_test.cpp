// svt field list, stats, probe, export and remove.
#include <tests/cli/run_command.hpp>

#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace svt::test {
namespace {

using nlohmann::json;

class FieldCommand : public ::testing::Test {
protected:
    FieldCommand() {
        prepareHouse(folder.path(), "0.25");
        std::filesystem::copy_file(folder / "house.svt", folder / "plain.svt");
        writeText(folder / "places.csv", "name,room\ns1,house_living\ns2,house_kitchen\n");
        writeText(folder / "warm.csv", "time,s1,s2\n0,20,24\n3600,22,24\n7200,26,\n");
        runSvtWell(folder.path(),
                   {"field-add", "house.svt", "warm.csv", "--places", "places.csv", "--unit", "Cel", "--name", "warm"});
    }
    json rows(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin() + 1, {"house.svt"});
        arguments.emplace_back("--json");
        return runSvtForJson(folder.path(), arguments);
    }
    // The message has the text.
    void expectError(const std::vector<std::string>& arguments, int exitCode, std::string_view text) {
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
    }

    TemporaryFolder folder;
};

TEST_F(FieldCommand, ListsFields) {
    const json listed = rows({"field-list"});
    ASSERT_EQ(listed.at("fields").size(), 1u);
    const json& field = listed["fields"][0];
    EXPECT_EQ(field["name"], "warm");
    EXPECT_EQ(field["kind"], "points");
    EXPECT_EQ(field["unit"], "Cel");
    EXPECT_EQ(field["times"], json({0, 3600, 7200}));
    EXPECT_EQ(field["range"], json({20, 26}));
    EXPECT_EQ(field["points"].size(), 2u);
    EXPECT_GT(field["bytes"], 0);
    const std::string text = runSvtWell(folder.path(), {"field", "list", "house.svt"});
    EXPECT_NE(text.find("warm"), std::string::npos);
    EXPECT_EQ(runSvtForJson(folder.path(), {"field-list", "plain.svt", "--json"}), json({{"fields", json::array()}}));
}

TEST_F(FieldCommand, AShellNamesTheFieldsThatItLoses) {
    const std::string lost = "the output does not have the fields of the input: warm";
    const CommandResult shell = runSvt(folder.path(), {"shell", "house.svt", "-o", "shell.svt"});
    EXPECT_EQ(shell.exitCode, 0) << shell.toString();
    EXPECT_NE(shell.err.find(lost), std::string::npos) << shell.toString();
    const CommandResult without = runSvt(folder.path(), {"shell", "plain.svt", "-o", "other.svt"});
    EXPECT_EQ(without.err.find("fields of the input"), std::string::npos) << without.toString();
}

TEST_F(FieldCommand, StatisticsOfRooms) {
    const json all = rows({"field-stats", "warm", "--by", "class=BuildingRoom", "--over", "23"});
    json living, kitchen, other;
    for (const json& row : all) {
        if (!row["time"].is_null()) continue;
        (row["id"] == "house_living" ? living : row["id"] == "house_kitchen" ? kitchen : other) = row;
    }
    ASSERT_FALSE(living.is_null() || kitchen.is_null() || other.is_null());
    EXPECT_NEAR(living["mean"].get<double>(), (20 + 22 + 26) / 3.0, 1e-6);
    EXPECT_EQ(living["min"], 20);
    EXPECT_EQ(living["max"], 26);
    EXPECT_NEAR(living["hoursOver"].get<double>(), 0.75, 1e-9) << "from 23 to 26 of 22 to 26";
    EXPECT_EQ(living["hoursUnknown"], 0);
    EXPECT_NEAR(kitchen["hoursOver"].get<double>(), 1, 1e-9);
    EXPECT_NEAR(kitchen["hoursUnknown"].get<double>(), 1, 1e-9) << "the last value is missing";
    EXPECT_TRUE(other["mean"].is_null()) << "a room without a sensor";
    EXPECT_EQ(other["volume"], 0);
    EXPECT_GT(other["missing"], 0);
    runSvtWell(folder.path(), {"field", "stats", "house.svt", "warm", "-o", "rows.csv"});
    EXPECT_NE(readText(folder / "rows.csv").find("house_living"), std::string::npos);
}

TEST_F(FieldCommand, ProbesAPlace) {
    const json at = rows({"field-list"}).at("fields")[0].at("points")[0].at("at");
    std::string place;
    for (std::size_t axis = 0; axis < 3; ++axis)
        place += (axis > 0 ? "," : "") + std::to_string(at[axis].get<double>());
    const json series = rows({"field-probe", "warm", "--at=" + place});
    ASSERT_EQ(series.size(), 3u);
    EXPECT_EQ(series[1]["value"], 22);
    EXPECT_EQ(series[1]["time"], 3600);
    const json outside = rows({"field-probe", "warm", "--at=-1000,0,0"});
    EXPECT_TRUE(outside[0]["value"].is_null());
    EXPECT_TRUE(outside[0]["id"].is_null());
}

TEST_F(FieldCommand, ExportsValuesAsATable) {
    runSvtWell(folder.path(), {"field-export", "house.svt", "warm", "-o", "all.json", "-q"});
    const json all = json::parse(readText(folder / "all.json"));
    ASSERT_EQ(all.size(), 5u) << "the last value of s2 is missing";
    EXPECT_EQ(all[1]["id"], "s2");
    EXPECT_EQ(all[1]["time"], 0);
    EXPECT_EQ(all[1]["value"], 24);
    EXPECT_TRUE(all[1]["x"].is_number());
    runSvtWell(folder.path(), {"field-export", "house.svt", "warm", "--time", "7200", "-o", "last.csv", "-q"});
    const std::string last = readText(folder / "last.csv");
    EXPECT_EQ(last.substr(0, last.find('\n')), "id,x,y,z,time,value\r");
    EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 2);
}

TEST_F(FieldCommand, ExportsALatticeThatComesBackAtTheSamePlaces) {
    runSvtWell(folder.path(), {"simulate-heat", "house.svt", "--leaky", "-q", "-o", "heat.svt"});
    const std::vector<std::string> probe{"field-probe", "heat.svt", "temperature", "--at", "500000.15,5400002.4,101.2",
                                         "--json"};
    const double before = runSvtForJson(folder.path(), probe)[0].at("value");
    for (const char* name : {"t.vti", "t.vtr", "t.nrrd"}) {
        runSvtWell(folder.path(), {"field-export", "heat.svt", "temperature", "-o", name, "-q"});
        runSvtWell(folder.path(),
                   {"field-add", "plain.svt", name, "--name", "temperature", "--replace", "-o", "heat.svt", "-q"});
        const json field = runSvtForJson(folder.path(), {"field-list", "heat.svt", "--json"})["fields"][0];
        EXPECT_EQ(field["unit"], "Cel") << name;
        EXPECT_EQ(field["medium"], "solid") << name;
        EXPECT_NEAR(runSvtForJson(folder.path(), probe)[0].at("value").get<double>(), before, 1e-3) << name;
    }
}

TEST_F(FieldCommand, ExportNamesTheRemedy) {
    expectError({"field-export", "house.svt", "warm", "-o", "w.vti"}, kUsage,
                "the field 'warm' has values of points, and .vti holds those of a lattice; write a .csv, .json or "
                ".parquet");
    expectError({"field-export", "house.svt", "warm", "--time", "5", "-o", "w.csv"}, kUsage,
                "the field 'warm' has no values at 5 s; it has 3 times from 0 to 7200 s");
    EXPECT_FALSE(std::filesystem::exists(folder / "w.vti") || std::filesystem::exists(folder / "w.csv"));
}

TEST_F(FieldCommand, RemovingRestoresTheFile) {
    runSvtWell(folder.path(), {"field", "remove", "house.svt", "warm", "-o", "without.svt"});
    EXPECT_EQ(readText(folder / "without.svt"), readText(folder / "plain.svt"));
    EXPECT_NE(readText(folder / "house.svt"), readText(folder / "plain.svt"));
    runSvtWell(folder.path(), {"field", "remove", "house.svt", "warm"});
    EXPECT_EQ(readText(folder / "house.svt"), readText(folder / "plain.svt"));
}

TEST_F(FieldCommand, OtherCommandsReadTheVolume) {
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "house.svt", "all", "--json"}),
              runSvtForJson(folder.path(), {"query", "plain.svt", "all", "--json"}));
    runSvtWell(folder.path(), {"info", "house.svt"});
}

TEST_F(FieldCommand, ErrorsNameTheRemedy) {
    expectError({"field-stats", "house.svt", "cold"}, kInput, "E702 UnknownField");
    expectError({"field-stats", "house.svt", "cold"}, kInput, "it has: warm");
    expectError({"field-probe", "plain.svt", "warm", "--at", "0,0,0"}, kInput, "svt field add");
    expectError({"field-remove", "house.svt", "cold"}, kInput, "E702");
    expectError({"field-list", "warm.csv"}, kInput, "this is not a .svt");
    expectError({"field-list", "missing.svt"}, kInput, "E101");
    expectError({"field-stats", "house.svt", "warm", "--by", "class=("}, kUsage, "E901");
}

}  // namespace
}  // namespace svt::test
