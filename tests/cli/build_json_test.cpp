// Machine-readable output: the JSON of build, info, check and query, and the NRRD header.
#include "run_command.hpp"
#include "small_model.hpp"

#include <cmath>
#include <map>
#include <sstream>

namespace svt::test {
namespace {

using Keys = std::vector<std::string>;
using nlohmann::json;

// nlohmann::json sorts keys, so lists of keys are in alphabetical order here.
const json& byId(const json& objects, const std::string& id) {
    for (const json& object : objects)
        if (object.at("id") == id) return object;
    static const json none;
    ADD_FAILURE() << "no object " << id;
    return none;
}

class TwoBoxes : public ::testing::Test {
protected:
    TwoBoxes() { writeText(folder / "two.gml", twoBoxes()); }
    json build(std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"build", "two.gml", "-o", "two.svt", "--spacing", "0.5", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runSvtForJson(folder.path(), arguments);
    }
    TemporaryFolder folder;
};

TEST_F(TwoBoxes, BuildJsonHasItsKeysAndTheRightFigures) {
    const json built = build();
    EXPECT_EQ(keysOf(built),
              (Keys{"bytes", "chosenSpacing", "closingMethods", "closures", "dimension", "objects", "open", "overlaps",
                    "seconds", "spacing", "tJunctions", "triangles", "uncertainVoxels", "warnings"}));
    EXPECT_EQ(keysOf(built["seconds"]), (Keys{"mesh", "pack", "read", "total", "voxelize", "write"}));
    EXPECT_EQ(keysOf(built["bytes"]), (Keys{"file", "memory"}));
    EXPECT_EQ(built["objects"], 2);
    EXPECT_EQ(built["triangles"], 24);
    EXPECT_EQ(built["open"], 0);
    EXPECT_EQ(built["closingMethods"]["closed"], 2);
    EXPECT_EQ(built["closingMethods"]["open"], 0);
    EXPECT_EQ(built["closures"], built["closingMethods"]);
    EXPECT_EQ(built["uncertainVoxels"], 0);
    EXPECT_EQ(built["tJunctions"], 0);
    EXPECT_EQ(built["warnings"], 0);
    EXPECT_EQ(built["dimension"].size(), 3u);
    EXPECT_EQ(built["spacing"], json::parse("[0.5, 0.5, 0.5]"));
    EXPECT_EQ(built["overlaps"], json::array());
    EXPECT_EQ(built["bytes"]["file"], std::filesystem::file_size(folder / "two.svt"));
    for (const auto& [stage, seconds] : built["seconds"].items()) EXPECT_GE(seconds.get<double>(), 0) << stage;
    EXPECT_GE(built["seconds"]["total"], built["seconds"]["voxelize"]);
}

TEST_F(TwoBoxes, DimensionIsTheNumberOfSamplesAsked) {
    const json built =
        runSvtForJson(folder.path(), {"build", "two.gml", "-o", "two.svt", "--dimension", "9,13,7", "--json"});
    EXPECT_EQ(built["dimension"], json::parse("[9, 13, 7]"));
    // The first and last sample lie on the envelope: 8 m / 8, 6 m / 12, 3 m / 6.
    EXPECT_NEAR(built["spacing"][0].get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(built["spacing"][1].get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(built["spacing"][2].get<double>(), 0.5, 1e-9);
}

TEST_F(TwoBoxes, DimensionCanBeWrittenWithTheLetterX) {
    const json built =
        runSvtForJson(folder.path(), {"build", "two.gml", "-o", "two.svt", "--dimension", "9x13x7", "--json"});
    EXPECT_EQ(built["dimension"], json::parse("[9, 13, 7]"));
}

TEST_F(TwoBoxes, InfoJsonHasItsKeysAndUnits) {
    (void)build();
    const json info = runSvtForJson(folder.path(), {"info", "two.svt", "--json"});
    EXPECT_EQ(keysOf(info), (Keys{"crs", "features", "grid", "name", "objects", "overlaps", "scalarType", "source"}));
    EXPECT_EQ(keysOf(info["grid"]), (Keys{"dimension", "frame", "origin", "spacing"}));
    EXPECT_EQ(info["grid"]["spacing"], json::parse("[0.5, 0.5, 0.5]"));
    EXPECT_EQ(info["grid"]["frame"], json::parse("[[1,0,0],[0,1,0],[0,0,1]]"));
    EXPECT_NEAR(info["grid"]["origin"][0].get<double>(), 500000, 1);
    EXPECT_NEAR(info["grid"]["origin"][1].get<double>(), 5400000, 1);
    EXPECT_EQ(info["scalarType"], "uint8");
    EXPECT_NE(info["crs"].get<std::string>().find("25832"), std::string::npos);
    EXPECT_EQ(info["source"], "two.gml");
    ASSERT_EQ(info["objects"].size(), 2u);
    const json& left = byId(info["objects"], "left");
    EXPECT_EQ(keysOf(left), (Keys{"class", "closed", "count", "countedVolume", "filling", "first", "id", "name",
                                  "ownVolume", "ownVoxels", "parent", "solidVolume", "totalVolume", "totalVoxels",
                                  "volume", "volumeBound", "volumeSource", "voxelVolume", "voxels"}));
    EXPECT_EQ(left["volumeSource"], "meshes");
    EXPECT_EQ(left["volumeBound"], 0.0);
    EXPECT_EQ(left["class"], "Building");
    EXPECT_EQ(left["parent"], nullptr);
    EXPECT_EQ(left["closed"], true);
    EXPECT_EQ(left["filling"], "solid");
    EXPECT_NEAR(left["volume"].get<double>(), 72, 1e-6);
    EXPECT_EQ(left["voxelVolume"].get<double>(), left["voxels"].get<double>() * 0.125);
    // Half a metre is coarse: 16 x 12 x 6 voxels fill the 144 m3, plus a layer where samples lie on faces.
    const double both = left["voxelVolume"].get<double>() + byId(info["objects"], "right")["voxelVolume"].get<double>();
    EXPECT_NEAR(both, 144, 0.35 * 144);
}

TEST_F(TwoBoxes, VoxelVolumeComesNearTheExactVolume) {
    (void)runSvtForJson(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.07", "--json"});
    const json info = runSvtForJson(folder.path(), {"info", "two.svt", "--json"});
    for (const json& object : info["objects"])
        EXPECT_NEAR(object["voxelVolume"].get<double>(), 72, 72 * 0.04) << object["id"];
}

TEST_F(TwoBoxes, InfoOfAModelIsThatOfItsVolume) {
    (void)build();
    EXPECT_EQ(runSvtForJson(folder.path(), {"info", "two.gml", "--spacing", "0.5", "--json"}),
              runSvtForJson(folder.path(), {"info", "two.svt", "--json"}));
}

TEST_F(TwoBoxes, QueryJsonIsRowsOfInfo) {
    (void)build();
    const json info = runSvtForJson(folder.path(), {"info", "two.svt", "--json"});
    const json rows = runSvtForJson(folder.path(), {"query", "two.svt", "id=right", "--json"});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0], byId(info["objects"], "right"));
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "two.svt", "class=Building and volume>20", "--json"}).size(), 2u);
}

TEST_F(TwoBoxes, CheckJsonHasItsKeysAndFindsNothing) {
    const json check = runSvtForJson(folder.path(), {"check", "two.gml", "--json"});
    EXPECT_EQ(keysOf(check), (Keys{"counts", "diagnostics", "features", "findings", "leaking", "legalUnits", "objects",
                                   "polygons", "primitives", "solids", "tJunctions", "usable", "valid"}));
    EXPECT_EQ(check["solids"], 2);
    EXPECT_EQ(check["leaking"], 0);
    EXPECT_EQ(check["tJunctions"], 0);
    const json& left = byId(check["objects"], "left");
    for (const char* key : {"id", "class", "name", "line", "lod", "closingMethod", "closed", "triangles",
                            "unmatchedEdges", "tJunctions", "leakingEdges", "leaks", "stillOpenEdges", "flippedFaces",
                            "complementedFaces", "caps", "assembled", "volume", "area"})
        EXPECT_TRUE(left.contains(key)) << key;
    EXPECT_EQ(left["closingMethod"], "closed");
    EXPECT_EQ(left["closure"], "closed");
    EXPECT_NEAR(left["volume"].get<double>(), 72, 1e-6);
    EXPECT_NEAR(left["area"].get<double>(), 2 * (4 * 6 + 4 * 3 + 6 * 3), 1e-6);
    EXPECT_EQ(left["lod"], 2.0);
}

TEST(CheckJson, NamesTheDefectItsPlaceAndTheLeak) {
    const TemporaryFolder folder;
    auto faces = boxFaces(500000, 5400000, 100, 500004, 5400006, 103);
    faces.pop_back();
    writeText(folder / "open.gml", cityModel(building("b", solid(faces))));
    const CommandResult result = runSvt(folder.path(), {"check", "open.gml", "--json"});
    EXPECT_EQ(result.exitCode, 4) << result.toString();
    const json check = result.json();
    EXPECT_EQ(check["leaking"], 1);
    EXPECT_EQ(check["objects"][0]["closed"], false);
    EXPECT_EQ(check["objects"][0]["leakingEdges"], 4);
    ASSERT_EQ(check["objects"][0]["caps"].size(), 1u);
    EXPECT_NEAR(check["objects"][0]["caps"][0]["area"].get<double>(), 18, 1e-6);
    ASSERT_FALSE(check["diagnostics"].empty());
    const json& finding = check["diagnostics"][0];
    EXPECT_EQ(finding["code"], "E209");
    EXPECT_EQ(finding["name"], "ShellCapped");
    EXPECT_EQ(finding["severity"], "warning");
    EXPECT_EQ(finding["file"], "open.gml");
    EXPECT_EQ(finding["id"], "b");
    EXPECT_GT(finding["line"].get<int>(), 1);
    // Leak positions are world coordinates.
    EXPECT_NEAR(check["objects"][0]["leaks"][0][1].get<double>(), 5400003, 3.01);
}

TEST(InfoJson, FindingsGoToStderrBesideTheJson) {
    const TemporaryFolder folder;
    auto faces = boxFaces(500000, 5400000, 100, 500004, 5400006, 103);
    faces.pop_back();
    writeText(folder / "open.gml", cityModel(building("b", solid(faces))));
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", "open.gml", "--spacing", "0.5", "--json"},
          {"query", "open.gml", "all", "--spacing", "0.5", "--json"}}) {
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_FALSE(result.json().empty());
        EXPECT_NE(result.err.find("E209 ShellCapped"), std::string::npos) << result.toString();
    }
}

TEST(BuildJson, OverlapsAreCountedPerPairAndThoseOfTheHierarchyAreMarked) {
    const TemporaryFolder folder;
    const std::string room = "<bldg:interiorRoom><bldg:Room gml:id=\"inner\"><bldg:lod4Solid>" +
                             solid(boxFaces(500001, 5400001, 101, 500002, 5400002, 102)) +
                             "</bldg:lod4Solid></bldg:Room></bldg:interiorRoom>";
    std::string big = building("big", solid(boxFaces(500000, 5400000, 100, 500006, 5400006, 106)));
    big.insert(big.find("</bldg:Building>"), room);
    writeText(folder / "overlap.gml",
              cityModel(big + building("cross", solid(boxFaces(500005, 5400001, 101, 500008, 5400003, 103)))));
    const json built =
        runSvtForJson(folder.path(), {"build", "overlap.gml", "-o", "o.svt", "--spacing", "0.13", "--json"});
    std::map<std::pair<std::string, std::string>, json> pairs;
    for (const json& overlap : built["overlaps"]) {
        EXPECT_EQ(keysOf(overlap), (Keys{"a", "b", "nested", "voxels"}));
        pairs[{std::min(overlap["a"], overlap["b"]), std::max(overlap["a"], overlap["b"])}] = overlap;
    }
    ASSERT_EQ(pairs.size(), 2u) << built["overlaps"];
    const double voxel = 0.13 * 0.13 * 0.13;
    const json& crossing = pairs.at({"big", "cross"});
    EXPECT_EQ(crossing["nested"], false);
    EXPECT_NEAR(crossing["voxels"].get<double>() * voxel, 1 * 2 * 2, 0.8);
    const json& nested = pairs.at({"big", "inner"});
    EXPECT_EQ(nested["nested"], true);
    EXPECT_NEAR(nested["voxels"].get<double>() * voxel, 1, 0.35);
}

std::map<std::string, std::string> nrrdHeader(const std::string& bytes) {
    std::map<std::string, std::string> fields;
    std::istringstream lines(bytes.substr(0, bytes.find("\n\n")));
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t colon = line.find(": "); colon != std::string::npos && line[0] != '#')
            fields[line.substr(0, colon)] = line.substr(colon + 2);
    return fields;
}

TEST_F(TwoBoxes, NrrdHeaderIsInWorldMetres) {
    const json built = build();
    runSvtWell(folder.path(), {"convert", "two.svt", "two.nrrd", "--encoding", "raw"});
    const std::string bytes = readText(folder / "two.nrrd");
    ASSERT_EQ(bytes.substr(0, 4), "NRRD");
    auto header = nrrdHeader(bytes);
    EXPECT_EQ(header["type"], "uint8");
    EXPECT_EQ(header["encoding"], "raw");
    EXPECT_EQ(header["space dimension"], "3");
    EXPECT_EQ(header.count("space"), 0u);
    std::ostringstream sizes;
    sizes << built["dimension"][0] << ' ' << built["dimension"][1] << ' ' << built["dimension"][2];
    EXPECT_EQ(header["sizes"], sizes.str());
    double d[9]{};
    ASSERT_EQ(std::sscanf(header["space directions"].c_str(), "(%lf,%lf,%lf) (%lf,%lf,%lf) (%lf,%lf,%lf)", d, d + 1,
                          d + 2, d + 3, d + 4, d + 5, d + 6, d + 7, d + 8),
              9)
        << header["space directions"];
    for (int i = 0; i < 9; ++i) EXPECT_EQ(d[i], i % 4 == 0 ? 0.5 : 0.0) << i;
    double o[3]{};
    ASSERT_EQ(std::sscanf(header["space origin"].c_str(), "(%lf,%lf,%lf)", o, o + 1, o + 2), 3)
        << header["space origin"];
    const json info = runSvtForJson(folder.path(), {"info", "two.svt", "--json"});
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(o[axis], info["grid"]["origin"][axis].get<double>());
    // One byte per sample after the header, x fastest; labels as in info.
    const std::string samples = bytes.substr(bytes.find("\n\n") + 2);
    std::map<int, std::uint64_t> counts;
    for (const char c : samples) ++counts[static_cast<unsigned char>(c)];
    for (const json& object : info["objects"])
        EXPECT_EQ(counts[object["first"].get<int>()], object["voxels"].get<std::uint64_t>()) << object["id"];
}

TEST_F(TwoBoxes, SeveralFilesMakeOneVolume) {
    writeText(folder / "third.json", cityJson());
    const json built =
        runSvtForJson(folder.path(), {"build", "two.gml", "third.json", "-o", "all.svt", "--spacing", "0.5", "--json"});
    EXPECT_EQ(built["objects"], 3);
}

TEST_F(TwoBoxes, ResultsGoToStdoutAndNothingToStderr) {
    const CommandResult result = runSvt(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.rfind("two.svt: 2 objects", 0), 0u) << result.out;
}

TEST_F(TwoBoxes, NoFileIsLeftBesideTheOutput) {
    (void)build();
    EXPECT_EQ(folder.count(), 2);
}

TEST(BuildOnly, KeepsTheSelectedInTheBoxAroundThem) {
    const TemporaryFolder folder;
    prepareHouse(folder.path(), "0.2");
    runSvtWell(folder.path(),
               {"build", "house.gml", "-o", "f.svt", "--spacing", "0.2", "--only", "class=BuildingFurniture"});
    const auto idsWithVoxels = [&](const char* file, const char* query) {
        std::vector<std::string> ids;
        for (const json& row : runSvtForJson(folder.path(), {"query", file, query, "--json"}))
            if (row["voxels"].get<std::uint64_t>() > 0) ids.push_back(row["id"].get<std::string>());
        return ids;
    };
    const auto kept = idsWithVoxels("f.svt", "all");
    EXPECT_FALSE(kept.empty());
    EXPECT_EQ(kept, idsWithVoxels("house.svt", "class=BuildingFurniture"));
    EXPECT_LT(kept.size(), idsWithVoxels("house.svt", "all").size());
    const auto dimensionOf = [&](const char* file) {
        return runSvtForJson(folder.path(), {"info", file, "--json"})["grid"]["dimension"]
            .get<std::vector<std::int64_t>>();
    };
    const auto part = dimensionOf("f.svt"), whole = dimensionOf("house.svt");
    ASSERT_EQ(part.size(), 3u);
    ASSERT_EQ(whole.size(), 3u);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(part[axis], whole[axis]) << axis;
}

}  // namespace
}  // namespace svt::test
