#include <svt/validate/polygons/polygon_checks.hpp>

#include <gtest/gtest.h>

namespace svt::validate {
namespace {

using RingPoints = std::vector<Vec3d>;

model::Polygon polygonOf(const std::vector<RingPoints>& rings) {
    model::Polygon polygon;
    for (const RingPoints& ring : rings) {
        polygon.points.insert(polygon.points.end(), ring.begin(), ring.end());
        polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
    }
    return polygon;
}

CheckedPolygon check(const model::Polygon& polygon, const PolygonTolerances& tolerances = {}) {
    Box3d bounds;
    for (const Vec3d& p : polygon.points) bounds.add(p);
    return checkPolygon(polygon, Lattice(bounds), tolerances);
}

// The one code that is found; Internal for a valid polygon.
Code codeOf(const std::vector<RingPoints>& rings) {
    const CheckedPolygon result = check(polygonOf(rings));
    EXPECT_LE(result.defects.size(), 1u);
    EXPECT_EQ(result.triangles.empty(), !result.defects.empty());
    return result.defects.empty() ? Code::Internal : result.defects.front().code;
}

const RingPoints kSquare{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}, {0, 9, 5}};

// A rectangle as a hole: clockwise seen from above.
RingPoints hole(double x0, double y0, double x1, double y1) {
    return {{x0, y0, 5}, {x0, y1, 5}, {x1, y1, 5}, {x1, y0, 5}};
}

TEST(CheckPolygon, ASquareWithHolesThatTouchOnceIsValid) {
    EXPECT_EQ(codeOf({kSquare}), Code::Internal);
    EXPECT_EQ(codeOf({kSquare, hole(1, 1, 3, 3), hole(3, 3, 5, 5)}), Code::Internal);
    // A corner of the hole on the exterior ring.
    EXPECT_EQ(codeOf({kSquare, {{0, 4, 5}, {3, 6, 5}, {3, 2, 5}}}), Code::Internal);
}

TEST(CheckPolygon, FindsTooFewAndRepeatedPoints) {
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {0, 0, 5}}}), Code::TooFewPoints);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 0.0005, 5}, {9, 9, 5}, {0, 9, 5}}}), Code::RepeatedPoint);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 0.002, 5}, {9, 9, 5}, {0, 9, 5}}}), Code::Internal);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}, {0, 9, 5}, {0, 0.0005, 5}}}), Code::Internal) << "only closes";
}

TEST(CheckPolygon, FindsRingsThatCrossTouchOrRunBackOnThemselves) {
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 9, 5}, {9, 0, 5}, {0, 9, 5}}}), Code::SelfTouchingRing);
    // A corner on an own edge, by nothing but its place.
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}, {4, 0, 5}, {0, 9, 5}}}), Code::SelfTouchingRing);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}, {9, 4, 5}, {0, 4, 5}}}), Code::SelfTouchingRing);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {4, 0, 5}, {9, 0, 5}}}), Code::ZeroArea);
}

TEST(CheckPolygon, FindsWhatIsNotFlat) {
    const CheckedPolygon result = check(polygonOf({{{0, 0, 5}, {9, 0, 5}, {9, 9, 5.1}, {0, 9, 5}}}));
    ASSERT_EQ(result.defects.size(), 1u);
    EXPECT_EQ(result.defects[0].code, Code::NonPlanar);
    EXPECT_NEAR(result.defects[0].value.value_or(0), 0.025, 0.001);
    EXPECT_EQ(codeOf({{{0, 0, 5}, {9, 0, 5}, {9, 9, 5.02}, {0, 9, 5}}}), Code::Internal);
}

TEST(CheckPolygon, FindsASmallFold) {
    // 6 mm down within 4 mm.
    EXPECT_EQ(codeOf({{{0, 0, 5},
                       {9, 0, 5},
                       {9, 4.498, 5.003},
                       {9, 4.502, 4.997},
                       {9, 9, 5},
                       {0, 9, 5},
                       {0, 4.502, 4.997},
                       {0, 4.498, 5.003}}}),
              Code::NormalsDeviate);
}

TEST(CheckPolygon, FindsHolesThatCrossRepeatOrTurnTheWrongWay) {
    EXPECT_EQ(codeOf({kSquare, hole(6, 2, 12, 6)}), Code::RingsIntersect);
    EXPECT_EQ(codeOf({kSquare, hole(4, 2, 9, 6)}), Code::RingsIntersect);  // along an edge
    EXPECT_EQ(codeOf({kSquare, hole(2, 2, 6, 6), hole(2, 2, 6, 6)}), Code::DuplicateRing);
    EXPECT_EQ(codeOf({kSquare, {{2, 2, 5}, {6, 2, 5}, {6, 6, 5}, {2, 6, 5}}}), Code::InnerRingTurnsAlike);
}

TEST(CheckPolygon, FindsHolesOutsideWithinOthersAndThoseThatSplit) {
    EXPECT_EQ(codeOf({kSquare, hole(12, 2, 16, 6)}), Code::InnerRingOutside);
    EXPECT_EQ(codeOf({kSquare, {{9, 4, 5}, {12, 6, 5}, {12, 2, 5}}}), Code::InnerRingOutside);
    EXPECT_EQ(codeOf({kSquare, hole(1, 1, 8, 8), hole(3, 3, 6, 6)}), Code::InnerRingsNested);
    EXPECT_EQ(codeOf({kSquare, {{0, 4, 5}, {4, 9, 5}, {9, 4, 5}, {4, 0, 5}}}), Code::PolygonSplit);
}

TEST(CheckPolygon, TrianglesCoverThePolygonAndTurnAsItDoes) {
    for (const bool isDownwards : {false, true}) {
        std::vector<RingPoints> rings{kSquare, hole(1, 1, 3, 3), hole(3, 3, 5, 5), {{0, 6, 5}, {2, 7, 5}, {2, 6, 5}}};
        // A point in the middle of an edge stays a corner.
        rings[0].insert(rings[0].begin() + 1, Vec3d{4, 0, 5});
        if (isDownwards)
            for (RingPoints& ring : rings) std::reverse(ring.begin(), ring.end());
        const model::Polygon polygon = polygonOf(rings);
        const CheckedPolygon result = check(polygon);
        ASSERT_TRUE(result.defects.empty());
        double area = 0;
        for (const Corners& t : result.triangles) {
            const Vec3d a = polygon.points[t[0]];
            const double z = cross(polygon.points[t[1]] - a, polygon.points[t[2]] - a).z;
            EXPECT_GT(isDownwards ? -z : z, 0);
            area += std::abs(z) / 2;
        }
        EXPECT_NEAR(area, 81 - 4 - 4 - 1, 1e-9);
    }
}

TEST(CheckPolygon, LargeCoordinatesDecideAsSmallOnesDo) {
    std::vector<RingPoints> rings{kSquare, {{0, 4, 5}, {3, 6, 5}, {3, 2, 5}}};
    for (RingPoints& ring : rings)
        for (Vec3d& p : ring) p = p + Vec3d{4.5e6, 5.9e6, 1000};
    EXPECT_EQ(codeOf(rings), Code::Internal);
    rings[1][0].x -= 1e-5;  // ten micrometres over the edge
    EXPECT_EQ(codeOf(rings), Code::RingsIntersect);
}

}  // namespace
}  // namespace svt::validate
