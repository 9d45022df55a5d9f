#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <chrono>

namespace svt::cli {
namespace {

// BuildArguments are those of all commands that build; these are of this command alone.
struct BuildCommandArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    std::filesystem::path gridOf;
    BuildArguments build;
    bool json = false, verbose = false, strict = false;
};

void printSummary(const pipeline::BuildOutput& built, std::uint64_t fileBytes, const BuildCommandArguments& arguments) {
    const auto dimension = built.volume.grid.dimension();
    const auto spacing = built.volume.grid.spacing();
    fmt::print("{}: {} objects, {} x {} x {} samples of {:.4g} x {:.4g} x {:.4g} m, {:.1f} kB in {:.2f} s\n",
               arguments.output.string(), built.report.objects, dimension.x, dimension.y, dimension.z, spacing.x,
               spacing.y, spacing.z, double(fileBytes) / 1000, built.report.seconds.total);
}

Result<volume::Grid> gridOfVolume(const std::filesystem::path& path, const BuildArguments& build) {
    if (!build.dimension.empty() || !build.spacing.empty() || build.axes != "world")
        return Error(Code::BadArgument,
                     "--grid-of excludes --dimension, --spacing and --axes; the other volume has them already");
    const auto volume = volume::readSvt(path);
    if (!volume) return volume.error();
    return volume->grid;
}

int runBuild(const BuildCommandArguments& arguments) {
    std::optional<pipeline::StyleSheet> sheet;
    auto options = arguments.build.options(sheet);
    if (!options) return fail(options.error());
    if (!arguments.gridOf.empty()) {
        auto grid = gridOfVolume(arguments.gridOf, arguments.build);
        if (!grid) return fail(grid.error());
        options->grid = *grid;
    }
    Diagnostics diagnostics;
    const auto start = std::chrono::steady_clock::now();
    std::optional<TerminalProgress> progress(std::in_place);
    options->progress = progress->get();
    Result<pipeline::BuildOutput> built = pipeline::buildVolume(arguments.inputs, *options, &diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!built) return fail(built.error());
    const auto writeStart = std::chrono::steady_clock::now();
    if (Progress::isCancelled(progress->get())) return fail(Error(Code::Cancelled, "stopped before writing"));
    Progress::tell(progress->get(), "write", 0);
    const auto bytes = volume::writeSvt(built->volume, arguments.output);
    progress.reset();
    if (!bytes) return fail(bytes.error());
    const auto end = std::chrono::steady_clock::now();
    pipeline::BuildReport& report = built->report;
    report.seconds.write = std::chrono::duration<double>(end - writeStart).count();
    report.seconds.total = std::chrono::duration<double>(end - start).count();
    if (arguments.json) {
        Json json;
        json["objects"] = report.objects;
        json["triangles"] = report.triangles;
        json["open"] = report.open;
        json["tJunctions"] = report.tJunctions;
        for (std::size_t c = 0; c < report.closures.size(); ++c)
            json["closures"][std::string(mesh::closureName(mesh::Closure(c)))] = report.closures[c];
        json["uncertainVoxels"] = report.uncertainVoxels;
        json["seconds"] = {{"read", report.seconds.read},         {"mesh", report.seconds.mesh},
                           {"voxelize", report.seconds.voxelize}, {"pack", report.seconds.pack},
                           {"write", report.seconds.write},       {"total", report.seconds.total}};
        json["bytes"] = {{"memory", built->volume.columns.sizeBytes()}, {"file", *bytes}};
        json["dimension"] = toJson(built->volume.grid.dimension());
        json["spacing"] = toJson(built->volume.grid.spacing());
        json["overlaps"] = overlapsJson(built->volume.labels);
        json["warnings"] = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
        print(json);
    } else if (!isQuiet()) {
        printSummary(*built, *bytes, arguments);
    }
    const bool isFlawed = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error) != 0;
    if (arguments.strict && isFlawed) {
        note("the model has defects (--strict)");
        return kInvalid;
    }
    return kDone;
}

}  // namespace

Action connectBuild(Command& command) {
    auto arguments = std::make_shared<BuildCommandArguments>();
    command.set("input", arguments->inputs);
    command.set("--output", arguments->output);
    arguments->build.connect(command);
    command.set("--grid-of", arguments->gridOf);
    command.take("--vectors", [arguments](const std::vector<std::string>& kinds) {
        for (const std::string& kind : kinds) {
            if (kind == "edges") arguments->build.vectors.edges = true;
            if (kind == "meshes") arguments->build.vectors.meshes = true;
        }
    });
    command.set("--json", arguments->json);
    command.set("--strict", arguments->strict);
    command.set("--verbose", arguments->verbose);
    return [arguments] { return runBuild(*arguments); };
}

}  // namespace svt::cli
