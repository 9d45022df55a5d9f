#include <svt/render/light/cell_edges.hpp>

#include <svt/image/color.hpp>
#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

constexpr double kStrength = 0.7;
// Cells of this many pixels have no edges yet, and full ones from the second on.
constexpr double kTooSmall = 3, kLargeEnough = 8;

}  // namespace

void drawCellEdges(const PreparedFrame& frame, std::size_t pass, double u, double v, Sample& sample) noexcept {
    if (!sample.hasHit()) return;
    const volume::Grid& grid = frame.volumeOf(pass).grid;
    const double depth = static_cast<double>(sample.depth), pixel = frame.rays().pixelSize(depth);
    const Vec3d point = grid.indexFromWorld(frame.rays().worldAt(u, v, depth)) + Vec3d{0.5, 0.5, 0.5};
    const Vec3d normal{sample.normal.x, sample.normal.y, sample.normal.z};
    const double facing = std::max(std::abs(dot(normal, frame.rays().forward())), kLeastCapFacing);
    double ink = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d across = grid.axes()[static_cast<std::size_t>(axis)];
        // Along the face, a voxel has the length spacing / slope in the direction of this axis.
        const double slope = std::sqrt(std::max(0.0, 1 - dot(normal, across) * dot(normal, across)));
        if (slope < 0.1) continue;
        const double size = grid.spacing()[axis] / slope;
        const double away = std::abs(point[axis] - std::floor(point[axis] + 0.5)) * size;
        // At a grazing angle a pixel covers more of the face.
        const double line = std::clamp(1.2 - away / (pixel / std::sqrt(facing)), 0.0, 1.0);
        const double fade = std::clamp((size * facing / pixel - kTooSmall) / (kLargeEnough - kTooSmall), 0.0, 1.0);
        ink = std::max(ink, line * fade);
    }
    const auto share = static_cast<float>(ink * kStrength);
    sample.color =
        sample.color * (1 - share) + image::linearFromSrgb(frame.spec.borders.color) * (share * sample.alpha);
}

}  // namespace svt::render
