#pragma once
/// \file
/// Writes the hulls of labels as USD in its text form (.usda), which Blender, Omniverse, Houdini, Maya and usdview open.
///
/// A prim `Xform` for each label with a hull in or below it, nested as the labels are, named by its id; `displayName` is its
/// name, `svt:id`, `svt:class`, `svt:name` and `svt:volume` (m3) are attributes. Its hull is a `Mesh` below it, `Hull`, of
/// triangles that are closed, with `displayColor` (linear, as USD has colours) and `displayOpacity`, the fraction of light
/// that a metre of it stops. Metres, z up. Points are metres from the grid's lower corner along its axes; the matrix of the
/// root, in doubles, leads to world coordinates.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: that of labelSurfaces().
/// \return bytes, or NothingSelected if no label has voxels, GridTooLarge for too many triangles, CannotWrite, DiskFull,
///         Cancelled
[[nodiscard]] Result<std::uint64_t> writeUsd(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const VolumeWriteOptions& options);

}  // namespace svt::writers
