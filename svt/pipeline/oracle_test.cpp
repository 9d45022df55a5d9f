/// Exact point-in-solid oracle on real and generated models, through the whole pipeline.

#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/labels.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>
#include <svt/voxelize/solids_test.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace svt::pipeline {
namespace {

struct Verdict {
    int checked = 0;
    int nearFaces = 0;  // too close to a face to decide
    int overlaps = 0;   // in several solids: any of them may own the sample
    int wrong = 0;
    std::string first;
};

/// A voxelized model, and an oracle for each of its objects.
struct Voxelized {
    mesh::MeshSet meshes;
    volume::Grid grid;
    LabelledObjects labelled;
    voxelize::VoxelizeResult voxels;
    std::vector<test::SolidOracle> oracles;
};

std::optional<Voxelized> voxelized(model::BuildingModel& model, Vec3i dimension) {
    auto meshes = mesh::buildMeshes(model);
    EXPECT_TRUE(meshes);
    if (!meshes) return std::nullopt;
    BuildOptions options;
    options.dimension = dimension;
    const auto grid = chooseGrid(*meshes, options);
    const StyleSheet* sheets[] = {&defaultStyle(false)};
    auto labelled = makeLabels(model, *meshes, sheets);
    EXPECT_TRUE(grid && labelled);
    auto voxels = voxelize::voxelize(*meshes, *grid, labelled->claims);
    EXPECT_TRUE(voxels);
    if (!voxels) return std::nullopt;
    std::vector<test::SolidOracle> oracles;
    for (const mesh::ObjectMesh& object : meshes->objects) oracles.emplace_back(object);
    return Voxelized{std::move(*meshes), *grid, std::move(*labelled), std::move(*voxels), std::move(oracles)};
}

void checkSample(const Voxelized& all, Vec3i v, Verdict& verdict) {
    const Vec3d local = all.grid.worldFromIndex({double(v.x), double(v.y), double(v.z)}) - all.meshes.origin;
    const Vec3d spacing = all.grid.spacing();
    const volume::Scalar found = all.voxels.columns.scalarAt(v.x, v.y, v.z);
    std::vector<volume::Scalar> containing;
    bool isSheetOrThin = false;
    for (std::size_t o = 0; o < all.oracles.size(); ++o) {
        const mesh::ObjectMesh& object = all.meshes.objects[o];
        const test::SolidOracle& oracle = all.oracles[o];
        const Vec3d low = object.bounds.min - spacing * 1.1, high = object.bounds.max + spacing * 1.1;
        if (!Box3d{low, high}.contains(local)) continue;
        const volume::Scalar scalar = all.labelled.claims[o].scalar;
        if (!object.isSolid()) {
            isSheetOrThin = isSheetOrThin || (found == scalar && oracle.distance(local, spacing) <= 1.01);
            continue;
        }
        if (oracle.distance(local, spacing) < 1.0 / 128) {
            ++verdict.nearFaces;
            return;
        }
        const bool isInside = oracle.contains(local);
        if (isInside) containing.push_back(scalar);
        // A part thinner than a voxel may claim an adjacent sample.
        if (!isInside && found == scalar && all.voxels.thinVoxels[o] > 0 && oracle.distance(local, spacing) <= 0.9)
            isSheetOrThin = true;
    }
    ++verdict.checked;
    if (isSheetOrThin) return;
    if (containing.size() > 1) ++verdict.overlaps;
    const bool isRight =
        containing.empty() ? found == 0 : std::find(containing.begin(), containing.end(), found) != containing.end();
    if (isRight) return;
    if (verdict.wrong++ == 0)
        verdict.first = "sample (" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
                        ") has scalar " + std::to_string(found) + ", oracle says " +
                        (containing.empty() ? "0" : std::to_string(containing[0]));
}

/// Compares samples of the voxelized model with the solids that contain their centers.
Verdict compareWithOracle(model::BuildingModel& model, Vec3i dimension, int randomSamples, int columnStep) {
    Verdict verdict;
    const std::optional<Voxelized> all = voxelized(model, dimension);
    if (!all) return verdict;
    const auto check = [&](Vec3i v) { checkSample(*all, v, verdict); };
    std::mt19937_64 random(11);
    const auto below = [&](std::int32_t n) { return static_cast<std::int32_t>(random() % std::uint64_t(n)); };
    for (int n = 0; n < randomSamples; ++n) check({below(dimension.x), below(dimension.y), below(dimension.z)});
    for (std::int32_t j = columnStep / 2; j < dimension.y; j += columnStep)
        for (std::int32_t i = columnStep / 3; i < dimension.x; i += columnStep)
            for (const volume::Run& run : all->voxels.columns.column(i, j)) {
                if (run.end < std::uint32_t(dimension.z)) check({i, j, static_cast<std::int32_t>(run.end)});
                check({i, j, static_cast<std::int32_t>(run.end) - 1});
            }
    return verdict;
}

void expectRight(model::BuildingModel& model, Vec3i dimension, int randomSamples, int columnStep, int atLeast) {
    const Verdict verdict = compareWithOracle(model, dimension, randomSamples, columnStep);
    EXPECT_EQ(verdict.wrong, 0) << verdict.first;
    EXPECT_GT(verdict.checked, atLeast);
    std::cout << verdict.checked << " samples checked, " << verdict.nearFaces << " too near to a face, "
              << verdict.overlaps << " in several solids\n";
}

void checkFile(const std::filesystem::path& file, Vec3i dimension, int randomSamples, int columnStep, int atLeast) {
    auto model = readers::readModel(file);
    ASSERT_TRUE(model) << model.error().toString();
    expectRight(*model, dimension, randomSamples, columnStep, atLeast);
}

TEST(Oracle, FzkHausHasNoWrongSample) {
    SVT_NEEDS_DATA(file, "fzk_haus_citygml3.gml");
    checkFile(file, {271, 230, 163}, 6000, 9, 8000);
    checkFile(file, {397, 401, 211}, 3000, 17, 6000);
}

TEST(Oracle, Sig3dHouseHasNoWrongSample) {
    SVT_NEEDS_DATA(file, "sig3d_lod4_citygml2.gml");
    checkFile(file, {311, 257, 203}, 6000, 9, 8000);
}

TEST(Oracle, BerlinHasNoWrongSample) {
    SVT_NEEDS_DATA(file, "berlin_lod2_citygml1.gml");
    checkFile(file, {251, 377, 203}, 6000, 13, 8000);
}

TEST(Oracle, HundredBuildingsHaveNoWrongSample) {
    SVT_NEEDS_DATA(file, "100_buildings_lod2_citygml3.gml");
    checkFile(file, {313, 307, 202}, 5000, 17, 5000);
}

TEST(Oracle, GeneratedHouseHasNoWrongSampleStraightAndTurned) {
    for (const double turn : {0.0, 30.0}) {
        samples::SampleOptions options;
        options.turnDegrees = turn;
        const auto text = samples::writeSample(samples::SampleKind::House, samples::SampleFormat::CityGml3, options);
        ASSERT_TRUE(text);
        auto model = readers::readModel(std::as_bytes(std::span(*text)), "house.gml");
        ASSERT_TRUE(model) << model.error().toString();
        expectRight(*model, {233, 211, 201}, 4000, 11, 6000);
    }
}

}  // namespace
}  // namespace svt::pipeline
