#pragma once
/// \file
/// A convex hull of the visible parts of a pass, as slabs.

#include <svt/render/camera_rays.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstddef>

namespace svt::render {

/// A rectangle of the picture, in the coordinates of CameraRays::at(). Empty by default.
struct ViewRect {
    double left = 1, right = -1;  ///< u
    double low = 1, high = -1;    ///< v
};

/// Slabs that contain all bricks with visible labels (a k-DOP). They are across the axes, across their diagonals, and
/// across the most frequent planes of the volume, so that the hull of a house is tight for any orientation. Nothing is
/// visible outside, so rays need not be walked there.
class VisibleHull {
public:
    /// An empty hull.
    VisibleHull() = default;
    /// The hull, seen by `rays`. Cost: O(boxes + palettes + rows of bricks); 0.5 to 1.5 ms of one core for a house at
    /// 800 x 700 x 400. The result does not depend on `threads`.
    VisibleHull(const volume::BrickVolume& volume, const PassTable& table, const CameraRays& rays, int threads);

    /// An interval of t outside of which no ray through `rect` meets anything visible (conservative); empty if none
    /// does. Cost: some hundred cycles.
    [[nodiscard]] RaySpan spanOf(const ViewRect& rect) const noexcept;

    static constexpr std::size_t kSlabs = 24;

private:
    // A slab is [low, high] along its direction. A ray through (u, v) starts at height(u, v) along that direction and
    // advances by rise(u, v) per t. Both are linear in u and v, so over a rectangle the extremes are at its corners.
    struct Linear {
        std::array<double, kSlabs> middle{}, byU{}, byV{};
    };
    Linear rise_, height_;
    std::array<double, kSlabs> low_{}, high_{};
    bool isEmpty_ = true;
};

}  // namespace svt::render
