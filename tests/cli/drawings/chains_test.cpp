// Chains of dimensions of turned models, and of models of single trades.
#include <tests/cli/drawings/small_ifc.hpp>
#include <tests/cli/run_command.hpp>

#include <string>

namespace svt::test {
namespace {

// A house of 8 x 6 m whose placement on the map turns it by 37 degrees.
std::string turnedHouse() {
    SmallIfc ifc("(0.,1.)", "500000.,5400000.,0.,0.8,0.6,1.", "Local grid");
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {8, 6, 3});
    ifc.box("SPACE", "Hall", storey, {0.3, 0.3, 0}, {7.7, 5.7, 2.8});
    return ifc.text();
}

// Eleven studs or columns in a row, 5 m long.
std::string rowOfParts(const char* type) {
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, "0.");
    for (int n = 0; n <= 10; ++n) ifc.box(type, "part", storey, {0.49 * n, 0, 0}, {0.49 * n + 0.1, 0.2, 2.5});
    return ifc.text();
}

CommandResult chainSheets(const TemporaryFolder& folder, const std::string& ifc, std::vector<std::string> more = {}) {
    writeText(folder / "model.ifc", ifc);
    std::vector<std::string> arguments{"sheets", "model.ifc", "--spacing", "0.1", "--svg", "s"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CommandResult result = runSvt(folder.path(), arguments);
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    return result;
}

TEST(Chains, ATurnedHouseIsDrawnAndMeasuredAlongItsWalls) {
    const TemporaryFolder folder;
    const CommandResult drawn = chainSheets(folder, turnedHouse());
    EXPECT_NE(drawn.err.find("the sheets follow its walls"), std::string::npos) << drawn.err;
    EXPECT_EQ(drawn.err.find("no chains"), std::string::npos) << drawn.err;
    const std::string plan = readText(folder / "s" / "sheet-1.svg");
    EXPECT_NE(plan.find(">8.00<"), std::string::npos);
    EXPECT_NE(plan.find(">6.00<"), std::string::npos);
    EXPECT_NE(plan.find(">7.40<"), std::string::npos) << "the room between its walls";
}

// Before, its plan had the lengths of the rectangle around it: 10.00 and 9.60 m.
TEST(Chains, ATurnedHouseInTheAxesOfTheMapHasNone) {
    const TemporaryFolder folder;
    const CommandResult drawn = chainSheets(folder, turnedHouse(), {"--no-turn"});
    EXPECT_NE(drawn.err.find("have no chains of dimensions, because their walls are turned"), std::string::npos)
        << drawn.err;
    EXPECT_NE(drawn.err.find("--axes building"), std::string::npos) << drawn.err;
    const std::string plan = readText(folder / "s" / "sheet-1.svg");
    EXPECT_EQ(plan.find(">10.00<"), std::string::npos);
    EXPECT_EQ(plan.find(">9.60<"), std::string::npos);
}

TEST(Chains, StudsAreNotMeasuredAndColumnsAre) {
    const TemporaryFolder folder;
    const CommandResult studs = chainSheets(folder, rowOfParts("MEMBER"));
    EXPECT_NE(studs.err.find("because they cut no wall, slab, roof or column"), std::string::npos) << studs.err;
    EXPECT_EQ(readText(folder / "s" / "sheet-1.svg").find(">5.00<"), std::string::npos);
    const CommandResult columns = chainSheets(folder, rowOfParts("COLUMN"));
    EXPECT_EQ(columns.err.find("no chains"), std::string::npos) << columns.err;
    EXPECT_NE(readText(folder / "s" / "sheet-1.svg").find(">5.00<"), std::string::npos);
}

// Before, the table had the classes of the file.
TEST(ComponentTable, HasWordsInTheLanguageOfTheSheets) {
    const TemporaryFolder folder;
    for (const auto& [language, word] : {std::pair("en", ">Wall<"), std::pair("de", ">Wand<")}) {
        chainSheets(folder, turnedHouse(), {"--language", language});
        std::string text;
        for (int n = 1; std::filesystem::exists(folder / "s" / ("sheet-" + std::to_string(n) + ".svg")); ++n)
            text += readText(folder / "s" / ("sheet-" + std::to_string(n) + ".svg"));
        EXPECT_NE(text.find(word), std::string::npos) << language;
        EXPECT_EQ(text.find("IfcWall"), std::string::npos) << language;
        EXPECT_EQ(text.find("BuildingConstructiveElement"), std::string::npos) << language;
    }
}

}  // namespace
}  // namespace svt::test
