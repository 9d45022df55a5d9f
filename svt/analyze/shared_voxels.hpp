#pragma once
/// \file
/// Two label sets over one grid, such as components and parcels: how much of each lies in which of the other.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// Voxels that are `a` in one volume and `b` in the other.
struct SharedVoxels {
    std::uint32_t a = volume::kNoLabel;  ///< label of the first; kNoLabel: background
    std::uint32_t b = volume::kNoLabel;  ///< label of the second; kNoLabel: background
    std::uint64_t voxels = 0;
    friend bool operator==(const SharedVoxels&, const SharedVoxels&) = default;
};

/// All pairs that share a voxel, ordered by (a, b), kNoLabel last; background of both is left out.
/// \param threads  0: all cores; the result does not depend on it
/// \return the pairs, or BadArgument where the grids differ (dimension, or samples apart by more than a millionth of a
///         spacing)
/// Cost: O(distinct pairs of columns in each tile * their runs).
[[nodiscard]] Result<std::vector<SharedVoxels>> sharedVoxels(const volume::SemanticVolume& first,
                                                             const volume::SemanticVolume& second, int threads = 0);

}  // namespace svt::analyze
