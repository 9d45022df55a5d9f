#include <svt/core/parallel.hpp>
#include <svt/render/prepare/visible_hull.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

namespace svt::render {
namespace {

using volume::BrickVolume;

constexpr std::size_t kSlabs = VisibleHull::kSlabs, kFixed = 13, kOfPlanes = kSlabs - kFixed;
// Widening of the slabs: far above rounding errors, also in single precision.
constexpr double kSlabMargin = 0.25;  // voxels

// Directions of the fixed slabs: the axes and their diagonals.
constexpr std::array<Vec3d, kFixed> kDirections{{{1, 0, 0},
                                                 {0, 1, 0},
                                                 {0, 0, 1},
                                                 {1, 1, 0},
                                                 {1, -1, 0},
                                                 {1, 0, 1},
                                                 {1, 0, -1},
                                                 {0, 1, 1},
                                                 {0, 1, -1},
                                                 {1, 1, 1},
                                                 {1, 1, -1},
                                                 {1, -1, 1},
                                                 {1, -1, -1}}};

std::size_t sideCount(const BrickVolume::BoxCoding& code) noexcept {
    std::size_t count = 0;
    code.forEachSide([&](int, std::uint16_t) { ++count; }, [&](std::uint32_t) { ++count; });
    return count;
}

// The most frequent plane normals, by number of coded boxes; nearly parallel ones count together.
std::vector<Vec3d> directionsOfPlanes(const BrickVolume::Arrays& volume) {
    struct Direction {
        Vec3d normal;
        std::size_t boxes;
    };
    constexpr double kSame = 0.999;  // cosine; 2.6 degrees
    std::vector<std::size_t> boxesOf(volume.planes.size());
    for (const BrickVolume::BoxCoding& code : volume.codes)
        for (const std::uint32_t plane : code.plane)
            if (plane != BrickVolume::kNoPlane) ++boxesOf[plane];
    std::vector<Direction> found;
    for (std::size_t plane = 0; plane < boxesOf.size(); ++plane) {
        const Vec3d normal = normalized(volume.planes[plane].normal);
        const auto same = std::find_if(found.begin(), found.end(), [&](const Direction& other) {
            return std::abs(dot(other.normal, normal)) > kSame;
        });
        if (same == found.end())
            found.push_back({normal, boxesOf[plane]});
        else
            same->boxes += boxesOf[plane];
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Direction& a, const Direction& b) { return a.boxes > b.boxes; });
    std::vector<Vec3d> directions;
    for (std::size_t n = 0; n < std::min(found.size(), kOfPlanes); ++n) directions.push_back(found[n].normal);
    return directions;
}

// By index entry: whether the brick has a visible label.
std::vector<std::uint8_t> findVisible(const BrickVolume::Arrays& volume, const PassTable& table) {
    const auto isAny = [&](std::size_t first, std::size_t count) {
        const auto scalars = volume.palettes.subspan(first, count);
        return std::any_of(scalars.begin(), scalars.end(),
                           [&](volume::Scalar scalar) { return table[scalar].kind != LinearStyle::Kind::Hidden; });
    };
    std::vector<std::uint8_t> visible;
    visible.reserve(volume.boxes.size() + volume.bricks.size());
    for (std::size_t box = 0; box < volume.uniformBoxes; ++box)
        visible.push_back(table[volume.boxes[box].scalar].kind != LinearStyle::Kind::Hidden);
    for (std::size_t box = volume.uniformBoxes; box < volume.boxes.size(); ++box) {
        const BrickVolume::BoxCoding& code = volume.codes[volume.boxes[box].scalar];
        visible.push_back(isAny(code.firstSideScalar, std::size_t{1} << sideCount(code)));
    }
    for (const BrickVolume::PaletteBrick& brick : volume.bricks)
        visible.push_back(isAny(brick.palette, brick.paletteSize));
    return visible;
}

// Slabs as a structure of arrays, so that the compiler can vectorize.
struct Extents {
    std::array<float, kSlabs> x{}, y{}, z{}, low, high;

    explicit Extents(std::span<const Vec3d> directions) {
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (std::size_t n = 0; n < directions.size(); ++n) {
            x[n] = static_cast<float>(directions[n].x);
            y[n] = static_cast<float>(directions[n].y);
            z[n] = static_cast<float>(directions[n].z);
        }
    }
    // Extends the slabs by bricks [begin, end) of row (by, bz).
    void include(std::int32_t begin, std::int32_t end, std::int32_t by, std::int32_t bz) noexcept {
        const auto x0 = static_cast<float>(8 * begin), x1 = static_cast<float>(8 * end);
        const auto y0 = static_cast<float>(8 * by), z0 = static_cast<float>(8 * bz);
        for (std::size_t n = 0; n < kSlabs; ++n) {
            const float alongX0 = x[n] * x0, alongX1 = x[n] * x1;
            const float alongY0 = y[n] * y0, alongY1 = y[n] * (y0 + 8);
            const float alongZ0 = z[n] * z0, alongZ1 = z[n] * (z0 + 8);
            low[n] =
                std::min(low[n], std::min(alongX0, alongX1) + std::min(alongY0, alongY1) + std::min(alongZ0, alongZ1));
            high[n] =
                std::max(high[n], std::max(alongX0, alongX1) + std::max(alongY0, alongY1) + std::max(alongZ0, alongZ1));
        }
    }
    void include(const Extents& other) noexcept {
        for (std::size_t n = 0; n < kSlabs; ++n) {
            low[n] = std::min(low[n], other.low[n]);
            high[n] = std::max(high[n], other.high[n]);
        }
    }
};

}  // namespace

VisibleHull::VisibleHull(const BrickVolume& volume, const PassTable& table, const CameraRays& rays, int threads) {
    const BrickVolume::Arrays arrays = volume.arrays();
    std::vector<Vec3d> directions(kDirections.begin(), kDirections.end());
    for (const Vec3d& direction : directionsOfPlanes(arrays)) directions.push_back(direction);
    const std::vector<std::uint8_t> visible = findVisible(arrays, table);
    const Vec3i count = volume.brickCount();
    // Finds the first visible brick of row (y, z) from either end; hidden same-label boxes are skipped at once.
    const auto find = [&](std::int32_t y, std::int32_t z, std::int32_t from, std::int32_t end, std::int32_t step) {
        std::int32_t x = from;
        while ((end - x) * step > 0) {
            const std::size_t entry = arrays.entry(x, y, z);
            if (visible[entry] != 0) break;
            if (entry >= arrays.uniformBoxes)
                x += step;
            else
                x = step > 0 ? (arrays.boxes[entry].max[0] + 7) / 8 : arrays.boxes[entry].min[0] / 8 - 1;
        }
        return x;
    };
    Extents extents(directions);
    std::mutex mutex;
    parallelFor(static_cast<std::size_t>(count.z), 8, threads, [&](std::size_t begin, std::size_t end) {
        Extents part(directions);
        for (std::size_t z = begin; z < end; ++z)
            for (std::int32_t y = 0; y < count.y; ++y) {
                const auto row = static_cast<std::int32_t>(z);
                const std::int32_t first = find(y, row, 0, count.x, 1);
                if (first >= count.x) continue;
                part.include(first, find(y, row, count.x - 1, -1, -1) + 1, y, row);
            }
        const std::scoped_lock lock(mutex);
        extents.include(part);
    });
    if (extents.low[0] > extents.high[0]) return;
    isEmpty_ = false;
    const CameraRays::Basis basis = rays.basis();
    const Vec3d right = basis.rightVoxel * basis.halfWidth, up = basis.upVoxel * basis.halfHeight;
    for (std::size_t n = 0; n < directions.size(); ++n) {
        // The directions as rounded to float.
        const Vec3d along{double(extents.x[n]), double(extents.y[n]), double(extents.z[n])};
        rise_.middle[n] = dot(along, basis.forwardVoxel);
        height_.middle[n] = dot(along, basis.eyeVoxel);
        Linear& moved = rays.isPerspective() ? rise_ : height_;
        moved.byU[n] = dot(along, right);
        moved.byV[n] = dot(along, up);
        low_[n] = double(extents.low[n]) - kSlabMargin;
        high_[n] = double(extents.high[n]) + kSlabMargin;
    }
}

RaySpan VisibleHull::spanOf(const ViewRect& rect) const noexcept {
    if (isEmpty_) return {0, 0};
    const double u = (rect.left + rect.right) / 2, v = (rect.low + rect.high) / 2;
    const double halfU = (rect.right - rect.left) / 2, halfV = (rect.high - rect.low) / 2;
    double from = 0, to = kInfinity;
    for (std::size_t n = 0; n < kSlabs; ++n) {
        const auto middle = [&](const Linear& of) { return of.middle[n] + of.byU[n] * u + of.byV[n] * v; };
        const auto reach = [&](const Linear& of) { return std::abs(of.byU[n]) * halfU + std::abs(of.byV[n]) * halfV; };
        const double rise = middle(rise_), slowest = rise - reach(rise_), fastest = rise + reach(rise_);
        const double height = middle(height_);
        // Distance from the highest start up to the slab, and from the lowest start up to the slab's far side.
        const double below = low_[n] - (height + reach(height_)), above = high_[n] - (height - reach(height_));
        // If all rays start on one side of the slab, the fastest one reaches it first; never, if none moves towards it.
        const double upTo = fastest > 0 ? below / fastest : kInfinity;
        const double downTo = slowest < 0 ? above / slowest : kInfinity;
        from = std::max(from, std::max(below > 0 ? upTo : 0, above < 0 ? downTo : 0));
        // If all rays move in one direction, the slowest one leaves the slab last; otherwise some ray may stay inside.
        to = std::min(to, slowest > 0 ? above / slowest : fastest < 0 ? below / fastest : kInfinity);
    }
    return {from, to};
}

}  // namespace svt::render
