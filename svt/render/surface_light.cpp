#include <svt/render/surface_light.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace svt::render {
namespace {

int longestAxis(Vec3d v) noexcept {
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

Vec3d toDouble(Vec3f v) noexcept { return {v.x, v.y, v.z}; }

using Words = volume::BrickVolume::MaskWords;

// The voxels of a brick below coordinate n along an axis, n from 0 to 8.
constexpr std::array<std::array<Words, 9>, 3> makeBelow() {
    std::array<std::array<Words, 9>, 3> below{};
    for (std::size_t n = 0; n <= 8; ++n)
        for (std::size_t k = 0; k < 8; ++k) {
            below[0][n][k] = 0x0101010101010101ull * (0xFFull >> (8 - n));
            below[1][n][k] = n == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * n)) - 1;
            below[2][n][k] = k < n ? ~std::uint64_t{0} : 0;
        }
    return below;
}
constexpr auto kBelow = makeBelow();

const Words& below(int axis, std::int32_t n) noexcept {
    return kBelow[static_cast<std::size_t>(axis)][static_cast<std::size_t>(std::clamp(n, 0, 8))];
}

// Of the bricks around a brick, x fastest, the voxels at most 3 away from it.
constexpr std::array<Words, 27> makeNear() {
    std::array<Words, 27> near{};
    for (int n = 0; n < 27; ++n) {
        const int away[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        Words words{};
        for (std::size_t k = 0; k < 8; ++k) {
            words[k] = ~std::uint64_t{0};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (away[axis] < 0) words[k] &= ~kBelow[axis][5][k];
                if (away[axis] > 0) words[k] &= kBelow[axis][3][k];
            }
        }
        near[static_cast<std::size_t>(n)] = words;
    }
    return near;
}
constexpr auto kNear = makeNear();

// Do two planes of the same direction hardly differ in a brick?
bool isLike(const volume::BrickPlane& plane, const volume::BrickPlane& other, Vec3i brick) noexcept {
    const Vec3d middle{8.0 * brick.x + 4, 8.0 * brick.y + 4, 8.0 * brick.z + 4};
    return dot(plane.normal, other.normal) > 0.998 &&
           std::abs(dot(plane.normal, middle) + plane.offset - dot(other.normal, middle) - other.offset) < 0.5;
}

std::uint64_t part(std::int32_t c, int shift) noexcept { return static_cast<std::uint64_t>(c) << shift; }

}  // namespace

DirectionTable::DirectionTable(const volume::BrickVolume& volume, const volume::Grid& grid) : grid_(grid) {
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d index{};
        index[axis] = 1;
        axes_[static_cast<std::size_t>(axis)] = directions(index);
    }
    planes_.reserve(volume.oblique().size());
    for (const volume::BrickPlane& plane : volume.oblique()) planes_.push_back(directions(plane.normal));
}

DirectionTable::Directions DirectionTable::directions(Vec3d index) const noexcept {
    Directions found;
    Vec3d normal{};
    for (int axis = 0; axis < 3; ++axis)
        normal = normal + grid_.axes()[static_cast<std::size_t>(axis)] * (index[axis] / grid_.spacing()[axis]);
    found.normal = normalized(normal);
    found.away = grid_.indexFromWorldDirection(found.normal);
    const double longest = std::max({std::abs(found.away.x), std::abs(found.away.y), std::abs(found.away.z)});
    if (longest > 0) found.away = found.away / longest;
    return found;
}

Surface SurfaceLight::at(const LinearStyle& style, const SurfaceHit& hit) const {
    if (hit.capPlane != nullptr) {
        Vec3d normal = normalized(hit.capPlane->normal);
        if (dot(normal, hit.view) < 0) normal = -normal;
        double open = 1;
        if (style.isBody && scene_.spec.light.ambientOcclusion > 0) {
            Vec3d away = scene_.grid.indexFromWorldDirection(normal);
            const double longest = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
            if (longest > 0) away = away / longest;
            open = openness(hit, away, SurfaceNormal::kPlaneCoverage);
        }
        return {normal, lightOn(normal, hit.view, open), true};
    }
    const bool isOblique = hit.plane != volume::BrickVolume::kNoPlane;
    if (!isOblique && hit.axis < 0) return {hit.view, lightOn(hit.view, hit.view, 1), false};  // the eye is inside
    if (style.isBody) return bodyAt(hit);
    const bool isAway = isOblique ? dot(scene_.volume.oblique()[hit.plane].normal, hit.direction) > 0
                                  : hit.direction[hit.axis] > 0;
    Vec3d normal = isOblique ? scene_.directions.plane(hit.plane).normal : scene_.directions.axis(hit.axis).normal;
    if (isAway) normal = -normal;
    return {normal, lightOn(normal, hit.view, 1), false};
}

Surface SurfaceLight::bodyAt(const SurfaceHit& hit) const {
    DirectionTable::Directions directions;
    float coverage = SurfaceNormal::kPlaneCoverage;
    bool isAway = false;
    if (hit.plane != volume::BrickVolume::kNoPlane) {
        const Vec3d index = scene_.volume.oblique()[hit.plane].normal;
        directions = scene_.directions.plane(hit.plane);
        isAway = dot(index, hit.direction) > 0;
        if (!isOpenBefore(hit.cell, hit.plane, !isAway)) {
            const int face = longestAxis(index);
            coverage = normalAt(hit.cell, face, (index[face] > 0) == isAway ? -1 : 1).coverage;
        }
    } else {
        isAway = hit.direction[hit.axis] > 0;
        const int sign = isAway ? -1 : 1;
        if (isFlatAround(hit.cell, hit.axis, sign)) {
            directions = scene_.directions.axis(hit.axis);
        } else {
            const SurfaceNormal& found = normalAt(hit.cell, hit.axis, sign);
            directions = scene_.directions.directions(toDouble(found.indexNormal));
            coverage = found.coverage;
            isAway = false;
        }
    }
    if (isAway) {
        directions.normal = -directions.normal;
        directions.away = -directions.away;
    }
    const double open = scene_.spec.light.ambientOcclusion > 0 ? openness(hit, directions.away, coverage) : 1;
    return {directions.normal, lightOn(directions.normal, hit.view, open), false};
}

const SurfaceNormal& SurfaceLight::normalAt(Vec3i cell, int axis, int sign) const {
    // 17 bits a coordinate, 3 the face, 6 the pass.
    const std::uint64_t key = part(cell.x, 0) | part(cell.y, 17) | part(cell.z, 34) |
                              part(2 * axis + (sign > 0 ? 1 : 0), 51) | part(std::int32_t(passNumber_), 54);
    NormalCache::Slot& slot = cache_.slot(key);
    if (slot.key != key) {
        slot.key = key;
        const PassTable& table = pass_.table;
        slot.normal = surfaceNormal(scene_.volume, cell, axis, sign,
                                    [&](volume::Scalar scalar) { return table[scalar].isBody; });
    }
    return slot.normal;
}

// Calls `isFine(brick, entry, near)` for each brick of the volume with voxels at most 3 away from `brick`, those in
// `near`. False as soon as that is.
template <class IsFine>
bool SurfaceLight::checkAround(Vec3i brick, const IsFine& isFine) const {
    const Vec3i bricks = scene_.volume.brickCount();
    for (std::int32_t n = 0; n < 27; ++n) {
        const Vec3i at = brick + Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= bricks.x || at.y >= bricks.y || at.z >= bricks.z) continue;
        if (!isFine(at, scene_.volume.entry(at.x, at.y, at.z), kNear[static_cast<std::size_t>(n)])) return false;
    }
    return true;
}

// Is the face of the voxel flat as far as normals look, all over the brick, with nothing before it? Then normalAt()
// gives the axis, and no corner, for all its voxels, and need not be asked.
bool SurfaceLight::isFlatAround(Vec3i cell, int axis, int sign) const {
    const std::int32_t face = sign > 0 ? cell[axis] + 1 : cell[axis];
    const Vec3i brick{cell.x >> 3, cell.y >> 3, cell.z >> 3};
    // 14 bits a brick's coordinate, 4 the place of the face in it, 3 its axis and sign, 6 the pass.
    const std::uint64_t key = part(brick.x, 0) | part(brick.y, 14) | part(brick.z, 28) |
                              part(face - 8 * brick[axis], 42) | part(2 * axis + (sign > 0 ? 1 : 0), 46) |
                              part(std::int32_t(passNumber_), 49);
    NormalCache::Flatness& slot = cache_.flatness(key);
    if (slot.key == key) return slot.isFlat;
    slot.key = key;
    const PassTable& table = pass_.table;
    Words scratch;
    slot.isFlat = isBorderFar(brick) && checkAround(brick, [&](Vec3i at, auto entry, const Words& near) {
        const std::int32_t first = face - 8 * at[axis];  // from the brick's corner
        // The voxels behind the face, and four before it.
        const Words &lowest = below(axis, sign > 0 ? first - 1 : first - 4), &middle = below(axis, first),
                    &highest = below(axis, sign > 0 ? first + 4 : first + 1);
        const auto mask = scene_.volume.voxelMask(
            entry, [&](volume::Scalar scalar) { return table[scalar].isBody; }, scratch);
        for (std::size_t k = 0; k < 8; ++k) {
            const std::uint64_t seen = highest[k] & ~lowest[k] & near[k];
            const std::uint64_t behind = sign > 0 ? middle[k] & ~lowest[k] : highest[k] & ~middle[k];
            if ((mask.word(k) & seen) != (behind & near[k])) return false;
        }
        return true;
    });
    return slot.isFlat;
}

// Are all bricks around in the volume?
bool SurfaceLight::isBorderFar(Vec3i brick) const noexcept {
    const Vec3i bricks = scene_.volume.brickCount();
    return brick.x > 0 && brick.y > 0 && brick.z > 0 && brick.x + 1 < bricks.x && brick.y + 1 < bricks.y &&
           brick.z + 1 < bricks.z;
}

// Is there no body before the plane, around the brick of the voxel?
bool SurfaceLight::isOpenBefore(Vec3i cell, std::uint32_t plane, bool isPositive) const {
    const Vec3i brick{cell.x >> 3, cell.y >> 3, cell.z >> 3};
    // 14 bits a brick's coordinate, 1 the side; 7 stands for planes, of which a brick shows one or two.
    const std::uint64_t key = part(brick.x, 0) | part(brick.y, 14) | part(brick.z, 28) |
                              part(std::int32_t(plane & 7u), 42) | part(isPositive ? 1 : 0, 45) | part(7, 46) |
                              part(std::int32_t(passNumber_), 49);
    NormalCache::Flatness& slot = cache_.flatness(key);
    if (slot.key == key && slot.plane == plane) return slot.isFlat;
    slot.key = key;
    slot.plane = plane;
    const volume::BrickVolume& volume = scene_.volume;
    const PassTable& table = pass_.table;
    const volume::BrickPlane& found = volume.oblique()[plane];
    const Vec3d normal = isPositive ? found.normal : -found.normal;
    const double offset = (isPositive ? found.offset : -found.offset) - 1;  // a voxel before the plane
    const double reach = 3.5 * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    Words scratch;
    slot.isFlat = checkAround(brick, [&](Vec3i at, auto entry, const Words& near) {
        const Vec3d first{8 * at.x + 0.5, 8 * at.y + 0.5, 8 * at.z + 0.5};
        const double base = dot(normal, first) + offset;
        if (base + 3.5 * (normal.x + normal.y + normal.z) + reach <= 0) return true;  // all behind
        if (!entry.isMixed()) return !table[volume.box(entry).scalar].isBody;
        if (volume.isCoded(entry)) {
            // The plane goes on, or one like it?
            const auto coding = volume.coding(entry);
            if (coding.plane[0] != volume::BrickVolume::kNoPlane &&
                coding.plane[1] == volume::BrickVolume::kNoPlane && coding.cut == std::array<std::uint8_t, 3>{} &&
                isLike(volume.oblique()[coding.plane[0]], found, at))
                return !table[coding.cells[isPositive ? 1 : 0]].isBody;
        }
        const auto mask = volume.voxelMask(
            entry, [&](volume::Scalar scalar) { return table[scalar].isBody; }, scratch);
        for (std::size_t k = 0; k < 8; ++k)
            for (std::uint64_t bits = mask.word(k) & near[k]; bits != 0; bits &= bits - 1) {
                const int bit = std::countr_zero(bits);
                if (base + normal.x * (bit & 7) + normal.y * (bit >> 3) + normal.z * static_cast<double>(k) > 0)
                    return false;
            }
        return true;
    });
    return slot.isFlat;
}

double SurfaceLight::openness(const SurfaceHit& hit, Vec3d away, float coverage) const noexcept {
    const Vec3f point = toFloat(hit.origin + hit.direction * hit.from);
    const float crease = std::clamp((coverage - SurfaceNormal::kPlaneCoverage - 0.05f) * 2.5f, 0.0f, 1.0f);
    const float occlusion = std::min(1.0f, pass_.occlusion.occlusion(point, toFloat(away)) + 0.35f * crease);
    return 1 - double(scene_.spec.light.ambientOcclusion) * double(occlusion);
}

// Key light, sky and a little light from the viewer; corners get less of all.
double SurfaceLight::lightOn(Vec3d normal, Vec3d view, double open) const noexcept {
    const Light& light = scene_.spec.light;
    const double key = std::max(0.0, dot(normal, scene_.towardsLight));
    const double facing = std::max(0.0, dot(normal, view));
    const double sky = 0.80 + 0.20 * normal.z;
    return double(light.ambient) * open * (0.82 * sky + 0.18 * facing) +
           double(light.key) * key * (0.45 + 0.55 * open);
}

}  // namespace svt::render
