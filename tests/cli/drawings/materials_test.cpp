// Hatches by materials: layered walls, the table of the user, and the reasons that the command reports.
#include <tests/cli/drawings/small_ifc.hpp>
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

// A room between walls of brick on steel studs, of a list of materials, and of a material that no table knows.
SmallIfc house() {
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.box("SPACE", "room", storey, {0.3, 0.3, 0}, {5.7, 4.7, 2.8});
    const int south = ifc.box("WALL", "south", storey, {0, 0, 0}, {6, 0.3, 2.8});
    ifc.layers(south, {{"Brick, Common", 0.1}, {"Fiberglass Batt", 0.05}, {"Metal Stud Layer", 0.15}});
    const int north = ifc.box("WALL", "north", storey, {0, 4.7, 0}, {6, 5, 2.8});
    ifc.materials(north, {"Plaster", "Masonry - Concrete Block", "Fiberglass Batt"});
    const int west = ifc.box("WALL", "west", storey, {0, 0.3, 0}, {0.3, 4.7, 2.8});
    ifc.materials(west, {"Poroton-T7-Wunder"});
    const int east = ifc.box("WALL", "east", storey, {5.7, 0.3, 0}, {6, 4.7, 2.8});
    ifc.materials(east, {"Solid 397409098"});
    return ifc;
}

struct Use {
    std::string hatch, source;
};

// Hatches of a plan by material.
std::map<std::string, Use> hatchesOf(const fs::path& folder, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"section", "house.ifc", "--spacing", "0.1", "--plane", "z=1.1", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::map<std::string, Use> uses;
    const nlohmann::json section = runSvtForJson(folder, arguments);
    for (const auto& use : section.at("hatches"))
        uses[use.at("material").is_null() ? "" : use.at("material")] = {use.at("hatch"), use.at("source")};
    return uses;
}

TEST(Materials, DecideHatchesByTheThickestLoadBearingLayer) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", house().text());
    auto uses = hatchesOf(folder.path());
    EXPECT_EQ(uses.size(), 4u);
    EXPECT_EQ(uses["Brick, Common"].hatch, "masonry") << "neither glass nor steel";
    EXPECT_EQ(uses["Brick, Common"].source, "thickest layer");
    EXPECT_EQ(uses["Masonry - Concrete Block"].hatch, "masonry");
    EXPECT_EQ(uses["Masonry - Concrete Block"].source, "first material");
    EXPECT_EQ(uses["Poroton-T7-Wunder"].source, "material");
    EXPECT_EQ(uses["Solid 397409098"].hatch, "masonry");
    EXPECT_EQ(uses["Solid 397409098"].source, "class");

    const CommandResult drawn =
        runSvt(folder.path(), {"section", "house.ifc", "--spacing", "0.1", "-o", "plan.svg", "--plane", "z=1.1"});
    EXPECT_EQ(drawn.exitCode, kDone);
    EXPECT_NE(drawn.err.find("the hatches of 1 components are assumed from their class and name: 1 with materials "
                             "without a matching word ('Solid 397409098')"),
              std::string::npos)
        << drawn.err;
    const std::string svg = readText(folder / "plan.svg");
    EXPECT_EQ(svg.find("id=\"glass\""), std::string::npos);
    EXPECT_EQ(svg.find("id=\"steel\""), std::string::npos);
}

TEST(Materials, OfLayersHaveTheirOwnHatches) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", house().text());
    auto uses = hatchesOf(folder.path(), {"--layers"});
    EXPECT_EQ(uses["Brick, Common"].hatch, "masonry");
    EXPECT_EQ(uses["Fiberglass Batt"].hatch, "insulation");
    EXPECT_EQ(uses["Metal Stud Layer"].hatch, "general");
}

TEST(Materials, OfTheUserComeFirst) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", house().text());
    writeText(folder / "own.csv", "hatch,loadBearing,words\nearth,yes,solid|*wunder\n");
    for (const char* command : {"section", "sheets"}) {
        const bool isSection = std::string(command) == "section";
        std::vector<std::string> arguments{command, "house.ifc", "--spacing", "0.1", "--materials", "own.csv"};
        if (isSection)
            arguments.insert(arguments.end(), {"-o", "plan.svg", "--plane", "z=1.1"});
        else
            arguments.insert(arguments.end(), {"--svg", "sheets"});
        const CommandResult drawn = runSvt(folder.path(), arguments);
        EXPECT_EQ(drawn.exitCode, kDone) << drawn.toString();
        EXPECT_EQ(drawn.err.find("are assumed"), std::string::npos) << drawn.err;
        const std::string svg = readText(folder / (isSection ? "plan.svg" : "sheets/sheet-1.svg"));
        EXPECT_NE(svg.find("earth"), std::string::npos);
    }
    auto uses = hatchesOf(folder.path(), {"--materials", "own.csv"});
    EXPECT_EQ(uses["Poroton-T7-Wunder"].hatch, "earth");
    EXPECT_EQ(uses["Solid 397409098"].hatch, "earth");
    EXPECT_EQ(uses["Brick, Common"].hatch, "masonry");
    writeText(folder / "bad.csv", "hatch,loadBearing,words\nclay,yes,solid\n");
    const CommandResult bad =
        runSvt(folder.path(), {"section", "house.ifc", "-o", "plan.svg", "--materials", "bad.csv"});
    EXPECT_EQ(bad.exitCode, kInput);
    EXPECT_NE(bad.err.find("bad.csv:2: materials: unknown hatch 'clay'"), std::string::npos) << bad.err;
}

// A storey whose room has a post in it, a table, and a stated area.
TEST(Areas, HaveOneNumberInStampScheduleAndCsv) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {6.007, 5.003, 2.8});
    ifc.box("SPACE", "room", storey, {0.3, 0.3, 0}, {5.707, 4.703, 2.8});
    ifc.box("COLUMN", "post", storey, {2, 2, 0}, {2.31, 2.31, 2.8});
    ifc.box("FURNITURE", "table", storey, {4, 2, 0.9}, {5.2, 3, 1.2});
    writeText(folder / "room.ifc", ifc.text());
    const std::string area = "23.81";  // 5.407 m x 4.403 m
    runSvtWell(folder.path(), {"section", "room.ifc", "--spacing", "0.1", "-o", "plan.svg", "--plane", "z=1.1"});
    EXPECT_NE(readText(folder / "plan.svg").find(">" + area + " m\u00B2<"), std::string::npos) << "stamp";
    runSvtWell(folder.path(), {"section", "room.ifc", "--spacing", "0.1", "-o", "plan.dxf", "--plane", "z=1.1"});
    EXPECT_NE(readText(folder / "plan.dxf").find("\n" + area + " m"), std::string::npos) << "stamp of DXF";
    runSvtWell(folder.path(), {"sheets", "room.ifc", "--spacing", "0.1", "--svg", "sheets"});
    std::string sheets;
    for (int n = 1; fs::exists(folder / "sheets" / ("sheet-" + std::to_string(n) + ".svg")); ++n)
        sheets += readText(folder / "sheets" / ("sheet-" + std::to_string(n) + ".svg"));
    EXPECT_NE(sheets.find(">" + area + " m\u00B2<"), std::string::npos) << "stamp";
    EXPECT_NE(sheets.find(">" + area + "<"), std::string::npos) << "schedule";
    for (const char* spacing : {"0.1", "0.23"}) {
        const auto rows =
            runSvtForJson(folder.path(), {"query", "room.ifc", "all", "--areas", "--spacing", spacing, "--json"});
        EXPECT_NEAR(rows[0].at("area").get<double>(), 5.407 * 4.403, 1e-4);
        EXPECT_TRUE(rows[0].at("statedArea").is_null());
        EXPECT_TRUE(rows[0].at("exact").get<bool>());
    }
}

}  // namespace
}  // namespace svt::test
