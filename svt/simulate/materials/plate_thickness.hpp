#pragma once
/// \file
/// The mean thickness of components that are plates: walls, slabs, roofs.

#include <svt/volume/semantic_volume.hpp>

#include <vector>

namespace svt::simulate {

/// Metres per label: the volume (of the closed mesh if the label states it, else of its voxels), divided by the area of one
/// side. With meshes, a side is half of the triangles that are parallel to most others. Without, its area follows from the
/// rows of voxels along the two axes that are most across it. 0 for labels without voxels.
/// Cost: O(runs of all columns), and O(n log n) for n triangles.
[[nodiscard]] std::vector<double> plateThicknesses(const volume::SemanticVolume& volume);

}  // namespace svt::simulate
