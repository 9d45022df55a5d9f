#pragma once
/// \file
/// Writes the hulls of components as 3D Tiles 1.1, which Cesium, Unreal, Unity and ArcGIS put on the globe: a folder with
/// `tileset.json` and tiles of some hundred thousand triangles, `0.glb`, `1.glb`, ...
///
/// A vertex tells its component (EXT_mesh_features), and a table tells id, name, class, parent, storey, volume, scalars and
/// attributes of each (EXT_structural_metadata).
///
/// Place: `root.transform` takes metres from the grid's lower corner (x, y, z of the world) to metres from the earth's
/// centre (EPSG:4978). By the CRS of the volume: along the axes of the projection, with its scale, so that each point is
/// where the projection has it. Heights count as those over the ellipsoid; where they are over the sea,
/// VolumeWriteOptions::lift adds the height of the geoid. Or by VolumeWriteOptions::place: x is east, y is north.
/// `asset.extras` has corner and CRS.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes a folder that appears when all of it is written; one that is there is not replaced. Equal volumes give equal
/// bytes. Memory: that of labelSurfaces(), and one tile.
/// \return bytes of all files, or CannotProject (a volume without a CRS and no place, or a CRS that leads to none),
///         BadArgument for a place that is none, NothingSelected, GridTooLarge, WouldDestroy, CannotWrite, Cancelled
[[nodiscard]] Result<std::uint64_t> writeTileset(const volume::SemanticVolume& volume,
                                                 const std::filesystem::path& path, const VolumeWriteOptions& options);

}  // namespace svt::writers
