#include <svt/crs/crs_facts.hpp>
#include <svt/crs/projection.hpp>
#include <svt/readers/georeference/far_features.hpp>
#include <svt/readers/georeference/georeference.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace svt::readers::georeference {
namespace {

// A building of one triangle at `points`, and an own root.
void addBuilding(model::BuildingModel& model, std::string id, std::vector<Vec3d> points) {
    model::Polygon polygon;
    polygon.ringEnds = {static_cast<std::uint32_t>(points.size())};
    polygon.points = std::move(points);
    model::Geometry geometry;
    geometry.surfaces.push_back({model.addPolygon(std::move(polygon)), false});
    model::Feature feature;
    feature.id = std::move(id);
    feature.className = "Building";
    feature.geometries.push_back(std::move(geometry));
    model.addFeature(std::move(feature), model::kNoFeature);
}

struct Placed {
    Result<void> result;
    model::BuildingModel model;
    Diagnostics diagnostics;

    const Vec3d& point(std::size_t i) const { return model.polygons.at(0).points.at(i); }
    std::string findings() const {
        std::string text;
        for (const Diagnostic& item : diagnostics.items()) text += item.toString() + "\n";
        return text;
    }
};

Placed place(std::vector<Vec3d> points, std::string_view crs, const ReadOptions& options = {},
             std::string_view units = {}) {
    Placed placed;
    addBuilding(placed.model, "b", std::move(points));
    const GivenCrs given{std::string(crs), std::string(units), false, {"test.gml", 3, 0, {}}, {}};
    placed.result = georeference(placed.model, given, options, placed.diagnostics);
    return placed;
}

void expectNear(Vec3d a, Vec3d b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

// Tokyo station in degrees north, east, and by cs2cs in plane IX; Munich in UTM zone 32.
const std::vector<Vec3d> kTokyo{{35.6812, 139.7671, 3}, {35.6813, 139.7671, 3}, {35.6812, 139.7673, 8}};
constexpr Vec3d kTokyoMetres{-5995.1852, -35367.2301, 3};
const std::vector<Vec3d> kMunich{{48.1374, 11.5755, 520}, {48.1375, 11.5755, 520}, {48.1374, 11.5757, 530}};
constexpr Vec3d kMunichMetres{691603.0320, 5334780.0309, 520};

std::vector<Vec3d> swapped(std::vector<Vec3d> points) {
    for (Vec3d& point : points) std::swap(point.x, point.y);
    return points;
}

TEST(Georeference, DegreesBecomeMetresOfTheUsualProjectionInEitherOrder) {
    for (const std::string_view name :
         {"http://www.opengis.net/def/crs/EPSG/0/6697", "EPSG:6697", "urn:ogc:def:crs,crs:EPSG::6668,crs:EPSG::6695"})
        for (const bool isNorthFirst : {true, false}) {
            const Placed placed = place(isNorthFirst ? kTokyo : swapped(kTokyo), name);
            ASSERT_TRUE(placed.result) << placed.result.error().toString();
            expectNear(placed.point(0), kTokyoMetres, 1e-4);
            EXPECT_GT(placed.point(1).y, placed.point(0).y + 11) << "the second point lies to the north";
            EXPECT_GT(placed.point(2).x, placed.point(0).x + 18) << "the third to the east";
            EXPECT_EQ(placed.model.crs.epsg, 6677);
            EXPECT_EQ(placed.model.crs.axesSwapped, isNorthFirst);
            EXPECT_NE(placed.model.crs.name.find("EPSG:6677 (from EPSG:66"), std::string::npos);
            EXPECT_EQ(placed.diagnostics.count(Code::GeographicCrs), 1u);
            EXPECT_EQ(placed.diagnostics.count(Severity::Error), 0u);
        }
}

TEST(Georeference, WhereBothOrdersArePossibleTheAreaOfUseOrTheNameDecides) {
    // Of ETRS89 only one order lies in Europe; of WGS 84 the form of the name counts.
    const std::pair<std::string_view, std::vector<Vec3d>> cases[] = {
        {"EPSG:4258", kMunich},
        {"EPSG:4258", swapped(kMunich)},
        {"urn:ogc:def:crs:EPSG::4326", kMunich},
        {"EPSG:4326", swapped(kMunich)},
        {"urn:ogc:def:crs:OGC:1.3:CRS84", swapped(kMunich)}};
    for (const auto& [name, points] : cases) {
        const Placed placed = place(points, name);
        ASSERT_TRUE(placed.result) << placed.result.error().toString();
        expectNear(placed.point(0), kMunichMetres, 1e-3);
    }
    EXPECT_EQ(place(kMunich, "EPSG:4258").model.crs.epsg, 25832);
    EXPECT_EQ(place(kMunich, "urn:ogc:def:crs:EPSG::4979").model.crs.epsg, 32632);
}

TEST(Georeference, DegreesInWhichBuildingsAreKilometresWideAreRefusedOrLengths) {
    // A room of 52 by 50 metres in a file that names degrees, as some editors of IndoorGML write it.
    const std::vector<Vec3d> room{{0.16, 0.17, 0}, {51.86, 0.17, 0}, {51.86, 49.83, 3}};
    const Placed refused = place(room, "EPSG::4326");
    ASSERT_FALSE(refused.result);
    EXPECT_EQ(refused.result.error().code(), Code::UnitInDoubt);
    EXPECT_NE(refused.result.error().message().find("51.7 degrees wide"), std::string::npos);
    ReadOptions inMetres;
    inMetres.unit = 1;
    const Placed placed = place(room, "EPSG::4326", inMetres);
    ASSERT_TRUE(placed.result) << placed.result.error().toString();
    EXPECT_EQ(placed.point(1), room[1]);
    EXPECT_EQ(placed.model.crs.epsg, 0);
    EXPECT_EQ(placed.model.crs.name, "");
    EXPECT_EQ(placed.diagnostics.count(Severity::Warning), 1u) << placed.findings();
    // Degrees of a building have no other unit.
    const Placed wrong = place(kTokyo, "EPSG:6697", inMetres);
    ASSERT_FALSE(wrong.result);
    EXPECT_EQ(wrong.result.error().code(), Code::BadArgument);
}

TEST(Georeference, ShapesPlacedByAddingMetresToDegreesAreNotKilometresWide) {
    const Vec3d anchor{35.6812, 139.7671, 3};
    model::BuildingModel model;
    addBuilding(model, "hut", {anchor, anchor + Vec3d{3, 0, 0}, anchor + Vec3d{3, 2, 5}});
    const std::vector<Vec3d> anchors{anchor};
    Diagnostics diagnostics;
    const auto done = georeference(model, {"urn:ogc:def:crs:EPSG::6697", {}, false, {}, anchors}, {}, diagnostics);
    ASSERT_TRUE(done) << done.error().toString();
    expectNear(model.polygons[0].points[0], kTokyoMetres, 1e-4);
}

TEST(Georeference, GeocentricCoordinatesAreRefused) {
    const std::vector<Vec3d> points{{3923513, 299831, 5002803}, {3923523, 299831, 5002803}, {3923513, 299841, 5002803}};
    for (const std::string_view name : {"https://www.opengis.net/def/crs/EPSG/0/4978", "EPSG:4936"}) {
        const Placed placed = place(points, name);
        ASSERT_FALSE(placed.result) << name;
        EXPECT_EQ(placed.result.error().code(), Code::CannotProject);
        EXPECT_NE(placed.result.error().message().find("centre of the earth"), std::string::npos);
    }
}

TEST(Georeference, CoordinatesTooLargeForDegreesHaveNoCrs) {
    const std::vector<Vec3d> points{{458000, 5438000, 110}, {458010, 5438000, 110}, {458010, 5438010, 115}};
    const Placed placed = place(points, "EPSG:4326");
    ASSERT_TRUE(placed.result);
    EXPECT_EQ(placed.point(0), points[0]);
    EXPECT_EQ(placed.model.crs.epsg, 0);
    EXPECT_EQ(placed.diagnostics.count(Severity::Warning), 1u) << placed.findings();
}

TEST(Georeference, FeetBecomeMetresWithTheirHeights) {
    const std::vector<Vec3d> feet{{981106, 195544, 100}, {981206, 195544, 100}, {981206, 195644, 130}};
    const Vec3d metres{299041.7069, 59601.9304, 100};
    struct Case {
        std::string_view name, units;
        double height;
    };
    const Case cases[] = {
        {"EPSG:2263", "", 100 * crs::kSurveyFoot},
        {"urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::6360", "", 100 * crs::kSurveyFoot},
        {"urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::8228", "", 100 * crs::kFoot},
        {"urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::5703", "", 100},
        {"EPSG:2263+5703", "", 100},
        {"EPSG:2263", "ftUS ftUS m", 100},
        {"EPSG:2263", "ft ft ft", 100 * crs::kFoot},
    };
    for (const Case& each : cases) {
        const Placed placed = place(feet, each.name, {}, each.units);
        ASSERT_TRUE(placed.result) << placed.result.error().toString();
        expectNear(placed.point(0), {metres.x, metres.y, each.height}, 5e-4);
        EXPECT_EQ(placed.model.crs.epsg, 32118);
        EXPECT_EQ(placed.diagnostics.count(Code::ForeignUnit), 1u) << placed.findings();
    }
    // Metres in plan, feet in height.
    const Placed mixed = place({{500000, 5400000, 100}, {500010, 5400000, 100}, {500010, 5400010, 130}},
                               "urn:ogc:def:crs,crs:EPSG::26918,crs:EPSG::6360");
    ASSERT_TRUE(mixed.result);
    expectNear(mixed.point(0), {500000, 5400000, 100 * crs::kSurveyFoot}, 1e-9);
    EXPECT_EQ(mixed.diagnostics.count(Code::ForeignUnit), 1u);
}

TEST(Georeference, MetresStayAsTheyAre) {
    const std::vector<Vec3d> points{{500000, 5400000, 3}, {500010, 5400000, 3}, {500010, 5400010, 8}};
    for (const std::string_view name : {"EPSG:25832", "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837", "", "local"}) {
        const Placed placed = place(points, name);
        EXPECT_EQ(placed.model.polygons[0].points, points);
        EXPECT_EQ(placed.model.crs.name, name);
        EXPECT_TRUE(placed.diagnostics.items().empty()) << placed.findings();
    }
}

TEST(Georeference, AnotherProjectionByWish) {
    ReadOptions options;
    options.crs = 25833;
    const std::vector<Vec3d> points{{500000, 5400000, 3}, {500010, 5400000, 3}, {500010, 5400010, 8}};
    EXPECT_EQ(place(points, "", options).result.error().code(), Code::CannotProject) << "a file that names no CRS";
    EXPECT_EQ(place(points, "EPSG:4326", options).result.error().code(), Code::CannotProject) << "no degrees";
    EXPECT_EQ(place(points, "EPSG:25833", options).model.polygons[0].points, points) << "it is there already";
    const Placed own = place(kMunich, "EPSG:4258", options);
    ASSERT_TRUE(own.result);
    EXPECT_EQ(own.model.crs.epsg, 25833);
    if (crs::projVersion().empty()) GTEST_SKIP() << "a build without PROJ";
    const Placed placed = place(points, "EPSG:25832", options);
    ASSERT_TRUE(placed.result) << placed.result.error().toString();
    expectNear(placed.point(0), {59084.6944, 5417387.8212, 3}, 1e-3);
    EXPECT_EQ(placed.model.crs.name, "EPSG:25833 (from EPSG:25832)");
    for (const int target : {4326, 2263, 999999}) {
        options.crs = target;
        EXPECT_EQ(place(points, "EPSG:25832", options).result.error().code(), Code::BadArgument) << target;
    }
}

TEST(Georeference, TheLikelyProjectionIsTakenForDegreesAlone) {
    ReadOptions options;
    options.likelyCrs = 32633;
    EXPECT_EQ(place(kMunich, "urn:ogc:def:crs:EPSG::4326", options).model.crs.epsg, 32633);
    EXPECT_EQ(place({{1, 2, 3}, {4, 5, 6}, {7, 8, 0}}, "EPSG:25832", options).model.crs.epsg, 25832);
}

// A box from `low` to `high` with its faces outward, or inward.
void addBox(model::BuildingModel& model, std::string id, Vec3d low, Vec3d high, bool isInward,
            std::string className = "Building") {
    constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    model::Solid solid;
    for (const auto& face : kFaces) {
        model::Polygon polygon;
        for (const int corner : face)
            polygon.points.push_back({(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                      (corner & 4) != 0 ? high.z : low.z});
        polygon.ringEnds = {4};
        solid.exterior.push_back({model.addPolygon(std::move(polygon)), isInward});
    }
    model::Geometry geometry;
    geometry.kind = model::GeometryKind::Solid;
    geometry.solids.push_back(std::move(solid));
    model::Feature feature;
    feature.id = std::move(id);
    feature.className = std::move(className);
    feature.geometries.push_back(std::move(geometry));
    model.addFeature(std::move(feature), model::kNoFeature);
}

Placed placed(model::BuildingModel model, std::string_view crs, const ReadOptions& options = {},
              std::string_view units = {}) {
    Placed result;
    result.model = std::move(model);
    const GivenCrs given{std::string(crs), std::string(units), false, {"test.gml", 3, 0, {}}, {}};
    result.result = georeference(result.model, given, options, result.diagnostics);
    return result;
}

// The building of Washington whose shells face inward: the name decides, longitude first.
TEST(Georeference, AnInwardShellDoesNotOverruleTheName) {
    for (const bool isInward : {false, true}) {
        model::BuildingModel model;
        addBox(model, "b", {-77.0111, 38.8976, 0}, {-77.0108, 38.8979, 46}, isInward);
        const Placed found = placed(std::move(model), "EPSG:4979");
        ASSERT_TRUE(found.result) << found.result.error().toString();
        EXPECT_EQ(found.model.crs.epsg, 32618);
        EXPECT_FALSE(found.model.crs.axesSwapped);
        EXPECT_NEAR(found.point(0).y, 4307216, 200);
        EXPECT_NE(found.findings().find("axes taken as east, north"), std::string::npos) << found.findings();
    }
}

TEST(Georeference, TheUserMayStateTheOrder) {
    ReadOptions options;
    options.axisOrder = -1;
    const Placed found = place(swapped(kMunich), "EPSG:4326", options);
    ASSERT_TRUE(found.result);
    EXPECT_TRUE(found.model.crs.axesSwapped);
    EXPECT_EQ(found.diagnostics.count(Code::AxisOrder), 0u);
    options.axisOrder = 1;
    EXPECT_FALSE(place(kMunich, "urn:ogc:def:crs:EPSG::4326", options).model.crs.axesSwapped);
}

TEST(Georeference, CoordinatesOutsideOfTheAreaOfUseTakeTheOtherOrder) {
    const std::vector<Vec3d> north{{5334780, 691603, 5}, {5334790, 691603, 5}, {5334780, 691613, 9}};
    for (const std::string_view name : {"EPSG:25832", "urn:ogc:def:crs:EPSG::25832", "EPSG:32632"}) {
        const Placed found = place(north, name);
        EXPECT_TRUE(found.model.crs.axesSwapped) << name;
        EXPECT_EQ(found.diagnostics.count(Code::AxisOrder), 1u) << found.findings();
        EXPECT_FALSE(place(swapped(north), name).model.crs.axesSwapped) << name;
    }
    if (crs::projVersion().empty()) GTEST_SKIP() << "a build without PROJ";
    // Turkey, TUREF / TM30: no magnitude is built in.
    const std::vector<Vec3d> turkey{{4500000, 500000, 5}, {4500010, 500000, 5}, {4500000, 500010, 9}};
    EXPECT_TRUE(place(turkey, "EPSG:5254").model.crs.axesSwapped);
    EXPECT_FALSE(place(swapped(turkey), "urn:ogc:def:crs:EPSG::5254").model.crs.axesSwapped);
}

// A system that no table knows, with north first: the shells of the model face inward.
TEST(Georeference, SeveralInwardShellsWarnOfAMirroredModel) {
    for (const int count : {1, 4}) {
        model::BuildingModel model;
        for (int n = 0; n < count; ++n)
            addBox(model, fmt::format("b{}", n), {20.0 * n, 0, 0}, {20.0 * n + 10, 8, 6}, true);
        const Placed found = placed(std::move(model), "EPSG:999998");
        EXPECT_EQ(found.diagnostics.count(Code::AxisOrder), count == 4 ? 1u : 0u) << found.findings();
        EXPECT_EQ(found.findings().find("--axis-order north-east") != std::string::npos, count == 4);
        EXPECT_EQ(found.point(0), Vec3d()) << "nothing is changed";
    }
}

TEST(Georeference, WebMercatorIsAWarningWithTheScale) {
    const std::vector<Vec3d> munich{{1288577, 6130000, 5}, {1288587, 6130000, 5}, {1288577, 6130010, 9}};
    const Placed found = place(munich, "EPSG:3857");
    ASSERT_EQ(found.diagnostics.count(Code::MapScale), 1u) << found.findings();
    EXPECT_NE(found.findings().find("lengths 1.499 times, areas and volumes 2.25 times"), std::string::npos)
        << found.findings();
    EXPECT_NE(found.findings().find("--crs EPSG:32632"), std::string::npos);
    EXPECT_EQ(place(munich, "EPSG:25832").diagnostics.count(Code::MapScale), 0u);
}

TEST(Georeference, APlaceOutsideOfTheAreaOfTheCrsIsAWarning) {
    const std::vector<Vec3d> local{{10, 20, 0}, {20, 20, 0}, {10, 30, 9}},
        amsterdam{{121000, 487000, 0}, {121010, 487000, 0}, {121000, 487010, 9}};
    ASSERT_EQ(place(local, "EPSG:25832").diagnostics.count(Code::OutsideArea), 1u);
    EXPECT_NE(place(local, "EPSG:25832").findings().find("the model lies at (15, 25), outside of the area"),
              std::string::npos);
    EXPECT_EQ(place(amsterdam, "EPSG:25832").diagnostics.count(Code::OutsideArea), 1u);
    EXPECT_EQ(place(amsterdam, "EPSG:7415").diagnostics.count(Code::OutsideArea), 0u);
    EXPECT_EQ(place(local, "").diagnostics.count(Code::OutsideArea), 0u);
    EXPECT_EQ(place(local, "EPSG:999998").diagnostics.count(Code::OutsideArea), 0u);
    EXPECT_EQ(place(kMunich, "EPSG:4258").diagnostics.count(Code::OutsideArea), 0u) << "after the projection";
}

TEST(Georeference, TheUnitIsThatOfTheUserOrOfTheFileOrPlausible) {
    const auto rooms = [](double unit) {
        model::BuildingModel model;
        for (int n = 0; n < 4; ++n)
            addBox(model, fmt::format("r{}", n), Vec3d{5.0 * n, 0, 0} * unit, Vec3d{5.0 * n + 4, 3, 2.8} * unit, false,
                   "BuildingRoom");
        return model;
    };
    EXPECT_TRUE(placed(rooms(1), "").result);
    EXPECT_EQ(placed(rooms(1000), "").result.error().code(), Code::UnitInDoubt);
    EXPECT_NE(placed(rooms(1000), "").result.error().message().find("--unit mm"), std::string::npos);
    model::BuildingModel millimetres;
    addBox(millimetres, "b", Vec3d{0, 0, 0}, Vec3d{10000, 10000, 3000}, false, "Building");
    EXPECT_EQ(placed(std::move(millimetres), "").result.error().code(), Code::UnitInDoubt) << "without rooms";
    EXPECT_NE(placed(rooms(100), "local").result.error().message().find("--unit cm"), std::string::npos);
    EXPECT_EQ(placed(rooms(1), "").diagnostics.count(Code::UnitInDoubt), 0u);
    EXPECT_EQ(placed(rooms(8), "").diagnostics.count(Code::UnitInDoubt), 1u) << "rooms of 22 units: a warning";
    EXPECT_EQ(placed(rooms(8), "EPSG:25832").diagnostics.count(Code::UnitInDoubt), 0u);
    ReadOptions options;
    options.unit = 0.001;
    for (const Placed& found : {placed(rooms(1000), "", options), placed(rooms(1000), "EPSG:4326", options),
                                placed(rooms(1000), "", {}, "mm mm mm")}) {
        ASSERT_TRUE(found.result) << found.result.error().toString();
        const model::Feature& last = found.model.features.back();
        expectNear(found.model.bounds(last.geometries[0]).max, {19, 3, 2.8}, 1e-9);
        EXPECT_EQ(found.diagnostics.count(Code::ForeignUnit), 1u) << found.findings();
    }
    EXPECT_EQ(place(kMunich, "EPSG:4258", options).result.error().code(), Code::BadArgument);
    options.unit = 1;
    EXPECT_TRUE(placed(rooms(1000), "", options).result) << "the user says metres";
}

TEST(Georeference, ACompoundCodeIsItsHorizontalPart) {
    const std::vector<Vec3d> points{{121000, 487000, 3}, {121010, 487000, 3}, {121010, 487010, 8}};
    const Placed found = place(points, "urn:ogc:def:crs:EPSG::7415");
    EXPECT_EQ(found.model.crs.epsg, 28992);
    ReadOptions options;
    options.crs = 28992;
    EXPECT_EQ(place(points, "EPSG:7415", options).model.polygons[0].points, points) << "it is there already";
}

TEST(Georeference, DegreesOfNoKnownSystemAreAnError) {
    EXPECT_EQ(place(kTokyo, "").result.error().code(), Code::GeographicCrs);
    EXPECT_EQ(place(kTokyo, "somewhere").result.error().code(), Code::GeographicCrs);
}

TEST(Georeference, PlacedShapesKeepTheirMetres) {
    // A shape of 3 m by 2 m at a reference point in degrees, as the reader places it: metres added to degrees.
    const Vec3d anchor{35.6812, 139.7671, 3};
    model::BuildingModel model;
    addBuilding(model, "house", kTokyo);
    addBuilding(model, "lamp", {anchor, anchor + Vec3d{3, 0, 0}, anchor + Vec3d{3, 2, 5}});
    const std::vector<Vec3d> anchors{kNoAnchor, anchor};
    const GivenCrs given{"urn:ogc:def:crs:EPSG::6697", {}, false, {}, anchors};
    Diagnostics diagnostics;
    ASSERT_TRUE(georeference(model, given, {}, diagnostics));
    const std::vector<Vec3d>& lamp = model.polygons[1].points;
    expectNear(lamp[0], kTokyoMetres, 1e-4);
    EXPECT_NEAR(length(lamp[1] - lamp[0]), 3, 1e-3);
    EXPECT_GT(lamp[1].x, lamp[0].x + 2.99) << "to the east";
    EXPECT_GT(lamp[2].y, lamp[1].y + 1.99) << "to the north";
    EXPECT_NEAR(lamp[2].z, 8, 1e-9);
}

std::vector<Vec3d> triangleAt(double x, double y) { return {{x, y, 0}, {x + 10, y, 0}, {x, y + 10, 4}}; }

TEST(FarFeatures, OneFarAwayIsNamedAndLeftOut) {
    model::BuildingModel model;
    for (int i = 0; i < 8; ++i) addBuilding(model, fmt::format("near{}", i), triangleAt(500000 + 30 * i, 5400000));
    addBuilding(model, "far", triangleAt(0, 0));
    const GivenCrs given{"EPSG:25832", {}, false, {"test.gml", 0, 0, {}}, {}};
    Diagnostics diagnostics;
    ReadOptions keeping;
    keeping.keepFarFeatures = true;
    model::BuildingModel kept = model;
    ASSERT_TRUE(georeference(kept, given, keeping, diagnostics));
    EXPECT_FALSE(kept.features.back().geometries.empty());
    EXPECT_TRUE(diagnostics.items().empty());

    ASSERT_TRUE(georeference(model, given, {}, diagnostics));
    EXPECT_TRUE(model.features.back().geometries.empty());
    EXPECT_TRUE(std::none_of(model.features.begin(), model.features.end() - 1,
                             [](const model::Feature& feature) { return feature.geometries.empty(); }));
    ASSERT_EQ(diagnostics.count(Code::FarFeature), 1u);
    EXPECT_EQ(diagnostics.items()[0].where.id, "far");
    EXPECT_NE(diagnostics.items()[0].message.find("5423 km"), std::string::npos) << diagnostics.items()[0].message;
}

TEST(FarFeatures, AFarBuildingWithPartsIsOneFinding) {
    model::BuildingModel model;
    for (int i = 0; i < 8; ++i) addBuilding(model, fmt::format("near{}", i), triangleAt(30 * i, 0));
    addBuilding(model, "far", triangleAt(7e6, 0));
    const auto far = static_cast<model::FeatureIndex>(model.features.size() - 1);
    model::Feature part = model.features[far];
    part.id = "part";
    part.parent = model::kNoFeature;
    model.addFeature(std::move(part), far);
    Diagnostics diagnostics;
    EXPECT_EQ(leaveOutFarFeatures(model, {1, 1, 1}, {}, diagnostics), 2u);
    ASSERT_EQ(diagnostics.count(Code::FarFeature), 1u);
    EXPECT_EQ(diagnostics.items()[0].where.id, "far");
}

TEST(FarFeatures, WideModelsKeepAll) {
    const auto leftOut = [](const std::vector<double>& places) {
        model::BuildingModel model;
        for (const double x : places) addBuilding(model, "b", triangleAt(x, 0));
        Diagnostics diagnostics;
        return leaveOutFarFeatures(model, {1, 1, 1}, {}, diagnostics);
    };
    EXPECT_EQ(leftOut({0, 50, 100, 9000}), 0u) << "within 10 km";
    EXPECT_EQ(leftOut({0, 1000, 2000, 3000, 40000}), 0u) << "within 50 times the spread";
    EXPECT_EQ(leftOut({0, 7e6}), 0u) << "two: none is the far one";
    EXPECT_EQ(leftOut({0, 100, 7e6, 7.0001e6}), 0u) << "two here and two there";
    EXPECT_EQ(leftOut({0, 100, 200, 300, 400, 500, 600, 7e6}), 1u);
}

}  // namespace
}  // namespace svt::readers::georeference
