#include <svt/render/clip_intervals.hpp>

#include <algorithm>
#include <cmath>

namespace svt::render {
namespace {

// Transforms a covector from world to voxel space: the gradient of dot(direction, p) with respect to voxel coordinates.
Vec3d inVoxels(Vec3d direction, const volume::Grid& grid) {
    Vec3d result;
    for (int axis = 0; axis < 3; ++axis)
        result[axis] = dot(direction, grid.axes()[static_cast<std::size_t>(axis)]) * grid.spacing()[axis];
    return result;
}

}  // namespace

Clipper::Clipper(std::span<const ClipRegion> clips, const volume::Grid& grid) {
    for (const ClipRegion& clip : clips) {
        Region region{{}, clip.mode, clip.gap};
        for (const ConvexPart& convex : clip.parts) {
            Part part;
            for (const HalfSpace& half : convex.halfSpaces) {
                // Voxel space is index space plus one half.
                const Vec3d normal = inVoxels(half.normal, grid);
                part.planes.push_back(
                    {normal, half.offset + dot(half.normal, grid.origin()) - normal.x / 2 - normal.y / 2 - normal.z / 2,
                     &half});
            }
            for (const RoundBody& round : convex.rounds) {
                RoundBody body{round.kind, grid.indexFromWorld(round.center) + Vec3d{0.5, 0.5, 0.5}, {}};
                for (std::size_t row = 0; row < 3; ++row) body.axes[row] = inVoxels(round.axes[row], grid);
                part.rounds.push_back({body, &round});
            }
            region.parts.push_back(std::move(part));
        }
        regions_.push_back(std::move(region));
    }
}

// Intersects the interval with [from, to], whose ends are on `face`.
void Clipper::PartInterval::meet(double from, double to, CapFace face) noexcept {
    if (from > enter) {
        enter = from;
        enterFace = face;
    }
    if (to < exit) {
        exit = to;
        exitFace = face;
    }
}

// Intersects the interval with a round body: the solutions of a t^2 + 2 b t + c < 0; of a cone, only one nappe.
void Clipper::meetRound(const Round& round, const Line& line, PartInterval& inside) noexcept {
    const RoundBody& body = round.body;
    const Vec3d from = line.origin - body.center;
    const auto inFrame = [&](Vec3d v) {
        return Vec3d{dot(body.axes[0], v), dot(body.axes[1], v), dot(body.axes[2], v)};
    };
    const Vec3d o = inFrame(from), d = inFrame(line.direction);
    const double along = body.kind == RoundBody::Kind::Ball ? 1 : body.kind == RoundBody::Kind::Cylinder ? 0 : -1;
    const double a = d.x * d.x + d.y * d.y + along * d.z * d.z;
    const double b = o.x * d.x + o.y * d.y + along * o.z * d.z;
    const double c = o.x * o.x + o.y * o.y + along * o.z * o.z - (along < 0 ? 0 : 1);
    const CapFace face{nullptr, round.source};
    if (a == 0) {
        // Parallel to a cylinder's axis or to a generator of a cone.
        if (b == 0 ? !(c < 0) : along >= 0) return inside.meet(kInfinity, -kInfinity, face);
        const double t = b == 0 ? 0 : -c / (2 * b);
        const double low = b > 0 ? -kInfinity : b < 0 ? t : -kInfinity, high = b > 0 ? t : kInfinity;
        if (along < 0 && !(o.z + d.z * (b == 0 ? 0 : t + (b > 0 ? -1 : 1)) > 0))
            return inside.meet(kInfinity, -kInfinity, face);
        return inside.meet(low, high, face);
    }
    const double square = b * b - a * c;
    // Without two roots the line misses the body. But with a < 0 it always meets the cone: its roots coincide only at
    // the apex.
    if (!(square > 0) && !(a < 0)) return inside.meet(kInfinity, -kInfinity, face);
    // The root of larger magnitude first; the other from it, without cancellation.
    const double sum = -(b + std::copysign(std::sqrt(std::max(square, 0.0)), b));
    double t0 = sum / a, t1 = sum != 0 ? c / sum : t0;
    if (t1 < t0) std::swap(t0, t1);
    if (a < 0) return d.z > 0 ? inside.meet(t1, kInfinity, face) : inside.meet(-kInfinity, t0, face);
    if (along < 0 && !(o.z + d.z * (t0 + t1) / 2 > 0)) return inside.meet(kInfinity, -kInfinity, face);
    inside.meet(t0, t1, face);
}

Clipper::PartInterval Clipper::within(const Part& part, const Line& line) noexcept {
    PartInterval inside{-kInfinity, kInfinity, {}, {}};
    for (const Plane& plane : part.planes) {
        const double at = dot(plane.normal, line.origin) + plane.offset;
        const double slope = dot(plane.normal, line.direction);
        const CapFace face{plane.source, nullptr};
        if (slope == 0)
            inside.meet(-kInfinity, at > 0 ? kInfinity : -kInfinity, face);
        else if (slope > 0)
            inside.meet(-at / slope, kInfinity, face);
        else
            inside.meet(-kInfinity, -at / slope, face);
    }
    for (const Round& round : part.rounds) meetRound(round, line, inside);
    return inside;
}

// Finds the intervals inside any part of a region, merged and ascending. Returns their count.
std::size_t Clipper::within(const Region& region, const Line& line, PartIntervals& insides) noexcept {
    std::size_t count = 0;
    for (const Part& part : region.parts) {
        const PartInterval inside = within(part, line);
        if (!(inside.enter < inside.exit)) continue;
        std::size_t at = count++;
        for (; at > 0 && insides[at - 1].enter > inside.enter; --at) insides[at] = insides[at - 1];
        insides[at] = inside;
    }
    std::size_t kept = 0;
    for (std::size_t n = 0; n < count; ++n) {
        if (kept == 0 || insides[n].enter > insides[kept - 1].exit) {
            insides[kept++] = insides[n];
        } else if (insides[n].exit > insides[kept - 1].exit) {
            insides[kept - 1].exit = insides[n].exit;
            insides[kept - 1].exitFace = insides[n].exitFace;
        }
    }
    return kept;
}

// The gap between two of the `count` intervals inside a region; empty if there is no such gap.
DrawnInterval Clipper::inGap(const DrawnInterval& interval, const Region& region, const PartIntervals& insides,
                             std::size_t count) noexcept {
    DrawnInterval gap = interval;
    if (region.gap > count) return {0, 0, {}};
    if (region.gap > 0 && insides[region.gap - 1].exit > gap.from)
        gap = {insides[region.gap - 1].exit, gap.to, insides[region.gap - 1].exitFace};
    if (region.gap < count) gap.to = std::min(gap.to, insides[region.gap].enter);
    return gap;
}

DrawnIntervals Clipper::cut(Vec3d origin, Vec3d direction, RaySpan span) const noexcept {
    const Line line{origin, direction};
    DrawnIntervals drawn;
    drawn.add({span.from, span.to, {}});
    PartIntervals insides;
    for (const Region& region : regions_) {
        if (drawn.isEmpty()) break;
        const std::size_t count = within(region, line, insides);
        DrawnIntervals next;
        for (const DrawnInterval& interval : drawn) {
            if (region.mode == ClipRegion::Mode::Gap) {
                next.add(inGap(interval, region, insides, count));
                continue;
            }
            DrawnInterval rest = interval;
            for (std::size_t n = 0; n < count; ++n) {
                const PartInterval& inside = insides[n];
                if (inside.exit <= rest.from) continue;
                if (region.mode == ClipRegion::Mode::KeepOnly) {
                    DrawnInterval kept = rest;
                    if (inside.enter > kept.from) kept = {inside.enter, rest.to, inside.enterFace};
                    kept.to = std::min(kept.to, inside.exit);
                    next.add(kept);
                } else {
                    next.add({rest.from, std::min(rest.to, inside.enter), rest.cap});
                    rest = {inside.exit, rest.to, inside.exitFace};
                }
            }
            if (region.mode == ClipRegion::Mode::CutAway) next.add(rest);
        }
        drawn = next;
    }
    return drawn;
}

bool Clipper::keeps(Vec3d point) const noexcept {
    return std::all_of(regions_.begin(), regions_.end(), [&](const Region& region) {
        if (region.mode == ClipRegion::Mode::Gap) return true;
        const bool isInside = std::any_of(region.parts.begin(), region.parts.end(), [&](const Part& part) {
            return std::all_of(part.planes.begin(), part.planes.end(),
                               [&](const Plane& plane) { return dot(plane.normal, point) + plane.offset > 0; }) &&
                   std::all_of(part.rounds.begin(), part.rounds.end(),
                               [&](const Round& round) { return round.body.contains(point); });
        });
        return isInside == (region.mode == ClipRegion::Mode::KeepOnly);
    });
}

}  // namespace svt::render
