#pragma once
/// \file
/// Writes a semantic volume as NRRD, the dense format that VTK, ITK, 3D Slicer, teem, MATLAB and pynrrd read.
///
/// Type: the smallest of uint8, uint16 and uint32 that holds all scalars. Position: `space directions` = axes * spacing
/// and `space origin` = first sample, in metres of the model's CRS, also for a rotated grid. `space dimension: 3` is
/// written instead of `space`: the named spaces are anatomical (left, posterior, superior), and a reader that knows
/// them would flip easting and northing. The label table is stored as key/value pairs, one label per key.
///
/// A segmentation of 3D Slicer (.seg.nrrd) is the same file with keys for each segment: id, name, colour, extent,
/// value, class as terminology, parent. Slicer uses millimetres and anatomical axes, so lengths are millimetres, and x,
/// y, z are its right, anterior, superior. A segment has one value: all phases of a pattern get the first scalar of the
/// label.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

enum class NrrdEncoding { Raw, Gzip };

struct NrrdOptions {
    NrrdEncoding encoding = NrrdEncoding::Gzip;
    int threads = 0;                     ///< maximum; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< stage "nrrd"
    bool hasSegments = false;            ///< write a segmentation of 3D Slicer
};

/// Writes the volume as one attached .nrrd, all or nothing. Equal volumes give equal bytes.
/// Cost: O(samples); memory: about 48 MB for any grid, because the columns are expanded slab by slab.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument if grid and columns differ in dimension or
///         a scalar belongs to no label
[[nodiscard]] Result<std::uint64_t> writeNrrd(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                              const NrrdOptions& options = {});

}  // namespace svt::writers
