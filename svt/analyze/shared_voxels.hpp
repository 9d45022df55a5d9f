#pragma once
/// \file
/// Overlay of two label volumes on one grid, such as components and parcels: the voxels that each pair of labels
/// shares.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// Number of voxels that are `a` in the first volume and `b` in the second.
struct SharedVoxels {
    std::uint32_t a = volume::kNoLabel;  ///< label of the first; kNoLabel: background
    std::uint32_t b = volume::kNoLabel;  ///< label of the second; kNoLabel: background
    std::uint64_t voxels = 0;
    friend bool operator==(const SharedVoxels&, const SharedVoxels&) = default;
};

/// All pairs that share a voxel, ordered by (a, b), kNoLabel last; voxels that are background in both are left out.
/// \param threads  0: all cores; the result does not depend on it
/// \return the pairs, or BadArgument if the grids differ: in dimension, or in the position of samples by more than 1e-6
///         of a spacing
/// Cost: O(runs of the distinct pairs of columns in each tile).
[[nodiscard]] Result<std::vector<SharedVoxels>> sharedVoxels(const volume::SemanticVolume& first,
                                                             const volume::SemanticVolume& second, int threads = 0);

}  // namespace svt::analyze
