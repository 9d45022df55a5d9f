#include <svt/pipeline/build_volume.hpp>

#include <svt/pipeline/stages/huge_objects.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::pipeline {
namespace {

// The axes after quarter turns about z, so that x and y are within 45 degrees of east and north.
std::array<Vec3d, 3> leastTurned(std::array<Vec3d, 3> axes) {
    for (int turns = 0; turns < 4 && !(axes[0].x > 0 && std::abs(axes[0].y) <= axes[0].x); ++turns)
        axes = {axes[1], -axes[0], axes[2]};
    return axes;
}

// The boxes of all objects along `axes`. \param origin  of the coordinates, relative to MeshSet::origin
std::vector<Box3d> boxesOf(const mesh::MeshSet& meshes, const std::array<Vec3d, 3>& axes, Vec3d origin) {
    std::vector<Box3d> boxes;
    boxes.reserve(meshes.objects.size());
    for (const mesh::ObjectMesh& object : meshes.objects) {
        Box3d& box = boxes.emplace_back();
        for (const Vec3d& vertex : object.vertices)
            box.add(Vec3d{dot(vertex, axes[0]), dot(vertex, axes[1]), dot(vertex, axes[2])} + origin);
    }
    return boxes;
}

// The default spacing of a model, and the box of its grid. Huge objects do not decide the spacing if it were ten times as
// coarse with them.
// \param box     of all objects, along `axes`; becomes that of the other objects
// \param origin  of the box's coordinates, relative to MeshSet::origin
SpacingChoice chooseDefault(const mesh::MeshSet& meshes, const std::array<Vec3d, 3>& axes, Vec3d origin,
                            std::uint64_t memoryBytes, Box3d& box) {
    constexpr double kCoarser = 10;
    double area = 0;
    for (const mesh::ObjectMesh& object : meshes.objects) area += object.area;
    const std::vector<Box3d> boxes = boxesOf(meshes, axes, origin);
    SpacingChoice all = chooseSpacing(box.size(), area, memoryBytes, occupiedShare(box, boxes));
    const auto core = coreOf(meshes, boxes);
    if (!core) return all;
    SpacingChoice finer = chooseSpacing(core->box.size(), core->area, memoryBytes);
    if (finer.spacing * kCoarser > all.spacing * (1 + 1e-9)) return all;
    finer.reason += fmt::format("; {} m with {} that {} larger than all others together", all.spacing,
                                core->huge.size() == 1 ? "one object" : fmt::format("{} objects", core->huge.size()),
                                core->huge.size() == 1 ? "is" : "are");
    finer.cutObjects = core->huge;
    finer.spacingOfAll = all.spacing;
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::max(box.min[axis], core->box.min[axis]);
        box.max[axis] = std::min(box.max[axis], core->box.max[axis]);
    }
    return finer;
}

// The samples of an endless grid that cover all objects. Huge objects reach no further than the given grid and the other
// objects.
Result<volume::Grid> extendGrid(const mesh::MeshSet& meshes, const volume::Grid& grid) {
    const std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    Box3d box;
    for (const mesh::ObjectMesh& object : meshes.objects)
        for (const Vec3d& vertex : object.vertices) box.add(grid.indexFromWorld(vertex + meshes.origin));
    if (const auto core = coreOf(meshes, boxesOf(meshes, axes, meshes.origin))) {
        Box3d most{{0, 0, 0}, toDouble(grid.dimension() - Vec3i{1, 1, 1})};
        for (int corner = 0; corner < 8; ++corner)
            most.add(grid.indexFromWorld({corner & 1 ? core->box.max.x : core->box.min.x,
                                          corner & 2 ? core->box.max.y : core->box.min.y,
                                          corner & 4 ? core->box.max.z : core->box.min.z}));
        for (int axis = 0; axis < 3; ++axis) {
            box.min[axis] = std::max(box.min[axis], most.min[axis]);
            box.max[axis] = std::min(box.max[axis], most.max[axis]);
        }
    }
    if (box.isEmpty()) return grid;
    Vec3d first{};
    Vec3i dimension{};
    for (int axis = 0; axis < 3; ++axis) {
        constexpr double kRounding = 1e-6;  // of a voxel
        first[axis] = std::floor(box.min[axis] + kRounding);
        const double count = std::max(2.0, std::ceil(box.max[axis] - kRounding) - first[axis] + 1);
        dimension[axis] = static_cast<std::int32_t>(std::min(count, 1e9));
    }
    return volume::Grid::fromParts(dimension, grid.spacing(), grid.worldFromIndex(first), grid.axes());
}

}  // namespace

Result<volume::Grid> chooseGrid(const mesh::MeshSet& meshes, const BuildOptions& options,
                                std::optional<SpacingChoice>* choice) {
    if (options.grid) return options.extendsGrid ? extendGrid(meshes, *options.grid) : *options.grid;
    Box3d box;
    std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    if (options.axes == AxesKind::Building) {
        // All objects together, to find their dominant direction.
        mesh::ObjectMesh all;
        for (const mesh::ObjectMesh& object : meshes.objects) {
            const auto first = static_cast<std::uint32_t>(all.vertices.size());
            all.vertices.insert(all.vertices.end(), object.vertices.begin(), object.vertices.end());
            for (mesh::Triangle triangle : object.triangles) {
                for (std::uint32_t& corner : triangle.corners) corner += first;
                all.triangles.push_back(triangle);
            }
        }
        axes = leastTurned(voxelize::dominantAxes(all).directions);
        for (const Vec3d& vertex : all.vertices)
            box.add(Vec3d{dot(vertex, axes[0]), dot(vertex, axes[1]), dot(vertex, axes[2])});
    } else {
        box.min = meshes.bounds.min + meshes.origin;
        box.max = meshes.bounds.max + meshes.origin;
    }
    Vec3d spacing = options.spacing.value_or(Vec3d{});
    if (!options.dimension && !options.spacing) {
        const Vec3d origin = options.axes == AxesKind::Building ? Vec3d{} : meshes.origin;
        SpacingChoice chosen = chooseDefault(meshes, axes, origin, options.memoryBytes, box);
        spacing = {chosen.spacing, chosen.spacing, chosen.spacing};
        if (choice != nullptr) *choice = std::move(chosen);
    }
    auto grid = options.dimension ? volume::Grid::fromDimension(box, *options.dimension)
                                  : volume::Grid::fromSpacing(box, spacing);
    if (grid && options.axes == AxesKind::Building) return grid->turned(axes, meshes.origin);
    return grid;
}

}  // namespace svt::pipeline
