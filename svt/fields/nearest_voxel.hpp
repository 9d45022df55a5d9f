#pragma once
/// \file
/// The voxel of a place, or the nearest one of a kind near it.

#include <svt/core/vec.hpp>
#include <svt/volume/grid.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace svt::fields {

/// A sensor in no room, such as one on a wall, belongs to the nearest room within this distance.
inline constexpr double kWallReach = 0.25;  // metres

/// The voxel of a place if accepts(voxel), else the nearest such voxel within `reach` metres and 32 voxels; the first
/// by z, y, x of equally near ones.
/// \param index  of the place, index space
template <class Accepts>
[[nodiscard]] std::optional<Vec3i> nearestVoxel(const volume::Grid& grid, Vec3d index, double reach,
                                                const Accepts& accepts) {
    const Vec3i n = grid.dimension();
    const Vec3d spacing = grid.spacing();
    Vec3i voxel, low, high;
    bool isInside = true;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(index[axis] > -1e6 && index[axis] < 1e6)) return std::nullopt;
        voxel[axis] = static_cast<std::int32_t>(std::floor(index[axis] + 0.5));
        isInside = isInside && voxel[axis] >= 0 && voxel[axis] < n[axis];
        const auto voxels = static_cast<std::int32_t>(std::min(reach / spacing[axis], 32.0));
        low[axis] = std::max(0, voxel[axis] - voxels);
        high[axis] = std::min(n[axis] - 1, voxel[axis] + voxels);
    }
    if (isInside && accepts(voxel)) return voxel;
    std::optional<Vec3i> best;
    double nearest = reach * reach;
    for (std::int32_t k = low.z; k <= high.z; ++k)
        for (std::int32_t j = low.y; j <= high.y; ++j)
            for (std::int32_t i = low.x; i <= high.x; ++i) {
                const Vec3d way = scaled(toDouble(Vec3i{i, j, k}) - index, spacing);
                if (!(dot(way, way) < nearest) || !accepts(Vec3i{i, j, k})) continue;
                best = Vec3i{i, j, k};
                nearest = dot(way, way);
            }
    return best;
}

}  // namespace svt::fields
