// Temperatures over time against exact series, steady states and sums of heat.
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/simulate/heat_over_time.hpp>
#include <svt/simulate/prism_model_test.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace svt::simulate {
namespace {

using test::blocksBetween;
using test::buildPrisms;
using volume::SemanticVolume;

constexpr double kThickness = 0.2, kConductivity = 0.8, kCapacity = 1.6e6,
                 kFilm = 0.125;  // m, W/(m K), J/(m3 K), m2 K/W

// A wall of 20 cm between a room and outside air, in an adiabatic frame; voxels of 1 cm.
SemanticVolume wall() {
    const double h = 0.01;
    return buildPrisms(blocksBetween({0, kThickness, kThickness + 0.1}, {0, 0.04, 0.08, 0.12}, {0, 0.04, 0.08, 0.12},
                                     [](Vec3d p) -> std::string {
                                         if (p.y < 0.04 || p.y > 0.08 || p.z < 0.04 || p.z > 0.08) return "cover";
                                         return p.x < kThickness ? "wall" : "room";
                                     }),
                       {h, h, h});
}

HeatOptions optionsOf(const SemanticVolume& volume, double room) {
    HeatOptions options;
    options.outside = 20;
    options.inside = {{"all", room}};
    options.materials = {{"name=cover", 0, 0, 0}, {"name=wall", kConductivity, 1600, 1000}};
    options.resistances = {kFilm, kFilm, kFilm, kFilm};
    options.isLeaky = true;
    options.priority = analyze::labelsByPriority(volume.labels);
    return options;
}

HeatOverTime run(const SemanticVolume& volume, const HeatOptions& options, const TimeOptions& time) {
    Diagnostics findings;
    auto result = simulateHeatOverTime(volume, options, time, findings);
    EXPECT_TRUE(result) << result.error().toString();
    return result ? std::move(*result) : HeatOverTime();
}

// The temperature of a plate, first at 0, between air of 20 degrees on both sides (Carslaw and Jaeger, section 3.11).
double plateAt(double x, double seconds) {
    const double half = kThickness / 2, biot = half / (kFilm * kConductivity);
    double sum = 0;
    for (int n = 0; n < 60; ++n) {
        double low = n * std::numbers::pi, high = low + std::numbers::pi / 2;
        for (int i = 0; i < 100; ++i) {
            const double middle = (low + high) / 2;
            (middle * std::tan(middle) < biot ? low : high) = middle;
        }
        const double mu = low, weight = 4 * std::sin(mu) / (2 * mu + std::sin(2 * mu));
        sum += weight * std::cos(mu * (x - half) / half) *
               std::exp(-mu * mu * kConductivity / kCapacity * seconds / (half * half));
    }
    return 20 * (1 - sum);
}

// The temperature of the field in the middle of the wall's height and width.
float fieldAt(const SemanticVolume& volume, const fields::Field& field, double x, std::size_t time) {
    const Vec3d index = volume.grid.indexFromWorld({x, 0.06, 0.06});
    const Vec3i n = volume.grid.dimension();
    const auto at = [](double v) { return static_cast<std::size_t>(std::lround(v)); };
    const auto nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y),
               nz = static_cast<std::size_t>(n.z);
    return field.values[at(index.x) + nx * (at(index.y) + ny * (at(index.z) + nz * time))];
}

TEST(HeatOverTime, AStepOfTheAirFollowsTheExactSeries) {
    const SemanticVolume volume = wall();
    const HeatOptions options = optionsOf(volume, 20);
    for (const auto& [step, limit] : {std::pair(60.0, 0.03), std::pair(300.0, 0.05), std::pair(900.0, 0.2)}) {
        TimeOptions time;
        time.hours = 6;
        time.step = step;
        time.every = 900;
        time.start = 0;
        const HeatOverTime result = run(volume, options, time);
        ASSERT_EQ(result.times.size(), 25u);
        double worst = 0;
        for (std::size_t t = 1; t < result.times.size(); ++t)
            for (int cell = 0; cell < 20; ++cell) {
                const double x = 0.005 + 0.01 * cell;
                const double found = double{fieldAt(volume, result.temperature, x, t)};
                worst = std::max(worst, std::abs(found - plateAt(x, result.times[t].seconds)));
            }
        EXPECT_LT(worst, limit) << step;
        RecordProperty("worst_" + std::to_string(int(step)), std::to_string(worst));
        EXPECT_NEAR(result.stored / result.received, 1, 1e-6);
        EXPECT_NEAR(result.capacity, kCapacity * kThickness * 0.04 * 0.04, 1e-3);
    }
}

TEST(HeatOverTime, StaysSteadyAndReachesTheSteadyState) {
    const SemanticVolume volume = wall();
    HeatOptions options = optionsOf(volume, 20);
    options.outside = -5;
    Diagnostics findings;
    const auto steady = simulateHeat(volume, options, findings);
    ASSERT_TRUE(steady);
    TimeOptions time;
    time.hours = 120;
    time.step = 3600;
    time.every = 3600 * 24;
    const HeatOverTime stays = run(volume, options, time);
    time.start = 15;
    const HeatOverTime reaches = run(volume, options, time);
    for (const HeatOverTime* result : {&stays, &reaches}) {
        EXPECT_NEAR(result->times.back().outside.watts, steady->outside.watts, 1e-4 * -steady->outside.watts);
        ASSERT_EQ(result->times.back().rooms.size(), 1u);
        EXPECT_NEAR(result->times.back().rooms[0].lowest->celsius, steady->rooms[0].lowest->celsius, 1e-3);
    }
    EXPECT_NEAR(stays.stored, 0, 1e-3);
    EXPECT_NEAR(reaches.stored / reaches.received, 1, 1e-6);
}

// Outside air that goes up and down within a day: the damping and the delay of the heat into the room are those of EN
// ISO 13786.
TEST(HeatOverTime, ADayOfWavesHasThePeriodicTransmittanceOfIso13786) {
    const SemanticVolume volume = wall();
    const HeatOptions options = optionsOf(volume, 20);
    TimeOptions time;
    time.hours = 96;
    time.step = 600;
    time.every = 600;
    constexpr double kDay = 86400;
    for (double t = 0; t <= time.hours * 3600 + 1; t += 600)
        time.weather.rows.push_back({t, 20 + 10 * std::sin(2 * std::numbers::pi * t / kDay)});
    const HeatOverTime result = run(volume, options, time);
    // The transfer matrix of film, layer and film: the periodic transmittance is -1 / Z12.
    using Complex = std::complex<double>;
    const double depth = std::sqrt(kConductivity / kCapacity * kDay / std::numbers::pi);
    const Complex xi = Complex(1, 1) * (kThickness / depth);
    const Complex z11 = std::cosh(xi), z12 = -std::sinh(xi) / (kConductivity * xi / kThickness);
    const Complex z21 = -kConductivity * xi / kThickness * std::sinh(xi);
    const Complex full = (z11 * -kFilm + z12) + -kFilm * (z21 * -kFilm + z11);
    const double wanted = std::abs(-1.0 / full);
    double least = 1e9, most = -1e9;
    for (const HeatAtTime& at : result.times) {
        if (at.seconds < 72 * 3600) continue;
        least = std::min(least, at.rooms[0].watts);
        most = std::max(most, at.rooms[0].watts);
    }
    EXPECT_NEAR((most - least) / 2 / (10 * 0.04 * 0.04) / wanted, 1, 0.005);
}

TEST(HeatOverTime, TheFieldStatesItsTimesAndAssumptions) {
    const SemanticVolume volume = wall();
    HeatOptions options = optionsOf(volume, 20);
    options.materials[1].density = 0;  // then a word or the default counts
    TimeOptions time;
    time.hours = 2;
    time.weather.rows = {{0, 0}, {7200, 10}};
    time.weather.epoch = "2026-01-05T00:00:00Z";
    const HeatOverTime result = run(volume, options, time);
    const fields::FieldHead& head = result.temperature.head;
    EXPECT_EQ(head.times, (std::vector<double>{0, 3600, 7200}));
    EXPECT_EQ(head.epoch, "2026-01-05T00:00:00Z");
    EXPECT_EQ(result.temperature.values.size(), 3 * volume.grid.sampleCount());
    EXPECT_EQ(result.times[1].outside.celsius, 5);
    EXPECT_EQ(result.times[1].outside.source, "--weather");
    EXPECT_EQ(result.steps, 8);
    const auto parameters = nlohmann::json::parse(head.parameters);
    EXPECT_EQ(parameters["weather"], nlohmann::json({{0.0, 0.0}, {7200.0, 10.0}}));
    EXPECT_EQ(parameters["start"], "steady");
    ASSERT_EQ(parameters["heatCapacities"].size(), 1u);
    EXPECT_EQ(parameters["heatCapacities"][0]["ids"].size(), 17u) << "17 prisms";
    EXPECT_EQ(parameters["heatCapacities"][0]["source"], "default");
    EXPECT_EQ(parameters["heatCapacities"][0]["heatCapacity"], 1.5e6);
}

TEST(HeatOverTime, RefusesTimesThatDoNotFit) {
    const SemanticVolume volume = wall();
    const HeatOptions options = optionsOf(volume, 20);
    const auto expectError = [&](const TimeOptions& time, std::string_view text) {
        Diagnostics findings;
        const auto result = simulateHeatOverTime(volume, options, time, findings);
        ASSERT_FALSE(result) << text;
        EXPECT_NE(result.error().toString().find(text), std::string::npos) << result.error().toString();
    };
    TimeOptions time;
    time.hours = 0;
    expectError(time, "hours");
    time = {};
    time.step = 7;
    expectError(time, "whole number of steps");
    time = {};
    time.hours = 1.5;
    expectError(time, "whole number");
    time = {};
    time.weather.rows = {{0, 0}, {3600, 1}};
    expectError(time, "the weather ends after 1 h");
    time = {};
    time.start = -300;
    expectError(time, "start");
    time = {};
    time.hours = 1e6;
    expectError(time, "values");
}

TEST(Weather, IsReadFromCsv) {
    const auto plain = parseWeather("time,temperature\n0,-5\n3600,1.5\n", "w.csv");
    ASSERT_TRUE(plain) << plain.error().toString();
    EXPECT_EQ(plain->rows, (std::vector<Weather::Row>{{0, -5}, {3600, 1.5}}));
    EXPECT_FALSE(plain->epoch);
    const auto dated = parseWeather("sun;Temperature;Time\n1;-0,5;2026-01-05T00:00Z\n2;2;2026-01-05T01:30Z\n", "w.csv");
    ASSERT_TRUE(dated) << dated.error().toString();
    EXPECT_EQ(dated->rows, (std::vector<Weather::Row>{{0, -0.5}, {5400, 2}}));
    EXPECT_EQ(dated->epoch, "2026-01-05T00:00:00Z");
    for (const char* bad : {"", "time,temperature\n", "time\n0\n", "time,temperature\n0\n", "time,temperature\n0,x\n",
                            "time,temperature\n0,-300\n", "time,temperature\n0,1\n0,2\n", "time,temperature\nnow,1\n",
                            "time,temperature\n0,1\n2026-01-05,2\n", "time,temperature\n0,\"1\n"}) {
        const auto result = parseWeather(bad, "w.csv");
        ASSERT_FALSE(result) << bad;
        EXPECT_EQ(result.error().code(), Code::BadValue);
    }
}

}  // namespace
}  // namespace svt::simulate
