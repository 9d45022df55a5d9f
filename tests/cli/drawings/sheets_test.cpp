// `svt sheets`: PDF that other programs read, true to scale, and what it says where that is not possible.
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

bool hasPoppler() { return hasProgram("pdfinfo -v") && hasProgram("pdftotext -v"); }

TEST(Sheets, TheHouseHasPlansSectionsAndElevations) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.1");
    runSvtWell(folder.path(), {"sheets", "house.svt", "-o", "house.pdf", "--svg", "sheets"});
    runSvtWell(folder.path(), {"sheets", "house.svt", "-o", "again.pdf", "--threads", "1"});
    EXPECT_EQ(readText(folder / "house.pdf"), readText(folder / "again.pdf"));
    for (int n = 1; n <= 7; ++n) EXPECT_TRUE(fs::exists(folder / "sheets" / ("sheet-" + std::to_string(n) + ".svg")));
    EXPECT_FALSE(fs::exists(folder / "sheets" / "sheet-8.svg"));
    if (!hasPoppler()) GTEST_SKIP() << "no poppler";
    const std::string info = runShellWell(folder.path(), "pdfinfo house.pdf");
    EXPECT_TRUE(std::regex_search(info, std::regex("Pages: +7"))) << info;
    EXPECT_TRUE(std::regex_search(info, std::regex("Title: +Sample house"))) << info;
    EXPECT_TRUE(std::regex_search(info, std::regex("1190\\.55 x 841\\.89 pts \\(A3\\)"))) << info;
    const std::string text = runShellWell(folder.path(), "pdftotext house.pdf -");
    for (const char* part : {"Living room", "Plan Ground floor, level \u00B10.00", "Section A\u2013A",
                             "Elevation from the west", "1:100", "7 of 7", "Floor areas after DIN 277-1", "36\u2075"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
}

// How many pixels of the first page are darker than light fills; by poppler, which follows the layers that are shown at first.
std::size_t darkPixels(const fs::path& folder, const std::string& pdf) {
    runShellWell(folder, "pdftoppm -r 50 -gray -f 1 -l 1 -singlefile " + pdf + " page");
    const std::string picture = readText(folder / "page.pgm");
    std::istringstream head(picture);
    std::string kind;
    std::size_t width = 0, height = 0, most = 0;
    head >> kind >> width >> height >> most;
    const std::string pixels = picture.substr(picture.size() - width * height);
    return static_cast<std::size_t>(
        std::count_if(pixels.begin(), pixels.end(), [](char c) { return static_cast<unsigned char>(c) < 200; }));
}

// Each layer alone and none of them: the parts of the picture add up, nothing is outside of layers.
TEST(Sheets, PdfHasLayersThatAViewerSwitches) {
    if (!hasPoppler() || !hasProgram("qpdf --version")) GTEST_SKIP() << "no poppler or qpdf";
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    const std::vector<std::string> section{"section",  "house.gml", "-o",       "plan.pdf", "-o",
                                           "plan.svg", "--beyond",  "--hidden", "--above",  "--dimensions"};
    const auto drawn = runSvt(folder.path(), section);
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    if (drawn.err.find("the PDF has no layers") != std::string::npos) GTEST_SKIP() << "no libqpdf";
    runShellWell(folder.path(), "qpdf --check plan.pdf");
    runShellWell(folder.path(), "qpdf --qdf --object-streams=disable plan.pdf plain.pdf");
    const std::string plain = readText(folder / "plain.pdf"), off = "/OFF [\n      ]";
    const std::size_t at = plain.find(off);
    ASSERT_NE(at, std::string::npos);
    std::vector<std::pair<std::string, std::string>> layers;  // name and reference, in order
    const std::regex group("\n([0-9]+) 0 obj\n<<\n  /Name \\(([^)]*)\\)\n  /Type /OCG");
    for (std::sregex_iterator found(plain.begin(), plain.end(), group), end; found != end; ++found)
        layers.emplace_back((*found)[2], (*found)[1].str() + " 0 R");
    std::vector<std::string> names;
    for (const auto& [name, reference] : layers) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{"Cut", "Beyond: visible", "Beyond: hidden", "Beyond: above", "Outlines",
                                               "Names", "Dimensions", "Title"}));
    const auto darkWithout = [&](const auto& isOff) {
        std::string listed = "/OFF [";
        for (const auto& [name, reference] : layers)
            if (isOff(name)) listed += " " + reference;
        std::string changed = plain;
        writeText(folder / "changed.pdf", changed.replace(at, off.size(), listed + " ]"));
        runShellWell(folder.path(), "fix-qdf changed.pdf > fixed.pdf");
        return darkPixels(folder.path(), "fixed.pdf");
    };
    const std::size_t all = darkWithout([](const std::string&) { return false; });
    EXPECT_EQ(all, darkPixels(folder.path(), "plan.pdf"));
    EXPECT_EQ(darkWithout([](const std::string&) { return true; }), 0u);
    for (const std::string& name : names) {
        EXPECT_LT(darkWithout([&](const std::string& other) { return other == name; }), all) << name;
        EXPECT_GT(darkWithout([&](const std::string& other) { return other != name; }), 0u) << name;
    }
    const std::string text = runShellWell(folder.path(), "pdftotext plan.pdf -");
    EXPECT_NE(text.find("Living room"), std::string::npos) << text;
}

TEST(Sheets, WhatDoesNotFitIsRefusedWithWhatWould) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    const auto result =
        runSvt(folder.path(), {"sheets", "boxes.gml", "-o", "s.pdf", "--scale", "1:20", "--paper", "A4"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("is large enough"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "s.pdf"));
    const auto nothing = runSvt(folder.path(), {"sheets", "boxes.gml"});
    EXPECT_EQ(nothing.exitCode, 2);
    EXPECT_NE(nothing.err.find("give -o P.pdf, --svg DIR"), std::string::npos) << nothing.err;
}

TEST(Sheets, ASetThatWasWrittenGivesTheSameSheets) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    runSvtWell(folder.path(), {"sheets", "boxes.gml", "--svg", "a", "--dxf", "cad", "--write-sheets", "s.sheets.json"});
    runSvtWell(folder.path(), {"sheets", "boxes.gml", "--svg", "b", "--from", "s.sheets.json"});
    for (int n = 1; fs::exists(folder / "a" / ("sheet-" + std::to_string(n) + ".svg")); ++n) {
        const std::string name = "sheet-" + std::to_string(n) + ".svg";
        EXPECT_EQ(readText(folder / "a" / name), readText(folder / "b" / name)) << name;
    }
    EXPECT_TRUE(fs::exists(folder / "cad" / "plan-1.dxf"));
    EXPECT_TRUE(fs::exists(folder / "cad" / "elevation-west.dxf"));
    runSvtWell(folder.path(),
               {"sheets", "boxes.gml", "--svg", "c", "--from", "s.sheets.json", "--language", "de", "--paper", "A4"});
    EXPECT_NE(readText(folder / "c" / "sheet-1.svg").find(">Zeichnung<"), std::string::npos);
    EXPECT_NE(readText(folder / "c" / "sheet-1.svg").find("width=\"297mm\""), std::string::npos);
}

TEST(LineDrawings, AreWrittenAsSvgAndPdfTheSameEachTime) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    runSvtWell(folder.path(), {"render", "boxes.gml", "-o", "a.svg", "--section", "z=1"});
    runSvtWell(folder.path(), {"render", "boxes.gml", "-o", "b.svg", "--section", "z=1", "--threads", "1"});
    EXPECT_EQ(readText(folder / "a.svg"), readText(folder / "b.svg"));
    EXPECT_NE(readText(folder / "a.svg").find("inkscape:label=\"Beyond: visible\""), std::string::npos);
    const auto gl = runSvt(folder.path(), {"render", "boxes.gml", "-o", "c.svg", "--labels", "l.png"});
    EXPECT_EQ(gl.exitCode, 2);
    EXPECT_NE(gl.err.find("are for PNG"), std::string::npos) << gl.err;
}

// A model without rooms and storeys has a plan at half its height.
TEST(Sheets, BoxesWithoutStoreysHaveOnePlan) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    runSvtWell(folder.path(), {"sheets", "boxes.gml", "--svg", "s"});
    EXPECT_NE(readText(folder / "s" / "sheet-1.svg").find(">Plan at z = "), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "s" / "sheet-3.svg"));
}

TEST(Sheets, OfAnOpenShellAreDrawnAndSaySo) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    std::string model = readText(folder / "house.gml");
    const std::string name = "gml:id=\"house_wall_south_0_p";
    for (int polygon = 0; polygon < 10; ++polygon) {
        const std::size_t at = model.find(name + std::to_string(polygon) + "\"");
        if (at == std::string::npos) continue;
        const std::size_t begin = model.rfind('\n', at), end = model.find('\n', at);
        model.erase(begin, end - begin);  // as sed does with the line of the polygon
    }
    writeText(folder / "gap.gml", model);
    const CommandResult result = runSvt(folder.path(), {"sheets", "gap.gml", "--svg", "sheets"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    const std::string expected = "E508 DrawnByVoxels: gap.gml: 1 of ";
    const std::size_t found = result.err.find(expected);
    ASSERT_NE(found, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(expected, found + 1), std::string::npos) << "once for all views";
    EXPECT_NE(result.err.find("house_wall_south_0", found), std::string::npos);
}

}  // namespace
}  // namespace svt::test
