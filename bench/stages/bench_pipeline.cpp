#include <bench/benches.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <array>

namespace svt::bench {
namespace {

struct Stage {
    const char* name;
    std::uint64_t resultBytes;
    std::function<void()> run;
};

std::uint64_t levelBytes(const std::vector<volume::LodLevel>& levels) {
    std::uint64_t bytes = 0;
    for (const volume::LodLevel& level : levels)
        bytes += level.columns.sizeBytes() + level.bricks.sizeBytes() + level.mixtures.size() * sizeof(volume::Mixture);
    return bytes;
}

Result<void> benchSize(const Input& input, const Workload& workload, Vec3i dimension, const BenchOptions& options,
                       Report& report) {
    tell(fmt::format("stages {} {}", input.name, sizeText(dimension)));
    const std::array files{input.file};
    const std::filesystem::path target = options.scratch / "stages.svt";
    pipeline::BuildOptions buildOptions;
    buildOptions.dimension = dimension;
    SVT_TRY(built, pipeline::buildVolume(files, buildOptions));
    const volume::SemanticVolume& volume = built->volume;
    SVT_TRY(fileBytes, volume::writeSvt(volume, target));
    SVT_TRY(bricks, volume::BrickVolume::fromColumns(volume.columns, {.planes = volume.planes}));
    SVT_TRY(levels, volume::buildLodPyramid(volume.columns, volume.grid));

    // Failures of this stage were already reported above; only time counts here.
    const auto done = [](const auto& result) { static_cast<void>(result.hasValue()); };
    mesh::MeshOptions meshOptions;
    meshOptions.measuresThickness = false;  // measured by the pipeline, up to a voxel
    // What `svt render` and the page make of a file: no borders on faces, and levels only where a picture takes them.
    const volume::BrickVolume::Options forPictures{.faces = volume::BrickFaces::Slopes, .planes = volume.planes};
    const std::array sheets{&pipeline::defaultStyle(false)};
    const std::vector<Stage> stages{
        {"read the model", 0, [&] { done(readers::readModel(input.file)); }},
        {"make meshes", 0, [&] { done(mesh::buildMeshes(workload.model, meshOptions)); }},
        {"make labels", 0, [&] { done(pipeline::makeLabels(workload.model, workload.meshes, sheets)); }},
        {"voxelize to columns", volume.columns.sizeBytes(),
         [&] { done(voxelize::voxelize(workload.meshes, volume.grid, workload.labels.claims)); }},
        {"write .svt", *fileBytes, [&] { done(volume::writeSvt(volume, target)); }},
        {"open .svt", 0, [&] { done(volume::readSvt(target)); }},
        {"make bricks", bricks->sizeBytes(),
         [&] { done(volume::BrickVolume::fromColumns(volume.columns, {.planes = volume.planes})); }},
        {"make coarse levels", levelBytes(*levels),
         [&] { done(volume::buildLodPyramid(volume.columns, volume.grid)); }},
        {"make one coarse level", 0, [&] { done(volume::buildLodLevel(volume.columns, volume.grid, 1)); }},
        {"ready to draw", 0,
         [&] {
             const auto opened = volume::readSvt(target);
             if (opened) done(volume::BrickVolume::fromColumns(opened->columns, forPictures));
         }},
        {"model file to .svt", *fileBytes, [&] {
             const auto output = pipeline::buildVolume(files, buildOptions);
             if (output) done(volume::writeSvt(output->volume, target));
         }}};
    std::vector<Contestant> contestants{{"yardstick", yardstick}};
    for (const Stage& stage : stages) contestants.push_back({stage.name, stage.run});
    const auto measured = measureInTurns(contestants, options.measure);
    for (std::size_t s = 0; s < stages.size(); ++s) {
        Row row;
        row.isStage = true;
        row.stage = stages[s].name;
        row.input = input.name;
        row.size = sizeText(dimension);
        row.ours = measured[s + 1];
        row.resultBytes = stages[s].resultBytes;
        row.yardsticks = row.ours.median / measured[0].median;
        report.rows.push_back(std::move(row));
    }
    return {};
}

}  // namespace

Result<void> benchStages(const Input& input, const Workload& workload, const BenchOptions& options, Report& report) {
    return benchSize(input, workload, gridSize(options.isQuick), options, report);
}

}  // namespace svt::bench
