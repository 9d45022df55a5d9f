#pragma once
/// \file
/// Volumes of a city as 3D Tiles 1.1 with implicit tiling: a quadtree of squares, each with the surfaces of what stands
/// there, added one by one.
///
///     tileset.json                    the root, and how to find the others
///     subtrees/LEVEL/X/Y.subtree      which squares of five levels there are, with their boxes and errors
///     content/LEVEL/X/Y.glb           surfaces; a feature is a building, a table has its attributes
///
/// The root stands on the globe by the CRS, as that of tileset_writer.cpp. Content is bent along the globe: each vertex is
/// where the projection has it, to a millimetre.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace svt::writers {

/// A square of the quadtree. Level 0 is the root; x counts to the east, y to the north.
struct QuadtreeNode {
    int level = 0;
    std::uint32_t x = 0, y = 0;
};

/// The square of the root, and what there is of options.
struct CityTilesetFrame {
    Vec3d corner;  ///< of the root: west, south, lowest; metres of the CRS
    double side = 0;
    int levels = 1;  ///< of the quadtree, the root included; 1..24
    std::string crsName;
    std::string source;        ///< what the city is made of, for people
    VolumeWriteOptions write;  ///< place (of `corner`), lift, faces
};

/// What stands in a square.
struct TileContent {
    std::string glb;   ///< empty: nothing
    Box3d box;         ///< in the frame of the root, metres
    double error = 0;  ///< metres by which it differs from the finest content
    std::size_t features = 0;
};

/// A folder that tiles are added to. Nothing is there before finish().
class CityTileset {
public:
    static constexpr int kMostLevels = 24;

    /// \return the tileset, or CannotProject (no CRS and no place), BadArgument, WouldDestroy, CannotWrite
    [[nodiscard]] static Result<std::unique_ptr<CityTileset>> create(const std::filesystem::path& path,
                                                                     const CityTilesetFrame& frame);
    virtual ~CityTileset() = default;

    /// Surfaces of volumes; a feature is a label without parent with all below it. Upward faces have the colour of its
    /// roofs, upright ones that of its walls, where it has such labels.
    /// Threads: may be called by several at once. Memory: that of labelSurfaces() of one volume, and the content.
    /// \return the content, empty where no voxel is filled; or CannotProject, GridTooLarge, Cancelled
    [[nodiscard]] virtual Result<TileContent> make(std::span<const volume::SemanticVolume> volumes,
                                                   double error) const = 0;
    /// Writes the content of a square, which has none yet. \return nothing, or CannotWrite, DiskFull
    [[nodiscard]] virtual Result<void> add(QuadtreeNode node, const TileContent& content) = 0;
    /// Memory: some 200 bytes for each content and square around it.
    /// \return bytes of all files, or NothingSelected without any content, CannotWrite, DiskFull
    [[nodiscard]] virtual Result<std::uint64_t> finish() = 0;
};

}  // namespace svt::writers
