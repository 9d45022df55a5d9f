#pragma once
/// \file
/// The levels of detail that formats with several levels contain besides the volume itself.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::writers {

/// Each level has half the samples of the previous one along each axis, until the longest side has at most 64 samples.
/// Up to six levels; none for a volume of this size.
/// \param threads  maximum; 0: all cores
/// \return the levels, finest first, or an error of volume::coarseVolumes()
[[nodiscard]] Result<std::vector<volume::SemanticVolume>> coarserLevels(const volume::SemanticVolume& volume,
                                                                        int threads);

}  // namespace svt::writers
