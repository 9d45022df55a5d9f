#include <svt/core/parallel.hpp>
#include <svt/writers/gltf/slope_vertices.hpp>
#include <svt/writers/gltf/surface_positions.hpp>

#include <optional>

namespace svt::writers {
namespace {

// Metres from the grid's lower corner along its axes.
Positions positionsOf(const LabelSurface& surface, Vec3d spacing, const SlopeVertices* slopes) {
    std::vector<Vec3d> places;
    places.reserve(surface.vertices.size());
    for (const Vec3i vertex : surface.vertices) places.push_back({0.5 * vertex.x, 0.5 * vertex.y, 0.5 * vertex.z});
    if (slopes != nullptr) {
        for (std::uint32_t c = 0; c < surface.cornerCount; ++c) {
            const Vec3i vertex = surface.vertices[c];
            places[c] = slopes->place({vertex.x / 2, vertex.y / 2, vertex.z / 2});
        }
        for (std::size_t m = 0; m < surface.middles.size(); ++m) {
            Vec3d sum{};
            for (const std::uint32_t corner : surface.middles[m]) sum = sum + places[corner];
            places[surface.cornerCount + m] = sum * 0.25;
        }
    }
    Positions positions;
    positions.reserve(places.size());
    for (const Vec3d place : places) {
        const Vec3d metres = scaled(place, spacing);
        positions.push_back({static_cast<float>(metres.x), static_cast<float>(metres.y), static_cast<float>(metres.z)});
    }
    return positions;
}

}  // namespace

Extent extentOf(const Positions& positions) noexcept {
    Vec3f min = positions.front(), max = min;
    for (const Vec3f position : positions)
        for (int axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], position[axis]);
            max[axis] = std::max(max[axis], position[axis]);
        }
    return {min, max};
}

Result<std::vector<Positions>> placeVertices(const volume::SemanticVolume& volume,
                                             std::span<const LabelSurface> surfaces, GlbFaces faces,
                                             const volume::SemanticVolume* planesOf, int threads,
                                             const Progress* told) {
    const volume::SemanticVolume& source = planesOf != nullptr ? *planesOf : volume;
    const std::vector<std::uint32_t> labelOfScalar = source.labels.labelOfScalar();
    volume::BrickVolume bricks;
    std::optional<SlopeVertices> slopes;
    if (faces != GlbFaces::Voxels && !surfaces.empty()) {
        SVT_TRY(made, volume::BrickVolume::fromColumns(source.columns, {.planes = source.planes, .threads = threads}));
        bricks = std::move(*made);
        slopes.emplace(bricks, labelOfScalar);
    }
    std::vector<Positions> positions(surfaces.size());
    std::uint64_t count = 0;
    for (const LabelSurface& surface : surfaces) count += surface.vertices.size();
    ProgressCounter progress(told, "vertices", count);
    parallelFor(surfaces.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            positions[m] = positionsOf(surfaces[m], volume.grid.spacing(), slopes ? &*slopes : nullptr);
            progress.add(surfaces[m].vertices.size());
        }
    });
    return positions;
}

}  // namespace svt::writers
