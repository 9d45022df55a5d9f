#pragma once
/// \file
/// Bounding boxes of the voxels of each scalar and label.

#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace svt::analyze {

/// A box of samples, [min, max] inclusive; empty by default.
struct SampleBox {
    Vec3i min{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max(),
              std::numeric_limits<std::int32_t>::max()};
    Vec3i max{-1, -1, -1};

    [[nodiscard]] bool isEmpty() const noexcept { return max.x < min.x; }
    void add(const SampleBox& box) noexcept {
        for (int axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], box.min[axis]);
            max[axis] = std::max(max[axis], box.max[axis]);
        }
    }
    friend bool operator==(const SampleBox&, const SampleBox&) = default;
};

/// The box of each scalar's samples; entry s is scalar s < scalarCount, empty if it has no samples.
/// Cost: O(distinct rows + runs of distinct columns of all tiles).
[[nodiscard]] std::vector<SampleBox> scalarBoxes(const volume::ColumnVolume& columns, volume::Scalar scalarCount);

/// The box of each label's own samples; entry l is label l. Cost: that of scalarBoxes(), and O(scalars).
[[nodiscard]] std::vector<SampleBox> labelBoxes(const volume::ColumnVolume& columns, const volume::LabelTable& labels);

}  // namespace svt::analyze
