// Levels and north in plans, sections, areas and pictures: statements of the file, checked against its rooms and slabs.
#include <tests/cli/drawings/small_ifc.hpp>
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <fmt/format.h>

#include <map>
#include <regex>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

// Rows of `svt query --areas` of a kind.
std::vector<nlohmann::json> rowsOf(const fs::path& folder, const std::string& model, const std::string& kind) {
    std::vector<nlohmann::json> rows;
    for (const auto& row : runSvtForJson(folder, {"query", model, "all", "--areas", "--spacing", "0.2", "--json"}))
        if (row["kind"] == kind) rows.push_back(row);
    return rows;
}

// The sheets of a model as one text.
std::string sheetsOf(const fs::path& folder, const std::string& model) {
    runSvtWell(folder, {"sheets", model, "--spacing", "0.2", "--svg", "sheets", "--no-turn"});
    std::string text;
    for (int n = 1; fs::exists(folder / "sheets" / fmt::format("sheet-{}.svg", n)); ++n)
        text += readText(folder / "sheets" / fmt::format("sheet-{}.svg", n));
    return text;
}

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

// Areas of a section by the names of components.
std::map<std::string, double> areasOf(const fs::path& folder, const std::string& model, const std::string& plane) {
    std::map<std::string, double> areas;
    std::vector<std::string> arguments{"section", model, "--spacing", "0.2", "--json"};
    if (!plane.empty()) arguments.insert(arguments.end(), {"--plane", plane});
    const nlohmann::json section = runSvtForJson(folder, arguments);
    for (const auto& component : section["components"])
        areas[component["name"].get<std::string>()] += component["area"].get<double>();
    return areas;
}

// A hall of 59 rooms on level 0, and the pit of a lift 1.25 m below them. The slab fills the space around the pit.
SmallIfc hallWithPit(const std::string& elevation) {
    SmallIfc ifc;
    const int storey = ifc.storey("EG", 0, elevation);
    ifc.shell(storey, {0, 0, 0}, {60, 10, 3});
    for (int n = 0; n < 59; ++n)
        ifc.box("SPACE", fmt::format("room {}", n), storey, {n + 0.3, 0.3, 0}, {n + 1.3, 9.7, 2.8});
    ifc.box("SPACE", "lift", storey, {59.3, 0.3, -1.25}, {59.7, 3.3, 2.8});
    return ifc;
}

TEST(Levels, APitDoesNotMoveThePlan) {
    const TemporaryFolder folder;
    for (const char* elevation : {"0.", "$"}) {
        writeText(folder / "pit.ifc", hallWithPit(elevation).text());
        const auto storeys = rowsOf(folder.path(), "pit.ifc", "storey");
        ASSERT_EQ(storeys.size(), 1u);
        EXPECT_NEAR(storeys[0]["elevation"].get<double>(), 0, 1e-5);
        EXPECT_GT(storeys[0]["bgf"].get<double>(), storeys[0]["nrf"].get<double>());
        EXPECT_NEAR(areasOf(folder.path(), "pit.ifc", "storey=EG+1.1")["south wall"], 60 * 0.3, 1e-3);
        EXPECT_NEAR(areasOf(folder.path(), "pit.ifc", "")["south wall"], 60 * 0.3, 1e-3);
        const std::string sheets = sheetsOf(folder.path(), "pit.ifc");
        EXPECT_NE(sheets.find(">Plan EG, level \u00B10.00<"), std::string::npos);
        EXPECT_NE(sheets.find("Heights above EG: \u00B10.00 = 0.00 m"), std::string::npos);
        EXPECT_EQ(countOf(sheets, ">Plan "), 2u) << "caption and title of one plan";
    }
}

TEST(Levels, InCityGmlAPitIsNoStoreyOfItsOwn) {
    const TemporaryFolder folder;
    const auto room = [](const std::string& id, const std::vector<Face>& faces) {
        return fmt::format(
            "<bldg:interiorRoom><bldg:Room gml:id=\"{}\"><bldg:lod4Solid>{}</bldg:lod4Solid></bldg:Room>"
            "</bldg:interiorRoom>",
            id, solid(faces));
    };
    const double x = 500000, y = 5400000;
    writeText(folder / "pit.gml",
              cityModel(building("hall", solid(boxFaces(x, y, 98, x + 20, y + 10, 103)),
                                 room("hall_room", boxFaces(x + 0.3, y + 0.3, 100, x + 17, y + 9.7, 102.8)) +
                                     room("lift", boxFaces(x + 17.3, y + 0.3, 98.75, x + 19.7, y + 2.7, 102.8)))));
    const auto storeys = rowsOf(folder.path(), "pit.gml", "storey");
    ASSERT_EQ(storeys.size(), 1u);
    EXPECT_NEAR(storeys[0]["elevation"].get<double>(), 100, 1e-5);
    EXPECT_NEAR(storeys[0]["nrf"].get<double>(), 16.7 * 9.4 + 2.4 * 2.4, 1e-3);
}

// The storey has neither rooms nor an elevation; its placement is at 0. Its footing reaches 2 m down.
TEST(Levels, AFootingDoesNotMoveThePlan) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int storey = ifc.storey("Ground", 0, "$");
    ifc.box("FOOTING", "footing", storey, {0, 0, -2}, {10, 8, 0});
    ifc.box("WALL", "wall", storey, {0, 0, 0}, {10, 0.4, 3});
    writeText(folder / "footing.ifc", ifc.text());
    for (const char* plane : {"", "storey=Ground+1.1"}) {
        auto areas = areasOf(folder.path(), "footing.ifc", plane);
        EXPECT_EQ(areas.count("footing"), 0u) << plane;
        EXPECT_NEAR(areas["wall"], 4, 1e-4) << plane;
    }
}

// Without rooms, and on a map 100 m above the sea: the levels are those of the placements.
TEST(Levels, AreThoseOfTheMap) {
    const TemporaryFolder folder;
    SmallIfc ifc({}, "500000.,5400000.,100.,1.,0.,1.", "EPSG:25832");
    const int lower = ifc.storey("Level 1", 0, "0."), upper = ifc.storey("Level 2", 3, "3.");
    ifc.shell(lower, {0, 0, 0}, {10, 8, 2.7});
    ifc.shell(upper, {0, 0, 3}, {10, 8, 5.7});
    ifc.box("COLUMN", "column", upper, {4, 4, 5}, {4.2, 4.2, 5.7});
    writeText(folder / "map.ifc", ifc.text());
    const auto storeys = rowsOf(folder.path(), "map.ifc", "storey");
    ASSERT_EQ(storeys.size(), 2u);
    EXPECT_NEAR(storeys[0]["elevation"].get<double>(), 100, 1e-6);
    EXPECT_NEAR(storeys[1]["elevation"].get<double>(), 103, 1e-6);
    EXPECT_NEAR(areasOf(folder.path(), "map.ifc", "storey=Level 2+1.1")["south wall"], 3, 1e-4);
}

// House of Renga: the roof's eaves hang below the floor of level 2, whose rooms over the garage stand lower than others.
TEST(Levels, RoomsBelongToTheStoreyThatContainsThem) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int lower = ifc.storey("Level 1", -0.6, "-0.6"), upper = ifc.storey("Level 2", 2.85, "2.85"),
              roof = ifc.storey("Roof", 3.35, "3.35");
    ifc.shell(lower, {0, 0, 0}, {17, 9, 3.15});
    ifc.shell(upper, {0, 0, 3.45}, {17, 9, 6.5});
    ifc.box("SPACE", "living room", lower, {0.3, 0.3, 0}, {16.7, 8.7, 3.15});
    ifc.box("SPACE", "bedroom", upper, {0.3, 0.3, 3.45}, {10, 8.7, 6.5});
    ifc.box("SPACE", "room over the garage", upper, {10, 0.3, 2.6}, {16.7, 8.7, 5});
    ifc.box("ROOF", "roof", roof, {-0.5, -0.5, 2.2}, {17.5, 9.5, 8});
    writeText(folder / "house.ifc", ifc.text());
    std::map<std::string, std::string> storeyOf;
    for (const auto& row : rowsOf(folder.path(), "house.ifc", "room"))
        storeyOf[row["name"].get<std::string>()] = row["storey"].get<std::string>();
    EXPECT_EQ(storeyOf["living room"], "Level 1");
    EXPECT_EQ(storeyOf["bedroom"], "Level 2");
    EXPECT_EQ(storeyOf["room over the garage"], "Level 2");
    const auto result = runSvt(folder.path(), {"sheets", "house.ifc", "--spacing", "0.2", "--svg", "s"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    const std::string plans = sheetsOf(folder.path(), "house.ifc");
    EXPECT_NE(plans.find(">Plan Level 1, level \u00B10.00<"), std::string::npos);
    EXPECT_NE(plans.find(">Plan Level 2, level +3.45<"), std::string::npos);
    EXPECT_EQ(plans.find(">Plan Roof"), std::string::npos);
    // The declared levels lie 0.6 m below the floors of the rooms.
    EXPECT_NE(result.err.find("warning E512 StoreyLevelDiffers"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("'Level 2' declares the level 2.85 m, but most of its rooms stand at 3.45 m"),
              std::string::npos)
        << result.err;
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"section", "house.ifc", "--spacing", "0.2", "-o", "p.svg", "--plane",
                                   "storey=Level 2"},
          {"render", "house.ifc", "--spacing", "0.2", "-o", "p.png", "--size", "64x64", "--section",
           "storey=Level 2"}}) {
        const auto run = runSvt(folder.path(), command);
        EXPECT_EQ(run.exitCode, 0) << run.toString();
        EXPECT_NE(run.err.find("E512"), std::string::npos) << run.err;
    }
}

SmallIfc houseOf(SmallIfc ifc) {
    const int storey = ifc.storey("EG", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {10, 8, 2.7});
    ifc.box("DOOR", "door", storey, {9.7, 3, 0}, {10.05, 4, 2});
    ifc.box("SPACE", "room", storey, {0.3, 0.3, 0}, {9.7, 7.7, 2.7});
    return ifc;
}

// The letter of the north arrow on the first sheet, from the middle of its circle; y downwards.
std::pair<double, double> arrowOf(const std::string& sheet) {
    // The letter N stands 3 mm beyond the tip of the arrow, whose circle has a radius of 7 mm.
    const std::regex letter("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"[^>]*>N</text>");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(sheet, found, letter)) << "no north arrow";
    if (found.empty()) return {};
    // On A3, the circle is 18 mm left of the title block and 18 mm above the frame; the baseline is 1.1 mm lower.
    return {std::stod(found[1]) - (410 - 180 - 18), std::stod(found[2]) - 1.1 - (287 - 18)};
}

TEST(North, ArrowsAndElevationsFollowTrueNorth) {
    const TemporaryFolder folder;
    // As in the FZK-Haus: true north is 50 degrees clockwise from the y axis.
    writeText(folder / "north.ifc", houseOf(SmallIfc("(0.766044443,0.64278761)")).text());
    const std::string sheets = sheetsOf(folder.path(), "north.ifc");
    for (const char* side : {"north-east", "south-east", "south-west", "north-west"})
        EXPECT_NE(sheets.find(fmt::format(">Elevation from the {}<", side)), std::string::npos) << side;
    EXPECT_EQ(sheets.find(">Elevation from the north<"), std::string::npos);
    EXPECT_EQ(sheets.find(">assumed: +y<"), std::string::npos);
    const auto [right, down] = arrowOf(sheets);
    EXPECT_NEAR(right, 10 * 0.766, 0.02);
    EXPECT_NEAR(down, -10 * 0.643, 0.02);
    // The side to +x, whose azimuth is 40 degrees, is the nearest to north.
    runSvtWell(folder.path(), {"section", "north.ifc", "--spacing", "0.2", "-o", "n.svg", "--elevation", "north"});
    runSvtWell(folder.path(), {"section", "north.ifc", "--spacing", "0.2", "-o", "ne.svg", "-o", "ne.geojson",
                               "--elevation", "north-east"});
    EXPECT_EQ(readText(folder / "n.svg"), readText(folder / "ne.svg"));
    EXPECT_NE(readText(folder / "n.svg").find("Elevation from the north-east"), std::string::npos);
    const auto drawn = nlohmann::json::parse(readText(folder / "ne.geojson"));
    EXPECT_NEAR(drawn["plane"]["normal"][0].get<double>(), 1, 1e-9);
}

TEST(North, IsAssumedWhereTheFileStatesNone) {
    const TemporaryFolder folder;
    writeText(folder / "house.ifc", houseOf(SmallIfc()).text());
    const std::string sheets = sheetsOf(folder.path(), "house.ifc");
    EXPECT_NE(sheets.find(">assumed: +y<"), std::string::npos);
    EXPECT_NE(sheets.find(">Elevation from the north<"), std::string::npos);
}

// The conversion turns the x axis of the project to the north-east of the map. The CRS has no code, so the file's true
// north counts: along the y axis of the project, 45 degrees counter-clockwise on the map.
TEST(North, TurnsWithTheMapConversion) {
    const TemporaryFolder folder;
    writeText(folder / "turned.ifc",
              houseOf(SmallIfc("(0.,1.)", "500000.,5400000.,0.,0.707106781,0.707106781,1.", "Local grid")).text());
    const std::string sheets = sheetsOf(folder.path(), "turned.ifc");
    const auto [right, down] = arrowOf(sheets);
    EXPECT_NEAR(right, -10 * 0.7071, 0.02);
    EXPECT_NEAR(down, -10 * 0.7071, 0.02);
}

// Far west of its meridian, the map's grid north lies west of true north.
TEST(North, GridNorthIsShownBesideTrueNorth) {
    const TemporaryFolder folder;
    writeText(folder / "map.ifc", houseOf(SmallIfc({}, "300000.,5400000.,0.,1.,0.,1.", "EPSG:25832")).text());
    const std::string sheets = sheetsOf(folder.path(), "map.ifc");
    EXPECT_TRUE(std::regex_search(sheets, std::regex(">grid north 2\\.[0-9]\u00B0 W<")));
    const auto [right, down] = arrowOf(sheets);
    EXPECT_GT(right, 0.2);
    EXPECT_LT(down, -9.9);
}

TEST(Levels, TheZeroLevelIsTheGroundFloor) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int cellar = ifc.storey("Keller", -2.8, "-2.8"), ground = ifc.storey("Erdgeschoss", 0, "0.");
    ifc.shell(cellar, {0, 0, -2.8}, {10, 8, -0.3});
    ifc.shell(ground, {0, 0, 0}, {10, 8, 2.7});
    ifc.box("SPACE", "store", cellar, {0.3, 0.3, -2.8}, {9.7, 7.7, -0.3});
    ifc.box("SPACE", "kitchen", ground, {0.3, 0.3, 0}, {6, 7.7, 2.7});
    ifc.box("SPACE", "bath", ground, {6, 0.3, 0.02}, {9.7, 4, 2.7});
    ifc.box("SPACE", "hall", ground, {6, 4, 0}, {9.7, 7.7, 2.7});
    writeText(folder / "cellar.ifc", ifc.text());
    EXPECT_EQ(areasOf(folder.path(), "cellar.ifc", "").count("kitchen"), 1u)
        << "the default plan is that of the ground";
    const std::string sheets = sheetsOf(folder.path(), "cellar.ifc");
    EXPECT_NE(sheets.find(">Plan Keller, level \u22122.80<"), std::string::npos);
    EXPECT_NE(sheets.find(">Plan Erdgeschoss, level \u00B10.00<"), std::string::npos);
    EXPECT_NE(sheets.find("Heights above Erdgeschoss: \u00B10.00 = 0.00 m"), std::string::npos);
    // Finished floors: once for the rooms that share one, and in the bath that has another.
    EXPECT_EQ(countOf(sheets, ">\u25BD \u22122.80<"), 1u);
    EXPECT_EQ(countOf(sheets, ">\u25BD \u00B10.00<"), 1u);
    EXPECT_EQ(countOf(sheets, ">\u25BD +0.02<"), 1u);
    // Names of storeys stand at their floors in sections: the lines of name and height are equally high.
    const std::string sections = readText(folder / "sheets" / "sheet-2.svg");
    const auto heightOf = [&](const std::string& text) {
        std::smatch found;
        const std::regex place("<text x=\"[-0-9.]+\" y=\"([-0-9.]+)\"[^>]*>" + text + "</text>");
        return std::regex_search(sections, found, place) ? std::stod(found[1]) : -1.0;
    };
    EXPECT_GT(heightOf("Erdgeschoss"), 0) << sections.substr(0, 200);
    EXPECT_NEAR(heightOf("Erdgeschoss"), heightOf("\u00B10.00"), 1e-6);
    EXPECT_NEAR(heightOf("Keller"), heightOf("\u22122.80"), 1e-6);
}

// The authors of small models put all floors into one storey.
TEST(Levels, RoomsOnTwoFloorsOfOneStoreyHaveAPlanEach) {
    const TemporaryFolder folder;
    SmallIfc ifc;
    const int storey = ifc.storey("Default storey", 0, "0.");
    ifc.shell(storey, {0, 0, 0}, {8, 6, 2.8});
    ifc.shell(storey, {0, 0, 3.1}, {8, 6, 5.9});
    ifc.box("SPACE", "living room", storey, {0.3, 0.3, 0}, {7.7, 5.7, 2.8});
    ifc.box("SPACE", "bedroom", storey, {0.3, 0.3, 3.1}, {7.7, 5.7, 5.9});
    writeText(folder / "house.ifc", ifc.text());
    const std::string sheets = sheetsOf(folder.path(), "house.ifc");
    EXPECT_GE(countOf(sheets, ">Plan Default storey, level \u00B10.00<"), 1u);
    EXPECT_GE(countOf(sheets, ">Plan Default storey, level +3.10<"), 1u);
    const auto storeys = rowsOf(folder.path(), "house.ifc", "storey");
    ASSERT_EQ(storeys.size(), 2u);
    for (const auto& row : storeys) {
        EXPECT_NEAR(row["nrf"].get<double>(), 7.4 * 5.4, 1e-3);
        EXPECT_NEAR(row["bgf"].get<double>(), 48, 0.05);
    }
    EXPECT_NE(runSvt(folder.path(), {"sheets", "house.ifc", "--spacing", "0.2", "--svg", "s"}).err.find("E512"),
              std::string::npos);
}

}  // namespace
}  // namespace svt::test
