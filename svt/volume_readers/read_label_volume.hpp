#pragma once
/// \file
/// Entry point: reads a label volume that another program, or `svt convert`, wrote in a format of others: segmentations of
/// CT scans, results of simulations, other voxelizers. The format is told by the content.
///
/// What becomes what:
///  - the sample values: with a table of `svt convert` in the file they are its scalars, and the volume is the one that was
///    written, bit for bit; with a table that is given (docs/user/build.md), or none, each value but 0 is a label;
///  - what `svt convert` wrote and was damaged or changed since is refused: checksums of table and samples and the voxels of
///    each label are compared. Where the grid is another one, the image was cut, and voxels are counted again. A table that
///    is given is taken as it is;
///  - the grid: spacing and direction of the file, in metres (files that count in millimetres are brought to metres). A
///    grid that is mirrored or sheared is refused;
///  - NRRD: 8, 16 or 32 bits, raw or gzip, one file, segments of 3D Slicer as the table; VTI: cells or points, raw
///    appended, zlib or not; NIfTI-1 and -2, .nii and .nii.gz; TIFF stacks, raw or Deflate; folders of Zarr 2 and 3, sharded
///    or not, raw or by zlib, gzip, zstd, LZ4 or Blosc with one of them, the finest level of OME-NGFF; CityGML with a volume
///    by the extension that `svt convert` writes, all three kinds of texture.

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

/// A format, declared beside its reader.
struct LabelFormat {
    std::string_view name;        ///< "nrrd"; unique
    std::string_view endings;     ///< of its files, lower case, '|' between them: ".tif|.tiff". Detection ignores them.
    std::string_view holds;       ///< content, for messages and the manual
    bool isFolder = false;        ///< else a file
    Code fault = Code::BadImage;  ///< of damaged samples
    /// Whether the input has this format. \param file  null for a folder
    bool (*looksLike)(const std::shared_ptr<const LabelFile>& file, const std::filesystem::path& path);
    /// Checks the header and leaves the samples to be read. \param maxBytes  memory that reading may take
    Result<LabelImage> (*open)(const std::shared_ptr<const LabelFile>& file, const std::filesystem::path& path,
                               std::uint64_t maxBytes);
};

/// All readable formats, in the order in which they are tried.
[[nodiscard]] std::span<const LabelFormat> labelFormats() noexcept;

struct LabelReadOptions {
    std::filesystem::path labels;        ///< table of labels (JSON); empty: that of the file, or a label per value
    std::uint64_t maxBytes = 0;          ///< memory that reading may take; 0: half of what is granted
    const Progress* progress = nullptr;  ///< stage "read"
    /// What is odd: bytes in the header that cannot be read, a grid that is no longer the one that was written.
    Diagnostics* diagnostics = nullptr;
};

/// Whether a file with these first bytes (64 KiB are enough) may be a label volume. CityGML is one if `path` has the
/// extension somewhere in it.
[[nodiscard]] bool looksLikeLabelVolume(const std::filesystem::path& path);

/// Cost: O(samples). Memory: the columns, and two slices (of Zarr a band of chunks); never the dense volume.
/// \return the volume, or CannotOpen; BadNrrd, BadImage or BadVolume with what is wrong; InputTooBig; BadDimension,
///         GridTooLarge; BadJson for a table; BadChecksum where table or
///         samples differ from those that were written; Cancelled
[[nodiscard]] Result<volume::SemanticVolume> readLabelVolume(const std::filesystem::path& path,
                                                             const LabelReadOptions& options = {});

}  // namespace svt::volume_readers
