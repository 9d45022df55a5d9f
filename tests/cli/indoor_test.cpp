// IndoorGML out and in: what is written has no findings, and comes back with the same rooms, volumes and connections.
#include "run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace svt::test {
namespace {

using nlohmann::json;

std::map<std::string, double> roomVolumes(const json& checked) {
    std::map<std::string, double> volumes;
    for (const json& object : checked.at("objects"))
        if (object.at("class") == "BuildingRoom" && object.at("volume").is_number())
            volumes[object.at("id")] = object.at("volume");
    return volumes;
}

class Indoor : public ::testing::Test {
protected:
    json check(const std::string& file) {
        const CommandResult result = runSvt(folder.path(), {"check", file, "--json"});
        EXPECT_EQ(result.exitCode, 0) << file << result.err;
        return json::parse(result.out);
    }
    // Ids by the room or door that is connected with them.
    std::map<std::string, std::set<std::string>> connections(const std::string& volume) {
        std::map<std::string, std::set<std::string>> all;
        const json info = runSvtForJson(folder.path(), {"info", volume, "--json"});
        for (const json& object : info.at("objects")) {
            if (!object.contains("attributes") || !object.at("attributes").contains("connectsTo")) continue;
            std::istringstream ids(object.at("attributes").at("connectsTo").get<std::string>());
            for (std::string id; std::getline(ids >> std::ws, id, ';');) all[object.at("id")].insert(id);
        }
        return all;
    }
    TemporaryFolder folder;
};

TEST_F(Indoor, TheHouseComesBackWithItsRoomsAndDoors) {
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    runSvtWell(folder.path(), {"convert", "house.gml", "house.indoor.gml"});
    const auto before = roomVolumes(check("house.gml")), after = roomVolumes(check("house.indoor.gml"));
    ASSERT_GT(before.size(), 10u);
    for (const auto& [id, volume] : before) {
        ASSERT_EQ(after.count(id), 1u) << id;
        EXPECT_NEAR(after.at(id), volume, 1e-4 * volume) << id;
    }
    EXPECT_EQ(after.size(), before.size() + 11) << "and a cell for each door between rooms or to the garden";

    runSvtWell(folder.path(), {"build", "house.indoor.gml", "-o", "indoor.svt", "--spacing", "0.2"});
    const auto joined = connections("indoor.svt");
    EXPECT_EQ(joined.at("house_door_study"), (std::set<std::string>{"house_hall", "house_study"}));
    EXPECT_EQ(joined.at("house_door_bath"), (std::set<std::string>{"house_bath", "house_gallery"}));
    EXPECT_EQ(joined.at("house_door_entrance"), (std::set<std::string>{"house_hall"}));
    EXPECT_EQ(joined.count("house_loft"), 0u) << "nobody goes there by a door";
}

TEST_F(Indoor, VoxelsAloneGiveValidCellsAsWell) {
    prepareHouse(folder.path(), "0.05", {"--vectors", "none"});
    runSvtWell(folder.path(), {"convert", "house.svt", "house.indoor.gml"});
    const auto after = roomVolumes(check("house.indoor.gml"));
    EXPECT_GT(after.size(), 20u);
}

TEST_F(Indoor, WhatIsWrittenIsWrittenAgainAlike) {
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    runSvtWell(folder.path(), {"convert", "house.gml", "one.indoor.gml"});
    runSvtWell(folder.path(), {"convert", "one.indoor.gml", "two.indoor.gml"});
    const auto one = roomVolumes(check("one.indoor.gml")), two = roomVolumes(check("two.indoor.gml"));
    ASSERT_EQ(one.size(), two.size());
    for (const auto& [id, volume] : one) EXPECT_NEAR(two.at(id), volume, 1e-4 * volume + 1e-6) << id;
}

TEST_F(Indoor, TheFzkHouseFromIfcHasTheVolumesOfItsSpaces) {
    SVT_NEEDS_DATA(file, "fzk_haus.ifc");
    runSvtWell(folder.path(), {"convert", file.string(), "fzk.indoor.gml"});
    double sum = 0;
    std::size_t rooms = 0;
    const json checked = check("fzk.indoor.gml");
    for (const json& object : checked.at("objects"))
        if (object.at("volume").get<double>() > 3) {
            sum += object.at("volume").get<double>();
            ++rooms;
        }
    EXPECT_EQ(rooms, 7u);
    EXPECT_EQ(checked.at("objects").size(), 12u) << "five doors";
    EXPECT_NEAR(sum, 470.83, 0.05);
}

TEST_F(Indoor, AVolumeWithoutRoomsIsToldSo) {
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    const CommandResult result = runSvt(
        folder.path(), {"convert", "house.gml", "walls.indoor.gml", "--spacing", "0.4", "--select", "class=Window"});
    EXPECT_NE(result.exitCode, 0);
    EXPECT_NE(result.err.find("no rooms"), std::string::npos) << result.err;
}

TEST_F(Indoor, GraphsAreDrawnAsLines) {
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    runSvtWell(folder.path(), {"convert", "house.gml", "house.indoor.gml"});
    const std::vector<std::string> picture{"render",
                                           "house.indoor.gml",
                                           "--spacing",
                                           "0.2",
                                           "--size",
                                           "320x200",
                                           "--show",
                                           "class=Transition",
                                           "--camera",
                                           "top",
                                           "--wireframe=class=Transition",
                                           "-o"};
    const auto draw = [&](std::vector<std::string> more) {
        more.insert(more.begin(), picture.begin(), picture.end());
        runSvtWell(folder.path(), more);
        return readText(folder / more[picture.size()]);
    };
    const std::string thin = draw({"thin.png"}), wide = draw({"wide.png", "--wire-width", "6"});
    EXPECT_NE(thin, wide) << "nothing but lines is shown";
}

}  // namespace
}  // namespace svt::test
