// Real models that are not part of the repository, with figures published by their authors.
#include "dense_volume.hpp"
#include "run_command.hpp"

#include <svt/core/test_data_test.hpp>

#include <cmath>

namespace svt::test {
namespace {

using nlohmann::json;

json infoOf(const TemporaryFolder& folder, const std::filesystem::path& model, const std::string& spacing) {
    return runSvtForJson(folder.path(), {"info", model.string(), "--spacing", spacing, "--json"});
}

struct Known {
    const char* ifcType;
    double volume;     ///< m3
    double tolerance;  ///< fraction; the GML is rounded to millimetres, which matters for rafters
};
constexpr Known kHouse[] = {{"IfcWallStandardCase", 54.50, 0.001},
                            {"IfcSlab", 76.99, 0.001},
                            {"IfcBeam", 0.695, 0.001},
                            {"IfcMember", 3.41, 0.003},
                            {"IfcDoor", 0.542, 0.001},
                            {"IfcSpace", 470.83, 0.001}};

void expectHouse(const json& info) {
    std::map<std::string, double> volumes;
    for (const json& object : info["objects"]) {
        volumes[object["attributes"].value("ifcType", "")] += object["solidVolume"].get<double>();
        EXPECT_EQ(object["closed"], true) << object["id"];
    }
    EXPECT_EQ(info["objects"].size(), 89u);
    for (const Known& known : kHouse)
        EXPECT_NEAR(volumes[known.ifcType], known.volume, known.volume * known.tolerance) << known.ifcType;
}

TEST(FzkHaus, CityGmlHas89ClosedSolidsOfTheKnownVolumes) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    const TemporaryFolder folder;
    const json built =
        runSvtForJson(folder.path(), {"build", model.string(), "-o", "f.svt", "--spacing", "0.1", "--json"});
    EXPECT_EQ(built["objects"], 89);
    EXPECT_EQ(built["open"], 0);
    expectHouse(infoOf(folder, model, "0.1"));
}

TEST(FzkHaus, CityJsonHas89ClosedSolidsOfTheKnownVolumes) {
    SVT_NEEDS_DATA(model, "fzk_haus.city.json");
    const TemporaryFolder folder;
    const json built =
        runSvtForJson(folder.path(), {"build", model.string(), "-o", "f.svt", "--spacing", "0.1", "--json"});
    EXPECT_EQ(built["objects"], 89);
    EXPECT_EQ(built["open"], 0);
    expectHouse(infoOf(folder, model, "0.1"));
}

// The two city models were made of this file.
TEST(FzkHaus, IfcHasTheSameSolids) {
    SVT_NEEDS_DATA(model, "fzk_haus.ifc");
    const TemporaryFolder folder;
    const json info = infoOf(folder, model, "0.1");
    std::map<std::string, double> volumes;
    std::map<std::string, std::string> types;  // by id; a pane belongs to its window
    for (const json& object : info["objects"]) types[object["id"]] = object["attributes"].value("ifcType", "");
    for (const json& object : info["objects"]) {
        if (types[object["id"]] == "IfcAnnotation") continue;  // lines
        const bool isPhase = object["class"].get<std::string>().ends_with("Phase");
        volumes[types[object[isPhase ? "parent" : "id"]]] += object["solidVolume"].get<double>();
        EXPECT_EQ(object["closed"], true) << object["id"];
    }
    for (const Known& known : kHouse)
        EXPECT_NEAR(volumes[known.ifcType], known.volume, known.volume * known.tolerance) << known.ifcType;
}

// All that have a shape.
TEST(Ifc, AllProductsOfRealFilesAreRead) {
    struct File {
        const char* name;
        const char* products;
    };
    for (const File& file :
         {File{"fzk_haus.ifc", "90 of 90 products"}, File{"openhouse.ifc", "35 of 35 products"},
          File{"samplehouse.ifc", "62 of 62 products"}, File{"largebuilding.ifc", "122 of 122 products"}}) {
        SVT_NEEDS_DATA(model, file.name);
        const TemporaryFolder folder;
        const CommandResult built =
            runSvt(folder.path(), {"build", model.string(), "-o", "v.svt", "--dimension", "80"});
        EXPECT_EQ(built.exitCode, 0) << built.err;
        EXPECT_NE(built.err.find(file.products), std::string::npos) << built.err;
    }
}

TEST(Ifc, QueriesByClassPropertyMaterialAndStorey) {
    SVT_NEEDS_DATA(model, "fzk_haus.ifc");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", model.string(), "-o", "f.svt", "--dimension", "80"});
    const auto count = [&](const char* query) {
        return runSvtForJson(folder.path(), {"query", "f.svt", query, "--json"}).size();
    };
    EXPECT_EQ(count("class=IfcWallStandardCase"), 13u);
    EXPECT_EQ(count("class=IfcWall"), 13u);
    EXPECT_EQ(count("class=IfcSpace"), 7u);
    EXPECT_EQ(count("class=IfcWindow and storey=Erdgeschoss"), 9u);
    EXPECT_GT(count("Pset_WallCommon.ThermalTransmittance=1.5"), 0u);
    EXPECT_GT(count("material~beton"), 0u);
}

TEST(FzkHaus, BothFormatsGiveTheSameVoxels) {
    SVT_NEEDS_DATA(gml, "fzk_haus_citygml3.gml");
    SVT_NEEDS_DATA(cityJson, "fzk_haus.city.json");
    const TemporaryFolder folder;
    const auto a = objectsById(infoOf(folder, gml, "0.041")), b = objectsById(infoOf(folder, cityJson, "0.041"));
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [id, object] : a) {
        ASSERT_EQ(b.count(id), 1u) << id;
        const double voxels = object["voxels"], others = b.at(id)["voxels"];
        // Millimetres against tenths of millimetres: a thin part may gain or lose a row of samples.
        const double allowed = voxels > 10000 ? 0.005 * voxels : 0.05 * voxels + 2;
        EXPECT_NEAR(voxels, others, allowed) << id << ' ' << object["name"];
    }
}

TEST(FzkHaus, HiddenBeamIsFoundAndDrawn) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", model.string(), "-o", "f.svt", "--spacing", "0.05"});
    const json rows = runSvtForJson(folder.path(), {"query", "f.svt", "name~'Unterzug'", "--json"});
    EXPECT_GE(rows.size(), 1u);
    runSvtWell(folder.path(), {"render", "f.svt", "-o", "p.png", "--size", "160x90", "--section", "z=2.6", "--color",
                               "name~'Unterzug':red"});
}

TEST(FzkHaus, WrongClassNamesTheNearest) {
    SVT_NEEDS_DATA(model, "fzk_haus_citygml3.gml");
    const TemporaryFolder folder;
    const CommandResult result =
        runSvt(folder.path(), {"query", model.string(), "class=BuildingRom", "--spacing", "0.2"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.err.find("did you mean 'BuildingRoom'"), std::string::npos) << result.err;
}

class Sig3d : public ::testing::Test {
protected:
    TemporaryFolder folder;
};

TEST_F(Sig3d, EveryXLinkIsResolvedAndTheDefectsOfBothSolidsAreNamed) {
    SVT_NEEDS_DATA(model, "sig3d_lod4_citygml2.gml");
    const CommandResult result = runSvt(folder.path(), {"check", model.string(), "--json"});
    EXPECT_EQ(result.exitCode, 4);
    const json check = result.json();
    bool isBuildingNamed = false, isRoomNamed = false;
    for (const json& finding : check["diagnostics"]) {
        EXPECT_NE(finding["code"], "E110") << finding;
        const std::string id = finding.value("id", ""), code = finding["code"];
        const bool isRoom = id.size() > 15 && id.compare(id.size() - 15, 15, "BuildingRoom[1]") == 0;
        isBuildingNamed = isBuildingNamed || (code == "E209" && id == "GML_7b1a5a6f-ddad-4c3d-a507-3eb9ee0a8e68");
        isRoomNamed = isRoomNamed || (isRoom && (code == "E207" || code == "E208" || code == "E209"));
    }
    EXPECT_TRUE(isBuildingNamed) << "the gap in the building's solid";
    EXPECT_TRUE(isRoomNamed) << "the T-junctions of the room";
    EXPECT_EQ(check["leaking"], 1);
}

TEST_F(Sig3d, RoomHasItsVolume) {
    SVT_NEEDS_DATA(model, "sig3d_lod4_citygml2.gml");
    const json info = infoOf(folder, model, "0.05");
    int rooms = 0;
    for (const json& object : info["objects"]) {
        if (object["class"] != "BuildingRoom") continue;
        ++rooms;
        EXPECT_NEAR(object["volume"].get<double>(), 160.5, 0.1);
        EXPECT_NEAR(object["voxelVolume"].get<double>(), 160.5, 1.6);
    }
    EXPECT_EQ(rooms, 1);
}

TEST_F(Sig3d, BodiesOfTheSurfacesFillTheBuildingBesidesItsRoom) {
    SVT_NEEDS_DATA(model, "sig3d_lod4_citygml2.gml");
    const json info = infoOf(folder, model, "0.04");
    double bodies = 0, openings = 0, room = 0, building = 0;
    for (const json& object : info["objects"]) {
        if (object["filling"] == "body") bodies += object["voxelVolume"].get<double>();
        if (object["class"] == "Window" || object["class"] == "Door") openings += object["voxelVolume"].get<double>();
        if (object["class"] == "BuildingRoom") room = object["volume"];
        if (object["class"] == "Building") {
            building = object["volume"];
            EXPECT_EQ(object["voxels"], 0) << "material that no wall, slab or roof took";
        }
    }
    EXPECT_NEAR(building, 199.5, 0.2);
    EXPECT_NEAR(bodies + openings, building - room, 0.03 * (building - room));
}

TEST(City, BerlinIsBuiltInSpiteOfItsDefects) {
    SVT_NEEDS_DATA(model, "berlin_lod2_citygml1.gml");
    const TemporaryFolder folder;
    const json built =
        runSvtForJson(folder.path(), {"build", model.string(), "-o", "b.svt", "--spacing", "1", "--json"});
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "b.svt", "class=Building", "--json"}).size(), 61u);
    EXPECT_EQ(built["open"], 4);
}

TEST(City, HundredBuildingsAreHundredClosedBuildings) {
    SVT_NEEDS_DATA(model, "100_buildings_lod2_citygml3.gml");
    const TemporaryFolder folder;
    const json built =
        runSvtForJson(folder.path(), {"build", model.string(), "-o", "b.svt", "--spacing", "1", "--json"});
    EXPECT_EQ(built["open"], 0);
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "b.svt", "class=Building", "--json"}).size(), 100u);
    EXPECT_EQ(runSvtForJson(folder.path(), {"query", "b.svt", "class=RoofSurface", "--json"}).size(), 200u);
}

TEST(CityJsonConformance, EveryConstructIsReadOrNamed) {
    SVT_NEEDS_DATA(model, "cityjson_fake_complete.city.json");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", model.string(), "-o", "c.svt", "--dimension", "60"});
}

TEST(IndoorGml, CellSpacesAreRooms) {
    SVT_NEEDS_DATA(indoorGml, "fzk_haus_indoorgml.gml");
    const TemporaryFolder folder;
    runSvtWell(folder.path(), {"build", indoorGml.string(), "-o", "i.svt", "--spacing", "0.2"});
    const json rooms = runSvtForJson(folder.path(), {"query", "i.svt", "class=BuildingRoom", "--json"});
    EXPECT_EQ(rooms.size(), 24u);
    for (const json& room : rooms) EXPECT_GT(room["voxels"], 0) << room;
}

}  // namespace
}  // namespace svt::test
