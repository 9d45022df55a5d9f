/// \file
/// Writes a volume as OpenVDB (.vdb, version 224 of the file format), which Blender, Houdini, Maya, Unreal and the
/// OpenVDB library open.
///
/// Grid `label`: the scalar of each voxel, active if it is not background; a float, because some programs cannot read
/// integer grids. Then one grid per class of features with voxels, named by the class (Float, a fog volume): 1 in its
/// voxels, 0 elsewhere. Uniform cubes of 8 and 128 samples are tiles. A voxel's centre is at its whole index, and the
/// transform maps to world coordinates in metres, also for a rotated grid. The metadata of the file contain `svt.json`
/// and `labels.json` of a `.svt`, and `crs`.
///
/// Optionally, each class is a level set: signed distances in metres to the surface of its voxels, negative inside,
/// within three samples of it. Level sets require cubic voxels. Programs convert them to meshes, offset and combine
/// them.
///
/// Implements the format as the OpenVDB library reads it (openvdb/io, openvdb/tree, version 10), without the library.

#include <svt/core/file.hpp>
#include <svt/record/record.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/vdb/vdb_level_set.hpp>
#include <svt/writers/vdb/vdb_tree.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace svt::writers {
namespace {

constexpr std::uint64_t kMagic = 0x56444220;
constexpr std::uint32_t kFileVersion = 224, kLibraryMajor = 10, kLibraryMinor = 0;
constexpr std::uint32_t kZip = 1, kActiveMask = 2;
constexpr std::uint64_t kKeptPartBytes = std::uint64_t{32} << 20;
constexpr std::string_view kLabelGrid = "label";
constexpr volume::Scalar kMostScalars = 1u << 24;                           // that a float holds exactly
constexpr std::string_view kUuid = "73767400-0000-4000-8000-000000000000";  // of any file, so that bytes are equal

std::string vdbString(std::string_view text) {
    std::string bytes;
    appendBytes(bytes, static_cast<std::uint32_t>(text.size()));
    return bytes += text;
}

std::string vdbMetadata(const std::map<std::string, std::string>& entries) {
    std::string bytes;
    appendBytes(bytes, static_cast<std::uint32_t>(entries.size()));
    for (const auto& [name, value] : entries) bytes += vdbString(name) + vdbString("string") + vdbString(value);
    return bytes;
}

/// From index to world: rows are what a step along each axis is, the last one where sample (0, 0, 0) is.
std::string vdbTransform(const volume::Grid& grid) {
    std::string bytes = vdbString("AffineMap");
    for (int row = 0; row < 4; ++row) {
        Vec3d step = grid.origin();
        if (row < 3) {
            Vec3d unit{0, 0, 0};
            unit[row] = 1;
            step = grid.worldFromIndexDirection(unit);
        }
        appendBytes(bytes, step, row < 3 ? 0.0 : 1.0);
    }
    return bytes;
}

struct VdbGrid {
    std::string name, kind;
    std::variant<VdbTree, VdbLevelSet> tree;

    [[nodiscard]] Result<void> write(const VdbSink& topology, const VdbSink& buffers) const {
        return std::visit([&](const auto& some) { return some.write(topology, buffers); }, tree);
    }
};

/// The bytes before the tree of a grid.
std::string gridHead(const VdbGrid& grid, const volume::Grid& samples) {
    std::string bytes;
    appendBytes(bytes, kZip | kActiveMask);
    bytes += vdbMetadata({{"class", grid.kind}, {"name", grid.name}});
    return bytes + vdbTransform(samples);
}

/// The bytes of a part of a grid: counted, and kept if they are few.
struct VdbPart {
    std::uint64_t size = 0;
    std::string kept;

    [[nodiscard]] VdbSink sink() {
        return [this](std::span<const std::byte> bytes) -> Result<void> {
            size += bytes.size();
            if (size <= kKeptPartBytes)
                kept.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            else
                kept = {};
            return {};
        };
    }
};

/// Writes a grid behind its descriptor, which must contain the positions of its parts. Parts that are not kept are made
/// twice.
Result<void> writeGrid(const VdbGrid& grid, const volume::Grid& samples, AtomicFile& file) {
    const std::string head = gridHead(grid, samples);
    VdbPart topology, buffers;
    SVT_DO(grid.write(topology.sink(), buffers.sink()));
    std::string descriptor = vdbString(grid.name) + vdbString("Tree_float_5_4_3") + vdbString("");
    const std::uint64_t begin = file.size() + descriptor.size() + 3 * sizeof(std::int64_t),
                        leaves = begin + head.size() + topology.size;
    appendAs<std::int64_t>(descriptor, begin, leaves, leaves + buffers.size);
    SVT_DO(file.write(descriptor + head));
    const auto sink = [&](std::span<const std::byte> bytes) { return file.write(bytes); };
    auto done = topology.kept.size() == topology.size ? file.write(topology.kept) : grid.write(sink, {});
    if (!done) return done;
    return buffers.kept.size() == buffers.size ? file.write(buffers.kept) : grid.write({}, sink);
}

std::vector<VdbGrid> gridsOf(const volume::SemanticVolume& volume, const VdbBlocks& blocks, bool hasLevelSets) {
    const std::size_t scalars = volume.labels.scalarCount();
    std::vector<std::uint32_t> values(scalars);
    for (std::size_t s = 0; s < scalars; ++s) values[s] = std::bit_cast<std::uint32_t>(static_cast<float>(s));
    std::vector<VdbGrid> grids;
    grids.push_back({std::string(kLabelGrid), "unknown", VdbTree(blocks, std::move(values))});
    std::map<std::string, std::vector<bool>> masks;
    for (const volume::Label& label : volume.labels.labels) {
        if (label.count == 0) continue;
        std::string name = validText(label.className);
        if (name.empty() || name == kLabelGrid) name = "class_" + name;
        const auto mask = masks.try_emplace(name, scalars, false).first;
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) mask->second[s] = true;
    }
    for (const auto& [name, mask] : masks) {
        std::vector<std::uint32_t> ones(scalars);
        for (std::size_t s = 0; s < scalars; ++s) ones[s] = mask[s] ? std::bit_cast<std::uint32_t>(1.0f) : 0;
        VdbTree tree(blocks, std::move(ones));
        if (tree.isEmpty()) continue;
        if (hasLevelSets)
            grids.push_back({name, "level set", VdbLevelSet(blocks, mask, volume.grid.spacing().x)});
        else
            grids.push_back({name, "fog volume", std::move(tree)});
    }
    return grids;
}

Result<void> checkCubes(const volume::Grid& grid) {
    const Vec3d spacing = grid.spacing();
    if (std::abs(spacing.y - spacing.x) <= 1e-6 * spacing.x && std::abs(spacing.z - spacing.x) <= 1e-6 * spacing.x)
        return {};
    return Error(
        Code::BadArgument,
        fmt::format("a level set has voxels that are cubes, and these are {} x {} x {} m; build with one number "
                    "for --spacing, or leave --level-sets out",
                    spacing.x, spacing.y, spacing.z));
}

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: some blocks of 128^3 samples. Cost: the
/// samples of each block are unrolled once, and once more for each grid with active voxels there; three times if the
/// grid has more than 64 MB.
/// \return bytes, or NothingSelected if no label has voxels, CannotWrite, DiskFull, Cancelled; BadArgument as
///         checkedSampleBits(), for more than 2^24 scalars, and for level sets of voxels that are not cubes
Result<std::uint64_t> writeVdb(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    SVT_DO(checkedSampleBits(volume));
    if (volume.labels.scalarCount() > kMostScalars)
        return Error(
            Code::BadArgument,
            fmt::format("the volume has {} scalars, but a float of OpenVDB distinguishes only {}; write another format",
                        volume.labels.scalarCount(), kMostScalars));
    if (options.vdb.hasLevelSets) SVT_DO(checkCubes(volume.grid));
    SVT_TRY(blocks, VdbBlocks::of(volume.columns, options.threads, options.progress));
    const std::vector<VdbGrid> grids = gridsOf(volume, *blocks, options.vdb.hasLevelSets);
    if (grids.size() == 1) return Error(Code::NothingSelected, "the volume has no voxels");
    SVT_TRY(file, AtomicFile::create(path));
    std::string head;
    appendBytes(head, kMagic);
    for (const std::uint32_t number : {kFileVersion, kLibraryMajor, kLibraryMinor}) appendBytes(head, number);
    appendBytes(head, std::int8_t{1});  // grids have offsets
    head += kUuid;
    head += vdbMetadata({{"creator", "svt"},
                         {"crs", validText(volume.crsName)},
                         {"labels.json", volume::writeLabelsJson(volume.labels)},
                         {"svt.json", volume::writeHeaderJson(volume)}});
    appendBytes(head, static_cast<std::uint32_t>(grids.size()));
    SVT_DO(file->write(head));
    for (std::size_t g = 0; g < grids.size(); ++g) {
        Progress::tell(options.progress, "write", double(g) / double(grids.size()));
        SVT_DO(writeGrid(grids[g], volume.grid, *file));
    }
    return file->commit();
}

}  // namespace

record::Members<VdbWriteOptions> membersOf(const VdbWriteOptions*) noexcept {
    using All = VdbWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::hasLevelSets>(
            "levelSets",
            "of a .vdb: each class as signed distances to its surface, three voxels to both sides, not as a mask",
            {.group = "Output", .option = "--level-sets"}),
    };
    return kMembers;
}

extern const VolumeFormat kVdb{.name = "vdb",
                               .endings = ".vdb",
                               .holds = "OpenVDB: a grid of labels, a fog volume or level set for each class",
                               .readers = "Blender, Houdini, Maya, Unreal, OpenVDB",
                               .content = FileContent::Vdb,
                               .isDense = true,
                               .write = writeVdb};

}  // namespace svt::writers
