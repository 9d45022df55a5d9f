#pragma once
/// \file
/// Encodes a block of tiles as eight streams of small numbers, and decodes it. The streams are predictive, so that a
/// general-purpose compressor (zstd) can do the rest. docs/formats/svt.md specifies them to the bit.
///
/// A block is coded as an image whose pixels are columns; "above" is the previous row of this image. A row is a list of
/// segments of equal columns, each coded relative to the row above: the same column with its end moved, or a new
/// column. A new column is predicted from its left and upper neighbours: copy their runs, move the end of a run, or
/// insert a run. So planes, straight walls and repeated rows take few bytes, whatever their direction.

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

inline constexpr std::int32_t kBlockTiles = 4;  ///< tiles along x and y that are coded together

/// Size of a block in samples; width and height are at most kBlockTiles * ColumnVolume::kTileSize.
struct BlockShape {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::int32_t nz = 0;

    [[nodiscard]] std::int32_t tilesX() const noexcept {
        return (width + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    }
    [[nodiscard]] std::int32_t tilesY() const noexcept {
        return (height + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    }
    /// Width of a tile of the block in columns.
    [[nodiscard]] std::int32_t tileWidth(std::int32_t tileX) const noexcept {
        return std::min(ColumnVolume::kTileSize, width - tileX * ColumnVolume::kTileSize);
    }
    [[nodiscard]] std::int32_t tileHeight(std::int32_t tileY) const noexcept {
        return std::min(ColumnVolume::kTileSize, height - tileY * ColumnVolume::kTileSize);
    }
};

/// The streams, in file order. Numbers are LEB128, except in Operations and Commands, which are bytes.
enum class BlockStream : std::uint8_t {
    Repeats,     ///< before each coded row: how many times the row before it is repeated
    Operations,  ///< a byte per segment: which column, and how far its end has moved
    Shifts,      ///< zigzag: movements too large for an operation
    Widths,      ///< inserted segments: width - 1
    Commands,    ///< bytes that build a new column from its neighbours
    Moves,       ///< zigzag: movements too large for a command
    Scalars,     ///< scalars of inserted runs
    Heights      ///< heights of inserted runs, in samples, less 1
};
inline constexpr std::size_t kBlockStreams = 8;

template <class T>
using PerStream = std::array<T, kBlockStreams>;
using BlockStreams = PerStream<std::vector<std::uint8_t>>;

/// An operation is the byte kind + kOperationKinds * movement. Movement 1 to 7 means -3 to 3; 0 means that the movement
/// is in Shifts, or, for kInsert, that there is no movement. Kinds 0 to 3 skip 0 to 3 segments above and reuse the next
/// one's column.
inline constexpr std::uint32_t kOperationKinds = 6;
inline constexpr std::uint32_t kReplace = 4;  ///< a new column in place of the segment above
inline constexpr std::uint32_t kInsert = 5;   ///< a new column before the segment above
inline constexpr std::int32_t kMaxShift = 3;

/// Commands. kCopy + 2 * n + source copies n runs (0: all up to the top) from the left (source 0) or upper (1) column.
/// All others are below kCopy:
inline constexpr std::uint32_t kNewRun = 0;
inline constexpr std::uint32_t kMoveLeft = 1;      ///< the next run of the left column, with another end (in Moves)
inline constexpr std::uint32_t kMoveAbove = 2;     ///< the same from the upper column
inline constexpr std::uint32_t kNearLeft = 3;      ///< 3 to 6: as kMoveLeft, with the end moved by -2, -1, 1, 2
inline constexpr std::uint32_t kNearAbove = 7;     ///< 7 to 10: the same from the upper column
inline constexpr std::uint32_t kFirstUnused = 11;  ///< 11 to 15 are invalid
inline constexpr std::uint32_t kCopy = 16;
inline constexpr std::uint32_t kMaxCopy = 119;

/// One of the two columns from which a new column is predicted.
struct ReferenceColumn {
    std::span<const Run> runs;
    std::size_t at = 0;

    /// Index of the run that predicts the next run of a column. The column reaches up to `height`, and its last run has
    /// the scalar `last`. This is the first run that ends above `height`, or the one after it if the first has scalar
    /// `last`. May be runs.size(). `height` must not decrease between calls.
    [[nodiscard]] std::size_t next(std::uint32_t height, Scalar last) noexcept {
        while (at < runs.size() && runs[at].end <= height) ++at;
        return at < runs.size() && runs[at].scalar == last ? at + 1 : at;
    }
};
inline constexpr Scalar kNoScalar = 0xFFFFFFFFu;  ///< `last` at the bottom of a column

/// Encodes a block. The tiles need not be canonical: adjacent runs with equal scalars are merged, and decoding gives
/// the canonical form of the same samples. Cost: O(bytes of the tiles), about 1 s per GB and core.
/// \param tiles  shape.tilesX() * shape.tilesY() tiles, x fastest
[[nodiscard]] BlockStreams encodeBlock(std::span<const ColumnTile> tiles, const BlockShape& shape);

/// Decodes the tiles of a block, in canonical form. Safe for any bytes: everything is checked before it is used or
/// allocated.
/// \param arrayBytes  limit for the bytes of the arrays of all tiles (see arrayBytesOf); memory stays below a few times
///                    this limit plus the size of the streams
/// \return the tiles, x fastest, or BadVolume with the reason
[[nodiscard]] Result<std::vector<ColumnTileData>> decodeBlock(const PerStream<std::span<const std::uint8_t>>& streams,
                                                              const BlockShape& shape, Scalar scalarCount,
                                                              std::uint64_t arrayBytes);

/// Bytes of the four arrays of a tile.
[[nodiscard]] inline std::uint64_t arrayBytesOf(const ColumnTile& tile) noexcept {
    return tile.rowOf.size_bytes() + tile.rowColumns.size_bytes() + tile.columnStart.size_bytes() +
           tile.runs.size_bytes();
}

}  // namespace svt::volume
