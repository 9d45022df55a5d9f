#pragma once
/// \file
/// The own volumes of labels, see exclusive_volumes.hpp, in the closed meshes of a second volume on the same grid.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace svt::analyze {

/// A volume and the error that the rounding of corners causes, m3.
struct BoundedVolume {
    double volume = 0, bound = 0;
};

struct ExclusiveParts {
    std::vector<double> all;  ///< by label: exact own volume, m3; NaN: not exact, or not asked for
    std::map<std::pair<std::uint32_t, std::uint32_t>, BoundedVolume> shared;  ///< by label, label of the second volume
};

/// \param labels  ascending
/// \param others  a volume on the same grid
/// \param work    maximum number of steps, see SolidOverlapOptions
[[nodiscard]] ExclusiveParts exclusiveParts(const volume::SemanticVolume& volume, std::span<const std::uint32_t> labels,
                                            const volume::SemanticVolume& others, std::uint64_t work);

}  // namespace svt::analyze
