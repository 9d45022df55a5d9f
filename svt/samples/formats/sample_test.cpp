#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/samples/formats/read_back_test.hpp>
#include <svt/samples/formats/sample_text.hpp>
#include <svt/samples/parts/placement.hpp>
#include <svt/samples/parts/random.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace svt::samples {
namespace {

using test::openEdges;
using test::Polygons;
using test::ReadBack;
using test::readCityJson;
using test::readGml;
using test::unevenness;
using test::volumeOf;

SampleOptions smallOptions() {
    SampleOptions options;
    options.storeys = 3;
    options.columns = 3;
    options.rows = 2;
    return options;
}

std::string text(SampleKind kind, SampleFormat format, const SampleOptions& options) {
    const Result<std::string> written = writeSample(kind, format, options);
    EXPECT_TRUE(written) << (written ? "" : written.error().toString());
    return written ? *written : std::string();
}

std::vector<SampleComponent> describe(SampleKind kind, const SampleOptions& options) {
    const Result<std::vector<SampleComponent>> described = describeSample(kind, options);
    EXPECT_TRUE(described) << (described ? "" : described.error().toString());
    return described ? *described : std::vector<SampleComponent>();
}

std::map<std::string, SampleComponent> byId(std::vector<SampleComponent> components) {
    std::map<std::string, SampleComponent> result;
    for (SampleComponent& component : components) result.emplace(component.id, component);
    return result;
}

bool sharesSpace(const SampleComponent& component) {
    static const std::set<std::string> classes{"BuildingConstructiveElement", "BuildingRoom", "Window", "Door"};
    return classes.count(component.className) != 0;
}

// Points of a lattice with odd steps, so that none lies on a plane of a design.
template <class Visit>
void forLattice(Vec3d low, Vec3d high, Vec3d step, const Visit& visit) {
    for (double z = low.z + 0.0137; z < high.z; z += step.z)
        for (double y = low.y + 0.0119; y < high.y; y += step.y)
            for (double x = low.x + 0.0113; x < high.x; x += step.x) visit(Vec3d{x, y, z});
}

// Whole millimetres are exact up to the resolution of double at 5,400 km; micrometre rounding after an arbitrary
// rotation tilts thin faces.
enum class Coordinates { Millimetres, Micrometres };

void expectSolidsAsDescribed(const ReadBack& read, const std::vector<SampleComponent>& components,
                             Coordinates coordinates) {
    const double flatness = coordinates == Coordinates::Millimetres ? 1e-7 : 2e-5;
    const double tolerance = coordinates == Coordinates::Millimetres ? 1e-6 : 2e-4;
    EXPECT_TRUE(read.dangling.empty()) << read.dangling.front();
    for (const SampleComponent& component : components) {
        EXPECT_TRUE(read.ids.count(component.id) != 0) << component.id;
        if (component.solids.empty()) continue;
        const auto shells = read.shells.find(component.id);
        if (shells == read.shells.end()) {
            ADD_FAILURE() << component.id << " has no solid";
            continue;
        }
        double volume = 0;
        for (const Polygons& shell : shells->second) {
            EXPECT_EQ(openEdges(shell), 0u) << component.id;
            EXPECT_GT(volumeOf(shell), 0) << component.id;
            EXPECT_LT(unevenness(shell), flatness) << component.id;
            volume += volumeOf(shell);
        }
        EXPECT_NEAR(volume, component.volume, tolerance * std::max(1.0, component.volume)) << component.id;
    }
}

// Some houses of a district are rotated by arbitrary angles.
Coordinates coordinatesOf(SampleKind kind) {
    return kind == SampleKind::District ? Coordinates::Micrometres : Coordinates::Millimetres;
}

// The second chair of the implicit pair contains no shape of its own in CityGML 2.0.
std::vector<SampleComponent> withoutImplicit(std::vector<SampleComponent> components) {
    std::erase_if(components, [](const SampleComponent& c) { return c.id == "house_chair_3"; });
    return components;
}

class EveryKind : public testing::TestWithParam<SampleKind> {};

INSTANTIATE_TEST_SUITE_P(Sample, EveryKind, testing::Values(SampleKind::House, SampleKind::Tower, SampleKind::District),
                         [](const auto& kind) {
                             return kind.param == SampleKind::House   ? "House"
                                    : kind.param == SampleKind::Tower ? "Tower"
                                                                      : "District";
                         });

TEST_P(EveryKind, SolidsOfCityGml3AreClosedAndHaveTheDescribedVolume) {
    const SampleOptions options = smallOptions();
    const std::vector<SampleComponent> components = describe(GetParam(), options);
    expectSolidsAsDescribed(readGml(text(GetParam(), SampleFormat::CityGml3, options)), components,
                            coordinatesOf(GetParam()));
}

TEST_P(EveryKind, SolidsOfCityGml2AreClosedAndHaveTheDescribedVolume) {
    const SampleOptions options = smallOptions();
    std::vector<SampleComponent> components = withoutImplicit(describe(GetParam(), options));
    expectSolidsAsDescribed(readGml(text(GetParam(), SampleFormat::CityGml2, options)), components,
                            coordinatesOf(GetParam()));
}

TEST_P(EveryKind, SolidsOfCityJsonAreClosedAndHaveTheDescribedVolume) {
    const SampleOptions options = smallOptions();
    const nlohmann::json file = nlohmann::json::parse(text(GetParam(), SampleFormat::CityJson2, options));
    expectSolidsAsDescribed(readCityJson(file), describe(GetParam(), options), coordinatesOf(GetParam()));
}

TEST_P(EveryKind, IdsOfCityJsonAreExactlyTheDescribedOnes) {
    const SampleOptions options = smallOptions();
    const nlohmann::json file = nlohmann::json::parse(text(GetParam(), SampleFormat::CityJson2, options));
    std::set<std::string> expected, found;
    for (const SampleComponent& component : describe(GetParam(), options)) expected.insert(component.id);
    for (const auto& [id, object] : file["CityObjects"].items())
        if (id != "ground") found.insert(id);
    EXPECT_EQ(found, expected);
}

TEST_P(EveryKind, ParentsOfCityJsonAreTheDescribedOnes) {
    const SampleOptions options = smallOptions();
    const nlohmann::json file = nlohmann::json::parse(text(GetParam(), SampleFormat::CityJson2, options));
    for (const SampleComponent& component : describe(GetParam(), options)) {
        const nlohmann::json& object = file["CityObjects"][component.id];
        if (component.parent.empty()) continue;
        EXPECT_EQ(object["parents"][0], component.parent) << component.id;
        for (const auto& parent : object["parents"]) {
            const nlohmann::json& children = file["CityObjects"][parent.get<std::string>()]["children"];
            EXPECT_NE(std::find(children.begin(), children.end(), component.id), children.end()) << component.id;
        }
    }
}

TEST_P(EveryKind, SequenceHoldsTheSameObjectsAsTheDocument) {
    const SampleOptions options = smallOptions();
    const nlohmann::json file = nlohmann::json::parse(text(GetParam(), SampleFormat::CityJson2, options));
    const std::string sequence = text(GetParam(), SampleFormat::CityJsonSeq2, options);
    std::set<std::string> expected, found;
    for (const auto& [id, object] : file["CityObjects"].items()) expected.insert(id);
    for (std::size_t at = sequence.find('\n') + 1; at < sequence.size();) {
        const std::size_t end = sequence.find('\n', at);
        const nlohmann::json feature = nlohmann::json::parse(sequence.substr(at, end - at));
        EXPECT_EQ(feature["type"], "CityJSONFeature");
        EXPECT_TRUE(feature["CityObjects"].contains(feature["id"].get<std::string>()));
        for (const auto& [id, object] : feature["CityObjects"].items()) found.insert(id);
        at = end + 1;
    }
    EXPECT_EQ(found, expected);
}

TEST_P(EveryKind, HullOfTheThematicModelIsClosedAndEnclosesWhatFillsIt) {
    SampleOptions options = smallOptions();
    options.thematic = true;
    const ReadBack read = readGml(text(GetParam(), SampleFormat::CityGml2, options));
    EXPECT_TRUE(read.dangling.empty()) << read.dangling.front();
    std::map<std::string, double> filled;
    std::string building;
    for (const SampleComponent& component : describe(GetParam(), options)) {
        if (component.className == "Building") building = component.id;
        if (sharesSpace(component)) filled[building] += component.volume;
        if (component.className != "BuildingRoom") continue;
        ASSERT_EQ(read.shells.count(component.id), 1u) << component.id;
        const Polygons& room = read.shells.at(component.id).front();
        EXPECT_EQ(openEdges(room), 0u) << component.id;
        EXPECT_NEAR(volumeOf(room), component.volume, 1e-4) << component.id;
    }
    for (const auto& [id, volume] : filled) {
        ASSERT_EQ(read.shells.count(id), 1u) << id;
        const Polygons& hull = read.shells.at(id).front();
        EXPECT_EQ(openEdges(hull), 0u) << id;
        EXPECT_NEAR(volumeOf(hull), volume, 1e-6 * volume) << id;
    }
}

TEST_P(EveryKind, EveryFormatFollowsItsSchema) {
    SVT_NEEDS_DATA(schema, "schemas/all_citygml.xsd");
    if (std::system("xmllint --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "xmllint is not installed";
    const svt::test::TemporaryFolder folder;
    struct Case {
        const char* name;
        SampleFormat format;
        bool thematic;
    };
    for (const Case& c : {Case{"gml3", SampleFormat::CityGml3, false}, Case{"gml2", SampleFormat::CityGml2, false},
                          Case{"gml2_thematic", SampleFormat::CityGml2, true}}) {
        SampleOptions options = smallOptions();
        options.thematic = c.thematic;
        options.turnDegrees = 17;
        svt::test::writeText(folder / c.name, text(GetParam(), c.format, options));
    }
    // All at once: reading the schemas takes longer than the files.
    const std::string command = "cd '" + folder.path().string() + "' && xmllint --nonet --noout --schema '" +
                                schema.string() + "' gml3 gml2 gml2_thematic >output.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << svt::test::readText(folder / "output.txt").substr(0, 2000);
}

TEST_P(EveryKind, SameArgumentsGiveTheSameBytes) {
    for (const SampleFormat format : {SampleFormat::CityGml3, SampleFormat::CityGml2, SampleFormat::CityJson2,
                                      SampleFormat::CityJsonSeq2, SampleFormat::Ifc4})
        EXPECT_EQ(text(GetParam(), format, smallOptions()), text(GetParam(), format, smallOptions()));
}

TEST_P(EveryKind, NoTwoComponentsClaimAPoint) {
    const std::vector<SampleComponent> components = describe(GetParam(), smallOptions());
    const std::map<std::string, SampleComponent> all = byId(components);
    const Vec3d origin = smallOptions().origin;
    const Vec3d size = GetParam() == SampleKind::House ? Vec3d{12, 11, 9} : Vec3d{22, 19, 13};
    const Vec3d step = GetParam() == SampleKind::House ? Vec3d{0.231, 0.213, 0.197} : Vec3d{0.623, 0.577, 0.491};
    forLattice(origin - Vec3d{1, 1, 1}, origin + size, step, [&](Vec3d p) {
        std::vector<std::string> fillers, furnishings;
        for (const SampleComponent& component : components) {
            if (!component.contains(p)) continue;
            if (sharesSpace(component)) fillers.push_back(component.id);
            const auto parent = all.find(component.parent);
            const bool isInRoom = parent != all.end() && parent->second.className == "BuildingRoom";
            if (!isInRoom) continue;
            EXPECT_TRUE(parent->second.contains(p)) << component.id << " leaves " << component.parent;
            furnishings.push_back(component.id);
        }
        EXPECT_LE(fillers.size(), 1u) << fillers[0] << " and " << fillers[1];
        EXPECT_LE(furnishings.size(), 1u) << furnishings[0] << " and " << furnishings[1];
    });
}

TEST(House, EveryPointInsideBelongsToExactlyOneComponent) {
    const std::vector<SampleComponent> components = describe(SampleKind::House, {});
    const Vec3d origin = SampleOptions{}.origin;
    forLattice({0.365, 0.365, 0}, {10.635, 8.635, 7.7}, {0.171, 0.163, 0.157}, [&](Vec3d p) {
        const double roof = 4.160 + 0.8 * std::min(p.y, 9 - p.y);
        const bool isFlue = p.x > 7.465 && p.x < 7.665 && p.y > 3.45 && p.y < 3.65 && p.z > 0.3;
        if (p.z > roof || isFlue) return;
        int count = 0;
        for (const SampleComponent& component : components)
            count += sharesSpace(component) && component.contains(origin + p) ? 1 : 0;
        EXPECT_EQ(count, 1) << p.x << " " << p.y << " " << p.z;
    });
}

TEST(House, VolumesAreThoseOfTheDrawing) {
    const std::map<std::string, SampleComponent> all = byId(describe(SampleKind::House, {}));
    const auto volume = [&](const std::string& id) { return all.at("house_" + id).volume; };
    EXPECT_NEAR(volume("ground_slab"), 11.0 * 9.0 * 0.25, 1e-9);
    EXPECT_NEAR(volume("suspended_ceiling"), 6.835 * 4.255 * 0.025, 1e-9);
    EXPECT_NEAR(volume("hidden_beam"), 0.24 * 4.485 * 0.25, 1e-9);
    EXPECT_NEAR(volume("ceiling_void"), 6.835 * 4.255 * 0.285 - 0.24 * 4.255 * 0.25, 1e-9);
    EXPECT_NEAR(volume("slab_1"), (11.0 * 9.0 - 3.24 * 1.0 - 0.25) * 0.2, 1e-9);
    EXPECT_NEAR(volume("rafter_south_5"), 0.08 * 0.2 * 5.02, 1e-9);
    EXPECT_NEAR(volume("rafter_north_5"), 0.08 * 0.2 * 5.02, 1e-9);
    EXPECT_NEAR(volume("ridge_beam"), 11.72 * 0.16 * 0.24, 1e-9);
    EXPECT_NEAR(volume("stair"), 1.0 * (0.27 * 0.185 + 14 * 0.27 * 0.2775), 1e-9);
    EXPECT_NEAR(volume("chimney"), 0.25 * 8.7 - 0.04 * 8.4, 1e-9);
    EXPECT_NEAR(volume("wall_wc"), 1.62 * 0.115 * 2.76, 1e-9);
    // A knee wall under the slope: trapezoid 4.160 to 4.452 above 2.960, 13 rafters notched out of its top.
    EXPECT_NEAR(volume("wall_south_1"), 10.27 * 0.365 * (1.2 + 1.492) / 2 - 13 * 0.08 * 0.365 * 0.2, 1e-9);
    // The south roof slab without its window and the chimney.
    EXPECT_NEAR(volume("roof_south"), 0.25 * (11.8 * 5.1 - 0.71 * 0.75 - 0.25), 1e-9);
}

TEST(House, HiddenBeamIsSeenFromNoRoomButTheCeilingVoid) {
    const std::vector<SampleComponent> components = describe(SampleKind::House, {});
    const Vec3d origin = SampleOptions{}.origin;
    const Vec3d below = origin + Vec3d{3.7, 2.5, 2.505};  // 5 mm under the beam
    for (const SampleComponent& component : components) {
        const bool isThere = component.contains(below) && sharesSpace(component);
        EXPECT_EQ(isThere, component.id == "house_ceiling_void") << component.id;
    }
}

TEST(House, WindowsAndDoorsStandInTheWallThatOwnsThem) {
    const std::map<std::string, SampleComponent> all = byId(describe(SampleKind::House, {}));
    EXPECT_EQ(all.at("house_window_kitchen_east").parent, "house_wall_east_0");
    EXPECT_EQ(all.at("house_door_living").parent, "house_wall_spine_0");
    EXPECT_EQ(all.at("house_attic_hatch").parent, "house_attic_floor");
    EXPECT_EQ(all.at("house_roof_window_gallery").parent, "house_roof_north");
    EXPECT_EQ(all.at("house_chair_1").parent, "house_living");
    EXPECT_EQ(all.at("house_living").storey, "house_storey_0");
}

TEST(House, NeighborsShareTheirFacesByXLinkInCityGml2) {
    const std::string gml = text(SampleKind::House, SampleFormat::CityGml2, {});
    // The passage between living room and kitchen is one polygon; the kitchen uses it reversed.
    const std::size_t kitchen = gml.find("<bldg:Room gml:id=\"house_kitchen\"");
    const std::size_t end = gml.find("</bldg:Room>", kitchen);
    const std::string room = gml.substr(kitchen, end - kitchen);
    const std::size_t closure = room.find("<bldg:ClosureSurface");
    ASSERT_NE(closure, std::string::npos);
    EXPECT_NE(room.find("orientation=\"-\"><gml:baseSurface xlink:href=\"#house_living_p", closure), std::string::npos);
    EXPECT_NE(room.find("orientation=\"-\"><gml:baseSurface xlink:href=\"#house_wall_spine_0_p"), std::string::npos);
    EXPECT_NE(room.find("orientation=\"-\"><gml:baseSurface xlink:href=\"#house_door_kitchen_p"), std::string::npos);
    // No face of a room is written twice: rooms contain polygons only where they face each other.
    EXPECT_EQ(room.find("<gml:Polygon gml:id=\"house_kitchen_p"), std::string::npos);
}

TEST(House, RoomIsNoDifferentThroughImplicitGeometry) {
    SampleOptions options;
    options.turnDegrees = 30;
    const nlohmann::json file = nlohmann::json::parse(text(SampleKind::House, SampleFormat::CityJson2, options));
    EXPECT_EQ(file["CityObjects"]["house_chair_2"]["geometry"][0]["type"], "GeometryInstance");
    const ReadBack read = readCityJson(file);
    const std::map<std::string, SampleComponent> all = byId(describe(SampleKind::House, options));
    const Vec3d origin = options.origin;
    for (const char* id : {"house_chair_2", "house_chair_3", "house_chair_1"}) {
        Vec3d center;
        std::size_t count = 0;
        for (const auto& polygon : read.shells.at(id).front())
            for (const Vec3d p : polygon.front()) {
                center = center + p;
                ++count;
            }
        center = center / double(count) + origin;
        center.z = origin.z + 0.45;  // in the seat
        EXPECT_TRUE(all.at(id).contains(center)) << id;
    }
}

TEST(Tower, UnitsEncloseTheirRoomsAndNeverMeet) {
    const std::vector<SampleComponent> components = describe(SampleKind::Tower, smallOptions());
    const Vec3d origin = smallOptions().origin;
    forLattice(origin, origin + Vec3d{21, 17, 9.5}, {0.431, 0.379, 0.353}, [&](Vec3d p) {
        std::vector<std::string> units;
        for (const SampleComponent& component : components)
            if (component.className == "BuildingUnit" && component.contains(p)) units.push_back(component.id);
        ASSERT_LE(units.size(), 1u);
        for (const SampleComponent& component : components) {
            if (component.className != "BuildingRoom" || !component.contains(p)) continue;
            ASSERT_EQ(units.size(), 1u) << component.id;
            EXPECT_EQ(component.unit, units[0]) << component.id;
        }
    });
}

TEST(Tower, SharesOfAllFlatsAddUpToOne) {
    SampleOptions options = smallOptions();
    options.flatsPerStorey = 5;
    const nlohmann::json file = nlohmann::json::parse(text(SampleKind::Tower, SampleFormat::CityJson2, options));
    std::int64_t sum = 0, whole = -1, flats = 0;
    for (const auto& [id, object] : file["CityObjects"].items()) {
        if (object["type"] != "BuildingUnit" || !object["attributes"].contains("share")) continue;
        EXPECT_TRUE(object["attributes"].contains("owner"));
        const std::string share = object["attributes"]["share"];
        sum += std::stoll(share);
        whole = std::stoll(share.substr(share.find('/') + 1));
        ++flats;
    }
    EXPECT_EQ(flats, 15);
    EXPECT_EQ(sum, whole);
}

TEST(Tower, EveryNumberOfFlatsAndStoreysGivesClosedSolids) {
    for (int flats = 2; flats <= 8; ++flats)
        for (const int storeys : {1, 2}) {
            if (storeys == 1 && flats % 3 != 2) continue;
            SampleOptions options;
            options.flatsPerStorey = flats;
            options.storeys = storeys;
            SCOPED_TRACE(testing::Message() << flats << " flats, " << storeys << " storeys");
            const nlohmann::json file =
                nlohmann::json::parse(text(SampleKind::Tower, SampleFormat::CityJson2, options));
            expectSolidsAsDescribed(readCityJson(file), describe(SampleKind::Tower, options), Coordinates::Millimetres);
        }
}

TEST(Tower, TallestTowerHasAllStoreys) {
    SampleOptions options;
    options.storeys = 200;
    options.flatsPerStorey = 8;
    const std::vector<SampleComponent> components = describe(SampleKind::Tower, options);
    EXPECT_EQ(
        std::count_if(components.begin(), components.end(), [](const auto& c) { return c.className == "Storey"; }),
        200);
    EXPECT_EQ(std::count_if(components.begin(), components.end(),
                            [](const auto& c) { return c.className == "BuildingUnit"; }),
              200 * 9);
}

TEST(District, HousesDifferAndStandApart) {
    SampleOptions options;
    options.columns = 8;
    options.rows = 8;
    const std::vector<SampleComponent> components = describe(SampleKind::District, options);
    std::set<double> volumes;
    for (const SampleComponent& component : components)
        if (component.name == "Roof slab south") volumes.insert(std::round(component.volume * 1e6));
    EXPECT_GE(volumes.size(), 6u);
    // Every house stays within its lot: no point within 1 m of the border of a lot is inside a house.
    for (const SampleComponent& component : components) {
        if (component.name != "Roof slab south" && component.name != "Roof slab north") continue;
        for (double t = 0.01; t < 8 * 22; t += 0.37)
            for (double z = 2; z < 12; z += 0.49)
                for (int line = 0; line <= 8; ++line) {
                    EXPECT_FALSE(component.contains(options.origin + Vec3d{t, line * 20.0, z})) << component.id;
                    EXPECT_FALSE(component.contains(options.origin + Vec3d{line * 22.0, t, z})) << component.id;
                }
    }
}

TEST(District, IsWrittenInSmallParts) {
    SampleOptions options;
    options.columns = 30;
    options.rows = 30;
    std::size_t largest = 0, total = 0, buildings = 0;
    std::string tail;
    const Result<void> written =
        writeSample(SampleKind::District, SampleFormat::CityJson2, options, [&](std::string_view part) {
            largest = std::max(largest, part.size());
            total += part.size();
            tail.append(part);
            for (std::size_t at = 0; (at = tail.find("{\"type\":\"Building\",", at)) != std::string::npos; ++at)
                ++buildings;
            tail.erase(0, tail.size() - std::min<std::size_t>(tail.size(), 18));
            return true;
        });
    ASSERT_TRUE(written);
    EXPECT_EQ(buildings, 900u);
    EXPECT_GT(total, 20'000'000u);
    EXPECT_LT(largest, 200'000u);
}

TEST(District, StopsWhereTheSinkTakesNoMore) {
    SampleOptions options;
    options.columns = 1000;
    options.rows = 1000;
    for (const SampleFormat format :
         {SampleFormat::CityGml3, SampleFormat::CityGml2, SampleFormat::CityJson2, SampleFormat::CityJsonSeq2}) {
        int calls = 0;
        const Result<void> written =
            writeSample(SampleKind::District, format, options, [&](std::string_view) { return ++calls < 3; });
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().code(), Code::CannotWrite);
        EXPECT_EQ(calls, 3);
    }
}

TEST(Sample, TurnKeepsVolumesAndMovesThePoints) {
    SampleOptions options = smallOptions();
    options.turnDegrees = 33.3;
    for (const SampleKind kind : {SampleKind::House, SampleKind::Tower, SampleKind::District}) {
        const std::vector<SampleComponent> turned = describe(kind, options), straight = describe(kind, smallOptions());
        ASSERT_EQ(turned.size(), straight.size());
        for (std::size_t i = 0; i < turned.size(); ++i) EXPECT_EQ(turned[i].volume, straight[i].volume);
        expectSolidsAsDescribed(readGml(text(kind, SampleFormat::CityGml3, options)), turned, Coordinates::Micrometres);
    }
}

TEST(Sample, QuarterTurnsKeepMillimetres) {
    SampleOptions options;
    options.turnDegrees = 90;
    const std::string gml = text(SampleKind::House, SampleFormat::CityGml3, options);
    EXPECT_EQ(gml.find("000000 "), std::string::npos) << "six decimals";
    expectSolidsAsDescribed(readGml(gml), describe(SampleKind::House, options), Coordinates::Millimetres);
}

TEST(Sample, DescribedShapesLieWhereTheFilePutsThem) {
    SampleOptions options;
    options.turnDegrees = 123.4;
    options.origin = {458877.25, 5438353.5, 111.75};
    const ReadBack read = readGml(text(SampleKind::House, SampleFormat::CityGml3, options));
    const std::map<std::string, SampleComponent> all = byId(describe(SampleKind::House, options));
    for (const char* id :
         {"house_wall_wc", "house_hidden_beam", "house_rafter_north_3", "house_suspended_ceiling", "house_fridge"}) {
        Vec3d center;
        std::set<Vec3d> corners;
        for (const auto& polygon : read.shells.at(id).front())
            for (const Vec3d p : polygon.front()) corners.insert(p);
        for (const Vec3d p : corners) center = center + p / double(corners.size());
        EXPECT_TRUE(all.at(id).contains(center)) << id;
        for (const Vec3d p : corners) {
            EXPECT_TRUE(all.at(id).contains(p + (center - p) * 0.001)) << id;
            EXPECT_FALSE(all.at(id).contains(p + (p - center) * 0.001)) << id;
        }
    }
}

TEST(Sample, SeedDecidesOwnersAndHouses) {
    SampleOptions one = smallOptions(), two = smallOptions();
    two.seed = 2;
    EXPECT_NE(text(SampleKind::Tower, SampleFormat::CityJson2, one),
              text(SampleKind::Tower, SampleFormat::CityJson2, two));
    EXPECT_NE(text(SampleKind::District, SampleFormat::CityJson2, one),
              text(SampleKind::District, SampleFormat::CityJson2, two));
    EXPECT_EQ(text(SampleKind::House, SampleFormat::CityJson2, one),
              text(SampleKind::House, SampleFormat::CityJson2, two));
}

TEST(Sample, ValueOutOfRangeIsNamed) {
    const auto messageFor = [](const auto& change) {
        SampleOptions options;
        change(options);
        const Result<std::string> written = writeSample(SampleKind::Tower, SampleFormat::CityJson2, options);
        EXPECT_FALSE(written);
        EXPECT_EQ(written.error().code(), Code::BadArgument);
        EXPECT_FALSE(describeSample(SampleKind::House, options));
        return written.error().message();
    };
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.storeys = 201; }), "storeys is 201, allowed is 1 to 200");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.flatsPerStorey = 1; }), "flatsPerStorey is 1, allowed is 2 to 8");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.columns = 0; }), "columns is 0, allowed is 1 to 1000");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.rows = 1001; }), "rows is 1001, allowed is 1 to 1000");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.turnDegrees = 361; }),
              "turnDegrees is 361, allowed is -360 to 360 degrees");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.turnDegrees = std::nan(""); }),
              "turnDegrees is nan, allowed is -360 to 360 degrees");
    EXPECT_EQ(messageFor([](SampleOptions& o) { o.origin.y = 2e7; }),
              "origin.y is 20000000, allowed is -10000000 to 10000000 m");
    SampleOptions large;
    large.columns = large.rows = 1000;
    EXPECT_FALSE(describeSample(SampleKind::District, large));
}

// Every record is used by a later one, has a number of its own, and refers to what comes before it.
TEST_P(EveryKind, RecordsOfIfcReferBackwards) {
    const std::string ifc = text(GetParam(), SampleFormat::Ifc4, smallOptions());
    std::set<std::string> globalIds;
    int last = 0;
    for (std::size_t at = ifc.find("DATA;\n") + 6; ifc[at] == '#';) {
        const std::size_t end = ifc.find('\n', at);
        const std::string record = ifc.substr(at, end - at);
        EXPECT_EQ(std::atoi(record.c_str() + 1), ++last);
        EXPECT_TRUE(record.ends_with(");")) << record;
        for (std::size_t ref = record.find('#', 1); ref != std::string::npos; ref = record.find('#', ref + 1)) {
            const int target = std::atoi(record.c_str() + ref + 1);
            EXPECT_TRUE(target > 0 && target < last) << record;
        }
        const std::size_t id = record.find("('");
        const bool hasGlobalId = id != std::string::npos && record.find("',$,", id) == id + 24;
        EXPECT_TRUE(!hasGlobalId || globalIds.insert(record.substr(id + 2, 22)).second) << record;
        at = end + 1;
    }
    EXPECT_GT(globalIds.size(), 100u);
    EXPECT_TRUE(ifc.ends_with("ENDSEC;\nEND-ISO-10303-21;\n"));
}

TEST(House, IsParametricInIfc) {
    const std::string ifc = text(SampleKind::House, SampleFormat::Ifc4, {});
    const auto count = [&](const std::string& word) {
        std::size_t found = 0;
        for (std::size_t at = ifc.find(word); at != std::string::npos; at = ifc.find(word, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("=IFCRELFILLSELEMENT("), 30u);  // 16 windows in walls, 2 in roofs, 11 doors, the hatch
    EXPECT_EQ(count("=IFCRELVOIDSELEMENT("), count("=IFCOPENINGELEMENT("));
    EXPECT_EQ(count("=IFCMAPPEDITEM("), 2u);
    EXPECT_EQ(count("=IFCBUILDINGSTOREY("), 3u);
    EXPECT_EQ(count("=IFCFACETEDBREP("), 0u);
    // The wall in the west is built from outside to inside.
    EXPECT_NE(ifc.find("'exterior plaster, mineral wool insulation, brick masonry, interior plaster'"),
              std::string::npos);
}

TEST(House, HasBakedOpeningsInIfc) {
    SampleOptions options;
    options.bakeOpenings = true;
    const std::string ifc = text(SampleKind::House, SampleFormat::Ifc4, options);
    for (const char* word : {"IFCOPENINGELEMENT", "IFCRELVOIDSELEMENT", "IFCRELFILLSELEMENT"})
        EXPECT_EQ(ifc.find(word), std::string::npos) << word;
    EXPECT_NE(ifc.find("=IFCFACETEDBREP("), std::string::npos);
    const auto refused = writeSample(SampleKind::House, SampleFormat::CityGml3, options);
    ASSERT_FALSE(refused.hasValue());
    EXPECT_NE(refused.error().message().find("only IFC files"), std::string::npos) << refused.error().message();
}

// A change of a design or writer changes these hashes.
TEST(Sample, BytesAreTheSameOnEveryMachine) {
    SampleOptions turned = smallOptions();
    turned.turnDegrees = 12.5;
    EXPECT_EQ(fnvHash(text(SampleKind::House, SampleFormat::CityGml3, {})), 12192302716060641339u);
    EXPECT_EQ(fnvHash(text(SampleKind::House, SampleFormat::CityGml2, turned)), 9709734554619383749u);
    EXPECT_EQ(fnvHash(text(SampleKind::Tower, SampleFormat::CityJson2, turned)), 15661415079836536294u);
    EXPECT_EQ(fnvHash(text(SampleKind::District, SampleFormat::CityGml3, turned)), 3226204104232761395u);
    EXPECT_EQ(fnvHash(text(SampleKind::Tower, SampleFormat::Ifc4, turned)), 2272212356315569772u);
}

TEST(TextSink, NumbersHaveFixedDecimals) {
    EXPECT_EQ(fixedText(0, 3), "0.000");
    EXPECT_EQ(fixedText(-20, 3), "-0.020");
    EXPECT_EQ(fixedText(1500, 3), "1.500");
    EXPECT_EQ(fixedText(5400000123456, 6), "5400000.123456");
    EXPECT_EQ(fixedText(-7, 0), "-7");
}

TEST(Placement, QuarterTurnsAreExact) {
    const Placement placement({}, {}, Rotation::byDegrees(-270, 5500, 4500), {1000, 2000, 3000});
    EXPECT_EQ(placement.decimals(), 3);
    const WorldPoint p = placement.at({5500 + 7, 4500, 5});
    EXPECT_EQ(p.x, 6500);
    EXPECT_EQ(p.y, 6507);
    EXPECT_EQ(p.z, 3005);
    EXPECT_EQ(Placement({}, {}, Rotation::byDegrees(1, 0, 0), {}).decimals(), 6);
}

}  // namespace
}  // namespace svt::samples
