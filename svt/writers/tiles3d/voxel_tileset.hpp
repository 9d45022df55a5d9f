#pragma once
/// \file
/// Writes voxels as 3D Tiles by two draft extensions, 3DTILES_content_voxels and EXT_primitive_voxels, which Cesium
/// supports experimentally: a folder with `tileset.json`, `subtree.subtree`, `labels.json` and one .glb per non-empty
/// tile.
///
/// Tiles are the nodes of an octree (implicit tiling) and have equal numbers of voxels; level 0 is the whole volume,
/// each further level has half the spacing. A voxel has `label`, its scalar as four bytes, the lowest first, and
/// `color`, the look (sRGB and opacity); 0 is background. Order in a tile: x fastest, then z, then y from its far end,
/// as the extensions require.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Like writeTileset(). Memory: that of the coarser levels, and one tile.
[[nodiscard]] Result<std::uint64_t> writeVoxelTileset(const volume::SemanticVolume& volume,
                                                      const std::filesystem::path& path,
                                                      const VolumeWriteOptions& options);

}  // namespace svt::writers
