#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/point_samples.hpp>

#include <cmath>

namespace svt::volume {

void samplePoints(const ColumnVolume& columns, const Grid& grid, std::span<const Vec3d> points, std::span<Scalar> out,
                  int threads) {
    SVT_CHECK(columns.dimension() == grid.dimension());
    SVT_CHECK(points.size() == out.size());
    const Vec3i dimension = grid.dimension();
    constexpr std::size_t kGrain = 4096;
    parallelFor(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const Vec3d voxel = grid.indexFromWorld(points[p]) + Vec3d{0.5, 0.5, 0.5};
            // Also false for NaN. Points inside fit into an integer.
            const bool isInside = voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < dimension.x &&
                                  voxel.y < dimension.y && voxel.z < dimension.z;
            out[p] = isInside ? columns.scalarAt(static_cast<std::int32_t>(voxel.x), static_cast<std::int32_t>(voxel.y),
                                                 static_cast<std::int32_t>(voxel.z))
                              : 0;
        }
    });
}

}  // namespace svt::volume
