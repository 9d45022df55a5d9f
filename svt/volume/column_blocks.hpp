#pragma once
/// \file
/// Columns in compressed form: blocks of 4 x 4 tiles, each a zstd frame of its own, and an index of them. So a reader
/// that has the index can fetch and decode the block around a place alone, from a mapped file or over HTTP.
///
///     index   per block, x fastest: u32 size, u32 streamBytes, u32 arrayBytes, u32 crc
///     frames  one behind the other

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Most bytes that the arrays of all tiles may take where their frames take `frameBytes`: 256 MiB and 1024 times that,
/// 16 GiB at most. A volume beyond is neither written nor opened, so a small file cannot fill the memory.
[[nodiscard]] std::uint64_t maxArrayBytes(std::uint64_t frameBytes) noexcept;

/// What the index says of a block. Little-endian in a file.
struct ColumnBlock {
    std::uint32_t size = 0;         ///< bytes of its frame
    std::uint32_t streamBytes = 0;  ///< bytes that the frame holds
    std::uint32_t arrayBytes = 0;   ///< bytes that the arrays of its tiles take at most, see ColumnTile
    std::uint32_t crc = 0;          ///< CRC-32 of the frame
    friend bool operator==(const ColumnBlock&, const ColumnBlock&) = default;
};

/// The columns of a volume as a file has them.
struct CompressedColumns {
    std::vector<ColumnBlock> index;
    std::vector<std::vector<std::byte>> frames;
};

/// Compresses all blocks on all cores. The bytes depend on the samples alone, not on the number of threads; another
/// release of libzstd may give others. Cost: 2 to 6 s per GB of arrays and core. Memory: the result, a block per
/// thread. \param threads  as in parallelFor \return index and frames, or BadArgument where they break a limit
[[nodiscard]] Result<CompressedColumns> compressColumns(const ColumnVolume& columns, int threads = 0);

/// Finds and decodes blocks. Cheap to copy but for the index. Thread-safe.
class ColumnBlocks {
public:
    /// \param index       the index as in a file, a copy is kept
    /// \param frameBytes  bytes that all frames have together
    /// \return the blocks, or BadVolume where the index does not fit `dimension` or `frameBytes`, or breaks a limit
    [[nodiscard]] static Result<ColumnBlocks> open(Vec3i dimension, Scalar scalarCount,
                                                   std::span<const std::byte> index, std::uint64_t frameBytes);

    [[nodiscard]] std::size_t count() const noexcept { return blocks_.size(); }
    [[nodiscard]] const ColumnBlock& block(std::size_t number) const noexcept { return blocks_[number]; }
    /// First byte of a block's frame among all frames.
    [[nodiscard]] std::uint64_t offset(std::size_t number) const noexcept { return offsets_[number]; }
    /// Number of the block that holds tile (tileX, tileY).
    [[nodiscard]] std::size_t blockOfTile(std::int32_t tileX, std::int32_t tileY) const noexcept;

    /// The tiles of a block, x fastest.
    /// \param frame  its bytes
    /// \return the tiles, or BadChecksum or BadVolume where the bytes are damaged
    [[nodiscard]] Result<std::vector<ColumnTileData>> decodeBlock(std::size_t number,
                                                                  std::span<const std::byte> frame) const;
    /// One tile. Cost: that of its block.
    [[nodiscard]] Result<ColumnTileData> decodeTile(std::int32_t tileX, std::int32_t tileY,
                                                    std::span<const std::byte> frame) const;
    /// All tiles, on all cores.
    /// \param frames   all frames
    /// \param threads  as in parallelFor
    [[nodiscard]] Result<ColumnVolume> decodeAll(std::span<const std::byte> frames, int threads = 0) const;

private:
    Vec3i dimension_{};
    Scalar scalarCount_ = 0;
    std::vector<ColumnBlock> blocks_;
    std::vector<std::uint64_t> offsets_;
};

}  // namespace svt::volume
