#pragma once
/// \file
/// Writes a semantic volume as a segmentation for neuroglancer (precomputed format): a folder for any web server, with
/// all levels.
///
///     info                      sizes, resolution in nanometres, levels.
///     LEVEL/x0-x1_y0-y1_z0-z1   chunks of 64 x 64 x 64 voxels, 32-bit compressed_segmentation in blocks of 8 x 8 x 8.
///     LEVEL/NUMBER.shard        with PrecomputedWriteOptions::isSharded: up to 64 of these chunks, instead of them.
///     properties/info           name, class, id and volume of each scalar.
///     mesh/NUMBER:0             with PrecomputedWriteOptions::hasMeshes: the file of the surface of a scalar (legacy).
///     mesh/LABEL.mesh           the surface of a label: vertices in nanometres, triangles; shared by phases of a
///                               pattern.
///     state.json                a layer with our colours, and the matrix to world coordinates in metres; put the
///                               address of the folder into its `source`.
///
/// Voxel (0, 0, 0) begins at the origin: neuroglancer numbers voxels from there. Axes are those of the grid.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace svt::writers {

/// The words of one chunk of one channel: headers of blocks, packed indices, tables of values; equal tables are shared.
/// \param values  x fastest, then y, then z
[[nodiscard]] std::vector<std::uint32_t> compressSegmentation(std::span<const std::uint32_t> values, Vec3i size);

/// Writes a folder that appears only when it is complete. An existing folder is not replaced. Equal volumes give equal
/// bytes. Memory: besides the volume and its levels, 4096 nx samples of 32 bits; with meshes that of labelSurfaces().
/// \return size of all files, bytes; or WouldDestroy, CannotWrite, DiskFull, Cancelled; BadArgument of
///         checkedSampleBits(); with meshes also NothingSelected, GridTooLarge
[[nodiscard]] Result<std::uint64_t> writePrecomputed(const volume::SemanticVolume& volume,
                                                     const std::filesystem::path& path,
                                                     const VolumeWriteOptions& options = {});

}  // namespace svt::writers
