#include <svt/pipeline/stages/build_checks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::pipeline {
namespace {

// Whether the bounding box of an object, along the grid's axes, intersects the grid.
bool meetsGrid(const mesh::ObjectMesh& object, const mesh::MeshSet& meshes, const volume::Grid& grid) {
    Box3d box;
    for (const Vec3d& vertex : object.vertices) box.add(grid.indexFromWorld(vertex + meshes.origin));
    const Vec3i n = grid.dimension();
    return box.overlaps({{-0.5, -0.5, -0.5}, {n.x - 0.5, n.y - 0.5, n.z - 0.5}});
}

// Whether an object lies in the grid as a whole.
bool liesInGrid(const mesh::ObjectMesh& object, const mesh::MeshSet& meshes, const volume::Grid& grid) {
    const Vec3i n = grid.dimension();
    const Box3d box{{-0.5, -0.5, -0.5}, {n.x - 0.5, n.y - 0.5, n.z - 0.5}};
    return std::all_of(object.vertices.begin(), object.vertices.end(),
                       [&](const Vec3d& vertex) { return box.contains(grid.indexFromWorld(vertex + meshes.origin)); });
}

// Voxels of a label, plus voxels inside it that other labels took. These are finer solids that claim the same voxels,
// the surfaces, bodies and open shells below it, whose overlaps are not counted, and everything below an open shell. An
// upper bound: voxels that three labels claim count twice.
std::uint64_t mostVoxels(const volume::LabelTable& table, std::uint32_t label, std::uint64_t lostByPriority) {
    const bool isOpen = table.labels[label].filling == volume::Filling::Winding;
    std::uint64_t sum = table.labels[label].voxels + lostByPriority;
    for (std::uint32_t below = label + 1; below < table.labels[label].subtreeEnd; ++below) {
        const volume::Filling filling = table.labels[below].filling;
        if (isOpen || filling == volume::Filling::Surface || filling == volume::Filling::Body ||
            filling == volume::Filling::Winding)
            sum += table.labels[below].voxels;
    }
    return sum;
}

// A volume in m3 with enough digits to differ from another one: 48937.0, 12.3, 0.00123.
std::string cubicMetres(double volume) {
    return std::abs(volume) < 100 ? fmt::format("{:.3g}", volume) : fmt::format("{:.1f}", volume);
}

}  // namespace

Result<void> checkGivenGrid(const model::BuildingModel& model, const mesh::MeshSet& meshes, const volume::Grid& grid,
                            Diagnostics* log) {
    std::size_t outside = 0;
    for (const mesh::ObjectMesh& object : meshes.objects) {
        if (meetsGrid(object, meshes, grid)) continue;
        ++outside;
        if (log != nullptr)
            log->add(Severity::Warning, Code::NoGeometry, "no part of it lies in the given grid",
                     model.placeOf(object.feature));
    }
    if (outside < meshes.objects.size()) return {};
    const Vec3d low = meshes.bounds.min + meshes.origin, high = meshes.bounds.max + meshes.origin;
    return Error(
        Code::EmptyModel,
        fmt::format("no part of the model lies in the given grid: the model reaches from ({:.3f}, {:.3f}, "
                    "{:.3f}) to ({:.3f}, {:.3f}, {:.3f}), the grid starts at ({:.3f}, {:.3f}, {:.3f}). Use a "
                    "grid of the same place and CRS",
                    low.x, low.y, low.z, high.x, high.y, high.z, grid.origin().x, grid.origin().y, grid.origin().z));
}

void reportCutObjects(const model::BuildingModel& model, const mesh::MeshSet& meshes, const volume::Grid& grid,
                      const SpacingChoice& choice, Diagnostics& log) {
    const Vec3d size = scaled(toDouble(grid.dimension()), grid.spacing());
    for (const std::uint32_t o : choice.cutObjects) {
        Box3d box;
        for (const Vec3d& vertex : meshes.objects[o].vertices) box.add(vertex);
        const model::FeatureIndex feature = meshes.objects[o].feature;
        log.add(Severity::Warning, Code::GridTooLarge,
                fmt::format(
                    "this {} reaches over {:.0f} x {:.0f} m, far beyond all others; the default grid covers the "
                    "others, {:.0f} x {:.0f} m, and its voxels end there; --spacing {} covers all of it",
                    model.features[feature].className, box.size().x, box.size().y, size.x, size.y, choice.spacingOfAll),
                model.placeOf(feature));
    }
}

void checkVolumes(const model::BuildingModel& model, const Prepared& prepared, const voxelize::VoxelizeResult& voxels,
                  Diagnostics& log) {
    constexpr double kPart = 0.02;
    const auto& [meshes, grid, choice, labelled] = prepared;
    const Vec3d spacing = grid.spacing();
    const double halfVoxel = std::max({spacing.x, spacing.y, spacing.z}) / 2;
    std::vector<std::uint64_t> lost(meshes.objects.size(), 0);
    for (const voxelize::ClaimPair& pair : voxels.overlaps) lost[pair.b] += pair.voxels;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const mesh::ObjectMesh& object = meshes.objects[o];
        if (object.closingMethod == mesh::ClosingMethod::Surface || !object.isVolumeKnown ||
            !liesInGrid(object, meshes, grid))
            continue;
        const std::uint32_t l = labelled.labelOfObject[o];
        const volume::Label& label = labelled.table.labels[l];
        const double allowed = kPart * std::abs(object.enclosedVolume) + object.area * halfVoxel + grid.voxelVolume();
        const double most = double(mostVoxels(labelled.table, l, lost[o])) * grid.voxelVolume();
        const double least = double(label.voxels - std::min(label.voxels, label.thinVoxels)) * grid.voxelVolume();
        if (most >= object.enclosedVolume - allowed && least <= object.enclosedVolume + allowed) continue;
        log.add(Severity::Warning, Code::VolumeDiffers,
                fmt::format(
                    "its voxels are {} m3, its shell encloses {} m3{}; expected at most {} m3 between them; look at "
                    "the object and correct its faces",
                    cubicMetres(most < object.enclosedVolume ? most : least), cubicMetres(object.enclosedVolume),
                    object.isSolid() ? "" : " if its holes are closed straight", cubicMetres(allowed)),
                model.placeOf(object.feature));
    }
}

namespace {

// One note for all objects, with the share of the first three.
void reportLostFaces(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                     std::span<const voxelize::LostShare> lostFaces, Diagnostics& log) {
    constexpr std::size_t kShown = 3;
    if (lostFaces.empty()) return;
    std::string objects;
    for (std::size_t n = 0; n < std::min(kShown, lostFaces.size()); ++n) {
        const double share = lostFaces[n].share;
        objects += fmt::format("{}'{}' ({:.{}f} %)", n == 0 ? "" : ", ",
                               model.features[meshes.objects[lostFaces[n].object].feature].id, 100 * share,
                               share < 0.01 ? 1 : 0);
    }
    if (lostFaces.size() > kShown) objects += fmt::format(" and {} others", lostFaces.size() - kShown);
    Place place{model.source, 0, 0, {}};
    if (lostFaces.size() == 1) place = model.placeOf(meshes.objects[lostFaces.front().object].feature);
    log.add(Severity::Note, Code::WindingFilled,
            fmt::format("the filling by winding number leaves out parts of the surface of {} object{}: {}; "
                        "there, voxels draw the faces, and no volume counts them",
                        lostFaces.size(), lostFaces.size() == 1 ? "" : "s", objects),
            std::move(place));
}

}  // namespace

void reportBounds(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                  const voxelize::VoxelizeResult& voxels, Diagnostics& log) {
    for (const std::uint32_t o : voxels.unfilled) {
        log.add(
            Severity::Warning, Code::WindingFilled,
            fmt::format("its {} open edges are too many for winding numbers; it is kept as a surface without inside",
                        meshes.objects[o].openEdges.size()),
            model.placeOf(meshes.objects[o].feature));
    }
    reportLostFaces(model, meshes, voxels.lostFaces, log);
    if (voxels.crowdedVoxels != 0)
        log.add(Severity::Warning, Code::Overlap,
                fmt::format("{} voxels are claimed by more than 16 solids each; of these only overlaps with the first "
                            "16 are counted",
                            voxels.crowdedVoxels),
                {model.source, 0, 0, {}});
}

}  // namespace svt::pipeline
