#pragma once
/// \file
/// The `.svt` file: a semantic volume in one file that any ZIP tool can open, with its columns compressed in blocks
/// that can be read individually. docs/formats/svt.md specifies it to the bit.
///
///     | entry          | content
///     | mimetype       | application/vnd.svt+zip
///     | svt.json       | version, grid, names
///     | labels.json    | label table, overlaps, phase colors (deflated)
///     | columns/index  | index of the blocks, see column_blocks.hpp
///     | columns/blocks | zstd frames, one per block
///     | meshes/shapes  | lines and triangles by label, see vector_parts.hpp; optional (meshes/parts in older files)
///     | meshes/planes  | planes of the model's faces, see face_planes.hpp; optional

#include <svt/core/result.hpp>
#include <svt/volume/column_blocks.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace svt::volume {

/// Writes `volume` to the file `path` atomically (see AtomicFile). Equal volumes give equal bytes.
/// In strings that are not valid UTF-8, each wrong byte is replaced by U+FFFD. Cost: that of compressColumns. Memory:
/// the file.
/// \return bytes written, or
///         - CannotWrite, DiskFull.
///         - BadArgument  if grid and columns differ in dimension, a scalar belongs to no label, the label table,
///                        vectors or planes are invalid (checkLabels, checkVectorParts, checkFacePlanes), or a limit is
///                        exceeded.
[[nodiscard]] Result<std::uint64_t> writeSvt(const SemanticVolume& volume, const std::filesystem::path& path);

/// The bytes that writeSvt() would write, for files of many volumes. Errors as writeSvt(), except CannotWrite and
/// DiskFull.
[[nodiscard]] Result<std::vector<std::byte>> svtBytes(const SemanticVolume& volume);

/// Opens the file `path` and decodes all columns in parallel.
/// All bytes are checked: container, CRC32 of each entry, every count, index and range. Cost: 1 to 3 s per GB of arrays
/// and core. Memory: the arrays, bounded by maxArrayBytes, and the label table.
/// \return the volume, or CannotOpen; BadVolume if it is damaged or not a `.svt`; BadChecksum; VolumeVersion if a newer
///         program wrote it; InputTooBig
[[nodiscard]] Result<SemanticVolume> readSvt(const std::filesystem::path& path);

/// The same from bytes in memory.
/// \param name  used as file name in messages
[[nodiscard]] Result<SemanticVolume> readSvt(std::span<const std::byte> bytes, const std::string& name = {});

/// A `.svt` whose columns are decoded block by block on demand.
struct SvtBlocks {
    Grid grid;
    LabelTable labels;
    ColumnBlocks blocks;
    std::span<const std::byte> frames;  ///< frames of all blocks; a view of the bytes it was opened from
    std::string crsName;
    std::string modelName;
    std::string source;
};

/// Opens a `.svt` without decoding its columns; the checksum of a block is checked when it is decoded.
/// \param bytes  the whole file, for instance memory-mapped; must outlive the result
/// \param name   used as file name in messages
/// \return as readSvt
[[nodiscard]] Result<SvtBlocks> openSvt(std::span<const std::byte> bytes, const std::string& name = {});

/// Whether a file that begins with `head` (at least 61 bytes) has the signature of a `.svt`.
[[nodiscard]] bool looksLikeSvt(std::span<const std::byte> head) noexcept;
/// looksLikeSvt() of the first bytes of a regular file; false if there is no such file.
[[nodiscard]] bool isSvtFile(const std::filesystem::path& path);

}  // namespace svt::volume
