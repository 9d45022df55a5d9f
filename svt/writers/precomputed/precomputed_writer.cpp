#include <svt/core/parallel.hpp>
#include <svt/image/color_text.hpp>
#include <svt/record/record.hpp>
#include <svt/writers/dense/coarser_levels.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/dense/sample_band.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/hulls/label_hulls.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/precomputed/precomputed_shards.hpp>
#include <svt/writers/precomputed/precomputed_writer.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace svt::writers {
namespace {

using SceneJson = nlohmann::ordered_json;

constexpr std::int32_t kSide = 64, kBlock = 8;
constexpr double kNanometres = 1e9;

/// The sizes of indices that the format has; of a block with `count` values.
std::uint32_t bitsFor(std::size_t count) {
    std::uint32_t bits = 0;
    while (bits < 32 && (std::size_t{1} << bits) < count) bits = bits == 0 ? 1 : bits * 2;
    return bits;
}

/// The values of a block in order of place; places beyond the chunk have the first value.
std::vector<std::uint32_t> blockValues(std::span<const std::uint32_t> values, Vec3i size, Vec3i first) {
    std::vector<std::uint32_t> block;
    block.reserve(kBlock * kBlock * kBlock);
    const auto at = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        return values[std::size_t(x) + std::size_t(size.x) * (std::size_t(y) + std::size_t(size.y) * std::size_t(z))];
    };
    for (std::int32_t z = first.z; z < first.z + kBlock; ++z)
        for (std::int32_t y = first.y; y < first.y + kBlock; ++y)
            for (std::int32_t x = first.x; x < first.x + kBlock; ++x)
                block.push_back(x < size.x && y < size.y && z < size.z ? at(x, y, z) : at(first.x, first.y, first.z));
    return block;
}

SceneJson triple(Vec3d v) { return SceneJson::array({v.x, v.y, v.z}); }

SceneJson shardingOf(Vec3i dimension) {
    Vec3i chunks;
    for (int axis = 0; axis < 3; ++axis) chunks[axis] = (dimension[axis] + kSide - 1) / kSide;
    const ShardBits bits = ShardBits::of(chunks);
    return {{"@type", "neuroglancer_uint64_sharded_v1"},
            {"preshift_bits", bits.chunk},
            {"hash", "identity"},
            {"minishard_bits", bits.minishard},
            {"shard_bits", bits.shard},
            {"minishard_index_encoding", "gzip"},
            {"data_encoding", "gzip"}};
}

std::string infoJson(const std::vector<const volume::SemanticVolume*>& levels, const VolumeWriteOptions& options) {
    SceneJson scales = SceneJson::array();
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const Vec3i d = levels[l]->grid.dimension();
        scales.push_back({{"key", std::to_string(l)},
                          {"size", {d.x, d.y, d.z}},
                          {"resolution", triple(levels[l]->grid.spacing() * kNanometres)},
                          {"voxel_offset", {0, 0, 0}},
                          {"chunk_sizes", {{kSide, kSide, kSide}}},
                          {"encoding", "compressed_segmentation"},
                          {"compressed_segmentation_block_size", {kBlock, kBlock, kBlock}}});
        if (options.precomputed.isSharded) scales.back()["sharding"] = shardingOf(d);
    }
    SceneJson info{{"@type", "neuroglancer_multiscale_volume"},
                   {"type", "segmentation"},
                   {"data_type", "uint32"},
                   {"num_channels", 1},
                   {"segment_properties", "properties"},
                   {"scales", scales}};
    if (options.precomputed.hasMeshes) info["mesh"] = "mesh";
    return info.dump(1) + "\n";
}

std::string propertiesJson(const volume::SemanticVolume& volume) {
    SceneJson ids = SceneJson::array(), names = ids, classes = ids, gmlIds = ids, volumes = ids;
    const auto voxels = volume.columns.countVoxels(volume.labels.scalarCount());
    for (const volume::Label& label : volume.labels.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) {
            ids.push_back(std::to_string(s));
            names.push_back(shownName(label));
            classes.push_back(label.className);
            gmlIds.push_back(label.id);
            volumes.push_back(static_cast<double>(voxels[s]) * volume.grid.voxelVolume());
        }
    const SceneJson properties =
        SceneJson::array({{{"id", "label"}, {"type", "label"}, {"values", names}},
                          {{"id", "class"}, {"type", "string"}, {"values", classes}},
                          {{"id", "gml_id"}, {"type", "string"}, {"values", gmlIds}},
                          {{"id", "volume"}, {"type", "number"}, {"data_type", "float32"}, {"values", volumes}}});
    const SceneJson info{{"@type", "neuroglancer_segment_properties"},
                         {"inline", {{"ids", ids}, {"properties", properties}}}};
    return info.dump(1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

/// A state of neuroglancer: one layer in our colours. Its voxels begin half a voxel before the first sample.
std::string stateJson(const volume::SemanticVolume& volume) {
    SceneJson colors = SceneJson::object(), segments = SceneJson::array();
    for (const volume::Label& label : volume.labels.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) {
            colors[std::to_string(s)] = image::colorText(colorOf(volume.labels, label, s));
            segments.push_back(std::to_string(s));
        }
    const Vec3d x = volume.grid.worldFromIndexDirection({1, 0, 0}), y = volume.grid.worldFromIndexDirection({0, 1, 0}),
                z = volume.grid.worldFromIndexDirection({0, 0, 1}), o = lowerCorner(volume.grid);
    const SceneJson metres = SceneJson::array({1, "m"});
    const SceneJson transform{{"matrix", {{x.x, y.x, z.x, o.x}, {x.y, y.y, z.y, o.y}, {x.z, y.z, z.z, o.z}}},
                              {"outputDimensions", {{"x", metres}, {"y", metres}, {"z", metres}}}};
    const SceneJson layer{{"type", "segmentation"},
                          {"name", volume.modelName.empty() ? "svt" : volume.modelName},
                          {"source", {{"url", "precomputed://ADDRESS"}, {"transform", transform}}},
                          {"segmentColors", colors},
                          {"segments", segments}};
    const SceneJson state{{"dimensions", {{"x", metres}, {"y", metres}, {"z", metres}}},
                          {"layers", SceneJson::array({layer})},
                          {"layout", "4panel"}};
    return state.dump(1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

Result<void> writeLevel(const volume::ColumnVolume& columns, const std::string& key, const VolumeWriteOptions& options,
                        NewFolder& folder) {
    const Vec3i dimension = columns.dimension();
    for (std::int32_t k = 0; k < dimension.z; k += kSide) {
        Progress::tell(options.progress, "write", double(k) / dimension.z);
        for (std::int32_t j = 0; j < dimension.y; j += kSide) {
            SVT_DO(checkNotStopped(options.progress, "nothing"));
            const SampleBand<std::uint32_t> band(columns, j, k, kSide, options.threads);
            std::vector<std::vector<std::uint32_t>> chunks(static_cast<std::size_t>((dimension.x + kSide - 1) / kSide));
            const auto sizeOf = [&](std::size_t c) {
                return Vec3i{std::min(kSide, dimension.x - static_cast<std::int32_t>(c) * kSide),
                             std::min(kSide, dimension.y - j), std::min(kSide, dimension.z - k)};
            };
            parallelFor(chunks.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t c = begin; c < end; ++c)
                    chunks[c] =
                        compressSegmentation(band.clipped(static_cast<std::int32_t>(c) * kSide, sizeOf(c)), sizeOf(c));
            });
            for (std::size_t c = 0; c < chunks.size(); ++c) {
                const Vec3i first{static_cast<std::int32_t>(c) * kSide, j, k}, end = first + sizeOf(c);
                const std::string name =
                    fmt::format("{}/{}-{}_{}-{}_{}-{}", key, first.x, end.x, first.y, end.y, first.z, end.z);
                const std::string_view text(reinterpret_cast<const char*>(chunks[c].data()), chunks[c].size() * 4);
                SVT_DO(folder.write(name, text));
            }
        }
    }
    return {};
}

/// Vertices in nanometres from the outer corner of the first voxel, along the axes of the grid.
Result<void> writeMeshes(const volume::SemanticVolume& volume, const VolumeWriteOptions& options, NewFolder& folder) {
    SVT_TRY(hulls, makeLabelHulls(volume, options));
    SVT_DO(folder.write("mesh/info", "{\"@type\": \"neuroglancer_legacy_mesh\"}\n"));
    for (std::size_t s = 0; s < hulls->surfaces.size(); ++s) {
        std::string bytes;
        appendBytes(bytes, static_cast<std::uint32_t>(hulls->positions[s].size()));
        for (const Vec3f position : hulls->positions[s])
            for (int axis = 0; axis < 3; ++axis)
                appendBytes(bytes, static_cast<float>(double(position[axis]) * kNanometres));
        for (const auto& triangle : hulls->surfaces[s].triangles)
            for (const std::uint32_t vertex : triangle) appendBytes(bytes, vertex);
        const std::string name = fmt::format("{}.mesh", hulls->surfaces[s].label);
        SVT_DO(folder.write("mesh/" + name, bytes));
        const volume::Label& label = hulls->label(s);
        for (volume::Scalar n = label.first; n < label.first + label.count; ++n)
            if (auto done =
                    folder.write(fmt::format("mesh/{}:0", n), fmt::format("{{\"fragments\": [\"{}\"]}}\n", name));
                !done)
                return done;
    }
    return {};
}

}  // namespace

std::vector<std::uint32_t> compressSegmentation(std::span<const std::uint32_t> values, Vec3i size) {
    const Vec3i blocks{(size.x + kBlock - 1) / kBlock, (size.y + kBlock - 1) / kBlock, (size.z + kBlock - 1) / kBlock};
    const std::size_t count = std::size_t(blocks.x) * std::size_t(blocks.y) * std::size_t(blocks.z);
    std::vector<std::uint32_t> words(2 * count, 0);  // offsets count from here
    std::map<std::vector<std::uint32_t>, std::uint32_t> tables;
    std::size_t block = 0;
    for (std::int32_t z = 0; z < size.z; z += kBlock)
        for (std::int32_t y = 0; y < size.y; y += kBlock)
            for (std::int32_t x = 0; x < size.x; x += kBlock, ++block) {
                const auto content = blockValues(values, size, {x, y, z});
                std::vector<std::uint32_t> table = content;
                std::sort(table.begin(), table.end());
                table.erase(std::unique(table.begin(), table.end()), table.end());
                const std::uint32_t bits = bitsFor(table.size());
                const auto valuesAt = static_cast<std::uint32_t>(words.size());
                words.resize(words.size() + content.size() * bits / 32, 0);
                for (std::size_t p = 0; bits > 0 && p < content.size(); ++p) {
                    const auto index = static_cast<std::uint32_t>(
                        std::lower_bound(table.begin(), table.end(), content[p]) - table.begin());
                    words[valuesAt + p * bits / 32] |= index << (p * bits % 32);
                }
                const auto [known, isNew] = tables.try_emplace(table, static_cast<std::uint32_t>(words.size()));
                if (isNew) words.insert(words.end(), table.begin(), table.end());
                words[2 * block] = known->second | bits << 24;
                words[2 * block + 1] = valuesAt;
            }
    words.insert(words.begin(), 1);  // where the one channel begins
    return words;
}

Result<std::uint64_t> writePrecomputed(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                       const VolumeWriteOptions& options) {
    SVT_DO(checkedSampleBits(volume));
    NewFolder folder(path);
    SVT_DO(folder.create());
    SVT_TRY(coarser, coarserLevels(volume, options.threads));
    std::vector<const volume::SemanticVolume*> levels{&volume};
    for (const volume::SemanticVolume& level : *coarser) levels.push_back(&level);
    SVT_DO(folder.write("info", infoJson(levels, options)));
    SVT_DO(folder.write("properties/info", propertiesJson(volume)));
    SVT_DO(folder.write("state.json", stateJson(volume)));
    for (std::size_t l = 0; l < levels.size(); ++l)
        SVT_DO(options.precomputed.isSharded
                   ? writeShards(levels[l]->columns, kSide, std::to_string(l), options, folder)
                   : writeLevel(levels[l]->columns, std::to_string(l), options, folder));
    if (options.precomputed.hasMeshes) SVT_DO(writeMeshes(volume, options, folder));
    return folder.commit();
}

record::Members<PrecomputedWriteOptions> membersOf(const PrecomputedWriteOptions*) noexcept {
    using All = PrecomputedWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::hasMeshes>("meshes", "of a .precomputed: also the surface of each label, for the 3D view",
                                        {.group = "Output", .option = "--meshes"}),
        record::member<&All::isSharded>(
            "sharded",
            "of a .precomputed: up to 64 chunks in a file, packed; the web server has to answer requests for ranges",
            {.group = "Output", .option = "--sharded"}),
    };
    return kMembers;
}

extern const VolumeFormat kPrecomputed{
    .name = "precomputed",
    .endings = ".precomputed",
    .holds = "neuroglancer's precomputed segmentation: a folder with all levels, names and colours",
    .readers = "neuroglancer, CloudVolume",
    .content = FileContent::Nothing,
    .isDense = true,
    .write = writePrecomputed};

}  // namespace svt::writers
