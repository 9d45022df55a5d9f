#pragma once
/// \file
/// Internal: background that cannot be reached from outside, and whose it is.
///
/// Background is joined face to face by union-find over the background runs of the columns. Rows and columns that
/// repeat share their nodes, so a tile costs what differs in it:
///
///     row stretch   equal rows one after the other              cells   firstNode[x + width * stretch]: node of the
///     cell          equal columns side by side in a stretch             cell's lowest background run; the others
///     follow
///
/// Background with a face on the volume's border is outside.

#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// A value that is neither background nor a group.
inline constexpr std::uint32_t kNoGroupValue = 0xFFFFFFFFu;

class EnclosedAir {
public:
    /// \param valueOfScalar  0: background; kNoGroupValue: no group; else the group's value. Has an entry per scalar
    /// Cost: O(runs of neighbouring columns that differ). The result does not depend on `threads`.
    [[nodiscard]] static EnclosedAir find(const volume::ColumnVolume& columns,
                                          std::span<const std::uint32_t> valueOfScalar, int threads);

    /// No air at all.
    [[nodiscard]] static EnclosedAir none(const volume::ColumnVolume& columns);

    /// Whether some background of the tile is enclosed by one group alone.
    [[nodiscard]] bool isIn(std::size_t tile) const noexcept { return !tiles_[tile].valueOfNode.empty(); }
    /// Values of the background runs of column (x, y) of a tile for which isIn(), bottom up: the group that alone
    /// encloses it, else 0.
    [[nodiscard]] const std::uint32_t* values(std::size_t tile, std::size_t x, std::size_t y) const noexcept {
        return tiles_[tile].valueOfNode.data() + node(tile, x, y);
    }
    /// Equal for columns of one tile with equal runs and equal values.
    [[nodiscard]] std::uint32_t node(std::size_t tile, std::size_t x, std::size_t y) const noexcept {
        const Tile& t = tiles_[tile];
        return t.firstNode[x + t.width * t.stretchOfRow[y]];
    }

private:
    struct Tile {
        std::size_t width = 0;
        std::vector<std::uint8_t> stretchOfRow;
        std::vector<std::uint32_t> firstNode;
        std::vector<std::uint32_t> valueOfNode;  // empty where all are 0
    };
    class TileScan;

    std::vector<Tile> tiles_;
};

}  // namespace svt::illustrate
