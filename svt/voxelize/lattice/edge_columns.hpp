#pragma once
/// \file
/// The column at which an edge crosses each row of a tile. SIMD by Google Highway: compiled for several instruction
/// sets, the best one available is chosen at run time; all give the same results.

#include <svt/voxelize/lattice/scan.hpp>

#include <cstddef>
#include <cstdint>

namespace svt::voxelize {

/// Size of the output buffer of edgeColumns(): it may write this many numbers, whatever the count of rows.
inline constexpr std::size_t kEdgeSpace = 64 + 8;

/// Sets of rows of an edge, one bit per row.
struct EdgeRows {
    std::uint64_t west = 0;    ///< the edge passes west of the tile: column <= 0
    std::uint64_t within = 0;  ///< 0 < column < width
    std::uint64_t moves = 0;   ///< the column differs from that of the row before
};

/// Columns of an edge in `count` rows, starting at the row of `walk`. A column is the first sample at or right of the
/// edge, relative to `firstColumn`.
/// \param count    1 to 64
/// \param columns  buffer of kEdgeSpace numbers; entries of rows `within` are valid, all others are unspecified
[[nodiscard]] EdgeRows edgeColumns(const EdgeWalk& walk, std::int32_t firstColumn, std::int32_t width,
                                   std::int32_t count, std::uint8_t* columns);

}  // namespace svt::voxelize
