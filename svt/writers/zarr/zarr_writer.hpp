#pragma once
/// \file
/// Writes a semantic volume as Zarr with the metadata of OME-NGFF, which zarr-python, zarrita, napari, neuroglancer and
/// vizarr read: a folder with one array per level, axes z, y, x.
///
/// Version 2 (OME-NGFF 0.4): chunks of 64 x 64 x 64 samples, each a zstd frame in a file of its own, `LEVEL/z/y/x`.
/// Version 3 (OME-NGFF 0.5): shards of 128 x 128 x 128 samples with inner chunks of 32 x 32 x 32, `LEVEL/c/z/y/x`, their
/// index at the end. What is background alone is left out. Levels are those of volume::coarseVolumes(), until 64 samples
/// are the longest side. Scale and translation are metres of the model's CRS; a turned grid has them along its own axes,
/// since the metadata know no rotation. `image-label` has colour, id, class and name of each scalar; `svt` has the same as
/// `svt.json` and `labels.json` of a `.svt`.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes a folder that appears when all of it is written; one that is there is not replaced. Equal volumes give equal
/// bytes. Memory: besides the volume and its levels, a band of chunks: 4096 nx samples (version 2) or 16384 nx (version 3).
/// \param version  2 or 3
/// \return bytes of all files, or WouldDestroy, CannotWrite, Cancelled; BadArgument as checkedSampleBits()
[[nodiscard]] Result<std::uint64_t> writeZarr(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                              int version, const DenseOptions& options = {});

}  // namespace svt::writers
