#include <svt/analyze/scalar_boxes.hpp>
#include <svt/drawing/field_drawing.hpp>
#include <svt/fields/node_field_test.hpp>
#include <svt/pipeline/sample_models_test.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>
#include <polyclipping/clipper.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace svt::drawing {
namespace {

using volume::SemanticVolume;
using volume::test::addObject;
using volume::test::emptyVolume;
using volume::test::paintBoxes;

constexpr Vec3i kSize{82, 62, 22};
constexpr double kStep = 0.05;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Two rooms beside each other, 10 cm of wall around and between them, and a pillar in the eastern one. Scalars: 1 wall, 2
// west, 3 east, 4 pillar.
SemanticVolume twoRooms(const std::array<Vec3d, 3>& axes = volume::test::kWorldAxes) {
    SemanticVolume volume = emptyVolume(kSize, {kStep, kStep, kStep}, {100, 200, 30}, axes);
    addObject(volume, "wall", "WallSurface");
    addObject(volume, "west", "BuildingRoom");
    addObject(volume, "east", "BuildingRoom");
    addObject(volume, "pillar", "BuildingConstructiveElement");
    paintBoxes(volume, {{1, {0, 0, 0}, kSize},
                        {2, {2, 2, 2}, {40, 60, 20}},
                        {3, {42, 2, 2}, {80, 60, 20}},
                        {4, {60, 30, 2}, {63, 33, 20}}});
    return volume;
}

// valueAt(metres from the corner of the grid, along its axes) at each node of the voxels.
fields::Field fieldOf(const std::string& medium, const std::function<double(Vec3d)>& valueAt) {
    return fields::test::nodeField("temperature", medium, kSize, kStep, valueAt);
}

SectionDrawing planOf(const SemanticVolume& volume, const char* plane = "z=0.53") {
    const auto at = parseSectionPlane(plane, volume);
    EXPECT_TRUE(at) << at.error().toString();
    const auto drawing = drawSection(volume, *at);
    EXPECT_TRUE(drawing) << drawing.error().toString();
    return *drawing;
}

FieldDrawing drawn(const SectionDrawing& drawing, const SemanticVolume& volume, const fields::Field& field,
                   const FieldDrawingOptions& options) {
    auto made = drawField(drawing, volume, field, options);
    EXPECT_TRUE(made) << (made ? "" : made.error().toString());
    return made ? std::move(*made) : FieldDrawing{};
}

ClipperLib::IntPoint clipperPoint(PlanePoint p) {
    return {std::llround(p.u * (1 << 20)), std::llround(p.v * (1 << 20))};
}

// Metres of the lines inside of the polygons of the labels, by Clipper.
double lengthInside(const std::vector<FieldIsoline>& lines, const SectionDrawing& drawing,
                    const std::vector<std::uint32_t>& labels) {
    ClipperLib::Clipper clipper;
    for (const FieldIsoline& line : lines) {
        ClipperLib::Path path;
        for (const PlanePoint p : line.points) path.push_back(clipperPoint(p));
        clipper.AddPath(path, ClipperLib::ptSubject, false);
    }
    for (const SectionComponent& component : drawing.components) {
        if (std::find(labels.begin(), labels.end(), component.label) == labels.end()) continue;
        for (const SectionPolygon& polygon : component.polygons) {
            std::vector<Ring> rings = polygon.holes;
            rings.push_back(polygon.outer);
            for (const Ring& ring : rings) {
                ClipperLib::Path path;
                for (const PlanePoint p : ring) path.push_back(clipperPoint(p));
                clipper.AddPath(path, ClipperLib::ptClip, true);
            }
        }
    }
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctIntersection, tree, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
    ClipperLib::Paths open;
    ClipperLib::OpenPathsFromPolyTree(tree, open);
    double length = 0;
    for (const ClipperLib::Path& path : open)
        for (std::size_t n = 0; n + 1 < path.size(); ++n)
            length += std::hypot(double(path[n + 1].X - path[n].X), double(path[n + 1].Y - path[n].Y)) / (1 << 20);
    return length;
}

double lengthOf(const FieldIsoline& line) {
    double length = 0;
    for (std::size_t n = 0; n + 1 < line.points.size(); ++n)
        length += std::hypot(line.points[n + 1].u - line.points[n].u, line.points[n + 1].v - line.points[n].v);
    return length;
}

double areaOf(const std::vector<SectionPolygon>& polygons) {
    double area = 0;
    for (const SectionPolygon& polygon : polygons) area += polygon.area;
    return area;
}

TEST(FieldDrawing, LinesOfALinearFieldAreStraightUpToTheWalls) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    // 3 x + 4 y, 5 per metre across its lines.
    const fields::Field field = fieldOf("air", [](Vec3d p) { return 3 * p.x + 4 * p.y; });
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    ASSERT_GT(made.isolines.size(), 20u);
    const PlanePoint corner = plan.axes.planeFromWorld(volume.grid.origin());
    for (const FieldIsoline& line : made.isolines)
        for (const PlanePoint p : line.points) {
            const double value = 3 * (p.u - corner.u) + 4 * (p.v - corner.v);
            EXPECT_LT(std::abs(value - line.value) / 5, 1e-4) << "metres from the true line";
        }
    EXPECT_LT(lengthInside(made.isolines, plan, {0, 3}), 1e-3) << "in the walls and the pillar";
    // Each line of the western room ends at two walls: the value 5 crosses it from (5/3, 0) to (0, 5/4).
    double length = 0;
    const double west = 0.075, south = 0.075;  // faces of the voxels: 1.5 steps from the first sample
    for (const FieldIsoline& line : made.isolines)
        if (line.value == 5) length += lengthOf(line);
    EXPECT_NEAR(length, std::hypot((5 - 4 * south) / 3 - west, (5 - 3 * west) / 4 - south), 2e-4);
}

TEST(FieldDrawing, NoLineAndNoBandCrossesAWall) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? 20.3 : 30.3; });
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    EXPECT_TRUE(made.isolines.empty()) << "each room has one value";
    ASSERT_EQ(made.bands.size(), 2u);
    EXPECT_EQ(made.bands[0].low, 20);
    EXPECT_EQ(made.bands[1].high, 31);
    const auto areaIn = [&](std::uint32_t label) {
        for (const SectionComponent& component : plan.components)
            if (component.label == label) return component.area;
        return 0.0;
    };
    // Outside of the building the nodes beyond the grid have no value, so both bands are the rooms.
    EXPECT_NEAR(areaOf(made.bands[0].polygons), areaIn(1), 1e-4);
    EXPECT_NEAR(areaOf(made.bands[1].polygons), areaIn(2), 1e-4);
    EXPECT_EQ(made.bands[1].polygons[0].holes.size(), 1u) << "the pillar";
    EXPECT_TRUE(made.missing.empty());
}

TEST(FieldDrawing, BandsHaveTheAreasOfALinearField) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    const fields::Field field = fieldOf("air", [](Vec3d p) { return 10 * p.x; });
    const FieldDrawing made = drawn(plan, volume, field, {.bands = 5.0});
    EXPECT_EQ(made.bandStep, 5);
    double sum = 0;
    for (const FieldBand& band : made.bands) sum += areaOf(band.polygons);
    EXPECT_NEAR(sum, 2 * 1.9 * 2.9 - 0.15 * 0.15, 1e-3);
    for (const FieldBand& band : made.bands)
        if (band.low >= 1 && band.high <= 19) {
            EXPECT_NEAR(areaOf(band.polygons), 0.5 * 2.9, 1e-3) << band.low;
        }
    EXPECT_EQ(drawn(plan, volume, field, {.isolines = 2}).bandStep, 2) << "as the lines";
    EXPECT_EQ(drawn(plan, volume, field, {.isolines = 2, .bands = 0.0}).bandStep, 0);
    EXPECT_EQ(drawn(plan, volume, field, {}).bandStep, 5) << "a round step";
}

TEST(FieldDrawing, FieldsOfSolidsLieInTheCutComponents) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    const fields::Field field = fieldOf("solid", [](Vec3d p) { return 10 * p.x; });
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 2});
    ASSERT_FALSE(made.isolines.empty());
    EXPECT_LT(lengthInside(made.isolines, plan, {1, 2}), 1e-3) << "in the rooms";
    double length = 0;
    for (const FieldIsoline& line : made.isolines) length += lengthOf(line);
    EXPECT_NEAR(lengthInside(made.isolines, plan, {0, 3}), length, 1e-2);
    double sum = 0;
    for (const FieldBand& band : made.bands) sum += areaOf(band.polygons);
    EXPECT_NEAR(sum, 4.1 * 3.1 - 2 * 1.9 * 2.9 + 0.15 * 0.15, 1e-3);
}

TEST(FieldDrawing, AllVoxelsHaveValuesOnBothSidesOfASurface) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    // Walls are 100 warmer than the air at each place: no line may show the jump.
    const fields::Field field = fieldOf("all", [&](Vec3d p) {
        const auto s = volume.columns.scalarAt(static_cast<int>(std::lround(p.x / kStep)),
                                               static_cast<int>(std::lround(p.y / kStep)), 10);
        return p.y + (s == 1 || s == 4 ? 100 : 0);
    });
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 0.5});
    for (const FieldIsoline& line : made.isolines) {
        EXPECT_TRUE(line.value < 4 || line.value > 99) << line.value;
        EXPECT_LT(lengthInside({line}, plan,
                               line.value > 50 ? std::vector<std::uint32_t>{1, 2} : std::vector<std::uint32_t>{0, 3}),
                  1e-3);
    }
}

TEST(FieldDrawing, UprightAndObliqueSectionsOfTurnedGrids) {
    const double c = std::cos(0.4), s = std::sin(0.4);
    const SemanticVolume volume = twoRooms({Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}});
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x + 2 * p.y + 3 * p.z; });
    for (const char* plane : {"y<1.51", "0.3,0.2,1,-1.5", "1,0.1,0.2,-1.2"}) {
        const SectionDrawing section = planOf(volume, plane);
        const FieldDrawing made = drawn(section, volume, field, {.isolines = 0.25});
        ASSERT_GT(made.isolines.size(), 5u) << plane;
        EXPECT_LT(lengthInside(made.isolines, section, {0, 3}), 2e-3) << plane;
        double sum = 0, rooms = 0;
        for (const FieldBand& band : made.bands) sum += areaOf(band.polygons);
        for (const SectionComponent& component : section.components)
            if (component.label == 1 || component.label == 2) rooms += component.area;
        EXPECT_NEAR(sum, rooms, 2e-3) << plane;
        if (std::string_view(plane) != "y<1.51") continue;
        for (const FieldIsoline& line : made.isolines)
            for (const PlanePoint p : line.points) {
                const Vec3d at = volume.grid.indexFromWorld(section.axes.worldFromPlane(p)) * kStep;
                EXPECT_LT(std::abs(at.x + 2 * at.y + 3 * at.z - line.value) / std::hypot(1, 3), 1e-4);
            }
    }
}

TEST(FieldDrawing, PlacesWithoutAValueReachTheOutlineOfTheRoom) {
    const SemanticVolume volume = twoRooms();
    SectionDrawing plan = planOf(volume);
    // The faces of the room lie 3 cm within the voxels of its walls.
    constexpr double kGrown = 0.03;
    const auto grow = [&](Ring& ring) {
        double u = 0, v = 0;
        for (const PlanePoint p : ring) {
            u += p.u / double(ring.size());
            v += p.v / double(ring.size());
        }
        for (PlanePoint& p : ring) p = {p.u + (p.u > u ? kGrown : -kGrown), p.v + (p.v > v ? kGrown : -kGrown)};
    };
    for (SectionComponent& component : plan.components)
        for (SectionPolygon& polygon : component.polygons) {
            if (component.label == 1) grow(polygon.outer);
            for (Ring& hole : polygon.holes)
                if (component.label == 0) grow(hole);
        }
    const double middle = volume.grid.origin().x + 2.05;
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? kMissing : p.x; });
    const FieldDrawing made = drawn(plan, volume, field, {.bands = 1.0});
    double west = 0;
    for (const SectionPolygon& polygon : made.missing)
        if (plan.axes.worldFromPlane(polygon.outer.front()).x < middle) west += polygon.area;
    EXPECT_NEAR(west, (1.9 + 2 * kGrown) * (2.9 + 2 * kGrown), 1e-3);
}

TEST(FieldDrawing, PlacesWithoutAValueAreNamed) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2.05 ? p.x : kMissing; });
    const FieldDrawing made = drawn(plan, volume, field, {.bands = 1.0});
    EXPECT_NEAR(areaOf(made.missing), 1.9 * 2.9 - 0.15 * 0.15, 1e-3);
    for (const FieldBand& band : made.bands)
        for (const SectionPolygon& polygon : band.polygons)
            for (const PlanePoint p : polygon.outer)
                EXPECT_LT(p.u - plan.axes.planeFromWorld(volume.grid.origin()).u, 2.05);
    const auto none = drawField(plan, volume, fieldOf("air", [](Vec3d) { return kMissing; }));
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code(), Code::BadArgument);
}

TEST(FieldDrawing, TimesAndStepsAreChecked) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    fields::Field field = fieldOf("air", [](Vec3d) { return 20; });
    const std::vector<float> second(field.values.size(), 30);
    field.values.insert(field.values.end(), second.begin(), second.end());
    field.head.times = {0, 60};
    const FieldDrawing made = drawn(plan, volume, field, {.time = 30.0, .bands = 1.0});
    ASSERT_EQ(made.bands.size(), 1u);
    EXPECT_EQ(made.bands[0].low, 25) << "half way between 20 and 30";
    EXPECT_EQ(made.title, "temperature (\u00B0C), 30 s");
    EXPECT_EQ(made.shareOf(25), 0.5) << "the range is that of all times";
    for (const FieldDrawingOptions& wrong : {FieldDrawingOptions{.time = 61.0}, FieldDrawingOptions{.isolines = 0.001},
                                             FieldDrawingOptions{.isolines = -1}, FieldDrawingOptions{.bands = 1e-9}}) {
        const auto refused = drawField(plan, volume, field, wrong);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code(), Code::BadArgument);
    }
    const FieldDrawing one = drawn(plan, volume, field, {.isolines = 1, .threads = 1});
    const FieldDrawing many = drawn(plan, volume, field, {.isolines = 1, .threads = 5});
    EXPECT_EQ(one.bands.size(), many.bands.size());
}

TEST(FieldDrawing, ThinWallsWithinOneRegionKeepTheirSidesApart) {
    // A wall of one voxel with a way around it: 20 on one side, 30 on the other.
    SemanticVolume volume = emptyVolume(kSize, {kStep, kStep, kStep});
    addObject(volume, "wall", "WallSurface");
    addObject(volume, "room", "BuildingRoom");
    paintBoxes(volume, {{1, {0, 0, 0}, kSize}, {2, {2, 2, 2}, {80, 60, 20}}, {1, {40, 2, 2}, {41, 40, 20}}});
    const SectionDrawing plan = planOf(volume);
    const fields::Field field = fieldOf("air", [](Vec3d p) { return p.x < 2 ? 20.5 : 30.5; });
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    for (const FieldIsoline& line : made.isolines)
        for (const PlanePoint p : line.points)
            EXPECT_GT(p.v, 1.9) << "a line lies beside the wall, where all values are equal";
    EXPECT_LT(lengthInside(made.isolines, plan, {0}), 1e-3);
}

// The kitchen of the sample house has values, and the living room beside it has none. A wall of 12 cm in voxels of 20 cm is
// between them, with a passage.
TEST(FieldDrawing, NoValueCrossesAWallThinnerThanAVoxel) {
    const SemanticVolume volume =
        svt::test::volumeOfSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, 0.2);
    const auto labelOf = [&](std::string_view id) {
        for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l)
            if (volume.labels.labels[l].id == id) return l;
        return volume::kNoLabel;
    };
    const std::uint32_t kitchen = labelOf("house_kitchen"), wall = labelOf("house_wall_kitchen");
    ASSERT_TRUE(kitchen != volume::kNoLabel && wall != volume::kNoLabel);
    fields::Field field;
    field.head.name = "temperature";
    field.head.unit = "Cel";
    field.head.medium = "air";
    const auto box = analyze::labelBoxes(volume.columns, volume.labels)[kitchen];
    field.head.lattice.first = toDouble(box.min);
    field.head.lattice.size = box.max - box.min + Vec3i{1, 1, 1};
    field.head.lattice.step = {1, 1, 1};
    const Vec3i size = field.head.lattice.size;
    field.values.assign(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 21.0f);
    const SectionDrawing plan = planOf(volume, "z=1.5");
    double least = kInfinity, face = kInfinity;
    for (const SectionComponent& component : plan.components)
        if (component.label == wall)
            for (const SectionPolygon& polygon : component.polygons)
                for (const PlanePoint p : polygon.outer) face = std::min(face, p.u);
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    ASSERT_EQ(made.bands.size(), 1u);
    for (const SectionPolygon& polygon : made.bands[0].polygons)
        for (const PlanePoint p : polygon.outer) least = std::min(least, p.u);
    EXPECT_GE(least, face - 1e-3) << "the band ends at the wall's other face";
    EXPECT_NEAR(areaOf(made.bands[0].polygons), 14.07, 0.05) << "and fills the kitchen around its furniture";
}

TEST(FieldDrawing, SensorsColourTheirRooms) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    fields::Field field;
    field.head.name = "warm";
    field.head.unit = "Cel";
    field.head.kind = fields::FieldKind::Label;
    field.head.medium = "air";
    field.values = {std::numeric_limits<float>::quiet_NaN(), 20.5f, 24.5f, std::numeric_limits<float>::quiet_NaN()};
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    EXPECT_TRUE(made.isolines.empty());
    ASSERT_EQ(made.bands.size(), 2u);
    EXPECT_NEAR(areaOf(made.bands[0].polygons), 1.9 * 2.9, 1e-3);
}

TEST(FieldDrawing, CoarseLatticesStayInTheirRooms) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing plan = planOf(volume);
    fields::Field field = fieldOf("air", [](Vec3d) { return 0; });
    // Nodes every 8 voxels: 20 to the west, 30 to the east.
    field.head.lattice = {{11, 8, 3}, {0, 2, 2}, {8, 8, 8}, {}};
    field.values.clear();
    for (int n = 0; n < 11 * 8 * 3; ++n) field.values.push_back(n % 11 * 8 <= 40 ? 20.2f : 30.2f);
    const FieldDrawing made = drawn(plan, volume, field, {.isolines = 1});
    EXPECT_TRUE(made.isolines.empty());
    ASSERT_EQ(made.bands.size(), 2u);
    EXPECT_NEAR(areaOf(made.bands[0].polygons), 1.9 * 2.9, 1e-3);
}

// vectorAt(metres along the axes of the grid) at each node.
fields::Field vectorsOf(const std::function<Vec3d(Vec3d)>& vectorAt) {
    fields::Field field;
    for (int c = 0; c < 3; ++c) {
        const fields::Field part = fieldOf("air", [&](Vec3d p) { return vectorAt(p)[c]; });
        field.head = part.head;
        field.values.insert(field.values.end(), part.values.begin(), part.values.end());
    }
    field.head.components = 3;
    return field;
}

TEST(FieldDrawing, ArrowsAreThePartsOfVectorsInThePlane) {
    const double turn = std::numbers::pi / 6, c = std::cos(turn), s = std::sin(turn);
    for (const auto& axes :
         {volume::test::kWorldAxes, std::array<Vec3d, 3>{Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}}}) {
        const SemanticVolume volume = twoRooms(axes);
        const SectionDrawing drawing = planOf(volume);
        const fields::Field field = vectorsOf([](Vec3d p) { return p.x < 2.05 ? Vec3d{3, 4, 12} : Vec3d{0, -20, 0}; });
        FieldDrawingOptions options;
        options.arrows = 0.1;
        const FieldDrawing made = drawn(drawing, volume, field, options);
        EXPECT_EQ(made.high, 20);
        EXPECT_EQ(made.low, 13);
        int west = 0, east = 0;
        std::vector<FieldIsoline> lines;
        for (const FieldArrow& arrow : made.arrows) {
            const bool isWest = arrow.value < 10;
            ++(isWest ? west : east);
            EXPECT_NEAR(arrow.value, isWest ? 5 : 20, 1e-4);
            const Vec3d wanted = isWest ? axes[0] * 0.6 + axes[1] * 0.8 : axes[1] * -1.0;
            const Vec3d way = drawing.axes.worldFromPlane(arrow.to) - drawing.axes.worldFromPlane(arrow.from);
            EXPECT_NEAR(length(way - wanted * (isWest ? 0.0475 : 0.095)), 0, 1e-6);
            const double u = (arrow.from.u + arrow.to.u) / 2, v = (arrow.from.v + arrow.to.v) / 2;
            EXPECT_NEAR(std::remainder(u, 0.1), 0, 1e-9);
            EXPECT_NEAR(std::remainder(v, 0.1), 0, 1e-9);
            lines.push_back({arrow.value, {arrow.from, arrow.to}});
        }
        EXPECT_GT(west, 450);  // of 1.9 x 2.9 m
        EXPECT_GT(east, 450);
        EXPECT_EQ(lengthInside(lines, drawing, {0, 3}), 0) << "arrows in walls";
        options.arrows = 0;
        EXPECT_TRUE(drawn(drawing, volume, field, options).arrows.empty());
        options.arrows = std::nullopt;
        EXPECT_NEAR(drawn(drawing, volume, field, options).arrowStep, 0.1, 1e-12);
    }
}

TEST(FieldDrawing, LengthsOfVectorsAreNotContinuedBelowZero) {
    const SemanticVolume volume = twoRooms();
    const fields::Field field = vectorsOf([](Vec3d p) { return Vec3d{0, 10 * std::max(0.0, p.x - 0.1), 0}; });
    FieldDrawingOptions options;
    options.bands = 0.2;
    options.isolines = 0.2;
    const FieldDrawing made = drawn(planOf(volume), volume, field, options);
    ASSERT_FALSE(made.bands.empty());
    EXPECT_GE(made.bands.front().low, 0);
    for (const FieldIsoline& line : made.isolines) EXPECT_GE(line.value, 0);
    for (const FieldArrow& arrow : made.arrows) EXPECT_GE(arrow.value, 0.01 * made.high);
}

TEST(FieldDrawing, RefusesArrowsThatAreTooManyOrOfNumbers) {
    const SemanticVolume volume = twoRooms();
    const SectionDrawing drawing = planOf(volume);
    FieldDrawingOptions options;
    options.arrows = 1e-4;
    const auto many = drawField(drawing, volume, vectorsOf([](Vec3d) { return Vec3d{1, 0, 0}; }), options);
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().code(), Code::BadArgument);
    EXPECT_NE(many.error().toString().find("--arrows"), std::string::npos);
    const auto numbers = drawField(drawing, volume, fieldOf("air", [](Vec3d p) { return p.x; }), options);
    ASSERT_FALSE(numbers);
    EXPECT_EQ(numbers.error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::drawing
