#pragma once
/// \file
/// Joins volumes on one lattice.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <span>

namespace svt::city {

/// Joins volumes whose samples lie on one lattice. Where several fill a sample, the first determines it. Label tables
/// are appended to each other, as are planes of faces. Overlaps are those of the volumes, and samples that several fill,
/// except if `isByClass`. Vectors are left out, see joinTriangles().
/// \param volumes      at least one, along the axes of the world, with equal spacing
/// \param isByClass    labels with the same id below the same one are one (levels whose labels are classes); ordered by
///                     the id of the parent, then their own
/// \return the volume; BadArgument if the lattices differ, GridTooLarge, TooManyLabels
/// Cost: O(columns of the result + runs). Memory: the result.
[[nodiscard]] Result<volume::SemanticVolume> joinVolumes(std::span<const volume::SemanticVolume> volumes,
                                                         bool isByClass = false);

/// The triangles of volumes for the result of joinVolumes(): labels in the same order, points relative to `grid`.
/// \param volumes  those that were joined, without `isByClass`, with their meshes
/// \param grid     of the result
/// \return parts whose unit is the coarsest of the volumes, or coarser for large grids: 32-bit numbers hold all points
/// Cost: O(points + triangles).
[[nodiscard]] volume::VectorParts joinTriangles(std::span<const volume::SemanticVolume> volumes,
                                                const volume::Grid& grid);

}  // namespace svt::city
