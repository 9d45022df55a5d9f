#pragma once
/// \file
/// The surfaces of all labels with final positions of vertices: the source of all formats of triangles.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/surface_positions.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstddef>
#include <vector>

namespace svt::writers {

struct LabelHulls {
    std::vector<LabelSurface> surfaces;  ///< ascending by label; only labels with voxels
    std::vector<Positions> positions;    ///< positions of the vertices of each surface
    const volume::SemanticVolume* volume = nullptr;
    bool hasMeshes = false;  ///< some surfaces are triangles of the model, which need not be closed

    /// World directions, metres from the lower corner of the grid.
    [[nodiscard]] Vec3d fromCorner(std::size_t surface, std::size_t vertex) const {
        const auto& [x, y, z] = volume->grid.axes();
        const Vec3d p = toDouble(positions[surface][vertex]);
        return x * p.x + y * p.y + z * p.z;
    }
    /// The lower corner of the grid, the outer corner of sample (0, 0, 0), world space.
    [[nodiscard]] Vec3d corner() const { return lowerCorner(volume->grid); }
    [[nodiscard]] const volume::Label& label(std::size_t surface) const {
        return volume->labels.labels[surfaces[surface].label];
    }
};

/// \param volume  must outlive the hulls
/// \return the hulls, or NothingSelected if no label has voxels, GridTooLarge for too many triangles, BadArgument,
///         Cancelled
[[nodiscard]] Result<LabelHulls> makeLabelHulls(const volume::SemanticVolume& volume,
                                                const VolumeWriteOptions& options);

}  // namespace svt::writers
