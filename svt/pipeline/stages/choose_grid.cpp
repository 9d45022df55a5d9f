#include <svt/pipeline/build_volume.hpp>

namespace svt::pipeline {

Result<volume::Grid> chooseGrid(const mesh::MeshSet& meshes, const BuildOptions& options,
                                std::optional<SpacingChoice>* choice) {
    if (options.grid) return *options.grid;
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
        axes = voxelize::dominantAxes(all).directions;
        for (const Vec3d& vertex : all.vertices)
            box.add(Vec3d{dot(vertex, axes[0]), dot(vertex, axes[1]), dot(vertex, axes[2])});
    } else {
        box.min = meshes.bounds.min + meshes.origin;
        box.max = meshes.bounds.max + meshes.origin;
    }
    Vec3d spacing = options.spacing.value_or(Vec3d{});
    if (!options.dimension && !options.spacing) {
        double area = 0;
        for (const mesh::ObjectMesh& object : meshes.objects) area += object.area;
        SpacingChoice chosen = chooseSpacing(box.size(), area, options.memoryBytes);
        spacing = {chosen.spacing, chosen.spacing, chosen.spacing};
        if (choice != nullptr) *choice = std::move(chosen);
    }
    auto grid = options.dimension ? volume::Grid::fromDimension(box, *options.dimension)
                                  : volume::Grid::fromSpacing(box, spacing);
    if (grid && options.axes == AxesKind::Building) return grid->turned(axes, meshes.origin);
    return grid;
}

}  // namespace svt::pipeline
