#pragma once
/// \file
/// Positions of the vertices of label surfaces, for all formats of triangles.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/gltf/label_surface.hpp>

#include <span>
#include <vector>

namespace svt::writers {

/// Metres from the grid's lower corner, the outer corner of sample (0, 0, 0), along the grid's axes.
using Positions = std::vector<Vec3f>;

/// The smallest and largest coordinates of positions; at least one position is required.
struct Extent {
    Vec3f min, max;
};
[[nodiscard]] Extent extentOf(const Positions& positions) noexcept;

/// Positions of the vertices of each surface.
/// \param planesOf  the volume whose planes are used; null: `volume`
/// \param told      stage "vertices"; may be null
/// \return the positions, or an error of BrickVolume::fromColumns()
[[nodiscard]] Result<std::vector<Positions>> placeVertices(const volume::SemanticVolume& volume,
                                                           std::span<const LabelSurface> surfaces, GlbFaces faces,
                                                           const volume::SemanticVolume* planesOf, int threads,
                                                           const Progress* told);

}  // namespace svt::writers
