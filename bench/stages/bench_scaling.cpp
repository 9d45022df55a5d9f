#include <bench/benches.hpp>
#include <bench/drawable.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <fmt/format.h>

#include <array>
#include <utility>

namespace svt::bench {
namespace {

volume::BrickVolume::Options forPictures(const std::vector<volume::FacePlane>& planes) {
    return {.faces = volume::BrickFaces::Slopes, .planes = planes};
}

constexpr int kWidth = 1280, kHeight = 720;

// Failures were already reported when the drawable was made; only time counts here.
const auto done = [](const auto& result) { static_cast<void>(result.hasValue()); };

std::uint64_t denseBytes(const volume::Grid& grid) { return 2 * grid.sampleCount(); }

// The largest resolutions take seconds per round; three rounds are sufficient for a plot.
MeasureOptions fewRuns(const BenchOptions& options) {
    MeasureOptions measure = options.measure;
    measure.leastRuns = 3;
    measure.mostRuns = 7;
    measure.maxTotalSeconds = 3;
    return measure;
}

Result<Row> scalingRow(const Workload& workload, Vec3i dimension, const BenchOptions& options) {
    tell(fmt::format("scaling {} {}", workload.name, sizeText(dimension)));
    // In program order: from meshes to a frame. The memory is that of the whole.
    Drawable drawable;
    render::FrameSpec spec;
    Result<void> outcome;
    const std::uint64_t peak = peakMemoryOf([&] {
        auto made = makeDrawable(workload, dimension);
        if (!made) {
            outcome = made.error();
            return;
        }
        drawable = std::move(*made);
        auto frame = makeFrameSpec(drawable.grid, opaqueStyles(workload.labels.table), kWidth, kHeight);
        if (!frame) {
            outcome = frame.error();
            return;
        }
        spec = std::move(*frame);
        done(render::castRays(drawable.bricks, drawable.grid, spec));
    });
    if (!outcome) return outcome.error();
    const auto measured = measureInTurns(
        {{"SVT", [&] { done(voxelize::voxelize(workload.meshes, drawable.grid, workload.labels.claims)); }},
         {"make bricks",
          [&] { done(volume::BrickVolume::fromColumns(drawable.columns, forPictures(drawable.planes))); }},
         {"opaque frame", [&] { done(render::castRays(drawable.bricks, drawable.grid, spec)); }}},
        fewRuns(options));
    Row row;
    row.stage = "scaling";
    row.input = workload.name;
    row.size = sizeText(dimension);
    row.ours = measured[0];
    row.resultBytes = drawable.columns.sizeBytes();
    row.extra = {{"samples_x", dimension.x},
                 {"voxelize_s", measured[0].median},
                 {"columns_bytes", drawable.columns.sizeBytes()},
                 {"bricks_s", measured[1].median},
                 {"bricks_bytes", drawable.bricks.sizeBytes()},
                 {"frame_s", measured[2].median},
                 {"peak_bytes", peak},
                 {"dense_bytes", denseBytes(drawable.grid)}};
    return row;
}

// From a model file to a frame.
struct Built {
    pipeline::BuildOutput output;
    volume::BrickVolume bricks;
    render::FrameSpec spec;
};

Result<Built> buildAndCast(const Input& input) {
    const std::array files{input.file};
    pipeline::BuildOptions buildOptions;
    buildOptions.spacing = Vec3d{0.05, 0.05, 0.05};
    SVT_TRY(output, pipeline::buildVolume(files, buildOptions));
    SVT_TRY(bricks, volume::BrickVolume::fromColumns(output->volume.columns, forPictures(output->volume.planes)));
    SVT_TRY(spec, makeFrameSpec(output->volume.grid, opaqueStyles(output->volume.labels), kWidth, kHeight));
    Built built{std::move(*output), std::move(*bricks), std::move(*spec)};
    SVT_TRY(frame, render::castRays(built.bricks, built.output.volume.grid, built.spec));
    return built;
}

}  // namespace

Result<void> benchScaling(const Workload& workload, const BenchOptions& options, Report& report) {
    std::vector<Vec3i> dimensions{{250, 219, 125}, {500, 438, 250}};
    if (!options.isQuick)
        dimensions.insert(dimensions.end(), {{1000, 875, 500}, {2000, 1750, 1000}, {4000, 3500, 2000}});
    for (const Vec3i dimension : dimensions) {
        SVT_TRY(row, scalingRow(workload, dimension, options));
        report.rows.push_back(std::move(*row));
    }
    return {};
}

Result<void> benchDistrict(const BenchOptions& options, Report& report) {
    tell("district");
    SVT_TRY(input, writeDistrict(options.scratch));
    Result<Built> built = Error(Code::Internal, "not built");
    const std::uint64_t peak = peakMemoryOf([&] { built = buildAndCast(*input); });
    if (!built) return built.error();
    const volume::SemanticVolume& volume = built->output.volume;
    const pipeline::BuildReport& figures = built->output.report;
    MeasureOptions once;
    once.leastRuns = once.mostRuns = 3;
    const auto measured = measureInTurns(
        {{"make bricks", [&] { done(volume::BrickVolume::fromColumns(volume.columns, forPictures(volume.planes))); }},
         {"opaque frame", [&] { done(render::castRays(built->bricks, volume.grid, built->spec)); }}},
        once);
    Row row;
    row.stage = "district";
    row.input = input->name;
    row.size = sizeText(volume.grid.dimension());
    row.ours = measured[1];
    row.resultBytes = volume.columns.sizeBytes();
    row.extra = {{"file_bytes", std::filesystem::file_size(input->file)},
                 {"objects", figures.objects},
                 {"triangles", figures.triangles},
                 {"build_s", figures.seconds.total},
                 {"read_s", figures.seconds.read},
                 {"mesh_s", figures.seconds.mesh},
                 {"voxelize_s", figures.seconds.voxelize},
                 {"columns_bytes", volume.columns.sizeBytes()},
                 {"bricks_s", measured[0].median},
                 {"bricks_bytes", built->bricks.sizeBytes()},
                 {"frame_s", measured[1].median},
                 {"peak_bytes", peak},
                 {"dense_bytes", denseBytes(volume.grid)}};
    report.rows.push_back(std::move(row));
    return {};
}

}  // namespace svt::bench
