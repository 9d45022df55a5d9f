#include <apps/cli/cli.hpp>
#include <apps/cli/output/json_output.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/illustrate/shell.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/writers/glb_writer.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input, output;
    std::string level = "building", labels = "components", faces = "planes", of;
    double thickness = 0;
    BuildArguments build;
    bool levels = false, json = false;
};

int printLevels(const volume::SemanticVolume& volume, bool isJson) {
    const auto steps = illustrate::shellLevels(volume);
    if (!isJson) {
        fmt::print("{:<12} {:>10} {:>10}\n", "level", "features", "groups");
        for (const illustrate::ShellStep& step : steps)
            fmt::print("{:<12} {:>10} {:>10}\n", illustrate::shellLevelName(step.level), step.features, step.groups);
        return kDone;
    }
    Json rows = Json::array();
    for (const illustrate::ShellStep& step : steps)
        rows.push_back(
            {{"level", illustrate::shellLevelName(step.level)}, {"features", step.features}, {"groups", step.groups}});
    print(rows);
    return kDone;
}

std::uint64_t filledVoxels(const volume::SemanticVolume& volume) {
    std::uint64_t voxels = 0;
    for (const volume::Label& label : volume.labels.labels) voxels += label.voxels;
    return voxels;
}

Result<Json> writeShell(const volume::SemanticVolume& shell, const volume::SemanticVolume& volume,
                        const Arguments& arguments, const Progress* progress) {
    Json json;
    if (arguments.output.extension() == ".svt") {
        const auto bytes = volume::writeSvt(shell, arguments.output);
        if (!bytes) return bytes.error();
        json["bytes"] = *bytes;
        return json;
    }
    writers::GlbOptions options;
    options.faces = arguments.faces == "voxels" ? writers::GlbFaces::Voxels : writers::GlbFaces::Planes;
    options.planesOf = &volume;
    options.threads = arguments.build.threads;
    options.progress = progress;
    const auto report = writers::writeGlb(shell, arguments.output, options);
    if (!report) return report.error();
    json["bytes"] = report->bytes;
    json["triangles"] = report->triangles;
    json["meshes"] = report->meshes;
    return json;
}

// Writes the shell; returns the number of voxels before and after, and figures of the output.
Result<Json> makeShell(const volume::SemanticVolume& volume, const Arguments& arguments, const Progress* progress) {
    illustrate::ShellOptions options;
    options.thickness = arguments.thickness;
    options.labels =
        arguments.labels == "groups" ? illustrate::ShellLabels::Groups : illustrate::ShellLabels::Components;
    options.threads = arguments.build.threads;
    options.progress = progress;
    if (!arguments.of.empty()) {
        auto selected = analyze::selectLabels(volume.labels, arguments.of);
        if (!selected) return selected.error();
        options.of = std::move(*selected);
    }
    const auto shell = illustrate::extractShell(volume, *illustrate::shellLevelFromName(arguments.level), options);
    if (!shell) return shell.error();
    auto written = writeShell(*shell, volume, arguments, progress);
    if (!written) return written.error();
    Json json;
    json["level"] = arguments.level;
    json["voxels"] = filledVoxels(*shell);
    json["voxelsBefore"] = filledVoxels(volume);
    json.update(*written);
    return json;
}

Result<void> check(const Arguments& arguments) {
    if (!(arguments.thickness >= 0) || !std::isfinite(arguments.thickness))
        return Error(Code::BadArgument, fmt::format("--thickness {}: expected metres, 0 or more; 0 gives two voxels",
                                                    arguments.thickness));
    if (arguments.levels != arguments.output.empty())
        return Error(Code::BadArgument, "expected either -o S.svt or -o S.glb, or --levels to list the levels");
    const std::string extension = arguments.output.extension().string();
    if (!arguments.levels && extension != ".svt" && extension != ".glb")
        return Error(Code::BadArgument, fmt::format("'{}': cannot write '{}'; possible are .svt and .glb",
                                                    arguments.output.string(), extension));
    if (!arguments.of.empty())
        if (auto query = model::Query::parse(arguments.of); !query) return query.error();
    return {};
}

int runShell(const Arguments& arguments) {
    if (auto checked = check(arguments); !checked) return fail(checked.error());
    Diagnostics diagnostics;
    auto progress = std::make_unique<TerminalProgress>();
    const auto volume = loadVolume(arguments.input, arguments.build, progress->get(), diagnostics);
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    if (arguments.levels) {
        progress.reset();
        return printLevels(*volume, arguments.json);
    }
    const auto json = makeShell(*volume, arguments, progress->get());
    progress.reset();
    if (!json) return fail(json.error());
    if (arguments.json) {
        print(*json);
        return kDone;
    }
    fmt::print("{}: {} of {} voxels, {:.1f} kB", arguments.output.string(), (*json)["voxels"].get<std::uint64_t>(),
               (*json)["voxelsBefore"].get<std::uint64_t>(), (*json)["bytes"].get<double>() / 1000);
    if (json->contains("triangles"))
        fmt::print(", {} triangles in {} meshes", (*json)["triangles"].get<std::uint64_t>(),
                   (*json)["meshes"].get<std::uint64_t>());
    fmt::print("\n");
    return kDone;
}

}  // namespace

Run addShellCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("shell", "Leave only the hull of rooms, flats, storeys or buildings");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "what to write; the extension tells the format: .svt (volume) or .glb (triangles)")
        ->type_name("FILE");
    command->add_option("--level", arguments->level, "whose hull stays")
        ->group("Shell")
        ->check(CLI::IsMember({"component", "room", "unit", "storey", "building"}))
        ->capture_default_str();
    command->add_option("--of", arguments->of, "only the groups that have something of what the query selects")
        ->group("Shell")
        ->type_name("QUERY");
    command
        ->add_option("--thickness", arguments->thickness,
                     "thickness of the hull in metres, rounded up to voxels; default: two voxels")
        ->group("Shell")
        ->type_name("M");
    command
        ->add_option("--labels", arguments->labels,
                     "whose label the voxels keep: that of their component, or one per group")
        ->group("Shell")
        ->check(CLI::IsMember({"components", "groups"}))
        ->capture_default_str();
    command
        ->add_option("--faces", arguments->faces,
                     "slopes of a .glb: planes (flat, as far as the volume knows them) or voxels (stairs)")
        ->group("Output")
        ->check(CLI::IsMember({"planes", "voxels"}))
        ->capture_default_str();
    command->add_flag("--levels", arguments->levels, "list the levels of the model and write nothing")->group("Output");
    command->add_flag("--json", arguments->json, "print figures as JSON on stdout")->group("Output");
    arguments->build.addTo(*command);
    return [arguments] { return runShell(*arguments); };
}

}  // namespace svt::cli
