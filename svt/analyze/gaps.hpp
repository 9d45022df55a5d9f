#pragma once
/// \file
/// Gaps: enclosed background, which belongs to no label and is not connected to the outside.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// A connected component of background (voxels connected by faces) that does not reach the border of the grid.
struct Gap {
    std::uint64_t voxels = 0;
    SampleBox box;
    std::vector<std::uint32_t> around;  ///< labels that share a face with it, ascending
    friend bool operator==(const Gap&, const Gap&) = default;
};

/// All gaps, largest first, then by position (z, y, x of the box's lower corner).
/// Cost: O(runs of all columns, not only of distinct ones). Memory: two rows of columns, and a few words per
/// provisional component of background.
[[nodiscard]] std::vector<Gap> findGaps(const volume::ColumnVolume& columns, const volume::LabelTable& labels);

}  // namespace svt::analyze
