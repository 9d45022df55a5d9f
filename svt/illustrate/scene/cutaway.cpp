#include <svt/illustrate/scene/cutaway.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace svt::illustrate {
namespace {

using render::Camera;
using render::RoundBody;

// Slopes of adjacent openings, from the widest: tan 25, 12 and 4 degrees.
constexpr double kNarrowest = 0.0699;
constexpr double kSlopes[] = {kCutawaySlope, 0.2126, kNarrowest};

struct View {
    Vec3d forward, right, up;
};

View makeView(const Camera& camera) {
    const Vec3d forward = normalized(camera.target - camera.eye);
    const Vec3d right = normalized(cross(forward, normalized(camera.up)));
    return {forward, right, cross(right, forward)};
}

std::array<Vec3d, 8> cornersOf(const analyze::SampleBox& box, const volume::Grid& grid) {
    std::array<Vec3d, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) {
        Vec3d index;
        for (int axis = 0; axis < 3; ++axis)
            index[axis] = (c >> axis & 1u) != 0 ? box.max[axis] + 0.5 : box.min[axis] - 0.5;
        corners[c] = grid.worldFromIndex(index);
    }
    return corners;
}

// Whether two cones meet within the volume: whether points on the rim of one are in the other.
bool meet(const RoundBody& a, const RoundBody& b, const volume::Grid& grid) {
    constexpr int kPlaces = 48, kHeights = 32;
    const Vec3d half{0.5, 0.5, 0.5}, end = toDouble(grid.dimension()) - half;
    const auto isInVolume = [&](Vec3d point) {
        const Vec3d index = grid.indexFromWorld(point);
        return index.x > -0.5 && index.y > -0.5 && index.z > -0.5 && index.x < end.x && index.y < end.y &&
               index.z < end.z;
    };
    const auto hasRimIn = [&](const RoundBody& cone, const RoundBody& other) {
        double height = 0;
        for (int c = 0; c < 8; ++c)
            height = std::max(height, dot(grid.worldFromIndex({(c & 1) != 0 ? end.x : -0.5, (c & 2) != 0 ? end.y : -0.5,
                                                               (c & 4) != 0 ? end.z : -0.5}) -
                                              cone.center,
                                          cone.axes[2]));
        const Vec3d axis = cone.axes[2] / dot(cone.axes[2], cone.axes[2]);
        const Vec3d u = cone.axes[0] / dot(cone.axes[0], cone.axes[0]),
                    v = cone.axes[1] / dot(cone.axes[1], cone.axes[1]);
        for (int place = 0; place < kPlaces; ++place) {
            const double angle = 2 * std::numbers::pi * place / kPlaces;
            const Vec3d rim = axis + u * std::cos(angle) + v * std::sin(angle);
            for (int n = 1; n <= kHeights; ++n) {
                const Vec3d point = cone.center + rim * (height * n / kHeights);
                if (isInVolume(point) && other.contains(point)) return true;
            }
        }
        return false;
    };
    return hasRimIn(a, b) || hasRimIn(b, a);
}

// A box of targets and the space in front of it, between planes of sight through its outline. Objects behind, beside
// and below it stay.
render::ConvexPart shadowPart(const Camera& camera, const volume::Grid& grid, const analyze::SampleBox& target,
                              double margin) {
    const bool isPerspective = camera.projection == Camera::Projection::Perspective;
    const View view = makeView(camera);
    const std::array<Vec3d, 8> corners = cornersOf(target, grid);
    const std::array<Vec3d, 3> axes = grid.axes();
    const auto face = [&](int axis, bool isUpper) {
        const Vec3d point = corners[isUpper ? std::size_t{1} << axis : 0];
        const Vec3d normal = isUpper ? axes[std::size_t(axis)] : -axes[std::size_t(axis)];
        return render::HalfSpace{normal, -dot(normal, point)};
    };
    const auto isSeen = [&](int axis, bool isUpper) {
        const render::HalfSpace f = face(axis, isUpper);
        return isPerspective ? dot(f.normal, camera.eye) + f.offset > 0 : dot(f.normal, view.forward) < 0;
    };
    Vec3d middle{};
    for (const Vec3d& corner : corners) middle = middle + corner / 8;
    render::ConvexPart sight;
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (int n = 0; n < 4; ++n) {  // edges along the axis
            const bool isUpperB = (n & 1) != 0, isUpperC = (n & 2) != 0;
            if (isSeen(b, isUpperB) == isSeen(c, isUpperC)) continue;
            const Vec3d from = corners[std::size_t(isUpperB) << b | std::size_t(isUpperC) << c];
            const Vec3d along = axes[std::size_t(axis)], away = isPerspective ? from - camera.eye : view.forward;
            Vec3d inward = normalized(cross(along, away));
            if (dot(inward, middle - from) < 0) inward = -inward;
            const bool isBelow = inward.z > 0.3;
            const Vec3d normal = isBelow ? inward : inward - view.forward * kNarrowest;
            double least = std::numeric_limits<double>::infinity();  // so that all corners are within
            for (const Vec3d& corner : corners) least = std::min(least, dot(normal, corner));
            sight.halfSpaces.push_back({normal, (isBelow ? 0 : margin) - least});
        }
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const bool isUpper : {false, true})
            if (!isSeen(axis, isUpper)) {
                // Inside the targets by a fraction of a voxel, so that objects that touch them there are not cut.
                const render::HalfSpace behind = face(axis, isUpper);
                const Vec3d spacing = grid.spacing();
                const double inset = 0.3 * std::min({spacing.x, spacing.y, spacing.z});
                sight.halfSpaces.push_back({-behind.normal, -behind.offset - inset});
            }
    return sight;
}

// Openings of targets.
class Openings {
public:
    Openings(const Camera& camera, const volume::Grid& grid, std::vector<analyze::SampleBox> targets, double margin,
             double slope)
        : camera_(camera), grid_(grid), margin_(margin), slope_(slope), targets_(std::move(targets)) {
        for (const auto& target : targets_) bodies_.push_back(bodyOf(target));
        isGroup_.assign(targets_.size(), false);
    }

    [[nodiscard]] bool areApart() const {
        std::size_t a = 0, b = 0;
        return !findMeeting(a, b);
    }
    // Targets that stand in the opening of another one share it.
    void joinShared() {
        while (joinAny()) {
        }
    }
    // Openings that meet become one, until all are apart: no longer a cone, which would take all around it.
    void joinMeeting() {
        std::size_t a = 0, b = 1;
        while (findMeeting(a, b)) joinAsGroup(a, b);
    }
    void joinToAtMost(std::size_t most) {
        while (bodies_.size() > most) {
            const auto [a, b] = nearest();
            join(a, b);
            joinShared();
        }
    }
    // Narrow openings reach far behind their targets, where nothing hides them: they end there.
    [[nodiscard]] std::vector<render::ConvexPart> parts(bool endBehind) const {
        std::vector<render::ConvexPart> parts;
        for (std::size_t n = 0; n < bodies_.size(); ++n) {
            if (isGroup_[n]) {
                parts.push_back(shadowPart(camera_, grid_, targets_[n], margin_));
                continue;
            }
            render::ConvexPart& part = parts.emplace_back();
            part.rounds.push_back(bodies_[n]);
            if (!endBehind) continue;
            const Vec3d normal = bodies_[n].axes[2];
            double farthest = std::numeric_limits<double>::infinity();
            for (const Vec3d& corner : cornersOf(targets_[n], grid_))
                farthest = std::min(farthest, dot(corner, normal));
            part.halfSpaces.push_back({normal, margin_ * length(normal) - farthest});
        }
        return parts;
    }

private:
    [[nodiscard]] RoundBody bodyOf(const analyze::SampleBox& target) const {
        return cutawayBody(camera_, grid_, target, margin_, slope_);
    }
    [[nodiscard]] Vec3d middleOf(std::size_t n) const {
        return grid_.worldFromIndex((toDouble(targets_[n].min) + toDouble(targets_[n].max)) * 0.5);
    }
    // The first two openings that meet; false: there are none.
    bool findMeeting(std::size_t& first, std::size_t& second) const {
        for (std::size_t a = 0; a < bodies_.size(); ++a)
            for (std::size_t b = a + 1; b < bodies_.size(); ++b)
                if (meet(bodies_[a], bodies_[b], grid_)) {
                    first = a;
                    second = b;
                    return true;
                }
        return false;
    }
    void join(std::size_t a, std::size_t b) {
        targets_[a].add(targets_[b]);
        targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(b));
        bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(b));
        bodies_[a] = bodyOf(targets_[a]);
        isGroup_[a] = isGroup_[a] || isGroup_[b];
        isGroup_.erase(isGroup_.begin() + static_cast<std::ptrdiff_t>(b));
    }
    void joinAsGroup(std::size_t a, std::size_t b) {
        join(a, b);
        isGroup_[a] = true;
    }
    bool joinAny() {
        for (std::size_t a = 0; a < bodies_.size(); ++a)
            for (std::size_t b = a + 1; b < bodies_.size(); ++b)
                if (bodies_[a].contains(middleOf(b)) && bodies_[b].contains(middleOf(a))) {
                    join(a, b);
                    return true;
                }
        return false;
    }
    [[nodiscard]] std::pair<std::size_t, std::size_t> nearest() const {
        std::pair<std::size_t, std::size_t> found{0, 1};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < bodies_.size(); ++a)
            for (std::size_t b = a + 1; b < bodies_.size(); ++b)
                if (const double apart = length(middleOf(b) - middleOf(a)); apart < least) {
                    least = apart;
                    found = {a, b};
                }
        return found;
    }

    const Camera& camera_;
    const volume::Grid& grid_;
    double margin_, slope_;
    std::vector<analyze::SampleBox> targets_;
    std::vector<RoundBody> bodies_;
    std::vector<bool> isGroup_;  // targets whose openings met
};

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

RoundBody cutawayBody(const Camera& camera, const volume::Grid& grid, const analyze::SampleBox& target, double margin,
                      double slope) {
    const std::array<Vec3d, 8> corners = cornersOf(target, grid);
    Vec3d middle{};
    for (const Vec3d& corner : corners) middle = middle + corner / 8;
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
        const double tip = larger / (slope + (distance > 0 ? larger / distance : 0));
        return RoundBody::cone(middle + away * tip, -away, right * (scale * across / tip), up * (scale * high / tip));
    };
    double scale = 1;
    const auto isAround = [&](const RoundBody& cone) {
        return std::all_of(corners.begin(), corners.end(), [&](Vec3d corner) { return cone.contains(corner); });
    };
    while (scale < 16 && !isAround(coneOf(scale))) scale *= 1.05;
    return coneOf(scale);
}

std::vector<render::ConvexPart> cutawayParts(const Camera& camera, const volume::Grid& grid,
                                             std::vector<analyze::SampleBox> targets, double margin, std::size_t most) {
    constexpr std::size_t kMostTargets = 64;
    const bool isCrowd = targets.size() > kMostTargets;
    if (isCrowd)
        for (; targets.size() > 1; targets.pop_back()) targets.front().add(targets.back());
    // As wide as keeps all apart.
    for (const double slope : kSlopes) {
        if (isCrowd) break;
        Openings openings(camera, grid, targets, margin, slope);
        openings.joinShared();
        openings.joinToAtMost(most);
        if (openings.areApart()) return openings.parts(slope != kCutawaySlope);
    }
    if (isCrowd) return {shadowPart(camera, grid, targets.front(), margin)};
    Openings openings(camera, grid, std::move(targets), margin, kNarrowest);
    openings.joinShared();
    openings.joinToAtMost(most);
    openings.joinMeeting();
    return openings.parts(true);
}

}  // namespace svt::illustrate
