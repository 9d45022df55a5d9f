#pragma once
/// \file
/// The depth that is t = 0 in shaders.

#include <svt/render/camera_rays.hpp>

#include <algorithm>

namespace svt::render_gl {

/// Depth of the middle voxel, metres along the view direction; 0 if it is behind the eye plane.
[[nodiscard]] inline double middleDepthOf(const render::Camera& camera, const render::CameraRays& rays,
                                          const volume::Grid& grid, Vec3i middle) noexcept {
    const Vec3d place = grid.worldFromIndex(Vec3d{middle.x - 0.5, middle.y - 0.5, middle.z - 0.5});
    return std::max(0.0, dot(place - camera.eye, rays.forward()));
}

}  // namespace svt::render_gl
