#pragma once
/// \file
/// The faces of a volume as the source of the labels of its pictures.

#include <svt/core/result.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/run_source.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <memory>
#include <optional>

namespace svt::illustrate {

struct ExactFaces {
    std::unique_ptr<const render::RunSource> source;  ///< null if the volume has no meshes
    std::size_t features = 0, byVoxels = 0;           ///< all features, and those that voxels show
};

/// Whether a pass with this representation shows the faces of a volume that has meshes. Hulls, cells, coarse levels and
/// scenes with SurfaceSource::Voxels show voxels.
[[nodiscard]] bool drawsFaces(std::optional<SurfaceSource> surfaces,
                              const VolumeRepresentation& representation) noexcept;
/// Whether any pass of the scene shows faces.
[[nodiscard]] bool drawsFaces(const Scene& scene) noexcept;

/// \return nothing, or BadArgument for SurfaceSource::Exact with cells or coarse levels, which are voxels
[[nodiscard]] Result<void> checkSurfaces(const Scene& scene);

/// \return the faces, or BadArgument if the volume has no meshes. Cost: render::FaceModel::make()
[[nodiscard]] Result<ExactFaces> makeFaces(const volume::SemanticVolume& volume);

/// makeFaces(), or a null pointer in programs without exact surfaces.
using FaceMaker = Result<ExactFaces> (*)(const volume::SemanticVolume&);

}  // namespace svt::illustrate
