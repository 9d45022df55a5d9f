#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/illustrate/shell.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::cli {
namespace {

struct ShellArguments {
    std::filesystem::path input, output;
    std::string of;
    illustrate::ShellLevel level = illustrate::ShellLevel::Building;
    illustrate::ShellOptions shell;
    writers::VolumeWriteOptions write;
    pipeline::BuildOptions build;
    bool levels = false, json = false;
};

int printLevels(const volume::SemanticVolume& volume, bool isJson) {
    const auto steps = illustrate::shellLevels(volume);
    if (!isJson) {
        fmt::print("{:<12} {:>10} {:>10}\n", "level", "features", "groups");
        for (const illustrate::ShellStep& step : steps)
            fmt::print("{:<12} {:>10} {:>10}\n", nameOf(step.level), step.features, step.groups);
        return kDone;
    }
    Json rows = Json::array();
    for (const illustrate::ShellStep& step : steps)
        rows.push_back({{"level", nameOf(step.level)}, {"features", step.features}, {"groups", step.groups}});
    print(rows);
    return kDone;
}

std::uint64_t filledVoxels(const volume::SemanticVolume& volume) {
    std::uint64_t voxels = 0;
    for (const volume::Label& label : volume.labels.labels) voxels += label.voxels;
    return voxels;
}

Result<Json> writeShell(const volume::SemanticVolume& shell, const volume::SemanticVolume& volume,
                        const ShellArguments& arguments, const Progress* progress) {
    Json json;
    if (endingOf(arguments.output) == ".svt") {
        SVT_TRY(bytes, volume::writeSvt(shell, arguments.output));
        json["bytes"] = *bytes;
        return json;
    }
    if (arguments.write.faces == writers::GlbFaces::Meshes)
        note("--faces meshes: a shell has no faces of the model; it is written as by --faces planes");
    writers::GlbOptions options;
    options.faces = arguments.write.faces;
    options.planesOf = &volume;
    options.threads = arguments.build.threads;
    options.progress = progress;
    SVT_TRY(report, writers::writeGlb(shell, arguments.output, options));
    json["bytes"] = report->bytes;
    json["triangles"] = report->triangles;
    json["meshes"] = report->meshes;
    return json;
}

// Writes the shell; returns the number of voxels before and after, and figures of the output.
Result<Json> makeShell(const volume::SemanticVolume& volume, const ShellArguments& arguments,
                       const Progress* progress) {
    illustrate::ShellOptions options = arguments.shell;
    options.threads = arguments.build.threads;
    options.progress = progress;
    if (!arguments.of.empty()) {
        SVT_TRY(selected, analyze::selectWithParts(volume, arguments.of));
        options.of = std::move(*selected);
    }
    Progress::tell(progress, "shell", 0);
    SVT_TRY(shell, illustrate::extractShell(volume, arguments.level, options));
    Progress::tell(progress, "write", 0);
    SVT_TRY(written, writeShell(*shell, volume, arguments, progress));
    Json json;
    json["level"] = nameOf(arguments.level);
    json["voxels"] = filledVoxels(*shell);
    json["voxelsBefore"] = filledVoxels(volume);
    json.update(*written);
    return json;
}

Result<void> check(const ShellArguments& arguments) {
    if (arguments.levels != arguments.output.empty())
        return Error(Code::BadArgument, "expected either -o S.svt or -o S.glb, or --levels to list the levels");
    if (!arguments.of.empty())
        if (auto query = model::Query::parse(arguments.of); !query) return query.error();
    return {};
}

Result<int> runShell(const ShellArguments& arguments) {
    SVT_DO(check(arguments));
    auto progress = std::make_unique<TerminalProgress>();
    SVT_TRY(volume, loadVolume(arguments.input, arguments.build, progress->get(), false));
    if (arguments.levels) {
        progress.reset();
        return printLevels(*volume, arguments.json);
    }
    const auto json = makeShell(*volume, arguments, progress->get());
    progress.reset();
    if (!json) return json.error();
    if (endingOf(arguments.output) == ".svt") noteLostFields(arguments.input);
    if (arguments.json) {
        print(*json);
        return kDone;
    }
    std::string text =
        fmt::format("{}: {} of {} voxels, {:.1f} kB", arguments.output.string(), (*json)["voxels"].get<std::uint64_t>(),
                    (*json)["voxelsBefore"].get<std::uint64_t>(), (*json)["bytes"].get<double>() / 1000);
    if (json->contains("triangles"))
        text += fmt::format(", {} triangles in {} meshes", (*json)["triangles"].get<std::uint64_t>(),
                            (*json)["meshes"].get<std::uint64_t>());
    summarize(text);
    return kDone;
}

Members<ShellArguments> membersOf(const ShellArguments*) noexcept {
    using All = ShellArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>("a .svt or a model file"),
        member<&All::output>("-o,--output",
                             "file to write; the extension selects the format: .svt (volume) or .glb (triangles)",
                             {.value = "FILE", .file = FileUse::Output, .formats = "svt|glb"}),
        member<&All::level>("--level", "level of the hulls", {.group = "Shell", .isForProjects = true}),
        member<&All::of>("--of", "only groups that contain selected features", {.value = "QUERY", .group = "Shell"}),
        member<&All::shell, &illustrate::ShellOptions::thickness>(
            "--thickness", "thickness of the hull in metres, rounded up to voxels",
            {.value = "M", .least = 0, .otherwise = "two voxels", .group = "Shell", .isForProjects = true}),
        member<&All::shell, &illustrate::ShellOptions::labels>(
            "--labels", "label of the voxels: that of their component, or one per group",
            {.group = "Shell", .isForProjects = true}),
        part<&All::write>("write", "--faces"),
        member<&All::levels>("--levels", "list the levels of the model, as named by --level, and write nothing",
                             {.group = "Output"}),
        jsonOption<&All::json>("print figures as JSON on stdout"),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kShellCommand =
    commandOf<ShellArguments, runShell>("shell", "Reduce a volume to the hulls of rooms, flats, storeys or buildings");

}  // namespace svt::cli
