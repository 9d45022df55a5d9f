#include <svt/crs/crs_facts.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/globe.hpp>
#include <svt/crs/project/elementary.hpp>
#include <svt/crs/project/proj_library.hpp>
#include <svt/crs/project/transverse_mercator.hpp>
#include <svt/crs/project/zones.hpp>
#include <svt/crs/projection.hpp>

#include <svt/core/temporary_folder_test.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace svt::crs {
namespace {

using project::TransverseMercator;

struct Place {
    const char* name;
    double latitude, longitude;
};
constexpr Place kTokyo{"Tokyo", 35.6812, 139.7671}, kMunich{"Munich", 48.1374, 11.5755},
    kNewYork{"New York", 40.7128, -74.0060}, kSydney{"Sydney", -33.8568, 151.2153};

Vec3d pointOf(const Place& place) { return {place.longitude, place.latitude, 12.5}; }

// What cs2cs makes of points (x: east or longitude); empty where the program is missing.
std::vector<Vec3d> cs2cs(int source, int target, const std::vector<Vec3d>& points, bool isNorthFirst) {
    if (std::system("command -v cs2cs > /dev/null 2>&1") != 0) return {};
    const test::TemporaryFolder folder;
    const auto in = folder.path() / "in", out = folder.path() / "out";
    std::ofstream file(in);
    for (const Vec3d p : points)
        file << (isNorthFirst ? fmt::format("{:.12f} {:.12f}\n", p.y, p.x) : fmt::format("{:.9f} {:.9f}\n", p.x, p.y));
    file.close();
    const std::string command = fmt::format("PROJ_NETWORK=OFF cs2cs -f %.6f EPSG:{} EPSG:{} < {} > {}", source, target,
                                            in.string(), out.string());
    if (std::system(command.c_str()) != 0) return {};
    std::ifstream answers(out);
    std::vector<Vec3d> results;
    for (Vec3d p; answers >> p.x >> p.y >> p.z;) results.push_back(p);
    return results;
}

TEST(Elementary, FunctionsAgreeWithTheLibraryToTheLastPlaces) {
    for (int i = -2000; i <= 2000; ++i) {
        const double x = i * 0.0031;
        EXPECT_NEAR(project::sineCosine(x).sine, std::sin(x), 1e-15) << x;
        EXPECT_NEAR(project::sineCosine(x).cosine, std::cos(x), 1e-15) << x;
        EXPECT_NEAR(project::arcTangent(x * 9), std::atan(x * 9), 1e-15) << x;
        EXPECT_NEAR(project::inverseHyperbolicSine(x), std::asinh(x), 2e-15) << x;
        EXPECT_NEAR(project::hyperbolic(x / 4).sine, std::sinh(x / 4), 2e-15) << x;
        EXPECT_NEAR(project::hyperbolic(x / 4).cosine, std::cosh(x / 4), 2e-15) << x;
        EXPECT_NEAR(project::inverseHyperbolicTangent(x / 13), std::atanh(x / 13), 1e-15) << x;
    }
}

TEST(TransverseMercator, AnswersThePublishedExample) {
    // Karney's Transverse Mercator test set begins with the poles and the equator; these follow from the definition:
    // a quarter of the meridian of WGS 84 is 10,001,965.7293 m.
    const TransverseMercator mercator(project::kWgs84, {0, 9, 1, 0, 0});
    EXPECT_NEAR(mercator.forward({9, 89.9999999999, 0}).y, 10001965.7293, 1e-3);
    EXPECT_EQ(mercator.forward({9, 0, 7}), (Vec3d{0, 0, 7}));
    EXPECT_TRUE(std::isnan(mercator.forward({60, 0, 0}).x));
    EXPECT_TRUE(std::isnan(mercator.forward({9, 91, 0}).y));
}

TEST(TransverseMercator, TheWayBackLeadsWhereItBegan) {
    const TransverseMercator mercator(project::kGrs80, {36, 139 + 5.0 / 6, 0.9999, 0, 0});
    for (double latitude = -80; latitude <= 80; latitude += 7.3)
        for (double longitude = 135; longitude <= 145; longitude += 1.1) {
            const Vec3d back = mercator.inverse(mercator.forward({longitude, latitude, 3}));
            EXPECT_NEAR(back.x, longitude, 1e-12);
            EXPECT_NEAR(back.y, latitude, 1e-12);
        }
}

TEST(TransverseMercator, CrossesThe180thMeridian) {
    const TransverseMercator zone60(project::kWgs84, {0, 177, 0.9996, 500000, 0});
    EXPECT_NEAR(zone60.forward({-179, -17, 0}).x, zone60.forward({181, -17, 0}).x, 1e-6);
}

TEST(Projection, DegreesGoToTheUsualZone) {
    const struct {
        int source;
        Place place;
        int target;
        const char* name;
    } cases[] = {
        {6697, kTokyo, 6677, "JGD2011 / Japan Plane Rectangular CS IX"},
        {6668, kTokyo, 6677, "JGD2011 / Japan Plane Rectangular CS IX"},
        {4612, kTokyo, 2451, "JGD2000 / Japan Plane Rectangular CS IX"},
        {4326, kTokyo, 32654, "WGS 84 / UTM zone 54N"},
        {4326, kMunich, 32632, "WGS 84 / UTM zone 32N"},
        {4979, kMunich, 32632, "WGS 84 / UTM zone 32N"},
        {4258, kMunich, 25832, "ETRS89 / UTM zone 32N"},
        {4937, kMunich, 25832, "ETRS89 / UTM zone 32N"},
        {4269, kNewYork, 26918, "NAD83 / UTM zone 18N"},
        {6318, kNewYork, 6347, "NAD83(2011) / UTM zone 18N"},
        {4326, kSydney, 32756, "WGS 84 / UTM zone 56S"},
        {7844, kSydney, 7856, "GDA2020 / MGA zone 56"},
        {4283, kSydney, 28356, "GDA94 / MGA zone 56"},
    };
    for (const auto& each : cases) {
        const auto projection = Projection::toUsualMetres(each.source, pointOf(each.place));
        ASSERT_TRUE(projection) << each.source << projection.error().toString();
        EXPECT_EQ(projection->epsg(), each.target) << each.source << each.place.name;
        EXPECT_EQ(projection->name(), each.name);
    }
    EXPECT_EQ(Projection::toUsualMetres(4326, {500, 95, 0}).error().code(), Code::CannotProject);
}

TEST(Projection, ZonesOfJapanAreThoseOfThePrefectures) {
    const std::pair<Place, int> cities[] = {
        {{"Nagasaki", 32.75, 129.88}, 1},  {{"Fukuoka", 33.59, 130.40}, 2},    {{"Kagoshima", 31.60, 130.56}, 2},
        {{"Hiroshima", 34.39, 132.46}, 3}, {{"Matsue", 35.47, 133.05}, 3},     {{"Matsuyama", 33.84, 132.77}, 4},
        {{"Takamatsu", 34.34, 134.05}, 4}, {{"Kochi", 33.56, 133.53}, 4},      {{"Okayama", 34.66, 133.93}, 5},
        {{"Kobe", 34.69, 135.00}, 5},      {{"Osaka", 34.69, 135.50}, 6},      {{"Kyoto", 35.02, 135.76}, 6},
        {{"Tsu", 34.72, 136.51}, 6},       {{"Nagoya", 35.18, 136.91}, 7},     {{"Kanazawa", 36.59, 136.63}, 7},
        {{"Toyama", 36.70, 137.21}, 7},    {{"Shizuoka", 34.98, 138.38}, 8},   {{"Nagano", 36.65, 138.18}, 8},
        {{"Niigata", 37.92, 139.04}, 8},   {{"Numazu", 35.10, 138.86}, 8},     {{"Maebashi", 36.39, 139.06}, 9},
        {{"Yokohama", 35.45, 139.64}, 9},  {{"Fukushima", 37.75, 140.47}, 9},  {{"Sendai", 38.27, 140.87}, 10},
        {{"Yamagata", 38.25, 140.34}, 10}, {{"Aomori", 40.82, 140.75}, 10},    {{"Hakodate", 41.77, 140.73}, 11},
        {{"Sapporo", 43.06, 141.35}, 12},  {{"Asahikawa", 43.77, 142.36}, 12}, {{"Kushiro", 42.98, 144.38}, 13},
        {{"Naha", 26.21, 127.68}, 15},     {{"Ishigaki", 24.34, 124.16}, 16},  {{"Chichijima", 27.09, 142.19}, 14},
    };
    for (const auto& [city, zone] : cities) EXPECT_EQ(project::japaneseZone(pointOf(city)), zone) << city.name;
}

TEST(Projection, UtmZonesHaveTheExceptionsOfTheNorth) {
    EXPECT_EQ(project::utmZone({5.32, 60.39, 0}), 32) << "Bergen";
    EXPECT_EQ(project::utmZone({15.6, 78.2, 0}), 33) << "Longyearbyen";
    EXPECT_EQ(project::utmZone({-180, 10, 0}), 1);
    EXPECT_EQ(project::utmZone({180, 10, 0}), 1);
    EXPECT_EQ(project::utmZone({179.9, 10, 0}), 60);
}

TEST(Projection, OwnZonesAgreeWithCs2csToATenthOfAMillimetre) {
    const struct {
        int source, target;
        Place place;
    } cases[] = {{6668, 6677, kTokyo},    {6668, 6669, {"Nagasaki", 32.75, 129.88}},
                 {4612, 2451, kTokyo},    {4326, 32632, kMunich},
                 {4258, 25832, kMunich},  {4258, 25833, kMunich},
                 {4269, 26918, kNewYork}, {6318, 6347, kNewYork},
                 {7844, 7856, kSydney},   {4326, 32756, kSydney}};
    for (const auto& each : cases) {
        std::vector<Vec3d> points;
        for (int i = 0; i < 100; ++i)
            points.push_back(pointOf(each.place) + Vec3d{0.03 * (i % 10), 0.03 * (i / 10), 0});
        const std::vector<Vec3d> expected = cs2cs(each.source, each.target, points, true);
        if (expected.size() != points.size()) GTEST_SKIP() << "cs2cs is not there";
        const auto projection = Projection::between(each.source, each.target, points[0]);
        ASSERT_TRUE(projection);
        projection->apply(points);
        // The authority of the Japanese planes gives north first.
        const bool isNorthFirst = factsOf(each.target).order == AxisOrder::NorthEast;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_NEAR(points[i].x, isNorthFirst ? expected[i].y : expected[i].x, 1e-4) << each.target;
            EXPECT_NEAR(points[i].y, isNorthFirst ? expected[i].x : expected[i].y, 1e-4) << each.target;
            EXPECT_EQ(points[i].z, 12.5);
        }
    }
}

TEST(Projection, FeetBecomeMetresOfTheSameProjection) {
    const struct {
        int feet, metres;
        Vec3d point;
    } cases[] = {{2263, 32118, {981106, 195544, 0}},   {6539, 6538, {981106, 195544, 0}},
                 {2244, 26973, {300000, 900000, 0}},   {2225, 26941, {6000000, 2000000, 0}},
                 {3435, 26971, {1176000, 1900000, 0}}, {2222, 26948, {650000, 800000, 0}}};
    for (const auto& each : cases) {
        const auto projection = Projection::toUsualMetres(each.feet, each.point);
        ASSERT_TRUE(projection) << each.feet;
        EXPECT_EQ(projection->epsg(), each.metres);
        const std::vector<Vec3d> expected = cs2cs(each.feet, each.metres, {each.point}, false);
        if (expected.empty()) GTEST_SKIP() << "cs2cs is not there";
        Vec3d point = each.point;
        projection->apply({&point, 1});
        EXPECT_NEAR(point.x, expected[0].x, 5e-4) << each.feet;
        EXPECT_NEAR(point.y, expected[0].y, 5e-4) << each.feet;
    }
}

TEST(Projection, OthersGoByProj) {
    if (projVersion().empty()) GTEST_SKIP() << "a build without PROJ";
    const struct {
        int source, target;
        Vec3d point;
        bool isSourceNorthFirst;
    } cases[] = {{25832, 25833, {691000, 5335000, 0}, false},
                 {31468, 25832, {4468000, 5333000, 0}, true},
                 {28992, 25831, {121000, 487000, 0}, false},
                 {4326, 3035, {11.57, 48.13, 0}, true}};
    for (const auto& each : cases) {
        const auto projection = Projection::between(each.source, each.target, each.point);
        ASSERT_TRUE(projection) << projection.error().toString();
        EXPECT_FALSE(projection->name().empty());
        const Vec3d asked = each.point;
        const std::vector<Vec3d> expected = cs2cs(each.source, each.target, {asked}, each.isSourceNorthFirst);
        if (expected.empty()) GTEST_SKIP() << "cs2cs is not there";
        Vec3d point = each.point;
        projection->apply({&point, 1});
        const bool isNorthFirst = factsOf(each.target).order == AxisOrder::NorthEast;
        EXPECT_NEAR(point.x, isNorthFirst ? expected[0].y : expected[0].x, 1e-3) << each.target;
        EXPECT_NEAR(point.y, isNorthFirst ? expected[0].x : expected[0].y, 1e-3) << each.target;
    }
    // Degrees of an old datum, and feet without a twin in metres.
    EXPECT_EQ(Projection::toUsualMetres(4301, pointOf(kTokyo))->epsg(), 32654);
    EXPECT_EQ(Projection::toUsualMetres(7057, {11900000, 9900000, 0})->epsg(), 6344);
}

TEST(Projection, DefinitionsOfCodesAreThoseOfProj) {
    if (projVersion().empty()) GTEST_SKIP() << "a build without PROJ";
    const std::string plan = wktOf(25832), compound = wktOf(25832, 7837);
    EXPECT_EQ(plan.find("PROJCRS[\"ETRS89 / UTM zone 32N\""), 0U) << plan;
    EXPECT_EQ(compound.find("COMPOUNDCRS["), 0U) << compound;
    EXPECT_NE(compound.find("DHHN2016"), std::string::npos);
    EXPECT_EQ(compound.find('\n'), std::string::npos);
    EXPECT_NE(projJsonOf(25832, 7837).find("\"CompoundCRS\""), std::string::npos);
    EXPECT_EQ(wktOf(999999), "");
    EXPECT_EQ(wktOf(25832, 999999), "");
    EXPECT_EQ(projJsonOf(999999), "");
}

TEST(Projection, TargetsThatAreNoMetresAreRefused) {
    if (projVersion().empty()) GTEST_SKIP() << "a build without PROJ";
    for (const int target : {4326, 2263, 999999, 5703, 4978})
        EXPECT_EQ(Projection::between(25832, target, {}).error().code(), Code::BadArgument) << target;
    EXPECT_EQ(Projection::between(999999, 25832, {}).error().code(), Code::CannotProject);
}

TEST(CrsName, AllFormsHaveTheirCodes) {
    const struct {
        std::string_view name;
        int horizontal, vertical;
    } cases[] = {
        {"EPSG:25832", 25832, 0},
        {"epsg:25832+5783", 25832, 5783},
        {"25832", 25832, 0},
        {"urn:ogc:def:crs:EPSG::25832", 25832, 0},
        {"urn:ogc:def:crs:EPSG:6.9:31467", 31467, 0},
        {"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", 25832, 5783},
        {"http://www.opengis.net/gml/srs/epsg.xml#25832", 25832, 0},
        {"https://www.opengis.net/def/crs/EPSG/0/7415", 28992, 5709},
        {"EPSG:7415", 28992, 5709},
        {"EPSG:5555", 25832, 5783},
        {"EPSG:6697", 6668, 6695},
        {"EPSG:10170", 6677, 6695},
        {"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", 25832, 7837},
        {"urn:adv:crs:DE_DHDN_3GK4*DE_DHHN92_NH", 31468, 5783},
        {"CH1903", 21781, 0},
        {"CH1903+", 2056, 0},
        {"CH1903+ / LV95 + LN02 height", 2056, 5728},
        {"Amersfoort / RD New + NAP height", 28992, 5709},
        {"ETRS89 / UTM zone 33N", 25833, 0},
        {"WGS 84 / UTM zone 23S", 32723, 0},
        {"EPSG:6677 (from EPSG:6668+6695)", 6677, 6695},
        {"EPSG:25833 (from EPSG:25832)", 25833, 0},
        {"ETRS89 / UTM zone 3N", 0, 0},
        {"local", 0, 0},
        {"", 0, 0},
    };
    for (const auto& each : cases) {
        const CrsCodes codes = codesOf(each.name);
        EXPECT_EQ(codes.horizontal, each.horizontal) << each.name;
        EXPECT_EQ(codes.vertical, each.vertical) << each.name;
        EXPECT_EQ(epsgCodeOf(each.name), static_cast<std::uint32_t>(each.horizontal)) << each.name;
    }
}

TEST(CrsFacts, KnowTheAreaOfUse) {
    EXPECT_EQ(isInAreaOfUse(25832, {691603, 5334780, 0}), true);
    EXPECT_EQ(isInAreaOfUse(25832, {5334780, 691603, 0}), false);
    EXPECT_EQ(isInAreaOfUse(4258, {11.5, 48.1, 0}), true);
    EXPECT_EQ(isInAreaOfUse(4258, {48.1, 11.5, 0}), false);
    EXPECT_EQ(isInAreaOfUse(4269, {-73.9, 40.7, 0}), true) << "over the 180th meridian";
    EXPECT_EQ(isInAreaOfUse(4269, {40.7, -73.9, 0}), false);
    const auto amsterdam = isInAreaOfUse(28992, {121000, 487000, 0});
    if (amsterdam) {  // by PROJ
        EXPECT_TRUE(*amsterdam);
        EXPECT_EQ(isInAreaOfUse(28992, {487000, 121000, 0}), false);
        EXPECT_EQ(isInAreaOfUse(28992, {500000, 5400000, 0}), false);
    }
    EXPECT_EQ(isInAreaOfUse(999999, {0, 0, 0}), std::nullopt);
}

TEST(CrsFacts, KnowTheScaleOfWorldMercator) {
    const MapScale munich = mapScaleAt(3857, {1288577, 6130000, 0});
    EXPECT_NEAR(munich.factor, 1 / std::cos(48.1 * 3.14159265358979 / 180), 0.01);
    EXPECT_EQ(munich.localCode, 32632);
    EXPECT_EQ(mapScaleAt(25832, {691603, 5334780, 0}).factor, 1);
}

TEST(Globe, TheGeoidComesFromAGridOfProj) {
    EXPECT_EQ(geoidHeight(25832, 0, {691603, 5334780, 0}), std::nullopt);
    EXPECT_EQ(geoidHeight(0, 5773, {}), std::nullopt);
    const auto height = geoidHeight(32632, 5773, {691603, 5334780, 0});
    if (!height) GTEST_SKIP() << "PROJ or its grid of EGM96 is not installed";
    EXPECT_NEAR(*height, 46.5, 1.5);
}

TEST(CrsFacts, TellDegreesFeetAndParts) {
    EXPECT_TRUE(factsOf(6697).isDegrees);
    EXPECT_EQ(factsOf(6697).horizontal, 6668);
    EXPECT_EQ(factsOf(6697).vertical, 6695);
    EXPECT_EQ(factsOf(6697).order, AxisOrder::NorthEast);
    EXPECT_TRUE(factsOf(25832).isMetres);
    EXPECT_TRUE(factsOf(7415).isMetres);
    EXPECT_FALSE(factsOf(2263).isMetres);
    EXPECT_FALSE(factsOf(2263).isDegrees);
    EXPECT_FALSE(factsOf(7057).isMetres) << "feet without a twin in metres";
    EXPECT_TRUE(factsOf(0).isMetres);
    EXPECT_EQ(metresPerHeight(5703), 1);
    EXPECT_EQ(metresPerHeight(6360), kSurveyFoot);
    EXPECT_EQ(metresPerHeight(8228), kFoot);
    EXPECT_TRUE(areaOf(6697)->contains({139.7, 35.6, 0}));
    EXPECT_FALSE(areaOf(6697)->contains({35.6, 139.7, 0}));
    EXPECT_FALSE(areaOf(4269)) << "beyond the 180th meridian";
}

}  // namespace
}  // namespace svt::crs
