#pragma once
/// \file
/// The number of voxels that labels of two volumes have in common.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace svt::compare {

/// The sparse matrix of common voxels. Empty where the grids have no common samples.
class VoxelOverlaps {
public:
    struct Entry {
        std::uint32_t was = 0, is = 0;  ///< labels
        std::uint64_t voxels = 0;
    };

    /// \param isWanted  by old label and by new label: only pairs with a wanted label are counted
    /// Cost: O(runs of all columns).
    VoxelOverlaps(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                  const std::vector<char>& isWantedOfWas, const std::vector<char>& isWantedOfIs);

    /// Whether the samples of both grids coincide.
    [[nodiscard]] bool isOnOneLattice() const noexcept { return isOnOneLattice_; }
    /// All pairs with common voxels, ordered by (was, is).
    [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
    [[nodiscard]] std::uint64_t of(std::uint32_t was, std::uint32_t is) const noexcept;

private:
    std::vector<Entry> entries_;
    bool isOnOneLattice_ = false;
};

/// The sample of the old grid at sample (0, 0, 0) of the new grid; nothing if the samples do not coincide.
[[nodiscard]] std::optional<Vec3i> latticeOffset(const volume::Grid& was, const volume::Grid& is) noexcept;

}  // namespace svt::compare
