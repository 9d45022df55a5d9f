#pragma once
/// \file
/// The sides of components, and the part of them that outside air touches: the hull of a building.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// Faces between voxels across x and y, m2.
struct SideArea {
    double whole = 0;    ///< towards other groups and background
    double outside = 0;  ///< of it: towards outside air
    friend bool operator==(const SideArea&, const SideArea&) = default;
};

/// The sides of each group of scalars. Outside air is background that is connected to the border of the grid (voxels
/// connected by faces), and the space beyond the grid. Rooms are groups, so the air in them is not outside air.
/// \param groupOfScalar  the group of each scalar; volume::kNoLabel: background
/// \param groups         number of groups
/// Faces overestimate the area of an oblique side by up to a factor of sqrt(2), in both numbers alike.
/// Cost: O(runs of all columns). Memory: see findGaps().
[[nodiscard]] std::vector<SideArea> findSideAreas(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                                  std::span<const std::uint32_t> groupOfScalar, std::size_t groups);

}  // namespace svt::analyze
