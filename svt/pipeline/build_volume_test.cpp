#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/color_text.hpp>
#include <svt/mesh/models_test.hpp>
#include <svt/model/classes.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/samples/sample.hpp>
#include <svt/volume/volume_json.hpp>

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace svt::pipeline {
namespace {

using model::FeatureIndex;
using test::addBoxFeature;
using test::addFeature;
using volume::Label;

BuildOutput build(model::BuildingModel model, const BuildOptions& options = {}, Diagnostics* log = nullptr) {
    auto output = buildVolume(model, options, log);
    EXPECT_TRUE(output) << output.error().toString();
    if (!output) return {};
    EXPECT_TRUE(volume::checkLabels(output->volume.labels));
    return *output;
}

const Label& labelOf(const BuildOutput& output, const std::string& id) {
    for (const Label& label : output.volume.labels.labels)
        if (label.id == id) return label;
    ADD_FAILURE() << "no label " << id;
    static const Label none;
    return none;
}

BuildOptions withSpacing(double spacing) {
    BuildOptions options;
    options.spacing = Vec3d{spacing, spacing, spacing};
    return options;
}

// A building of 6 x 5 x 3 m with one room and the boundary surfaces of both.
model::BuildingModel thematicHouse() {
    model::BuildingModel model;
    const Vec3d low{0, 0, 0}, high{6, 5, 3}, roomLow{0.4, 0.4, 0.4}, roomHigh{5.6, 4.6, 2.6};
    const FeatureIndex house = addBoxFeature(model, "Building", "house", low, high);
    const char* const outer[6] = {"GroundSurface", "RoofSurface", "WallSurface",
                                  "WallSurface",   "WallSurface", "WallSurface"};
    for (int side = 0; side < 6; ++side)
        addFeature(model, outer[side], "outer-" + std::to_string(side), house,
                   {test::surfaceOf({{test::addRings(model, {test::boxRing(low, high, side)}), false}})});
    const FeatureIndex room = addBoxFeature(model, "BuildingRoom", "room", roomLow, roomHigh, house);
    const char* const inner[6] = {"FloorSurface",        "CeilingSurface",      "InteriorWallSurface",
                                  "InteriorWallSurface", "InteriorWallSurface", "InteriorWallSurface"};
    for (int side = 0; side < 6; ++side) {
        test::Ring ring = test::boxRing(roomLow, roomHigh, side);
        std::reverse(ring.begin(), ring.end());  // seen from the material
        addFeature(model, inner[side], "inner-" + std::to_string(side), room,
                   {test::surfaceOf({{test::addRings(model, {ring}), false}})});
    }
    return model;
}

TEST(BuildVolume, KeepsEdgesAndMeshesByLabelWhereAskedFor) {
    BuildOptions options = withSpacing(0.2);
    const BuildOutput bare = build(thematicHouse(), options);
    EXPECT_TRUE(bare.volume.vectors.isEmpty());
    options.vectors = {.edges = true, .meshes = true};
    const BuildOutput output = build(thematicHouse(), options);
    EXPECT_EQ(output.volume.columns.countVoxels(output.volume.labels.scalarCount()),
              bare.volume.columns.countVoxels(bare.volume.labels.scalarCount()));
    const volume::VectorParts& parts = output.volume.vectors;
    ASSERT_TRUE(volume::checkVectorParts(parts, output.volume.labels.labels.size()));
    std::map<std::string, std::size_t> segments, triangles;
    Box3d room;
    for (const auto& segment : parts.segments) {
        const Label& label = output.volume.labels.labels[segment.label];
        ++segments[label.id];
        if (label.id == "room")
            for (const std::uint32_t end : segment.ends) room.add(parts.position(end, output.volume.grid.origin()));
    }
    for (const auto& triangle : parts.triangles) ++triangles[output.volume.labels.labels[triangle.label].id];
    EXPECT_EQ(segments["house"], 12u);
    EXPECT_EQ(segments["room"], 12u);
    EXPECT_EQ(segments["outer-3"], 4u);
    EXPECT_EQ(triangles["room"], 12u);
    EXPECT_EQ(triangles["outer-3"], 2u);
    EXPECT_LT(length(room.min - Vec3d{0.4, 0.4, 0.4}), 1e-4);
    EXPECT_LT(length(room.max - Vec3d{5.6, 4.6, 2.6}), 1e-4);

    options.threads = 1;
    EXPECT_EQ(build(thematicHouse(), options).volume.vectors, parts);
    options.vectors.meshes = false;
    EXPECT_TRUE(build(thematicHouse(), options).volume.vectors.triangles.empty());
}

TEST(BuildVolume, BoxHasItsVoxelsAndFigures) {
    model::BuildingModel model;
    model.source = "folder/house.gml";
    model.name = "House";
    model.crs.name = "EPSG:25832";
    addBoxFeature(model, "Building", "house", {0, 0, 0}, {4, 3, 2});
    const BuildOutput output = build(model, withSpacing(0.1));
    const Label& house = labelOf(output, "house");
    // First and last samples of each axis lie half a voxel outside of the box.
    EXPECT_EQ(output.volume.grid.dimension(), (Vec3i{42, 32, 22}));
    EXPECT_EQ(house.voxels, 40u * 30 * 20);
    EXPECT_NEAR(double(house.voxels) * output.volume.grid.voxelVolume(), house.volume, 1e-9);
    EXPECT_EQ(output.report.objects, 1u);
    EXPECT_EQ(output.report.triangles, 12u);
    EXPECT_EQ(output.report.open, 0u);
    EXPECT_EQ(output.volume.source, "house.gml");
    EXPECT_EQ(output.volume.modelName, "House");
    EXPECT_EQ(output.volume.crsName, "EPSG:25832");
}

TEST(BuildVolume, CapsAreLabelsWithoutVoxels) {
    model::BuildingModel model;
    addFeature(model, "BuildingRoom", "room", model::kNoFeature,
               {test::solidOf(test::addBox(model, {0, 0, 0}, {4, 3, 2}, {test::kTop}))});
    Diagnostics log;
    const BuildOutput output = build(model, withSpacing(0.1), &log);
    const Label& cap = labelOf(output, "room_cap_1");
    EXPECT_EQ(cap.className, "ClosureSurface");
    EXPECT_EQ(cap.count, 0u);
    EXPECT_EQ(cap.voxels, 0u);
    EXPECT_NEAR(std::get<double>(cap.attributes.back().value), 12, 1e-12);
    EXPECT_EQ(labelOf(output, "room").voxels, 24000u);
    EXPECT_EQ(labelOf(output, "room").filling, volume::Filling::Capped);
    EXPECT_EQ(output.report.open, 1u);
    EXPECT_EQ(log.count(Code::ShellCapped), 1u);
}

TEST(BuildVolume, WarnsWhereVoxelsAreFarFromWhatTheShellEncloses) {
    // Two boxes of one solid overlap by half: the volume counts the common part twice.
    model::BuildingModel model;
    auto uses = test::addBox(model, {0, 0, 0}, {8, 6, 4});
    for (const model::SurfaceUse& use : test::addBox(model, {1, 1, 0.5}, {9, 7, 4.5})) uses.push_back(use);
    addFeature(model, "Building", "twice", model::kNoFeature, {test::solidOf(uses)});
    const FeatureIndex right = addBoxFeature(model, "Building", "right", {20, 0, 0}, {28, 6, 4});
    addBoxFeature(model, "BuildingRoom", "room", {21, 1, 0.5}, {27, 5, 3.5}, right);
    addBoxFeature(model, "BuildingFurniture", "table", {22, 1.5, 1}, {23, 2.5, 2}, right);
    Diagnostics log;
    (void)build(model, withSpacing(0.1), &log);
    ASSERT_EQ(log.count(Code::VolumeDiffers), 1u);
    for (const Diagnostic& item : log.items()) {
        if (item.code == Code::VolumeDiffers) {
            EXPECT_EQ(item.where.id, "twice");
        }
    }
}

// A house of 10 m on a stratum of 24 km.
TEST(BuildVolume, OneHugeObjectDoesNotDecideTheDefaultSpacing) {
    model::BuildingModel model;
    addBoxFeature(model, "Building", "house", {500, 700, 20}, {510, 708, 26});
    addBoxFeature(model, "GenericOccupiedSpace", "stratum", {-12000, -12000, 0}, {12000, 12000, 20});
    Diagnostics log;
    const BuildOutput output = build(model, {}, &log);
    EXPECT_EQ(output.volume.grid.spacing().x, 0.05);
    ASSERT_TRUE(output.report.spacing);
    EXPECT_NE(output.report.spacing->reason.find("the usual 0.05 m; 5 m with one object that is larger"),
              std::string::npos)
        << output.report.spacing->reason;
    EXPECT_EQ(labelOf(output, "house").voxels, 200u * 160 * 120);
    EXPECT_GT(labelOf(output, "stratum").voxels, 0u);
    EXPECT_NEAR(labelOf(output, "stratum").volume, 24000.0 * 24000 * 20, 1e3) << "that of its mesh";
    const auto found = std::ranges::find(log.items(), Code::GridTooLarge, &Diagnostic::code);
    ASSERT_NE(found, log.items().end()) << "the cut is reported";
    EXPECT_EQ(found->where.id, "stratum");
    EXPECT_NE(found->message.find("--spacing 5 covers all"), std::string::npos) << found->message;
    // A model with two of them keeps the coarse spacing, and terrain of usual size is not cut.
    addBoxFeature(model, "GenericOccupiedSpace", "rock", {-12000, -12000, -30}, {12000, 12000, 0});
    EXPECT_GE(build(model, {}).volume.grid.spacing().x, 5);
    model::BuildingModel usual;
    addBoxFeature(usual, "Building", "house", {50, 70, 20}, {60, 78, 26});
    addBoxFeature(usual, "GenericOccupiedSpace", "ground", {0, 0, 15}, {200, 200, 20});
    EXPECT_NEAR(build(usual, {}).volume.grid.dimension().x * 0.05, 200, 0.2);
}

TEST(BuildVolume, VolumesOfSmallThingsHaveTheDigitsInWhichTheyDiffer) {
    model::BuildingModel model;
    auto uses = test::addBox(model, {0, 0, 0}, {0.08, 0.06, 0.04});
    for (const model::SurfaceUse& use : test::addBox(model, {0.01, 0.01, 0.005}, {0.09, 0.07, 0.045}))
        uses.push_back(use);
    addFeature(model, "BuildingFurniture", "screw", model::kNoFeature, {test::solidOf(uses)});
    Diagnostics log;
    (void)build(model, withSpacing(0.001), &log);
    ASSERT_EQ(log.count(Code::VolumeDiffers), 1u);
    for (const Diagnostic& item : log.items()) {
        if (item.code != Code::VolumeDiffers) continue;
        EXPECT_EQ(item.message.find(" 0.0 m3"), std::string::npos) << item.message;
        EXPECT_NE(item.message.find("encloses 0.000384 m3"), std::string::npos) << item.message;
    }
}

TEST(BuildVolume, OverlapsTellNestedFromConflicting) {
    model::BuildingModel model;
    const FeatureIndex house = addBoxFeature(model, "Building", "house", {0, 0, 0}, {8, 4, 4});
    const FeatureIndex room = addBoxFeature(model, "BuildingRoom", "room", {1, 1, 1}, {4, 3, 3}, house);
    addBoxFeature(model, "BuildingFurniture", "table", {2, 1.5, 1}, {3, 2.5, 2}, room);
    addBoxFeature(model, "BuildingRoom", "rival", {3.5, 1, 1}, {6, 3, 3}, house);
    const FeatureIndex unit = addBoxFeature(model, "BuildingUnit", "flat", {0.5, 0.5, 0.5}, {4.5, 3.5, 3.5}, house);
    model.memberships.push_back({unit, room, ""});
    const BuildOutput output = build(model, withSpacing(0.1));
    std::map<std::pair<std::string, std::string>, std::pair<std::uint64_t, bool>> found;
    const auto& labels = output.volume.labels.labels;
    for (const volume::Overlap& overlap : output.volume.labels.overlaps)
        found[{labels[overlap.a].id, labels[overlap.b].id}] = {overlap.voxels, overlap.isNested};
    using Entry = std::pair<std::uint64_t, bool>;
    EXPECT_EQ((found[{"room", "house"}]), (Entry{30 * 20 * 20, true}));
    EXPECT_EQ((found[{"table", "room"}]), (Entry{1000, true}));
    EXPECT_EQ((found[{"room", "flat"}]), (Entry{30 * 20 * 20, true}));    // a member
    EXPECT_EQ((found[{"table", "flat"}]), (Entry{1000, true}));           // a descendant of a member
    EXPECT_EQ((found[{"rival", "room"}]), (Entry{5 * 20 * 20, false}));   // the smaller room wins
    EXPECT_EQ((found[{"rival", "flat"}]), (Entry{10 * 20 * 20, false}));  // rooms take precedence over flats
    EXPECT_TRUE(std::is_sorted(output.volume.labels.overlaps.begin(), output.volume.labels.overlaps.end(),
                               [](const auto& p, const auto& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }));
}

TEST(BuildVolume, GridByDimensionSpacingOrContent) {
    model::BuildingModel model;
    addBoxFeature(model, "Building", "house", {100, 200, 10}, {108, 204, 12});
    BuildOptions options;
    const BuildOutput unasked = build(model, options);
    EXPECT_EQ(unasked.volume.grid.spacing(), (Vec3d{0.05, 0.05, 0.05}));
    EXPECT_EQ(unasked.volume.grid.dimension(), (Vec3i{162, 82, 42}));
    ASSERT_TRUE(unasked.report.spacing);
    EXPECT_EQ(unasked.report.spacing->reason, "the usual 0.05 m");
    EXPECT_NEAR(unasked.report.spacing->forecast.surfaceVoxels, 2 * (32 + 16 + 8) / 0.0025, 1e-6);
    options.memoryBytes = 100'000;  // two faces of 32 m2, two of 16, two of 8
    const BuildOutput small = build(model, options);
    EXPECT_EQ(small.volume.grid.spacing(), (Vec3d{0.2, 0.2, 0.2}));
    EXPECT_LE(small.report.spacing->forecast.bytes, 100'000);
    EXPECT_NE(small.report.spacing->reason.find("0.2 m, because at 0.1 m it would take about"), std::string::npos)
        << small.report.spacing->reason;
    options.memoryBytes = SpacingChoice::kMemoryBytes;
    options.spacing = Vec3d{0.5, 0.25, 0.125};
    const BuildOutput asked = build(model, options);
    EXPECT_EQ(asked.volume.grid.dimension(), (Vec3i{18, 18, 18}));
    EXPECT_EQ(asked.volume.grid.origin(), (Vec3d{99.75, 199.875, 9.9375}));
    EXPECT_FALSE(asked.report.spacing);
    options.dimension = Vec3i{5, 6, 7};  // takes precedence over spacing
    const BuildOutput output = build(model, options);
    EXPECT_EQ(output.volume.grid.dimension(), (Vec3i{5, 6, 7}));
    EXPECT_EQ(output.volume.grid.origin(), (Vec3d{100, 200, 10}));
    options.dimension = Vec3i{1, 6, 7};
    EXPECT_EQ(buildVolume(model, options).error().code(), Code::BadDimension);
}

TEST(BuildVolume, BuildingFrameTurnsWithTheModel) {
    // A box of 8 x 4 m rotated by 30 degrees: along its own axes it fills the grid.
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    const Vec3d world{458877, 5438353, 100};
    model::BuildingModel model;
    addBoxFeature(model, "Building", "house", {0, 0, 0}, {8, 4, 2});
    for (model::Polygon& polygon : model.polygons)
        for (Vec3d& p : polygon.points) p = Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z} + world;
    BuildOptions options = withSpacing(0.1);
    const BuildOutput straight = build(model, options);
    options.axes = AxesKind::Building;
    const BuildOutput turned = build(model, options);
    EXPECT_TRUE(straight.volume.grid.isAxisParallel());
    EXPECT_FALSE(turned.volume.grid.isAxisParallel());
    const Vec3i n = turned.volume.grid.dimension();
    EXPECT_EQ(std::max(n.x, n.y), 82);
    EXPECT_EQ(std::min(n.x, n.y), 42);
    EXPECT_EQ(labelOf(turned, "house").voxels, 80u * 40 * 20);
    EXPECT_NEAR(double(labelOf(straight, "house").voxels), 80.0 * 40 * 20, 640);
    EXPECT_LT(turned.volume.grid.sampleCount(), straight.volume.grid.sampleCount());
}

TEST(BuildVolume, BuildingFrameTurnsByAtMost45Degrees) {
    BuildOptions options = withSpacing(0.5);
    options.axes = AxesKind::Building;
    for (const int degrees : {0, 20, 44, 46, 60, 90, 100, 135, 150, 179}) {
        const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
        model::BuildingModel model;
        addBoxFeature(model, "Building", "house", {0, 0, 0}, {8, 4, 2});
        for (model::Polygon& polygon : model.polygons)
            for (Vec3d& p : polygon.points) p = Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
        const BuildOutput output = build(model, options);
        const Vec3d x = output.volume.grid.axes()[0], y = output.volume.grid.axes()[1];
        EXPECT_GE(x.x, std::cos(std::numbers::pi / 4) - 1e-9) << degrees;
        EXPECT_GE(y.y, std::cos(std::numbers::pi / 4) - 1e-9) << degrees;
        EXPECT_EQ(labelOf(output, "house").voxels, 16u * 8 * 4) << degrees;
    }
}

TEST(BuildVolume, MaterialGoesToTheSurfacesOrStaysWithTheBuilding) {
    BuildOptions options = withSpacing(0.04);  // no layer of samples at the centre of a wall
    const BuildOutput given = build(thematicHouse(), options);
    options.assignThematicBodies = false;
    const BuildOutput kept = build(thematicHouse(), options);
    const auto solidVoxels = [](const BuildOutput& output) {
        std::uint64_t sum = labelOf(output, "house").voxels;
        for (int side = 0; side < 6; ++side)
            sum += labelOf(output, "outer-" + std::to_string(side)).voxels +
                   labelOf(output, "inner-" + std::to_string(side)).voxels;
        return sum;
    };
    EXPECT_EQ(labelOf(given, "house").voxels, 0u);
    EXPECT_GT(labelOf(kept, "house").voxels, 0u);
    EXPECT_EQ(solidVoxels(given), solidVoxels(kept));
    EXPECT_EQ(labelOf(given, "room").voxels, labelOf(kept, "room").voxels);
    for (int side = 0; side < 6; ++side) {
        const Label& body = labelOf(given, "outer-" + std::to_string(side));
        EXPECT_EQ(body.filling, volume::Filling::Body);
        EXPECT_NEAR(body.volume, double(body.voxels) * given.volume.grid.voxelVolume(), 1e-9);
        const Label& sheet = labelOf(kept, "outer-" + std::to_string(side));
        EXPECT_EQ(sheet.filling, volume::Filling::Surface);
        EXPECT_EQ(sheet.volume, 0);
        EXPECT_GT(body.voxels, sheet.voxels);
    }
    // The outer half of the ground slab, mitred at the walls: the integral of (6 - 2 d) (5 - 2 d) over d = 0 .. 0.2.
    EXPECT_NEAR(labelOf(given, "outer-0").volume, 5.5707, 30 * 0.04 / 2);
}

TEST(BuildVolume, PatternsSplitScalarsAndKeepTheVoxels) {
    BuildOptions options = withSpacing(0.05);
    const BuildOutput plain = build(thematicHouse(), options);
    options.usePatterns = true;
    const BuildOutput patterned = build(thematicHouse(), options);
    EXPECT_EQ(labelOf(plain, "outer-2").count, 1u);
    EXPECT_TRUE(plain.volume.labels.phaseColors.empty());
    const Label& wall = labelOf(patterned, "outer-2");
    EXPECT_EQ(wall.count, 2u);
    EXPECT_EQ(patterned.volume.labels.phaseColors.size(), patterned.volume.labels.scalarCount());
    const auto counts = patterned.volume.columns.countVoxels(patterned.volume.labels.scalarCount());
    EXPECT_GT(counts[wall.first], counts[wall.first + 1]);
    EXPECT_GT(counts[wall.first + 1], 0u);
    ASSERT_EQ(plain.volume.labels.labels.size(), patterned.volume.labels.labels.size());
    for (std::size_t l = 0; l < plain.volume.labels.labels.size(); ++l)
        EXPECT_EQ(plain.volume.labels.labels[l].voxels, patterned.volume.labels.labels[l].voxels)
            << plain.volume.labels.labels[l].id;
}

TEST(BuildVolume, StyleOfTheCallerIsStrongerThanTheBuiltInOne) {
    const auto style = parseStyleSheet(R"({"rules": [{"select": "id=room", "color": "red", "opacity": 0.75}]})", {});
    ASSERT_TRUE(style);
    BuildOptions options = withSpacing(0.2);
    options.style = &*style;
    const BuildOutput output = build(thematicHouse(), options);
    EXPECT_EQ(labelOf(output, "room").color, (Vec3f{1, 0, 0}));
    EXPECT_EQ(labelOf(output, "room").opacity, 0.75f);
    EXPECT_EQ(labelOf(output, "outer-1").color, *image::parseColor("#a8483a"));
}

TEST(BuildVolume, SameForAnyNumberOfThreads) {
    BuildOptions one = withSpacing(0.05), many = one;
    one.usePatterns = many.usePatterns = true;
    one.threads = 1;
    many.threads = 4;
    const BuildOutput a = build(thematicHouse(), one), b = build(thematicHouse(), many);
    EXPECT_TRUE(a.volume.columns == b.volume.columns);
    EXPECT_TRUE(a.volume.labels == b.volume.labels);
    EXPECT_TRUE(a.volume.grid == b.volume.grid);
}

TEST(BuildVolume, EmptyModelAndCancelAreErrors) {
    model::BuildingModel empty;
    EXPECT_EQ(buildVolume(empty).error().code(), Code::EmptyModel);
    EXPECT_EQ(buildVolume(std::span<const std::filesystem::path>{}).error().code(), Code::BadArgument);
    model::BuildingModel model = thematicHouse();
    Progress progress;
    progress.cancel = true;
    BuildOptions options = withSpacing(0.2);
    options.progress = &progress;
    EXPECT_EQ(buildVolume(model, options).error().code(), Code::Cancelled);
}

class TwoFiles : public ::testing::Test {
protected:
    void SetUp() override {
        samples::SampleOptions options;
        for (int file = 0; file < 2; ++file) {
            const auto text =
                samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityJson2, options);
            ASSERT_TRUE(text);
            files_.push_back(folder_ / ("house-" + std::to_string(file) + ".city.json"));
            test::writeText(files_.back(), *text);
            options.origin.x += 30;
        }
    }
    test::TemporaryFolder folder_;
    std::vector<std::filesystem::path> files_;
};

TEST_F(TwoFiles, EqualIdsAreToldApart) {
    Diagnostics log;
    const auto one = readers::readModels(std::span(files_).first(1), {}, nullptr);
    const auto both = readers::readModels(files_, {}, &log);
    ASSERT_TRUE(one && both);
    const std::size_t count = one->features.size();
    ASSERT_EQ(both->features.size(), 2 * count);
    EXPECT_EQ(both->polygons.size(), 2 * one->polygons.size());
    EXPECT_EQ(both->roots.size(), 2 * one->roots.size());
    EXPECT_EQ(both->memberships.size(), 2 * one->memberships.size());
    EXPECT_EQ(log.count(Code::DuplicateId), count);
    std::set<std::string> ids;
    for (const model::Feature& feature : both->features) ids.insert(feature.id);
    EXPECT_EQ(ids.size(), 2 * count);
    for (std::size_t f = 0; f < count; ++f) {
        const model::Feature &a = both->features[f], &b = both->features[count + f];
        EXPECT_EQ(b.id, a.id + "@2");
        EXPECT_EQ(b.parent == model::kNoFeature, a.parent == model::kNoFeature);
        if (a.parent != model::kNoFeature) {
            EXPECT_EQ(b.parent, a.parent + count);
        }
    }
}

TEST_F(TwoFiles, BothHousesHaveTheSameVolumes) {
    BuildOptions options = withSpacing(0.1);
    const auto output = buildVolume(files_, options);
    ASSERT_TRUE(output) << output.error().toString();
    const auto& labels = output->volume.labels.labels;
    ASSERT_EQ(labels.size() % 2, 0u);
    for (std::size_t l = 0; l < labels.size() / 2; ++l) {
        const Label &a = labels[l], &b = labels[labels.size() / 2 + l];
        std::string id = a.id;  // that of a phase begins with the id of its object
        id.insert(model::isPhase(a.className) ? id.rfind("_phase") : id.size(), "@2");
        EXPECT_EQ(b.id, id);
        EXPECT_NEAR(a.volume, b.volume, 1e-6 + 1e-9 * a.volume);
        EXPECT_EQ(a.filling, b.filling);
    }
    EXPECT_EQ(output->volume.source, "house-0.city.json");
    EXPECT_GT(output->report.seconds.total, 0);
}

// From files, geometry is dropped as soon as there are meshes: nothing after them may need it.
TEST_F(TwoFiles, FromFilesAsFromAModelInMemory) {
    BuildOptions options = withSpacing(0.1);
    options.vectors = {.edges = true, .meshes = true};
    options.usePatterns = true;
    Diagnostics ofFiles, ofModel;
    const auto fromFiles = buildVolume(files_, options, &ofFiles);
    auto model = readers::readModels(files_, {}, &ofModel);
    ASSERT_TRUE(fromFiles && model);
    const std::size_t polygons = model->polygons.size();
    const auto fromModel = buildVolume(*model, options, &ofModel);
    ASSERT_TRUE(fromModel);
    EXPECT_EQ(model->polygons.size(), polygons);
    EXPECT_EQ(fromFiles->volume.labels, fromModel->volume.labels);
    EXPECT_EQ(fromFiles->volume.columns, fromModel->volume.columns);
    EXPECT_EQ(fromFiles->volume.vectors, fromModel->volume.vectors);
    EXPECT_EQ(fromFiles->volume.planes, fromModel->volume.planes);
    ASSERT_EQ(ofFiles.items().size(), ofModel.items().size());
    for (std::size_t n = 0; n < ofFiles.items().size(); ++n)
        EXPECT_EQ(ofFiles.items()[n].message, ofModel.items()[n].message);
}

TEST_F(TwoFiles, ThreeEqualFilesStayApart) {
    files_.push_back(files_[0]);
    const auto all = readers::readModels(files_, {}, nullptr);
    ASSERT_TRUE(all);
    std::set<std::string> ids;
    for (const model::Feature& feature : all->features) ids.insert(feature.id);
    EXPECT_EQ(ids.size(), all->features.size());
}

TEST_F(TwoFiles, MissingFileIsAnError) {
    files_.push_back(folder_ / "missing.gml");
    const auto all = readers::readModels(files_, {}, nullptr);
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().code(), Code::CannotOpen);
}

TEST(BuildVolume, AGivenGridIsTaken) {
    const BuildOutput house = build(thematicHouse(), withSpacing(0.25));
    // A parcel that extends beyond the house's grid on three sides, and one elsewhere.
    model::BuildingModel parcels;
    addBoxFeature(parcels, "LandUse", "parcel", {-5, -5, -1}, {3, 20, 10});
    addBoxFeature(parcels, "LandUse", "elsewhere", {50, 0, 0}, {60, 10, 3});
    BuildOptions options;
    options.grid = house.volume.grid;
    Diagnostics log;
    const BuildOutput output = build(parcels, options, &log);
    EXPECT_EQ(output.volume.grid, house.volume.grid);
    // 13 of 26 samples along x: those at -0.125, 0.125, ... 2.875 m.
    EXPECT_EQ(labelOf(output, "parcel").voxels, 13u * 22 * 14);
    EXPECT_EQ(labelOf(output, "elsewhere").voxels, 0u);
    ASSERT_EQ(log.count(Severity::Warning), 1u);
    EXPECT_EQ(log.items().back().where.id, "elsewhere");
    // Nothing inside the grid.
    model::BuildingModel far;
    addBoxFeature(far, "LandUse", "far", {500, 0, 0}, {510, 10, 3});
    const auto failed = buildVolume(far, options);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code(), Code::EmptyModel);
}

}  // namespace
}  // namespace svt::pipeline
