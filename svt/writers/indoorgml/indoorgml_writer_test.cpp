#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/indoorgml/cell_plan.hpp>
#include <svt/writers/indoorgml/indoorgml_writer.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

namespace svt::writers {
namespace {

using indoor::CellBody;
using indoor::CellPlan;
using indoor::CellShape;
using volume::SemanticVolume;

// A volume that is painted box by box; samples of 0.1 m, 4 x 3 x 2.6 m.
class Painted {
public:
    Painted() {
        volume.source = "a house.gml";
        volume.crsName = "EPSG:25832";
    }
    std::uint32_t add(const char* id, const char* className, const char* name = "") {
        volume::test::addObject(volume, id, className).name = name;
        return volume.labels.labels.back().subtreeEnd - 1;
    }
    void fill(std::uint32_t label, Vec3i begin, Vec3i end) {
        boxes_.push_back({label == volume::kNoLabel ? 0 : volume.labels.labels[label].first, begin, end});
    }
    const SemanticVolume& done() {
        volume::test::paintBoxes(volume, boxes_);
        return volume;
    }
    // Twelve triangles of a box, local metres.
    void addMesh(std::uint32_t label, Vec3d a, Vec3d b) { volume::test::addBoxMesh(volume, label, a, b); }

    SemanticVolume volume = volume::test::emptyVolume({40, 30, 26}, {0.1, 0.1, 0.1}, {1000, 2000, 50});

private:
    std::vector<volume::test::PaintedBox> boxes_;
};

//   y                                  west: 1.5 x 2.6 m, east: 1.9 x 2.6 m, both 2.2 m high
//   |  +------+###+--------+           wall: 0.3 m; the door leaf, 0.1 m thick, stands 0.1 m from both rooms
//   |  | west |:D:|  east  |D outside  entrance: through the outer wall, 0.2 m thick
//   |  +------+###+--------+
//   +------------------------ x
struct TwoRooms : Painted {
    std::uint32_t wall = add("wall", "BuildingConstructiveElement"), west = add("west", "BuildingRoom", "West & co"),
                  east = add("0east", "BuildingRoom"), door = add("d", "Door", "Door"), entrance = add("e", "Door");
    TwoRooms() {
        fill(wall, {0, 0, 0}, {40, 30, 26});
        fill(west, {2, 2, 2}, {17, 28, 24});
        fill(east, {20, 2, 2}, {38, 28, 24});
        fill(volume::kNoLabel, {17, 10, 2}, {20, 20, 22});
        fill(door, {18, 10, 2}, {19, 20, 22});
        fill(entrance, {38, 10, 2}, {40, 20, 22});
    }
};

CellPlan cellsOf(const SemanticVolume& volume) {
    auto plan = indoor::planCells(volume, {});
    EXPECT_TRUE(plan) << plan.error().message();
    return plan ? std::move(*plan) : CellPlan{};
}

double volumeOf(const CellBody& body) {
    double sum = indoor::volumeOf(body.shell);
    for (const CellShape& cavity : body.cavities) sum += indoor::volumeOf(cavity);
    return sum;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
    std::vector<std::string> found;
    const std::regex expression(pattern);
    for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
        found.push_back((*at)[1].str());
    return found;
}

// What no schema says: ids are unique, and every link leads to one.
void expectLinked(const std::string& document) {
    const auto ids = matches(document, "gml:id=\"([^\"]*)\"");
    const std::set<std::string> known(ids.begin(), ids.end());
    EXPECT_EQ(known.size(), ids.size());
    for (const std::string& id : ids) EXPECT_TRUE(std::regex_match(id, std::regex("[A-Za-z_][-A-Za-z0-9_.]*"))) << id;
    for (const std::string& link : matches(document, "xlink:href=\"#([^\"]*)\""))
        EXPECT_EQ(known.count(link), 1u) << link;
}

TEST(IndoorGmlWriter, RoomsAndTheirDoorsAreCellsThatTouch) {
    TwoRooms house;
    const CellPlan plan = cellsOf(house.done());
    ASSERT_EQ(plan.cells.size(), 4u);
    EXPECT_NEAR(volumeOf(plan.cells[0].body), 1.5 * 2.6 * 2.2, 1e-9);
    EXPECT_NEAR(volumeOf(plan.cells[1].body), 1.8 * 2.6 * 2.2, 1e-9);
    EXPECT_EQ(plan.cells[2].kind, "ConnectionSpace");
    EXPECT_NEAR(volumeOf(plan.cells[2].body), 0.3 * 1.0 * 2.0, 1e-9) << "the whole wall, not the leaf alone";
    EXPECT_EQ(plan.cells[3].kind, "AnchorSpace");
    EXPECT_NEAR(volumeOf(plan.cells[3].body), 0.2 * 1.0 * 2.0, 1e-9);
    ASSERT_EQ(plan.transitions.size(), 3u);
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& transition : plan.transitions) pairs.emplace(transition.a, transition.b);
    EXPECT_EQ(pairs, (std::set<std::pair<std::size_t, std::size_t>>{{0, 2}, {1, 2}, {1, 3}}));
    for (const auto& boundary : plan.boundaries) {
        EXPECT_NEAR(indoor::areaOf(boundary.pieces), 2.0, 1e-9);
        EXPECT_EQ(boundary.pieces.size(), 1u);
    }
    for (const auto& cell : plan.cells) EXPECT_TRUE(indoor::encloses(cell.body.shell, cell.inner)) << cell.id;
}

TEST(IndoorGmlWriter, KeptMeshesAreTakenExactly) {
    TwoRooms house;
    house.done();
    // The room of the voxels is 1.5 m wide, its mesh 1.512.
    house.addMesh(house.west, {0.15, 0.15, 0.15}, {1.662, 2.75, 2.35});
    const CellPlan plan = cellsOf(house.volume);
    ASSERT_EQ(plan.cells.size(), 4u);
    EXPECT_NEAR(volumeOf(plan.cells[0].body), 1.512 * 2.6 * 2.2, 1e-4);
    EXPECT_NEAR(volumeOf(plan.cells[2].body), (1.95 - 1.662) * 1.0 * 2.0, 1e-4) << "the door reaches to the mesh";
    EXPECT_EQ(plan.transitions.size(), 3u);
    EXPECT_EQ(indoor::facesOf(plan.cells[0].body.shell).size(), 6u);
}

// The west room ends in stairs of one voxel: the door touches the nearest step alone.
TEST(IndoorGmlWriter, DoorsReachRoomsOfOtherSlopes) {
    TwoRooms house;
    for (int j = 10; j < 20; ++j) house.fill(volume::kNoLabel, {15 + j / 10, j, 2}, {17, j + 1, 24});
    house.fill(house.west, {15, 15, 2}, {16, 16, 24});
    const CellPlan plan = cellsOf(house.done());
    ASSERT_EQ(plan.cells.size(), 4u);
    EXPECT_EQ(plan.cells[2].kind, "ConnectionSpace");
    EXPECT_EQ(plan.transitions.size(), 3u);
    expectLinked(*makeIndoorGml(house.volume));
}

TEST(IndoorGmlWriter, AWallBehindADoorIsNoWay) {
    TwoRooms house;
    house.fill(house.wall, {19, 10, 2}, {20, 20, 22});
    const CellPlan plan = cellsOf(house.done());
    ASSERT_EQ(plan.cells.size(), 4u);
    EXPECT_EQ(plan.cells[2].kind, "AnchorSpace") << "it opens to one room alone";
    EXPECT_EQ(plan.transitions.size(), 2u);
    house.fill(house.wall, {17, 10, 2}, {18, 20, 22});
    EXPECT_EQ(cellsOf(house.done()).cells.size(), 3u) << "a door that joins no rooms becomes no cell";
}

TEST(IndoorGmlWriter, RoomsThatTouchAreJoinedWhereOneCanWalk) {
    Painted open;
    const auto a = open.add("a", "BuildingRoom"), b = open.add("b", "BuildingRoom"),
               above = open.add("c", "BuildingRoom");
    open.fill(a, {2, 2, 2}, {17, 28, 13});
    open.fill(b, {17, 10, 2}, {38, 20, 13});
    open.fill(above, {2, 2, 13}, {17, 28, 24});
    const CellPlan plan = cellsOf(open.done());
    ASSERT_EQ(plan.boundaries.size(), 2u);
    ASSERT_EQ(plan.transitions.size(), 1u);
    EXPECT_EQ(std::pair(plan.transitions[0].a, plan.transitions[0].b), std::pair(std::size_t{0}, std::size_t{1}));
    EXPECT_NEAR(indoor::areaOf(plan.boundaries[plan.transitions[0].boundary].pieces), 1.0 * 1.1, 1e-9);
    const std::string document = *makeIndoorGml(open.volume);
    EXPECT_EQ(matches(document, "(<navi:NavigableBoundary)").size(), 1u);
    EXPECT_EQ(matches(document, "(<core:CellSpaceBoundary) ").size(), 1u) << "the ceiling";
    expectLinked(document);
}

TEST(IndoorGmlWriter, StatesLieWithinBentRooms) {
    Painted ell;
    const auto room = ell.add("a", "BuildingRoom");
    ell.fill(room, {2, 2, 2}, {38, 5, 24});
    ell.fill(room, {2, 2, 2}, {5, 28, 24});
    const CellPlan plan = cellsOf(ell.done());
    ASSERT_EQ(plan.cells.size(), 1u);
    const Vec3d at = plan.cells[0].inner / 0.1;
    EXPECT_EQ(ell.volume.columns.scalarAt(int(std::lround(at.x)), int(std::lround(at.y)), int(std::lround(at.z))),
              ell.volume.labels.labels[room].first);
    EXPECT_TRUE(indoor::encloses(plan.cells[0].body.shell, plan.cells[0].inner));
}

TEST(IndoorGmlWriter, PiecesAndHollowsOfARoomAreKept) {
    Painted two;
    const auto room = two.add("a", "BuildingRoom"), column = two.add("c", "BuildingConstructiveElement");
    two.fill(room, {2, 2, 2}, {14, 14, 14});
    two.fill(column, {5, 5, 5}, {9, 9, 9});
    two.fill(room, {20, 2, 2}, {30, 12, 12});
    const CellPlan plan = cellsOf(two.done());
    ASSERT_EQ(plan.cells.size(), 2u);
    EXPECT_EQ(plan.cells[0].body.cavities.size(), 1u);
    EXPECT_NEAR(volumeOf(plan.cells[0].body), 1.728 - 0.064, 1e-9);
    EXPECT_NEAR(volumeOf(plan.cells[1].body), 1, 1e-9);
    EXPECT_EQ(plan.cells[1].id, "a_2");
    const std::string document = *makeIndoorGml(two.volume);
    EXPECT_EQ(matches(document, "(<gml:interior>\n<gml:Shell>)").size(), 1u);
    expectLinked(document);
}

TEST(IndoorGmlWriter, FacesHaveTheirHoles) {
    // A block with a shaft through it: its top and bottom are a square with a hole each.
    Painted block;
    const auto room = block.add("a", "BuildingRoom");
    block.fill(room, {2, 2, 2}, {14, 14, 14});
    block.fill(volume::kNoLabel, {6, 6, 2}, {9, 9, 14});
    const auto faces = indoor::facesOf(cellsOf(block.done()).cells[0].body.shell);
    EXPECT_EQ(faces.size(), 10u);
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto& rings) { return rings.size() == 2; }), 2);
}

TEST(IndoorGmlWriter, TheDocumentSaysWhatTheVolumeKnows) {
    TwoRooms house;
    house.volume.labels.labels[house.west].attributes = {{"usage", std::string("sleep"), ""}};
    const auto storey = house.add("eg", "Storey", "EG \"low\"");
    house.volume.labels.labels[house.west].groups = {storey};
    const std::string document = *makeIndoorGml(house.done());
    expectLinked(document);
    EXPECT_NE(document.find("<navi:GeneralSpace gml:id=\"west\">"), std::string::npos);
    EXPECT_NE(document.find("<gml:name>West &amp; co</gml:name>"), std::string::npos);
    EXPECT_NE(document.find("storey=\"EG 'low'\""), std::string::npos);
    EXPECT_NE(document.find("<navi:usage>sleep</navi:usage>"), std::string::npos);
    EXPECT_NE(document.find("<navi:GeneralSpace gml:id=\"_0east\">"), std::string::npos) << "no XML name as it is";
    EXPECT_NE(document.find("<core:informationSystem>a%20house.gml</core:informationSystem>"), std::string::npos);
    EXPECT_NE(document.find("<core:name>0east</core:name>"), std::string::npos) << "the id of the model";
    EXPECT_NE(document.find("srsName=\"EPSG:25832\""), std::string::npos);
    EXPECT_EQ(matches(document, "(<core:State )").size(), 4u);
    EXPECT_EQ(matches(document, "(<core:Transition )").size(), 3u);
}

TEST(IndoorGmlWriter, EqualVolumesGiveEqualBytes) {
    TwoRooms house;
    house.done();
    VolumeWriteOptions one, four;
    one.threads = 1;
    four.threads = 4;
    EXPECT_EQ(*makeIndoorGml(house.volume, one), *makeIndoorGml(house.volume, four));
}

TEST(IndoorGmlWriter, AVolumeWithoutRoomsIsRefused) {
    Painted walls;
    walls.fill(walls.add("w", "BuildingConstructiveElement"), {2, 2, 2}, {9, 9, 9});
    EXPECT_EQ(makeIndoorGml(walls.done()).error().code(), Code::NothingSelected);
}

}  // namespace
}  // namespace svt::writers
