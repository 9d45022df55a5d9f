// svt field add: files of other programs become fields of a volume, and a file that cannot leaves the volume as it is.
#include <tests/cli/run_command.hpp>

#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

namespace svt::test {
namespace {

using nlohmann::json;

class FieldAdd : public ::testing::Test {
protected:
    FieldAdd() {
        prepareHouse(folder.path(), "0.25");
        writeText(folder / "places.csv", "name,room\ns1,Living room\ns2,Kitchen\n");
        writeText(
            folder / "co2.csv",
            "time,s1,s2\n2026-01-05T00:00:00Z,400,410\n2026-01-05T00:15:00Z,520,\n2026-01-05T00:30:00Z,610,455\n");
    }

    json add(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"field-add", "house.svt"});
        arguments.emplace_back("--json");
        return runSvtForJson(folder.path(), arguments);
    }

    // The volume stays as it is, and the message has `text`.
    void expectRefusal(std::vector<std::string> arguments, int exitCode, std::string_view text) {
        const std::string before = readText(folder / "house.svt");
        const auto files = folder.count();
        arguments.insert(arguments.begin(), {"field-add", "house.svt"});
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
        EXPECT_EQ(readText(folder / "house.svt"), before);
        EXPECT_EQ(folder.count(), files);
    }

    TemporaryFolder folder;
};

TEST_F(FieldAdd, SensorsInRooms) {
    const json volume = runSvtForJson(folder.path(), {"info", "house.svt", "--json"});
    std::string rooms[2];
    for (const json& object : volume.at("objects"))
        if (object.at("class") == "BuildingRoom") (rooms[0].empty() ? rooms[0] : rooms[1]) = object.at("id");
    ASSERT_FALSE(rooms[1].empty());
    writeText(folder / "places.csv", "name,room\ns1," + rooms[0] + "\ns2," + rooms[1] + "\n");
    const json added = add({"co2.csv", "--places", "places.csv", "--unit", "ppm", "--quantity", "CO2"});
    ASSERT_EQ(added.at("fields").size(), 1u);
    const json& field = added["fields"][0];
    EXPECT_EQ(field["name"], "co2");
    EXPECT_EQ(field["kind"], "points");
    EXPECT_EQ(field["unit"], "[ppm]");
    EXPECT_EQ(field["points"], 2);
    EXPECT_EQ(field["times"], json({0, 900, 1800}));
    EXPECT_EQ(field["epoch"], "2026-01-05T00:00:00Z");
    EXPECT_EQ(field["range"], json({400, 610}));
    EXPECT_EQ(field["parameters"]["places"], "places.csv");

    // The labels are those of before, and the name is taken now.
    const json again = runSvtForJson(folder.path(), {"info", "house.svt", "--json"});
    EXPECT_EQ(again.at("objects"), volume.at("objects"));
    const std::vector<std::string> more{"co2.csv", "--places", "places.csv", "--unit", "ppm", "--quantity", "CO2"};
    expectRefusal(more, kUsage, "has a field 'co2' already; replace it with --replace");
    auto replaced = more;
    replaced.insert(replaced.end(), {"--replace", "--from", "900"});
    EXPECT_EQ(add(replaced)["fields"][0]["times"], json({900, 1800}));
    auto named = more;
    named.insert(named.end(), {"--name", "air.quality", "-o", "other.svt"});
    EXPECT_EQ(add(named)["fields"][0]["name"], "air.quality");
    EXPECT_TRUE(std::filesystem::exists(folder / "other.svt"));
}

TEST_F(FieldAdd, RefusalsLeaveTheVolume) {
    writeText(folder / "points.csv", "name,x,y,z\ns1,1,1,1\n");
    expectRefusal({"co2.csv", "--unit", "ppm"}, kUsage, "--places");
    expectRefusal({"co2.csv", "--unit", "ppm", "--places", "points.csv"}, kInput,
                  "co2.csv:1: sensor 's2' has no place in");
    expectRefusal({"co2.csv", "--places", "places.csv", "--at", "1,2,3"}, kUsage, "--at has no meaning for sensors");
    writeText(folder / "points.csv", "name,x,y,z\ns1,-900,1,1\ns2,-900,1,1\n");
    expectRefusal({"co2.csv", "--unit", "ppm", "--places", "points.csv"}, kInput, "E703");
    expectRefusal({"points.csv", "--from", "5", "--to", "1"}, kUsage, "is behind the last");
    expectRefusal({"house.gml", "--unit", "Cel"}, kInput, "the format is not known");
    const CommandResult model = runSvt(folder.path(), {"field-add", "house.gml", "co2.csv"});
    EXPECT_EQ(model.exitCode, kUsage) << model.toString();
    EXPECT_NE(model.err.find("svt build"), std::string::npos) << model.toString();
}

TEST_F(FieldAdd, DevicesOfARunThatGoesOn) {
    const json grid = runSvtForJson(folder.path(), {"info", "house.svt", "--json"}).at("grid");
    const json& origin = grid.at("origin");
    const auto number = [&](std::size_t axis, double more) {
        return std::to_string(origin[axis].get<double>() + more);
    };
    writeText(
        folder / "run.smv",
        "FDSVERSION\nFDS-6.9.1\n\nCSVF\n devc\n run_devc.csv\n\nDEVICE\n T1 % TEMPERATURE\n 1 1 1 0 0 -1 0 0 % null\n");
    writeText(folder / "run_devc.csv", "s,C\nTime,T1\n0,20\n10,24.5\n20,2");
    const json added = add({"run.smv", "--at", number(0, 1) + "," + number(1, 1) + "," + number(2, 0), "--unit", "K"});
    const json& field = added.at("fields").at(0);
    EXPECT_EQ(field["name"], "devices_temperature");
    EXPECT_EQ(field["by"], "FDS-6.9.1");
    EXPECT_EQ(field["times"], json({0, 10}));
    EXPECT_NEAR(field["range"][1].get<double>(), 297.65, 1e-4);
    bool isCut = false;
    for (const json& finding : added.at("findings")) isCut = isCut || finding.at("code") == "E704";
    EXPECT_TRUE(isCut) << added["findings"];
}

TEST_F(FieldAdd, ExportsOfTheVolumeComeBackInPlace) {
    runSvtWell(folder.path(), {"convert", "house.svt", "house.vti"});
    runSvtWell(folder.path(), {"convert", "house.svt", "house.nrrd"});
    const json size = runSvtForJson(folder.path(), {"info", "house.svt", "--json"}).at("grid").at("dimension");
    for (const char* file : {"house.nrrd", "house.vti"}) {
        const json added =
            add({file, "--unit", "1", "--precision", "1", "--name", "labels", "--replace", "--quantity", "label"});
        EXPECT_EQ(added.at("fields").at(0).at("size"), size) << file;
        EXPECT_EQ(added["fields"][0]["range"][0], 0) << file;
        EXPECT_GT(added["fields"][0]["range"][1], 5) << file;
    }
}

}  // namespace
}  // namespace svt::test
