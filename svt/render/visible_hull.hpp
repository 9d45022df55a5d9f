#pragma once
/// \file
/// A convex body around all that a pass shows. Internal to render.

#include <svt/render/camera_rays.hpp>
#include <svt/render/pass_table.hpp>
#include <svt/volume/brick_volume.hpp>

#include <vector>

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
    /// Cost: by rows of bricks; a tenth of a millisecond per thousand. Deterministic for any number of threads.
    VisibleHull(const volume::BrickVolume& volume, const PassTable& table, int threads);

    /// A stretch outside of which no ray through `rect` comes to anything visible; empty where none does. Cost: some
    /// hundred cycles. Of a plane that all rays of a beam cross to the same side, the corners' times are the extremes:
    /// they are fractions of linear functions of u and v.
    [[nodiscard]] RaySpan around(const CameraRays& rays, const ViewRect& rect) const noexcept;

private:
    struct Slab {
        Vec3d normal;      // voxel space
        double low, high;  // of dot(normal, point)
    };
    std::vector<Slab> slabs_;
};

}  // namespace svt::render
