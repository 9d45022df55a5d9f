#include <svt/illustrate/exact_faces.hpp>

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/render/face_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace svt::illustrate {

bool drawsFaces(std::optional<SurfaceSource> surfaces, const VolumeRepresentation& representation) noexcept {
    return surfaces != SurfaceSource::Voxels && !representation.shell && !representation.hasCells &&
           representation.level.value_or(0) == 0;
}

bool drawsFaces(const Scene& scene) noexcept {
    return std::ranges::any_of(scene.passes,
                               [&](const ScenePass& pass) { return drawsFaces(scene.surfaces, pass.representation); });
}

Result<void> checkSurfaces(const Scene& scene) {
    if (scene.surfaces != SurfaceSource::Exact) return {};
    for (const ScenePass& pass : scene.passes) {
        const bool hasLevel = pass.representation.level.value_or(0) != 0;
        if (hasLevel || pass.representation.hasCells)
            return Error(Code::BadArgument,
                         fmt::format("--surfaces exact does not support {}; leave out one of the two",
                                     hasLevel ? "--level" : "--cells"));
    }
    return {};
}

Result<ExactFaces> makeFaces(const volume::SemanticVolume& volume) {
    SVT_TRY(faces, render::FaceModel::make(volume, analyze::labelsByPriority(volume.labels)));
    const auto counts = (*faces)->counts();
    return ExactFaces{std::move(*faces), counts.byVoxels + counts.solids + counts.sheets, counts.byVoxels};
}

}  // namespace svt::illustrate
