#pragma once
/// \file
/// Writes a semantic volume as NIfTI (.nii, .nii.gz), which nibabel, ITK, 3D Slicer, FSL and SPM read.
///
/// Samples as they are, x fastest, then y, then z; unit metre; the sform matrix leads from index to world space (east is
/// "right", north "anterior", up "superior"). NIfTI-1 where its 16-bit sizes and 32-bit floats say enough, NIfTI-2
/// (64 bits) where they would move a sample by a hundredth of a voxel, as coordinates of most CRSs do. Three comments (code
/// 6) hold `svt.json` and `labels.json` of a `.svt` and their seal, so that the file can become a volume again.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes one file, all or nothing, compressed by gzip if its name ends in .gz. Equal volumes give equal bytes.
/// Cost: O(samples); memory: about 48 MB, besides the label table.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument as checkedSampleBits()
[[nodiscard]] Result<std::uint64_t> writeNifti(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                               const DenseOptions& options = {});

}  // namespace svt::writers
