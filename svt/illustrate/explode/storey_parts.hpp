#pragma once
/// \file
/// Assigns parts of labels to storeys.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// The part of a label that belongs to storey `number`: below `end` (samples along z), down to the end of the previous
/// part.
struct StoreyPart {
    std::int32_t end = 0;
    int number = 0;
};

/// Parts of all labels; the last of each ends above all samples.
struct StoreyParts {
    std::vector<std::vector<StoreyPart>> ofLabel;
    int highest = 0;  ///< number of the highest storey of any building; 0: no storeys to draw apart
};

/// The rule is that of explodeStoreys().
[[nodiscard]] StoreyParts findStoreyParts(const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
