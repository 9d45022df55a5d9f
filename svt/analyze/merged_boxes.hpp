#pragma once
/// \file
/// The voxels of a label or a group of labels as few boxes, for solvers and games that read only boxes.

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/volume_part.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// A box whose voxels are all of one group.
struct GroupBox {
    std::uint32_t group = 0;
    volume::IndexBox box;
    friend bool operator==(const GroupBox&, const GroupBox&) = default;
};

/// Boxes that hold each voxel of a group once and nothing else. Greedy: runs of a column grow along x while the next
/// column has the same, then along y while the next row has the same. Not the fewest possible.
/// \param groupOfScalar  one entry for each scalar of `columns`; kNoLabel: belongs to no group
/// \return ordered by group, then by lower corner (z, y, x); BadArgument if there would be more than `maxBoxes`
/// Cost: O(columns + runs of columns that differ from the one before). Memory: the boxes.
[[nodiscard]] Result<std::vector<GroupBox>> mergeBoxes(const volume::ColumnVolume& columns,
                                                       std::span<const std::uint32_t> groupOfScalar,
                                                       std::size_t maxBoxes);

}  // namespace svt::analyze
