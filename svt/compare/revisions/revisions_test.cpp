// Changes in drawings, and files that keep both states.
#include <svt/compare/difference_volume.hpp>
#include <svt/compare/revisions.hpp>
#include <svt/compare/revisions/changed_lines.hpp>
#include <svt/compare/states_file.hpp>

#include <svt/core/file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/model/building_model.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/zip_entries.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace svt::compare {
namespace {

struct RevisedBox {
    std::string id, className;
    Vec3d min, max;
};

model::Solid solidOf(model::BuildingModel& model, const RevisedBox& box) {
    model::Solid solid;
    const auto corner = [&](int c) {
        return Vec3d{c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z};
    };
    for (const auto& face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                             std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
        model::Polygon polygon;
        for (const int c : face) polygon.points.push_back(corner(c));
        polygon.ringEnds = {4};
        solid.exterior.push_back({model.addPolygon(std::move(polygon)), false});
    }
    return solid;
}

volume::SemanticVolume boxVolume(const std::vector<RevisedBox>& boxes, const volume::Grid* grid = nullptr) {
    model::BuildingModel model;
    for (const RevisedBox& box : boxes) {
        model::Feature feature;
        feature.id = box.id;
        feature.className = box.className;
        model::Geometry geometry;
        geometry.kind = model::GeometryKind::Solid;
        geometry.solids.push_back(solidOf(model, box));
        feature.geometries.push_back(std::move(geometry));
        model.addFeature(std::move(feature), model::kNoFeature);
    }
    pipeline::BuildOptions options;
    options.spacing = Vec3d{0.1, 0.1, 0.1};
    options.vectors.meshes = true;
    if (grid != nullptr) options.grid = *grid;
    options.extendsGrid = grid != nullptr;
    auto built = pipeline::buildVolume(model, options);
    EXPECT_TRUE(built) << built.error().toString();
    return built ? std::move(built->volume) : volume::SemanticVolume{};
}

const std::string kElement = "BuildingConstructiveElement";
const RevisedBox kPlate{"plate", kElement, {0, 0, 0}, {10, 8, 0.2}};

/// Two states, and the plan of both 1 m above the lower corner.
struct RevisedPlan {
    RevisedPlan(const std::vector<RevisedBox>& before, const std::vector<RevisedBox>& after)
        : was(boxVolume(before)), is(boxVolume(after, &was.grid)) {
        auto result = compareVolumes(was, is);
        EXPECT_TRUE(result) << result.error().toString();
        comparison = std::move(*result);
        drawing::SectionOptions options;
        options.beyond.visible = true;
        const drawing::SectionPlane plane{{0, 0, 1}, {0, 0, 1}};
        auto old = drawing::drawSection(was, plane, options);
        auto now = drawing::drawSection(is, plane, options);
        EXPECT_TRUE(old && now);
        drawn = std::move(*now);
        drawing::SectionDrawing* const drawings[] = {&drawn};
        revisions = markRevisions({was, is, comparison}, std::span(&*old, 1), drawings);
    }
    volume::SemanticVolume was, is;
    Comparison comparison;
    drawing::SectionDrawing drawn;
    std::vector<drawing::Revision> revisions;
};

double lengthOf(const std::vector<Line>& lines) {
    double length = 0;
    for (const Line& line : lines) length += std::hypot(line.to.u - line.from.u, line.to.v - line.from.v);
    return length;
}

TEST(ChangedLines, AreThePartsThatTheOthersLack) {
    const Line line{{0, 0}, {10, 0}};
    std::vector<Line> parts;
    addMissingParts(line, std::vector<Line>{{{2, 0.001}, {4, 0.001}}, {{3, 0}, {6, 0}}}, 0.01, parts);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_NEAR(parts[0].to.u, 2, 0.02);
    EXPECT_NEAR(parts[1].from.u, 6, 0.02);
    parts.clear();
    // A line across it, and one beside it, are others.
    addMissingParts(line, std::vector<Line>{{{5, -1}, {5, 1}}, {{0, 0.5}, {10, 0.5}}}, 0.01, parts);
    EXPECT_NEAR(lengthOf(parts), 10, 1e-9);
    parts.clear();
    addMissingParts(line, std::vector<Line>{{{12, 0}, {-1, 0}}}, 0.01, parts);
    EXPECT_TRUE(parts.empty());
}

TEST(Revisions, OfALongerWallAreItsNewEndOnly) {
    const RevisedPlan plan({kPlate, {"wall", kElement, {1, 1, 0.2}, {5, 1.3, 3}}},
                           {kPlate, {"wall", kElement, {1, 1, 0.2}, {7, 1.3, 3}}});
    ASSERT_EQ(plan.revisions.size(), 1u);
    EXPECT_EQ(plan.revisions[0].number, 1u);
    EXPECT_EQ(plan.revisions[0].change, "changed");
    EXPECT_EQ(plan.revisions[0].object, "wall");
    EXPECT_NEAR(*plan.revisions[0].added, 2 * 0.3 * 2.8, 1e-4);
    ASSERT_EQ(plan.drawn.revisions.size(), 1u);
    // Two sides of 2 m and the new end; the old end was removed.
    EXPECT_NEAR(lengthOf(plan.drawn.revisions[0].added), 4.3, 0.03);
    EXPECT_NEAR(lengthOf(plan.drawn.revisions[0].removed), 0.3, 0.02);
}

TEST(Revisions, CountOnlyWhatTheDrawingsShow) {
    const RevisedBox low{"low", kElement, {1, 1, 0.2}, {2, 2, 0.6}};
    const RevisedBox high{"high", kElement, {4, 4, 2}, {5, 5, 2.5}};  // above the cut
    const RevisedPlan plan({kPlate, low, high}, {kPlate});
    ASSERT_EQ(plan.revisions.size(), 2u);
    EXPECT_EQ(plan.revisions[0].object, "low");
    EXPECT_EQ(plan.revisions[0].number, 1u);
    EXPECT_EQ(plan.revisions[0].change, "removed");
    EXPECT_NEAR(*plan.revisions[0].removed, 0.4, 1e-4);
    EXPECT_EQ(plan.revisions[1].object, "high");
    EXPECT_EQ(plan.revisions[1].number, 0u) << "no drawing shows it";
    ASSERT_EQ(plan.drawn.revisions.size(), 1u);
    EXPECT_NEAR(lengthOf(plan.drawn.revisions[0].removed), 4, 0.01);
    EXPECT_TRUE(plan.drawn.revisions[0].added.empty());
}

TEST(Revisions, OfARoomAreThoseOfItsWall) {
    const RevisedPlan plan(
        {kPlate, {"room", "BuildingRoom", {1, 1, 0.2}, {5, 5, 3}}, {"wall", kElement, {5, 1, 0.2}, {5.2, 5, 3}}},
        {kPlate, {"room", "BuildingRoom", {1, 1, 0.2}, {6, 5, 3}}, {"wall", kElement, {6, 1, 0.2}, {6.2, 5, 3}}});
    ASSERT_EQ(plan.revisions.size(), 1u);
    EXPECT_EQ(plan.revisions[0].object, "wall");
    // A room that changes on its own has a mark.
    const RevisedPlan alone({kPlate, {"room", "BuildingRoom", {1, 1, 0.2}, {5, 5, 3}}},
                            {kPlate, {"room", "BuildingRoom", {1, 1, 0.2}, {6, 5, 3}}});
    ASSERT_EQ(alone.revisions.size(), 1u);
    EXPECT_EQ(alone.revisions[0].object, "room");
}

TEST(Revisions, AreNoneWithoutAChange) {
    const RevisedPlan plan({kPlate}, {kPlate});
    EXPECT_TRUE(plan.revisions.empty());
    EXPECT_TRUE(plan.drawn.revisions.empty());
}

TEST(StatesFile, KeepsStatesAndRows) {
    const RevisedPlan plan({kPlate, {"box", kElement, {1, 1, 0.2}, {2, 2, 1.2}}},
                           {kPlate, {"box", kElement, {3, 1, 0.2}, {4, 2, 1.2}}});
    const auto difference = makeDifferenceVolume(plan.was, plan.is, plan.comparison);
    ASSERT_TRUE(difference);
    const test::TemporaryFolder folder;
    const Vec3d shift{0, 0, -5};  // the new model was 5 m higher
    ASSERT_TRUE(writeDifference(*difference,
                                {.was = plan.was,
                                 .is = plan.is,
                                 .comparison = plan.comparison,
                                 .shift = shift,
                                 .options = {.tolerance = 0.005}},
                                folder / "d.svt"));
    const auto read = readStates(folder / "d.svt");
    ASSERT_TRUE(read) << read.error().toString();
    ASSERT_TRUE(read->has_value());
    const ComparedStates& states = **read;
    EXPECT_EQ(states.options.tolerance, 0.005);
    EXPECT_EQ(states.is.labels.labels.size(), plan.is.labels.labels.size());
    EXPECT_NEAR(states.is.grid.origin().z, plan.is.grid.origin().z + 5, 1e-9);
    EXPECT_NEAR(states.was.grid.origin().z, plan.was.grid.origin().z + 5, 1e-9);
    ASSERT_EQ(states.comparison.rows.size(), plan.comparison.rows.size());
    EXPECT_EQ(states.comparison.counts, plan.comparison.counts);
    for (std::size_t r = 0; r < plan.comparison.rows.size(); ++r) {
        const ComparisonRow &a = plan.comparison.rows[r], &b = states.comparison.rows[r];
        EXPECT_EQ(a.change, b.change);
        EXPECT_EQ(a.was, b.was);
        EXPECT_EQ(a.is, b.is);
        EXPECT_EQ(a.added, b.added);
        EXPECT_EQ(a.vector.has_value(), b.vector.has_value());
        EXPECT_EQ(a.isExact, b.isExact);
    }
    // For other readers it is a volume as before.
    const auto volume = volume::readSvt(folder / "d.svt");
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->labels.labels.size(), difference->labels.labels.size());
}

TEST(StatesFile, IsNotAnyVolume) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(volume::writeSvt(boxVolume({kPlate}), folder / "v.svt"));
    const auto states = readStates(folder / "v.svt");
    ASSERT_TRUE(states);
    EXPECT_FALSE(states->has_value());
}

TEST(StatesFile, RefusesRowsThatContradictItsStates) {
    const volume::SemanticVolume state = boxVolume({kPlate});
    const test::TemporaryFolder folder;
    const auto bytes = volume::svtBytes(state);
    ASSERT_TRUE(bytes);
    for (const std::string rows :
         {R"({"rows": [{"change": "moved", "was": [7], "is": [0], "geometry": true}]})",
          R"({"rows": [{"change": "moved", "was": [-1], "is": [0]}]})",
          R"({"rows": [{"change": "flown", "was": [0], "is": [0]}]})",
          R"({"rows": [{"change": "same", "was": [], "is": []}]})", R"({"rows": [4]})", R"({"rows": 4})", R"([])", "{",
          R"({"tolerance": -1, "rows": []})", R"({"rows": [[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]})"}) {
        const auto* const text = reinterpret_cast<const std::byte*>(rows.data());
        const std::vector<volume::NewEntry> entries{{"states/rows.json", {std::span(text, rows.size())}, true},
                                                    {"states/was.svt", {*bytes}, false},
                                                    {"states/is.svt", {*bytes}, false}};
        ASSERT_TRUE(volume::writeWithEntries(
            *bytes, folder / "d.svt", [](std::string_view) { return true; }, entries));
        const auto read = readStates(folder / "d.svt");
        ASSERT_FALSE(read) << rows;
        EXPECT_EQ(read.error().code(), Code::BadVolume) << rows;
        EXPECT_NE(read.error().message().find("states/rows.json"), std::string::npos) << read.error().message();
    }
    // A file that lost a state.
    const std::string rows = R"({"rows": []})";
    const auto* const text = reinterpret_cast<const std::byte*>(rows.data());
    const std::vector<volume::NewEntry> entries{{"states/rows.json", {std::span(text, rows.size())}, true}};
    ASSERT_TRUE(volume::writeWithEntries(
        *bytes, folder / "d.svt", [](std::string_view) { return true; }, entries));
    EXPECT_FALSE(readStates(folder / "d.svt"));
}

}  // namespace
}  // namespace svt::compare
