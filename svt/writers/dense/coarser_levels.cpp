#include <svt/writers/dense/coarser_levels.hpp>

#include <svt/volume/volume_part.hpp>

#include <algorithm>
#include <cstdint>

namespace svt::writers {

Result<std::vector<volume::SemanticVolume>> coarserLevels(const volume::SemanticVolume& volume, int threads) {
    constexpr std::int32_t kSmall = 64;
    constexpr int kMost = 6;
    const Vec3i dimension = volume.grid.dimension();
    int levels = 0;
    for (std::int32_t side = std::max({dimension.x, dimension.y, dimension.z}); side > kSmall && levels < kMost;
         side = (side + 1) / 2)
        ++levels;
    if (levels == 0) return std::vector<volume::SemanticVolume>{};
    return volume::coarseVolumes(volume, levels, threads);
}

}  // namespace svt::writers
