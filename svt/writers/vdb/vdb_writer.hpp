#pragma once
/// \file
/// Writes a volume as OpenVDB (.vdb, version 224 of the file format), which Blender, Houdini, Maya, Unreal and the OpenVDB
/// library open.
///
/// Grid `label`: the scalar of each voxel, active where it is not background; a float, which all programs read, also
/// those without grids of whole numbers. Then for each class of features that
/// has voxels a grid of its name (Float, a fog volume): 1 in its voxels, 0 elsewhere. Uniform cubes of 8 and 128 samples are
/// tiles. A voxel's centre is at its whole index, and the transform leads to world coordinates in metres, also of a turned
/// grid. The metadata of the file have `svt.json` and `labels.json` of a `.svt`, and `crs`.
///
/// Or each class is a level set: signed distances in metres to the surface of its voxels, negative inside, within three
/// samples of it; of voxels that are cubes alone. Programs make meshes of these, offset them and combine them.
///
/// Written from the format as the OpenVDB library reads it (openvdb/io, openvdb/tree, version 10), without the library.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes one file, all or nothing. Equal volumes give equal bytes. Memory: some blocks of 128^3 samples. Cost: the samples
/// of each block are unrolled once, and once more for each grid that has something in it, thrice where the grid has
/// more than 64 MB.
/// \return bytes, or NothingSelected if no label has voxels, CannotWrite, DiskFull, Cancelled; BadArgument as
///         checkedSampleBits(), for more than 2^24 scalars, and for level sets where voxels are no cubes
[[nodiscard]] Result<std::uint64_t> writeVdb(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const DenseOptions& options = {}, bool hasLevelSets = false);

}  // namespace svt::writers
