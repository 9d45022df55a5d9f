#include <svt/frontend/exact_faces.hpp>

#include <svt/pipeline/labels.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace svt::frontend {

Result<void> prepareForFaces(illustrate::Scene& scene) {
    const auto has = [&](const auto& isOne) { return std::ranges::any_of(scene.passes, isOne); };
    const std::pair<bool, const char*> needs[] = {
        {scene.explode != 0, "--explode (explode of a scene)"},
        {has([](const auto& pass) { return pass.representation.hasCells; }), "--cells (cells of a scene)"},
        {has([](const auto& pass) { return pass.representation.level.value_or(0) != 0; }),
         "--level (level of a scene)"}};
    for (const auto& [isGiven, option] : needs)
        if (isGiven)
            return Error(Code::BadArgument,
                         fmt::format("--surfaces exact does not support {}; leave out one of the two", option));
    for (illustrate::ScenePass& pass : scene.passes) pass.representation.level = 0;
    return {};
}

Result<std::unique_ptr<render::FaceModel>> makeFaces(const volume::SemanticVolume& volume,
                                                     std::vector<std::string>& notes) {
    SVT_TRY(faces, render::FaceModel::make(volume, pipeline::labelsByPriority(volume.labels)));
    if (const auto& counts = (*faces)->counts(); counts.byVoxels > 0)
        notes.push_back(
            fmt::format("exact surfaces: {} of {} features have no closed mesh, a pattern, or material divided among "
                        "surfaces; voxels show them",
                        counts.byVoxels, counts.byVoxels + counts.solids + counts.sheets));
    return std::move(*faces);
}

}  // namespace svt::frontend
