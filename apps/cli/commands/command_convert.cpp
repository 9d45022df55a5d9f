#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/output/file_content.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace svt::cli {
namespace {

struct ConvertArguments {
    std::filesystem::path input, output;
    std::string encoding, faces, select, texture, cityGml, zarr, merge, holes, vents;
    std::filesystem::path model;
    double maxVoxels = 0, maxBoxes = 0, lift = 0;
    std::vector<double> box, place;
    int level = 0;
    bool hasMeshes = false;
    BuildArguments build;
};

// What of the volume is written: a box of it, some of its labels, a level.
Result<volume::SemanticVolume> partOf(volume::SemanticVolume volume, const ConvertArguments& arguments) {
    if (const auto& box = arguments.box; !box.empty()) {
        const auto samples = volume::samplesIn(volume.grid, {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
        if (!samples) return samples.error();
        auto cropped = volume::croppedVolume(volume, *samples);
        if (!cropped) return cropped;
        volume = std::move(*cropped);
    }
    if (!arguments.select.empty()) {
        const auto labels = analyze::selectLabels(volume.labels, arguments.select);
        if (!labels) return labels.error();
        auto selected = volume::selectedVolume(volume, *labels);
        if (!selected) return selected;
        volume = std::move(*selected);
    }
    return volume::coarseVolume(volume, arguments.level, arguments.build.threads);
}

int runConvert(const ConvertArguments& arguments) {
    Diagnostics diagnostics;
    const TerminalProgress progress;
    BuildArguments build = arguments.build;
    // Of rooms, the bodies as the model has them.
    const writers::VolumeFormat* format = writers::volumeFormatOf(arguments.output);
    if (format != nullptr && format->name == "indoorgml") build.vectors = {.meshes = true, .isRequired = false};
    auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    volume = partOf(std::move(*volume), arguments);
    if (!volume) return fail(volume.error());
    Progress::tell(progress.get(), "write", 0);
    writers::VolumeWriteOptions options;
    options.isCompressed = arguments.encoding == "gzip";
    options.faces = arguments.faces == "voxels" ? writers::GlbFaces::Voxels : writers::GlbFaces::Planes;
    options.texture = arguments.texture == "image"      ? writers::TextureKind::Image
                      : arguments.texture == "composed" ? writers::TextureKind::Composed
                                                        : writers::TextureKind::Pixel;
    options.maxVoxels = static_cast<std::uint64_t>(arguments.maxVoxels);
    options.model = arguments.model;
    if (options.model.empty() && contentOf(arguments.input) == FileContent::CityGml) options.model = arguments.input;
    options.cityGmlVersion = arguments.cityGml.empty() ? 0 : arguments.cityGml.front() - '0';
    options.zarrVersion = arguments.zarr == "3" ? 3 : 2;
    if (const auto& place = arguments.place; !place.empty()) options.place = Vec3d{place[0], place[1], place[2]};
    options.lift = arguments.lift;
    options.hasMeshes = arguments.hasMeshes;
    options.mergeBy = arguments.merge == "class"      ? writers::MergeBy::Class
                      : arguments.merge == "material" ? writers::MergeBy::Material
                                                      : writers::MergeBy::Label;
    options.maxBoxes = static_cast<std::size_t>(arguments.maxBoxes);
    for (const auto& [query, labels] :
         {std::pair{&arguments.holes, &options.holes}, std::pair{&arguments.vents, &options.vents}}) {
        if (query->empty()) continue;
        auto selected = analyze::selectLabels(volume->labels, *query);
        if (!selected) return fail(selected.error());
        *labels = std::move(*selected);
    }
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    const auto bytes = writers::writeVolume(*volume, arguments.output, options);
    return bytes ? static_cast<int>(kDone) : fail(bytes.error());
}

}  // namespace

Action connectConvert(Command& command) {
    auto arguments = std::make_shared<ConvertArguments>();
    command.set("input", arguments->input);
    command.set("output", arguments->output);
    command.set("--select", arguments->select);
    command.set("--box", arguments->box);
    command.set("--level", arguments->level);
    command.set("--encoding", arguments->encoding);
    command.set("--faces", arguments->faces);
    command.set("--texture", arguments->texture);
    command.set("--model", arguments->model);
    command.set("--zarr", arguments->zarr);
    command.set("--meshes", arguments->hasMeshes);
    command.set("--place", arguments->place);
    command.set("--lift", arguments->lift);
    command.set("--citygml", arguments->cityGml);
    command.set("--max-voxels", arguments->maxVoxels);
    command.set("--merge", arguments->merge);
    command.set("--max-boxes", arguments->maxBoxes);
    command.set("--holes", arguments->holes);
    command.set("--vents", arguments->vents);
    arguments->build.connect(command);
    return [arguments] { return runConvert(*arguments); };
}

}  // namespace svt::cli
