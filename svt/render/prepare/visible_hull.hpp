#pragma once
/// \file
/// A convex body around all that a pass shows. Internal to render.

#include <svt/render/camera_rays.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/volume/brick_volume.hpp>

#include <array>
#include <cstddef>

namespace svt::render {

/// Part of the picture, see CameraRays::at().
struct ViewRect {
    double left = 1, right = -1;  ///< u
    double low = 1, high = -1;    ///< v
};

/// Slabs that hold all bricks with visible labels: across the axes, their diagonals, and the directions that most
/// planes of the volume have, so that a house is wrapped tightly whichever way it stands. What lies outside is hidden,
/// so rays need not be walked there.
class VisibleHull {
public:
    /// Around nothing.
    VisibleHull() = default;
    /// As `rays` see it. Cost: by boxes, palettes and rows of bricks; 0.5 to 1.5 ms of one core for a house at
    /// 800 x 700 x 400. Deterministic for any number of threads.
    VisibleHull(const volume::BrickVolume& volume, const PassTable& table, const CameraRays& rays, int threads);

    /// A stretch outside of which no ray through `rect` comes to anything visible; empty where none does. Cost: some
    /// hundred cycles.
    [[nodiscard]] RaySpan around(const ViewRect& rect) const noexcept;

    static constexpr std::size_t kSlabs = 24;

private:
    // A ray through (u, v) crosses places low to high along a slab's direction; it begins at height(u, v) and goes on
    // by rise(u, v) per t. Both are linear, so among the rays of a rectangle the extremes are at its corners.
    struct Linear {
        std::array<double, kSlabs> middle{}, byU{}, byV{};
    };
    Linear rise_, height_;
    std::array<double, kSlabs> low_{}, high_{};
    bool isEmpty_ = true;
};

}  // namespace svt::render
