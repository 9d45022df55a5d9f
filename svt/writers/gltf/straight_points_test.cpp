#include <svt/writers/gltf/straight_points.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

// Surfaces of label 0, 1, ... by their points and triangles.
SheetSurfaces sheetsOf(const std::vector<std::pair<Positions, std::vector<std::array<std::uint32_t, 3>>>>& surfaces) {
    SheetSurfaces sheets;
    for (const auto& [points, triangles] : surfaces) {
        LabelSurface& surface = sheets.surfaces.emplace_back();
        surface.label = static_cast<std::uint32_t>(sheets.surfaces.size() - 1);
        surface.vertices.resize(points.size());
        for (const auto& triangle : triangles) surface.triangles.push_back(triangle);
        sheets.positions.push_back(points);
    }
    return sheets;
}

double areaOf(const SheetSurfaces& sheets, std::size_t s) {
    double area = 0;
    for (const auto& triangle : sheets.surfaces[s].triangles) {
        const auto at = [&](std::size_t c) { return toDouble(sheets.positions[s][triangle[c]]); };
        area += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
    return area;
}

// A roof of 4 x 3 m with a point in its south edge and another in its north edge. The wall below has the south point.
const Positions kRoof{{0, 0, 3}, {1, 0, 3}, {4, 0, 3}, {4, 3, 3}, {2, 3, 3}, {0, 3, 3}};
const std::vector<std::array<std::uint32_t, 3>> kRoofTriangles{{0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}};

TEST(StraightPoints, GoWhereAllFacesCanSpareThem) {
    const Positions wall{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {1, 0, 3}, {0, 0, 3}};
    SheetSurfaces sheets = sheetsOf({{kRoof, kRoofTriangles}, {wall, {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}}}});
    dropStraightPoints(sheets);
    EXPECT_EQ(sheets.surfaces[0].triangles.size(), 2u);
    EXPECT_EQ(sheets.surfaces[1].triangles.size(), 2u);
    EXPECT_NEAR(areaOf(sheets, 0), 12, 1e-9);
    EXPECT_NEAR(areaOf(sheets, 1), 12, 1e-9);
}

// The walls below the south edge meet in its point: a corner of both.
TEST(StraightPoints, StayWhereOneFaceHasACorner) {
    const Positions left{{0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {0, 0, 3}}, right{{1, 0, 0}, {4, 0, 0}, {4, 0, 3}, {1, 0, 3}};
    SheetSurfaces sheets =
        sheetsOf({{kRoof, kRoofTriangles}, {left, {{0, 1, 2}, {0, 2, 3}}}, {right, {{0, 1, 2}, {0, 2, 3}}}});
    dropStraightPoints(sheets);
    EXPECT_EQ(sheets.surfaces[0].triangles.size(), 3u) << "only the north point goes";
    EXPECT_EQ(sheets.surfaces[1].triangles.size() + sheets.surfaces[2].triangles.size(), 4u);
    EXPECT_NEAR(areaOf(sheets, 0), 12, 1e-9);
}

TEST(StraightPoints, StayInBentBordersAndFaces) {
    Positions bent = kRoof;
    bent[1].y = -0.002f;  // 2 mm beside the line of its neighbours
    SheetSurfaces sheets = sheetsOf({{bent, kRoofTriangles}});
    dropStraightPoints(sheets);
    EXPECT_EQ(sheets.surfaces[0].triangles.size(), 3u);
    // Two slopes meet in the middle of a straight border seen from above, which bends in height.
    const Positions ridge{{0, 0, 0}, {2, 0, 1}, {4, 0, 0}, {4, 3, 0}, {2, 3, 1}, {0, 3, 0}};
    sheets = sheetsOf({{ridge, {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}}}});
    dropStraightPoints(sheets);
    EXPECT_EQ(sheets.surfaces[0].triangles.size(), 4u);
}

// A triangle without area, which fills a gap between points of an edge, must not grow.
TEST(StraightPoints, TrianglesWithoutAreaDoNotGrow) {
    const Positions wall{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {3, 0, 3}, {1, 0, 3}, {0, 0, 3}, {2, 0, 0}};
    SheetSurfaces sheets = sheetsOf({{wall, {{0, 6, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {0, 4, 5}}}});
    dropStraightPoints(sheets);
    EXPECT_NEAR(areaOf(sheets, 0), 12, 1e-9);
    EXPECT_EQ(sheets.surfaces[0].triangles.size(), 2u);
}

}  // namespace
}  // namespace svt::writers
