#pragma once
/// \file
/// The levels of detail that formats with several levels hold beside the volume itself.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::writers {

/// Each level with half the samples of the one before along each axis, until the longest side has at most 64 samples, at
/// most six; none of a volume that is so small itself.
/// \param threads  maximum; 0: all cores
/// \return the levels, finest first, or an error of volume::coarseVolumes()
[[nodiscard]] Result<std::vector<volume::SemanticVolume>> coarserLevels(const volume::SemanticVolume& volume,
                                                                        int threads);

}  // namespace svt::writers
