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

// Whether two cones meet within the volume. They open towards the viewer: if their rims are apart where the volume ends,
// they are apart all the way.
bool meet(const RoundBody& a, const RoundBody& b, const volume::Grid& grid) {
    constexpr int kPlaces = 48;
    const auto hasRimIn = [&](const RoundBody& cone, const RoundBody& other) {
        const Vec3i n = grid.dimension();
        double height = 0;
        for (int c = 0; c < 8; ++c) {
            const Vec3d corner{(c & 1) * n.x - 0.5, ((c >> 1) & 1) * n.y - 0.5, (c >> 2) * n.z - 0.5};
            height = std::max(height, dot(grid.worldFromIndex(corner) - cone.center, cone.axes[2]));
        }
        const Vec3d axis = cone.axes[2] / dot(cone.axes[2], cone.axes[2]);
        const Vec3d u = cone.axes[0] / dot(cone.axes[0], cone.axes[0]),
                    v = cone.axes[1] / dot(cone.axes[1], cone.axes[1]);
        for (int place = 0; place < kPlaces; ++place) {
            const double angle = 2 * std::numbers::pi * place / kPlaces;
            const Vec3d rim = axis + u * std::cos(angle) + v * std::sin(angle);
            for (const double share : {0.02, 0.25, 0.5, 0.75, 1.0})
                if (other.contains(cone.center + rim * (height * share))) return true;
        }
        return false;
    };
    return hasRimIn(a, b) || hasRimIn(b, a);
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

std::vector<RoundBody> cutawayBodies(const Camera& camera, const volume::Grid& grid,
                                     std::vector<analyze::SampleBox> targets, double margin, std::size_t most) {
    constexpr std::size_t kMostTargets = 64;
    if (targets.size() > kMostTargets)
        for (; targets.size() > 1; targets.pop_back()) targets.front().add(targets.back());
    std::vector<RoundBody> bodies;
    for (const auto& target : targets) bodies.push_back(cutawayBody(camera, grid, target, margin));
    const auto join = [&](std::size_t a, std::size_t b) {
        targets[a].add(targets[b]);
        targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(b));
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(b));
        bodies[a] = cutawayBody(camera, grid, targets[a], margin);
    };
    const auto joinAnyThatMeet = [&] {
        for (std::size_t a = 0; a < bodies.size(); ++a)
            for (std::size_t b = a + 1; b < bodies.size(); ++b)
                if (meet(bodies[a], bodies[b], grid)) {
                    join(a, b);
                    return true;
                }
        return false;
    };
    while (joinAnyThatMeet()) {
    }
    while (bodies.size() > most) {
        std::size_t first = 0, second = 1;
        double nearest = length(bodies[1].center - bodies[0].center);
        for (std::size_t a = 0; a < bodies.size(); ++a)
            for (std::size_t b = a + 1; b < bodies.size(); ++b)
                if (const double apart = length(bodies[b].center - bodies[a].center); apart < nearest) {
                    nearest = apart;
                    first = a;
                    second = b;
                }
        join(first, second);
        while (joinAnyThatMeet()) {
        }
    }
    return bodies;
}

}  // namespace svt::illustrate
