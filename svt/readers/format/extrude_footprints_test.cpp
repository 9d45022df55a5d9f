#include <svt/readers/format/extrude_footprints.hpp>

#include <svt/readers/read_model.hpp>

#include <gtest/gtest.h>

#include <span>

namespace svt::readers {
namespace {

using model::BuildingModel;

// Six times the volume that faces enclose, by fans, which is right for convex faces and for those with the origin's side.
double volumeOf(const BuildingModel& model, const model::Solid& solid) {
    double sum = 0;
    for (const model::SurfaceUse& use : solid.exterior) {
        const model::Polygon& polygon = model.polygons[use.polygon];
        std::size_t begin = 0;
        for (const std::uint32_t end : polygon.ringEnds) {
            for (std::size_t i = begin + 1; i + 1 < end; ++i)
                sum += (use.isReversed ? -1 : 1) *
                       dot(polygon.points[begin], cross(polygon.points[i], polygon.points[i + 1])) / 6;
            begin = end;
        }
    }
    return sum;
}

BuildingModel modelWith(std::vector<Vec3d> points, std::vector<std::uint32_t> ends, std::vector<Attribute> attributes) {
    BuildingModel model;
    model::Feature building;
    building.id = "b";
    building.className = "Building";
    building.attributes = std::move(attributes);
    model::Geometry flat;
    flat.lod = 0;
    flat.surfaces = {{model.addPolygon({std::move(points), std::move(ends), {}, -1}), false}};
    building.geometries = {flat};
    model.addFeature(std::move(building), model::kNoFeature);
    return model;
}

const std::vector<Vec3d> kRing{{0, 0, 5}, {4, 0, 5}, {4, 3, 5}, {0, 3, 5}};
// With a hole of one square metre that runs the same way.
const std::vector<Vec3d> kRingAndHole{{0, 0, 5}, {4, 0, 5}, {4, 3, 5}, {0, 3, 5},
                                      {1, 1, 5}, {2, 1, 5}, {2, 2, 5}, {1, 2, 5}};

TEST(ExtrudeFootprints, APrismFacesOutwardsWhicheverWayTheRingsRun) {
    for (const bool isTurned : {false, true}) {
        std::vector<Vec3d> points = kRingAndHole;
        if (isTurned) std::reverse(points.begin(), points.begin() + 4);
        BuildingModel model = modelWith(points, {4, 8}, {{"measuredHeight", 2.5, "m"}});
        EXPECT_EQ(extrudeFootprints(model, nullptr), 1u);
        ASSERT_EQ(model.features[0].geometries.size(), 2u);
        const model::Geometry& body = model.features[0].geometries[1];
        EXPECT_EQ(body.kind, model::GeometryKind::Solid);
        EXPECT_EQ(body.lod, 1);
        ASSERT_EQ(body.solids.size(), 1u);
        EXPECT_EQ(body.solids[0].exterior.size(), 10u);
        EXPECT_NEAR(volumeOf(model, body.solids[0]), 11 * 2.5, 1e-9);
    }
}

TEST(ExtrudeFootprints, HeightsOfParentsFeetAndWholeNumbersCount) {
    BuildingModel inFeet = modelWith(kRing, {4}, {{"height", std::int64_t{10}, "ftUS"}});
    EXPECT_EQ(extrudeFootprints(inFeet, nullptr), 1u);
    EXPECT_NEAR(volumeOf(inFeet, inFeet.features[0].geometries[1].solids[0]), 12 * 3.048, 1e-9);

    BuildingModel model = modelWith(kRing, {4}, {{"measuredHeight", 3.0, ""}});
    model::Feature part;
    part.id = "p";
    part.className = "BuildingPart";
    part.geometries = model.features[0].geometries;
    model.addFeature(part, 0);
    model.features[0].geometries.clear();
    EXPECT_EQ(extrudeFootprints(model, nullptr), 1u);
    EXPECT_EQ(model.features[1].geometries.size(), 2u);
}

TEST(ExtrudeFootprints, WhatHasABodyOrNoHeightOrSlopesStays) {
    Diagnostics diagnostics;
    BuildingModel unknown = modelWith(kRing, {4}, {{"measuredHeight", -1.0, "m"}});
    EXPECT_EQ(extrudeFootprints(unknown, &diagnostics), 0u);
    EXPECT_EQ(diagnostics.count(Code::NoHeights), 1u);
    std::vector<Vec3d> slope = kRing;
    slope[0].z = 6;
    BuildingModel roof = modelWith(slope, {4}, {{"measuredHeight", 2.0, "m"}});
    EXPECT_EQ(extrudeFootprints(roof, nullptr), 0u);
    BuildingModel withWalls = modelWith(kRing, {4}, {{"measuredHeight", 2.0, "m"}});
    model::Feature wall;
    wall.id = "w";
    wall.className = "WallSurface";
    wall.geometries = withWalls.features[0].geometries;
    withWalls.addFeature(wall, 0);
    EXPECT_EQ(extrudeFootprints(withWalls, nullptr), 0u) << "its walls tell more";
    BuildingModel twice = modelWith(kRing, {4}, {{"measuredHeight", 2.0, "m"}});
    EXPECT_EQ(extrudeFootprints(twice, nullptr), 1u);
    EXPECT_EQ(extrudeFootprints(twice, nullptr), 0u) << "it has a body now";
}

TEST(ExtrudeFootprints, FilesOfTwoNumbersAPointAreReadWhereItIsWanted) {
    const std::string text =
        R"(<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
 xmlns:gml="http://www.opengis.net/gml"><cityObjectMember><bldg:Building gml:id="b"><bldg:measuredHeight uom="m">9</bldg:measuredHeight>
<bldg:lod0FootPrint><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing>
<gml:posList srsDimension="2">0 0 4 0 4 6 0 6 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
</gml:MultiSurface></bldg:lod0FootPrint></bldg:Building></cityObjectMember></CityModel>)";
    const auto bytes = std::as_bytes(std::span(text));
    EXPECT_EQ(readModel(bytes, "flat.gml", {}, nullptr).error().code(), Code::NoHeights);
    ReadOptions options;
    options.extrudeFootprints = true;
    const auto model = readModel(bytes, "flat.gml", options, nullptr);
    ASSERT_TRUE(model) << model.error().toString();
    EXPECT_NEAR(volumeOf(*model, model->features[0].geometries.at(1).solids.at(0)), 4 * 6 * 9, 1e-9);
}

}  // namespace
}  // namespace svt::readers
