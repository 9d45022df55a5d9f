#include <svt/render/camera_rays.hpp>
#include <svt/render/view_ray.hpp>

namespace svt::render {

ViewRay viewRay(const FrameSpec& spec, const volume::Grid& grid, double x, double y) {
    const CameraRays rays(spec, grid);
    const double u = 2 * x - 1, v = 1 - 2 * y;
    const Vec3d origin = rays.worldAt(u, v, 0);
    return {origin, rays.worldAt(u, v, 1) - origin};
}

}  // namespace svt::render
