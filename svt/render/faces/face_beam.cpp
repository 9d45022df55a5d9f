#include <svt/render/faces/face_beam.hpp>

#include <cmath>
#include <cstddef>

namespace svt::render {
namespace {

constexpr double kMargin = 1e-3;  // voxels, far above rounding

}  // namespace

FaceBeam::FaceBeam(const CameraRays& rays, double left, double right, double bottom, double top) noexcept
    : isPerspective_(rays.isPerspective()) {
    const double u = (left + right) / 2, v = (bottom + top) / 2;
    const VoxelRay middle = rays.at(u, v).voxelRay, toRight = rays.at(right, v).voxelRay,
                   toTop = rays.at(u, top).voxelRay;
    origin_ = middle.origin;
    direction_ = middle.direction;
    right_ = isPerspective_ ? toRight.direction - direction_ : toRight.origin - origin_;
    up_ = isPerspective_ ? toTop.direction - direction_ : toTop.origin - origin_;
    const CameraRays::Basis basis = rays.basis();
    const Vec3d across = cross(basis.rightVoxel, basis.upVoxel);
    depth_ = across / dot(across, basis.forwardVoxel);
    depthOfEye_ = dot(depth_, basis.eyeVoxel);
    const VoxelRay corners[] = {rays.at(left, bottom).voxelRay, rays.at(right, bottom).voxelRay,
                                rays.at(right, top).voxelRay, rays.at(left, top).voxelRay};
    for (std::size_t n = 0; n < sides_.size(); ++n) {
        const VoxelRay &a = corners[n], &b = corners[(n + 1) % 4];
        const Vec3d normal = normalized(cross(a.direction, (b.origin - a.origin) + (b.direction - a.direction)));
        const double offset = dot(normal, a.origin);
        const double sign = dot(normal, origin_ + direction_) > offset ? -1 : 1;
        sides_[n] = {normal * sign, offset * sign};
    }
}

double FaceBeam::depthOf(Vec3d low, Vec3d high) const noexcept {
    const Vec3d center = (low + high) * 0.5, half = (high - low) * 0.5 + Vec3d{kMargin, kMargin, kMargin};
    return dot(depth_, center) - depthOfEye_ -
           (std::abs(depth_.x) * half.x + std::abs(depth_.y) * half.y + std::abs(depth_.z) * half.z);
}

bool FaceBeam::mayMeet(Vec3d low, Vec3d high) const noexcept {
    const Vec3d center = (low + high) * 0.5, half = (high - low) * 0.5;
    bool isAhead = true, isBehind = isPerspective_;
    for (const Side& side : sides_) {
        const double middle = dot(side.normal, center) - side.offset;
        const double reach = std::abs(side.normal.x) * half.x + std::abs(side.normal.y) * half.y +
                             std::abs(side.normal.z) * half.z + kMargin;
        isAhead = isAhead && middle <= reach;
        isBehind = isBehind && middle >= -reach;
    }
    return isAhead || isBehind;
}

bool FaceBeam::findEdges(Vec3d a, Vec3d b, Vec3d c, BeamTriangle& triangle) const noexcept {
    constexpr double kEdgeOn = 1e-6;
    struct Value {
        double right, up, middle;
        [[nodiscard]] double reach() const noexcept { return std::abs(right) + std::abs(up); }
    };
    // The side on which the line of a ray passes the edge, as a volume, for all rays.
    const auto sideOf = [&](Vec3d p, Vec3d q) -> Value {
        if (isPerspective_) {
            const Vec3d normal = cross(p - origin_, q - origin_);
            return {dot(normal, right_), dot(normal, up_), dot(normal, direction_)};
        }
        const Vec3d normal = cross(direction_, q - p);
        return {dot(normal, right_), dot(normal, up_), dot(normal, origin_ - p)};
    };
    const std::array<Value, 3> sides{sideOf(a, b), sideOf(b, c), sideOf(c, a)};
    // The sum is a measure of the area that a ray sees.
    Value sum{};
    double largest = 0;
    for (const Value& side : sides) {
        sum = {sum.right + side.right, sum.up + side.up, sum.middle + side.middle};
        largest = std::max(largest, std::abs(side.middle) + side.reach());
    }
    triangle.edges = {};
    if (!(std::abs(sum.middle) > sum.reach() + kEdgeOn * largest)) {
        // Nearly edge-on: inside of the triangle, all sides have one sign, so that none exceeds the sum.
        const Value& side = *std::ranges::max_element(
            sides, {}, [](const Value& value) { return std::abs(value.middle) + value.reach(); });
        if (!(largest > 0)) return true;
        const double most = (std::abs(sum.middle) + sum.reach()) / largest + kEdgeOn;
        if (std::abs(side.middle) - side.reach() > most * largest) return false;
        for (const double sign : {1.0, -1.0})
            triangle.edges[sign > 0 ? 0 : 1] = {static_cast<float>(sign * side.right / largest),
                                                static_cast<float>(sign * side.up / largest),
                                                static_cast<float>(sign * side.middle / largest + most)};
        return true;
    }
    for (std::size_t n = 0; n < sides.size(); ++n) {
        const Value& side = sides[n];
        const double scale = (std::abs(side.middle) + side.reach()) * (sum.middle > 0 ? 1 : -1);
        if (scale == 0) continue;
        const double reach = side.reach() / std::abs(scale), middle = side.middle / scale;
        if (middle + reach < -double(BeamTriangle::kMargin)) return false;
        triangle.edges[n] = {static_cast<float>(side.right / scale), static_cast<float>(side.up / scale),
                             static_cast<float>(middle)};
    }
    return true;
}

}  // namespace svt::render
