#include <svt/illustrate/pick_ray.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace svt::illustrate {
namespace {

// Whether a ray from `from` along `along`, in index space, hits the voxels.
bool meetsVoxels(Vec3d from, Vec3d along, Vec3i dimension) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = -0.5 - from[axis], high = dimension[axis] - 0.5 - from[axis];
        if (along[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        enter = std::max(enter, std::min(low / along[axis], high / along[axis]));
        leave = std::min(leave, std::max(low / along[axis], high / along[axis]));
    }
    return enter < leave;
}

}  // namespace

Result<PickRay> parsePickRay(std::string_view text, const volume::Grid& grid) {
    const auto bad = [&](const std::string& reason) {
        return Error(Code::BadArgument, fmt::format("the ray '{}': {}", text, reason));
    };
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto point = parseNumbers(text.substr(0, colon), 3);
    const auto along = parseNumbers(text.substr(std::min(colon + 1, text.size())), 3);
    if (!point || !along || point->size() != 3 || along->size() != 3)
        return bad(
            "expected x,y,z:dx,dy,dz, such as 0,2.5,1:1,0,0 (a point in metres from the lower corner, and a "
            "direction)");
    const Vec3d direction{(*along)[0], (*along)[1], (*along)[2]};
    if (!(length(direction) > 0)) return bad("the direction is zero; give one such as 1,0,0");
    const PickRay ray{grid.origin() + Vec3d{(*point)[0], (*point)[1], (*point)[2]}, normalized(direction)};
    if (meetsVoxels(grid.indexFromWorld(ray.origin), grid.indexFromWorldDirection(ray.direction), grid.dimension()))
        return ray;
    const Vec3d size =
        scaled(grid.spacing(), {double(grid.dimension().x), double(grid.dimension().y), double(grid.dimension().z)});
    return bad(
        fmt::format("the ray does not meet the volume, which is {:.3f} x {:.3f} x {:.3f} m", size.x, size.y, size.z));
}

}  // namespace svt::illustrate
