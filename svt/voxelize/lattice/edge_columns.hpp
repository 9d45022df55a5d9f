#pragma once
/// \file
/// Where an edge crosses the rows of a tile. Compiled for several instruction sets, of which the best that the machine
/// has is taken when the program runs; all give the same numbers. Internal to voxelize.

#include <svt/voxelize/lattice/scan.hpp>

#include <cstddef>
#include <cstdint>

namespace svt::voxelize {

/// edgeColumns() may write so many numbers, whatever the count of rows.
inline constexpr std::size_t kEdgeSpace = 64 + 8;

/// Rows of an edge, a bit each.
struct EdgeRows {
    std::uint64_t west = 0;    ///< it passes the tile to the west: column <= 0
    std::uint64_t within = 0;  ///< 0 < column < width
    std::uint64_t moves = 0;   ///< another column than in the row before
};

/// Columns of an edge, first sample at or right of it less `firstColumn`, in `count` rows from the walk's own on.
/// \param count    1 to 64
/// \param columns  kEdgeSpace numbers, of which those of rows within are set and the rest left with any value
[[nodiscard]] EdgeRows edgeColumns(const EdgeWalk& walk, std::int32_t firstColumn, std::int32_t width,
                                   std::int32_t count, std::uint8_t* columns);

}  // namespace svt::voxelize
