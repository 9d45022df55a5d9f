#include <svt/samples/parts/placement.hpp>

#include <cmath>

namespace svt::samples {
namespace {

Vec3d rotatedBy(const Rotation& rotation, Vec3d p) {
    const double dx = p.x - rotation.centerX, dy = p.y - rotation.centerY;
    return {rotation.centerX + rotation.cosine * dx - rotation.sine * dy,
            rotation.centerY + rotation.sine * dx + rotation.cosine * dy, p.z};
}

Vec3d rotatedDirection(const Rotation& rotation, Vec3d d) {
    return {rotation.cosine * d.x - rotation.sine * d.y, rotation.sine * d.x + rotation.cosine * d.y, d.z};
}

}  // namespace

Rotation Rotation::byDegrees(double degrees, double centerX, double centerY) {
    constexpr double kRadians = 0.017453292519943295;
    const double quarters = degrees / 90;
    if (quarters == std::floor(quarters)) {
        const int quarter = ((int(quarters) % 4) + 4) % 4;
        return {quarter == 0   ? 1.0
                : quarter == 2 ? -1.0
                               : 0.0,
                quarter == 1   ? 1.0
                : quarter == 3 ? -1.0
                               : 0.0,
                centerX, centerY};
    }
    // Math libraries differ in the last bits of sine and cosine.
    return {std::round(std::cos(degrees * kRadians) * 1e12) / 1e12,
            std::round(std::sin(degrees * kRadians) * 1e12) / 1e12, centerX, centerY};
}

bool Rotation::isExact() const {
    if (cosine != 0 && sine != 0) return false;
    const double kept = centerX - cosine * centerX + sine * centerY;
    const double other = centerY - sine * centerX - cosine * centerY;
    return kept == std::floor(kept) && other == std::floor(other);
}

Vec3d Placement::rotated(Vec3d p) const {
    return rotatedBy(modelRotation_, rotatedBy(buildingRotation_, p) + toDouble(shift_));
}

WorldPoint Placement::at(Point p) const {
    const Vec3d q = rotated(toDouble(p));
    const std::int64_t scale = decimals() == 3 ? 1 : 1000;
    const auto whole = [&](double value, Length origin) {
        return std::int64_t(std::llround(value * double(scale))) + origin * scale;
    };
    return {whole(q.x, origin_.x), whole(q.y, origin_.y), whole(q.z, origin_.z)};
}

Vec3d Placement::worldPosition(Vec3d millimetres) const { return (rotated(millimetres) + toDouble(origin_)) / 1000; }

Vec3d Placement::worldDirection(Vec3d direction) const {
    return rotatedDirection(modelRotation_, rotatedDirection(buildingRotation_, direction));
}

Placement Placement::lifted(Length height) const {
    Placement result = *this;
    result.shift_.z += height;
    return result;
}

}  // namespace svt::samples
