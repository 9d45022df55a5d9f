#include <svt/mesh/models_test.hpp>
#include <svt/mesh/polygons/local_polygons.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace svt::mesh {
namespace {

using test::addRings;

std::vector<std::uint8_t> all(const model::BuildingModel& model) {
    return std::vector<std::uint8_t>(model.polygons.size(), 1);
}

TEST(ClusterValues, NoiseIsJoinedAndDistinctValuesStay) {
    std::vector<double> values{3, 3.000001, 1, 2.999999, 1.1, 3.000002};
    clusterValues(values, 5e-6);
    const std::vector<double> expected{2.999999, 2.999999, 1, 2.999999, 1.1, 2.999999};
    EXPECT_EQ(values, expected);
}

TEST(ClusterValues, ChainReachesNoFurtherThanTheDistance) {
    // Steps smaller than the distance over a length much larger than it.
    std::vector<double> values, before;
    for (int n = 0; n < 1000; ++n) values.push_back(n * 1e-6);
    before = values;
    clusterValues(values, 5.5e-6);
    std::set<double> distinct(values.begin(), values.end());
    EXPECT_EQ(distinct.size(), 167u);  // six values each
    for (std::size_t v = 0; v < values.size(); ++v) {
        EXPECT_LE(values[v], before[v]);
        EXPECT_LE(before[v] - values[v], 5.5e-6);
    }
}

TEST(ClusterValues, OrderDoesNotMatter) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> noise(-2e-6, 2e-6);
    std::vector<double> values;
    for (int n = 0; n < 500; ++n) values.push_back((n % 20) * 0.25 + noise(random));
    std::vector<std::size_t> order(values.size());
    for (std::size_t v = 0; v < order.size(); ++v) order[v] = v;
    std::shuffle(order.begin(), order.end(), random);
    std::vector<double> shuffled;
    for (const std::size_t v : order) shuffled.push_back(values[v]);
    clusterValues(values, 5e-6);
    clusterValues(shuffled, 5e-6);
    for (std::size_t v = 0; v < order.size(); ++v) ASSERT_EQ(shuffled[v], values[order[v]]);
    EXPECT_EQ(std::set<double>(values.begin(), values.end()).size(), 20u);
}

TEST(ClusterValues, NothingIsNothing) {
    std::vector<double> none;
    clusterValues(none, 1);
    std::vector<double> one{-7.5};
    clusterValues(one, 1);
    EXPECT_EQ(one[0], -7.5);
}

TEST(PrepareLocalPolygons, OriginIsTheWholeMetreBelowAllPoints) {
    model::BuildingModel model;
    addRings(model, {{{458877.6, 5438353.2, -0.3}, {458880.6, 5438353.2, -0.3}, {458880.6, 5438356.2, -0.3}}});
    const LocalPolygons local = prepareLocalPolygons(model, all(model), {}, nullptr);
    EXPECT_EQ(local.origin, (Vec3d{458877, 5438353, -1}));
    EXPECT_NEAR(local.points[0].x, 0.6, 1e-9);
    EXPECT_NEAR(local.points[0].z, 0.7, 1e-9);
}

TEST(PrepareLocalPolygons, PointsOfDifferentPolygonsAreWeldedWithinTheNoise) {
    model::BuildingModel model;
    addRings(model, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}});
    addRings(model, {{{1.000001, 0, 1e-6}, {0.999999, 1, 0}, {2, 0, 0}}});
    const LocalPolygons local = prepareLocalPolygons(model, all(model), {}, nullptr);
    EXPECT_EQ(local.weldedCount, 4u);
    EXPECT_EQ(local.pointIds[1], local.pointIds[3]);
    EXPECT_EQ(local.pointIds[2], local.pointIds[4]);
    EXPECT_EQ(local.points[1], local.points[3]);
}

TEST(PrepareLocalPolygons, UnusedPolygonsAreNotLaidOut) {
    model::BuildingModel model;
    addRings(model, {{{-1e6, 0, 0}, {1, 0, 0}, {1, 1, 0}}});
    addRings(model, {{{5, 5, 5}, {6, 5, 5}, {6, 6, 5}}});
    const LocalPolygons local = prepareLocalPolygons(model, {0, 1}, {}, nullptr);
    EXPECT_EQ(local.origin, (Vec3d{5, 5, 5}));
    EXPECT_EQ(local.points.size(), 3u);
    EXPECT_TRUE(local.trianglesOf(0).empty());
    EXPECT_EQ(local.trianglesOf(1).size(), 1u);
}

TEST(PrepareLocalPolygons, BadCoordinatesAreReportedAndTheRestIsKept) {
    model::BuildingModel model;
    model.source = "house.gml";
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308, -1e9})
        addRings(model, {{{0, 0, 0}, {bad, 0, 0}, {1, 1, 0}}});
    addRings(model, {{{0, 0, 0}, {9e8, 0, 0}, {1, 1, 0}}});
    Diagnostics log;
    const LocalPolygons local = prepareLocalPolygons(model, all(model), {}, &log);
    EXPECT_EQ(log.count(Code::BadCoordinate), 4u);
    EXPECT_EQ(log.items()[0].where.id, "polygon-0");
    EXPECT_EQ(local.triangles.size(), 1u);
    EXPECT_EQ(local.trianglesOf(4).size(), 1u);
}

TEST(PrepareLocalPolygons, FindingsNameThePolygon) {
    model::BuildingModel model;
    addRings(model, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}});
    addRings(model, {{{0, -2, 0}, {3, 1, 0}, {3, -1, 0}, {0, 2, 0}}});
    addRings(model, {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0.4}, {0, 4, 0}}});
    addRings(model, {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0.004}, {0, 4, 0}}});
    Diagnostics log;
    const LocalPolygons local = prepareLocalPolygons(model, all(model), {}, &log);
    ASSERT_EQ(log.items().size(), 3u);
    EXPECT_EQ(log.items()[0].code, Code::ZeroArea);
    EXPECT_EQ(log.items()[0].where.id, "polygon-0");
    EXPECT_EQ(log.items()[1].code, Code::SelfTouchingRing);
    EXPECT_EQ(log.items()[1].where.id, "polygon-1");
    EXPECT_EQ(log.items()[2].code, Code::NonPlanar);
    EXPECT_EQ(log.items()[2].where.id, "polygon-2");
    EXPECT_EQ(local.points.size(), 17u);  // one where the ring crosses itself
}

}  // namespace
}  // namespace svt::mesh
