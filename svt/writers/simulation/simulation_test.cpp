#include <svt/analyze/space_boundaries.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/simulation/adjacency_graph.hpp>
#include <svt/writers/simulation/box_list.hpp>
#include <svt/writers/simulation/fds_writer.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>

namespace svt::writers {
namespace {

using nlohmann::json;
using volume::SemanticVolume;

// A room in walls with a door of their thickness, 0.1 m a voxel; the second wall has the name of the first.
SemanticVolume roomWithADoor() {
    SemanticVolume volume = volume::test::emptyVolume({31, 23, 17}, {0.1, 0.1, 0.1}, {1000, 2000, 50});
    volume.modelName = "Haus \"Süd\" 'A'";
    for (const auto& [id, className, name] : {std::tuple("w1", "BuildingConstructiveElement", "Wall"),
                                              std::tuple("w2", "BuildingConstructiveElement", "Wall"),
                                              std::tuple("d", "Door", "Tür"), std::tuple("r", "BuildingRoom", "Room")})
        volume::test::addObject(volume, id, className).name = name;
    for (const std::size_t wall : {0, 1})
        volume.labels.labels[wall].attributes = {{"material", std::string("brick"), ""}};
    volume::test::paintBoxes(volume, {{1, {2, 2, 2}, {28, 20, 15}},
                                      {2, {20, 2, 2}, {28, 20, 15}},
                                      {4, {4, 4, 4}, {26, 18, 13}},
                                      {3, {10, 2, 4}, {14, 4, 11}}});
    return volume;
}

struct FdsBox {
    std::string kind, surface;
    std::array<double, 6> bounds{};
};

// OBST, HOLE and VENT lines with XB.
std::vector<FdsBox> readFds(const std::string& text) {
    std::vector<FdsBox> boxes;
    std::istringstream lines(text);
    const std::regex pattern("&(OBST|HOLE|VENT) XB=([-0-9.,]+)(?:, SURF_ID='([^']*)')? /.*");
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, pattern)) continue;
        FdsBox box{match[1], match[3], {}};
        std::istringstream numbers(match[2]);
        for (double& bound : box.bounds) {
            numbers >> bound;
            numbers.ignore();
        }
        boxes.push_back(box);
    }
    return boxes;
}

TEST(Fds, ObstaclesAreTheSolidVoxelsWithoutTheRoom) {
    const SemanticVolume volume = roomWithADoor();
    const auto text = makeFds(volume, "my house", {});
    ASSERT_TRUE(text);
    std::map<std::string, std::uint64_t> voxels;
    for (const FdsBox& box : readFds(*text)) {
        EXPECT_EQ(box.kind, "OBST");
        std::uint64_t count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis)
            count *= static_cast<std::uint64_t>(std::lround((box.bounds[2 * axis + 1] - box.bounds[2 * axis]) / 0.1));
        voxels[box.surface] += count;
        // Nothing of the room, which begins at the fifth voxel.
        EXPECT_FALSE(box.bounds[0] < 2.55 && box.bounds[1] > 0.45 && box.bounds[2] < 1.75 && box.bounds[3] > 0.45 &&
                     box.bounds[4] < 1.25 && box.bounds[5] > 0.45);
    }
    const auto& labels = volume.labels.labels;
    EXPECT_EQ(voxels, (std::map<std::string, std::uint64_t>{
                          {"Wall", labels[0].voxels}, {"Wall 2", labels[1].voxels}, {"T_r", labels[2].voxels}}));
    EXPECT_NE(text->find("&HEAD CHID='my_house', TITLE='Haus _S_d_ _A_' /"), std::string::npos) << *text;
    // 31, 23, 17 have prime factors over 5.
    EXPECT_NE(text->find("&MESH IJK=32,24,18, XB=0.0000,3.2000,0.0000,2.4000,0.0000,1.8000 /"), std::string::npos);
    EXPECT_TRUE(std::all_of(text->begin(), text->end(), [](char c) { return c == '\n' || (c >= ' ' && c < 127); }));
}

TEST(Fds, MaterialBehindSurfacesOfARoomIsAnObstacle) {
    SemanticVolume volume = roomWithADoor();
    volume::Label& wall = volume.labels.labels[0];
    wall.className = "InteriorWallSurface";
    wall.parent = 3;
    // Parents come before their children.
    std::swap(volume.labels.labels[0], volume.labels.labels[3]);
    volume.labels.labels[3].parent = 0;
    for (const auto& [filling, isObstacle] :
         {std::pair(volume::Filling::Body, true), std::pair(volume::Filling::Surface, false)}) {
        volume.labels.labels[3].filling = filling;
        const auto text = makeFds(volume, "house", {});
        ASSERT_TRUE(text);
        EXPECT_EQ(text->find("SURF_ID='Wall 2' /") != std::string::npos, isObstacle) << "one of two walls";
    }
}

TEST(Fds, HolesStandBehindAllObstaclesAndVentsOnBothSides) {
    const SemanticVolume volume = roomWithADoor();
    VolumeWriteOptions options;
    options.boxes.holes = "class=Door";
    options.boxes.vents = "class=Door";
    const auto text = makeFds(volume, "h", options);
    ASSERT_TRUE(text);
    const auto boxes = readFds(*text);
    const std::array<double, 6> door{1, 1.4, 0.2, 0.4, 0.4, 1.1};
    std::vector<FdsBox> holes, vents;
    for (const FdsBox& box : boxes) {
        if (box.kind == "HOLE") holes.push_back(box);
        if (box.kind == "VENT") vents.push_back(box);
        EXPECT_TRUE(box.kind != "OBST" || (holes.empty() && vents.empty()));
    }
    ASSERT_EQ(holes.size(), 1u);
    EXPECT_EQ(holes[0].bounds, door);
    ASSERT_EQ(vents.size(), 2u);
    for (const std::size_t side : {0u, 1u}) {
        EXPECT_EQ(vents[side].surface, "T_r vent");
        EXPECT_EQ(vents[side].bounds[2], door[2 + side]) << "across y, where the door is thinnest";
        EXPECT_EQ(vents[side].bounds[3], door[2 + side]);
        EXPECT_EQ(vents[side].bounds[0], door[0]);
        EXPECT_EQ(vents[side].bounds[5], door[5]);
    }
}

TEST(Fds, FaultyQueriesAreErrorsInEveryFormat) {
    const SemanticVolume volume = roomWithADoor();
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    for (const auto query : {&BoxWriteOptions::holes, &BoxWriteOptions::vents})
        for (const char* name : {"faulty_query.fds", "faulty_query.nrrd"}) {
            VolumeWriteOptions options;
            options.boxes.*query = "class=";
            const auto written = writeVolume(volume, folder / name, options);
            ASSERT_FALSE(written) << name;
            EXPECT_EQ(written.error().code(), Code::BadQuery) << written.error().message();
            EXPECT_FALSE(std::filesystem::exists(folder / name));
        }
}

TEST(Fds, HolesStayApartWhereComponentsAreMerged) {
    const SemanticVolume volume = roomWithADoor();
    VolumeWriteOptions options;
    options.boxes.mergeBy = MergeBy::Class;
    options.boxes.holes = "id=w2";  // the second of two walls of one class
    const auto text = makeFds(volume, "h", options);
    ASSERT_TRUE(text);
    double holes = 0, walls = 0;
    for (const FdsBox& box : readFds(*text)) {
        const auto& b = box.bounds;
        const double size = (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
        if (box.kind == "HOLE") holes += size;
        if (box.surface == "BuildingConstructiveElement") walls += size;
    }
    EXPECT_NEAR(holes, double(volume.labels.labels[1].voxels) * 0.001, 1e-9);
    EXPECT_NEAR(walls, double(volume.labels.labels[0].voxels) * 0.001, 1e-9);
}

TEST(Boxes, TableAndJsonHoldEachSolidVoxelOnce) {
    const SemanticVolume volume = roomWithADoor();
    VolumeWriteOptions options;
    const auto text = makeBoxJson(volume, options);
    ASSERT_TRUE(text);
    const json boxes = json::parse(*text);
    EXPECT_EQ(boxes["grid"]["lowerCorner"], (json{999.95, 1999.95, 49.95}));
    auto dense = *volume::toDense<std::uint32_t>(volume.columns);
    for (const json& box : boxes["boxes"]) {
        const std::string id = boxes["groups"][box["group"].get<std::size_t>()]["id"];
        const std::uint32_t scalar = id == "w1" ? 1 : id == "w2" ? 2 : 3;
        EXPECT_NEAR(box["max"][2].get<double>(), box["end"][2].get<int>() * 0.1, 1e-6);
        for (int k = box["begin"][2]; k < box["end"][2]; ++k)
            for (int j = box["begin"][1]; j < box["end"][1]; ++j)
                for (int i = box["begin"][0]; i < box["end"][0]; ++i) {
                    auto& at = dense[std::size_t(i) + 31 * (std::size_t(j) + 23 * std::size_t(k))];
                    EXPECT_EQ(at, scalar);
                    at = 0;
                }
    }
    for (const std::uint32_t rest : dense) EXPECT_TRUE(rest == 0 || rest == 4) << "the room alone is left";
    const auto table = makeBoxTable(volume, options);
    ASSERT_TRUE(table);
    EXPECT_EQ(std::size_t(std::count(table->begin(), table->end(), '\n')), boxes["boxes"].size() + 1);
    EXPECT_NE(table->find("\r\n0,Wall,w1,BuildingConstructiveElement,2,2,2,"), std::string::npos) << *table;
}

TEST(Boxes, OfOneMaterialAreMergedAcrossComponents) {
    const SemanticVolume volume = roomWithADoor();
    VolumeWriteOptions options;
    options.boxes.mergeBy = MergeBy::Material;
    const auto text = makeBoxJson(volume, options);
    ASSERT_TRUE(text);
    const json boxes = json::parse(*text);
    ASSERT_EQ(boxes["groups"].size(), 2u);
    EXPECT_EQ(boxes["groups"][0]["name"], "brick");
    EXPECT_EQ(boxes["groups"][1]["name"], "Door") << "without a material: its class";
    options.boxes.mergeBy = MergeBy::Label;
    EXPECT_LT(boxes["boxes"].size(), json::parse(*makeBoxJson(volume, options))["boxes"].size());
    options.boxes.maxBoxes = 3;
    EXPECT_EQ(makeBoxJson(volume, options).error().code(), Code::BadArgument);
    EXPECT_EQ(makeFds(volume, "h", options).error().code(), Code::BadArgument);
}

TEST(Boxes, RoomsAloneAreWritten) {
    SemanticVolume volume = roomWithADoor();
    for (std::size_t l = 0; l < 3; ++l) volume.labels.labels[l].voxels = 0;
    const json boxes = json::parse(*makeBoxJson(volume, {}));
    EXPECT_EQ(boxes["groups"].size(), 1u);
    EXPECT_EQ(boxes["groups"][0]["id"], "r");
}

TEST(Adjacency, TellsWhatSeparatesTheRoomFromOutside) {
    const SemanticVolume volume = roomWithADoor();
    const json graph = json::parse(makeAdjacencyJson(volume));
    ASSERT_EQ(graph["nodes"].size(), 5u);
    EXPECT_EQ(graph["nodes"][0]["id"], "outside");
    EXPECT_EQ(graph["nodes"][1]["material"], "brick");
    EXPECT_TRUE(graph["nodes"][4]["isSpace"]);
    EXPECT_FALSE(graph["nodes"][4].contains("material"));
    double door = 0, wall = 0;
    for (const json& boundary : graph["boundaries"]) {
        EXPECT_EQ(boundary["a"], 4);
        EXPECT_EQ(boundary["b"], 0);
        ASSERT_EQ(boundary["layers"].size(), 1u);
        EXPECT_DOUBLE_EQ(boundary["layers"][0]["thickness"], 0.2);
        (boundary["layers"][0]["node"] == 3 ? door : wall) += boundary["area"].get<double>();
    }
    EXPECT_NEAR(door, 0.4 * 0.7, 1e-9);
    EXPECT_NEAR(wall + door, 2 * (2.2 * 1.4 + 2.2 * 0.9 + 1.4 * 0.9), 1e-9);
    EXPECT_GT(graph["contacts"].size(), 4u);
}

TEST(Adjacency, GraphMlHasTheSame) {
    const SemanticVolume volume = roomWithADoor();
    const std::string xml = makeGraphMl(volume);
    const json graph = json::parse(makeAdjacencyJson(volume));
    const auto count = [&](const std::string& word) {
        std::size_t found = 0;
        for (std::size_t at = xml.find(word); at != std::string::npos; at = xml.find(word, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("<node "), graph["nodes"].size());
    EXPECT_EQ(count("<edge "), graph["contacts"].size() + graph["boundaries"].size());
    EXPECT_EQ(count(">boundary</data>"), graph["boundaries"].size());
    EXPECT_NE(xml.find("<data key=\"layers\">d:0.2</data>"), std::string::npos);
    const svt::test::TemporaryFolder folder;
    svt::test::writeText(folder / "g.graphml", xml);
    if (std::system("xmllint --version >/dev/null 2>&1") == 0) {
        EXPECT_EQ(std::system(("xmllint --noout '" + (folder / "g.graphml").string() + "'").c_str()), 0);
    }
}

}  // namespace
}  // namespace svt::writers
