#include <svt/writers/gltf/slope_vertices.hpp>

#include <svt/volume/label_table.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace svt::writers {
namespace {

using volume::BrickPlane;
using volume::BrickVolume;
using volume::kNoLabel;

constexpr std::size_t kMaxPlanes = 3;
constexpr double kFarthest = 1;  // voxels

bool isInside(Vec3i voxel, Vec3i dimension) {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < dimension.x && voxel.y < dimension.y &&
           voxel.z < dimension.z;
}

// Sides of a code's cuts and planes on which a voxel lies; see BrickVolume::BoxCoding::firstSideScalar.
struct Sides {
    std::uint32_t bits = 0, planeBits = 0;                      // the latter are of planes
    std::array<std::uint32_t, BrickVolume::kMaxSides> plane{};  // by bit, where it is of a plane
};

Sides sidesOf(const BrickVolume& bricks, const BrickVolume::BoxCoding& code, Vec3i voxel) {
    Sides sides;
    std::uint32_t bit = 0;
    code.forEachSide([&](int axis, std::uint16_t place) { sides.bits |= (voxel[axis] >= place ? 1u : 0u) << bit++; },
                     [&](std::uint32_t number) {
                         const BrickPlane& plane = bricks.planes()[number];
                         const Vec3d center{voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5};
                         sides.plane[bit] = number;
                         sides.planeBits |= 1u << bit;
                         sides.bits |= (dot(plane.normal, center) + plane.offset > 0 ? 1u : 0u) << bit++;
                     });
    return sides;
}

// The smallest step, along unconstrained axes only, from `point` onto all planes; nothing if they do not meet nearby.
// It is a sum of the normals, which Gauss finds from their dot products.
std::optional<Vec3d> stepOnto(std::span<const BrickPlane> planes, Vec3d point, std::uint32_t fixedAxes) {
    const std::size_t count = planes.size();
    std::array<Vec3d, kMaxPlanes> normal;
    std::array<std::array<double, kMaxPlanes + 1>, kMaxPlanes> row{};
    for (std::size_t p = 0; p < count; ++p) {
        normal[p] = planes[p].normal;
        row[p][count] = -(dot(planes[p].normal, point) + planes[p].offset);
        for (int axis = 0; axis < 3; ++axis)
            if (((fixedAxes >> axis) & 1u) != 0) normal[p][axis] = 0;
    }
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < count; ++q) row[p][q] = dot(normal[p], normal[q]);
    for (std::size_t p = 0; p < count; ++p) {
        // The remaining squared length of a normal after projecting out the others: 0 if planes are parallel.
        if (!(row[p][p] > (p == 0 ? 1e-6 : 1e-3 * dot(normal[p], normal[p])))) return std::nullopt;
        for (std::size_t q = 0; q < count; ++q) {
            if (q == p) continue;
            const double part = row[q][p] / row[p][p];
            for (std::size_t n = p; n <= count; ++n) row[q][n] -= part * row[p][n];
        }
    }
    Vec3d step{};
    for (std::size_t p = 0; p < count; ++p) step = step + normal[p] * (row[p][count] / row[p][p]);
    if (!(length(step) <= kFarthest)) return std::nullopt;
    return step;
}

}  // namespace

std::uint32_t SlopeVertices::separatingPlane(Vec3i a, Vec3i b) const {
    const volume::Scalar scalarA = bricks_.scalarAt(a.x, a.y, a.z), scalarB = bricks_.scalarAt(b.x, b.y, b.z);
    const Vec3i brick{a.x >> 3, a.y >> 3, a.z >> 3};
    // The brick itself, then its neighbours.
    for (std::int32_t n = -1; n < 27; ++n) {
        const Vec3i at = n < 0 ? brick : brick + Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        if (!isInside(at, bricks_.brickCount())) continue;
        const BrickVolume::Entry entry = bricks_.entry(at.x, at.y, at.z);
        if (!entry.isCoded()) continue;
        const BrickVolume::BoxCoding& code = bricks_.coding(entry);
        const Sides sidesA = sidesOf(bricks_, code, a), sidesB = sidesOf(bricks_, code, b);
        const std::uint32_t differing = sidesA.bits ^ sidesB.bits;
        if (std::popcount(differing) != 1 || (differing & sidesA.planeBits) == 0) continue;
        if (bricks_.sideScalar(code, sidesA.bits) != scalarA || bricks_.sideScalar(code, sidesB.bits) != scalarB)
            continue;
        return sidesA.plane[static_cast<std::size_t>(std::countr_zero(differing))];
    }
    return BrickVolume::kNoPlane;
}

Vec3d SlopeVertices::place(Vec3i corner) const {
    const Vec3d stays{double(corner.x), double(corner.y), double(corner.z)};
    const auto voxelAt = [&](unsigned number) {
        return corner - Vec3i{1, 1, 1} +
               Vec3i{static_cast<std::int32_t>(number & 1), static_cast<std::int32_t>(number >> 1 & 1),
                     static_cast<std::int32_t>(number >> 2)};
    };
    std::array<std::uint32_t, 8> label{};
    for (unsigned v = 0; v < 8; ++v) {
        const Vec3i voxel = voxelAt(v);
        label[v] = kNoLabel;
        if (!isInside(voxel, bricks_.dimension())) continue;
        const volume::Scalar scalar = bricks_.scalarAt(voxel.x, voxel.y, voxel.z);
        if (scalar < labelOfScalar_.size()) label[v] = labelOfScalar_[scalar];
    }
    if (bricks_.planes().empty()) return stays;
    std::array<BrickPlane, kMaxPlanes> planes;
    std::size_t count = 0;
    std::uint32_t fixedAxes = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned v = 0; v < 8; ++v) {
            if ((v >> axis & 1) != 0 || label[v] == label[v | 1u << axis]) continue;
            const Vec3i a = voxelAt(v), b = voxelAt(v | 1u << axis);
            const bool areInside = isInside(a, bricks_.dimension()) && isInside(b, bricks_.dimension());
            const std::uint32_t number = areInside ? separatingPlane(a, b) : BrickVolume::kNoPlane;
            if (number == BrickVolume::kNoPlane) {
                fixedAxes |= 1u << axis;
                continue;
            }
            // Adjacent bricks often store the same plane separately.
            const BrickPlane& plane = bricks_.planes()[number];
            bool isKnown = false;
            for (std::size_t p = 0; p < count; ++p)
                isKnown = isKnown || std::abs(dot(planes[p].normal, plane.normal)) > 0.99;
            if (isKnown) continue;
            if (count == kMaxPlanes) return stays;
            planes[count++] = plane;
        }
    if (count == 0) return stays;
    const auto step = stepOnto(std::span(planes).first(count), stays, fixedAxes);
    return step ? stays + *step : stays;
}

}  // namespace svt::writers
