// Comparisons of generated models with known changes.
#include <svt/compare/comparison.hpp>
#include <svt/compare/difference_volume.hpp>
#include <svt/compare/match/voxel_overlaps.hpp>
#include <svt/compare/shape/surface_distance.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::compare {
namespace {

constexpr double kSpacing = 0.1;

/// A box with outward faces, as a feature of a class.
struct TestBox {
    std::string id, className;
    Vec3d min, max;
    std::string name{};
};

void addFace(model::BuildingModel& model, model::Solid& solid, std::vector<Vec3d> points) {
    model::Polygon polygon;
    polygon.ringEnds = {static_cast<std::uint32_t>(points.size())};
    polygon.points = std::move(points);
    solid.exterior.push_back({model.addPolygon(std::move(polygon)), false});
}

// \param isSplit  each face as four triangles about its centre
model::BuildingModel modelOf(const std::vector<TestBox>& boxes, bool isSplit = false) {
    model::BuildingModel model;
    for (const TestBox& box : boxes) {
        model::Solid solid;
        const auto corner = [&](int c) {
            return Vec3d{c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z};
        };
        for (const auto& face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                 std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
            const Vec3d a = corner(face[0]), b = corner(face[1]), c = corner(face[2]), d = corner(face[3]);
            if (!isSplit) {
                addFace(model, solid, {a, b, c, d});
                continue;
            }
            const Vec3d middle = (a + c) / 2.0;
            addFace(model, solid, {a, b, middle});
            addFace(model, solid, {b, c, middle});
            addFace(model, solid, {c, d, middle});
            addFace(model, solid, {d, a, middle});
        }
        model::Feature feature;
        feature.id = box.id;
        feature.className = box.className;
        feature.name = box.name;
        model::Geometry geometry;
        geometry.kind = model::GeometryKind::Solid;
        geometry.solids.push_back(std::move(solid));
        feature.geometries.push_back(std::move(geometry));
        model.addFeature(std::move(feature), model::kNoFeature);
    }
    return model;
}

volume::SemanticVolume volumeOf(model::BuildingModel model, const volume::Grid* grid = nullptr) {
    pipeline::BuildOptions options;
    options.spacing = Vec3d{kSpacing, kSpacing, kSpacing};
    options.vectors.meshes = true;
    if (grid != nullptr) options.grid = *grid;
    options.extendsGrid = grid != nullptr;
    auto built = pipeline::buildVolume(model, options);
    EXPECT_TRUE(built) << built.error().toString();
    return built ? std::move(built->volume) : volume::SemanticVolume{};
}

class Compared {
public:
    Compared(const std::vector<TestBox>& before, const std::vector<TestBox>& after, CompareOptions options = {},
             bool isSplit = false)
        : was(volumeOf(modelOf(before))), is(volumeOf(modelOf(after, isSplit), &was.grid)) {
        auto result = compareVolumes(was, is, options);
        EXPECT_TRUE(result) << result.error().toString();
        if (result) comparison = std::move(*result);
    }
    /// The row of an object by its new id, else by its old one.
    [[nodiscard]] const ComparisonRow& row(const std::string& id) const {
        for (const ComparisonRow& row : comparison.rows)
            for (const std::uint32_t l : row.is)
                if (is.labels.labels[l].id == id) return row;
        for (const ComparisonRow& row : comparison.rows)
            for (const std::uint32_t l : row.was)
                if (was.labels.labels[l].id == id) return row;
        ADD_FAILURE() << "no row of " << id;
        return comparison.rows.front();
    }
    volume::SemanticVolume was, is;
    Comparison comparison;
};

const TestBox kWall{"wall", "Wall", {0, 0, 0}, {4, 0.3, 3}};
const TestBox kSlab{"slab", "Slab", {0, 0, -0.25}, {4, 5, 0}};

TEST(Comparison, OfEqualModelsFindsNothing) {
    const Compared compared({kWall, kSlab}, {kWall, kSlab});
    EXPECT_FALSE(compared.comparison.isDifferent());
    EXPECT_TRUE(compared.comparison.isOnOneLattice);
    EXPECT_EQ(compared.comparison.counts[std::size_t(Change::Same)], 2u);
    EXPECT_EQ(compared.row("wall").distance, 0.0);
}

TEST(Comparison, IgnoresIdsTrianglesAndOrder) {
    TestBox wall = kWall, slab = kSlab;
    wall.id = "1";
    slab.id = "2";
    const Compared compared({kWall, kSlab}, {slab, wall}, {}, true);
    EXPECT_FALSE(compared.comparison.isDifferent());
    EXPECT_TRUE(compared.row("1").hasOtherId);
    EXPECT_EQ(compared.was.labels.labels[compared.row("1").was[0]].id, "wall");
    EXPECT_TRUE(compared.row("1").isExact);
    EXPECT_NEAR(compared.row("1").added.value_or(1), 0, 1e-12);
}

TEST(Comparison, FindsMoves) {
    for (const bool keepsId : {true, false})
        for (const double by : {0.02, 0.5, 7.0}) {
            TestBox moved = kWall;
            moved.min.y += by;
            moved.max.y += by;
            if (!keepsId) moved.id = "other";
            const Compared compared({kWall, kSlab}, {moved, kSlab});
            const ComparisonRow& row = compared.row(moved.id);
            ASSERT_EQ(row.change, Change::Moved) << by;
            ASSERT_TRUE(row.vector);
            EXPECT_NEAR(row.vector->y, by, 2e-6);
            EXPECT_NEAR(row.vector->x, 0, 2e-6);
            EXPECT_TRUE(row.isExact);
            EXPECT_NEAR(row.added.value_or(0), 4 * 3 * std::min(by, 0.3), 1e-4);
            EXPECT_NEAR(row.removed.value_or(0), 4 * 3 * std::min(by, 0.3), 1e-4);
            EXPECT_EQ(compared.comparison.counts[std::size_t(Change::Same)], 1u);
        }
}

// A box with another id that a quarter turn about its centre makes of the first one.
TEST(Comparison, FindsRotatedObjectsWithOtherIds) {
    const TestBox table{"table", "Furniture", {0, 0, 0}, {3, 0.4, 0.7}};
    const TestBox turned{"t2", "Furniture", {1.3, -1.3, 0}, {1.7, 1.7, 0.7}};
    const TestBox wider{"t2", "Furniture", {1.3, -1.4, 0}, {1.7, 1.6, 0.75}};
    const Compared compared({kSlab, table}, {kSlab, turned});
    const ComparisonRow& row = compared.row("t2");
    ASSERT_EQ(row.change, Change::Changed);
    EXPECT_EQ(row.was.size(), 1u);
    EXPECT_NEAR(row.added.value_or(0), 2.6 * 0.4 * 0.7, 1e-4);
    EXPECT_NEAR(row.removed.value_or(0), 2.6 * 0.4 * 0.7, 1e-4);
    EXPECT_EQ(row.rotation, 90.0);
    EXPECT_FALSE(row.vector);
    EXPECT_EQ(Compared({kSlab, table}, {kSlab, wider}).row("t2").change, Change::Added);
}

// A prism over a polygon without symmetry, turned about the vertical axis at (2, 1), and moved.
model::BuildingModel prismOf(double degrees, Vec3d move = {}, double top = 0.7) {
    model::BuildingModel model = modelOf({kSlab});
    const double angle = degrees * 3.14159265358979323846 / 180;
    const auto turned = [&](double x, double y, double z) {
        return Vec3d{2, 1, 0} + move +
               Vec3d{std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y, z};
    };
    const std::vector<std::array<double, 2>> plan{{-1, -0.5}, {1, -0.3}, {0.8, 0.4}, {0.1, 0.2}, {-0.7, 0.9}};
    model::Solid solid;
    std::vector<Vec3d> low, high;
    for (const auto& [x, y] : plan) {
        low.insert(low.begin(), turned(x, y, 0.1));
        high.push_back(turned(x, y, top));
    }
    for (std::size_t n = 0; n < plan.size(); ++n) {
        const auto& [ax, ay] = plan[n];
        const auto& [bx, by] = plan[(n + 1) % plan.size()];
        addFace(model, solid, {turned(ax, ay, 0.1), turned(bx, by, 0.1), turned(bx, by, top), turned(ax, ay, top)});
    }
    addFace(model, solid, low);
    addFace(model, solid, high);
    model::Geometry geometry;
    geometry.kind = model::GeometryKind::Solid;
    geometry.solids.push_back(std::move(solid));
    model::Feature feature;
    feature.id = "prism";
    feature.className = "Furniture";
    feature.geometries.push_back(std::move(geometry));
    model.addFeature(std::move(feature), model::kNoFeature);
    return model;
}

TEST(Comparison, StatesTheAngleOfTurnedObjects) {
    const auto was = volumeOf(prismOf(0));
    const auto rowOf = [&](model::BuildingModel model) {
        const auto is = volumeOf(std::move(model), &was.grid);
        const auto comparison = compareVolumes(was, is);
        EXPECT_TRUE(comparison);
        for (const ComparisonRow& row : comparison->rows)
            if (!row.is.empty() && is.labels.labels[row.is[0]].id == "prism") return row;
        return ComparisonRow();
    };
    for (const double degrees : {3.0, 45.0, -120.0, 180.0}) {
        const ComparisonRow row = rowOf(prismOf(degrees));
        EXPECT_EQ(row.change, Change::Changed) << degrees;
        EXPECT_NEAR(row.rotation.value_or(0), degrees, 0.002) << degrees;
    }
    const ComparisonRow moved = rowOf(prismOf(30, {1, 0, 0}));
    EXPECT_NEAR(moved.rotation.value_or(0), 30, 0.002);
    EXPECT_FALSE(moved.vector) << "the place of the axis is not known";
    EXPECT_FALSE(rowOf(prismOf(0, {1, 0, 0})).rotation) << "it moved";
    EXPECT_FALSE(rowOf(prismOf(30, {}, 0.75)).rotation) << "it has another shape";
}

TEST(Comparison, KeepsMovesBelowTheTolerance) {
    TestBox moved = kWall;
    moved.min.y += 0.005;
    moved.max.y += 0.005;
    EXPECT_EQ(Compared({kWall}, {moved}).row("wall").change, Change::Same);
    CompareOptions fine;
    fine.tolerance = 0.002;
    const Compared compared({kWall}, {moved}, fine);
    EXPECT_EQ(compared.row("wall").change, Change::Moved);
    EXPECT_NEAR(compared.row("wall").vector->y, 0.005, 2e-6);
}

TEST(Comparison, MeasuresOtherShapes) {
    TestBox longer = kWall;
    longer.max.x = 4.5;
    const Compared compared({kWall, kSlab}, {longer, kSlab});
    const ComparisonRow& row = compared.row("wall");
    EXPECT_EQ(row.change, Change::Changed);
    EXPECT_NEAR(row.added.value_or(0), 0.5 * 0.3 * 3, 1e-4);
    EXPECT_NEAR(row.removed.value_or(1), 0, 1e-9);
    EXPECT_NEAR(row.distance.value_or(0), 0.5, 1e-6);
    EXPECT_LT(row.bound.value_or(1), 1e-3);
}

// A plate of 20 mm with a hole of 100 x 100 mm: all corners of the new faces lie on old faces.
TEST(Comparison, FindsASmallHole) {
    const TestBox plate{"plate", "Slab", {0, 0, 0}, {2, 1, 0.02}};
    auto holed = modelOf({plate});
    const auto square = [](double a, double b, double z) {
        return std::vector<Vec3d>{{a, a, z}, {b, a, z}, {b, b, z}, {a, b, z}};
    };
    for (const bool isTop : {false, true}) {
        model::Polygon& face = holed.polygons[isTop ? 1 : 0];
        std::vector<Vec3d> ring = square(0.4, 0.5, isTop ? 0.02 : 0);
        if (isTop) std::reverse(ring.begin(), ring.end());
        face.points.insert(face.points.end(), ring.begin(), ring.end());
        face.ringEnds.push_back(static_cast<std::uint32_t>(face.points.size()));
    }
    const auto low = square(0.4, 0.5, 0), high = square(0.4, 0.5, 0.02);
    for (std::size_t n = 0; n < 4; ++n)
        addFace(holed, holed.features[0].geometries[0].solids[0],
                {low[(n + 1) % 4], low[n], high[n], high[(n + 1) % 4]});
    const auto was = volumeOf(modelOf({plate})), is = volumeOf(holed, &was.grid);
    const auto comparison = compareVolumes(was, is);
    ASSERT_TRUE(comparison);
    const ComparisonRow& row = comparison->rows.front();
    EXPECT_EQ(row.change, Change::Changed);
    EXPECT_TRUE(row.isExact);
    EXPECT_NEAR(row.removed.value_or(0), 0.1 * 0.1 * 0.02, 2e-5);
    EXPECT_GT(row.distance.value_or(0), 0.03);
    EXPECT_LE(row.distance.value_or(1), 0.0501);
}

TEST(Comparison, FindsAddedAndRemovedObjects) {
    const TestBox column{"column", "Column", {2, 2, 0}, {2.4, 2.4, 3}};
    const Compared compared({kWall, column}, {kWall, kSlab});
    EXPECT_EQ(compared.row("column").change, Change::Removed);
    EXPECT_NEAR(compared.row("column").removed.value_or(0), 0.4 * 0.4 * 3, 1e-5);
    EXPECT_EQ(compared.row("slab").change, Change::Added);
    EXPECT_NEAR(compared.row("slab").added.value_or(0), 4 * 5 * 0.25, 1e-4);
}

TEST(Comparison, FindsSplitsAndMerges) {
    TestBox left = kWall, right = kWall;
    right.id = "right";
    left.max.x = right.min.x = 2.5;
    const Compared split({kWall, kSlab}, {left, right, kSlab});
    EXPECT_EQ(split.row("right").change, Change::Split);
    EXPECT_EQ(split.row("right").is.size(), 2u);
    EXPECT_NEAR(split.row("right").added.value_or(1) + split.row("right").removed.value_or(1), 0, 1e-9);
    const Compared merged({left, right, kSlab}, {kWall, kSlab});
    EXPECT_EQ(merged.row("wall").change, Change::Merged);
    EXPECT_EQ(merged.row("wall").was.size(), 2u);
}

// One format has a window as a frame, another one as a solid of another class.
TEST(Comparison, MatchesNamesInOnePlace) {
    const TestBox frame{"w", "Window", {1, 0.1, 1}, {2, 0.2, 2}, "Window 1"};
    const TestBox solid{"1", "Element", {1, 0.05, 1}, {2, 0.25, 2}, "Window 1"};
    const Compared compared({kSlab, frame}, {kSlab, solid});
    EXPECT_EQ(compared.row("1").change, Change::Changed);
    EXPECT_TRUE(compared.row("1").hasOtherClass);
    EXPECT_NEAR(compared.row("1").added.value_or(0), 0.1, 1e-5);
    TestBox twin = frame, apart = solid;
    twin.id = "twin";
    twin.min.x += 1.5;
    twin.max.x += 1.5;
    EXPECT_EQ(Compared({kSlab, frame, twin}, {kSlab, solid}).row("1").change, Change::Added) << "which of the two?";
    apart.min.x = 1.6;
    apart.max.x = 2.6;
    EXPECT_EQ(Compared({kSlab, frame}, {kSlab, apart}).row("1").change, Change::Added);
}

// A wall that grew over its neighbour's old place, while the neighbour went on elsewhere.
TEST(Comparison, DoesNotMergeObjectsThatGoOn) {
    TestBox left = kWall, right = kWall, below = kWall;
    right.id = below.id = "right";
    left.max.x = right.min.x = 2.5;
    below.min.x = 0.5;
    below.min.y = -0.4;
    below.max.y = -0.1;
    const Compared compared({left, right, kSlab}, {kWall, below, kSlab});
    EXPECT_EQ(compared.row("wall").change, Change::Changed);
    EXPECT_EQ(compared.row("right").change, Change::Changed);
    EXPECT_EQ(compared.row("right").was.size(), 1u);
    TestBox renewed = below;
    renewed.id = "other";
    EXPECT_EQ(Compared({left, right, kSlab}, {kWall, renewed, kSlab}).row("wall").change, Change::Merged);
}

TEST(Comparison, FindsOtherNamesClassesAndOwnersOfSpace) {
    TestBox renamed = kWall, other = kSlab;
    renamed.name = "W1";
    other.id = "roof";
    other.className = "Roof";
    const Compared compared({kWall, kSlab}, {renamed, other});
    EXPECT_EQ(compared.row("wall").change, Change::Same);
    EXPECT_TRUE(compared.row("wall").hasOtherName);
    EXPECT_EQ(compared.row("roof").change, Change::Reassigned);
    EXPECT_TRUE(compared.row("roof").hasOtherClass);
    EXPECT_TRUE(compared.comparison.isDifferent());
}

// Two equal boxes at one place, and the nearer of two shapes that moved.
TEST(Comparison, PrefersTheSameIdThenTheNearest) {
    TestBox twin = kWall;
    twin.id = "twin";
    const Compared doubled({kWall, twin}, {twin, kWall});
    EXPECT_FALSE(doubled.row("wall").hasOtherId);
    EXPECT_FALSE(doubled.row("twin").hasOtherId);
    const auto boxAt = [](const std::string& id, double x) {
        return TestBox{id, "Column", {x, 0, 0}, {x + 0.4, 0.4, 3}};
    };
    CompareOptions bySpace;
    bySpace.match = MatchBy::Space;
    const Compared moved({boxAt("a", 0), boxAt("b", 10)}, {boxAt("c", 11), boxAt("d", 1)}, bySpace);
    EXPECT_NEAR(moved.row("c").vector.value_or(Vec3d{}).x, 1, 1e-5);
    EXPECT_NEAR(moved.row("d").vector.value_or(Vec3d{}).x, 1, 1e-5);
}

TEST(Comparison, FollowsIdsThatMovedIntoEachOthersPlace) {
    const auto boxAt = [](const std::string& id, double x) {
        return TestBox{id, "Column", {x, 0, 0}, {x + 0.4, 0.4, 3}};
    };
    const Compared compared({boxAt("a", 0), boxAt("b", 2)}, {boxAt("a", 2), boxAt("b", 4)});
    EXPECT_EQ(compared.row("a").change, Change::Moved);
    EXPECT_EQ(compared.row("b").change, Change::Moved);
    CompareOptions bySpace;
    bySpace.match = MatchBy::Space;
    const Compared space({boxAt("a", 0), boxAt("b", 2)}, {boxAt("a", 2), boxAt("b", 4)}, bySpace);
    EXPECT_EQ(space.comparison.counts[std::size_t(Change::Same)], 1u);
    EXPECT_EQ(space.comparison.counts[std::size_t(Change::Moved)], 1u);
}

TEST(Comparison, TakesManyEqualObjectsInSeconds) {
    std::vector<TestBox> before, after;
    for (int n = 0; n < 2000; ++n) {
        const double x = n % 50 * 0.3, y = n / 50 % 40 * 0.3;
        before.push_back({"old" + std::to_string(n), "Brick", {x, y, 0}, {x + 0.2, y + 0.2, 0.2}});
        after.push_back({"new" + std::to_string(n), "Brick", {x, y, 1}, {x + 0.2, y + 0.2, 1.2}});
    }
    const Compared compared(before, after);
    EXPECT_EQ(compared.comparison.counts[std::size_t(Change::Moved)], 2000u);
    for (const ComparisonRow& row : compared.comparison.rows) {
        ASSERT_TRUE(row.vector);
        EXPECT_NEAR(length(*row.vector - Vec3d{0, 0, 1}), 0, 1e-5);
    }
}

TEST(Comparison, RefusesOtherReferenceSystemsAndTolerances) {
    Compared compared({kWall}, {kWall});
    CompareOptions options;
    options.tolerance = 0;
    EXPECT_EQ(compareVolumes(compared.was, compared.is, options).error().code(), Code::BadArgument);
    compared.was.crsName = "EPSG:25832";
    compared.is.crsName = "urn:ogc:def:crs:EPSG::25832";
    EXPECT_TRUE(compareVolumes(compared.was, compared.is));
    compared.is.crsName = "EPSG:25833";
    EXPECT_EQ(compareVolumes(compared.was, compared.is).error().code(), Code::BadArgument);
}

// Without meshes, voxels decide, and their bound is unknown.
TEST(Comparison, CountsVoxelsWithoutMeshes) {
    TestBox longer = kWall;
    longer.max.x = 4.5;
    auto was = volumeOf(modelOf({kWall, kSlab})), is = volumeOf(modelOf({longer, kSlab}), &was.grid);
    was.vectors = is.vectors = {};
    const auto comparison = compareVolumes(was, is);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->counts[std::size_t(Change::Same)], 1u);
    for (const ComparisonRow& row : comparison->rows)
        if (row.change != Change::Same) {
            EXPECT_EQ(row.change, Change::Changed);
            EXPECT_NEAR(row.added.value_or(0), 0.5 * 0.3 * 3, 1e-9);
            EXPECT_EQ(row.removed, 0.0);
            EXPECT_FALSE(row.bound || row.distance || row.vector || row.isExact);
        }
}

// Storeys have rows of their own, and give their objects another storey.
TEST(Comparison, FindsRenamedGroupsAndOtherStoreys) {
    const auto modelWith = [](const std::string& name, bool isAbove) {
        auto model = modelOf({kWall, kSlab});
        for (const char* id : {"low", "high"}) {
            model::Feature storey;
            storey.id = id;
            storey.className = "Storey";
            storey.name = std::string(id) == "low" ? name : "Upper floor";
            model.addFeature(std::move(storey), model::kNoFeature);
        }
        // The wall belongs to one of the storeys.
        model.memberships.push_back({isAbove ? 3u : 2u, 0u, {}});
        return model;
    };
    const auto was = volumeOf(modelWith("Ground", false)), is = volumeOf(modelWith("Ground floor", true), &was.grid);
    const auto comparison = compareVolumes(was, is);
    ASSERT_TRUE(comparison);
    std::size_t groups = 0;
    for (const ComparisonRow& row : comparison->rows) {
        ASSERT_EQ(row.is.size(), 1u);
        const std::string& id = is.labels.labels[row.is[0]].id;
        EXPECT_EQ(row.change, Change::Same) << id;
        EXPECT_EQ(row.hasOtherStorey, id == "wall") << id;
        EXPECT_EQ(row.hasOtherName, id == "low") << id;
        groups += row.hasGeometry ? 0 : 1;
    }
    EXPECT_EQ(groups, 2u);
    EXPECT_EQ(comparison->otherProperties, 2u);
    CompareOptions none;
    none.properties = Properties::None;
    EXPECT_FALSE(compareVolumes(was, is, none)->isDifferent());
}

// The caps of an open shell have numbers that depend on the rest of the file.
TEST(Comparison, HasNoRowsOfCaps) {
    auto open = modelOf({kWall, kSlab});
    open.features[0].geometries[0].solids[0].exterior.pop_back();
    const auto was = volumeOf(std::move(open)), is = volumeOf(modelOf({kSlab}), &was.grid);
    ASSERT_TRUE(std::any_of(was.labels.labels.begin(), was.labels.labels.end(),
                            [](const volume::Label& label) { return label.className == "ClosureSurface"; }));
    const auto comparison = compareVolumes(was, is);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->rows.size(), 2u);
    EXPECT_EQ(comparison->counts[std::size_t(Change::Removed)], 1u);
    EXPECT_EQ(comparison->groups[std::size_t(Change::Removed)], 0u);
}

// Another program may write numbers with 32 bits.
TEST(Comparison, IgnoresTheRoundingOfAttributes) {
    const auto modelWith = [](double height, const std::string& unit) {
        auto model = modelOf({kWall});
        model.features[0].attributes = {{"height", height, unit}, {"rating", std::string("F90")}};
        return model;
    };
    const auto was = volumeOf(modelWith(1.82, "m"));
    const auto attributesOf = [&](double height, const std::string& unit) {
        const auto comparison = compareVolumes(was, volumeOf(modelWith(height, unit), &was.grid));
        EXPECT_TRUE(comparison);
        return comparison->rows.front().attributes.size();
    };
    EXPECT_EQ(attributesOf(double(1.82F), "m"), 0u);
    EXPECT_EQ(attributesOf(1.8200009, "m"), 1u);
    EXPECT_EQ(attributesOf(1.82, "mm"), 1u);
}

// Features without geometry, with the members that are boxes.
struct TestGroup {
    std::string id, name;
    int parent = -1;  // a group
    std::vector<std::uint32_t> members{};
    std::string className = "Zone";
};

Comparison compareGroups(const std::vector<TestGroup>& before, const std::vector<TestGroup>& after,
                         MatchBy match = MatchBy::Both) {
    const auto modelWith = [](const std::vector<TestGroup>& groups) {
        auto model = modelOf({kWall, kSlab});
        for (const TestGroup& group : groups) {
            model::Feature feature;
            feature.id = group.id;
            feature.className = group.className;
            feature.name = group.name;
            const auto number = static_cast<std::uint32_t>(model.features.size());
            model.addFeature(std::move(feature),
                             group.parent < 0 ? model::kNoFeature : static_cast<std::uint32_t>(2 + group.parent));
            for (const std::uint32_t member : group.members) model.memberships.push_back({number, member, {}});
        }
        return model;
    };
    const auto was = volumeOf(modelWith(before)), is = volumeOf(modelWith(after), &was.grid);
    CompareOptions options;
    options.match = match;
    auto comparison = compareVolumes(was, is, options);
    EXPECT_TRUE(comparison);
    return comparison ? std::move(*comparison) : Comparison{};
}

// All ids are new. Names are unique only below their parents.
TEST(Comparison, MatchesGroupsByTheirParents) {
    const std::vector<TestGroup> before{{"a", "North"}, {"b", "South"}, {"c", "Flat", 0}, {"d", "Flat", 1}};
    const std::vector<TestGroup> after{{"1", "South"}, {"2", "North"}, {"3", "Flat", 1}, {"4", "Flat", 0}};
    const Comparison comparison = compareGroups(before, after);
    EXPECT_FALSE(comparison.isDifferent());
    EXPECT_EQ(comparison.groups[std::size_t(Change::Same)], 4u);
    EXPECT_EQ(comparison.ambiguousGroups, 0u);
    EXPECT_TRUE(compareGroups(before, after, MatchBy::Id).isDifferent());
}

// All ids and names are new, so members decide, and nothing for the empty group.
TEST(Comparison, MatchesGroupsByTheirMembers) {
    const Comparison comparison = compareGroups(
        {{"a", "Upper floor", -1, {0}, "Storey"}, {"b", "Ground", -1, {1}, "Storey"}, {"c", "Roof", -1, {}, "Storey"}},
        {{"1", "Ground floor", -1, {1}, "Storey"}, {"2", "First floor", -1, {0}, "Storey"}});
    EXPECT_EQ(comparison.groups[std::size_t(Change::Same)], 2u);
    EXPECT_EQ(comparison.groups[std::size_t(Change::Removed)], 1u);
    EXPECT_EQ(comparison.groups[std::size_t(Change::Added)], 0u);
    EXPECT_EQ(comparison.properties.names, 2u);
    EXPECT_EQ(comparison.properties.storeys, 0u) << "walls and slabs stay in their storeys";
    EXPECT_EQ(comparison.otherProperties, 2u);
}

// Any pairs of equal groups without members give the same result. Others have several partners, which the result states.
TEST(Comparison, MatchesOnlyGroupsWithoutAChoice) {
    const Comparison equal = compareGroups({{"a", ""}, {"b", ""}, {"c", ""}}, {{"1", ""}, {"2", ""}});
    EXPECT_EQ(equal.groups[std::size_t(Change::Same)], 2u);
    EXPECT_EQ(equal.groups[std::size_t(Change::Removed)], 1u);
    EXPECT_EQ(equal.ambiguousGroups, 0u);
    const Comparison several = compareGroups({{"a", "", -1, {0}}, {"b", "", -1, {0}}}, {{"1", "", -1, {0}}, {"2", ""}});
    EXPECT_EQ(several.groups[std::size_t(Change::Removed)], 2u);
    EXPECT_EQ(several.groups[std::size_t(Change::Added)], 2u);
    EXPECT_EQ(several.ambiguousGroups, 4u);
}

TEST(DifferenceVolume, CountsTheSpaceThatChanged) {
    TestBox longer = kWall;
    longer.max.x = 4.5;
    const TestBox column{"column", "Column", {2, 2, 0}, {2.4, 2.4, 3}};
    const TestBox slab{"slab", "Slab", {0, 0, -0.3}, {4, 5, 0}};
    const Compared compared({kWall, column, slab}, {longer, slab});
    const auto difference = makeDifferenceVolume(compared.was, compared.is, compared.comparison);
    ASSERT_TRUE(difference) << difference.error().toString();
    const auto volumeOfPart = [&](const std::string& id) {
        for (const volume::Label& label : difference->labels.labels)
            if (label.id == id) return double(label.voxels) * difference->grid.voxelVolume();
        ADD_FAILURE() << id;
        return 0.0;
    };
    EXPECT_NEAR(volumeOfPart("wall/added"), 0.5 * 0.3 * 3, 1e-9);
    EXPECT_NEAR(volumeOfPart("wall/removed"), 0, 1e-9);
    EXPECT_NEAR(volumeOfPart("wall"), 4 * 0.3 * 3, 1e-9);
    EXPECT_NEAR(volumeOfPart("column"), 0.4 * 0.4 * 3, 1e-9);
    EXPECT_NEAR(volumeOfPart("slab"), 4 * 5 * 0.3, 1e-9);
    for (const volume::Label& label : difference->labels.labels) {
        const bool isPart = label.id.find('/') != std::string::npos || label.id == "wall";
        if (label.count > 0) {
            EXPECT_EQ(volume::hasClosedMesh(label.filling), !isPart) << label.id;
        }
    }
    EXPECT_EQ(difference->grid.dimension(), compared.was.grid.dimension() + (Vec3i{5, 0, 0}));
}

// A face that is off by 1 mm does not hide a move.
TEST(Comparison, FindsMovesOfRoundedShapes) {
    TestBox moved = kWall;
    moved.min.y += 0.5;
    moved.max.y += 0.5;
    moved.max.x += 0.001;
    const Compared compared({kWall, kSlab}, {moved, kSlab});
    EXPECT_EQ(compared.row("wall").change, Change::Moved);
}

// A sheet that became two close ones has another shape, wherever it is.
TEST(Comparison, DoesNotTakeADoubledSheetForAMovedOne) {
    const auto sheets = [](double z, int count) {
        model::BuildingModel model = modelOf({kSlab});
        model::Geometry geometry;
        for (int n = 0; n < count; ++n) {
            model::Polygon polygon;
            const double at = z + 0.001 * n;
            polygon.points = {{0, 0, at}, {2, 0, at}, {2, 2, at}, {0, 2, at}};
            polygon.ringEnds = {4};
            geometry.surfaces.push_back({model.addPolygon(std::move(polygon)), false});
        }
        model::Feature feature;
        feature.id = "sheet";
        feature.className = "FloorSurface";
        feature.geometries.push_back(std::move(geometry));
        model.addFeature(std::move(feature), model::kNoFeature);
        return model;
    };
    const auto was = volumeOf(sheets(1, 1)), is = volumeOf(sheets(1.5, 2), &was.grid);
    const auto comparison = compareVolumes(was, is);
    ASSERT_TRUE(comparison);
    for (const ComparisonRow& row : comparison->rows)
        if (!row.is.empty() && is.labels.labels[row.is[0]].id == "sheet") {
            EXPECT_EQ(row.change, Change::Changed);
        }
}

// Surfaces have no volume that shows a hole. All corners of the new face lie on the old one.
TEST(Comparison, FindsAHoleInASurface) {
    const auto wall = [](std::optional<double> holeAt) {
        model::BuildingModel model = modelOf({kSlab});
        model::Polygon face;
        const auto add = [&](std::vector<Vec3d> ring) {
            face.points.insert(face.points.end(), ring.begin(), ring.end());
            face.ringEnds.push_back(static_cast<std::uint32_t>(face.points.size()));
        };
        add({{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}});
        if (holeAt) {
            const double a = *holeAt, b = *holeAt + 0.3;
            add({{a, 0, 1}, {a, 0, 1.3}, {b, 0, 1.3}, {b, 0, 1}});
        }
        model::Geometry geometry;
        geometry.surfaces.push_back({model.addPolygon(std::move(face)), false});
        model::Feature feature;
        feature.id = "wall";
        feature.className = "WallSurface";
        feature.geometries.push_back(std::move(geometry));
        model.addFeature(std::move(feature), model::kNoFeature);
        return volumeOf(std::move(model));
    };
    const auto changeOf = [](const volume::SemanticVolume& was, const volume::SemanticVolume& is) {
        const auto comparison = compareVolumes(was, is);
        EXPECT_TRUE(comparison);
        for (const ComparisonRow& row : comparison->rows)
            if (!row.is.empty() && is.labels.labels[row.is[0]].id == "wall") return row;
        return ComparisonRow();
    };
    const auto plain = wall({}), left = wall(0.41), right = wall(2.87);
    EXPECT_EQ(changeOf(plain, plain).change, Change::Same);
    for (const auto& [was, is] : {std::pair(&plain, &left), std::pair(&left, &plain), std::pair(&left, &right)}) {
        const ComparisonRow row = changeOf(*was, *is);
        EXPECT_EQ(row.change, Change::Changed);
        EXPECT_FALSE(row.added) << "a surface has no volume";
        EXPECT_NEAR(row.distance.value_or(0), 0.15, 0.02);
    }
}

TEST(Shapes, DifferInDigestsOfAnyCorner) {
    volume::SemanticVolume volume;
    volume.labels.labels.resize(2);
    for (std::uint32_t l = 0; l < 2; ++l) volume.labels.labels[l].subtreeEnd = l + 1;
    volume.vectors.points = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {5, 5, 5}};
    volume.vectors.triangles = {{0, {3, 1, 2}}, {1, {0, 1, 2}}};
    const auto shapes = findShapes(volume, {});
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_NE(shapes[0].digest, shapes[1].digest);
    volume.vectors.triangles[0].corners = {1, 2, 0};
    const auto same = findShapes(volume, {});
    EXPECT_EQ(same[0].digest, same[1].digest);
}

// Area and volume of a turned box are the same, but not its moments.
TEST(Shapes, OfTurnedObjectsAreNotAlike) {
    const auto volume = volumeOf(modelOf({{"a", "Column", {0, 0, 0}, {1, 2, 3}},
                                          {"b", "Column", {5, 0, 0}, {7, 1, 3}},
                                          {"c", "Column", {9, 0, 0}, {10, 2, 3}}}));
    const auto shapes = findShapes(volume, {});
    ASSERT_EQ(shapes.size(), 3u);
    EXPECT_FALSE(areAlike(shapes[0], shapes[1], 0.01));
    EXPECT_TRUE(areAlike(shapes[0], shapes[2], 0.01));
    EXPECT_TRUE(areAlikeTurned(shapes[0], shapes[1], 0.01));
    EXPECT_TRUE(areAlikeTurned(shapes[0], shapes[2], 0.01));
}

// Two plates farther apart have the same area, volume and centre. Only one moment differs.
TEST(Shapes, OfPartsFartherApartAreNotAlike) {
    const auto plates = [](int axis, double apart) {
        TestBox low{"a", "Column", {0, 0, 0}, {1, 1, 1}}, high = low;
        low.max[axis] = 0.1;
        high.min[axis] = apart;
        high.max[axis] = apart + 0.1;
        auto model = modelOf({low, high});
        auto& solids = model.features[0].geometries[0].solids;
        solids.push_back(model.features[1].geometries[0].solids[0]);
        model.features.pop_back();
        model.roots.pop_back();
        return findShapes(volumeOf(std::move(model)), {});
    };
    for (int axis = 0; axis < 3; ++axis) {
        const auto near = plates(axis, 2), far = plates(axis, 3);
        ASSERT_EQ(near.size(), 1u);
        ASSERT_EQ(far.size(), 1u);
        EXPECT_NEAR(near[0].area, far[0].area, 1e-6);
        EXPECT_FALSE(areAlike(near[0], far[0], 0.01));
        EXPECT_FALSE(areAlikeTurned(near[0], far[0], 0.01));
        EXPECT_FALSE(agreeWithin(near[0], far[0], 0.01, far[0].center - near[0].center));
        EXPECT_TRUE(areAlike(near[0], near[0], 0.01));
    }
}

TEST(FaceTree, OfOneTriangleGivesItsDistance) {
    volume::VectorParts parts;
    parts.unit = 0x1p-10;
    parts.points = {{0, 0, 0}, {1024, 0, 0}, {0, 1024, 0}};
    parts.triangles = {{0, {0, 1, 2}}};
    const FaceTree tree(Faces{parts.triangles, &parts, {}});
    EXPECT_DOUBLE_EQ(tree.distanceTo({0.25, 0.25, 2}), 2);
    EXPECT_DOUBLE_EQ(tree.distanceTo({-3, 0, 4}), 5);
}

TEST(VoxelOverlaps, CountOnlyPairsWithAWantedLabel) {
    const Compared compared({kWall, kSlab}, {kWall, kSlab});
    const auto label = [&](const std::string& id) {
        for (std::uint32_t l = 0; l < compared.was.labels.labels.size(); ++l)
            if (compared.was.labels.labels[l].id == id) return l;
        return volume::kNoLabel;
    };
    std::vector<char> isWanted(compared.was.labels.labels.size(), 0);
    isWanted[label("wall")] = 1;
    const std::vector<char> none(isWanted.size(), 0);
    for (const bool isOfWas : {true, false}) {
        const VoxelOverlaps overlaps(compared.was, compared.is, isOfWas ? isWanted : none, isOfWas ? none : isWanted);
        ASSERT_EQ(overlaps.entries().size(), 1u);
        EXPECT_EQ(overlaps.entries()[0].was, label("wall"));
        EXPECT_EQ(overlaps.of(label("wall"), label("wall")), compared.was.labels.labels[label("wall")].voxels);
        EXPECT_EQ(overlaps.of(label("slab"), label("slab")), 0u);
    }
}

TEST(EstimatedTranslation, IsThatOfMostObjects) {
    const Vec3d by{12.5, -3.25, 0.5};
    std::vector<TestBox> before, after;
    for (int n = 0; n < 9; ++n) {
        before.push_back({"b" + std::to_string(n), "Wall", {n * 1.0, 0, 0}, {n + 0.2, 1.0 + n * 0.1, 3}});
        after.push_back(before.back());
        const Vec3d shift = n < 7 ? by : Vec3d{1, 1, 1};
        after.back().min = after.back().min + shift;
        after.back().max = after.back().max + shift;
    }
    const auto was = volumeOf(modelOf(before)), is = volumeOf(modelOf(after));
    const auto offset = estimateTranslation(was, is, 0.01);
    ASSERT_TRUE(offset);
    EXPECT_NEAR(length(*offset - by), 0, 1e-5);
    const auto back = translated(is, -*offset);
    ASSERT_TRUE(back);
    const auto comparison = compareVolumes(was, *back);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->counts[std::size_t(Change::Same)], 7u);
    EXPECT_EQ(comparison->counts[std::size_t(Change::Moved)], 2u);
}

}  // namespace
}  // namespace svt::compare
