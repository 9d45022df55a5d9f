#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/voxel_tileset.hpp>

#include <svt/volume/dense.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/tiles3d/quadtree_index.hpp>
#include <svt/writers/tiles3d/tile_glb.hpp>
#include <svt/writers/tiles3d/tileset_frame.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

constexpr std::int32_t kTileSide = 64;  // voxels, at most, as long as the levels suffice
constexpr int kMostLevels = 7;
constexpr std::string_view kContentVoxels = "3DTILES_content_voxels", kPrimitiveVoxels = "EXT_primitive_voxels";

/// The octree: levels, and the voxels of a tile along each axis.
struct Octree {
    int levels = 1;
    Vec3i tile{1, 1, 1};

    explicit Octree(Vec3i dimension) {
        const std::int32_t longest = std::max({dimension.x, dimension.y, dimension.z});
        while (levels < kMostLevels && (longest + (1 << (levels - 1)) - 1) >> (levels - 1) > kTileSide) ++levels;
        const std::int32_t along = 1 << (levels - 1);
        for (int axis = 0; axis < 3; ++axis) tile[axis] = (dimension[axis] + along - 1) / along;
    }
    /// Index of a tile within its level: bits of x, y and z by turns.
    [[nodiscard]] static std::size_t morton(Vec3i place, int level) {
        std::size_t index = 0;
        for (int bit = 0; bit < level; ++bit)
            for (int axis = 0; axis < 3; ++axis) index |= std::size_t(place[axis] >> bit & 1) << (3 * bit + axis);
        return index;
    }
    /// Tiles of all levels before this one: (8^level - 1) / 7.
    [[nodiscard]] static std::size_t before(int level) { return ((std::size_t{1} << (3 * level)) - 1) / 7; }
};

TilesetJson voxelSchema() {
    const TilesetJson bytes{{"type", "VEC4"}, {"componentType", "UINT8"}, {"required", true}};
    return {{"id", "svt"}, {"classes", {{"voxel", {{"properties", {{"label", bytes}, {"color", bytes}}}}}}}};
}

/// Colours and scalars of a tile in the order of the extension.
std::string tileBytes(const volume::SemanticVolume& level, const std::vector<std::uint32_t>& looks, Vec3i first,
                      Vec3i tile, int threads) {
    Vec3i end = first + tile;
    for (int axis = 0; axis < 3; ++axis) {
        end[axis] = std::min(end[axis], level.grid.dimension()[axis]);
        if (first[axis] >= end[axis]) return {};
    }
    const Vec3i size = end - first;
    std::vector<volume::Scalar> samples(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
    volume::copyBox<volume::Scalar>(level.columns, {first.y, end.y, first.z, end.z, first.x, end.x}, samples, threads);
    if (std::all_of(samples.begin(), samples.end(), [](volume::Scalar s) { return s == 0; })) return {};
    const std::size_t count = std::size_t(tile.x) * std::size_t(tile.y) * std::size_t(tile.z);
    std::string bytes(8 * count, '\0');
    std::size_t sample = 0;
    for (std::int32_t k = 0; k < size.z; ++k)
        for (std::int32_t j = 0; j < size.y; ++j)
            for (std::int32_t i = 0; i < size.x; ++i, ++sample) {
                const auto at =
                    std::size_t(i) +
                    std::size_t(tile.x) * (std::size_t(k) + std::size_t(tile.z) * std::size_t(tile.y - 1 - j));
                const volume::Scalar scalar = samples[sample];
                for (std::size_t byte = 0; byte < 4; ++byte) {
                    bytes[4 * at + byte] = static_cast<char>(scalar >> (8 * byte) & 0xFF);
                    bytes[4 * (count + at) + byte] = static_cast<char>(looks[scalar] >> (24 - 8 * byte) & 0xFF);
                }
            }
    return bytes;
}

/// A tile as .glb: a primitive whose vertices are voxels.
std::string tileGlb(const std::string& bytes, Vec3i tile, Vec3d size, Vec3d centre) {
    const std::size_t half = bytes.size() / 2;
    const TilesetJson zero = TilesetJson::array({0, 0, 0, 0});
    const TilesetJson primitive{
        {"mode", 2147483647},
        {"attributes", {{"_LABEL", 0}, {"_COLOR", 1}}},
        {"extensions",
         {{kPrimitiveVoxels,
           {{"shape", 0}, {"dimensions", {tile.x, tile.z, tile.y}}, {"noData", {{"_LABEL", zero}, {"_COLOR", zero}}}}},
          {"EXT_structural_metadata", {{"propertyAttributes", {0}}}}}}};
    TilesetJson accessors = TilesetJson::array(), views = TilesetJson::array();
    for (std::size_t n = 0; n < 2; ++n) {
        accessors.push_back({{"bufferView", n}, {"componentType", 5121}, {"type", "VEC4"}, {"count", half / 4}});
        views.push_back({{"buffer", 0}, {"byteOffset", n * half}, {"byteLength", half}});
    }
    const TilesetJson used = TilesetJson::array({kPrimitiveVoxels, "KHR_implicit_shapes", "EXT_structural_metadata"});
    const TilesetJson document{
        {"asset", {{"version", "2.0"}, {"generator", "svt"}}},
        {"extensionsUsed", used},
        {"extensionsRequired", used},
        {"extensions",
         {{"KHR_implicit_shapes", {{"shapes", {{{"type", "box"}, {"box", {{"size", {size.x, size.z, size.y}}}}}}}}},
          {"EXT_structural_metadata",
           {{"schema", voxelSchema()},
            {"propertyAttributes",
             {{{"class", "voxel"},
               {"properties", {{"label", {{"attribute", "_LABEL"}}}, {"color", {{"attribute", "_COLOR"}}}}}}}}}}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}, {"translation", {centre.x, centre.z, -centre.y}}}}},
        {"meshes", {{{"primitives", TilesetJson::array({primitive})}}}},
        {"accessors", accessors},
        {"bufferViews", views},
        {"buffers", {{{"byteLength", bytes.size()}}}}};
    return asGlbFile(document, bytes);
}

/// The one subtree: which tiles there are.
std::string subtreeOf(const std::vector<bool>& isThere) {
    const std::string bits = packedBits(isThere.size(), [&](std::size_t n) { return isThere[n]; });
    const TilesetJson available{{"bitstream", 0}, {"availableCount", std::count(isThere.begin(), isThere.end(), true)}};
    // makeSubtreeFile() sets `buffers`, which comes first here.
    return makeSubtreeFile({{"buffers", nullptr},
                            {"bufferViews", {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bits.size()}}}},
                            {"tileAvailability", available},
                            {"contentAvailability", TilesetJson::array({available})},
                            {"childSubtreeAvailability", {{"constant", 0}}}},
                           bits);
}

std::vector<std::uint32_t> looksOf(const volume::LabelTable& labels) {
    std::vector<std::uint32_t> looks(labels.scalarCount(), 0);
    for (const volume::Label& label : labels.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) looks[s] = lookOf(labels, label, s);
    return looks;
}

/// Writes the tiles, finest first, and which there are: those that are not empty, and those around them on coarser
/// levels.
Result<std::vector<bool>> writeTiles(const volume::SemanticVolume& volume, const Octree& octree,
                                     const VolumeWriteOptions& options, NewFolder& folder) {
    const std::vector<std::uint32_t> looks = looksOf(volume.labels);
    std::vector<bool> isThere(Octree::before(octree.levels));
    const std::string empty(8 * std::size_t(octree.tile.x) * std::size_t(octree.tile.y) * std::size_t(octree.tile.z),
                            '\0');
    for (int level = octree.levels - 1; level >= 0; --level) {
        const int coarser = octree.levels - 1 - level;
        SVT_TRY(made, volume::coarseVolume(volume, coarser, options.threads));
        const Vec3d size = scaled(toDouble(octree.tile), made->grid.spacing());
        for (std::int32_t z = 0; z < 1 << level; ++z)
            for (std::int32_t y = 0; y < 1 << level; ++y)
                for (std::int32_t x = 0; x < 1 << level; ++x) {
                    SVT_DO(checkNotStopped(options.progress, "nothing"));
                    const Vec3i place{x, y, z};
                    const std::size_t index = Octree::before(level) + Octree::morton(place, level);
                    const Vec3i first{x * octree.tile.x, y * octree.tile.y, z * octree.tile.z};
                    std::string bytes = tileBytes(*made, looks, first, octree.tile, options.threads);
                    if (bytes.empty() && !isThere[index]) continue;
                    if (bytes.empty()) bytes = empty;
                    isThere[index] = true;
                    if (level > 0)
                        isThere[Octree::before(level - 1) + Octree::morton({x / 2, y / 2, z / 2}, level - 1)] = true;
                    const Vec3d centre = scaled(size, toDouble(place) + Vec3d{0.5, 0.5, 0.5});
                    const std::string name = fmt::format("tiles/{}/{}/{}/{}.glb", level, x, y, z);
                    SVT_DO(folder.write(name, tileGlb(bytes, octree.tile, size, centre)));
                }
    }
    return isThere;
}

}  // namespace

Result<std::uint64_t> writeVoxelTileset(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                        const VolumeWriteOptions& options) {
    SVT_DO(checkedSampleBits(volume));
    const volume::Grid& grid = volume.grid;
    const Vec3d corner = lowerCorner(grid);
    SVT_TRY(frame, frameOfVolume(volume, corner, options));
    // Tiles lie along the axes of the grid.
    const std::array<Vec3d, 3> world = frame->axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec3d along = grid.axes()[axis];
        frame->axes[axis] = world[0] * along.x + world[1] * along.y + world[2] * along.z;
    }
    NewFolder folder(path);
    SVT_DO(folder.create());
    const Octree octree(grid.dimension());
    SVT_TRY(tiles, writeTiles(volume, octree, options, folder));
    if (!tiles->front()) return Error(Code::NothingSelected, "the volume has no voxels");
    const Vec3i padded = octree.tile * (1 << (octree.levels - 1));
    const Box3d box{{0, 0, 0}, scaled(toDouble(padded), grid.spacing())};
    const double size = length(box.max);
    const TilesetJson content{
        {"uri", "tiles/{level}/{x}/{y}/{z}.glb"},
        {"extensions",
         {{kContentVoxels, {{"dimensions", {octree.tile.x, octree.tile.y, octree.tile.z}}, {"class", "voxel"}}}}}};
    const TilesetJson root{{"transform", transformOf(*frame)},
                           {"boundingVolume", boundingVolume(box)},
                           {"geometricError", size},
                           {"refine", "REPLACE"},
                           {"content", content},
                           {"implicitTiling",
                            {{"subdivisionScheme", "OCTREE"},
                             {"subtreeLevels", octree.levels},
                             {"availableLevels", octree.levels},
                             {"subtrees", {{"uri", "subtree.subtree"}}}}}};
    const TilesetJson used = TilesetJson::array({kContentVoxels});
    const TilesetJson tileset{{"asset", assetOf(volume, corner)}, {"schema", voxelSchema()}, {"extensionsUsed", used},
                              {"extensionsRequired", used},       {"geometricError", size},  {"root", root}};
    const std::string text = tileset.dump(1, ' ', false, TilesetJson::error_handler_t::replace) + "\n";
    SVT_DO(folder.write("subtree.subtree", subtreeOf(*tiles)));
    SVT_DO(folder.write("labels.json", volume::writeLabelsJson(volume.labels)));
    SVT_DO(folder.write("tileset.json", text));
    return folder.commit();
}

}  // namespace svt::writers
