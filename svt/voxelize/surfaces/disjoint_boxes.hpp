#pragma once
/// \file
/// Merges voxels given as overlapping boxes into few disjoint boxes.

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Appends the union of `boxes` to `disjoint`, as boxes without overlap: first runs along z, then equal adjacent runs
/// along x and equal boxes of successive rows are merged.
/// \param boxes  all of one claim that count alike, each one row high, inside the grid
/// \return count of voxels
/// Cost: O(r log r) for the r runs of each row, plus O(boxes + rows). Memory: a copy of the boxes and the runs of one
/// row.
std::uint64_t addDisjoint(std::span<const ClaimedBox> boxes, std::vector<ClaimedBox>& disjoint);

}  // namespace svt::voxelize
