#pragma once
/// \file
/// Volumes of a city as 3D Tiles 1.1 with implicit tiling: a quadtree of squares, each with the surfaces of its
/// features, added one by one.
///
///     tileset.json                    the root, and the address template of the others.
///     subtrees/LEVEL/X/Y.subtree      existing squares of five levels, with their boxes and errors.
///     content/LEVEL/X/Y.glb           surfaces; a feature is a building, a table has its attributes.
///
/// The CRS determines the place of the root on the globe, as in tileset_writer.cpp. Content follows the curvature of
/// the globe: each vertex is within a millimetre of its projected place.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace svt::writers {

/// A square of the quadtree. Level 0 is the root; x counts to the east, y to the north.
struct QuadtreeNode {
    int level = 0;
    std::uint32_t x = 0, y = 0;
};

/// The square of the root, and options.
struct CityTilesetFrame {
    Vec3d corner;  ///< lower corner of the root: west, south, lowest; metres of the CRS
    double side = 0;
    int levels = 1;  ///< levels of the quadtree, including the root; 1..24
    std::string crsName;
    std::string source;        ///< source of the city, for display
    VolumeWriteOptions write;  ///< place (of `corner`), lift, faces, from
};

/// The content of a square.
struct TileContent {
    std::string glb;   ///< empty: no content
    Box3d box;         ///< in the frame of the root, metres
    double error = 0;  ///< deviation from the finest content, metres
    std::size_t features = 0;
    bool hasVoxels = false;  ///< a volume without meshes has the surface of its voxels
};

/// A folder to which tiles are added. It appears on disk only with finish().
class CityTileset {
public:
    static constexpr int kMostLevels = 24;

    /// \return the tileset, or CannotProject (no CRS and no place), BadArgument, WouldDestroy, CannotWrite
    [[nodiscard]] static Result<std::unique_ptr<CityTileset>> create(const std::filesystem::path& path,
                                                                     const CityTilesetFrame& frame);
    virtual ~CityTileset() = default;

    /// The next volume of a square; nothing after the last one.
    using NextVolume = std::function<Result<std::optional<volume::SemanticVolume>>()>;

    /// Surfaces of volumes; a feature is a label without parent, with all labels below it. The faces of the model are
    /// used where the volume keeps them, see MeshChoice::Open. Features with rooms or bodies, and labels without
    /// faces, have the surface of their voxels. There, upward faces have the colour of the feature's roofs, and vertical faces
    /// that of its walls, if it has such labels.
    /// \param cell  surfaces are simplified to points one per cube of this side, see simplified(); 0: not at all
    /// Threads: several may call this at the same time. Memory: one volume, and the content.
    /// \return the content, empty if no voxel is filled; or an error of `next`, CannotProject, GridTooLarge, Cancelled
    [[nodiscard]] virtual Result<TileContent> make(const NextVolume& next, double error, double cell) const = 0;
    /// Writes the content of a square, which must not have content yet. \return success, or CannotWrite, DiskFull
    [[nodiscard]] virtual Result<void> add(QuadtreeNode node, const TileContent& content) = 0;
    /// Memory: about 200 bytes per content and per square around it.
    /// \return size of all files, bytes; or NothingSelected without any content, CannotWrite, DiskFull
    [[nodiscard]] virtual Result<std::uint64_t> finish() = 0;
};

}  // namespace svt::writers
