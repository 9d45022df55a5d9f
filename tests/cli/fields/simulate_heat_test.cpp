// `svt simulate heat` on the generated house.
#include <tests/cli/run_command.hpp>

#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::test {
namespace {

using nlohmann::json;

class SimulateHeat : public ::testing::Test {
protected:
    SimulateHeat() { prepareHouse(folder.path(), "0.2"); }
    json simulate(std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate-heat", "house.svt", "--json", "-q"});
        return runSvtForJson(folder.path(), more);
    }
    void expectError(std::vector<std::string> more, int exitCode, std::string_view text) {
        more.insert(more.begin(), {"simulate", "heat", "house.svt"});
        const CommandResult result = runSvt(folder.path(), more);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
    }
    TemporaryFolder folder;
};

TEST_F(SimulateHeat, HasTheDocumentedKeys) {
    const json report = simulate();
    EXPECT_EQ(keysOf(report), (std::vector<std::string>{"assumed", "balance", "cells", "iterations", "leaks",
                                                        "openings", "outside", "planes", "rooms", "undetermined"}));
    ASSERT_EQ(report["rooms"].size(), 14u);
    double sum = report["outside"]["watts"].get<double>();
    EXPECT_LT(sum, -1000) << "outside air receives the heat";
    for (const json& room : report["rooms"]) {
        sum += room["watts"].get<double>();
        EXPECT_EQ(room["temperature"], 20);
        EXPECT_EQ(room["source"], "default");
        EXPECT_EQ(room["lowestSurface"]["at"].size(), 3u);
        EXPECT_LT(room["lowestSurface"]["celsius"], 20);
        EXPECT_GT(room["lowestSurface"]["celsius"], -5);
    }
    EXPECT_NEAR(sum, 0, 0.1);
    EXPECT_LT(report["balance"], 1e-5);
    EXPECT_GT(report["planes"]["share"], 0.95);
    EXPECT_FALSE(report["assumed"].empty());
    EXPECT_TRUE(report["leaks"].empty());
}

TEST_F(SimulateHeat, TemperaturesAndMaterialsAreThoseOfTheOptions) {
    const json plain = simulate(), cold = simulate({"--outside", "-30"});
    EXPECT_NEAR(cold["outside"]["watts"].get<double>() / plain["outside"]["watts"].get<double>(), 2, 1e-4)
        << "the heat is linear in the difference of temperatures";
    const json warm = simulate({"--inside", "all:20", "--inside", "id=house_living:24"});
    for (const json& room : warm["rooms"]) {
        EXPECT_EQ(room["temperature"], room["id"] == "house_living" ? 24 : 20);
        EXPECT_EQ(room["source"], "--inside");
    }
    writeText(folder / "t.csv", "query,conductivity\nclass=BuildingConstructiveElement,0.04\n");
    const json insulated = simulate({"--materials", "t.csv"});
    EXPECT_GT(insulated["outside"]["watts"], plain["outside"]["watts"]);
    EXPECT_EQ(insulated["assumed"].back()["source"], "table");
    const json films = simulate({"--rsi", "1", "--rsi-up", "1", "--rsi-down", "1", "--rse", "1"});
    EXPECT_GT(films["outside"]["watts"], plain["outside"]["watts"]);
}

TEST_F(SimulateHeat, OverTimeHasTheDocumentedKeys) {
    writeText(folder / "frost.csv", "time,temperature\n2026-01-05T00:00,5\n2026-01-05T06:00,-10\n");
    const json report = simulate({"--hours", "6", "--step", "60", "--every", "3", "--weather", "frost.csv"});
    EXPECT_EQ(keysOf(report),
              (std::vector<std::string>{"assumed", "balance", "capacity", "cells", "heatCapacities", "iterations",
                                        "leaks", "planes", "received", "steps", "stored", "times", "undetermined"}));
    ASSERT_EQ(report["times"].size(), 3u);
    EXPECT_EQ(report["steps"], 6);
    EXPECT_LT(report["balance"], 1e-5);
    EXPECT_LT(report["stored"], 0) << "walls cool down";
    const json& last = report["times"][2];
    EXPECT_EQ(keysOf(last), (std::vector<std::string>{"outside", "rooms", "seconds"}));
    EXPECT_EQ(last["seconds"], 21600);
    EXPECT_EQ(last["outside"]["temperature"], -10);
    EXPECT_EQ(last["rooms"].size(), 14u);
    EXPECT_EQ(keysOf(last["rooms"][0]), keysOf(simulate()["rooms"][0]));
    const CommandResult result = runSvt(folder.path(), {"simulate", "heat", "house.svt", "--hours", "6", "--every", "3",
                                                        "--weather", "frost.csv", "-o", "frost.svt"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("the times of the weather have no zone; they count as UTC"), std::string::npos);
    EXPECT_NE(result.err.find("57 components have a heat capacity by a word"), std::string::npos) << result.toString();
    const json field = runSvtForJson(folder.path(), {"field-list", "frost.svt", "--json"})["fields"][0];
    EXPECT_EQ(field["times"], json({0, 10800, 21600}));
    EXPECT_EQ(field["epoch"], "2026-01-05T00:00:00Z");
    expectError({"--step", "5"}, kUsage, "give --hours as well");
    expectError({"--hours", "12", "--weather", "frost.csv"}, kUsage, "the weather ends after 6 h");
    expectError({"--hours", "1", "--step", "7"}, kUsage, "whole number of steps");
}

TEST_F(SimulateHeat, WritesTheFieldIntoACopy) {
    const std::string summary = runSvtWell(folder.path(), {"simulate", "heat", "house.svt", "-o", "warm.svt"});
    EXPECT_TRUE(summary.starts_with("warm.svt: field 'temperature', 14 rooms, ")) << summary;
    EXPECT_NE(runSvtWell(folder.path(), {"simulate", "heat", "house.svt"}).find("(outside)"), std::string::npos);
    const json listed = runSvtForJson(folder.path(), {"field-list", "warm.svt", "--json"});
    ASSERT_EQ(listed["fields"].size(), 1u);
    const json& field = listed["fields"][0];
    EXPECT_EQ(field["name"], "temperature");
    EXPECT_EQ(field["unit"], "Cel");
    EXPECT_EQ(field["medium"], "solid");
    EXPECT_EQ(field["parameters"]["outside"], -5);
    EXPECT_FALSE(field["parameters"]["conductivities"].empty());
    EXPECT_GE(field["range"][0], -5);
    EXPECT_LE(field["range"][1], 20);
    // From a model: the volume is built, and the field is in it.
    runSvtWell(folder.path(), {"simulate", "heat", "house.gml", "--spacing", "0.25", "-o", "built.svt", "--name", "t"});
    EXPECT_EQ(runSvtForJson(folder.path(), {"field-list", "built.svt", "--json"})["fields"][0]["name"], "t");
}

TEST_F(SimulateHeat, FaultyOptionsAreErrors) {
    expectError({"--inside", "20"}, kUsage, "is not QUERY:CELSIUS");
    expectError({"--inside", "class=BuildingRoom:warm"}, kUsage, "is not QUERY:CELSIUS");
    expectError({"--inside", "id=nobody:20"}, kUsage, "E902");
    expectError({"--outside", "-300"}, kUsage, "--outside");
    writeText(folder / "bad.csv", "query,lambda\n");
    expectError({"--materials", "bad.csv"}, kInput, "unknown column 'lambda'");
    const CommandResult result = runSvt(folder.path(), {"simulate", "heat", "house.svt", "-o", "house.svt"});
    EXPECT_EQ(result.exitCode, kOutput) << result.toString();
}

}  // namespace
}  // namespace svt::test
