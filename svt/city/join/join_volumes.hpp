#pragma once
/// \file
/// Volumes on one lattice as one volume.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <span>

namespace svt::city {

/// Puts volumes together whose samples lie on one lattice. Where several fill a sample, the first has it; label tables
/// follow each other, so do planes of faces. Vectors and overlaps are left out.
/// \param volumes      at least one, along the axes of the world, with equal spacing
/// \param isByClass    labels with the same id below the same one are one (levels whose labels are classes); ordered by
///                     the id of the parent, then their own
/// \return the volume, BadArgument where the lattices differ, GridTooLarge, TooManyLabels
/// Cost: O(columns of the result + runs). Memory: the result.
[[nodiscard]] Result<volume::SemanticVolume> joinVolumes(std::span<const volume::SemanticVolume> volumes,
                                                         bool isByClass = false);

}  // namespace svt::city
