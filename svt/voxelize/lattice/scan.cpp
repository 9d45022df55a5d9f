#include <svt/voxelize/lattice/scan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::voxelize {
namespace {

// Slope limit in quanta per sample (64 voxels up per voxel along). Steeper faces take their heights from the snapped
// corners, clamped to the triangle: there the snapping error outweighs the benefit of a shared plane.
constexpr double kSteepest = 64.0 * double(kQuanta);

// Above this slope the heights over a whole grid would overflow 63 bits.
constexpr double kUnstable = double(std::int64_t{1} << 25);

std::int64_t toFixed(double quanta) {
    constexpr double kLargest = 2e18;
    return static_cast<std::int64_t>(std::llrint(std::clamp(std::ldexp(quanta, Height::kBits), -kLargest, kLargest)));
}

// Samples (i, j) are offset by one quantum along x and y from the integer coordinates.
Height heightAtSamples(double slopeX, double slopeY, double offset) {
    return {toFixed(offset + (slopeX + slopeY) / double(kQuanta)), toFixed(slopeX), toFixed(slopeY)};
}

// By y, then by x.
void sortCorners(ScanTriangle& t) {
    const auto order = [&](int p, int q) {
        if (std::pair(t.y[p], t.x[p]) <= std::pair(t.y[q], t.x[q])) return;
        std::swap(t.x[p], t.x[q]);
        std::swap(t.y[p], t.y[q]);
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
}

}  // namespace

bool isScanPlane(const mesh::Plane& plane) noexcept {
    return std::abs(plane.slopeX) <= kSteepest && std::abs(plane.slopeY) <= kSteepest;
}

FaceHeight planeHeight(const mesh::Plane& plane) noexcept {
    // No clamp: the plane may miss the snapped corners slightly, and all faces that share it must get equal heights.
    constexpr std::int32_t kNoLow = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t kNoHigh = std::numeric_limits<std::int32_t>::max();
    if (plane.slopeX == 0 && plane.slopeY == 0)
        return {{(2 * std::llrint(plane.offset / 2)) << Height::kBits, 0, 0}, kNoLow, kNoHigh};
    return {heightAtSamples(plane.slopeX, plane.slopeY, plane.offset), kNoLow, kNoHigh};
}

FaceHeight triangleHeight(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c,
                          const ScanAxes& axes) noexcept {
    const std::int32_t low = std::min({a[axes.z], b[axes.z], c[axes.z]});
    const std::int32_t high = std::max({a[axes.z], b[axes.z], c[axes.z]});
    FaceHeight face;
    face.lowest = static_cast<std::int32_t>(firstSampleAbove(low));
    face.highest = static_cast<std::int32_t>(firstSampleAbove(high));
    if (low == high) {
        face.height = {std::int64_t(low) << Height::kBits, 0, 0};
        return face;
    }
    const auto along = [&](const QuantaPoint& from, const QuantaPoint& to, std::size_t axis) {
        return std::int64_t(to[axis]) - from[axis];
    };
    const std::int64_t ax = along(a, b, axes.x), ay = along(a, b, axes.y), az = along(a, b, axes.z);
    const std::int64_t bx = along(a, c, axes.x), by = along(a, c, axes.y), bz = along(a, c, axes.z);
    const std::int64_t area = ax * by - ay * bx;
    const double slopeX = (double(az) * double(by) - double(ay) * double(bz)) / double(area) * double(kQuanta);
    const double slopeY = (double(ax) * double(bz) - double(az) * double(bx)) / double(area) * double(kQuanta);
    const double offset =
        double(a[axes.z]) - (slopeX * double(a[axes.x]) + slopeY * double(a[axes.y])) / double(kQuanta);
    // So steep that every crossed sample is within the snapping distance: any height between the corners is correct.
    if (std::abs(slopeX) > kUnstable || std::abs(slopeY) > kUnstable)
        face.height = {((std::int64_t(face.lowest) + face.highest) / 2 * kQuanta) << Height::kBits, 0, 0};
    else
        face.height = heightAtSamples(slopeX, slopeY, offset);
    return face;
}

bool setUpScan(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, const ScanAxes& axes,
               ScanTriangle& out) noexcept {
    const QuantaPoint* corner[3] = {&a, &b, &c};
    const auto x = [&](int i) { return (*corner[i])[axes.x]; };
    const auto y = [&](int i) { return (*corner[i])[axes.y]; };

    out.firstRow = static_cast<std::int32_t>(firstSampleAbove(std::min({y(0), y(1), y(2)})));
    out.endRow = static_cast<std::int32_t>(firstSampleAbove(std::max({y(0), y(1), y(2)})));
    if (out.firstRow >= out.endRow) return false;
    out.firstColumn = static_cast<std::int32_t>(firstSampleAbove(std::min({x(0), x(1), x(2)})));
    out.endColumn = static_cast<std::int32_t>(firstSampleAbove(std::max({x(0), x(1), x(2)})));
    if (out.firstColumn >= out.endColumn) return false;
    const std::int64_t ax = x(1) - std::int64_t(x(0)), ay = y(1) - std::int64_t(y(0));
    const std::int64_t bx = x(2) - std::int64_t(x(0)), by = y(2) - std::int64_t(y(0));
    const std::int64_t area = ax * by - ay * bx;
    if (area == 0) return false;
    out.sign = (area > 0) != axes.isMirrored ? -1 : 1;
    const FaceHeight face = triangleHeight(a, b, c, axes);
    out.height = face.height;
    out.lowest = face.lowest;
    out.highest = face.highest;

    for (int i = 0; i < 3; ++i) {
        out.x[i] = x(i);
        out.y[i] = y(i);
    }
    sortCorners(out);
    const std::int64_t side = (std::int64_t(out.x[1]) - out.x[0]) * (std::int64_t(out.y[2]) - out.y[0]) -
                              (std::int64_t(out.y[1]) - out.y[0]) * (std::int64_t(out.x[2]) - out.x[0]);
    out.isMiddleRight = side > 0;
    return true;
}

}  // namespace svt::voxelize
