#pragma once
/// \file
/// Writes a volume for MagicaVoxel (.vox, version 150 with the scene graph), which voxel editors and game engines open.
///
/// A group for each label with voxels, named by its name or id, with its voxels in models of at most 256 x 256 x 256, the
/// format's limit; a model is cut to what the label has there. z is up; a voxel is a voxel, its size in metres is told by
/// the root's attributes `svt_spacing`, and `svt_origin` is where the first sample is (world coordinates), `svt_crs` what
/// they are in. The palette has the colours of the labels with their opacity; of more than 255 the most frequent ones, the
/// others become the nearest of them.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: a box of 256 x 256 x 256 samples; the voxels
/// are unrolled twice.
/// \return bytes, or BadArgument for more voxels than VolumeWriteOptions::maxVoxels, NothingSelected if no label has voxels,
///         CannotWrite, DiskFull, Cancelled
[[nodiscard]] Result<std::uint64_t> writeVox(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const VolumeWriteOptions& options);

}  // namespace svt::writers
