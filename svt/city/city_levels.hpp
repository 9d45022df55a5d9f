#pragma once
/// \file
/// Coarse levels of a city, details 2 and up: a quadtree of tiles above those of the plan. Their columns have a height
/// and the classes of the buildings there. docs/formats/city.md specifies them to the bit. `s` is the spacing of the
/// city.
///
///     detail 2   4 s    one class per column: the largest
///     detail 3   8 s    up to four classes per column, with coverage in eighths
///     ...
///     last       the whole city in one tile of at most 256 x 256 columns

#include <svt/city/city_plan.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace svt::city {

inline constexpr int kFirstClassDetail = 2;  ///< coarser ones have classes instead of buildings
inline constexpr int kLevelCells = 256;      ///< columns of a tile of details 2 and up, along x and y
inline constexpr int kMaxLevel = 24;         ///< of tiles of details 2 and up
inline constexpr int kCoverageSteps = 8;     ///< coverage is counted in eighths of a column

/// Side of a tile in metres. At details 2 and up it is the width of 256 columns.
[[nodiscard]] double tileSide(const TileKey& tile, int detail, double spacing) noexcept;
/// Distance between columns, and between samples along them, in metres. Vertically, details 2 and up have half the
/// spacing of columns, up to 4 m, but not less than detail 1.
[[nodiscard]] Vec3d spacingOf(int detail, double spacing) noexcept;

/// The tile of the next coarser detail that contains all buildings of a tile. For detail 0 it is the same tile. For
/// other details it is the tile whose square holds the middle of the given one. Does not apply if the next coarser
/// detail is the coarsest, which is one tile.
[[nodiscard]] TileKey tileAbove(const TileKey& tile, int detail, double spacing) noexcept;

/// Coverage of a mixture label (detail 3 and up): classes ("Building", or "Building/RoofSurface" for parts) with their
/// share in eighths, largest first. Empty for labels of other details.
[[nodiscard]] std::vector<std::pair<std::string, int>> coverageOf(const volume::Label& label);

}  // namespace svt::city
