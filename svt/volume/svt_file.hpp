#pragma once
/// \file
/// The `.svt` file: a semantic volume in one file that any ZIP tool opens and that is used mapped in place, without
/// decoding. docs/formats/svt.md specifies it to the bit.
///
///     mimetype             application/vnd.svt+zip
///     svt.json             version, grid, names
///     labels.json          label table, overlaps, phase colors
///     columns/tiles        u32[3] per tile: distinct rows, distinct columns, runs
///     columns/row-of       u8      the arrays of ColumnTile, tile after tile
///     columns/row-columns  u16
///     columns/starts       u32
///     columns/runs         {u32 end, u32 scalar}

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace svt::volume {

/// Writes `volume` as the file `path`, all or nothing (see AtomicFile). Equal volumes give equal bytes.
/// Strings that are no valid UTF-8 get U+FFFD for each wrong byte. Cost: O(bytes written), no copy of the volume.
/// \return bytes written, or CannotWrite or DiskFull; BadArgument where grid and columns differ in dimension, a
///         scalar belongs to no label or the label table breaks its contract (checkLabels)
[[nodiscard]] Result<std::uint64_t> writeSvt(const SemanticVolume& volume, const std::filesystem::path& path);

/// Opens the file `path`. The columns are views of the mapped file, which the volume keeps open.
/// All bytes are checked: container, CRC32 of each entry, every count, index and range. Cost: O(file size), under
/// 1 s per GB and core; memory: the label table.
/// \return the volume, or CannotOpen; BadVolume where it is damaged or no `.svt`; BadChecksum; VolumeVersion where a
///         newer program wrote it; InputTooBig
[[nodiscard]] Result<SemanticVolume> readSvt(const std::filesystem::path& path);

/// The same from bytes in memory, which `keepAlive` owns. Arrays that are not aligned to their element are copied.
/// \param name  stands for the file name in messages
[[nodiscard]] Result<SemanticVolume> readSvt(std::span<const std::byte> bytes, std::shared_ptr<const void> keepAlive,
                                             const std::string& name = {});

/// Whether a file that begins with `head` (at least 61 bytes) claims to be a `.svt`.
[[nodiscard]] bool looksLikeSvt(std::span<const std::byte> head) noexcept;

}  // namespace svt::volume
