#include <svt/core/parallel.hpp>
#include <svt/render/occlusion.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace svt::render {
namespace {

// One tap per level, a cell's size away from the surface: near enough to see the corner, far enough that a plane does
// not see itself through the filter. Nearer blocks count more.
constexpr std::array<float, 4> kWeights{0.30f, 0.30f, 0.24f, 0.16f};
// A wall beside the surface covers about half of what a tap sees.
constexpr float kFull = 0.55f;

std::size_t at(Vec3i count, std::int32_t x, std::int32_t y, std::int32_t z) noexcept {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(count.x) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(count.y) * static_cast<std::size_t>(z));
}

}  // namespace

OcclusionField::OcclusionField(const volume::BrickVolume& volume, const std::function<bool(volume::Scalar)>& isOpaque,
                               const Clipper& clipper, int threads) {
    // Once per distinct brick, then once per brick.
    std::vector<float> ofPaletteBrick(volume.paletteBrickCount());
    parallelFor(ofPaletteBrick.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            int voxels = 0;
            volume::BrickVolume::MaskWords scratch;
            const auto mask = volume.voxelMask(volume::BrickVolume::paletteBrickEntry(n), isOpaque, scratch);
            for (std::size_t k = 0; k < 8; ++k) voxels += std::popcount(mask.word(k));
            ofPaletteBrick[n] = static_cast<float>(voxels) / 512;
        }
    });
    std::vector<float> ofBox(volume.boxes().size());
    for (std::size_t n = 0; n < ofBox.size(); ++n) ofBox[n] = isOpaque(volume.boxes()[n].scalar) ? 1.0f : 0.0f;

    Level level;
    level.count = volume.brickCount();
    level.coverage.resize(static_cast<std::size_t>(level.count.x) * static_cast<std::size_t>(level.count.y) *
                          static_cast<std::size_t>(level.count.z));
    parallelFor(static_cast<std::size_t>(level.count.z), 4, threads, [&](std::size_t begin, std::size_t end) {
        for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z)
            for (std::int32_t y = 0; y < level.count.y; ++y)
                for (std::int32_t x = 0; x < level.count.x; ++x) {
                    const auto entry = volume.entry(x, y, z);
                    float coverage = entry.isMixed() ? ofPaletteBrick[volume.paletteBrickNumber(entry)]
                                                     : ofBox[volume.boxNumber(entry)];
                    if (coverage > 0 && !clipper.isEmpty() && !clipper.keeps({8.0 * x + 4, 8.0 * y + 4, 8.0 * z + 4}))
                        coverage = 0;
                    level.coverage[at(level.count, x, y, z)] = coverage;
                }
    });
    levels_.push_back(std::move(level));
    while (levels_.size() < kWeights.size()) levels_.push_back(halved(levels_.back()));
}

OcclusionField::Level OcclusionField::halved(const Level& fine) {
    Level level;
    for (int axis = 0; axis < 3; ++axis) level.count[axis] = (fine.count[axis] + 1) / 2;
    level.cellSize = 2 * fine.cellSize;
    level.coverage.resize(static_cast<std::size_t>(level.count.x) * static_cast<std::size_t>(level.count.y) *
                          static_cast<std::size_t>(level.count.z));
    for (std::int32_t z = 0; z < level.count.z; ++z)
        for (std::int32_t y = 0; y < level.count.y; ++y)
            for (std::int32_t x = 0; x < level.count.x; ++x) {
                float sum = 0;
                for (std::int32_t c = 0; c < 8; ++c) {
                    const Vec3i f{2 * x + (c & 1), 2 * y + ((c >> 1) & 1), 2 * z + (c >> 2)};
                    if (f.x < fine.count.x && f.y < fine.count.y && f.z < fine.count.z)
                        sum += fine.coverage[at(fine.count, f.x, f.y, f.z)];
                }
                level.coverage[at(level.count, x, y, z)] = sum / 8;
            }
    return level;
}

float OcclusionField::Level::sample(Vec3f point) const noexcept {
    std::int32_t cell[3];
    float f[3];
    bool isInside = true;
    const float perVoxel = 1 / cellSize;  // a power of two
    for (int axis = 0; axis < 3; ++axis) {
        const float p = point[axis] * perVoxel + 0.5f;  // 1 more than the place among the cells' middles
        if (!(p > 0 && p < static_cast<float>(count[axis] + 1))) return 0;
        const auto low = static_cast<std::int32_t>(p);
        cell[axis] = low - 1;
        f[axis] = p - static_cast<float>(low);
        isInside = isInside && low > 0 && low < count[axis];
    }
    const auto along = [](float a, float b, float s) { return a + (b - a) * s; };
    const auto blend = [&](const auto& value) {
        const float low =
            along(along(value(0, 0, 0), value(1, 0, 0), f[0]), along(value(0, 1, 0), value(1, 1, 0), f[0]), f[1]);
        const float high =
            along(along(value(0, 0, 1), value(1, 0, 1), f[0]), along(value(0, 1, 1), value(1, 1, 1), f[0]), f[1]);
        return along(low, high, f[2]);
    };
    if (isInside) {
        const float* corner = coverage.data() + at(count, cell[0], cell[1], cell[2]);
        const std::size_t nextY = at(count, 0, 1, 0), nextZ = at(count, 0, 0, 1);
        return blend(
            [&](std::size_t dx, std::size_t dy, std::size_t dz) { return corner[dx + dy * nextY + dz * nextZ]; });
    }
    return blend([&](std::int32_t dx, std::int32_t dy, std::int32_t dz) {
        const std::int32_t x = cell[0] + dx, y = cell[1] + dy, z = cell[2] + dz;
        if (x < 0 || y < 0 || z < 0 || x >= count.x || y >= count.y || z >= count.z) return 0.0f;
        return coverage[at(count, x, y, z)];
    });
}

float OcclusionField::occlusion(Vec3f point, Vec3f direction) const noexcept {
    float sum = 0;
    for (std::size_t n = 0; n < levels_.size(); ++n) {
        const Level& level = levels_[n];
        sum += kWeights[n] * std::min(1.0f, level.sample(point + direction * level.cellSize) / kFull);
    }
    return sum;
}

}  // namespace svt::render
