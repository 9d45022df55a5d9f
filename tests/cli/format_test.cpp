// One model in several formats gives one volume, and the same input gives the same bytes.
#include "dense_volume.hpp"
#include "run_command.hpp"

#include <cmath>

namespace svt::test {
namespace {

using nlohmann::json;

std::string build(const TemporaryFolder& folder, const std::string& model, const std::string& spacing,
                  const std::vector<std::string>& more = {}) {
    const std::string volume = model + ".svt";
    std::vector<std::string> arguments{"build", model, "-o", volume, "--spacing", spacing};
    arguments.insert(arguments.end(), more.begin(), more.end());
    runSvtWell(folder.path(), arguments);
    return volume;
}

void writeHouse(const TemporaryFolder& folder, const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"sample", "house", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    runSvtWell(folder.path(), arguments);
}

bool isSheet(const json& object) { return object.at("filling") == "surface"; }

// Boundary surfaces and openings have no names common to all formats; the room that they bound has.
const json& boundedBody(const DenseVolume& volume, const json& object) {
    const json* body = &object;
    while (isSheet(*body) && volume.objects.count(body->at("parent")) != 0)
        body = &volume.objects.at(body->at("parent"));
    return *body;
}

std::vector<std::string> sharedNames(const DenseVolume& volume) {
    return volume.names([&](const json& object) {
        return boundedBody(volume, object).at("id").get<std::string>() + (isSheet(object) ? " surface" : "");
    });
}

std::vector<std::string> bodyNames(const DenseVolume& volume) {
    return volume.names([&](const json& object) { return boundedBody(volume, object).at("id").get<std::string>(); });
}

std::map<std::string, json> solidsOf(const DenseVolume& volume) {
    std::map<std::string, json> solids;
    for (const auto& [id, object] : volume.objects)
        if (!isSheet(object)) solids[id] = object;
    return solids;
}

class SameHouse : public ::testing::Test {
protected:
    DenseVolume readHouse(const std::string& file, const std::vector<std::string>& sampleOptions = {}) {
        writeHouse(folder, file, sampleOptions);
        // Parts thinner than a voxel compete by id, and ids of surfaces differ between formats. No coordinate of the
        // house is a multiple of the spacing: a sample exactly on a face may fall to either side of furniture that the
        // formats place differently.
        return readDense(folder, build(folder, file, "0.0967", {"--no-thin"}));
    }
    TemporaryFolder folder;
};

void expectSameVolumes(const DenseVolume& a, const DenseVolume& b) {
    const auto solidsA = solidsOf(a), solidsB = solidsOf(b);
    ASSERT_EQ(solidsA.size(), solidsB.size());
    for (const auto& [id, object] : solidsA) {
        ASSERT_EQ(solidsB.count(id), 1u) << id;
        // Coordinates are whole millimetres in all formats, so volumes agree up to rounding.
        EXPECT_NEAR(object["solidVolume"].get<double>(), solidsB.at(id)["solidVolume"].get<double>(), 1e-6) << id;
    }
    EXPECT_EQ(a.info["grid"], b.info["grid"]);
}

TEST_F(SameHouse, CityJsonHasTheSameLabelInEverySample) {
    const DenseVolume gml = readHouse("house.gml"), cityJson = readHouse("house.json");
    expectSameVolumes(gml, cityJson);
    for (const auto& [id, object] : solidsOf(gml)) EXPECT_EQ(object["voxels"], cityJson.objects.at(id)["voxels"]) << id;
    EXPECT_TRUE(sharedNames(gml) == sharedNames(cityJson));
}

TEST_F(SameHouse, CityJsonSeqHasTheSameScalarsAsCityJson) {
    const DenseVolume one = readHouse("house.json"), lines = readHouse("house.jsonl");
    EXPECT_EQ(one.scalars, lines.scalars);
    EXPECT_EQ(one.info["objects"], lines.info["objects"]);
}

TEST_F(SameHouse, CityGml2HasTheSameVolumesAndNearlyTheSameSamples) {
    const DenseVolume three = readHouse("house3.gml"), two = readHouse("house2.gml", {"--format", "citygml2"});
    expectSameVolumes(three, two);
    // CityGML 2.0 represents slabs and roofs as installations, which take precedence over the surfaces of rooms on
    // them, so a few samples on such faces go to the other side.
    const auto namesThree = bodyNames(three), namesTwo = bodyNames(two);
    ASSERT_EQ(namesThree.size(), namesTwo.size());
    std::size_t filled = 0, differing = 0;
    for (std::size_t i = 0; i < namesThree.size(); ++i) {
        filled += !namesThree[i].empty();
        differing += namesThree[i] != namesTwo[i];
    }
    EXPECT_GT(filled, 400000u);
    EXPECT_LT(double(differing), 0.0001 * double(filled));
}

TEST_F(SameHouse, GzippedInputGivesTheSameBytes) {
    if (!hasProgram("gzip --version")) GTEST_SKIP() << "no gzip here";
    writeHouse(folder, "house.gml");
    const std::string plain = readText(folder / build(folder, "house.gml", "0.2"));
    runShellWell(folder.path(), "gzip --no-name house.gml && mv house.gml.gz house.gml");
    EXPECT_EQ(readText(folder / build(folder, "house.gml", "0.2")), plain);
}

TEST(SameBytes, ForOneThreadAndForFour) {
    const TemporaryFolder folder;
    writeHouse(folder, "house.gml");
    for (const char* patterns : {"--no-bodies", "--patterns"}) {
        const std::string one = readText(folder / build(folder, "house.gml", "0.1", {"--threads", "1", patterns}));
        const std::string four = readText(folder / build(folder, "house.gml", "0.1", {"--threads", "4", patterns}));
        EXPECT_GT(one.size(), 20000u);
        EXPECT_TRUE(one == four) << "the volumes of one and four threads differ " << patterns;
    }
}

TEST(SameBytes, ForAThematicModelOfSeveralFilesAndThreads) {
    const TemporaryFolder folder;
    writeHouse(folder, "a.gml", {"--format", "citygml2", "--thematic"});
    runSvtWell(folder.path(), {"sample", "tower", "--storeys", "2", "-o", "b.json"});
    std::string bytes[2];
    for (const int i : {0, 1}) {
        runSvtWell(folder.path(), {"build", "a.gml", "b.json", "-o", "o.svt", "--dimension", "90,90,60", "--threads",
                                   i == 0 ? "1" : "4"});
        bytes[i] = readText(folder / "o.svt");
    }
    EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST(SameBytes, WhenBuiltTwice) {
    const TemporaryFolder folder;
    writeHouse(folder, "house.json");
    const std::string first = readText(folder / build(folder, "house.json", "0.15", {"--patterns"}));
    const std::string second = readText(folder / build(folder, "house.json", "0.15", {"--patterns"}));
    EXPECT_TRUE(first == second) << "two builds of one file differ";
}

TEST(SameBytes, OfSamplesPicturesAndConversions) {
    const TemporaryFolder folder;
    for (const char* file : {"a.gml", "b.gml"}) writeHouse(folder, file);
    EXPECT_TRUE(readText(folder / "a.gml") == readText(folder / "b.gml"));
    build(folder, "a.gml", "0.2");
    for (const char* threads : {"1", "4"}) {
        const std::string name = std::string("t") + threads;
        runSvtWell(folder.path(), {"render", "a.gml.svt", "-o", name + ".png", "--size", "160x90", "--threads", threads,
                                   "--labels", name + "l.png", "--depth", name + "d.png"});
        runSvtWell(folder.path(), {"convert", "a.gml.svt", name + ".nrrd", "--threads", threads});
    }
    for (const char* end : {".png", "l.png", "d.png", ".nrrd"})
        EXPECT_TRUE(readText(folder / (std::string("t1") + end)) == readText(folder / (std::string("t4") + end)))
            << end;
}

TEST(BuildingFrame, FollowsAHouseTurnedBy30Degrees) {
    const TemporaryFolder folder;
    writeHouse(folder, "straight.gml");
    writeHouse(folder, "turned.gml", {"--turn", "30"});
    const json straight = runSvtForJson(folder.path(), {"info", "straight.gml", "--spacing", "0.1", "--json"});
    const json turned =
        runSvtForJson(folder.path(), {"info", "turned.gml", "--spacing", "0.1", "--axes", "building", "--json"});
    const json world = runSvtForJson(folder.path(), {"info", "turned.gml", "--spacing", "0.1", "--json"});
    const json& axes = turned["grid"]["frame"];
    const double angle = std::atan2(axes[0][1].get<double>(), axes[0][0].get<double>()) * 180 / std::acos(-1.0);
    // Vertices are whole millimetres, so an edge of 10 m has its direction within 0.01 degrees.
    EXPECT_NEAR(std::fmod(angle + 360, 90), 30, 0.02);
    EXPECT_EQ(axes[2], json::parse("[0, 0, 1]"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(turned["grid"]["dimension"][axis].get<int>(), straight["grid"]["dimension"][axis].get<int>(), 1)
            << axis;
    }
    // Along the axes of the CRS the rotated house needs a wider grid.
    EXPECT_GT(world["grid"]["dimension"][0].get<int>(), straight["grid"]["dimension"][0].get<int>() + 20);
    // Sufficiently thick objects have as many voxels as their volume.
    const auto objects = objectsById(turned);
    std::size_t compared = 0;
    for (const auto& [id, object] : objects) {
        if (object["class"] != "BuildingConstructiveElement" || object["solidVolume"].is_null()) continue;
        const double solid = object["solidVolume"];
        if (solid < 3) continue;
        ++compared;
        EXPECT_NEAR(object["voxelVolume"].get<double>(), solid, 0.25 * solid) << id;
    }
    EXPECT_GT(compared, 10u);
}

TEST(BuildingFrame, NrrdKeepsTheTurnedAxes) {
    const TemporaryFolder folder;
    writeHouse(folder, "turned.gml", {"--turn", "30"});
    build(folder, "turned.gml", "0.2", {"--axes", "building"});
    runSvtWell(folder.path(), {"convert", "turned.gml.svt", "t.nrrd"});
    const std::string header = readText(folder / "t.nrrd").substr(0, 2000);
    const std::size_t at = header.find("space directions: (");
    ASSERT_NE(at, std::string::npos);
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(header.c_str() + at, "space directions: (%lf,%lf,%lf)", &x, &y, &z), 3);
    EXPECT_NEAR(std::hypot(x, y), 0.2, 1e-9);
    EXPECT_EQ(z, 0);
    EXPECT_NEAR(std::fmod(std::atan2(y, x) * 180 / std::acos(-1.0) + 360, 90), 30, 0.02);
}

}  // namespace
}  // namespace svt::test
