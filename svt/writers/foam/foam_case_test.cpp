#include <svt/analyze/contacts.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/foam/air_cells.hpp>
#include <svt/writers/foam/foam_case.hpp>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace svt::writers {
namespace {

using volume::SemanticVolume;

constexpr Vec3d kSpacing{0.1, 0.2, 0.25};

// A room with a table and a window, a sheet on its floor, and a second room behind a wall of three voxels.
SemanticVolume twoRooms() {
    SemanticVolume volume = volume::test::emptyVolume({30, 20, 14}, kSpacing, {1000, 2000, 50});
    for (const auto& [id, className, name] :
         {std::tuple("w", "BuildingConstructiveElement", "Wand Süd"), std::tuple("r1", "BuildingRoom", "Room"),
          std::tuple("r2", "BuildingRoom", "2 nd"), std::tuple("t", "BuildingFurniture", "Wand Süd"),
          std::tuple("win", "Window", ""), std::tuple("floor", "FloorSurface", "floor")})
        volume::test::addObject(volume, id, className).name = name;
    volume.labels.labels[3].parent = volume.labels.labels[5].parent = 1;
    volume::test::paintBoxes(volume, {{1, {1, 1, 1}, {29, 19, 13}},
                                      {2, {3, 3, 3}, {15, 17, 11}},
                                      {3, {18, 3, 3}, {27, 17, 11}},
                                      {4, {6, 6, 4}, {10, 9, 6}},
                                      {5, {1, 6, 5}, {3, 12, 9}},
                                      {6, {3, 3, 3}, {15, 17, 4}}});
    return volume;
}

struct Mesh {
    std::vector<Vec3d> points;
    std::vector<std::vector<std::size_t>> faces;
    std::vector<std::size_t> owner, neighbour;
    std::map<std::string, std::array<std::size_t, 2>> patches;  // count, first
};

// The entries of a list behind the header, as lines.
std::vector<std::string> entriesOf(const std::filesystem::path& file) {
    std::istringstream text(test::readText(file));
    std::string line;
    while (std::getline(text, line) && line != "}") {
    }
    std::getline(text, line);  // blank
    std::getline(text, line);
    const auto count = static_cast<std::size_t>(std::stoul(line));
    std::getline(text, line);
    EXPECT_EQ(line, "(");
    std::vector<std::string> lines;
    while (std::getline(text, line) && line != ")") lines.push_back(line);
    EXPECT_TRUE(file.filename() == "boundary" || lines.size() == count) << file;
    return lines;
}

Mesh readMesh(const std::filesystem::path& folder) {
    Mesh mesh;
    const auto file = [&](const char* name) { return folder / "constant" / "polyMesh" / name; };
    for (const std::string& line : entriesOf(file("points"))) {
        std::istringstream text(line.substr(1));
        Vec3d point;
        text >> point.x >> point.y >> point.z;
        mesh.points.push_back(point);
    }
    for (const std::string& line : entriesOf(file("faces"))) {
        EXPECT_EQ(line.substr(0, 2), "4(");
        std::istringstream text(line.substr(2));
        std::vector<std::size_t> face(4);
        for (std::size_t& point : face) text >> point;
        mesh.faces.push_back(face);
    }
    for (const std::string& line : entriesOf(file("owner"))) mesh.owner.push_back(std::stoul(line));
    for (const std::string& line : entriesOf(file("neighbour"))) mesh.neighbour.push_back(std::stoul(line));
    std::string all;
    for (const std::string& line : entriesOf(file("boundary"))) all += line;
    const std::regex pattern(R"((\w+) *\{ *type (\w+); *nFaces (\d+); *startFace (\d+); *\})");
    for (std::sregex_iterator patch(all.begin(), all.end(), pattern), end; patch != end; ++patch)
        mesh.patches[(*patch)[1].str() + ":" + (*patch)[2].str()] = {std::stoul((*patch)[3]), std::stoul((*patch)[4])};
    return mesh;
}

// Twice the area, as a vector along the normal.
Vec3d areaVector(const Mesh& mesh, std::size_t face) {
    Vec3d sum;
    const auto& points = mesh.faces[face];
    for (std::size_t p = 1; p + 1 < points.size(); ++p)
        sum = sum + cross(mesh.points[points[p]] - mesh.points[points[0]],
                          mesh.points[points[p + 1]] - mesh.points[points[0]]);
    return sum * 0.5;
}

Vec3d centreOf(const Mesh& mesh, std::size_t face) {
    Vec3d sum;
    for (const std::size_t point : mesh.faces[face]) sum = sum + mesh.points[point];
    return sum * 0.25;
}

class FoamCase : public ::testing::Test {
protected:
    Mesh write(const SemanticVolume& volume, const FoamWriteOptions& foam) {
        VolumeWriteOptions options;
        options.foam = foam;
        options.diagnostics = &notes;
        const auto path = folder / "room.foam";
        const auto written = writeVolume(volume, path, options);
        EXPECT_TRUE(written) << (written ? "" : written.error().message());
        return written ? readMesh(path) : Mesh();
    }

    std::string messageOf(const SemanticVolume& volume, const FoamWriteOptions& foam, Code code,
                          std::uint64_t maxVoxels = 1 << 20) {
        VolumeWriteOptions options;
        options.foam = foam;
        options.maxVoxels = maxVoxels;
        const auto written = writeVolume(volume, folder / "bad.foam", options);
        EXPECT_FALSE(written);
        if (written) return {};
        EXPECT_EQ(written.error().code(), code);
        EXPECT_EQ(folder.count(), 0u) << "nothing is left behind";
        return written.error().message();
    }

    test::TemporaryFolder folder;
    Diagnostics notes;
};

TEST_F(FoamCase, CellsAreTheVoxelsOfTheRoomAndCloseEachOther) {
    const Mesh mesh = write(twoRooms(), {.air = "id=r1", .temperatures = {}});
    const std::size_t cells = 12 * 14 * 8 - 4 * 3 * 2;  // without the table, with the sheet
    std::vector<Vec3d> area(cells), low(cells, {1e9, 1e9, 1e9});
    double volume = 0;
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
        const Vec3d normal = areaVector(mesh, face);
        ASSERT_LT(mesh.owner[face], cells);
        area[mesh.owner[face]] = area[mesh.owner[face]] + normal;
        volume += dot(normal, centreOf(mesh, face)) / 3;
        if (face >= mesh.neighbour.size()) continue;
        ASSERT_LT(mesh.neighbour[face], cells);
        ASSERT_LT(mesh.owner[face], mesh.neighbour[face]);
        area[mesh.neighbour[face]] = area[mesh.neighbour[face]] - normal;
        volume -= dot(normal, centreOf(mesh, face)) / 3;
        if (face == 0) continue;
        EXPECT_LT(std::pair(mesh.owner[face - 1], mesh.neighbour[face - 1]),
                  std::pair(mesh.owner[face], mesh.neighbour[face]))
            << "inner faces stand in the order of their cells";
    }
    for (const Vec3d& sum : area) EXPECT_NEAR(length(sum), 0, 1e-12);
    EXPECT_NEAR(volume, static_cast<double>(cells) * 0.1 * 0.2 * 0.25, 1e-9);
    Vec3d least = mesh.points[0], most = mesh.points[0];
    for (const Vec3d& point : mesh.points)
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = std::min(least[axis], point[axis]);
            most[axis] = std::max(most[axis], point[axis]);
        }
    EXPECT_EQ(least, (Vec3d{0.3, 0.6, 0.75}));
    EXPECT_EQ(most, (Vec3d{1.5, 3.4, 2.75}));
}

TEST_F(FoamCase, PatchesHaveTheAreasOfTheContacts) {
    const SemanticVolume volume = twoRooms();
    const Mesh mesh = write(volume, {.air = "name=Room", .temperatures = {}});
    constexpr std::array<double, 3> kAreas{0.2 * 0.25, 0.1 * 0.25, 0.1 * 0.2};
    std::map<std::uint32_t, double> expected;
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels))
        for (const auto& [one, other] : {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)})
            if ((one == 1 || one == 5) && other != 1 && other != 5)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    expected[other] += static_cast<double>(contact.faces[axis]) * kAreas[axis];
    const std::map<std::string, std::uint32_t> labels{{"Wand_S_d:wall", 0}, {"Wand_S_d_2:wall", 3}, {"win:wall", 4}};
    ASSERT_EQ(mesh.patches.size(), labels.size());
    ASSERT_EQ(expected.size(), labels.size());
    for (const auto& [name, label] : labels) {
        ASSERT_TRUE(mesh.patches.contains(name)) << name;
        const auto& [count, first] = mesh.patches.at(name);
        double area = 0;
        for (std::size_t face = first; face < first + count; ++face) area += length(areaVector(mesh, face));
        EXPECT_NEAR(area, expected.at(label), 1e-9) << name;
    }
    const std::string table = test::readText(folder / "room.foam" / "patches.csv");
    EXPECT_NE(table.find("win,component,win,Window,,24,1.2,20"), std::string::npos) << table;
}

TEST_F(FoamCase, SurfacesHaveTheirTemperatures) {
    write(twoRooms(), {.air = "id=r1", .temperatures = {"class=BuildingFurniture:40", "class=Window:-5.5"}});
    const std::string text = test::readText(folder / "room.foam" / "0" / "T");
    EXPECT_NE(text.find("    Wand_S_d { type fixedValue; value uniform 293.15; }\n"), std::string::npos) << text;
    EXPECT_NE(text.find("    Wand_S_d_2 { type fixedValue; value uniform 313.15; }\n"), std::string::npos) << text;
    EXPECT_NE(text.find("    win { type fixedValue; value uniform 267.65; }\n"), std::string::npos) << text;
    EXPECT_TRUE(notes.items().empty());
}

TEST_F(FoamCase, RoomsThatTouchAreOneCaseAndOthersAreAdiabatic) {
    SemanticVolume volume = twoRooms();
    volume::test::paintBoxes(
        volume, {{1, {1, 1, 1}, {29, 19, 13}}, {2, {3, 3, 3}, {15, 17, 11}}, {3, {15, 3, 3}, {27, 17, 11}}});
    const Mesh one = write(volume, {.air = "id=r1", .temperatures = {}});
    EXPECT_TRUE(one.patches.contains("part_2_nd:patch"));
    EXPECT_NE(test::readText(folder / "room.foam" / "0" / "T").find("    part_2_nd { type zeroGradient; }\n"),
              std::string::npos);
    EXPECT_NE(test::readText(folder / "room.foam" / "0" / "U").find("    part_2_nd { type slip; }\n"),
              std::string::npos);
    ASSERT_EQ(notes.items().size(), 1u);
    EXPECT_NE(notes.items()[0].message.find("the air stays at rest"), std::string::npos);
    std::filesystem::remove_all(folder / "room.foam");
    const Mesh both = write(volume, {});
    EXPECT_EQ(both.patches.size(), 1u);
}

TEST_F(FoamCase, SmallPiecesAreLeftOutAndLargeOnesRefused) {
    SemanticVolume volume = twoRooms();
    EXPECT_NE(messageOf(volume, {}, Code::BadArgument).find("in 2 pieces that do not touch"), std::string::npos);
    EXPECT_NE(messageOf(volume, {}, Code::BadArgument).find("'Room' with 1320 cells, '2 nd' with 1008 cells"),
              std::string::npos);
    volume::test::paintBoxes(volume,
                             {{1, {1, 1, 1}, {29, 19, 13}}, {2, {3, 3, 3}, {15, 17, 11}}, {2, {20, 3, 3}, {21, 4, 4}}});
    const auto cells = airCells(volume, {}, 1 << 20);
    ASSERT_TRUE(cells);
    EXPECT_EQ(cells->count, 12u * 14 * 8);
    EXPECT_EQ(cells->leftOut, 1u);
    write(volume, {});
    ASSERT_FALSE(notes.items().empty());
    EXPECT_NE(notes.items()[0].message.find("the other 1344 cells are left out: 1"), std::string::npos);
}

TEST_F(FoamCase, RefusesWhatItCannotCompute) {
    const SemanticVolume volume = twoRooms();
    EXPECT_NE(messageOf(volume, {.air = "class=Window", .temperatures = {}}, Code::NothingSelected)
                  .find("no room with voxels"),
              std::string::npos);
    EXPECT_NE(messageOf(volume, {.air = "id=r1", .temperatures = {}}, Code::BadArgument, 1319).find("--max-voxels"),
              std::string::npos);
    EXPECT_NE(messageOf(volume, {.air = "id=r1", .temperatures = {"class=Window"}}, Code::BadArgument)
                  .find("is not QUERY:CELSIUS of --surface-temperature"),
              std::string::npos);
    EXPECT_NE(messageOf(volume, {.air = "id=r1", .temperatures = {"id=r2:12"}}, Code::BadArgument)
                  .find("selects no component that the air touches"),
              std::string::npos);
    EXPECT_NE(messageOf(volume, {.air = "id=r1", .temperatures = {"class=Window:1e4"}}, Code::BadArgument)
                  .find("not between -100 and 1000"),
              std::string::npos);
    messageOf(volume, {.air = "id=", .temperatures = {}}, Code::BadQuery);
    std::filesystem::create_directory(folder / "room.foam");
    const auto written = writeVolume(volume, folder / "room.foam", {});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code(), Code::WouldDestroy);
}

}  // namespace
}  // namespace svt::writers
