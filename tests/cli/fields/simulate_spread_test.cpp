// `svt simulate spread` on the generated house.
#include <tests/cli/run_command.hpp>

#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

namespace svt::test {
namespace {

using nlohmann::json;

class SimulateSpread : public ::testing::Test {
protected:
    SimulateSpread() {
        prepareHouse(folder.path(), "0.2");
        writeText(folder / "places.csv", "name,x,y,z\nliving,500002,5400002,101.2\nlost,499990,5400002,101.2\n");
        writeText(folder / "warm.csv", "time,living,lost\n0,20,5\n3600,22,5\n");
        runSvtWell(folder.path(),
                   {"field-add", "house.svt", "warm.csv", "--places", "places.csv", "--unit", "Cel", "--name", "warm"});
    }
    json spread(std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate-spread", "house.svt", "warm", "--json", "-q"});
        return runSvtForJson(folder.path(), more);
    }
    void expectError(std::vector<std::string> more, int exitCode, std::string_view text) {
        more.insert(more.begin(), {"simulate", "spread"});
        const CommandResult result = runSvt(folder.path(), more);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.toString();
    }
    TemporaryFolder folder;
};

TEST_F(SimulateSpread, HasTheDocumentedKeys) {
    const json report = spread();
    EXPECT_EQ(keysOf(report),
              (std::vector<std::string>{"field", "nodes", "roomsWithoutValues", "sensors", "touchingRooms"}));
    EXPECT_EQ(report["field"], "spread");
    ASSERT_EQ(report["sensors"].size(), 2u);
    EXPECT_EQ(report["sensors"][0]["room"], "house_living");
    EXPECT_GT(report["sensors"][0]["volume"], 20);
    EXPECT_EQ(report["sensors"][1], json({{"id", "lost"}, {"room", nullptr}, {"volume", nullptr}}));
    EXPECT_EQ(report["roomsWithoutValues"].size(), 12u) << "air passes the hatch to the kitchen";
    EXPECT_GT(report["nodes"], 1000);
}

TEST_F(SimulateSpread, OpenDoorsLetAirPass) {
    const json closed = spread(), open = spread({"--open", "class~Door"});
    EXPECT_LT(open["roomsWithoutValues"].size(), closed["roomsWithoutValues"].size());
    EXPECT_GT(open["sensors"][0]["volume"], closed["sensors"][0]["volume"]);
}

TEST_F(SimulateSpread, WritesTheFieldIntoACopy) {
    const CommandResult result = runSvt(
        folder.path(), {"simulate", "spread", "house.svt", "warm", "-o", "air.svt", "--name", "air", "--step", "0.4"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("1 of 2 sensors do not count, because no room lies within 0.25 m: lost"),
              std::string::npos)
        << result.toString();
    EXPECT_NE(result.err.find("12 rooms have no values"), std::string::npos) << result.toString();
    EXPECT_NE((result.out + result.err).find("air.svt: field 'air', "), std::string::npos) << result.toString();
    const json listed = runSvtForJson(folder.path(), {"field-list", "air.svt", "--json"});
    ASSERT_EQ(listed["fields"].size(), 2u);
    const json& field = listed["fields"][1];
    EXPECT_EQ(field["name"], "air");
    EXPECT_EQ(field["kind"], "grid");
    EXPECT_EQ(field["unit"], "Cel");
    EXPECT_EQ(field["medium"], "air");
    EXPECT_EQ(field["times"], json({0, 3600}));
    EXPECT_EQ(field["parameters"]["sensors"], "warm");
    EXPECT_EQ(field["parameters"]["sensorsWithoutRoom"], json({"lost"}));
    const json rows =
        runSvtForJson(folder.path(), {"field-stats", "air.svt", "air", "--by", "id=house_living", "--json"});
    EXPECT_EQ(rows[0]["mean"], 20);
    EXPECT_EQ(rows[1]["max"], 22);
}

TEST_F(SimulateSpread, BadInputIsNamed) {
    expectError({"house.gml", "warm"}, kInput, "this is not a .svt");
    expectError({"house.svt", "cold"}, kInput, "warm");
    expectError({"house.svt", "warm", "--open", "class=Gate"}, kUsage, "class=Gate");
    expectError({"house.svt", "warm", "--step", "0"}, kUsage, "--step");
    expectError({"house.svt", "warm", "--name", "2 words", "-o", "o.svt"}, kInput, "2 words");
    EXPECT_FALSE(std::filesystem::exists(folder / "o.svt"));
}

}  // namespace
}  // namespace svt::test
