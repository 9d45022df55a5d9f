/// \file
/// Writes the hulls of components as 3D Tiles 1.1, which Cesium, Unreal, Unity and ArcGIS show on the globe: a folder
/// with `tileset.json` and tiles of some hundred thousand triangles, `0.glb`, `1.glb`, ...
///
/// Vertices reference their component (EXT_mesh_features). A table contains id, name, class, parent, storey, volume
/// and attributes of each component (EXT_structural_metadata). On request, features are buildings.
///
/// Place: `root.transform` takes metres from the grid's lower corner (x, y, z of the world) to metres from the earth's
/// centre (EPSG:4978). If the place comes from the CRS of the volume, the frame has the axes and the scale of the
/// projection, so that each point is at its projected place. Heights count as heights over the ellipsoid. If they are
/// above sea level, TilesetWriteOptions::lift adds the height of the geoid. If TilesetWriteOptions::place is set, x is
/// east and y is north. `asset.extras` has corner and CRS.

#include <svt/record/record.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/feature_glb.hpp>
#include <svt/writers/tiles3d/tileset_frame.hpp>
#include <svt/writers/tiles3d/voxel_tileset.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

constexpr std::uint64_t kTileTriangles = 300'000;

/// Writes a folder that appears when all of it is written; one that is there is not replaced. Equal volumes give equal
/// bytes. Surfaces are the faces of the model, where the volume keeps them. Memory: that of labelSurfaces(), and one tile.
/// \return bytes of all files, or CannotProject (a volume without a CRS and no place, or a CRS that PROJ cannot
///         convert), BadArgument for an invalid place, NothingSelected, GridTooLarge, WouldDestroy, CannotWrite,
///         Cancelled
Result<std::uint64_t> writeTileset(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                   const VolumeWriteOptions& options) {
    if (options.tileset.hasVoxels) {
        if (options.tileset.isPerBuilding || options.tileset.isCompressed)
            return Error(
                Code::BadArgument,
                fmt::format("{}: tiles of voxels (--voxels) have neither a feature per building nor triangles; "
                            "leave out --per-building and --meshopt, or --voxels",
                            path.string()));
        return writeVoxelTileset(volume, path, options);
    }
    const Vec3d corner = lowerCorner(volume.grid);
    SVT_TRY(frame, frameOfVolume(volume, corner, options));
    NewFolder folder(path);
    SVT_DO(folder.create());
    SVT_TRY(hulls, makeTileHulls(volume, meshChoice(options, MeshChoice::Open), options));
    const FeatureTexts texts = featureTexts(volume);

    const std::size_t count = hulls->surfaces.size();
    TilesetJson children = TilesetJson::array();
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        std::uint64_t triangles = 0;
        // A surface without triangles, which comes before those that cover it, does not end a tile.
        while (end < count && (triangles == 0 || triangles + hulls->surfaces[end].triangles.size() <= kTileTriangles))
            triangles += hulls->surfaces[end++].triangles.size();
        SVT_DO(checkNotStopped(options.progress, "nothing"));
        Progress::tell(options.progress, "write", double(begin) / double(count));
        SVT_TRY(glb, makeFeatureGlb(*hulls, begin, end, texts, options.tileset));
        const std::string name = fmt::format("{}.glb", children.size());
        SVT_DO(folder.write(name, *glb));
        children.push_back({{"boundingVolume", boundingVolume(boxOfHulls(*hulls, begin, end))},
                            {"geometricError", 0},
                            {"content", {{"uri", name}}}});
    }
    const Box3d box = boxOfHulls(*hulls, 0, count);
    const double size = length(box.max - box.min);
    TilesetJson root{{"transform", transformOf(*frame)},
                     {"boundingVolume", boundingVolume(box)},
                     {"geometricError", children.size() == 1 ? 0 : size},
                     {"refine", "ADD"}};
    if (children.size() == 1)
        root["content"] = children[0]["content"];
    else
        root["children"] = std::move(children);
    const TilesetJson tileset{{"asset", assetOf(volume, corner)}, {"geometricError", size}, {"root", std::move(root)}};
    const std::string text = tileset.dump(1, ' ', false, TilesetJson::error_handler_t::replace) + "\n";
    SVT_DO(folder.write("tileset.json", text));
    return folder.commit();
}

}  // namespace

record::Members<TilesetWriteOptions> membersOf(const TilesetWriteOptions*) noexcept {
    using All = TilesetWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::place>("place", "of a .3dtiles: where on the globe the lower corner is",
                                    {.value = "LAT,LON,HEIGHT",
                                     .unit = "degrees and metres",
                                     .otherwise = "that of the CRS",
                                     .group = "Output",
                                     .option = "--place"}),
        record::member<&All::lift>(
            "lift",
            "of a .3dtiles: metres added to heights, such as the height of the geoid where they are over the sea",
            {.value = "M",
             .otherwise = "the height of the geoid, if the CRS names its heights and PROJ has the grid",
             .group = "Output",
             .option = "--lift"}),
        record::member<&All::hasVoxels>(
            "voxels", "of a .3dtiles: voxels by draft extensions, as Cesium has them for trial, not surfaces",
            {.group = "Output", .option = "--voxels"}),
        record::member<&All::isCompressed>(
            "meshopt", "of a .3dtiles: compress the triangles by EXT_meshopt_compression, which the viewer must know",
            {.group = "Output", .option = "--meshopt"}),
        record::member<&All::isPerBuilding>("buildings",
                                            "of a .3dtiles: one feature per building, not per component, as in cities",
                                            {.group = "Output", .option = "--per-building"}),
    };
    return kMembers;
}

extern const VolumeFormat kTileset{
    .name = "tileset",
    .endings = ".3dtiles",
    .holds = "3D Tiles 1.1: a folder with the surfaces on the globe, a table of components in each tile",
    .readers = "Cesium, Unreal, Unity, ArcGIS",
    .content = FileContent::Nothing,
    .write = writeTileset};

}  // namespace svt::writers
