#pragma once
/// \file
/// Cavities: background that cannot be reached from outside, and the group that encloses it.
///
/// Connected components of background (by faces) are found by union-find over the background runs of the columns.
/// Consecutive equal rows and columns share their nodes, so the cost of a tile depends on the differences in it:
///
///     stretch   consecutive equal rows
///     cell      consecutive equal columns in a stretch. firstNode[x + width * stretch] is the node of its lowest
///               background run; the nodes of the runs above follow
///
/// Background with a face on the volume's border is outside.

#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// The value of voxels that are neither background nor in a group.
inline constexpr std::uint32_t kNoGroupValue = 0xFFFFFFFFu;

class EnclosedAir {
public:
    /// \param valueOfScalar  entry per scalar: 0: background; kNoGroupValue: no group; else the group's value
    /// Cost: O(runs of neighbouring columns that differ). The result does not depend on `threads`.
    [[nodiscard]] static EnclosedAir find(const volume::ColumnVolume& columns,
                                          std::span<const std::uint32_t> valueOfScalar, int threads);

    /// The result for a volume without enclosed background.
    [[nodiscard]] static EnclosedAir none(const volume::ColumnVolume& columns);

    /// Whether any background of the tile is enclosed by a single group.
    [[nodiscard]] bool isIn(std::size_t tile) const noexcept { return !tiles_[tile].valueOfNode.empty(); }
    /// Values of the background runs of column (x, y), bottom up: the single group that encloses the run, else 0. Only
    /// for tiles with isIn().
    [[nodiscard]] const std::uint32_t* values(std::size_t tile, std::size_t x, std::size_t y) const noexcept {
        return tiles_[tile].valueOfNode.data() + node(tile, x, y);
    }
    /// Node of the lowest background run of a column. Neighbouring columns with the same node have equal runs and equal
    /// values.
    [[nodiscard]] std::uint32_t node(std::size_t tile, std::size_t x, std::size_t y) const noexcept {
        const Tile& t = tiles_[tile];
        return t.firstNode[x + t.width * t.stretchOfRow[y]];
    }

private:
    struct Tile {
        std::size_t width = 0;
        std::vector<std::uint8_t> stretchOfRow;
        std::vector<std::uint32_t> firstNode;
        std::vector<std::uint32_t> valueOfNode;  // empty if all are 0
    };
    class TileScan;

    std::vector<Tile> tiles_;
};

}  // namespace svt::illustrate
