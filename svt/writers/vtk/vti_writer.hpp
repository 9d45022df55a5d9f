#pragma once
/// \file
/// Writes a semantic volume as VTK XML image data (.vti), which ParaView, VTK and PyVista read.
///
/// Each voxel is a cell: cell array `label`, UInt8, UInt16 or UInt32, x fastest, then y, then z. `Origin` is the outer
/// corner of voxel (0, 0, 0), `Direction` has the grid's axes as columns; world = Origin + Direction * (Spacing *
/// index), metres of the model's CRS. The label table is field data, one entry per label: `label_id`, `label_class` and
/// `label_name` (strings), `label_first`, `label_count` (the cells of a label have the values first to first + count -
/// 1), `label_parent` (its number, -1: none), `label_color` (sRGB, 0..1). `svt_header` and `svt_labels` have the same
/// content as in a `.svt`, `svt_seal` their checksums, so that the file can become a volume again.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes one .vti, all or nothing, samples appended raw or in zlib blocks of 1 MiB. Equal volumes give equal bytes.
/// Cost: O(samples); memory: about 150 MB at most, besides the label table.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument of checkedSampleBits()
[[nodiscard]] Result<std::uint64_t> writeVti(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const VolumeWriteOptions& options = {});

}  // namespace svt::writers
