// Quantities of bodies whose figures are known in closed form.
#include <svt/quantities/quantities.hpp>
#include <svt/quantities/touching_faces.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace svt::quantities {
namespace {

using Ring = std::vector<std::array<double, 2>>;

struct Shape {
    std::string id, className;
    Ring outer{};               // counter-clockwise, seen against `across`
    std::vector<Ring> holes{};  // clockwise
    double thickness = 0.3;
    bool isFlat = false;  // false: upright, the ring is x and z
    double turn = 0;      // radians about z
    Vec3d at{};
    bool isOpen = false;  // without the back
    double splay = 0;     // by how much the holes are wider at the back
};

Ring rectangle(double x0, double y0, double x1, double y1, bool isHole = false) {
    Ring ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    if (isHole) std::reverse(ring.begin(), ring.end());
    return ring;
}

Ring widened(const Ring& ring, double by) {
    double u = 0, v = 0;
    for (const auto& p : ring) {
        u += p[0] / double(ring.size());
        v += p[1] / double(ring.size());
    }
    Ring wide = ring;
    for (auto& p : wide) p = {p[0] + (p[0] > u ? by : -by), p[1] + (p[1] > v ? by : -by)};
    return wide;
}

class Prism {
public:
    Prism(const Shape& body, model::BuildingModel& model) : body_(body), model_(model) {
        addCap(false);
        if (!body.isOpen) addCap(true);
        addSides(body.outer, body.outer);
        for (const Ring& hole : body.holes) addSides(hole, widened(hole, body.splay));
    }
    model::Solid solid;

private:
    // Upright: front at y = 0, back at y = thickness. Flat: top at z = 0, underside below.
    [[nodiscard]] Vec3d place(const std::array<double, 2>& p, bool isBack) const {
        const double depth = isBack ? body_.thickness : 0;
        const Vec3d q = body_.isFlat ? Vec3d{p[0], p[1], -depth} : Vec3d{p[0], depth, p[1]};
        const double c = std::cos(body_.turn), s = std::sin(body_.turn);
        return Vec3d{c * q.x - s * q.y, s * q.x + c * q.y, q.z} + body_.at;
    }
    void add(const std::vector<std::vector<Vec3d>>& rings) {
        model::Polygon polygon;
        for (const auto& ring : rings) {
            polygon.points.insert(polygon.points.end(), ring.begin(), ring.end());
            polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
        }
        solid.exterior.push_back({model_.addPolygon(std::move(polygon)), false});
    }
    void addCap(bool isBack) {
        std::vector<std::vector<Vec3d>> rings;
        const auto addRing = [&](Ring ring) {
            if (isBack) std::reverse(ring.begin(), ring.end());
            auto& points = rings.emplace_back();
            for (const auto& p : ring) points.push_back(place(p, isBack));
        };
        addRing(body_.outer);
        for (const Ring& hole : body_.holes) addRing(isBack ? widened(hole, body_.splay) : hole);
        add(rings);
    }
    void addSides(const Ring& front, const Ring& back) {
        for (std::size_t n = 0; n < front.size(); ++n) {
            const std::size_t m = (n + 1) % front.size();
            add({{place(front[n], false), place(back[n], true), place(back[m], true), place(front[m], false)}});
        }
    }
    const Shape& body_;
    model::BuildingModel& model_;
};

class Measured {
public:
    explicit Measured(const std::vector<Shape>& bodies, double spacing = 0.1) {
        model::BuildingModel model;
        for (const Shape& body : bodies) {
            model::Feature feature;
            feature.id = body.id;
            feature.className = body.className;
            model::Geometry geometry;
            geometry.kind = model::GeometryKind::Solid;
            geometry.solids.push_back(Prism(body, model).solid);
            feature.geometries.push_back(std::move(geometry));
            model.addFeature(std::move(feature), model::kNoFeature);
        }
        pipeline::BuildOptions options;
        options.spacing = Vec3d{spacing, spacing, spacing};
        options.vectors.meshes = true;
        auto built = pipeline::buildVolume(model, options);
        EXPECT_TRUE(built) << built.error().toString();
        if (!built) return;
        volume = std::move(built->volume);
        std::vector<std::uint32_t> all(volume.labels.labels.size());
        std::iota(all.begin(), all.end(), 0U);
        rows = measureObjects(volume, objectsOf(volume, all));
    }
    [[nodiscard]] const ObjectQuantities& operator[](const std::string& id) const {
        for (const ObjectQuantities& row : rows)
            if (volume.labels.labels[row.label].id == id) return row;
        ADD_FAILURE() << "no row of " << id;
        return rows.front();
    }
    [[nodiscard]] double sum() const {
        double sum = 0;
        for (const CountedVolume& one : countedVolumes(volume, rows)) sum += one.volume.value_or(0);
        return sum;
    }
    volume::SemanticVolume volume;
    std::vector<ObjectQuantities> rows;
};

// 6 x 3 m, 0.3 thick; a window of 1.5 x 1.2 m, and a door of 1 x 2 m that reaches the floor.
Shape wallWithOpenings(double turn = 0) {
    Shape wall{"wall", "BuildingConstructiveElement"};
    wall.outer = {{0, 0}, {4, 0}, {4, 2}, {5, 2}, {5, 0}, {6, 0}, {6, 3}, {0, 3}};
    wall.holes = {rectangle(1, 1, 2.5, 2.2, true)};
    wall.turn = turn;
    return wall;
}

void expectWall(const ObjectQuantities& wall) {
    constexpr double kOpenings = 1.5 * 1.2 + 1 * 2, kSide = 6 * 3 - kOpenings;
    EXPECT_EQ(wall.trust, Trust::Exact);
    EXPECT_NEAR(wall.netVolume.value(), kSide * 0.3, 1e-4);
    EXPECT_LT(wall.bound.value(), 1e-3);
    EXPECT_NEAR(wall.grossVolume.value(), 6 * 3 * 0.3, 1e-4);
    EXPECT_EQ(wall.grossBound, 0.0);
    EXPECT_NEAR(wall.thickness.value(), 0.3, 1e-5);
    EXPECT_NEAR(wall.length.value(), 6, 1e-5);
    EXPECT_FALSE(wall.width);
    EXPECT_NEAR(wall.height.value(), 3, 1e-5);
    EXPECT_NEAR(wall.sideArea.value(), kSide, 1e-3);
    EXPECT_NEAR(wall.openingArea.value(), kOpenings, 1e-3);
    EXPECT_EQ(wall.openings, 2u);
    EXPECT_NEAR(wall.perimeter.value(), 18, 1e-3);
    EXPECT_NEAR(wall.topArea.value(), (6 + 1.5) * 0.3, 1e-4) << "with the sill";
    EXPECT_NEAR(wall.bottomArea.value(), (5 + 1.5 + 1) * 0.3, 1e-4) << "with both lintels, without the door";
    EXPECT_NEAR(wall.outerArea.value(), 2 * kSide + 0.3 * (18 + 4 + 2 * (1.5 + 1.2)), 1e-3);
}

TEST(Quantities, OfAWallWithWindowAndDoor) { expectWall(Measured({wallWithOpenings()})["wall"]); }

TEST(Quantities, DoNotDependOnTheDirection) {
    for (const double degrees : {30.0, 90.0, 211.0})
        expectWall(Measured({wallWithOpenings(degrees * std::numbers::pi / 180)})["wall"]);
}

TEST(Quantities, AreUnknownOfAnObjectThatWasReadInPart) {
    Measured measured({wallWithOpenings()});
    const std::uint32_t wall = measured["wall"].label;
    measured.volume.labels.labels[wall].attributes.push_back(
        {std::string(model::kReadInPartAttribute), std::string("1 openings"), ""});
    std::vector<std::uint32_t> all(measured.volume.labels.labels.size());
    std::iota(all.begin(), all.end(), 0U);
    for (const ObjectQuantities& row : measureObjects(measured.volume, objectsOf(measured.volume, all))) {
        if (row.label != wall) continue;
        EXPECT_EQ(row.trust, Trust::Unknown);
        EXPECT_FALSE(row.netVolume || row.grossVolume || row.sideArea || row.openingArea || row.bound);
    }
    EXPECT_FALSE(analyze::solidVolumeOf(measured.volume.labels.labels[wall]));
}

// Far from the origin of the coordinates.
TEST(Quantities, KeepTheirDigitsInMapCoordinates) {
    Shape wall = wallWithOpenings(0.5);
    wall.at = {458000, 5438000, 110};
    expectWall(Measured({wall})["wall"]);
}

TEST(Quantities, OfASlabWithAHole) {
    Shape slab{"slab", "BuildingConstructiveElement", rectangle(0, 0, 8, 5), {rectangle(2, 2, 4, 3, true)}};
    slab.thickness = 0.25;
    slab.isFlat = true;
    slab.turn = 0.4;
    const Measured measured({slab});
    const ObjectQuantities& row = measured["slab"];
    EXPECT_NEAR(row.netVolume.value(), (40 - 2) * 0.25, 1e-4);
    EXPECT_NEAR(row.grossVolume.value(), 40 * 0.25, 1e-4);
    EXPECT_NEAR(row.openingArea.value(), 2, 1e-3);
    EXPECT_NEAR(row.topArea.value(), 38, 1e-4);
    EXPECT_NEAR(row.bottomArea.value(), 38, 1e-4);
    EXPECT_NEAR(row.sideArea.value(), 0.25 * (26 + 6), 1e-4);
    EXPECT_NEAR(row.length.value(), 8, 1e-4);
    EXPECT_NEAR(row.width.value(), 5, 1e-4);
    EXPECT_NEAR(row.thickness.value(), 0.25, 1e-5);
    EXPECT_NEAR(row.perimeter.value(), 26, 1e-3);
}

// Gables, steps at an end, battlements and seats of slabs do not count.
TEST(Quantities, FindNoOpeningsInOtherOutlines) {
    const std::pair<const char*, Ring> outlines[] = {
        {"gable", {{0, 0}, {6, 0}, {6, 3}, {3, 5}, {0, 3}}},
        {"step", {{0, 0}, {3, 0}, {3, -1}, {6, -1}, {6, 3}, {0, 3}}},
        {"battlement", {{0, 0}, {6, 0}, {6, 3}, {4, 3}, {4, 2}, {2, 2}, {2, 3}, {0, 3}}},
        {"seat", {{0, 0}, {2, 0}, {2, 0.2}, {4, 0.2}, {4, 0}, {6, 0}, {6, 3}, {0, 3}}},
    };
    for (const auto& [id, outline] : outlines) {
        const Measured measured({{id, "BuildingConstructiveElement", outline}});
        const ObjectQuantities& row = measured[id];
        EXPECT_EQ(row.openings, 0u) << id;
        EXPECT_EQ(row.grossVolume, row.netVolume) << id;
        EXPECT_NEAR(row.thickness.value(), 0.3, 1e-5) << id;
    }
}

// A window that widens to the back: the void is between its two outlines, and so is the figure with its bound.
TEST(Quantities, OfASplayedOpeningHaveABound) {
    Shape wall{"wall", "BuildingConstructiveElement", rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2, true)}};
    wall.splay = 0.1;
    const Measured measured({wall});
    const ObjectQuantities& row = measured["wall"];
    const double exact = 4 * 3 * 0.3;
    ASSERT_TRUE(row.grossVolume && row.grossBound);
    EXPECT_GT(*row.grossBound, 0.01);
    EXPECT_LE(std::abs(*row.grossVolume - exact), *row.grossBound);
    EXPECT_NEAR(row.openingArea.value(), 1, 1e-3);
}

// A round body has no two faces: openings and gross volume are unknown, not 0.
TEST(Quantities, OfARoundBodyHaveNoThickness) {
    Shape column{"column", "BuildingConstructiveElement"};
    for (int n = 0; n < 24; ++n) {
        const double angle = n * std::numbers::pi / 12;
        column.outer.push_back({0.2 * std::cos(angle), 0.2 * std::sin(angle)});
    }
    column.isFlat = true;
    column.thickness = 3;
    const Measured measured({column}, 0.05);
    const ObjectQuantities& row = measured["column"];
    EXPECT_NEAR(row.netVolume.value(), 3 * 12 * 0.04 * std::sin(std::numbers::pi / 12), 1e-4);
    EXPECT_NEAR(row.height.value(), 3, 1e-5);
    EXPECT_FALSE(row.thickness || row.openingArea || row.openings || row.grossVolume || row.length);
}

// Four walls in one body are not a slab with a hole. Of three walls, the middle one has the largest faces.
TEST(Quantities, OfWallsAroundACourtyardHaveNoOpenings) {
    Shape court{"court", "BuildingConstructiveElement", rectangle(0, 0, 6, 6), {rectangle(0.3, 0.3, 5.7, 5.7, true)}};
    Shape three{"three", "BuildingConstructiveElement"};
    three.outer = {{10, 0}, {16, 0}, {16, 6}, {15.7, 6}, {15.7, 0.3}, {10.3, 0.3}, {10.3, 6}, {10, 6}};
    for (Shape* shape : {&court, &three}) {
        shape->isFlat = true;
        shape->thickness = 2.8;
    }
    const Measured measured({court, three});
    const ObjectQuantities& row = measured["court"];
    EXPECT_NEAR(row.netVolume.value(), (36 - 5.4 * 5.4) * 2.8, 1e-3);
    EXPECT_FALSE(row.thickness || row.openingArea || row.openings || row.grossVolume || row.length);
    EXPECT_NEAR(measured["three"].thickness.value(), 0.3, 1e-5);
    EXPECT_EQ(measured["three"].grossVolume, measured["three"].netVolume);
}

// A building is not a wall, whatever its form is.
TEST(Quantities, OfBuildingsHaveAllSides) {
    Shape block{"block", "Building", rectangle(0, 0, 6, 3)};
    block.thickness = 2;
    const Measured measured({block});
    const ObjectQuantities& row = measured["block"];
    EXPECT_NEAR(row.sideArea.value(), 2 * (6 * 3 + 2 * 3), 1e-3);
    EXPECT_FALSE(row.thickness || row.length);
    const auto buildings = buildingQuantities(measured.volume, measured.rows);
    ASSERT_EQ(buildings.size(), 1u);
    EXPECT_EQ(buildings.front().netVolume, row.netVolume);
}

// SVT closes the missing back by a cap: the volume is that of the closed body, and no bound is known.
TEST(Quantities, NameTheirSource) {
    Shape open{"open", "BuildingConstructiveElement", rectangle(0, 0, 4, 3)};
    open.isOpen = true;
    const Measured measured({open});
    const ObjectQuantities& row = measured["open"];
    EXPECT_EQ(row.trust, Trust::Caps);
    EXPECT_NEAR(row.netVolume.value(), 4 * 3 * 0.3, 1e-4);
    EXPECT_FALSE(row.bound);
}

TEST(Quantities, CountSharedSpaceOnce) {
    const std::string element = "BuildingConstructiveElement";
    Shape a{"a", element, rectangle(0, 0, 4, 3)};
    Shape b{"b", element, rectangle(0, 0, 3, 3)};
    b.turn = std::numbers::pi / 2;
    b.at = {0.3, 0, 0};  // x from 0 to 0.3, y from 0 to 3: shares 0.3 x 0.3 x 3 with a
    Shape c{"c", element, rectangle(0, 0, 4, 3)};
    c.thickness = 0.25;
    c.isFlat = true;
    c.at = {0, 0, 0.125};  // z from -0.125 to 0.125: shares with both
    const Measured measured({a, b, c});
    const double walls = 4 * 3 * 0.3 + 3 * 3 * 0.3 - 0.3 * 0.3 * 3;
    const double slab = 4 * 3 * 0.25, shared = 0.125 * (4 * 0.3 + 3 * 0.3 - 0.3 * 0.3);
    EXPECT_NEAR(measured.sum(), walls + slab - shared, 1e-4 * (walls + slab));
    EXPECT_NEAR(measured["b"].netVolume.value(), 3 * 3 * 0.3, 1e-4) << "the row has the whole object";
    // Only the walls: the slab takes nothing from them.
    const std::vector<ObjectQuantities> rows{measured["a"], measured["b"]};
    double sum = 0;
    for (const CountedVolume& one : countedVolumes(measured.volume, rows)) {
        EXPECT_TRUE(one.isExact);
        sum += one.volume.value_or(0);
    }
    EXPECT_NEAR(sum, walls, 1e-4 * walls);
}

// Many equal bodies at one place fill the space of one.
TEST(Quantities, CountEqualBodiesOnce) {
    std::vector<Shape> bodies;
    for (int n = 0; n < 300; ++n)
        bodies.push_back({"b" + std::to_string(n), "BuildingConstructiveElement", rectangle(0, 0, 1, 2)});
    const Measured measured(bodies);
    EXPECT_EQ(measured.rows.size(), 300u);
    EXPECT_NEAR(measured.sum(), 1 * 2 * 0.3, 1e-4);
}

double areaOf(const std::vector<TouchingArea>& areas, const auto& is) {
    double sum = 0;
    for (const TouchingArea& one : areas)
        if (is(one)) sum += one.area;
    return sum;
}

// A wall on a slab: their contact is neither outside, nor in need of formwork.
TEST(TouchingFaces, DivideTheFacesOfAMesh) {
    for (const double degrees : {0.0, 30.0}) {
        const double turn = degrees * std::numbers::pi / 180;
        Shape wall{"wall", "BuildingConstructiveElement", rectangle(0.5, 0, 4.5, 3)};
        wall.turn = turn;
        Shape slab{"slab", "BuildingConstructiveElement", rectangle(0, -1, 5, 1)};
        slab.isFlat = true;
        slab.turn = turn;
        const Measured measured({wall, slab});
        const auto areas = findTouchingAreas(measured.volume, measured.rows);
        for (std::size_t n = 0; n < areas.size(); ++n) {
            const bool isWall = measured.volume.labels.labels[measured.rows[n].label].id == "wall";
            const double whole = measured.rows[n].outerArea.value();
            const double contact = areaOf(areas[n], [](const TouchingArea& t) { return t.label != volume::kNoLabel; });
            const double outside = areaOf(areas[n], [](const TouchingArea& t) { return t.isOutside; });
            EXPECT_NEAR(contact, 4 * 0.3, degrees == 0 ? 0.03 : 0.12) << isWall << ' ' << degrees;
            EXPECT_NEAR(outside, whole - 4 * 0.3, 0.005 * whole) << isWall << ' ' << degrees;
            const double south = areaOf(areas[n], [](const TouchingArea& t) { return t.facing == Facing::S; });
            if (isWall) {
                EXPECT_NEAR(south, degrees == 0 ? 12 : 0, 0.01) << degrees;
            }
        }
    }
}

// A house of boxes without air inside: soil with a pit, a slab in it, two walls that meet on the slab, and a beam on both.
std::vector<Shape> boxesOnSoil(double turn) {
    std::vector<Shape> bodies;
    const auto addBox = [&](const char* id, const char* className, Ring ring, double low, double high, Ring hole = {}) {
        Shape body{id, className, std::move(ring)};
        if (!hole.empty()) body.holes.push_back(std::move(hole));
        body.isFlat = true;
        body.thickness = high - low;
        body.turn = turn;
        body.at = {12.34, 5.67, high};
        bodies.push_back(std::move(body));
    };
    addBox("soil", "GenericCityObject", rectangle(-3, -3, 8.1, 6.2), -1.5, -0.37);
    addBox("pit", "GenericCityObject", rectangle(-3, -3, 8.1, 6.2), -0.37, -0.03,
           rectangle(0.013, 0.027, 5.117, 3.231, true));
    addBox("slab", "BuildingConstructiveElement", rectangle(0.013, 0.027, 5.117, 3.231), -0.37, 0.011);
    addBox("wall", "BuildingConstructiveElement", rectangle(0.113, 0.127, 4.117, 0.367), 0.011, 2.513);
    addBox("other", "BuildingConstructiveElement", rectangle(0.113, 0.367, 0.353, 2.931), 0.011, 2.513);
    addBox("beam", "BuildingConstructiveElement", rectangle(0.113, 0.127, 1.513, 0.767), 2.513, 2.733);
    return bodies;
}

struct FaceAreas {
    double exterior = 0, counted = 0, touched = 0;
};
FaceAreas facesOf(const Measured& measured, const std::string& id) {
    FaceAreas sums;
    const auto areas = findTouchingAreas(measured.volume, measured.rows);
    for (std::size_t n = 0; n < areas.size(); ++n)
        if (measured.volume.labels.labels[measured.rows[n].label].id == id)
            for (const TouchingArea& one : areas[n]) {
                (one.isOutside ? sums.exterior : sums.touched) += one.area;
                sums.counted += one.countedArea;
            }
    return sums;
}

// Closed forms of the figures above, in any direction and at any spacing.
TEST(TouchingFaces, AreExactBetweenClosedMeshes) {
    struct Known {
        const char* id;
        double exterior, touched;
    };
    constexpr double kSlab = 5.104 * 3.204, kWall = 4.004 * 0.24, kOther = 0.24 * 2.564, kHigh = 2.502;
    constexpr double kRound = 2 * (5.104 + 3.204), kBeam = 1.4 * 0.24 + 0.24 * 0.4;
    const Known known[] = {
        {"slab", kSlab - kWall - kOther + kRound * 0.041, kSlab + kRound * 0.34 + kWall + kOther},
        {"wall", (2 * (4.004 + 0.24) - 0.24) * kHigh + kWall - 1.4 * 0.24, kWall + 0.24 * kHigh + 1.4 * 0.24},
        {"other", (2 * (0.24 + 2.564) - 0.24) * kHigh + kOther - 0.24 * 0.4, kOther + 0.24 * kHigh + 0.24 * 0.4},
        {"beam", 2 * 1.4 * 0.64 + 2 * (1.4 + 0.64) * 0.22 - kBeam, kBeam}};
    for (const double degrees : {0.0, 17.0, 30.0, 45.0})
        for (const double spacing : {0.1, 0.07, 0.05}) {
            if (degrees == 17 && spacing == 0.07) continue;
            const Measured measured(boxesOnSoil(degrees * std::numbers::pi / 180), spacing);
            for (const Known& one : known) {
                const FaceAreas found = facesOf(measured, one.id);
                EXPECT_NEAR(found.exterior, one.exterior, 0.0005) << one.id << ' ' << degrees << ' ' << spacing;
                EXPECT_NEAR(found.touched, one.touched, 0.0005) << one.id << ' ' << degrees << ' ' << spacing;
                EXPECT_EQ(found.counted, 0) << one.id << ' ' << degrees << ' ' << spacing;
            }
        }
}

// Across a gap of 4 mm, points divide the face. The result says so.
TEST(TouchingFaces, SayWherePointsDivideThem) {
    Shape slab{"slab", "BuildingConstructiveElement", rectangle(0, 0, 5, 3)}, wall = slab;
    slab.isFlat = true;
    wall.id = "wall";
    wall.outer = rectangle(1, 0, 4, 2);
    wall.at = {0, 1, 0.004};
    const Measured measured({slab, wall});
    const FaceAreas found = facesOf(measured, "slab");
    EXPECT_NEAR(found.touched, 0.9, 0.05);
    EXPECT_NEAR(found.counted, 2 * 0.9, 0.1) << "as much may be free or not";
    EXPECT_NEAR(found.exterior + found.touched, 30 + 16 * 0.3, 1e-3);
}

// A body that is inside of another one has no free face, and the outer one is not divided.
TEST(TouchingFaces, KnowBodiesInBodies) {
    Shape slab{"slab", "BuildingConstructiveElement", rectangle(0, 0, 5, 3)}, duct = slab;
    slab.isFlat = duct.isFlat = true;
    duct.id = "duct";
    duct.outer = rectangle(1, 1, 1.5, 2);
    duct.thickness = 0.1;
    duct.at = {0, 0, -0.1};
    const Measured measured({slab, duct});
    EXPECT_NEAR(facesOf(measured, "duct").touched, 2 * 0.5 + 3 * 0.1, 1e-4);
    EXPECT_EQ(facesOf(measured, "duct").exterior, 0);
    EXPECT_NEAR(facesOf(measured, "slab").exterior, 30 + 16 * 0.3, 1e-3);
}

TEST(TouchingFaces, KnowTheirDirection) {
    EXPECT_EQ(facingOf({0, 1, 0}), Facing::N);
    EXPECT_EQ(facingOf({1, 0, 0}), Facing::E);
    EXPECT_EQ(facingOf({-0.6, -0.6, 0.5}), Facing::SW);
    EXPECT_EQ(facingOf({0, -1, 0}), Facing::S);
    EXPECT_EQ(facingOf({-0.5, 0.5, 0}), Facing::NW);
    EXPECT_EQ(facingOf({0.1, 0, 1}), Facing::Top);
    EXPECT_EQ(facingOf({0, 0.1, -1}), Facing::Bottom);
}

// Only air that the grid's border does not reach is inside air.
TEST(TouchingFaces, TellInsideFromOutside) {
    std::vector<Shape> bodies;
    const auto flat = [&](const char* id, Ring ring, double thickness, double top) {
        Shape body{id, "BuildingConstructiveElement", std::move(ring)};
        body.isFlat = true;
        body.thickness = thickness;
        body.at = {0, 0, top};
        bodies.push_back(body);
    };
    flat("floor", rectangle(0, 0, 4, 4), 0.4, 0);
    flat("roof", rectangle(0, 0, 4, 4), 0.4, 3.4);
    Shape ring{"ring", "BuildingConstructiveElement", rectangle(0, 0, 4, 4), {rectangle(0.4, 0.4, 3.6, 3.6, true)}};
    ring.isFlat = true;
    ring.thickness = 3;
    ring.at = {0, 0, 3};
    bodies.push_back(ring);
    const Measured measured(bodies);
    const auto areas = findTouchingAreas(measured.volume, measured.rows);
    double outside = 0, inside = 0;
    for (const auto& one : areas) {
        outside += areaOf(one, [](const TouchingArea& t) { return t.isOutside; });
        inside += areaOf(one, [](const TouchingArea& t) { return t.label == volume::kNoLabel && !t.isOutside; });
    }
    EXPECT_NEAR(outside, 2 * 16 + 16 * 3.8, 0.005 * 92.8);
    EXPECT_NEAR(inside, 2 * 3.2 * 3.2 + 4 * 3.2 * 3, 0.01 * 58.88);
}

}  // namespace
}  // namespace svt::quantities
