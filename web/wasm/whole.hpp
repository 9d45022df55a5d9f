#pragma once
/// \file
/// Parts that only the whole module has: it reads models, draws exact surfaces, and makes drawings and sheets. A visit
/// starts with a module that lacks them, and is smaller by two fifths.

#include "calls.hpp"

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/illustrate/exact_faces.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <span>
#include <string>

namespace svt::web {

struct BuiltVolume {
    volume::SemanticVolume volume;
    std::string spacingReason;
};

/// The models as one volume.
/// \return the volume, or an error of readModels() or buildVolume(); BadArgument in the module without readers
[[nodiscard]] Result<BuiltVolume> buildModels(std::span<const NamedBytes> files, const OpenOptions& options,
                                              const Progress* progress, Diagnostics& findings);

/// The maker of exact surfaces; null in the module that only draws voxels.
[[nodiscard]] illustrate::FaceMaker faceMaker() noexcept;

/// The calls of drawings and sheets; none in the module without writers.
[[nodiscard]] std::span<const Call> wholeCalls() noexcept;
/// The calls on fields; none in the module that only draws.
[[nodiscard]] std::span<const Call> fieldCalls() noexcept;

}  // namespace svt::web
