#include <apps/cli/options/write_options.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/volume/volume_part.hpp>

#include <utility>

namespace svt::cli {

void WriteArguments::connect(Command& command) {
    command.set("--select", select);
    command.set("--box", box);
    command.set("--level", level);
    command.set("--encoding", encoding);
    command.set("--faces", faces);
    command.set("--texture", texture);
    command.set("--model", model);
    command.set("--zarr", zarr);
    command.set("--meshes", hasMeshes);
    command.set("--sharded", isSharded);
    command.set("--place", place);
    command.set("--lift", lift);
    command.set("--voxels", hasVoxels);
    command.set("--level-sets", hasLevelSets);
    command.set("--citygml", cityGml);
    command.set("--max-voxels", maxVoxels);
    command.set("--merge", merge);
    command.set("--max-boxes", maxBoxes);
    command.set("--holes", holes);
    command.set("--vents", vents);
}

Result<volume::SemanticVolume> WriteArguments::partOf(volume::SemanticVolume volume, int threads) const {
    if (!box.empty()) {
        const auto samples = volume::samplesIn(volume.grid, {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
        if (!samples) return samples.error();
        auto cropped = volume::croppedVolume(volume, *samples);
        if (!cropped) return cropped;
        volume = std::move(*cropped);
    }
    if (!select.empty()) {
        SVT_TRY(labels, analyze::selectLabels(volume.labels, select));
        auto selected = volume::selectedVolume(volume, *labels);
        if (!selected) return selected;
        volume = std::move(*selected);
    }
    return volume::coarseVolume(volume, level, threads);
}

Result<writers::VolumeWriteOptions> WriteArguments::options(const volume::SemanticVolume& part) const {
    writers::VolumeWriteOptions options;
    options.isCompressed = encoding == "gzip";
    options.faces = faces == "voxels" ? writers::GlbFaces::Voxels : writers::GlbFaces::Planes;
    options.texture = texture == "image"      ? writers::TextureKind::Image
                      : texture == "composed" ? writers::TextureKind::Composed
                      : texture == "atlas"    ? writers::TextureKind::Atlas
                                              : writers::TextureKind::Pixel;
    options.maxVoxels = static_cast<std::uint64_t>(maxVoxels);
    options.model = model;
    options.cityGmlVersion = cityGml.empty() ? 0 : cityGml.front() - '0';
    options.zarrVersion = zarr == "3" ? 3 : 2;
    if (!place.empty()) options.place = Vec3d{place[0], place[1], place[2]};
    options.lift = lift;
    options.hasMeshes = hasMeshes;
    options.isSharded = isSharded;
    options.hasVoxels = hasVoxels;
    options.hasLevelSets = hasLevelSets;
    options.mergeBy = merge == "class"      ? writers::MergeBy::Class
                      : merge == "material" ? writers::MergeBy::Material
                                            : writers::MergeBy::Label;
    options.maxBoxes = static_cast<std::size_t>(maxBoxes);
    for (const auto& [query, labels] : {std::pair{&holes, &options.holes}, std::pair{&vents, &options.vents}}) {
        if (query->empty()) continue;
        SVT_TRY(selected, analyze::selectLabels(part.labels, *query));
        *labels = std::move(*selected);
    }
    return options;
}

}  // namespace svt::cli
