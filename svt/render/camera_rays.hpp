#pragma once
/// \file
/// The rays of a camera in voxel space. For renderers: used by render and render_gl.

#include <svt/render/frame_spec.hpp>
#include <svt/render/voxel_ray.hpp>
#include <svt/volume/grid.hpp>

#include <cmath>
#include <numbers>

namespace svt::render {

/// A ray in voxel space, and its direction in world space, for shading.
struct CameraRay {
    VoxelRay voxelRay;
    Vec3d direction;    ///< world space; its component along the view direction is 1, so t is depth
    double metresPerT;  ///< length of `direction`
};

class CameraRays {
public:
    /// `spec` must have passed checkFrameSpec().
    CameraRays(const FrameSpec& spec, const volume::Grid& grid)
        : isPerspective_(spec.camera.projection == Camera::Projection::Perspective) {
        const Camera& camera = spec.camera;
        eye_ = camera.eye;
        forward_ = normalized(camera.target - camera.eye);
        right_ = normalized(cross(forward_, normalized(camera.up)));
        up_ = cross(right_, forward_);
        halfHeight_ = isPerspective_ ? std::tan(camera.verticalFovDegrees * std::numbers::pi / 360)
                                     : camera.orthographicHeight / 2;
        halfWidth_ = halfHeight_ * spec.width / spec.height;
        metresPerRow_ = 2 * halfHeight_ / spec.height;
        eyeVoxel_ = grid.indexFromWorld(camera.eye) + Vec3d{0.5, 0.5, 0.5};
        forwardVoxel_ = grid.indexFromWorldDirection(forward_);
        rightVoxel_ = grid.indexFromWorldDirection(right_);
        upVoxel_ = grid.indexFromWorldDirection(up_);
    }

    /// \param u, v  -1..1 from left to right and from bottom to top of the picture
    [[nodiscard]] CameraRay at(double u, double v) const noexcept {
        const double x = u * halfWidth_, y = v * halfHeight_;
        const Vec3d aside = rightVoxel_ * x + upVoxel_ * y;
        if (!isPerspective_) return {VoxelRay(eyeVoxel_ + aside, forwardVoxel_), forward_, 1};
        return {VoxelRay(eyeVoxel_, forwardVoxel_ + aside), forward_ + right_ * x + up_ * y,
                std::sqrt(1 + x * x + y * y)};
    }

    /// The point (world space) seen at (u, v) at a depth, metres along the view direction.
    [[nodiscard]] Vec3d worldAt(double u, double v, double depth) const noexcept {
        const Vec3d aside = right_ * (u * halfWidth_) + up_ * (v * halfHeight_);
        return eye_ + forward_ * depth + (isPerspective_ ? aside * depth : aside);
    }
    /// Projects a point (world space, relative to the eye): u, v and depth. With perspective, valid only if depth > 0.
    [[nodiscard]] Vec3d seenAt(Vec3d fromEye) const noexcept {
        const double depth = dot(fromEye, forward_), scale = isPerspective_ ? depth : 1;
        return {dot(fromEye, right_) / (halfWidth_ * scale), dot(fromEye, up_) / (halfHeight_ * scale), depth};
    }
    [[nodiscard]] bool isPerspective() const noexcept { return isPerspective_; }

    /// The vectors from which at() makes rays; those named Voxel are in voxel space.
    struct Basis {
        Vec3d forward, right, up;
        double halfWidth, halfHeight;
        Vec3d eyeVoxel, forwardVoxel, rightVoxel, upVoxel;
    };
    [[nodiscard]] Basis basis() const noexcept {
        return {forward_, right_, up_, halfWidth_, halfHeight_, eyeVoxel_, forwardVoxel_, rightVoxel_, upVoxel_};
    }

    [[nodiscard]] Vec3d forward() const noexcept { return forward_; }
    [[nodiscard]] Vec3d right() const noexcept { return right_; }
    [[nodiscard]] Vec3d up() const noexcept { return up_; }
    /// Height of a pixel at a depth, both in metres.
    [[nodiscard]] double pixelSize(double depth) const noexcept {
        return isPerspective_ ? metresPerRow_ * depth : metresPerRow_;
    }

private:
    bool isPerspective_;
    Vec3d eye_, forward_, right_, up_;
    double halfWidth_, halfHeight_, metresPerRow_;
    Vec3d eyeVoxel_, forwardVoxel_, rightVoxel_, upVoxel_;
};

}  // namespace svt::render
