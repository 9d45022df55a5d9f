#pragma once
/// \file
/// A semantic volume as NRRD, the dense format that VTK, ITK, 3D Slicer, teem, MATLAB and pynrrd read.
///
/// Type: the smallest of uint8, uint16 and uint32 that holds all scalars. Place: `space directions` = axes * spacing
/// and `space origin` = first sample, in metres of the model's CRS, also for a turned grid. `space dimension: 3` is
/// written and no `space`: the named spaces are anatomical (left, posterior, superior), and a reader that knows them
/// would flip easting and northing. The label table goes along as key/values, one label per key.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

enum class NrrdEncoding { Raw, Gzip };

struct NrrdOptions {
    NrrdEncoding encoding = NrrdEncoding::Gzip;
    int threads = 0;                     ///< at most this many; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< stage "nrrd"
};

/// Writes the volume as one attached .nrrd, all or nothing. Equal volumes give equal bytes.
/// Cost: O(samples); memory: about 48 MB whatever the grid, since the columns are unrolled slab by slab.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument where grid and columns differ in dimension
/// or
///         a scalar belongs to no label
[[nodiscard]] Result<std::uint64_t> writeNrrd(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                              const NrrdOptions& options = {});

}  // namespace svt::writers
