// Revision clouds and tables in drawings of a volume that compares two states.
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace svt::test {
namespace {

using nlohmann::json;

class Revisions : public ::testing::Test {
protected:
    // Seed 3 cuts a hole, seed 6 edits several pieces of furniture.
    void compareHouse(const std::string& seed) {
        runSvtWell(folder.path(), {"sample", "house", "-o", "old.gml"});
        runSvtWell(folder.path(),
                   {"sample", "house", "-o", "new.gml", "--change", seed, "--change-list", "known.json"});
        const CommandResult result =
            runSvt(folder.path(), {"diff", "old.gml", "new.gml", "--spacing", "0.2", "--tolerance", "0.002",
                                   "--properties", "none", "-q", "-o", "changes.svt"});
        ASSERT_EQ(result.exitCode, 7) << result.toString();
    }
    // The numbers that the clouds of a drawing refer to.
    static std::set<int> numbersOf(const std::string& svg) {
        std::set<int> numbers;
        const std::regex cloud("class=\"revision\" data-revisions=\"([0-9 ]+)\"");
        for (std::sregex_iterator at(svg.begin(), svg.end(), cloud), end; at != end; ++at) {
            std::istringstream list((*at)[1].str());
            for (int number = 0; list >> number;) numbers.insert(number);
        }
        return numbers;
    }
    [[nodiscard]] std::string sheetsText() const {
        std::string all;
        for (int n = 1; std::filesystem::exists(folder / "sheets" / ("sheet-" + std::to_string(n) + ".svg")); ++n)
            all += readText(folder / "sheets" / ("sheet-" + std::to_string(n) + ".svg"));
        return all;
    }
    TemporaryFolder folder;
};

std::size_t revisionMarkCount(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST_F(Revisions, AreOnSheetsOfADifferenceVolume) {
    compareHouse("6");
    const json known = json::parse(readText(folder / "known.json"));
    std::size_t ofSpace = 0;
    for (const json& row : known["rows"]) ofSpace += row["edit"] != "reclass" && row["edit"] != "rename" ? 1 : 0;
    ASSERT_GT(ofSpace, 0u);
    const CommandResult result =
        runSvt(folder.path(), {"sheets", "changes.svt", "--svg", "sheets", "--dxf", "dxf", "-o", "changes.pdf"});
    ASSERT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("the sheets show the new one with"), std::string::npos) << result.err;
    const std::string text = sheetsText();
    // As an ordinary plan: names of rooms, dimensions, the title block.
    for (const char* part : {"Living room", "Plan Ground floor", "Revisions", "Removed", "Change"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
    const std::string dxf = readText(folder / "dxf" / "plan-1.dxf");
    EXPECT_NE(dxf.find("REVISIONS"), std::string::npos);
    const CommandResult german =
        runSvt(folder.path(), {"sheets", "changes.svt", "--svg", "sheets", "--language", "de", "-q"});
    ASSERT_EQ(german.exitCode, 0) << german.toString();
    EXPECT_NE(sheetsText().find("\u00C4nderungen"), std::string::npos);
}

TEST_F(Revisions, AreInASectionOnRequest) {
    compareHouse("6");
    const std::vector<std::string> section{"section",     "changes.svt", "--plane", "storey=Ground floor+1.2",
                                           "--revisions", "--beyond",    "-o",      "plan.svg",
                                           "-o",          "plan.dxf",    "-o",      "plan.pdf"};
    const CommandResult result = runSvt(folder.path(), section);
    ASSERT_EQ(result.exitCode, 0) << result.toString();
    const std::string svg = readText(folder / "plan.svg");
    const std::set<int> numbers = numbersOf(svg);
    ASSERT_FALSE(numbers.empty());
    // Each number has a triangle, and a row in the table.
    EXPECT_EQ(revisionMarkCount(svg, "class=\"revision tag\""), numbers.size());
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), int(numbers.size()));
    EXPECT_NE(svg.find(">Revisions<"), std::string::npos);
    const std::string dxf = readText(folder / "plan.dxf");
    EXPECT_GT(revisionMarkCount(dxf, "\n 42\n0.6"), 4u) << "arcs of clouds";
    EXPECT_NE(dxf.find("revisions 1"), std::string::npos);
    // Without the option, the labels of the difference are drawn as before.
    runSvtWell(folder.path(), {"section", "changes.svt", "--plane", "z=1.2", "-o", "labels.svg"});
    EXPECT_TRUE(numbersOf(readText(folder / "labels.svg")).empty());
}

TEST_F(Revisions, NeedTwoStates) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.gml"});
    const CommandResult model = runSvt(folder.path(), {"section", "house.gml", "--revisions", "-o", "plan.svg"});
    EXPECT_EQ(model.exitCode, kUsage) << model.toString();
    EXPECT_NE(model.err.find("svt diff OLD NEW"), std::string::npos) << model.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "plan.svg"));
}

}  // namespace
}  // namespace svt::test
