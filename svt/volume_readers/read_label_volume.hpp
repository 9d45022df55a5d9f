#pragma once
/// \file
/// Entry point: reads a label volume in a foreign format, written by another program or by `svt convert`: segmentations
/// of CT scans, results of simulations, other voxelizers. The content determines the format.
///
/// A file becomes a volume as follows:
///
///  - Values. With a table of `svt convert` in the file, the sample values are its scalars, and the volume is the one
///    that was written, bit for bit. With a given table (docs/user/build.md), or without a table, each value except 0
///    is a label.
///
///  - Checks. A file that `svt convert` wrote and that was damaged or changed since is rejected: checksums of table and
///    samples and the voxels of each label are compared. If the grid differs, the image was cut, and voxels are counted
///    again. A given table is taken as it is.
///
///  - Grid. Spacing and direction come from the file, in metres (files in millimetres are converted). A mirrored or
///    sheared grid is rejected.
///
///  - Formats. NRRD: 8, 16 or 32 bits, raw or gzip, one file, segments of 3D Slicer as the table. VTI: cells or points,
///    raw appended, with or without zlib. NIfTI-1 and -2: .nii and .nii.gz. TIFF stacks: raw or Deflate. Folders of
///    Zarr 2 and 3: sharded or not, raw or by zlib, gzip, zstd, LZ4 or Blosc with one of them, the finest level of
///    OME-NGFF. CityGML: a volume by the extension that `svt convert` writes, all three kinds of texture.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace svt::volume_readers {

class LabelFile;
struct LabelImage;

/// A format, declared next to its reader.
struct LabelFormat {
    std::string_view name;        ///< "nrrd"; unique
    std::string_view endings;     ///< of its files, lower case, '|' between them: ".tif|.tiff". Detection ignores them.
    std::string_view holds;       ///< content, for messages and the manual
    bool isFolder = false;        ///< else a file
    Code fault = Code::BadImage;  ///< of damaged samples
    /// Whether the input has this format. \param file  null for a folder
    bool (*looksLike)(const std::shared_ptr<const LabelFile>& file, const std::filesystem::path& path);
    /// Checks the header; the samples are read later. \param maxBytes  memory that reading may take
    Result<LabelImage> (*open)(const std::shared_ptr<const LabelFile>& file, const std::filesystem::path& path,
                               std::uint64_t maxBytes);
};

/// All readable formats, in the order in which they are tried.
[[nodiscard]] std::span<const LabelFormat> labelFormats() noexcept;

struct LabelReadOptions {
    std::filesystem::path labels;        ///< table of labels (JSON); empty: the table of the file, or a label per value
    std::uint64_t maxBytes = 0;          ///< memory that reading may take; 0: half of the granted memory
    const Progress* progress = nullptr;  ///< stage "read"
    /// Receives warnings: bytes in the header that cannot be read, a grid that differs from the written one.
    Diagnostics* diagnostics = nullptr;
};

/// Whether the content of a file or folder looks like a label volume. CityGML is one if it contains the extension. A
/// ZIP archive of Zarr counts too, so that readLabelVolume() reports the remedy.
[[nodiscard]] bool looksLikeLabelVolume(const std::filesystem::path& path);

/// Cost: O(samples). Memory: the columns, and two slices (of Zarr a band of chunks); never the dense volume.
/// \return the volume, or CannotOpen; BadNrrd, BadImage or BadVolume with the problem; InputTooBig; BadDimension,
///         GridTooLarge; BadJson for a table; BadChecksum if table or samples differ from those that were written;
///         Cancelled
[[nodiscard]] Result<volume::SemanticVolume> readLabelVolume(const std::filesystem::path& path,
                                                             const LabelReadOptions& options = {});

}  // namespace svt::volume_readers
