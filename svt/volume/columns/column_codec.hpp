#pragma once
/// \file
/// Internal: a block of tiles as eight streams of small numbers, and back. Nothing is compressed here; the streams are
/// made so that a general compressor finds little left in them. docs/formats/svt.md specifies them to the bit.
///
/// A block is coded as one picture whose pixels are columns. A row is a list of segments of equal columns, each told by
/// what differs from the row before: the column above it, found again a little to the left or right, or a new column.
/// A new column is told by its neighbours, the columns to the left and above: copy their runs, move an end, or
/// insert a run. So planes, straight walls and repeated rows cost next to nothing, whatever their direction.

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

/// The streams, in the order in which a file has them. Numbers are LEB128 but for the bytes of Operations and Commands.
enum class BlockStream : std::uint8_t {
    Repeats,     ///< before each coded row: how many rows before it repeat the one before them
    Operations,  ///< a byte per segment: which column, and how far its end moved
    Shifts,      ///< zigzag: movements that do not fit into an operation
    Widths,      ///< inserted segments: width - 1
    Commands,    ///< bytes that make a new column from its neighbours
    Moves,       ///< zigzag: movements that do not fit into a command
    Scalars,     ///< of inserted runs
    Heights      ///< of inserted runs, in samples - 1
};
inline constexpr std::size_t kBlockStreams = 8;

template <class T>
using PerStream = std::array<T, kBlockStreams>;
using BlockStreams = PerStream<std::vector<std::uint8_t>>;

/// What an operation says: byte = kind + kOperationKinds * movement. Movement 0: it stands in Shifts (or there is
/// none); 1 ... 7: -3 ... 3.
inline constexpr std::uint32_t kOperationKinds = 6;
inline constexpr std::uint32_t kReplace = 4;  ///< 0 ... 3: the column above, after leaving out so many segments above
inline constexpr std::uint32_t kInsert = 5;
inline constexpr std::int32_t kMaxShift = 3;

/// Commands below kCopy; kCopy + 2 * n + source copies n runs (0: all up to the top), source 0: left, 1: above.
inline constexpr std::uint32_t kNewRun = 0;
inline constexpr std::uint32_t kMoveLeft = 1;      ///< the next run of the column to the left, with another end
inline constexpr std::uint32_t kMoveAbove = 2;     ///< the same of the column above
inline constexpr std::uint32_t kNearLeft = 3;      ///< 3 ... 6: end moved by -2, -1, 1, 2
inline constexpr std::uint32_t kNearAbove = 7;     ///< 7 ... 10
inline constexpr std::uint32_t kFirstUnused = 11;  ///< 11 ... 15
inline constexpr std::uint32_t kCopy = 16;
inline constexpr std::uint32_t kMaxCopy = 119;

/// One of the two columns that a new one is told by.
struct ReferenceColumn {
    std::span<const Run> runs;
    std::size_t at = 0;

    /// Number of the run that is compared with the next one of a column that reaches up to `height` with a run of
    /// `last`: the first that ends above, or the one behind it where that has the same scalar. May be runs.size().
    [[nodiscard]] std::size_t next(std::uint32_t height, Scalar last) noexcept {
        while (at < runs.size() && runs[at].end <= height) ++at;
        return at < runs.size() && runs[at].scalar == last ? at + 1 : at;
    }
};
inline constexpr Scalar kNoScalar = 0xFFFFFFFFu;  ///< `last` at the bottom of a column

/// The streams of a block. Tiles need not be canonical: equal neighbouring runs are joined, and decoding gives the
/// canonical form of the same samples. Cost: O(bytes of the tiles), about 1 s per GB and core.
/// \param tiles  shape.tilesX() * shape.tilesY() tiles, x fastest
[[nodiscard]] BlockStreams encodeBlock(std::span<const ColumnTile> tiles, const BlockShape& shape);

/// The tiles of a block in canonical form. Any bytes are safe: everything is checked before it is used or allocated.
/// \param arrayBytes  most bytes that the arrays of all tiles may take (see arrayBytesOf); memory stays below a few
///                    times that and the size of the streams
/// \return the tiles, x fastest, or BadVolume that says what is wrong
[[nodiscard]] Result<std::vector<ColumnTileData>> decodeBlock(const PerStream<std::span<const std::uint8_t>>& streams,
                                                              const BlockShape& shape, Scalar scalarCount,
                                                              std::uint64_t arrayBytes);

/// Bytes of the four arrays of a tile.
[[nodiscard]] inline std::uint64_t arrayBytesOf(const ColumnTile& tile) noexcept {
    return tile.rowOf.size_bytes() + tile.rowColumns.size_bytes() + tile.columnStart.size_bytes() +
           tile.runs.size_bytes();
}

}  // namespace svt::volume
