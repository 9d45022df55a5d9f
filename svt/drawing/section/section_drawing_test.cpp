#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>
#include <polyclipping/clipper.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

namespace svt::drawing {
namespace {

using volume::kNoLabel;
using volume::Scalar;

/// The scalar at a point, metres from the grid's lower corner along the grid's axes.
using Solid = std::function<Scalar(Vec3d)>;

struct Scene {
    Vec3i dimension{101, 89, 73};
    Vec3d spacing{0.05, 0.06, 0.04};
    bool isTurned = false;
    Vec3d origin{458877.03, 5438353.7, 111.5};
};

/// Labels 0, 1, ... own the scalars 1, 2, ...; their classes are `classes`.
volume::SemanticVolume volumeOf(const Scene& scene, const std::vector<std::string>& classes, const Solid& solid) {
    const std::array<Vec3d, 3> turned{Vec3d{0.6, 0.8, 0}, Vec3d{-0.8, 0.6, 0}, Vec3d{0, 0, 1}};
    volume::SemanticVolume volume = volume::test::emptyVolume(scene.dimension, scene.spacing, scene.origin,
                                                              scene.isTurned ? turned : volume::test::kWorldAxes);
    for (std::size_t l = 0; l < classes.size(); ++l)
        volume::test::addObject(volume, "id-" + std::to_string(l), classes[l]);
    volume::test::paint(volume, [&](int i, int j, int k) {
        return solid(scaled(Vec3d{double(i), double(j), double(k)}, scene.spacing));
    });
    return volume;
}

/// A plane through `point`, metres from the lower corner along the grid's axes; so is the normal.
SectionPlane planeAt(const volume::SemanticVolume& volume, Vec3d normal, Vec3d point) {
    const auto& axes = volume.grid.axes();
    const auto turned = [&](Vec3d v) { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; };
    return {normalized(turned(normal)), volume.grid.origin() + turned(point)};
}

SectionDrawing draw(const volume::SemanticVolume& volume, const SectionPlane& plane,
                    const SectionOptions& options = {}) {
    auto drawing = drawSection(volume, plane, options);
    EXPECT_TRUE(drawing) << drawing.error().toString();
    return drawing ? *drawing : SectionDrawing{};
}

double signedArea(const Ring& ring) {
    double area = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        area += 0.5 * (a.u * b.v - a.v * b.u);
    }
    return area;
}

bool isInside(const Ring& ring, PlanePoint p) {
    bool inside = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
    }
    return inside;
}

/// Labels drawn at a point.
std::vector<std::uint32_t> labelsAt(const SectionDrawing& drawing, PlanePoint p) {
    std::vector<std::uint32_t> found;
    for (const SectionComponent& component : drawing.components)
        for (const SectionPolygon& polygon : component.polygons) {
            bool inside = isInside(polygon.outer, p);
            for (const Ring& hole : polygon.holes) inside = inside && !isInside(hole, p);
            if (inside) found.push_back(component.label);
        }
    return found;
}

/// Checks the orientation of all rings and the sums of all areas. Each edge of a ring
/// belongs to at most one neighbour, in the opposite direction.
/// \param walls  labels that join without a border, see joinWalls()
void expectSound(const SectionDrawing& drawing, const std::set<std::uint32_t>& walls = {}) {
    const PlaneAxes& axes = drawing.axes;
    EXPECT_NEAR(dot(cross(axes.u, axes.v), axes.normal), 1, 1e-12);
    EXPECT_NEAR(std::abs(dot(axes.normal, drawing.plane.normal)), 1, 1e-12);
    std::map<std::tuple<double, double, double, double>, int> edges;
    std::map<std::tuple<double, double, double, double>, std::uint32_t> labels;
    double total = 0;
    for (const SectionComponent& component : drawing.components) {
        double area = 0;
        for (const SectionPolygon& polygon : component.polygons) {
            double own = signedArea(polygon.outer);
            EXPECT_GT(own, 0);
            for (const Ring& hole : polygon.holes) {
                EXPECT_LT(signedArea(hole), 0);
                own += signedArea(hole);
            }
            EXPECT_NEAR(own, polygon.area, 1e-6);
            area += polygon.area;
            const auto add = [&](const Ring& ring) {
                for (std::size_t n = 0; n < ring.size(); ++n) {
                    const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
                    ++edges[{a.u, a.v, b.u, b.v}];
                    labels[{a.u, a.v, b.u, b.v}] = component.label;
                }
            };
            add(polygon.outer);
            for (const Ring& hole : polygon.holes) add(hole);
        }
        EXPECT_NEAR(area, component.area, 1e-9);
        total += area;
    }
    EXPECT_NEAR(total, drawing.area, 1e-9);
    // The edges without a neighbour enclose everything that is drawn.
    double enclosed = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        const auto [au, av, bu, bv] = edge;
        if (!edges.contains({bu, bv, au, av})) enclosed += 0.5 * (au * bv - av * bu);
    }
    EXPECT_NEAR(enclosed, total, 1e-6 * std::max(1.0, total));
    // Borders are the same edges, without those between two walls.
    std::size_t lines = 0, joints = 0;
    for (const auto& [edge, label] : labels) {
        const auto [au, av, bu, bv] = edge;
        const auto other = labels.find({bu, bv, au, av});
        joints += other != labels.end() && walls.contains(label) && walls.contains(other->second) ? 1 : 0;
    }
    for (const SectionBorder& border : drawing.borders)
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
            const PlanePoint a = border.points[n], b = border.points[n + 1];
            EXPECT_TRUE(border.left == kNoLabel || edges.contains({a.u, a.v, b.u, b.v}));
            EXPECT_TRUE(border.right == kNoLabel || edges.contains({b.u, b.v, a.u, a.v}));
            EXPECT_FALSE(walls.contains(border.left) && walls.contains(border.right));
            lines += (border.left != kNoLabel ? 1 : 0) + (border.right != kNoLabel ? 1 : 0);
        }
    EXPECT_EQ(lines + joints, edges.size());
}

/// Area of the box [low, high] on a plane: the plane's rectangle clipped by its six sides.
double boxSectionArea(Vec3d low, Vec3d high, Vec3d normal, Vec3d point) {
    normal = normalized(normal);
    const Vec3d side = normalized(cross(normal, std::abs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    const Vec3d other = cross(normal, side);
    std::vector<Vec3d> polygon{point + side * 99 + other * 99, point - side * 99 + other * 99,
                               point - side * 99 - other * 99, point + side * 99 - other * 99};
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const double sign = (face & 1) != 0 ? 1 : -1, limit = (face & 1) != 0 ? high[axis] : -low[axis];
        std::vector<Vec3d> rest;
        for (std::size_t n = 0; n < polygon.size(); ++n) {
            const Vec3d a = polygon[n], b = polygon[(n + 1) % polygon.size()];
            const double da = limit - sign * a[axis], db = limit - sign * b[axis];
            if (da >= 0) rest.push_back(a);
            if ((da >= 0) != (db >= 0)) rest.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon = rest;
    }
    Vec3d area;
    for (std::size_t n = 1; n + 1 < polygon.size(); ++n)
        area = area + cross(polygon[n] - polygon[0], polygon[n + 1] - polygon[0]) * 0.5;
    return std::abs(dot(area, normal));
}

Scalar boxAt(Vec3d p) { return p.x > 1 && p.x < 4 && p.y > 0.7 && p.y < 4.1 && p.z > 0.5 && p.z < 2.3 ? 1 : 0; }

TEST(SectionDrawing, BoxIsARectangleOnTheFacesOfItsVoxels) {
    for (const bool isTurned : {false, true}) {
        Scene scene;
        scene.isTurned = isTurned;
        const auto volume = volumeOf(scene, {"WallSurface"}, boxAt);
        const auto drawing = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 1.2}));
        expectSound(drawing);
        ASSERT_EQ(drawing.components.size(), 1u);
        ASSERT_EQ(drawing.components[0].polygons.size(), 1u);
        const SectionPolygon& polygon = drawing.components[0].polygons[0];
        ASSERT_EQ(polygon.outer.size(), 4u);
        EXPECT_TRUE(polygon.holes.empty());
        // Samples 21 to 79 along x, 12 to 68 along y.
        const PlanePoint expected[] = {{20.5 * 0.05, 11.5 * 0.06},
                                       {79.5 * 0.05, 11.5 * 0.06},
                                       {79.5 * 0.05, 68.5 * 0.06},
                                       {20.5 * 0.05, 68.5 * 0.06}};
        for (std::size_t n = 0; n < 4; ++n) {
            EXPECT_NEAR(polygon.outer[n].u, expected[n].u, 1e-7) << n;
            EXPECT_NEAR(polygon.outer[n].v, expected[n].v, 1e-7) << n;
        }
        EXPECT_NEAR(drawing.area, 59 * 0.05 * 57 * 0.06, 1e-6);
        EXPECT_LE(std::abs(drawing.area - 3.0 * 3.4), drawing.components[0].areaBound);
        ASSERT_EQ(drawing.classes.size(), 1u);
        EXPECT_EQ(drawing.classes[0].className, "WallSurface");
        EXPECT_EQ(drawing.classes[0].components, 1u);
    }
}

// Two frames of one object, side by side. A ray from the hole of one passes through the other, whichever is first.
TEST(SectionDrawing, AHoleBelongsToTheFrameAroundIt) {
    for (const bool isLeftLower : {false, true})
        for (const bool isWide : {false, true}) {
            Scene scene;
            scene.dimension = {40, 24, 5};
            scene.spacing = {1, 1, 1};
            const double left = isLeftLower ? 2 : 5, right = isLeftLower ? 5 : 2, far = isWide ? 36 : 26;
            const auto volume = volumeOf(scene, {"WallSurface"}, [&](Vec3d p) -> Scalar {
                const auto isIn = [&](double west, double south, double east, double north) {
                    return p.x >= west && p.x < east && p.y >= south && p.y < north;
                };
                const bool isFrame = isIn(2, left, 12, left + 12) || isIn(16, right, far, right + 12);
                return isFrame && !isIn(5, 8, 9, 12) && !isIn(19, 8, 23, 12) ? 1 : 0;
            });
            const SectionDrawing drawing = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 2}));
            expectSound(drawing);
            ASSERT_EQ(drawing.components.size(), 1u);
            ASSERT_EQ(drawing.components[0].polygons.size(), 2u);
            for (const SectionPolygon& polygon : drawing.components[0].polygons) {
                ASSERT_EQ(polygon.holes.size(), 1u);
                EXPECT_TRUE(isInside(polygon.outer, polygon.holes[0][0]));
            }
        }
}

TEST(SectionDrawing, ObliquePlaneThroughABoxIsItsPolygon) {
    const auto volume = volumeOf({}, {"WallSurface"}, boxAt);
    const Vec3d voxelLow{20.5 * 0.05, 11.5 * 0.06, 12.5 * 0.04}, voxelHigh{79.5 * 0.05, 68.5 * 0.06, 57.5 * 0.04};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    int cut = 0;
    for (int n = 0; n < 60; ++n) {
        const Vec3d normal{any(random), any(random), any(random)};
        const Vec3d point{2.5 + any(random), 2.4 + any(random), 1.4 + 0.6 * any(random)};
        const auto drawing = draw(volume, planeAt(volume, normal, point));
        expectSound(drawing);
        // The voxels' box is a box: its section is exact.
        EXPECT_NEAR(drawing.area, boxSectionArea(voxelLow, voxelHigh, normal, point), 2e-3) << n;
        ASSERT_EQ(drawing.components.size(), 1u) << n;
        ASSERT_EQ(drawing.components[0].polygons.size(), 1u) << n;
        EXPECT_LE(drawing.components[0].polygons[0].outer.size(), 6u) << n;
        ++cut;
    }
    EXPECT_EQ(cut, 60);
}

TEST(SectionDrawing, TurnedPrismFollowsPlanesNotSteps) {
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    const auto prism = [&](Vec3d p) -> Scalar {
        const double x = c * (p.x - 2.5) + s * (p.y - 2.6), y = -s * (p.x - 2.5) + c * (p.y - 2.6);
        return std::abs(x) < 1.4 && std::abs(y) < 0.9 && p.z > 0.3 && p.z < 2.5 ? 1 : 0;
    };
    const auto volume = volumeOf({}, {"WallSurface"}, prism);
    const auto drawing = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 1.3}));
    expectSound(drawing);
    ASSERT_EQ(drawing.components.size(), 1u);
    const double exact = 2.8 * 1.8;
    EXPECT_LE(std::abs(drawing.area - exact), drawing.components[0].areaBound);
    // Planes code most of the prism: a tenth of the error of steps, and nearly the length of straight lines; steps would be a
    // third longer.
    EXPECT_LE(std::abs(drawing.area - exact), 0.1 * drawing.components[0].areaBound);
    double length = 0;
    EXPECT_LE(drawing.components[0].polygons.size(), 3u);
    const Ring& ring = std::ranges::max_element(drawing.components[0].polygons, {}, &SectionPolygon::area)->outer;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        length += std::hypot(b.u - a.u, b.v - a.v);
    }
    EXPECT_NEAR(length, 2 * (2.8 + 1.8), 0.08 * 2 * (2.8 + 1.8));
}

TEST(SectionDrawing, SphereWithinTheBound) {
    const Vec3d center{2.5, 2.6, 1.45};
    const double radius = 1.2;
    const auto volume = volumeOf({}, {"WallSurface"}, [&](Vec3d p) -> Scalar { return length(p - center) < radius; });
    for (const Vec3d normal : {Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{1, 0, 0}, Vec3d{1, 1, 0}, Vec3d{0.3, -0.5, 0.8}})
        for (const double height : {0.0, 0.37, -0.8}) {
            const auto drawing = draw(volume, planeAt(volume, normal, center + normalized(normal) * height));
            expectSound(drawing);
            ASSERT_EQ(drawing.components.size(), 1u);
            const double circle = std::sqrt(radius * radius - height * height);
            const double sine = circle / radius;  // of the angle between surface and plane
            EXPECT_LE(std::abs(drawing.area - std::numbers::pi * circle * circle),
                      drawing.components[0].areaBound / sine);
        }
}

/// Walls of 0.3 m around two rooms, a slab, and a gable roof of 0.25 m; the rest is air.
Scalar houseAt(Vec3d p) {
    if (p.z < 0.2) return p.x > 0.2 && p.x < 4.8 && p.y > 0.3 && p.y < 4.9 ? 1 : 0;
    const double roof = 2.6 - 0.6 * std::abs(p.y - 2.6);
    if (p.z < roof && p.z > roof - 0.25) return 2;
    if (p.z >= roof) return 0;
    if (p.x < 0.3 || p.x > 4.7 || p.y < 0.4 || p.y > 4.8) return 0;
    if (p.x < 0.6 || p.x > 4.4 || p.y < 0.7 || p.y > 4.5) return 3;
    if (std::abs(p.x - 2.2) < 0.1) return 4;
    return p.x < 2.2 ? 5 : 6;
}
const std::vector<std::string> kHouseClasses{"GroundSurface",       "RoofSurface",  "WallSurface",
                                             "InteriorWallSurface", "BuildingRoom", "BuildingRoom"};
const std::set<std::uint32_t> kHouseWalls{2, 3};  // labels

TEST(SectionDrawing, HouseHasItsAreasAndSharedBorders) {
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    const auto plan = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 0.6}));
    expectSound(plan, kHouseWalls);
    ASSERT_EQ(plan.components.size(), 4u);
    const double expected[] = {4.4 * 4.4 - 3.8 * 3.8, 0.2 * 3.8, 1.5 * 3.8, 2.1 * 3.8};
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_EQ(plan.components[n].label, n + 2);
        EXPECT_LE(std::abs(plan.components[n].area - expected[n]), plan.components[n].areaBound) << n;
    }
    EXPECT_EQ(plan.components[0].polygons.at(0).holes.size(), 1u);
    ASSERT_EQ(plan.classes.size(), 3u);
    EXPECT_EQ(plan.classes[0].className, "BuildingRoom");
    EXPECT_EQ(plan.classes[0].components, 2u);

    const auto section = draw(volume, planeAt(volume, {1, 0, 0}, {3.3, 0, 0}));
    expectSound(section, kHouseWalls);
    // The roof's band: 0.25 m high over the length where it is above the slab, all of the grid here.
    const auto roof = std::ranges::find(section.components, 1u, &SectionComponent::label);
    ASSERT_NE(roof, section.components.end());
    EXPECT_LE(std::abs(roof->area - 0.25 * 5.34), roof->areaBound);
    for (const Vec3d normal : {Vec3d{0.2, 1, 0.5}, Vec3d{1, 0.3, -0.4}, Vec3d{0.1, 0.05, 1}})
        expectSound(draw(volume, planeAt(volume, normal, {2.5, 2.2, 1.2})), kHouseWalls);
}

TEST(SectionDrawing, EveryPointShowsItsVoxel) {
    // Second implementation: by voxels only, each point of the plane lies in one voxel, and its label is drawn there.
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    const auto bricks = *volume::BrickVolume::fromColumns(volume.columns, {.faces = volume::BrickFaces::Voxels});
    SectionOptions options;
    options.tolerance = 0;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    int checked = 0;
    for (const Vec3d normal : {Vec3d{0, 0, 1}, Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0.6, 0.8, 0},
                               Vec3d{0.3, 0.2, -0.9}, Vec3d{-0.5, 0.7, 0.4}}) {
        const auto drawing = drawSection(volume, bricks, planeAt(volume, normal, {2.4, 2.5, 1.31}), options);
        ASSERT_TRUE(drawing);
        expectSound(*drawing, kHouseWalls);
        for (int n = 0; n < 1500; ++n) {
            const PlanePoint p{3 * any(random) + drawing->axes.planeFromWorld(drawing->plane.point).u,
                               3 * any(random) + drawing->axes.planeFromWorld(drawing->plane.point).v};
            const Vec3d index = volume.grid.indexFromWorld(drawing->axes.worldFromPlane(p));
            const Vec3d low{index.x + 0.5, index.y + 0.5, index.z + 0.5};
            bool isClear = true;
            for (int axis = 0; axis < 3; ++axis) {
                isClear = isClear && low[axis] >= 0 && low[axis] < volume.grid.dimension()[axis];
                if (std::abs(normal[axis]) < 0.99)
                    isClear = isClear && std::abs(low[axis] - std::round(low[axis])) > 1e-4;
            }
            if (!isClear) continue;
            const Scalar scalar =
                volume.columns.scalarAt(std::int32_t(low.x), std::int32_t(low.y), std::int32_t(low.z));
            const auto found = labelsAt(*drawing, p);
            ASSERT_EQ(found.size(), scalar == 0 ? 0u : 1u);
            if (scalar != 0) {
                ASSERT_EQ(found[0], scalar - 1);
            }
            ++checked;
        }
    }
    EXPECT_GT(checked, 5000);
}

TEST(SectionDrawing, PlanesOfBricksStayWithinAVoxelOfTheirVoxels) {
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    std::mt19937 random(13);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const Vec3d normal : {Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{-0.5, 0.7, 0.4}}) {
        const auto drawing = draw(volume, planeAt(volume, normal, {2.4, 2.5, 1.31}));
        const PlanePoint middle = drawing.axes.planeFromWorld(drawing.plane.point);
        int checked = 0;
        for (int n = 0; n < 1500; ++n) {
            const PlanePoint p{3 * any(random) + middle.u, 3 * any(random) + middle.v};
            const Vec3d index = volume.grid.indexFromWorld(drawing.axes.worldFromPlane(p));
            const Vec3i at{std::int32_t(std::lround(index.x)), std::int32_t(std::lround(index.y)),
                           std::int32_t(std::lround(index.z))};
            bool isClear = true;
            Scalar scalar = 0;
            for (int neighbor = 0; neighbor < 27 && isClear; ++neighbor) {
                const Vec3i v = at + Vec3i{neighbor % 3 - 1, neighbor / 3 % 3 - 1, neighbor / 9 - 1};
                for (int axis = 0; axis < 3; ++axis)
                    isClear = isClear && v[axis] >= 0 && v[axis] < volume.grid.dimension()[axis];
                if (!isClear) break;
                const Scalar there = volume.columns.scalarAt(v.x, v.y, v.z);
                isClear = neighbor == 0 || there == scalar;
                scalar = there;
            }
            if (!isClear) continue;
            const auto found = labelsAt(drawing, p);
            ASSERT_EQ(found.size(), scalar == 0 ? 0u : 1u);
            if (scalar != 0) {
                ASSERT_EQ(found[0], scalar - 1);
            }
            ++checked;
        }
        EXPECT_GT(checked, 500);
    }
}

ClipperLib::Path pathOf(const std::vector<PlanePoint>& points) {
    ClipperLib::Path path;
    for (const PlanePoint p : points) path << ClipperLib::IntPoint(std::llround(p.u * 1e7), std::llround(p.v * 1e7));
    return path;
}

/// Area of a Clipper operation, m2.
double clippedArea(ClipperLib::ClipType type, const ClipperLib::Paths& a, const ClipperLib::Paths& b) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(a, ClipperLib::ptSubject, true);
    clipper.AddPaths(b, ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    EXPECT_TRUE(clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero));
    double area = 0;
    for (const auto& path : result) area += ClipperLib::Area(path) * 1e-14;
    return area;
}

TEST(SectionDrawing, IsTheUnionOfItsVoxelsByClipper) {
    // Second implementation: the faces of one layer of voxels joined by Clipper, label by label.
    Scene scene;
    scene.dimension = {61, 53, 31};
    std::mt19937 random(5);
    std::uniform_int_distribution<int> any(0, 9);
    const auto volume = volumeOf(scene, {"A", "B"}, [&](Vec3d p) -> Scalar {
        const int noise = any(random);
        if (noise == 0) return 0;
        return std::hypot(p.x - 1.5, p.y - 1.5) < 1.1 ? 1 : noise < 3 ? 1 : 2;
    });
    const auto bricks = *volume::BrickVolume::fromColumns(volume.columns, {.faces = volume::BrickFaces::Voxels});
    const Vec3d spacing = scene.spacing;
    const int layer = 12;
    const auto drawing = drawSection(volume, bricks, planeAt(volume, {0, 0, 1}, {0, 0, layer * spacing.z + 0.013}));
    ASSERT_TRUE(drawing);
    expectSound(*drawing);
    ASSERT_EQ(drawing->components.size(), 2u);
    std::array<ClipperLib::Paths, 2> drawn, voxels;
    std::size_t holes = 0;
    for (std::size_t label = 0; label < 2; ++label) {
        for (const SectionPolygon& polygon : drawing->components[label].polygons) {
            drawn[label] << pathOf(polygon.outer);
            for (const Ring& hole : polygon.holes) drawn[label] << pathOf(hole);
            holes += polygon.holes.size();
        }
        for (int j = 0; j < scene.dimension.y; ++j)
            for (int i = 0; i < scene.dimension.x; ++i)
                if (volume.columns.scalarAt(i, j, layer) == label + 1)
                    voxels[label] << pathOf({{(i - 0.5) * spacing.x, (j - 0.5) * spacing.y},
                                             {(i + 0.5) * spacing.x, (j - 0.5) * spacing.y},
                                             {(i + 0.5) * spacing.x, (j + 0.5) * spacing.y},
                                             {(i - 0.5) * spacing.x, (j + 0.5) * spacing.y}});
        EXPECT_LT(clippedArea(ClipperLib::ctXor, drawn[label], voxels[label]), 1e-4);
        EXPECT_NEAR(clippedArea(ClipperLib::ctUnion, voxels[label], {}), drawing->components[label].area, 1e-5);
    }
    EXPECT_GT(holes, 100u);
    EXPECT_LT(clippedArea(ClipperLib::ctIntersection, drawn[0], drawn[1]), 1e-6);
}

TEST(SectionDrawing, ComponentsOfAnObliqueCutDoNotOverlapByClipper) {
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    const auto drawing = draw(volume, planeAt(volume, {-0.5, 0.7, 0.4}, {2.4, 2.5, 1.31}));
    std::vector<ClipperLib::Paths> drawn;
    ClipperLib::Paths all;
    for (const SectionComponent& component : drawing.components) {
        drawn.emplace_back();
        for (const SectionPolygon& polygon : component.polygons) {
            drawn.back() << pathOf(polygon.outer);
            for (const Ring& hole : polygon.holes) drawn.back() << pathOf(hole);
        }
        all.insert(all.end(), drawn.back().begin(), drawn.back().end());
    }
    ASSERT_GT(drawn.size(), 3u);
    for (std::size_t a = 0; a < drawn.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_LT(clippedArea(ClipperLib::ctIntersection, drawn[a], drawn[b]), 2e-5);
    EXPECT_NEAR(clippedArea(ClipperLib::ctUnion, all, {}), drawing.area, 2e-5);
}

TEST(SectionDrawing, PlanesThroughCornersOfVoxelsArePartitionsToo) {
    Scene scene;
    scene.dimension = {27, 25, 19};
    scene.spacing = {0.125, 0.125, 0.125};
    scene.origin = {1000, 2000, 30};
    std::mt19937 random(17);
    std::uniform_int_distribution<int> any(1, 3);
    const auto noise = volumeOf(scene, {"A", "B", "C"}, [&](Vec3d) { return static_cast<Scalar>(any(random)); });
    const auto full = volumeOf(scene, {"A"}, [](Vec3d) { return Scalar{1}; });
    const Vec3d low{-0.0625, -0.0625, -0.0625}, high{26.5 * 0.125, 24.5 * 0.125, 18.5 * 0.125};
    for (const Vec3d normal :
         {Vec3d{0, 0, 1}, Vec3d{1, 1, 0}, Vec3d{1, 1, 1}, Vec3d{1, 2, 3}, Vec3d{-1, 1, 1}, Vec3d{0, 1, -1}}) {
        // A corner of voxels, and of bricks: the middle of sample 8 less half a voxel.
        const Vec3d corner{7.5 * 0.125, 7.5 * 0.125, 7.5 * 0.125};
        const auto drawing = draw(noise, planeAt(noise, normal, corner));
        expectSound(drawing);
        EXPECT_NEAR(drawing.area, boxSectionArea(low, high, normal, corner), 1e-5);
        EXPECT_NEAR(draw(full, planeAt(full, normal, corner)).area, drawing.area, 1e-5);
    }
}

TEST(SectionDrawing, NoiseIsStillAPartition) {
    // Labels that touch at points everywhere: no area is lost or drawn twice.
    Scene scene;
    scene.dimension = {37, 29, 23};
    std::mt19937 random(3);
    std::uniform_int_distribution<int> any(0, 3);
    std::uniform_real_distribution<double> real(-1, 1);
    const auto volume = volumeOf(scene, {"A", "B", "C"}, [&](Vec3d) { return static_cast<Scalar>(any(random)); });
    const auto full = volumeOf(scene, {"A"}, [](Vec3d) { return Scalar{1}; });
    for (int n = 0; n < 12; ++n) {
        const Vec3d normal = n < 3 ? Vec3d{double(n == 0), double(n == 1), double(n == 2)}
                                   : Vec3d{real(random), real(random), n < 6 ? 0 : real(random)};
        const Vec3d point{0.9 + 0.3 * real(random), 0.8 + 0.3 * real(random), 0.43};
        const auto drawing = draw(volume, planeAt(volume, normal, point));
        expectSound(drawing);
        const auto all = draw(full, planeAt(full, normal, point));
        // Where the label 0 is, nothing is: it is counted by drawing the noise with another label for it.
        EXPECT_LT(drawing.area, all.area);
        EXPECT_NEAR(all.area,
                    boxSectionArea({-0.025, -0.03, -0.02}, {36.5 * 0.05, 28.5 * 0.06, 22.5 * 0.04}, normal, point),
                    1e-6);
    }
    const auto shifted =
        volumeOf(scene, {"A", "B", "C", "D"}, [&](Vec3d) { return static_cast<Scalar>(1 + any(random)); });
    const auto plane = planeAt(shifted, {0.4, 0.3, 0.8}, {0.9, 0.8, 0.4});
    EXPECT_NEAR(draw(shifted, plane).area, draw(full, plane).area, 1e-6);
}

TEST(SectionDrawing, FrameIsSeenFromTheSideThatIsCutAway) {
    const auto volume = volumeOf({}, {"WallSurface"}, boxAt);
    const volume::Grid& grid = volume.grid;
    for (const double sign : {1.0, -1.0}) {
        const PlaneAxes plan = makePlaneAxes(planeAt(volume, {0, 0, sign}, {0, 0, 1}), grid);
        EXPECT_EQ(plan.u, (Vec3d{1, 0, 0}));
        EXPECT_EQ(plan.v, (Vec3d{0, 1, 0}));
        const PlaneAxes front = makePlaneAxes(planeAt(volume, {0, sign, 0}, {0, 1, 0}), grid);
        EXPECT_EQ(front.v, (Vec3d{0, 0, 1}));
        // Seen from the south (normal to -y), east is on the right.
        EXPECT_NEAR(front.u.x, -sign, 1e-12);
    }
    const auto plane = planeAt(volume, {0.3, 0.5, 0.6}, {1, 2, 1});
    const PlaneAxes axes = makePlaneAxes(plane, grid);
    EXPECT_GT(axes.v.z, 0);
    EXPECT_NEAR(axes.u.z, 0, 1e-12);
    const PlanePoint p = axes.planeFromWorld(axes.worldFromPlane({1.25, -0.5}));
    EXPECT_NEAR(p.u, 1.25, 1e-8);
    EXPECT_NEAR(p.v, -0.5, 1e-8);
    EXPECT_NEAR(dot(axes.worldFromPlane({1.25, -0.5}) - plane.point, plane.normal), 0, 1e-8);
}

TEST(SectionDrawing, PlaneOnFacesOfVoxelsCutsWhatIsKept) {
    Scene scene;
    scene.spacing = {0.5, 0.5, 0.5};
    scene.dimension = {9, 9, 9};
    scene.origin = {10, 20, 30};
    const auto volume = volumeOf(scene, {"Below", "Above"}, [](Vec3d p) -> Scalar { return p.z < 2.2 ? 1 : 2; });
    // Samples up to 2.0 are below; the face lies at 2.25.
    const auto above = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 2.25}));
    ASSERT_EQ(above.components.size(), 1u);
    EXPECT_EQ(above.components[0].label, 0u);
    const auto below = draw(volume, planeAt(volume, {0, 0, -1}, {0, 0, 2.25}));
    ASSERT_EQ(below.components.size(), 1u);
    EXPECT_EQ(below.components[0].label, 1u);
    EXPECT_NEAR(below.area, 4.5 * 4.5, 1e-6);
}

TEST(SectionDrawing, OptionsChooseWhatIsDrawn) {
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    const auto plane = planeAt(volume, {0, 0, 1}, {0, 0, 0.6});
    SectionOptions options;
    options.spaces = false;
    EXPECT_EQ(draw(volume, plane, options).components.size(), 2u);
    options = {};
    options.show = {"class=BuildingRoom", "class=WallSurface"};
    options.hide = {"id=id-4"};
    const auto drawing = draw(volume, plane, options);
    expectSound(drawing);
    ASSERT_EQ(drawing.components.size(), 2u);
    EXPECT_EQ(drawing.components[0].label, 2u);
    EXPECT_EQ(drawing.components[1].label, 5u);
    options = {};
    options.smallestArea = 1;
    const auto large = draw(volume, plane, options);
    expectSound(large);
    EXPECT_EQ(large.components.size(), 3u);  // without the partition of 0.76 m2
    options.show = {"class=Rom"};
    EXPECT_EQ(drawSection(volume, plane, options).error().code(), Code::NothingSelected);
    options.show = {"class="};
    EXPECT_EQ(drawSection(volume, plane, options).error().code(), Code::BadQuery);
    EXPECT_EQ(drawSection(volume, SectionPlane{{0, 0, 0}, {}}).error().code(), Code::BadSection);
    EXPECT_EQ(drawSection(volume, SectionPlane{{0, 0, 1}, {0, NAN, 0}}).error().code(), Code::BadSection);
    options = {};
    options.tolerance = INFINITY;
    EXPECT_EQ(drawSection(volume, plane, options).error().code(), Code::BadArgument);
    EXPECT_TRUE(draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 500})).components.empty());
}

TEST(SectionDrawing, PhasesOfAPatternAreOneComponent) {
    auto volume = volumeOf({}, {"WallSurface"}, [](Vec3d p) -> Scalar {
        return boxAt(p) == 0 ? 0 : 1 + static_cast<Scalar>(std::floor(p.x * 3) + std::floor(p.y * 5)) % 3;
    });
    volume.labels.labels[0].count = 3;
    const auto drawing = draw(volume, planeAt(volume, {0, 0, 1}, {0, 0, 1.2}));
    ASSERT_EQ(drawing.components.size(), 1u);
    ASSERT_EQ(drawing.components[0].polygons.size(), 1u);
    EXPECT_EQ(drawing.components[0].polygons[0].outer.size(), 4u);
}

TEST(SectionDrawing, SameForAnyNumberOfThreads) {
    const auto volume = volumeOf({}, kHouseClasses, houseAt);
    const auto plane = planeAt(volume, {0.3, 0.2, 0.9}, {2.5, 2.2, 1.2});
    SectionOptions one, four;
    one.threads = 1;
    four.threads = 4;
    const auto a = draw(volume, plane, one), b = draw(volume, plane, four);
    ASSERT_EQ(a.components.size(), b.components.size());
    for (std::size_t n = 0; n < a.components.size(); ++n) {
        ASSERT_EQ(a.components[n].polygons.size(), b.components[n].polygons.size());
        for (std::size_t p = 0; p < a.components[n].polygons.size(); ++p) {
            EXPECT_EQ(a.components[n].polygons[p].outer, b.components[n].polygons[p].outer);
            EXPECT_EQ(a.components[n].polygons[p].holes, b.components[n].polygons[p].holes);
        }
    }
}

TEST(SectionDrawing, TextStandsInTheLargestFreePlace) {
    SectionPolygon l;  // an L: 6 x 1 m below, 1.5 x 5 m above its left end
    l.outer = {{0, 0}, {6, 0}, {6, 1}, {1.5, 1}, {1.5, 6}, {0, 6}};
    const TextPlace place = findTextPlace(l);
    EXPECT_GT(place.width, 4);
    EXPECT_LT(place.center.v, 1);
    SectionPolygon ring;  // nothing stands in the hole
    ring.outer = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};
    ring.holes = {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}};
    const TextPlace beside = findTextPlace(ring);
    EXPECT_FALSE(isInside(ring.holes[0], beside.center));
    EXPECT_GT(beside.width, 5);
}

}  // namespace
}  // namespace svt::drawing
