#pragma once
/// \file
/// The canonical form of a label volume: run-length encoded columns, shared per tile. Lossless; its size grows with the
/// surface of the objects, not with the volume.
///
/// The (x, y) plane is divided into tiles of 64 x 64 columns of full height. A tile holds a dictionary of its distinct
/// columns and one of its distinct rows of columns:
///
///     rowOf       [ 0 0 0 1 1 2 ... ]            64 rows of the tile -> row of the dictionary
///     rowColumns  [ 0 0 0 1 1 1 2 ... | ... ]    each dictionary row: `width` column numbers
///     columnStart [ 0 1 4 9 ... ]                each column: offset of its runs, last entry = runs.size()
///     runs        [ {end 163, scalar 0} | {end 10, 7} {end 80, 0} {end 163, 0} | ... ]
///
/// A run covers [end of the previous run (0 for the first), end). The last run ends at nz; adjacent runs differ in
/// scalar. Columns and rows are numbered by first use (y, then x ascending), so equal volumes have equal bytes.

#include <svt/core/hash_index.hpp>
#include <svt/core/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace svt::volume {

/// Value of a voxel; 0 is background. Stored with 32 bits; LabelTable::scalarBits() has the bits for a dense copy.
using Scalar = std::uint32_t;

/// An interval of a column with one scalar: k from the end of the previous run to `end` - 1.
struct Run {
    std::uint32_t end = 0;
    Scalar scalar = 0;
    friend bool operator==(const Run&, const Run&) = default;
};

/// Views of one tile's arrays; the volume's storage owns them.
struct ColumnTile {
    std::span<const std::uint8_t> rowOf;         ///< height entries
    std::span<const std::uint16_t> rowColumns;   ///< width * (distinct rows) entries
    std::span<const std::uint32_t> columnStart;  ///< distinct columns + 1 entries
    std::span<const Run> runs;

    [[nodiscard]] std::span<const Run> column(std::uint32_t number) const noexcept {
        return runs.subspan(columnStart[number], columnStart[number + 1] - columnStart[number]);
    }
};

/// The arrays of one tile, as made by a ColumnTileBuilder.
struct ColumnTileData {
    std::vector<std::uint8_t> rowOf;
    std::vector<std::uint16_t> rowColumns;
    std::vector<std::uint32_t> columnStart;
    std::vector<Run> runs;
    [[nodiscard]] ColumnTile view() const noexcept { return {rowOf, rowColumns, columnStart, runs}; }
};

/// A label volume, immutable and cheap to copy (shares its storage). Thread-safe to read.
class ColumnVolume {
public:
    static constexpr std::int32_t kTileSize = 64;  ///< columns along x and y

    ColumnVolume() = default;

    /// From tiles in row order (x fastest), as made by a ColumnTileBuilder. They are not checked.
    [[nodiscard]] static ColumnVolume fromTiles(Vec3i dimension, std::vector<ColumnTileData> tiles);

    /// From a dense array, x fastest, then y, then z (index i + nx * (j + ny * k)).
    [[nodiscard]] static ColumnVolume fromDense(Vec3i dimension, std::span<const Scalar> scalars);

    [[nodiscard]] Vec3i dimension() const noexcept { return dimension_; }
    [[nodiscard]] std::int32_t tilesX() const noexcept { return (dimension_.x + kTileSize - 1) / kTileSize; }
    [[nodiscard]] std::int32_t tilesY() const noexcept { return (dimension_.y + kTileSize - 1) / kTileSize; }
    [[nodiscard]] std::span<const ColumnTile> tiles() const noexcept { return tiles_; }  ///< x fastest
    [[nodiscard]] std::int32_t tileWidth(std::int32_t tileX) const noexcept;
    [[nodiscard]] std::int32_t tileHeight(std::int32_t tileY) const noexcept;

    /// Runs of column (i, j), bottom up. Cost O(1).
    [[nodiscard]] std::span<const Run> column(std::int32_t i, std::int32_t j) const noexcept;
    /// Scalar of sample (i, j, k). Cost O(log runs).
    [[nodiscard]] Scalar scalarAt(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept;

    /// Count of voxels per scalar: `scalarCount` entries; larger scalars are not counted. Cost: O(runs of distinct
    /// columns + distinct rows * width).
    [[nodiscard]] std::vector<std::uint64_t> countVoxels(Scalar scalarCount) const;
    /// Bytes of all arrays.
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

    /// Same dimension and same scalar at every sample; compares the arrays, since the form is canonical.
    friend bool operator==(const ColumnVolume& a, const ColumnVolume& b) noexcept;

private:
    Vec3i dimension_{};
    std::vector<ColumnTile> tiles_;
    std::shared_ptr<const void> storage_;
};

/// Builds tiles, one after the other and each row by row, storing equal columns and equal rows once. Keeps its buffers
/// between tiles.
class ColumnTileBuilder {
public:
    explicit ColumnTileBuilder(std::int32_t width) { start(width); }

    /// Begins a tile of `width` columns; an unfinished tile is discarded.
    void start(std::int32_t width);

    /// Number of the column with these runs, added if new. Runs: ends ascending, last = nz, adjacent ones differ in
    /// scalar.
    [[nodiscard]] std::uint16_t addColumn(std::span<const Run> runs);
    /// The same without a copy: returns space for at most `count` runs. The caller fills it and calls endColumn().
    [[nodiscard]] Run* beginColumn(std::size_t count) {
        if (runs_.size() < runCount_ + count) runs_.resize(2 * (runCount_ + count));
        return runs_.data() + runCount_;
    }
    /// Ends the column of beginColumn(). `count` is its actual number of runs, at most that of beginColumn().
    /// \return the number of the column
    [[nodiscard]] std::uint16_t endColumn(std::size_t count);
    /// Adds the next row: `width` column numbers.
    void addRow(std::span<const std::uint16_t> columns);
    /// Adds a row equal to the one before.
    void repeatRow();
    /// Number of rows added so far.
    [[nodiscard]] std::int32_t rowCount() const noexcept { return static_cast<std::int32_t>(rowOf_.size()); }
    /// The finished tile. It is canonical if columns were added in order of first use and all are used.
    [[nodiscard]] ColumnTileData finish() const;

private:
    [[nodiscard]] std::span<const Run> column(std::uint32_t number) const noexcept {
        return std::span(runs_).subspan(columnStart_[number], columnStart_[number + 1] - columnStart_[number]);
    }

    std::size_t width_ = 0;
    std::vector<Run> runs_;  // the first runCount_ are in use
    std::size_t runCount_ = 0;
    std::vector<std::uint32_t> columnStart_;
    std::vector<std::uint16_t> rowColumns_;
    std::vector<std::uint8_t> rowOf_;
    HashIndex columnIndex_{512}, rowIndex_{128};
};

}  // namespace svt::volume
