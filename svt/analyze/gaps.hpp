#pragma once
/// \file
/// Air that is shut in: background that no label claims and that has no way out.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// A connected piece of background (voxels that share a face) that does not reach the border of the grid.
struct Gap {
    std::uint64_t voxels = 0;
    SampleBox box;
    std::vector<std::uint32_t> around;  ///< labels that share a face with it, ascending
    friend bool operator==(const Gap&, const Gap&) = default;
};

/// All gaps, the largest first, then by place (z, y, x of the box's lower corner).
/// Cost: O(runs of all columns, not of the distinct ones). Memory: two rows of columns, and a few words per piece of
/// background that a row begins.
[[nodiscard]] std::vector<Gap> findGaps(const volume::ColumnVolume& columns, const volume::LabelTable& labels);

}  // namespace svt::analyze
