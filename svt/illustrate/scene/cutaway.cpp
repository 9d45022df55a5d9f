#include <svt/illustrate/scene/cutaway.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::illustrate {
namespace {

using render::Camera;
using render::RoundBody;

struct View {
    Vec3d forward, right, up;
};

View makeView(const Camera& camera) {
    const Vec3d forward = normalized(camera.target - camera.eye);
    const Vec3d right = normalized(cross(forward, normalized(camera.up)));
    return {forward, right, cross(right, forward)};
}

}  // namespace

RoundBody viewBody(const Camera& camera, double aspect, double x, double y, double radius) {
    const View view = makeView(camera);
    const double u = (2 * x - 1) * aspect, v = 1 - 2 * y;
    if (camera.projection == Camera::Projection::Orthographic) {
        const double half = camera.orthographicHeight / 2;
        return RoundBody::cylinder(camera.eye + view.right * (u * half) + view.up * (v * half), view.forward,
                                   2 * radius * half);
    }
    const double half = std::tan(camera.verticalFovDegrees * std::numbers::pi / 360);
    // Lines of sight through the circle's centre and rim; away from the picture's centre the cone is slightly elliptic.
    const auto lineAt = [&](double du, double dv) {
        return view.forward + view.right * ((u + du) * half) + view.up * ((v + dv) * half);
    };
    const Vec3d axis = normalized(lineAt(0, 0));
    const auto slopeTo = [&](double du, double dv) {
        const Vec3d line = lineAt(du, dv);
        const double along = dot(line, axis);
        return length(line - axis * along) / along;
    };
    const Vec3d across = normalized(view.right - axis * dot(view.right, axis));
    return RoundBody::cone(camera.eye, axis, across * slopeTo(2 * radius, 0),
                           cross(axis, across) * slopeTo(0, 2 * radius));
}

RoundBody cutawayBody(const Camera& camera, const volume::Grid& grid, const analyze::SampleBox& target, double margin) {
    std::array<Vec3d, 8> corners;
    Vec3d middle{};
    for (std::size_t c = 0; c < 8; ++c) {
        Vec3d index;
        for (int axis = 0; axis < 3; ++axis)
            index[axis] = (c >> axis & 1u) != 0 ? target.max[axis] + 0.5 : target.min[axis] - 0.5;
        corners[c] = grid.worldFromIndex(index);
        middle = middle + corners[c] / 8;
    }
    const bool isPerspective = camera.projection == Camera::Projection::Perspective;
    const View view = makeView(camera);
    const Vec3d away = isPerspective ? normalized(middle - camera.eye) : view.forward;
    const Vec3d right = normalized(view.right - away * dot(view.right, away)), up = cross(right, away);
    // Half extents of all corners, as seen.
    double across = margin, high = margin;
    for (const Vec3d& corner : corners) {
        across = std::max(across, std::abs(dot(corner - middle, right)) + margin);
        high = std::max(high, std::abs(dot(corner - middle, up)) + margin);
    }
    // For narrow targets, limit the aspect ratio, so that the cone is not a slit.
    const double least = 0.35 * std::max(across, high);
    across = std::max(across, least);
    high = std::max(high, least);
    const double distance = isPerspective ? length(middle - camera.eye) : 0;
    // A cone with these half-axes at the target's centre, times `scale`. The scale is increased until the cone contains
    // all corners, also the far ones, where it is narrower.
    const auto coneOf = [&](double scale) {
        const double larger = scale * std::max(across, high);
        const double tip = larger / (kCutawaySlope + (distance > 0 ? larger / distance : 0));
        return RoundBody::cone(middle + away * tip, -away, right * (scale * across / tip), up * (scale * high / tip));
    };
    double scale = 1;
    const auto isAround = [&](const RoundBody& cone) {
        return std::all_of(corners.begin(), corners.end(), [&](Vec3d corner) { return cone.contains(corner); });
    };
    while (scale < 16 && !isAround(coneOf(scale))) scale *= 1.05;
    return coneOf(scale);
}

}  // namespace svt::illustrate
