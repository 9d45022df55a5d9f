// Curved walls of facets, with openings, whose figures are known in closed form.
#include <svt/quantities/quantities.hpp>

#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace svt::quantities {
namespace {

constexpr double kOuterRadius = 5, kInnerRadius = 4.7, kStep = 5 * std::numbers::pi / 180;

// A wall of facets of 5 degrees, 3 m high. Openings: facet and row (of 1 m).
struct CurvedWall {
    int facets = 18;
    bool isClosed = false;
    std::set<std::pair<int, int>> openings{};
    std::set<int> widened{};  // corners whose inner point is moved by `splay` radians
    double splay = 0;
    Vec3d at{};
};

class CurvedSolid {
public:
    explicit CurvedSolid(const CurvedWall& wall) : wall_(wall) {
        for (int facet = 0; facet < wall.facets; ++facet) addFacet(facet);
        if (wall.isClosed) return;
        for (int row = 0; row < 3; ++row) {
            addEnd(0, row, false);
            addEnd(wall.facets, row, true);
        }
    }
    std::vector<std::array<Vec3d, 4>> faces;
    // Plan area of the wall without openings: its two polygons.
    [[nodiscard]] double planArea() const {
        double area = 0;
        for (int n = 0; n < wall_.facets; ++n) {
            area += twice(point(n, true, 0), point(n + 1, true, 0)) / 2;
            area -= twice(point(n, false, 0), point(n + 1, false, 0)) / 2;
        }
        if (wall_.isClosed) return area;
        area += twice(point(wall_.facets, true, 0), point(wall_.facets, false, 0)) / 2;
        return area + twice(point(0, false, 0), point(0, true, 0)) / 2;
    }

private:
    [[nodiscard]] bool isOpen(int facet, int row) const {
        if (wall_.isClosed) facet = (facet + wall_.facets) % wall_.facets;
        return facet < 0 || facet >= wall_.facets || row < 0 || row > 2 || wall_.openings.contains({facet, row});
    }
    [[nodiscard]] Vec3d point(int corner, bool isOuter, int z) const {
        if (wall_.isClosed) corner %= wall_.facets;
        double angle = corner * kStep;
        if (!isOuter && wall_.widened.contains(corner)) angle += wall_.splay * (isOpen(corner, 1) ? -1 : 1);
        const double r = isOuter ? kOuterRadius : kInnerRadius;
        return Vec3d{r * std::cos(angle), r * std::sin(angle), double(z)} + wall_.at;
    }
    [[nodiscard]] double twice(Vec3d a, Vec3d b) const {
        a = a - wall_.at;
        b = b - wall_.at;
        return a.x * b.y - a.y * b.x;
    }
    void addEnd(int corner, int row, bool isLast) {
        const Vec3d a = point(corner, true, row), b = point(corner, false, row), c = point(corner, false, row + 1),
                    d = point(corner, true, row + 1);
        faces.push_back(isLast ? std::array{a, b, c, d} : std::array{b, a, d, c});
    }
    void addFacet(int n) {
        for (int row = 0; row < 3; ++row) {
            if (isOpen(n, row)) continue;
            faces.push_back(
                {point(n, true, row), point(n + 1, true, row), point(n + 1, true, row + 1), point(n, true, row + 1)});
            faces.push_back({point(n + 1, false, row), point(n, false, row), point(n, false, row + 1),
                             point(n + 1, false, row + 1)});
            if (isOpen(n, row + 1))
                faces.push_back({point(n, true, row + 1), point(n + 1, true, row + 1), point(n + 1, false, row + 1),
                                 point(n, false, row + 1)});
            if (isOpen(n, row - 1))
                faces.push_back(
                    {point(n, false, row), point(n + 1, false, row), point(n + 1, true, row), point(n, true, row)});
            const bool isFirst = !wall_.isClosed && n == 0, isLast = !wall_.isClosed && n == wall_.facets - 1;
            if (!isFirst && isOpen(n - 1, row)) addEnd(n, row, false);
            if (!isLast && isOpen(n + 1, row)) addEnd(n + 1, row, true);
        }
    }
    const CurvedWall& wall_;
};

ObjectQuantities measured(const CurvedWall& wall) {
    model::BuildingModel model;
    model::Feature feature;
    feature.id = "wall";
    feature.className = "BuildingConstructiveElement";
    model::Geometry geometry;
    geometry.kind = model::GeometryKind::Solid;
    model::Solid solid;
    for (const auto& face : CurvedSolid(wall).faces) {
        model::Polygon polygon;
        polygon.points.assign(face.begin(), face.end());
        polygon.ringEnds.push_back(4);
        solid.exterior.push_back({model.addPolygon(std::move(polygon)), false});
    }
    geometry.solids.push_back(std::move(solid));
    feature.geometries.push_back(std::move(geometry));
    model.addFeature(std::move(feature), model::kNoFeature);
    pipeline::BuildOptions options;
    options.spacing = Vec3d{0.1, 0.1, 0.1};
    options.vectors.meshes = true;
    auto built = pipeline::buildVolume(model, options);
    EXPECT_TRUE(built) << built.error().toString();
    std::vector<std::uint32_t> all(built->volume.labels.labels.size());
    std::iota(all.begin(), all.end(), 0U);
    return measureObjects(built->volume, objectsOf(built->volume, all)).front();
}

const double kMiddle = (kOuterRadius + kInnerRadius) / 2, kThick = kOuterRadius - kInnerRadius;

// A window of three facets, and a door of two.
TEST(CurvedWalls, HaveTheFiguresOfTheUnrolledWall) {
    for (const Vec3d at : {Vec3d{}, Vec3d{458000, 5438000, 110}}) {
        CurvedWall wall;
        wall.openings = {{4, 1}, {5, 1}, {6, 1}, {10, 0}, {10, 1}, {11, 0}, {11, 1}};
        wall.at = at;
        const ObjectQuantities row = measured(wall);
        const double sector = CurvedSolid(wall).planArea() / 18, facet = kMiddle * kStep;
        EXPECT_EQ(row.trust, Trust::Exact);
        EXPECT_NEAR(row.netVolume.value(), sector * (18 * 3 - 7), 1e-3);
        EXPECT_NEAR(row.thickness.value(), kThick, 1e-4);
        EXPECT_NEAR(row.length.value(), 18 * facet, 1e-3);
        EXPECT_NEAR(row.height.value(), 3, 1e-4);
        EXPECT_EQ(row.openings, 2u);
        EXPECT_NEAR(row.openingArea.value(), 7 * facet, 1e-2);
        EXPECT_NEAR(row.sideArea.value(), (18 * 3 - 7) * facet, 1e-2);
        EXPECT_NEAR(row.grossVolume.value(), sector * 18 * 3, 2e-3);
        ASSERT_TRUE(row.grossBound);
        EXPECT_LE(std::abs(*row.grossVolume - sector * 18 * 3), *row.grossBound + 1e-3);
        EXPECT_LT(*row.grossBound, 0.02 * 7 * sector);
        EXPECT_NEAR(row.perimeter.value(), 2 * (18 * facet + 3), 1e-2);
    }
}

// Two windows of a tower, one of them at the angle 0, where the wall is unrolled first.
TEST(CurvedWalls, MayBeClosed) {
    CurvedWall wall;
    wall.facets = 72;
    wall.isClosed = true;
    wall.openings = {{71, 1}, {0, 1}, {35, 1}, {36, 1}};
    const ObjectQuantities row = measured(wall);
    const double sector = CurvedSolid(wall).planArea() / 72;
    EXPECT_EQ(row.openings, 2u);
    EXPECT_NEAR(row.netVolume.value(), sector * (72 * 3 - 4), 1e-3);
    EXPECT_NEAR(row.grossVolume.value(), sector * 72 * 3, 2e-3);
    EXPECT_NEAR(row.length.value(), 72 * kMiddle * kStep, 1e-2);
    EXPECT_NEAR(row.thickness.value(), kThick, 1e-4);
    EXPECT_FALSE(row.perimeter) << "the outline has two parts";
}

// Straight reveals: wider at the inner face than radial ones.
TEST(CurvedWalls, WithStraightRevealsHaveABound) {
    CurvedWall wall;
    wall.openings = {{4, 1}, {5, 1}, {6, 1}};
    wall.widened = {4, 7};
    wall.splay = 1.5 * kStep * (kOuterRadius / kInnerRadius - 1);
    const ObjectQuantities row = measured(wall);
    const double exact = CurvedSolid(wall).planArea() * 3;
    EXPECT_EQ(row.openings, 1u);
    ASSERT_TRUE(row.grossVolume && row.grossBound);
    EXPECT_LE(std::abs(*row.grossVolume - exact), *row.grossBound);
    EXPECT_NEAR(*row.grossVolume, exact, 0.005 * exact);
    EXPECT_LT(*row.grossBound, 0.01 * exact);
}

// A void that is not there has no volume.
TEST(CurvedWalls, WithoutOpeningsAreWhole) {
    CurvedWall wall;
    wall.facets = 72;
    wall.isClosed = true;
    const ObjectQuantities round = measured(wall);
    EXPECT_TRUE(round.thickness);
    EXPECT_EQ(round.openings, 0u);
    EXPECT_EQ(round.grossVolume, round.netVolume);
}

}  // namespace
}  // namespace svt::quantities
