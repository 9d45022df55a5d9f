// Reports of `svt query`: neighbours, rays, overlaps, gaps, parcels and owners, on models whose figures are known.
#include "run_command.hpp"
#include "small_model.hpp"

#include <svt/core/test_data_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace svt::test {
namespace {

using Keys = std::vector<std::string>;
using nlohmann::json;

// Two boxes of 4 x 6 x 3 m that share a wall.
class TwoBoxReports : public ::testing::Test {
protected:
    TwoBoxReports() {
        writeText(folder / "two.gml", twoBoxes());
        prepare(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.1"});
    }
    json report(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"query", "two.svt"});
        arguments.emplace_back("--json");
        return runSvtForJson(folder.path(), arguments);
    }
    TemporaryFolder folder;
};

TEST_F(TwoBoxReports, NeighboursShareAFaceAndMeetTheOutside) {
    const json rows = report({"id=left", "--neighbours"});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(keysOf(rows[0]), (Keys{"area", "class", "id", "name", "neighbour", "neighbourClass", "neighbourName"}));
    EXPECT_EQ(rows[0]["neighbour"], nullptr);
    EXPECT_EQ(rows[1]["neighbour"], "right");
    EXPECT_EQ(rows[1]["neighbourClass"], "Building");
    // 6 x 3 m; the outside has the other five sides.
    EXPECT_NEAR(rows[1]["area"].get<double>(), 18, 1e-6);
    EXPECT_NEAR(rows[0]["area"].get<double>(), 2 * 24 + 2 * 12 + 18, 1);
    // The neighbour reports the same for the wall between them.
    EXPECT_EQ(report({"id=right", "--neighbours"})[1]["area"], rows[1]["area"]);
}

// A building of boundary surfaces, without a solid: a box with RoofSurface, four WallSurface and GroundSurface.
std::string houseOfSurfaces(const std::string& id, const std::string& owner, double x, double width) {
    static constexpr const char* kClasses[] = {"Ground", "Roof", "Wall", "Wall", "Wall", "Wall"};
    std::string surfaces;
    // One face of solid() as a member.
    const auto member = [](const Face& face) {
        const std::string text = solid({face});
        const std::size_t begin = text.find("<gml:surfaceMember>"), end = text.find("</gml:CompositeSurface>");
        return text.substr(begin, end - begin);
    };
    const std::vector<Face> faces = boxFaces(x, 5400000, 100, x + width, 5400006, 103);
    for (std::size_t f = 0; f < faces.size(); ++f)
        surfaces += fmt::format(
            "<bldg:boundedBy><bldg:{0}Surface gml:id=\"{1}_{2}\"><bldg:lod2MultiSurface>"
            "<gml:MultiSurface>{3}</gml:MultiSurface></bldg:lod2MultiSurface>"
            "</bldg:{0}Surface></bldg:boundedBy>",
            kClasses[f], id, f, member(faces[f]));
    return fmt::format(
        "<cityObjectMember><bldg:Building gml:id=\"{}\"><gen:stringAttribute "
        "xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\" name=\"owner\"><gen:value>{}</gen:value>"
        "</gen:stringAttribute>{}</bldg:Building></cityObjectMember>",
        id, owner, surfaces);
}

// Three houses of 4, 5 and 7 x 6 x 3 m with space between them, of two owners.
class FaceSums : public ::testing::Test {
protected:
    FaceSums() {
        std::filesystem::create_directory(folder / "files");
        writeText(folder / "files/three.gml",
                  cityModel(houseOfSurfaces("a", "Ada", 500000, 4) + houseOfSurfaces("b", "Ada", 500006, 5) +
                            houseOfSurfaces("c", "Ben", 500013, 7)));
    }
    // The faces of a row; wall: without openings.
    static void expectFaces(const json& row, double roof, double wall) {
        EXPECT_NEAR(row["roofFaces"].get<double>(), roof, 1e-4) << row;
        EXPECT_NEAR(row["groundFaces"].get<double>(), roof, 1e-4) << row;
        EXPECT_NEAR(row["wallFaces"].get<double>(), wall, 1e-4) << row;
        EXPECT_TRUE(row["windowFaces"].is_null()) << row;
        EXPECT_TRUE(row["doorFaces"].is_null()) << row;
    }
    void expectSums(const std::string& input) {
        const auto ask = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.begin(), {"query", input});
            arguments.insert(arguments.end(), {"--with", "faces", "--json"});
            return runSvtForJson(folder.path(), arguments);
        };
        // Owners, of the buildings and of all their parts: each face counts once.
        for (const char* query : {"class=Building", "all"}) {
            const json owners = ask({query, "--by", "owner"});
            ASSERT_EQ(owners.size(), 2u) << owners;
            EXPECT_EQ(owners[0]["owner"], "Ada");
            expectFaces(owners[0], 24 + 30, 3 * (20 + 22));
            expectFaces(owners[1], 42, 3 * 26);
        }
        const json classes = ask({"all", "--by", "class"});
        for (const json& row : classes) {
            const bool isRoof = row["class"] == "RoofSurface";
            EXPECT_EQ(row["roofFaces"].is_null(), !isRoof) << row;
            if (isRoof) {
                EXPECT_NEAR(row["roofFaces"].get<double>(), 96, 1e-4);
            }
            if (row["class"] == "Building") {
                EXPECT_TRUE(row["wallFaces"].is_null()) << "they count with the walls";
            }
        }
        const json rows = ask({"id=b", "--sort", "volume"});
        ASSERT_EQ(rows.size(), 1u);
        expectFaces(rows[0], 30, 66);
    }
    TemporaryFolder folder;
};

TEST_F(FaceSums, CountEachFaceOnceByOwnerAndClass) {
    expectSums("files/three.gml");
    // The words of the table, and a file.
    const CommandResult text =
        runSvt(folder.path(), {"query", "files/three.gml", "all", "--by", "owner", "--with", "faces"});
    EXPECT_NE(text.out.find("roof m2"), std::string::npos) << text.toString();
    runSvtWell(folder.path(), {"query", "files/three.gml", "id=c", "-o", "c.csv", "--with", "faces"});
    EXPECT_NE(readText(folder / "c.csv").find("roofFaces"), std::string::npos);
    // Other columns of --with have no sums.
    for (const char* command : {"query", "quantities"}) {
        std::vector<std::string> arguments{command, "files/three.gml", "--by", "ownr"};
        if (std::string(command) == "query") arguments.insert(arguments.begin() + 2, "all");
        const CommandResult unknown = runSvt(folder.path(), arguments);
        EXPECT_NE(unknown.err.find("no feature of these sums has a value for 'ownr'"), std::string::npos)
            << unknown.toString();
    }
    EXPECT_EQ(runSvt(folder.path(), {"query", "files/three.gml", "all", "--by", "class", "--with", "surface"}).exitCode,
              2);
}

TEST_F(FaceSums, AreThoseOfCities) {
    runSvtWell(folder.path(), {"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
    runSvtWell(folder.path(), {"city", "run", "city", "-q"});
    expectSums("city");
}

TEST_F(FaceSums, AreUnknownWithoutMeshes) {
    runSvtWell(folder.path(), {"build", "files/three.gml", "-o", "none.svt", "--vectors", "none", "--spacing", "0.5"});
    const CommandResult none =
        runSvt(folder.path(), {"query", "none.svt", "all", "--by", "owner", "--with", "faces", "--json"});
    for (const json& row : none.json()) EXPECT_TRUE(row["roofFaces"].is_null() && row["wallFaces"].is_null()) << row;
    EXPECT_NE(none.err.find("18 features have no mesh"), std::string::npos) << none.toString();
}

// The frame of a window of the sample house: 6 cm wide, bars of 5 cm, 7 cm deep, two by two panes.
double frameArea(double width, double height) {
    const double across = width - 0.17, up = height - 0.17;
    return 2 * (width * height - across * up) + 0.07 * 2 * (width + height) + 0.07 * 4 * (across + up);
}

TEST(FaceSumsOfWindows, CountTheFrameAndNotItsPanes) {
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.gml"});
    const auto ask = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"query", "house.gml"});
        arguments.insert(arguments.end(), {"--spacing", "0.2", "--with", "faces", "--json"});
        return runSvtForJson(folder.path(), arguments);
    };
    const double terrace = frameArea(2.2, 2.3), dining = frameArea(1.8, 1.4);
    const std::string both = "under house_window_terrace or under house_window_dining";
    for (const char* key : {"class", "storey"}) {
        const json rows = ask({both, "--by", key});
        ASSERT_EQ(rows.size(), 1u) << rows;
        EXPECT_NEAR(rows[0]["windowFaces"].get<double>(), terrace + dining, 1e-4) << rows;
        EXPECT_TRUE(rows[0]["roofFaces"].is_null());
    }
    EXPECT_EQ(ask({both, "--by", "storey"})[0]["storey"], "Ground floor");
    // The sum of the storeys is that of all windows. The building has these, without their surfaces in rooms.
    const auto sumOf = [](const json& rows) {
        double sum = 0;
        for (const json& row : rows) sum += row["windowFaces"].get<double>();
        return sum;
    };
    double ofWindows = 0;
    for (const json& row : ask({"class=Window"})) ofWindows += row["faces"]["window"].get<double>();
    EXPECT_NEAR(sumOf(ask({"class=Window", "--by", "storey"})), ofWindows, 1e-6);
    const json classes = ask({"class=Window or class=WindowSurface", "--by", "class"});
    ASSERT_EQ(classes.size(), 2u);
    EXPECT_GT(sumOf(classes), ofWindows + 1);
    EXPECT_NEAR(ask({"class=Building"})[0]["faces"]["window"].get<double>(), ofWindows, 1e-6);
    EXPECT_NEAR(ask({"class=Building", "--by", "class"})[0]["windowFaces"].get<double>(), ofWindows, 1e-6);
}

TEST(FeatureRows, LeaveUnknownMeasuresEmpty) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.4");
    const auto ask = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"query", "house.svt", "all"});
        return runSvt(folder.path(), more);
    };
    const json rows = ask({"--sort", "height", "--first", "5000", "--json"}).json();
    int sheets = 0, unseen = 0;
    for (const json& row : rows) {
        if (row["filling"] == "surface") {
            ++sheets;
            EXPECT_TRUE(row["volume"].is_null()) << row;
        }
        const bool hasVoxels = row["voxels"] != 0;
        unseen += hasVoxels ? 0 : 1;
        for (const char* key : {"area", "height", "lowest", "highest"}) EXPECT_NE(row[key].is_null(), hasVoxels) << row;
    }
    EXPECT_GT(sheets, 0);
    EXPECT_GT(unseen, 0);

    const CommandResult sums = ask({"--by", "class", "--json"});
    for (const json& sum : sums.json()) {
        EXPECT_FALSE(sum["class"] == "BuildingRoom" && sum["volume"].is_null()) << sum;
        EXPECT_FALSE(sum["volume"] == 0 || sum["area"] == 0) << sum;
    }
    EXPECT_NE(sums.err.find("the sums of volume exclude"), std::string::npos) << sums.err;
    EXPECT_NE(sums.err.find("the sums of area exclude"), std::string::npos) << sums.err;
}

TEST(FeatureRows, AreAsManyAsAreReported) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.4");
    const std::string printed =
        runSvtWell(folder.path(), {"query", "house.svt", "all", "--sort", "volume", "--first", "3", "-o", "rows.csv"});
    EXPECT_EQ(printed, "rows.csv: 3 features\n");
    const std::string written = readText(folder / "rows.csv");
    EXPECT_EQ(std::count(written.begin(), written.end(), '\n'), 4) << written;
}

TEST_F(TwoBoxReports, WithAddsColumns) {
    const json rows = report({"id=right", "--with", "surface,box,volume"});
    ASSERT_EQ(rows.size(), 1u);
    const json &total = rows[0]["totalSurface"], &own = rows[0]["ownSurface"];
    EXPECT_EQ(keysOf(total), (Keys{"area", "outside"}));
    EXPECT_NEAR(total["area"].get<double>(), 108, 0.03 * 108);
    EXPECT_NEAR(total["area"].get<double>() - total["outside"].get<double>(), 18, 1e-6);
    EXPECT_NEAR(rows[0]["totalBox"]["min"][0].get<double>(), 500004, 0.0501);
    EXPECT_NEAR(rows[0]["totalBox"]["max"][2].get<double>(), 103, 0.0501);
    // A leaf is its own voxels. The old names are those of its own voxels.
    EXPECT_NEAR(own["area"].get<double>(), total["area"].get<double>(), 1e-9);
    EXPECT_EQ(rows[0]["surface"], own);
    EXPECT_EQ(rows[0]["box"], rows[0]["totalBox"]);
    const std::string csv = runSvtWell(folder.path(), {"query", "two.svt", "id=right", "--with", "volume", "--csv"});
    EXPECT_EQ(
        csv.substr(0, csv.find('\n')),
        "id,class,name,ownVolume,totalVolume,ownVoxels,totalVoxels,solidVolume,countedVolume,filling,volume,voxels,"
        "voxelVolume,volumeBound,volumeSource");
    const CommandResult wrong = runSvt(folder.path(), {"query", "two.svt", "all", "--with", "volume,surfaces"});
    EXPECT_EQ(wrong.exitCode, 2);
    EXPECT_NE(wrong.err.find("'surfaces'"), std::string::npos) << wrong.toString();
}

TEST_F(TwoBoxReports, ARayMeetsOneAfterTheOther) {
    const json rows = report({"all", "--along", "-2,3,1.5:1,0,0"});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(keysOf(rows[0]), (Keys{"class", "enter", "id", "leave", "length", "name"}));
    EXPECT_EQ(rows[0]["id"], "left");
    EXPECT_NEAR(rows[0]["enter"].get<double>(), 2, 0.0501);
    EXPECT_NEAR(rows[0]["leave"].get<double>(), 6, 0.0501);
    EXPECT_EQ(rows[1]["enter"], rows[0]["leave"]);
    EXPECT_EQ(report({"id=right", "--along", "-2,3,1.5:1,0,0"}).size(), 1u);
    for (const char* ray : {"1,2,3", "0,0,0:0,0,0", "0,0,9:1,0,0"})
        EXPECT_EQ(runSvt(folder.path(), {"query", "two.svt", "all", "--along", ray}).exitCode, 2) << ray;
}

TEST_F(TwoBoxReports, ParcelsDivideThem) {
    // A border at y = 2; the parcels extend far beyond the houses; x > 6 belongs to no parcel.
    writeText(folder / "parcels.gml",
              cityModel(building("south", solid(boxFaces(499990, 5399990, 90, 500006, 5400002, 120))) +
                        building("north", solid(boxFaces(499990, 5400002, 90, 500006, 5400030, 120)))));
    const json rows = report({"all", "--parcels", "parcels.gml"});
    std::map<std::string, json> byPair;
    for (const json& row : rows)
        byPair[row["id"].get<std::string>() + " " +
               (row["parcel"].is_null() ? "-" : row["parcel"].get<std::string>())] = row;
    ASSERT_EQ(byPair.size(), 5u);
    EXPECT_EQ(keysOf(rows[0]), (Keys{"class", "id", "name", "parcel", "parcelClass", "parcelName", "part", "volume",
                                     "volumeBound", "volumeSource", "voxels"}));
    for (const auto& [pair, row] : byPair) EXPECT_EQ(row["volumeSource"], "meshes") << pair;
    EXPECT_NEAR(byPair["left south"]["part"].get<double>(), 2.0 / 6, 1e-5);
    EXPECT_NEAR(byPair["left north"]["part"].get<double>(), 4.0 / 6, 1e-5);
    EXPECT_NEAR(byPair["right -"]["part"].get<double>(), 0.5, 1e-5);
    EXPECT_NEAR(byPair["right south"]["part"].get<double>(), 1.0 / 6, 1e-5);
    EXPECT_NEAR(byPair["left south"]["volume"].get<double>(), 24, 1e-4);
    // The same from a volume built on the same grid; another grid is rejected with a message that states the remedy.
    (void)runSvtWell(folder.path(), {"build", "parcels.gml", "-o", "p.svt", "--grid-of", "two.svt"});
    EXPECT_EQ(report({"all", "--parcels", "p.svt"}), rows);
    (void)runSvtWell(folder.path(), {"build", "parcels.gml", "-o", "other.svt", "--spacing", "1"});
    const CommandResult refused = runSvt(folder.path(), {"query", "two.svt", "all", "--parcels", "other.svt"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.err.find("--grid-of"), std::string::npos) << refused.toString();
    EXPECT_EQ(runSvt(folder.path(), {"query", "two.svt", "all", "--parcels", "missing.svt"}).exitCode, 3);
}

TEST_F(TwoBoxReports, AGridOfAnotherVolumeIsTakenAsItIs) {
    (void)runSvtWell(folder.path(), {"build", "two.gml", "-o", "again.svt", "--grid-of", "two.svt"});
    EXPECT_EQ(readText(folder / "again.svt"), readText(folder / "two.svt"));
    const auto exitOf = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"build", "two.gml", "-o", "x.svt"});
        return runSvt(folder.path(), more).exitCode;
    };
    EXPECT_EQ(exitOf({"--grid-of", "two.svt", "--spacing", "1"}), 2);
    EXPECT_EQ(exitOf({"--grid-of", "missing.svt"}), 3);
    EXPECT_EQ(exitOf({"--grid-of", "two.gml"}), 3);
    writeText(folder / "far.gml", cityModel(building("far", solid(boxFaces(0, 0, 0, 5, 5, 5)))));
    const CommandResult far = runSvt(folder.path(), {"build", "far.gml", "-o", "x.svt", "--grid-of", "two.svt"});
    EXPECT_EQ(far.exitCode, 3);
    EXPECT_NE(far.err.find("E109"), std::string::npos) << far.toString();
}

TEST_F(TwoBoxReports, OneReportAtATimeAndOneFormat) {
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
             {"--neighbours", "--gaps"}, {"--overlaps", "--with", "box"}, {"--json", "--csv"}}) {
        std::vector<std::string> arguments{"query", "two.svt", "all"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, 2);
        EXPECT_EQ(result.out, "");
        EXPECT_NE(result.err.find("exclude each other"), std::string::npos) << result.toString();
    }
    const CommandResult nothing = runSvt(folder.path(), {"query", "two.svt", "id=lefft", "--neighbours"});
    EXPECT_EQ(nothing.exitCode, 0);
    EXPECT_NE(nothing.err.find("'left'"), std::string::npos) << nothing.toString();
}

TEST_F(TwoBoxReports, BadOwnersTablesSayWhere) {
    const auto errorOf = [&](const std::string& table, int exitCode) {
        writeText(folder / "owners.csv", table);
        const CommandResult result = runSvt(folder.path(), {"query", "two.svt", "all", "--owners", "owners.csv"});
        EXPECT_EQ(result.exitCode, exitCode) << table;
        return result.err;
    };
    EXPECT_NE(errorOf("left,Ada\nrigth,Bob\n", 2).find("owners.csv:2"), std::string::npos);
    EXPECT_NE(errorOf("left,Ada\nrigth,Bob\n", 2).find("'right'"), std::string::npos);
    EXPECT_NE(errorOf("left,Ada\nright\n", 3).find("owners.csv:2"), std::string::npos);
    EXPECT_NE(errorOf("", 3).find("no rows"), std::string::npos);
    EXPECT_EQ(runSvt(folder.path(), {"query", "two.svt", "all", "--owners", "missing.csv"}).exitCode, 3);
}

TEST(QueryReports, AHollowIsAGapAndOverlapsAreTold) {
    const TemporaryFolder folder;
    // Five slabs around a cavity of 2 x 2 x 2 m; the lid extends into the two side walls.
    const auto box = [](const char* id, double x0, double y0, double z0, double x1, double y1, double z1) {
        return building(id, solid(boxFaces(500000 + x0, 5400000 + y0, 100 + z0, 500000 + x1, 5400000 + y1, 100 + z1)));
    };
    writeText(folder / "hollow.gml", cityModel(box("floor", 0, 0, 0, 4, 4, 1) + box("west", 0, 0, 1, 1, 4, 3) +
                                               box("east", 3, 0, 1, 4, 4, 3) + box("south", 1, 0, 1, 3, 1, 3) +
                                               box("north", 1, 3, 1, 3, 4, 3) + box("lid", 0, 0, 2.5, 4, 4, 4)));
    (void)runSvtWell(folder.path(), {"build", "hollow.gml", "-o", "h.svt", "--spacing", "0.125"});
    const json gaps = runSvtForJson(folder.path(), {"query", "h.svt", "all", "--gaps", "--json"});
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(keysOf(gaps[0]), (Keys{"around", "maxX", "maxY", "maxZ", "minX", "minY", "minZ", "volume", "voxels"}));
    EXPECT_NEAR(gaps[0]["volume"].get<double>(), 2 * 2 * 1.5, 0.2 * 6);
    EXPECT_NEAR(gaps[0]["minX"].get<double>(), 500001, 0.13);
    EXPECT_EQ(gaps[0]["around"].size(), 6u);
    const json overlaps = runSvtForJson(folder.path(), {"query", "h.svt", "id=east", "--overlaps", "--json"});
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_EQ(keysOf(overlaps[0]),
              (Keys{"a", "aClass", "aName", "b", "bClass", "bName", "bound", "exact", "nested", "volume", "voxels"}));
    EXPECT_NEAR(overlaps[0]["volume"].get<double>(), 1 * 4 * 0.5, 1e-4);
    EXPECT_EQ(overlaps[0]["exact"], true);
    EXPECT_EQ(overlaps[0]["nested"], false);
    (void)runSvtWell(folder.path(), {"build", "hollow.gml", "-o", "v.svt", "--spacing", "0.125", "--vectors", "none"});
    const json byVoxels = runSvtForJson(folder.path(), {"query", "v.svt", "id=east", "--overlaps", "--json"});
    ASSERT_EQ(byVoxels.size(), 1u);
    EXPECT_NEAR(byVoxels[0]["volume"].get<double>(), 1 * 4 * 0.5, 0.3);
    EXPECT_EQ(byVoxels[0]["exact"], false);
    EXPECT_TRUE(byVoxels[0]["bound"].is_null());
}

TEST(QueryReports, OverlapsThinnerThanAVoxelAreTold) {
    const TemporaryFolder folder;
    // Two panes of 4 cm that stand twice, and a box that reaches 1 mm into another; samples are 0.2 m apart.
    const auto box = [](const char* id, double x0, double x1) {
        return building(id, solid(boxFaces(500000 + x0, 5400000, 100, 500000 + x1, 5400002, 102)));
    };
    writeText(folder / "thin.gml", cityModel(box("pane", 0.13, 0.17) + box("again", 0.13, 0.17) + box("left", 1, 3) +
                                             box("right", 2.999, 5) + box("beside", 5, 6)));
    (void)runSvtWell(folder.path(), {"build", "thin.gml", "-o", "thin.svt", "--spacing", "0.2"});
    const json overlaps = runSvtForJson(folder.path(), {"query", "thin.svt", "all", "--overlaps", "--json"});
    ASSERT_EQ(overlaps.size(), 2u);
    std::vector<double> volumes;
    for (const json& overlap : overlaps) {
        volumes.push_back(overlap["volume"].get<double>());
        EXPECT_LT(std::abs(overlap["bound"].get<double>()), 1e-4);
    }
    std::sort(volumes.begin(), volumes.end());
    EXPECT_NEAR(volumes[0], 0.001 * 2 * 2, 1e-4);
    EXPECT_NEAR(volumes[1], 0.04 * 2 * 2, 1e-4);
    // Without meshes they are unknown, and the command says so.
    (void)runSvtWell(folder.path(), {"build", "thin.gml", "-o", "voxels.svt", "--spacing", "0.2", "--vectors", "none"});
    const CommandResult voxels = runSvt(folder.path(), {"query", "voxels.svt", "all", "--overlaps", "--json"});
    EXPECT_NE(voxels.err.find("5 solids have no closed mesh"), std::string::npos) << voxels.toString();
}

TEST(QueryReports, ThePartyWallOfTheTowerIsHalfEachOnes) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "tower", "-o", "tower.gml", "--storeys", "1"});
    (void)runSvtWell(folder.path(), {"build", "tower.gml", "-o", "tower.svt", "--spacing", "0.06"});
    writeText(folder / "owners.csv", "feature,owner\ntower_S00_F1,Weber\ntower_S00_F2,\"Hoffmann, H.\"\n");
    const std::vector<std::string> query{"query", "tower.svt", "id=tower_S00_wall_party_south_1", "--owners",
                                         "owners.csv"};
    std::vector<std::string> asJson = query, asCsv = query;
    asJson.emplace_back("--json");
    asCsv.emplace_back("--csv");
    const json report = runSvtForJson(folder.path(), asJson);
    EXPECT_EQ(keysOf(report), (Keys{"all", "common", "components", "features", "owners", "sharedSpace", "unowned",
                                    "unownedSpaces", "untouched"}));
    double sum = report["unowned"].get<double>() + report["untouched"].get<double>();
    sum += report["unownedSpaces"].get<double>();
    for (const json& owner : report["owners"]) sum += owner["total"].get<double>();
    EXPECT_NEAR(sum, report["all"].get<double>(), 1e-6);
    double common = 0, features = 0;
    for (const json& row : report["common"]) common += row["total"].get<double>();
    for (const json& row : report["features"]) features += row["volume"].get<double>();
    EXPECT_NEAR(common + features, report["all"].get<double>(), 1e-6);
    ASSERT_EQ(report["owners"].size(), 2u);
    EXPECT_EQ(keysOf(report["owners"][0]), (Keys{"alone", "own", "owner", "shared", "total", "with"}));
    ASSERT_EQ(report["components"].size(), 1u);
    const json& wall = report["components"][0];
    EXPECT_EQ(keysOf(wall), (Keys{"class", "id", "name", "shares", "volume"}));
    // 0.24 x 7 x 2.84 m; its ends meet the exterior and the corridor wall.
    EXPECT_NEAR(wall["volume"].get<double>(), 0.24 * 7 * 2.84, 1e-6);
    ASSERT_EQ(wall["shares"].size(), 2u);
    for (const json& share : wall["shares"]) {
        EXPECT_NEAR(share["area"].get<double>(), 7 * 2.84, 0.04 * 7 * 2.84);
        EXPECT_NEAR(share["volume"].get<double>(), 0.12 * 7 * 2.84, 0.02 * 0.24 * 7 * 2.84);
    }
    // The own volume of a flat is its rooms and inner walls: the volume of the unit in the model, plus doors and
    // furniture.
    EXPECT_NEAR(report["owners"][0]["own"].get<double>(), 197.27, 0.02 * 197.27);
    const std::string csv = runSvtWell(folder.path(), asCsv);
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "id,class,name,owner,area,volume");
    EXPECT_NE(csv.find("\"Hoffmann, H.\""), std::string::npos) << csv;
}

TEST(QueryReports, AreTheSameForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    prepare(folder.path(), {"sample", "house", "-o", "house.gml", "--turn", "30"});
    (void)runSvtWell(folder.path(), {"build", "house.gml", "-o", "house.svt", "--spacing", "0.08"});
    const auto report = [&](const char* threads) {
        return runSvtWell(folder.path(), {"query", "house.svt", "all", "--neighbours", "--json", "--threads", threads});
    };
    const std::string one = report("1");
    EXPECT_GT(one.size(), 1000u);
    EXPECT_EQ(report("2"), one);
    EXPECT_EQ(report("7"), one);
}

TEST(QueryReports, TheRoomsOfTheFzkHausOwnTheirKnownVolume) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    const TemporaryFolder folder;
    (void)runSvtWell(folder.path(), {"build", model.string(), "-o", "f.svt", "--spacing", "0.02"});
    std::string table;
    for (const char* room : {"Schlafzimmer", "Bad", "Buero", "Wohnen", "Flur", "K\u00fcche", "Galerie"})
        table += fmt::format("\"name=\"\"{}\"\"\",owner of {}\n", room, room);
    writeText(folder / "owners.csv", table);
    const json report = runSvtForJson(folder.path(), {"query", "f.svt", "all", "--owners", "owners.csv", "--json"});
    double own = 0, all = report["unowned"].get<double>() + report["untouched"].get<double>(), shares = 0;
    for (const json& owner : report["owners"]) {
        own += owner["own"].get<double>();
        all += owner["total"].get<double>();
    }
    // Stairs, rafters and purlins are inside rooms.
    EXPECT_NEAR(own, 470.83, 0.004 * 470.83);
    for (const json& component : report["components"])
        for (const json& share : component["shares"]) shares += share["volume"].get<double>();
    EXPECT_NEAR(own + shares + report["untouched"].get<double>(), all, 1e-9 * all);
    const json known =
        runSvtForJson(folder.path(), {"query", "f.svt", "name=Bodenplatte", "--with", "surface", "--json"});
    // 12 x 10 x 0.2 m.
    EXPECT_NEAR(known[0]["totalSurface"]["area"].get<double>(), 248.8, 0.002 * 248.8);
    // The rooms of the ground floor touch it with their floors.
    const json neighbors =
        runSvtForJson(folder.path(), {"query", "f.svt", "name=Bodenplatte", "--neighbours", "--json"});
    double floors = 0, contacts = 0;
    for (const json& row : neighbors) {
        contacts += row["area"].get<double>();
        if (row["neighbourClass"] == "BuildingRoom") floors += row["area"].get<double>();
    }
    EXPECT_NEAR(contacts, known[0]["totalSurface"]["area"].get<double>(), 1e-9 * contacts);
    EXPECT_NEAR(floors, 101.33, 0.01 * 101.33);
}

}  // namespace
}  // namespace svt::test
