#pragma once
/// \file
/// Coarse levels of a city, details 2 and up: a quadtree of tiles above those of the plan, whose columns have a height and
/// the classes that stand there. docs/formats/city.md specifies them to the bit.
///
///     detail 2   4 s    a class a column: the one that covers most of it
///     detail 3   8 s    up to four classes a column with their coverage, in eighths
///     ...
///     the last   the whole city in one tile of at most 256 x 256 columns

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

/// Side of a tile in metres. Of details 2 and up it is that of 256 columns.
[[nodiscard]] double tileSide(const TileKey& tile, int detail, double spacing) noexcept;
/// Distance of columns, and of samples along them, in metres. Heights of details 2 and up are as fine as half a column,
/// and at least 4 m where that is not finer than detail 1.
[[nodiscard]] Vec3d spacingOf(int detail, double spacing) noexcept;

/// The tile of the next coarser detail that a tile belongs to, with all that stands in it: of detail 0 itself, of detail 1
/// the one whose square holds the middle of its own. Not that of the coarsest detail, which is one tile.
[[nodiscard]] TileKey tileAbove(const TileKey& tile, int detail, double spacing) noexcept;

/// What covers the columns of a label of detail 3 or up: classes ("Building", or "Building/RoofSurface" of parts) and eighths,
/// the one that covers most first. Empty where the label does not say (other details).
[[nodiscard]] std::vector<std::pair<std::string, int>> coverageOf(const volume::Label& label);

}  // namespace svt::city
