// The four validation cases of ISO 10211 as models of blocks, built and simulated.
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/simulate/heat.hpp>
#include <svt/simulate/prism_model_test.hpp>

#include <array>
#include <map>
#include <numbers>

namespace svt::simulate {
namespace {

using test::blocksBetween;
using test::buildPrisms;

HeatResult simulated(const volume::SemanticVolume& volume, HeatOptions options) {
    options.priority = analyze::labelsByPriority(volume.labels);
    Diagnostics findings;
    auto result = simulateHeat(volume, options, findings);
    EXPECT_TRUE(result) << result.error().toString();
    return result ? std::move(*result) : HeatResult();
}

// Figures stand in the report of --gtest_output=xml:F.xml.
void recordCase(const std::string& name, double value) {
    testing::Test::RecordProperty(name, fmt::format("{:.6g}", value));
}

// Sums of the rooms with one name.
struct RoomSum {
    double watts = 0, lowest = 1e9;
};
std::map<std::string, RoomSum> roomSums(const volume::SemanticVolume& volume, const HeatResult& result) {
    std::map<std::string, RoomSum> sums;
    for (const ZoneHeat& room : result.rooms) {
        RoomSum& sum = sums[volume.labels.labels[room.label].name];
        sum.watts += room.watts;
        if (room.lowest) sum.lowest = std::min(sum.lowest, room.lowest->celsius);
    }
    return sums;
}

float valueAt(const volume::SemanticVolume& volume, const HeatResult& result, Vec3d world) {
    const Vec3d index = volume.grid.indexFromWorld(world);
    const Vec3i n = volume.grid.dimension();
    const Vec3i at{int(std::lround(index.x)), int(std::lround(index.y)), int(std::lround(index.z))};
    return result.temperature
        .values[std::size_t(at.x) + std::size_t(n.x) * (std::size_t(at.y) + std::size_t(n.y) * std::size_t(at.z))];
}

// Half of a square column: 20 degrees at the top, 0 at the left and at the bottom, symmetric at the right. The table of the
// standard is the rounded series.
TEST(Iso10211, PassesCase1) {
    const double h = 1.0 / 32;
    const auto prisms = blocksBetween({0, 1, 1 + h}, {0, h, 2 * h, 3 * h}, {0, 2, 2 + 2 * h, 2 + 3 * h}, [&](Vec3d p) {
        const bool isCover = p.x > 1 || p.y < h || p.y > 2 * h || p.z > 2 + 2 * h;
        return std::string(isCover ? "cover" : p.z > 2 ? "room" : "body");
    });
    const volume::SemanticVolume volume = buildPrisms(prisms, {h, h, h});
    HeatOptions options;
    options.outside = 0;
    options.materials = {{"name=cover", 0, 0, 0}, {"name=body", 1, 0, 0}};
    options.resistances = {0, 0, 0, 0};
    options.isLeaky = true;  // the room is open at its left side
    const HeatResult result = simulated(volume, options);
    const std::array<std::array<double, 4>, 7> table{{{9.658, 13.379, 14.729, 15.085},
                                                      {5.252, 8.641, 10.316, 10.811},
                                                      {3.189, 5.609, 7.014, 7.465},
                                                      {2.014, 3.641, 4.658, 5.000},
                                                      {1.262, 2.309, 2.986, 3.219},
                                                      {0.740, 1.359, 1.767, 1.908},
                                                      {0.342, 0.630, 0.820, 0.886}}};
    double worst = 0;
    for (std::size_t row = 0; row < 7; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const double x = 0.25 * double(column + 1), z = 2 - 0.25 * double(row + 1);
            double mean = 0;  // of the four cells around the node; at the axis, of the two inside
            int count = 0;
            for (const double dx : {-h / 2, h / 2})
                for (const double dz : {-h / 2, h / 2}) {
                    if (x + dx > 1) continue;
                    mean += double{valueAt(volume, result, {x + dx, 1.5 * h, z + dz})};
                    ++count;
                }
            worst = std::max(worst, std::abs(mean / count - table[row][column]));
        }
    EXPECT_LT(worst, 0.1);
    recordCase("K", worst);
    EXPECT_LT(result.balance, 1e-5);
}

// A roof with an aluminium profile, in millimetres.
TEST(Iso10211, PassesCase2) {
    constexpr double mm = 1e-3;
    const double depth = 5;  // of a layer
    const auto scaled = [](std::vector<double> values) {
        for (double& v : values) v *= mm;
        return values;
    };
    const auto prisms = blocksBetween(scaled({-1, 0, 1.5, 15, 500, 501}), scaled({0, depth, 2 * depth, 3 * depth}),
                                      scaled({-2, -1, 0, 1.5, 35, 36.5, 41.5, 47.5}), [&](Vec3d p) -> std::string {
                                          const double x = p.x / mm, y = p.z / mm;
                                          if (x < 0 || x > 500 || p.y < depth * mm || p.y > 2 * depth * mm || y < -1)
                                              return "cover";
                                          if (y < 0) return "room";
                                          if (y > 41.5) return "concrete";
                                          if (y > 36.5 && x < 15) return "wood";
                                          if ((y > 35 && y < 36.5 && x < 15) || (x < 1.5 && y < 36.5) || y < 1.5)
                                              return "aluminium";
                                          return "insulation";
                                      });
    const volume::SemanticVolume volume = buildPrisms(prisms, {0.5 * mm, depth * mm, 0.5 * mm});
    HeatOptions options;
    options.outside = 0;
    options.materials = {{"name=cover", 0, 0, 0},
                         {"name=concrete", 1.15, 0, 0},
                         {"name=wood", 0.12, 0, 0},
                         {"name=aluminium", 230, 0, 0},
                         {"name=insulation", 0.029, 0, 0}};
    options.resistances = {0.11, 0.11, 0.11, 0.06};
    const HeatResult result = simulated(volume, options);
    const double watts = result.outside.watts / (depth * mm);
    EXPECT_NEAR(-watts, 9.5, 0.1);
    // Temperatures of the nine points from the cells around: surfaces by their film, inside by lambda / distance.
    struct Point {
        double x, y, celsius;
    };
    const auto lambdaAt = [](double x, double y) {
        if (y > 41.5) return 1.15;
        if (y > 36.5 && x < 15) return 0.12;
        if ((y > 35 && y < 36.5 && x < 15) || (x < 1.5 && y < 36.5) || y < 1.5) return 230.0;
        return 0.029;
    };
    double worst = 0;
    for (const Point& p :
         {Point{0, 47.5, 7.1}, Point{500, 47.5, 0.8}, Point{0, 41.5, 7.9}, Point{15, 41.5, 6.3}, Point{500, 41.5, 0.8},
          Point{0, 36.5, 16.4}, Point{15, 36.5, 16.3}, Point{0, 0, 16.8}, Point{500, 0, 18.3}}) {
        double sum = 0, weights = 0;
        for (const double dx : {-0.25, 0.25})
            for (const double dy : {-0.25, 0.25}) {
                const double x = p.x + dx, y = p.y + dy;
                if (x < 0 || x > 500 || y < 0 || y > 47.5) continue;
                double t = double{valueAt(volume, result, {x * mm, 1.5 * depth * mm, y * mm})};
                const double own = lambdaAt(x, y) / (0.25 * mm);
                if (p.y == 0) t = (t * own + 20 / 0.11) / (own + 1 / 0.11);
                if (p.y == 47.5) t = t * own / (own + 1 / 0.06);
                sum += t * lambdaAt(x, y);
                weights += lambdaAt(x, y);
            }
        EXPECT_NEAR(sum / weights, p.celsius, 0.1) << p.x << " " << p.y;
        worst = std::max(worst, std::abs(sum / weights - p.celsius));
    }
    recordCase("W/m", -watts);
    recordCase("K", worst);
}

// A balcony slab through an insulated corner, between two rooms.
TEST(Iso10211, PassesCase3) {
    const double c = 0.025;  // thickness of the covers
    const auto prisms = blocksBetween({-0.1, 0, 0.05, 0.2, 1.2, 1.2 + c}, {-0.7, -0.1, 0, 0.05, 0.2, 1.2, 1.2 + c},
                                      {-c, 0, 1.0, 1.15, 1.2, 2.15, 2.15 + c}, [](Vec3d p) -> std::string {
                                          if ((p.x > 1.2 || p.y > 1.2 || p.z < 0 || p.z > 2.15))
                                              return p.y > -0.1 || (p.x > 0.05 && p.z > 1 && p.z < 1.15) ? "cover" : "";
                                          if (p.x > 0.05 && p.z > 1 && p.z < 1.15) return "slab";
                                          if (p.y < -0.1) return "";
                                          if (p.x < 0 || p.y < 0) return "outer";
                                          if (p.x < 0.05 || p.y < 0.05) return "insulation";
                                          if (p.x < 0.2 || p.y < 0.2) return "inner";
                                          if (p.z > 1.15 && p.z < 1.2) return "floor";
                                          return p.z < 1 ? "room alpha" : "room beta";
                                      });
    const double h = 0.0125;
    const volume::SemanticVolume volume = buildPrisms(prisms, {h, h, h});
    HeatOptions options;
    options.outside = 0;
    options.inside = {{"name='room beta'", 15}};
    options.materials = {{"name=cover", 0, 0, 0},         {"name=slab", 2.5, 0, 0},  {"name=outer", 1, 0, 0},
                         {"name=insulation", 0.04, 0, 0}, {"name=inner", 0.7, 0, 0}, {"name=floor", 1, 0, 0}};
    options.resistances = {0.2, 0.2, 0.2, 0.05};
    const HeatResult result = simulated(volume, options);
    const auto rooms = roomSums(volume, result);
    const RoomSum alpha = rooms.at("room alpha"), beta = rooms.at("room beta");
    EXPECT_NEAR(alpha.watts, 46.09, 0.4609);
    EXPECT_NEAR(beta.watts, 13.89, 0.1389);
    EXPECT_NEAR(-result.outside.watts, 59.98, 0.5998);
    EXPECT_NEAR(alpha.lowest, 11.32, 0.1);
    EXPECT_NEAR(beta.lowest, 11.11, 0.1);
    EXPECT_LT(result.balance, 1e-5);
    for (const auto& [name, value] : {std::pair("alpha, W", alpha.watts), std::pair("beta, W", beta.watts),
                                      std::pair("gamma, W", -result.outside.watts), std::pair("alpha, C", alpha.lowest),
                                      std::pair("beta, C", beta.lowest)})
        recordCase(name, value);
}

// A quarter of an iron bar through insulation.
TEST(Iso10211, PassesCase4) {
    const double h = 0.00625, c = h;
    const auto prisms = blocksBetween({0.5 - c, 0.5, 0.55, 1, 1 + c}, {-c, 0, 0.2, 0.6, 0.6 + 4 * c, 0.6 + 5 * c},
                                      {0.5 - c, 0.5, 0.525, 1, 1 + c}, [c](Vec3d p) -> std::string {
                                          if (p.y < 0) return "";
                                          if (p.x < 0.5 || p.x > 1 || p.z < 0.5 || p.z > 1 || p.y > 0.6 + 4 * c)
                                              return "cover";
                                          if (p.x < 0.55 && p.z < 0.525 && p.y < 0.6) return "bar";
                                          return p.y < 0.2 ? "insulation" : "room";
                                      });
    const volume::SemanticVolume volume = buildPrisms(prisms, {h, h, h});
    HeatOptions options;
    options.outside = 0;
    options.inside = {{"name=room", 1}};
    options.materials = {{"name=cover", 0, 0, 0}, {"name=bar", 50, 0, 0}, {"name=insulation", 0.1, 0, 0}};
    options.resistances = {0.1, 0.1, 0.1, 0.1};
    const HeatResult result = simulated(volume, options);
    const double watts = -4 * result.outside.watts;
    EXPECT_NEAR(watts, 0.540, 0.0054);
    ASSERT_TRUE(result.outside.highest);
    EXPECT_NEAR(result.outside.highest->celsius, 0.805, 0.005);
    EXPECT_LT(result.balance, 1e-5);
    recordCase("W", watts);
    recordCase("C", result.outside.highest->celsius);
}

}  // namespace
}  // namespace svt::simulate
