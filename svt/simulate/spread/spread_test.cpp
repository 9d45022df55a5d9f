// Values of sensors through the air of rooms, against values that are known by symmetry or by a formula.
#include <svt/fields/field_sampler.hpp>
#include <svt/simulate/prism_model_test.hpp>
#include <svt/simulate/spread.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace svt::simulate {
namespace {

using test::blocksBetween;
using test::boxPrism;
using test::buildPrisms;
using test::Prism;
using volume::SemanticVolume;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr Vec3d kSpacing{0.1, 0.1, 0.1};

fields::Field sensorsAt(const std::vector<Vec3d>& places, std::vector<float> values, std::vector<double> times = {0}) {
    fields::Field field;
    field.head.name = "sensors";
    field.head.kind = fields::FieldKind::Points;
    field.head.quantity = "temperature";
    field.head.unit = "Cel";
    field.head.times = std::move(times);
    for (std::size_t p = 0; p < places.size(); ++p) field.head.points.push_back({fmt::format("s{}", p), places[p]});
    field.values = std::move(values);
    return field;
}

// A spread field, and its values at places in metres.
class Spread {
public:
    Spread(const SemanticVolume& volume, const fields::Field& sensors, const SpreadOptions& options = {})
        : volume_(volume) {
        auto made = spreadSensors(volume, sensors, options);
        EXPECT_TRUE(made) << made.error().toString();
        if (!made) return;
        result = std::move(*made);
        auto sampler = fields::FieldSampler::make(result.field, volume);
        EXPECT_TRUE(sampler) << sampler.error().toString();
        if (sampler) sampler_ = std::move(*sampler);
    }
    [[nodiscard]] float at(Vec3d place, std::size_t time = 0) const {
        return sampler_ ? sampler_->at(volume_.grid.indexFromWorld(place), time) : kMissing;
    }
    SpreadResult result;

private:
    const SemanticVolume& volume_;
    std::optional<fields::FieldSampler> sampler_;
};

void expectError(const SemanticVolume& volume, const fields::Field& sensors, std::string_view text,
                 const SpreadOptions& options = {}) {
    const auto result = spreadSensors(volume, sensors, options);
    ASSERT_FALSE(result) << text;
    EXPECT_NE(result.error().toString().find(text), std::string::npos) << result.error().toString();
}

// Two rooms of 4 x 4 x 3 m between walls of 0.2 m; in the middle of the wall between them a door or a doorway.
SemanticVolume twoRooms(const std::string& between) {
    const double d = 0.2;
    std::vector<Prism> prisms =
        blocksBetween({0, d, 4 + d, 4 + 2 * d, 8 + 2 * d, 8 + 3 * d}, {0, d, 1.6 + d, 2.4 + d, 4 + d, 4 + 2 * d},
                      {0, d, 2 + d, 3 + d, 3 + 2 * d}, [&](Vec3d p) -> std::string {
                          if (p.z < d || p.z > 3 + d || p.y < d || p.y > 4 + d || p.x < d || p.x > 8 + 2 * d)
                              return "wall";
                          if (p.x < 4 + d || p.x > 4 + 2 * d) return "";
                          return p.y > 1.6 + d && p.y < 2.4 + d && p.z < 2 + d ? between : "wall";
                      });
    prisms.push_back(boxPrism("room 1", true, {d, d, d}, {4 + d, 4 + d, 3 + d}));
    prisms.push_back(boxPrism("room 2", true, {4 + 2 * d, d, d}, {8 + 2 * d, 4 + d, 3 + d}));
    return buildPrisms(prisms, kSpacing);
}

TEST(Spread, NoValueCrossesAWall) {
    const SemanticVolume volume = twoRooms("door");
    const Spread field(volume, sensorsAt({{2, 2, 1.5}, {6, 2, 1.5}}, {20, 30}));
    int wrong = 0, count = 0;
    for (double x = 0.22; x < 8.4; x += 0.07)
        for (double y = 0.22; y < 4.2; y += 0.07)
            for (double z = 0.22; z < 3.2; z += 0.07) {
                if (x > 4.19 && x < 4.41) continue;
                ++count;
                if (field.at({x, y, z}) != (x < 4.2 ? 20.0f : 30.0f)) ++wrong;
            }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(count, 200000);
    EXPECT_TRUE(std::isnan(field.at({4.3, 2, 1}))) << "the door has no value";
    EXPECT_TRUE(std::isnan(field.at({-0.1, 2, 1}))) << "outside air has no value";
    EXPECT_TRUE(field.result.dry.empty());
    EXPECT_TRUE(field.result.touching.empty());
    ASSERT_EQ(field.result.sensors.size(), 2u);
    EXPECT_NEAR(field.result.sensors[1].volume, 48, 1e-6);
    EXPECT_EQ(volume.labels.labels[field.result.sensors[1].label].name, "room 2");
}

TEST(Spread, ValuesPassDoorwaysAndOpenDoors) {
    for (const std::string between : {"door", ""}) {
        const SemanticVolume volume = twoRooms(between);
        SpreadOptions options;
        options.step = 0.1;
        if (!between.empty()) options.open = {"name=door"};
        const Spread field(volume, sensorsAt({{2.3, 2.2, 1.1}, {6.3, 2.2, 1.1}}, {20, 30}), options);
        EXPECT_NEAR(field.at({2.3, 2.2, 1.1}), 20, 0.02);
        EXPECT_NEAR(field.at({6.3, 2.2, 1.1}), 30, 0.02);
        EXPECT_NEAR(field.at({4.15, 2.2, 1.1}) + field.at({4.45, 2.2, 1.1}), 50, 0.02) << "by symmetry";
        // Weights by the squares of 3 m and 1 m, in sight of both.
        EXPECT_NEAR(field.at({3.3, 2.2, 1.1}), (20.0 + 30.0 / 9) / (1 + 1.0 / 9), 0.05);
        // Behind the wall, the way to the far sensor leads through the doorway.
        const double straight = std::hypot(6.3 - 4.1, 2.2 - 0.3), own = std::hypot(4.1 - 2.3, 2.2 - 0.3);
        const float corner = field.at({4.1, 0.3, 1.1});
        EXPECT_LT(corner,
                  (20 / own / own + 30 / straight / straight) / (1 / own / own + 1 / straight / straight) - 0.3);
        EXPECT_NEAR(field.result.sensors[0].volume, 96 + 0.8 * 2 * 0.2, 1e-6);
    }
}

TEST(Spread, ASensorWithoutAValueDoesNotCountAtThatTime) {
    const SemanticVolume volume = twoRooms("door");
    const Spread field(volume, sensorsAt({{2, 2, 1.5}, {3, 3, 1.5}, {6, 2, 1.5}},
                                         {20, 22, 30, kMissing, 24, kMissing, kMissing, kMissing, 31}, {0, 60, 120}));
    EXPECT_EQ(field.result.field.head.times, (std::vector<double>{0, 60, 120}));
    EXPECT_GT(field.at({1, 1, 1}, 0), 20);
    EXPECT_LT(field.at({1, 1, 1}, 0), 21);
    EXPECT_EQ(field.at({1, 1, 1}, 1), 24);
    EXPECT_TRUE(std::isnan(field.at({1, 1, 1}, 2)));
    EXPECT_TRUE(std::isnan(field.at({7, 1, 1}, 1)));
    EXPECT_EQ(field.at({7, 1, 1}, 2), 31);
}

TEST(Spread, NamesSensorsWithoutARoomAndRoomsWithoutASensor) {
    const SemanticVolume volume = twoRooms("door");
    // On the inner face of a wall, 0.05 m inside of it; and outside.
    const Spread field(volume, sensorsAt({{2, 0.15, 1.5}, {-3, 2, 1}, {2, -0.2, 1.5}}, {21, 5, 6}));
    ASSERT_EQ(field.result.sensors.size(), 3u);
    EXPECT_EQ(volume.labels.labels[field.result.sensors[0].label].name, "room 1");
    EXPECT_EQ(field.result.sensors[1].label, volume::kNoLabel);
    EXPECT_EQ(field.result.sensors[2].label, volume::kNoLabel);
    ASSERT_EQ(field.result.dry.size(), 1u);
    EXPECT_EQ(volume.labels.labels[field.result.dry[0]].name, "room 2");
    EXPECT_EQ(field.at({1, 1, 1}), 21);
    EXPECT_TRUE(std::isnan(field.at({7, 1, 1})));
    EXPECT_NE(field.result.field.head.parameters.find(R"("sensorsWithoutRoom":["s1","s2"])"), std::string::npos)
        << field.result.field.head.parameters;
}

TEST(Spread, RoomsThatTouchStayApartUnlessOneIsOpen) {
    const SemanticVolume volume = buildPrisms(
        {boxPrism("room a", true, {0, 0, 0}, {2, 2, 2}), boxPrism("room b", true, {2, 0, 0}, {4, 2, 2})}, kSpacing);
    const fields::Field sensors = sensorsAt({{1, 1, 1}, {3, 1, 1}}, {10, 20});
    const Spread apart(volume, sensors);
    EXPECT_EQ(apart.at({1.7, 1, 1}), 10);  // nearer than a step, the sampler mixes the nodes of both rooms
    EXPECT_EQ(apart.at({2.3, 1, 1}), 20);
    ASSERT_EQ(apart.result.touching.size(), 1u);
    SpreadOptions options;
    options.open = {"name=\"room b\""};
    const Spread joined(volume, sensors, options);
    EXPECT_NEAR(joined.at({1.95, 1, 1}) + joined.at({2.05, 1, 1}), 30, 0.05);
    EXPECT_GT(joined.at({1.95, 1, 1}), 14);
    EXPECT_TRUE(joined.result.touching.empty());
    EXPECT_TRUE(joined.result.dry.empty());
}

TEST(Spread, TheStepChoosesTheNodesAndCoversTheGrid) {
    const SemanticVolume volume = twoRooms("door");
    const fields::Field sensors = sensorsAt({{2, 2, 1.5}, {1, 1, 0.5}}, {20, 30});
    SpreadOptions options;
    options.step = 0.1;
    const Spread fine(volume, sensors, options);
    EXPECT_EQ(fine.result.field.head.lattice.size, volume.grid.dimension());
    EXPECT_EQ(fine.result.nodes, 48000u);
    options.step = 0.5;
    const Spread coarse(volume, sensors, options);
    const fields::Lattice& lattice = coarse.result.field.head.lattice;
    EXPECT_EQ(lattice.step, (Vec3d{5, 5, 5}));
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_GE(lattice.first[axis] + lattice.step[axis] * (lattice.size[axis] - 0.5),
                  volume.grid.dimension()[axis] - 0.5);
    EXPECT_NEAR(coarse.at({3, 3, 2.5}), fine.at({3, 3, 2.5}), 0.1);
    options.step = 100;  // one node, in a wall or not
    expectError(volume, sensorsAt({{-5, 2, 1.5}}, {20}), "no point of the field 'sensors' lies in a room", options);
}

TEST(Spread, RefusesOtherFieldsAndBadOptions) {
    const SemanticVolume volume = twoRooms("door");
    fields::Field sensors = sensorsAt({{2, 2, 1.5}}, {20});
    SpreadOptions options;
    for (const double step : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        options.step = step;
        expectError(volume, sensors, "step", options);
    }
    options = {};
    options.open = {"name=gate"};
    expectError(volume, sensors, "name=gate", options);
    options.open = {"name="};
    expectError(volume, sensors, "E901", options);
    options = {};
    options.name = "1 2";
    expectError(volume, sensors, "1 2", options);
    options = {};
    const SemanticVolume walls = buildPrisms({boxPrism("wall", false, {0, 0, 0}, {1, 1, 1})}, kSpacing);
    expectError(walls, sensors, "no rooms");
    sensors.head.kind = fields::FieldKind::Label;
    expectError(volume, sensors, "kind label");
}

}  // namespace
}  // namespace svt::simulate
