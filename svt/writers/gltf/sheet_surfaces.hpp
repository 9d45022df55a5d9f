#pragma once
/// \file
/// Surfaces that a volume keeps as triangles of the model, in place of the surfaces of their voxels. A terrain of
/// 125,000 triangles has millions of voxel faces.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/surface_positions.hpp>
#include <svt/writers/surface_source.hpp>

#include <cstdint>
#include <vector>

namespace svt::writers {

/// Triangles of labels, and their places.
struct SheetSurfaces {
    std::vector<LabelSurface> surfaces;  ///< ascending by label; only the number of `vertices` has a meaning
    std::vector<Positions> positions;    ///< of each surface
};

/// The drawn triangles of each chosen label, see drawnTriangles(). The surface of a label is empty if all of its
/// triangles are covered.
[[nodiscard]] SheetSurfaces sheetSurfaces(const volume::SemanticVolume& volume, MeshChoice choice);

/// The label of each scalar; volume::kNoLabel for those of labels with triangles.
/// \param labelOfScalar  of all scalars
[[nodiscard]] std::vector<std::uint32_t> withoutSheets(std::vector<std::uint32_t> labelOfScalar,
                                                       const volume::LabelTable& labels, const SheetSurfaces& sheets);

}  // namespace svt::writers
