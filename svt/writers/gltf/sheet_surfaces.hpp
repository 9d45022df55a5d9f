#pragma once
/// \file
/// Surfaces that a volume keeps as triangles of the model, in place of the surfaces of their voxels. A terrain of
/// 125,000 triangles has millions of voxel faces.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/surface_positions.hpp>

#include <vector>

namespace svt::writers {

/// Triangles of labels, and their places.
struct SheetSurfaces {
    std::vector<LabelSurface> surfaces;  ///< ascending by label; only the number of `vertices` has a meaning
    std::vector<Positions> positions;    ///< of each surface
};

/// The triangles of each label that has voxels and whose triangles the volume keeps. Without `allLabels` only of labels
/// without inside (volume::Filling::Surface), whose voxels are a layer of stairs.
[[nodiscard]] SheetSurfaces sheetSurfaces(const volume::SemanticVolume& volume, bool allLabels);

}  // namespace svt::writers
