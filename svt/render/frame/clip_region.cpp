#include <svt/render/clip_region.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

Vec3d anyAcross(Vec3d unit) {
    const Vec3d other = std::abs(unit.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
    return normalized(cross(other, unit));
}

bool isHalfSpace(const HalfSpace& half) {
    return isFinite(half.normal) && length(half.normal) > 0 && std::isfinite(half.offset);
}

bool isRoundBody(const RoundBody& round) {
    const auto& [x, y, z] = round.axes;
    return isFinite(round.center) && isFinite(x) && isFinite(y) && isFinite(z) && length(cross(x, y)) > 0 &&
           (round.kind == RoundBody::Kind::Cylinder || std::abs(dot(cross(x, y), z)) > 0);
}

}  // namespace

RoundBody RoundBody::ball(Vec3d center, double radius) {
    return {Kind::Ball, center, {Vec3d{1 / radius, 0, 0}, Vec3d{0, 1 / radius, 0}, Vec3d{0, 0, 1 / radius}}};
}

RoundBody RoundBody::cylinder(Vec3d point, Vec3d axis, double radius) {
    const Vec3d along = normalized(axis), u = anyAcross(along);
    return {Kind::Cylinder, point, {u / radius, cross(along, u) / radius, along}};
}

RoundBody RoundBody::cone(Vec3d tip, Vec3d axis, Vec3d u, Vec3d v) {
    return {Kind::Cone, tip, {u / dot(u, u), v / dot(v, v), normalized(axis)}};
}

bool RoundBody::contains(Vec3d p) const noexcept {
    const Vec3d from = p - center;
    const Vec3d d{dot(axes[0], from), dot(axes[1], from), dot(axes[2], from)};
    const double across = d.x * d.x + d.y * d.y;
    switch (kind) {
        case Kind::Ball: return across + d.z * d.z < 1;
        case Kind::Cylinder: return across < 1;
        case Kind::Cone: break;
    }
    return across < d.z * d.z && d.z > 0;
}

Vec3d RoundBody::normalAt(Vec3d p) const noexcept {
    const Vec3d from = p - center;
    const double along = kind == Kind::Ball ? 1 : kind == Kind::Cylinder ? 0 : -1;
    return normalized(axes[0] * dot(axes[0], from) + axes[1] * dot(axes[1], from) +
                      axes[2] * (along * dot(axes[2], from)));
}

ClipRegion ClipRegion::plane(Vec3d normal, Vec3d point) {
    const Vec3d unit = normalized(normal);
    return {{{{HalfSpace{unit, -dot(unit, point)}}, {}}}, Mode::CutAway};
}

ClipRegion ClipRegion::box(const Box3d& box, Mode mode) {
    return {{boxPart({}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}, box.min, box.max)}, mode};
}

ConvexPart boxPart(Vec3d origin, const std::array<Vec3d, 3>& axes, Vec3d low, Vec3d high) {
    ConvexPart part;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d along = axes[static_cast<std::size_t>(axis)];
        const double at = dot(along, origin);
        part.halfSpaces.push_back({along, -(at + low[axis])});
        part.halfSpaces.push_back({-along, at + high[axis]});
    }
    return part;
}

Result<void> checkClip(const ClipRegion& clip, const std::string& place) {
    if (clip.parts.empty()) return Error(Code::BadFrame, place + ": a clip without a part");
    for (const ConvexPart& part : clip.parts) {
        const std::size_t faces = part.halfSpaces.size() + part.rounds.size();
        if (faces == 0 || faces > ConvexPart::kMaxFaces)
            return Error(Code::BadFrame, fmt::format("{}: a clip of {} faces is out of range; 1 to {} are possible",
                                                     place, faces, ConvexPart::kMaxFaces));
        if (!std::all_of(part.halfSpaces.begin(), part.halfSpaces.end(), isHalfSpace))
            return Error(Code::BadFrame, place + ": a clip plane has a zero normal or is not finite");
        if (!std::all_of(part.rounds.begin(), part.rounds.end(), isRoundBody))
            return Error(Code::BadFrame, place + ": a round clip is flat or not finite");
    }
    return {};
}

}  // namespace svt::render
