#include <svt/core/parallel.hpp>
#include <svt/render/occlusion.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace svt::render {
namespace {

// One tap per level, one cell away from the surface: close enough for the tap to include the corner, far enough that a
// flat surface does not occlude itself through the trilinear filter. Closer levels weigh more.
constexpr std::array<double, OcclusionField::kLevels> kWeights{0.30, 0.30, 0.24, 0.16};
// Coverage that counts as full occlusion: a wall next to the surface covers about half of a tap.
constexpr double kFull = 0.55;

OcclusionField::Level emptyLevel(Vec3i count, double cellSize, double weight) {
    OcclusionField::Level level{count, cellSize, 1 / (kFull * cellSize * cellSize * cellSize), weight, {}};
    level.voxels.resize(level.at(count.x, count.y, count.z) + 2);
    return level;
}

// Log2 of the bricks per block along each axis.
int blockShift(double voxelSize) noexcept {
    constexpr double kWidest = 0.2;  // metres
    int shift = 0;
    while (shift < 6 && voxelSize * (16 << shift) <= kWidest) ++shift;
    return shift;
}

}  // namespace

OcclusionField::OcclusionField(const volume::BrickVolume& volume, double voxelSize,
                               const std::function<bool(volume::Scalar)>& isOpaque, const Clipper& clipper,
                               int threads) {
    // Count once per distinct palette brick, then sum once per brick.
    std::vector<std::uint32_t> ofPaletteBrick(volume.paletteBrickCount());
    parallelFor(ofPaletteBrick.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            int voxels = 0;
            volume::BrickVolume::MaskWords scratch;
            const auto mask = volume.voxelMask(volume::BrickVolume::paletteBrickEntry(n), isOpaque, scratch);
            for (std::size_t k = 0; k < 8; ++k) voxels += std::popcount(mask.word(k));
            ofPaletteBrick[n] = static_cast<std::uint32_t>(voxels);
        }
    });
    std::vector<std::uint32_t> ofBox(volume.boxes().size());
    for (std::size_t n = 0; n < ofBox.size(); ++n) ofBox[n] = isOpaque(volume.boxes()[n].scalar) ? 512 : 0;

    const int shift = blockShift(voxelSize);
    const double size = 8 << shift;
    const auto blocks = [&](std::int32_t bricks) { return (bricks + (1 << shift) - 1) >> shift; };
    const Vec3i bricks = volume.brickCount();
    Level level = emptyLevel({blocks(bricks.x), blocks(bricks.y), blocks(bricks.z)}, size, kWeights[0]);
    parallelFor(static_cast<std::size_t>(level.count.z), 1, threads, [&](std::size_t begin, std::size_t end) {
        const auto last = std::min(static_cast<std::int32_t>(end) << shift, bricks.z);
        for (std::int32_t z = static_cast<std::int32_t>(begin) << shift; z < last; ++z)
            for (std::int32_t y = 0; y < bricks.y; ++y) {
                std::uint32_t* row = &level.voxels[level.at(0, y >> shift, z >> shift)];
                volume.forRow(
                    y, z,
                    [&](std::int32_t first, std::int32_t behind, std::size_t box) {
                        if (ofBox[box] == 0) return;
                        for (std::int32_t x = first; x < behind; ++x) row[x >> shift] += ofBox[box];
                    },
                    [&](std::int32_t x, std::size_t number) { row[x >> shift] += ofPaletteBrick[number]; });
            }
        if (clipper.isEmpty()) return;
        for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z)
            for (std::int32_t y = 0; y < level.count.y; ++y)
                for (std::int32_t x = 0; x < level.count.x; ++x) {
                    std::uint32_t& voxels = level.voxels[level.at(x, y, z)];
                    if (voxels > 0 && !clipper.keeps({size * (x + 0.5), size * (y + 0.5), size * (z + 0.5)}))
                        voxels = 0;
                }
    });
    levels_.push_back(std::move(level));
    while (levels_.size() < kLevels) levels_.push_back(halved(levels_.back()));
    for (std::size_t n = 0; n < kLevels; ++n) levels_[n].weight = kWeights[n];
}

OcclusionField::Level OcclusionField::halved(const Level& fine) {
    const Vec3i count{(fine.count.x + 1) / 2, (fine.count.y + 1) / 2, (fine.count.z + 1) / 2};
    Level level = emptyLevel(count, 2 * fine.cellSize, 0);
    for (std::int32_t z = 0; z < count.z; ++z)
        for (std::int32_t y = 0; y < count.y; ++y) {
            std::uint32_t* to = &level.voxels[level.at(0, y, z)];
            for (std::int32_t c = 0; c < 4; ++c) {  // if the count is odd, the second block at the end is the padding
                const std::uint32_t* from = &fine.voxels[fine.at(0, 2 * y + (c & 1), 2 * z + (c >> 1))];
                for (std::int32_t x = 0; x < count.x; ++x) to[x] += from[2 * x] + from[2 * x + 1];
            }
        }
    return level;
}

double OcclusionField::Level::sample(Vec3d point) const noexcept {
    const double perVoxel = 1 / cellSize;  // a power of two
    Vec3d f;
    Vec3i low;
    for (int axis = 0; axis < 3; ++axis) {
        const double p = point[axis] * perVoxel + 0.5;  // 1 more than the position relative to the first block's centre
        if (!(p > 0 && p < count[axis] + 1)) return 0;
        low[axis] = static_cast<std::int32_t>(p);
        f[axis] = p - low[axis];
    }
    const std::uint32_t* corner = voxels.data() + at(low.x - 1, low.y - 1, low.z - 1);
    const std::size_t nextY = static_cast<std::size_t>(count.x) + 2,
                      nextZ = nextY * (static_cast<std::size_t>(count.y) + 2);
    const auto along = [](double a, double b, double s) { return a + (b - a) * s; };
    const auto row = [&](std::size_t first) { return along(corner[first], corner[first + 1], f.x); };
    return along(along(row(0), row(nextY), f.y), along(row(nextZ), row(nextZ + nextY), f.y), f.z);
}

double OcclusionField::occlusion(Vec3d point, Vec3d direction) const noexcept {
    double sum = 0;
    for (const Level& level : levels_)
        sum += level.weight * std::min(1.0, level.sample(point + direction * level.cellSize) * level.gain);
    return sum;
}

}  // namespace svt::render
