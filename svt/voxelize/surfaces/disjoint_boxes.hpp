#pragma once
/// \file
/// Voxels given as boxes that may overlap, to few boxes that do not.

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Appends the voxels of `boxes`, each once: runs along z, equal runs side by side along x, then equal boxes of
/// successive rows are joined.
/// \param boxes  of one claim, each one row high, within the grid
/// \return count of voxels
/// Cost: O(r log r) in the runs of a row, O(boxes + rows) in all. Memory: the boxes, and the runs of one row.
std::uint64_t addDisjoint(std::span<const ClaimedBox> boxes, std::vector<ClaimedBox>& disjoint);

}  // namespace svt::voxelize
