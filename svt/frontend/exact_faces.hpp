#pragma once
/// \file
/// Pictures by the faces of the model instead of voxels: for `svt render --surfaces exact`, and `surfaces` in Python.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/render/face_model.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace svt::frontend {

/// The source of the labels of pictures.
enum class SurfaceSource : std::uint8_t { Voxels, Exact };
constexpr auto namesOf(SurfaceSource) {
    return std::to_array<Name<SurfaceSource>>({{SurfaceSource::Voxels, "voxels"}, {SurfaceSource::Exact, "exact"}});
}

/// Prepares a scene for exact faces: passes without a level get the finest one.
/// \return nothing, or BadArgument if the scene has cells, exploded storeys or a coarse level, which need voxels
[[nodiscard]] Result<void> prepareForFaces(illustrate::Scene& scene);

/// The faces of a volume, for ScenePainter::drawBy().
/// \param notes  gets a note if voxels show some of the features
/// \return the faces, or BadArgument if the volume has no meshes. Cost: FaceModel::make()
[[nodiscard]] Result<std::unique_ptr<render::FaceModel>> makeFaces(const volume::SemanticVolume& volume,
                                                                   std::vector<std::string>& notes);

}  // namespace svt::frontend
