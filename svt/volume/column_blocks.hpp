#pragma once
/// \file
/// Columns in compressed form: blocks of 4 x 4 tiles, each its own zstd frame, and an index of the blocks. A reader
/// with the index can fetch and decode single blocks, from a mapped file or over HTTP.
///
///     index   per block, x fastest: u32 size, u32 streamBytes, u32 arrayBytes, u32 crc
///     frames  concatenated, in the same order

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Maximum size in bytes of the arrays of all tiles, for frames of `frameBytes` in total: 256 MiB + 1024 * frameBytes,
/// but at most 16 GiB. Larger volumes are neither written nor opened, so that a small file cannot exhaust the memory.
[[nodiscard]] std::uint64_t maxArrayBytes(std::uint64_t frameBytes) noexcept;

/// The index entry of a block. Little-endian in a file.
struct ColumnBlock {
    std::uint32_t size = 0;         ///< bytes of its frame
    std::uint32_t streamBytes = 0;  ///< bytes of the frame when decompressed
    std::uint32_t arrayBytes = 0;   ///< maximum bytes of the arrays of its tiles, see ColumnTile
    std::uint32_t crc = 0;          ///< CRC-32 of the frame
    friend bool operator==(const ColumnBlock&, const ColumnBlock&) = default;
};

/// The columns of a volume as stored in a file.
struct CompressedColumns {
    std::vector<ColumnBlock> index;
    std::vector<std::vector<std::byte>> frames;
};

/// Compresses all blocks in parallel. The bytes depend only on the samples, not on the number of threads; another
/// release of libzstd may give other bytes.
/// Cost: 2 to 6 s per GB of arrays and core. Memory: the result, and one block per thread.
/// \param threads  as in parallelFor
/// \return index and frames, or BadArgument if they exceed a limit
[[nodiscard]] Result<CompressedColumns> compressColumns(const ColumnVolume& columns, int threads = 0);

/// Finds and decodes blocks. A copy copies the index. Thread-safe.
class ColumnBlocks {
public:
    /// \param index       the index as in a file; it is copied
    /// \param frameBytes  total bytes of all frames
    /// \return the blocks, or BadVolume if the index does not match `dimension` or `frameBytes`, or exceeds a limit
    [[nodiscard]] static Result<ColumnBlocks> open(Vec3i dimension, Scalar scalarCount,
                                                   std::span<const std::byte> index, std::uint64_t frameBytes);

    [[nodiscard]] std::size_t count() const noexcept { return blocks_.size(); }
    [[nodiscard]] const ColumnBlock& block(std::size_t number) const noexcept { return blocks_[number]; }
    /// Offset of the frame of a block in the concatenated frames, bytes.
    [[nodiscard]] std::uint64_t offset(std::size_t number) const noexcept { return offsets_[number]; }
    /// Number of the block that holds tile (tileX, tileY).
    [[nodiscard]] std::size_t blockOfTile(std::int32_t tileX, std::int32_t tileY) const noexcept;

    /// The tiles of a block, x fastest.
    /// \param frame  the frame of the block
    /// \return the tiles, or BadChecksum or BadVolume if the bytes are damaged
    [[nodiscard]] Result<std::vector<ColumnTileData>> decodeBlock(std::size_t number,
                                                                  std::span<const std::byte> frame) const;
    /// One tile. Decodes the whole block.
    /// \param frame  the frame of the block that holds the tile
    [[nodiscard]] Result<ColumnTileData> decodeTile(std::int32_t tileX, std::int32_t tileY,
                                                    std::span<const std::byte> frame) const;
    /// All tiles, decoded in parallel.
    /// \param frames   all frames, concatenated
    /// \param threads  as in parallelFor
    [[nodiscard]] Result<ColumnVolume> decodeAll(std::span<const std::byte> frames, int threads = 0) const;

private:
    Vec3i dimension_{};
    Scalar scalarCount_ = 0;
    std::vector<ColumnBlock> blocks_;
    std::vector<std::uint64_t> offsets_;
};

}  // namespace svt::volume
