// Steady heat conduction against exact answers, and its findings.
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/simulate/heat.hpp>
#include <svt/simulate/materials/thermal_words.hpp>
#include <svt/simulate/prism_model_test.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::simulate {
namespace {

using test::blocksBetween;
using test::buildPrisms;
using test::Prism;

const std::vector<ThermalRule> kLayers{{"name=cover", 0, 0, 0},
                                       {"name=plaster", 0.7, 0, 0},
                                       {"name=brick", 0.8, 0, 0},
                                       {"name=insulation", 0.04, 0, 0},
                                       {"name=render", 0.9, 0, 0}};

HeatResult run(const volume::SemanticVolume& volume, HeatOptions options) {
    options.priority = analyze::labelsByPriority(volume.labels);
    Diagnostics findings;
    auto result = simulateHeat(volume, options, findings);
    EXPECT_TRUE(result) << result.error().toString();
    return result ? std::move(*result) : HeatResult();
}

double lossOf(const HeatResult& result) { return -result.outside.watts; }

// Layers whose faces lie anywhere between voxel centres; at whole 64ths of a metre, so that meshes hold them exactly.
volume::SemanticVolume layeredWall() {
    const double h = 0.0625, q = 1.0 / 64;
    const auto prisms = blocksBetween({0, 5 * q, 16 * q, 25 * q, 30 * q, 48 * q, 52 * q}, {0, h, 1 + h, 1 + 2 * h},
                                      {0, h, 1 + h, 1 + 2 * h}, [h, q](Vec3d p) -> std::string {
                                          if (p.y < h || p.y > 1 + h || p.z < h || p.z > 1 + h || p.x > 48 * q)
                                              return "cover";
                                          if (p.x < 5 * q) return "render";
                                          if (p.x < 16 * q) return "insulation";
                                          if (p.x < 25 * q) return "brick";
                                          return p.x < 30 * q ? "plaster" : "room";
                                      });
    return buildPrisms(prisms, {h, h, h});
}

TEST(Heat, LayersInSeriesAreExact) {
    const double q = 1.0 / 64, resistance = 0.04 + 5 * q / 0.9 + 11 * q / 0.04 + 9 * q / 0.8 + 5 * q / 0.7 + 0.13;
    const double expected = 25 / resistance;
    volume::SemanticVolume volume = layeredWall();
    HeatOptions options;
    options.materials = kLayers;
    for (const bool hasMeshes : {true, false}) {
        if (!hasMeshes) volume.vectors = {};  // then faces are planes
        const HeatResult result = run(volume, options);
        EXPECT_NEAR(lossOf(result) / expected, 1, 1e-6) << hasMeshes;
        EXPECT_EQ(result.planeShare, 1);
        EXPECT_LT(result.balance, 1e-5);
        ASSERT_EQ(result.rooms.size(), 1u);
        ASSERT_TRUE(result.rooms[0].lowest);
        EXPECT_NEAR(result.rooms[0].lowest->celsius, 20 - 0.13 * expected, 1e-4);
        EXPECT_NEAR(result.rooms[0].lowest->at.x, 30 * q, hasMeshes ? 1e-6 : 0.0625 / 500)
            << "planes are whole 512ths of a voxel";
        EXPECT_NEAR(result.rooms[0].area, 1, 1e-6);
    }
}

// A quarter would do; all angles at once.
std::vector<Prism> ringOf(const std::string& name, double from, double to, double low, double high) {
    constexpr int kSides = 64;
    // Circumscribed and inscribed in equal parts, so that lengths are those of the circle.
    const double widen = std::sqrt(1 / std::cos(std::numbers::pi / kSides));
    std::vector<Prism> ring;
    const auto at = [&](double radius, int n) {
        const double angle = 2 * std::numbers::pi * n / kSides;
        return test::PlanPoint{radius * widen * std::cos(angle), radius * widen * std::sin(angle)};
    };
    for (int n = 0; n < kSides; ++n)
        ring.push_back({name, false, {at(from, n), at(to, n), at(to, n + 1), at(from, n + 1)}, low, high});
    return ring;
}

void record(const std::string& name, double value) {
    testing::Test::RecordProperty(name, fmt::format("{:.6g}", value));
}

double curvedWallError(double h) {
    const double height = 4, inner = 2, a = 2.015, b = 2.19, c = 2.33, outer = 2.34;
    std::vector<Prism> prisms;
    for (const auto& [name, from, to] : {std::tuple("plaster", inner, a), std::tuple("brick", a, b),
                                         std::tuple("insulation", b, c), std::tuple("render", c, outer)})
        for (Prism& one : ringOf(name, from, to, 0, height)) prisms.push_back(std::move(one));
    Prism room{"room", true, {}, 0, height};
    for (const Prism& one : ringOf("", inner, outer, 0, height)) room.ring.push_back(one.ring[0]);
    prisms.push_back(std::move(room));
    for (const double z : {-h, height})
        prisms.push_back(test::boxPrism("cover", false, {-2.5, -2.5, z}, {2.5, 2.5, z + h}));
    const volume::SemanticVolume volume = buildPrisms(prisms, {h, h, h});
    HeatOptions options;
    options.outside = 0;
    options.materials = kLayers;
    const HeatResult result = run(volume, options);
    const double error = lossOf(result) / (4 * 17.9438 * height) - 1;
    record(fmt::format("curved wall, error at {} m", h), error);
    return error;
}

TEST(Heat, CurvedWallIsWithinThreePerMille) {
    EXPECT_LT(std::abs(curvedWallError(0.1)), 0.003);
    EXPECT_LT(std::abs(curvedWallError(0.05)), 0.003);
}

double boxHouseLoss(double degrees, pipeline::AxesKind axes = pipeline::AxesKind::World, bool hasMeshes = true) {
    const double d = 0.36;
    auto prisms = blocksBetween({0, d, 8 + d, 8 + 2 * d}, {0, d, 6 + d, 6 + 2 * d}, {0, 0.2, 2.7, 2.92},
                                [](Vec3d p) -> std::string {
                                    const bool isInside = p.x > 0.36 && p.x < 8.36 && p.y > 0.36 && p.y < 6.36;
                                    return isInside && p.z > 0.2 && p.z < 2.7 ? "room" : "wall";
                                });
    volume::SemanticVolume volume = buildPrisms(test::turned(prisms, degrees), {0.05, 0.05, 0.05}, axes);
    if (!hasMeshes) volume.vectors = {};
    HeatOptions options;
    options.materials = {{"name=wall", 0.2, 0, 0}};
    const HeatResult result = run(volume, options);
    record(fmt::format("box house turned by {} degrees, {} axes, W", degrees, nameOf(axes)), lossOf(result));
    EXPECT_LT(result.balance, 1e-5);
    return lossOf(result);
}

TEST(Heat, TurnedHouseLosesTheSame) {
    const double straight = boxHouseLoss(0);
    for (const double degrees : {12.5, 30.0, 45.0}) EXPECT_NEAR(boxHouseLoss(degrees) / straight, 1, 0.003) << degrees;
    EXPECT_NEAR(boxHouseLoss(30, pipeline::AxesKind::Building) / straight, 1, 1e-4) << "the grid is turned as well";
}

// Planes give the area of slanted faces; the stairs of voxels have up to 1.41 times as much.
TEST(Heat, TurnedHouseWithoutMeshesFollowsItsPlanes) {
    const auto world = pipeline::AxesKind::World;
    const double straight = boxHouseLoss(0, world, false);
    for (const double degrees : {12.5, 30.0, 45.0})
        EXPECT_NEAR(boxHouseLoss(degrees, world, false) / straight, 1, 0.003) << degrees;
}

// A room of 1 m3 in walls of 0.1 m, painted.
volume::SemanticVolume paintedRoom(const std::vector<volume::test::PaintedBox>& more = {}) {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 16, 16}, {0.1, 0.1, 0.1});
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement");
    volume::test::addObject(volume, "room", "BuildingRoom");
    volume::test::addObject(volume, "window", "Window");
    volume::test::addObject(volume, "chair", "BuildingFurniture");
    std::vector<volume::test::PaintedBox> boxes{{1, {2, 2, 2}, {14, 14, 14}}, {2, {3, 3, 3}, {13, 13, 13}}};
    boxes.insert(boxes.end(), more.begin(), more.end());
    volume::test::paintBoxes(volume, boxes);
    return volume;
}

TEST(Heat, UnknownMaterialIsReportedWithItsDefault) {
    Diagnostics findings;
    const auto result = simulateHeat(paintedRoom(), {}, findings);
    ASSERT_TRUE(result);
    ASSERT_EQ(findings.count(Code::UnknownMaterial), 1u);
    EXPECT_NE(findings.items()[0].message.find("1 W/(m K) is assumed"), std::string::npos);
    EXPECT_EQ(findings.items()[0].where.id, "wall");
    ASSERT_EQ(result->assumed.size(), 1u);
    EXPECT_EQ(result->assumed[0].source, "default");
    EXPECT_NE(result->temperature.head.parameters.find("\"default\""), std::string::npos);
}

TEST(Heat, RoomThatIsOpenToOutsideAirIsAnErrorWithItsPlace) {
    // A hole of 2 x 1 voxels in the lower wall along x.
    const volume::SemanticVolume volume = paintedRoom({{0, {2, 7, 7}, {3, 9, 8}}});
    Diagnostics findings;
    const auto result = simulateHeat(volume, {}, findings);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code(), Code::AirLeak);
    EXPECT_NE(result.error().message().find("(0.200, 0.700, 0.700)"), std::string::npos) << result.error().message();
    EXPECT_EQ(findings.count(Code::AirLeak), 1u);
    HeatOptions options;
    options.isLeaky = true;
    const auto leaky = simulateHeat(volume, options, findings);
    ASSERT_TRUE(leaky);
    ASSERT_EQ(leaky->leaks.size(), 1u);
    EXPECT_NEAR(leaky->leaks[0].area, 0.02, 1e-12);
}

TEST(Heat, WindowHasItsTransmittance) {
    volume::SemanticVolume volume = paintedRoom({{3, {2, 5, 5}, {3, 9, 10}}});
    volume.labels.labels[2].attributes.push_back({"Pset_WindowCommon.ThermalTransmittance", std::string("1.4")});
    const HeatResult result = run(volume, {});
    ASSERT_EQ(result.openings.size(), 1u);
    EXPECT_NEAR(result.openings[0].area, 0.2, 1e-12);
    EXPECT_NEAR(result.openings[0].watts, 1.4 * 0.2 * 25, 1e-9);
    EXPECT_NEAR(result.rooms[0].openingWatts, 7, 1e-9);
    EXPECT_NEAR(result.outside.openingWatts, -7, 1e-9);
    EXPECT_LT(result.balance, 1e-5);
}

TEST(Heat, FurnitureIsAirAndAloneSolidsHaveNoTemperature) {
    // A chair that stands in the room and a block of wall inside of an adiabatic one.
    volume::SemanticVolume volume = paintedRoom({{4, {5, 5, 3}, {8, 8, 6}}});
    HeatOptions options;
    options.materials = {{"id=wall", 0.5, 0, 0}};
    const HeatResult with = run(volume, options), without = run(paintedRoom(), options);
    EXPECT_NEAR(with.rooms[0].watts, without.rooms[0].watts, 1e-6 * without.rooms[0].watts);
    EXPECT_EQ(with.undetermined, 0u);
    options.materials = {{"id=wall", 0, 0, 0}};
    volume::test::addObject(volume, "core", "BuildingConstructiveElement");
    volume::test::paintBoxes(volume, {{1, {2, 2, 2}, {14, 14, 14}},
                                      {2, {3, 3, 3}, {13, 13, 13}},
                                      {1, {3, 3, 3}, {6, 6, 6}},
                                      {5, {4, 4, 4}, {5, 5, 5}}});
    const HeatResult blocked = run(volume, options);
    EXPECT_EQ(blocked.cells, 1u);
    EXPECT_EQ(blocked.undetermined, 1u);
    EXPECT_TRUE(std::isnan(blocked.temperature.values[4 + 16 * (4 + 16 * 4)]));
    EXPECT_EQ(blocked.outside.watts, 0);
}

TEST(Heat, ResultDoesNotDependOnTheThreads) {
    const volume::SemanticVolume volume = layeredWall();
    HeatOptions options;
    options.materials = kLayers;
    options.threads = 1;
    const HeatResult one = run(volume, options);
    options.threads = 4;
    const HeatResult four = run(volume, options);
    EXPECT_EQ(one.outside.watts, four.outside.watts);
    ASSERT_EQ(one.temperature.values.size(), four.temperature.values.size());
    for (std::size_t n = 0; n < one.temperature.values.size(); ++n) {
        const float a = one.temperature.values[n], b = four.temperature.values[n];
        ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << n;
    }
}

// A wall states a U-value; its layers have the attributes of the wall, but the conductivity of their material.
TEST(Heat, TransmittanceGivesTheConductivityOfAPlateButNotOfALayer) {
    volume::SemanticVolume volume = paintedRoom();
    volume::Label& wall = volume.labels.labels[0];
    wall.attributes = {{"Pset_WallCommon.ThermalTransmittance", 0.5}, {"material", std::string("Stahlbeton")}};
    const HeatResult plate = run(volume, {});
    ASSERT_EQ(plate.assumed.size(), 1u);
    EXPECT_EQ(plate.assumed[0].source, "transmittance");
    wall.attributes.push_back({"layer", std::int64_t{1}});
    const HeatResult layer = run(volume, {});
    ASSERT_EQ(layer.assumed.size(), 1u);
    EXPECT_EQ(layer.assumed[0].source, "word");
    EXPECT_EQ(layer.assumed[0].conductivity, 2.3);
    wall.attributes = {{"materialLayers", std::string("Stahlbeton 0.2 m; EPS 0.1 m")}};
    EXPECT_NEAR(run(volume, {}).assumed[0].conductivity, 0.3 / (0.2 / 2.3 + 0.1 / 0.035), 1e-12);
}

TEST(ThermalWords, MatchBeginningsOfWords) {
    const auto lambdaOf = [](std::string_view name) {
        std::string_view word;
        const ThermalWord* row = findThermalWord(name, word);
        return row != nullptr ? row->conductivity : 0;
    };
    EXPECT_EQ(lambdaOf("Leichtbeton 102890359"), 0.30);
    EXPECT_EQ(lambdaOf("Ortbeton C25/30"), 2.0);
    EXPECT_EQ(lambdaOf("Holzfaserdämmung"), 0.040);
    EXPECT_EQ(lambdaOf("EPS 035"), 0.035);
    EXPECT_EQ(lambdaOf("Brick, common"), 0.80);
    for (const char* name : {"Spine wall", "Steps", "Spiral", "Cloakroom", "Textile", "Valuable", ""})
        EXPECT_EQ(lambdaOf(name), 0) << name;
}

TEST(Heat, TooFewIterationsAreAnError) {
    HeatOptions options;
    options.mostIterations = 1;
    Diagnostics findings;
    const auto result = simulateHeat(paintedRoom(), options, findings);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code(), Code::NotConverged);
}

TEST(Heat, NeedsRoomsAndValidNumbers) {
    Diagnostics findings;
    volume::SemanticVolume volume = volume::test::emptyVolume({4, 4, 4}, {1, 1, 1});
    volume::test::addObject(volume, "wall", "BuildingConstructiveElement");
    volume::test::paintBoxes(volume, {{1, {1, 1, 1}, {3, 3, 3}}});
    const auto none = simulateHeat(volume, {}, findings);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code(), Code::BadArgument);
    HeatOptions options;
    options.outside = -300;
    EXPECT_EQ(simulateHeat(paintedRoom(), options, findings).error().code(), Code::BadArgument);
    options = {};
    options.name = "no name";
    EXPECT_EQ(simulateHeat(paintedRoom(), options, findings).error().code(), Code::BadField);
    options = {};
    options.inside = {{"id=nobody", 20}};
    EXPECT_EQ(simulateHeat(paintedRoom(), options, findings).error().code(), Code::NothingSelected);
}

TEST(ThermalRules, AreReadFromCsv) {
    const auto rules = parseThermalRules(
        "# table\nquery,conductivity,density\n\"material~\"\"a, b\"\"\",0.5,\nclass=Slab,2.3,2400\n", "t.csv");
    ASSERT_TRUE(rules) << rules.error().toString();
    ASSERT_EQ(rules->size(), 2u);
    EXPECT_EQ((*rules)[0], (ThermalRule{"material~\"a, b\"", 0.5, 0, 0}));
    EXPECT_EQ((*rules)[1], (ThermalRule{"class=Slab", 2.3, 2400, 0}));
    const auto german = parseThermalRules("query;conductivity\nclass=Slab;2,3\n", "t.csv");
    ASSERT_TRUE(german) << german.error().toString();
    EXPECT_EQ((*german)[0].conductivity, 2.3);
    for (const char* bad :
         {"", "query\n", "query,lambda\n", "query,conductivity\na=b,-1\n", "query,conductivity\na=b,x\n",
          "query,conductivity\n,1\n", "query,conductivity\n\"a=b,1\n"}) {
        const auto result = parseThermalRules(bad, "t.csv");
        ASSERT_FALSE(result) << bad;
        EXPECT_EQ(result.error().code(), Code::BadValue);
    }
}

}  // namespace
}  // namespace svt::simulate
