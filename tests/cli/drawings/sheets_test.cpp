// `svt sheets`: PDF that other programs read, true to scale, and what it says where that is not possible.
#include <tests/cli/drawings/small_ifc.hpp>
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

// Before, a scale of 1:50 on the default paper was an error.
TEST(Sheets, AScaleSelectsThePaper) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.1");
    const auto drawn = runSvt(folder.path(), {"sheets", "house.svt", "--svg", "s", "--scale", "1:50"});
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    EXPECT_NE(drawn.err.find("paper A2: the smallest on which all views fit at 1:50"), std::string::npos) << drawn.err;
    EXPECT_NE(readText(folder / "s" / "sheet-1.svg").find("width=\"594mm\""), std::string::npos);
    const auto never = runSvt(folder.path(), {"sheets", "house.svt", "-o", "s.pdf", "--scale", "1:5"});
    EXPECT_EQ(never.exitCode, 2);
    EXPECT_NE(never.err.find("do not fit onto any paper at 1:5"), std::string::npos) << never.err;
    EXPECT_NE(never.err.find("--hide"), std::string::npos) << never.err;
    EXPECT_FALSE(fs::exists(folder / "s.pdf"));
}

TEST(Sheets, TheTitleBlockAndTheScheduleAreFilled) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.ifc"});
    const auto drawn =
        runSvt(folder.path(), {"sheets", "house.ifc", "--svg", "s", "--schedule", "openings.csv", "--number", "A-100",
                               "--creator", "M. Smith", "--title", "Town hall", "--write-sheets", "s.sheets.json"});
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    EXPECT_NE(drawn.err.find("--approver, --issued, --owner"), std::string::npos) << drawn.err;
    const std::string sheet = readText(folder / "s" / "sheet-1.svg");
    for (const char* text : {">A-100-1<", ">M. Smith<", ">Town hall<", ">Materials<", ">Masonry<", ">Floor plan<"})
        EXPECT_NE(sheet.find(text), std::string::npos) << text;
    const std::string csv = readText(folder / "openings.csv");
    EXPECT_TRUE(csv.starts_with(
        "mark,kind,type,storey,overallWidth,overallHeight,measuredWidth,measuredHeight,clearWidth,sill,count,"))
        << csv;
    // The entrance door: 1.11 x 2.25 m, as stated and as measured.
    EXPECT_TRUE(std::regex_search(csv, std::regex("D[0-9]+,door,door,Ground floor,1\\.11,2\\.25,1\\.11,2\\.25,,0,1,")))
        << csv;
    EXPECT_TRUE(std::regex_search(sheet, std::regex(">D[0-9]+<")));
    EXPECT_TRUE(std::regex_search(sheet, std::regex(">W[0-9]+<")));
    runSvtWell(folder.path(), {"sheets", "house.ifc", "--svg", "again", "--from", "s.sheets.json"});
    EXPECT_EQ(readText(folder / "again" / "sheet-1.svg"), sheet);
}

// Model space in metres, and a layout in paper space; lines beyond the cut on layers of ISO 13567.
TEST(Sheets, DxfHasWidthsAndALayout) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.1");
    runSvtWell(folder.path(), {"sheets", "house.svt", "--dxf", "cad", "--scale", "1:100", "--iso-layers"});
    const std::string dxf = readText(folder / "cad" / "plan-1.dxf");
    for (const char* part : {"\nAcDbLayout\n  1\nA3 1 to 100\n", "\nVIEWPORT\n", "  3\nACAD_LAYOUT\n", "-VISIBLE-\n",
                             "\n370\n50\n", "Floor plan"})
        EXPECT_NE(dxf.find(part), std::string::npos) << part;
    EXPECT_EQ(dxf.find("BEYOND_"), std::string::npos);
    // Each handle once.
    std::vector<std::string> handles;
    for (std::size_t at = 0; (at = dxf.find("\n  5\n", at)) != std::string::npos; ++at)
        handles.push_back(dxf.substr(at + 5, dxf.find('\n', at + 5) - at - 5));
    std::sort(handles.begin(), handles.end());
    // The header repeats the next free one.
    EXPECT_EQ(std::adjacent_find(handles.begin(), handles.end()), handles.end());
    EXPECT_GT(handles.size(), 100u);
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

std::string houseAndTree() {
    return cityModel(building("house", solid(boxFaces(500000, 5400000, 100, 500008, 5400006, 103))) +
                     "<cityObjectMember><veg:SolitaryVegetationObject gml:id=\"tree\" "
                     "xmlns:veg=\"http://www.opengis.net/citygml/vegetation/2.0\"><veg:lod2Geometry>" +
                     solid(boxFaces(500080, 5400002, 100, 500081, 5400003, 105)) +
                     "</veg:lod2Geometry></veg:SolitaryVegetationObject></cityObjectMember>");
}

TEST(Sheets, ATreeFarAwayIsNeitherMeasuredNorDecidesTheScale) {
    const TemporaryFolder folder;
    writeText(folder / "garden.gml", houseAndTree());
    runSvtWell(folder.path(), {"sheets", "garden.gml", "--svg", "s", "--keep-far-features"});
    const std::string plan = readText(folder / "s" / "sheet-1.svg");
    EXPECT_NE(plan.find(">1:100<"), std::string::npos);
    EXPECT_NE(plan.find(">8.00<"), std::string::npos);
    EXPECT_NE(plan.find(">6.00<"), std::string::npos);
    EXPECT_EQ(plan.find(">81.00<"), std::string::npos);
    // Both sections cut the house, not the garden: their heights are there.
    const std::string sections = readText(folder / "s" / "sheet-2.svg");
    const std::size_t first = sections.find(">3.00<");
    ASSERT_NE(first, std::string::npos);
    EXPECT_NE(sections.find(">3.00<", first + 1), std::string::npos);
}

TEST(Sheets, ASmallPartFarAwayDecidesNoScaleAndIsNamed) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {8, 6, 3});
    ifc.box("BUILDINGELEMENTPROXY", "geo-reference", storey, {2, -45, 0}, {2.5, -44.5, 0.5});
    writeText(folder / "house.ifc", ifc.text());
    const auto drawn = runSvt(folder.path(), {"sheets", "house.ifc", "--spacing", "0.2", "--svg", "s"});
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    EXPECT_NE(readText(folder / "s" / "sheet-1.svg").find(">1:100<"), std::string::npos);
    EXPECT_NE(drawn.err.find("1 small parts stand away from the building and are not on the sheets: 'geo-reference'"),
              std::string::npos)
        << drawn.err;
}

TEST(Sheets, CharactersThatThePdfCannotShowAreReported) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    const std::vector<std::string> start{"sheets", "boxes.gml", "-o", "p.pdf", "--title"};
    const auto drawnAs = [&](const std::string& title) {
        std::vector<std::string> arguments = start;
        arguments.push_back(title);
        return runSvt(folder.path(), arguments);
    };
    const auto drawn = drawnAs("\U0010FFFD");  // of private use: no font has it
    if (drawn.err.find("E510") != std::string::npos) GTEST_SKIP() << "no cairo";
    ASSERT_EQ(drawn.exitCode, 0) << drawn.toString();
    EXPECT_NE(drawn.err.find("has the letters '\U0010FFFD'"), std::string::npos) << drawn.err;
    EXPECT_EQ(drawnAs("Town hall").err.find("has the letters"), std::string::npos);
}

TEST(Sheets, DimensionsHaveTheirUnit) {
    const TemporaryFolder folder;
    writeText(folder / "boxes.gml", twoBoxes());
    for (const auto& [unit, length] : {std::pair("mm", ">8000<"), std::pair("cm", ">800<"), std::pair("m", ">8.00<"),
                                       std::pair("m-cm", ">8.00<"), std::pair("ft-in", ">26&#39;-2 15/16")}) {
        runSvtWell(folder.path(), {"sheets", "boxes.gml", "--svg", unit, "--dimension-unit", unit});
        EXPECT_NE(readText(folder / unit / "sheet-1.svg").find(length), std::string::npos) << unit;
    }
    runSvtWell(folder.path(), {"section", "boxes.gml", "-o", "plan.svg", "--dimensions", "--dimension-unit", "cm"});
    EXPECT_NE(readText(folder / "plan.svg").find(">800<"), std::string::npos);
    // A set keeps its unit.
    runSvtWell(folder.path(), {"sheets", "boxes.gml", "--write-sheets", "s.sheets.json", "--dimension-unit", "mm"});
    runSvtWell(folder.path(), {"sheets", "boxes.gml", "--svg", "again", "--from", "s.sheets.json"});
    EXPECT_NE(readText(folder / "again" / "sheet-1.svg").find(">8000<"), std::string::npos);
    const auto unknown = runSvt(folder.path(), {"sheets", "boxes.gml", "--svg", "x", "--dimension-unit", "inch"});
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("ft-in"), std::string::npos) << unknown.err;
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
