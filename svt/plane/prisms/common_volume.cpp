#include <svt/plane/common_volume.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::plane {
namespace {

struct PlanPoint {
    double x, y;
};

// A convex polygon seen from above. Each of four lines adds a corner; if rounding bends a side, up to half as many
// again.
struct PlanPolygon {
    std::array<PlanPoint, 20> points;  // not set beyond `count`
    std::size_t count = 0;

    PlanPolygon() {}  // NOLINT(modernize-use-equals-default): leaves the points as they are, which `{}` would clear

    void add(PlanPoint p) { points[count++] = p; }
};

// Clips a polygon to the part where `valueAt`, a linear function, is positive.
template <class ValueAt>
PlanPolygon clipped(const PlanPolygon& polygon, const ValueAt& valueAt) {
    PlanPolygon kept;
    for (std::size_t n = 0; n < polygon.count; ++n) {
        const PlanPoint p = polygon.points[n], q = polygon.points[(n + 1) % polygon.count];
        const double atP = valueAt(p), atQ = valueAt(q);
        if (atP >= 0) kept.add(p);
        if ((atP >= 0) == (atQ >= 0)) continue;
        const double share = atP / (atP - atQ);
        kept.add({p.x + (q.x - p.x) * share, p.y + (q.y - p.y) * share});
    }
    return kept;
}

// The integral over a polygon of a function that is linear there.
template <class ValueAt>
double integral(const PlanPolygon& polygon, const ValueAt& valueAt) {
    double sum = 0;
    for (std::size_t n = 1; n + 1 < polygon.count; ++n) {
        const PlanPoint o = polygon.points[0], p = polygon.points[n], q = polygon.points[n + 1];
        const double twice = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
        sum += twice * (valueAt(o) + valueAt(p) + valueAt(q));
    }
    return sum / 6;
}

// Whether the whole of `a` lies beyond an edge of `b`: clipping would leave nothing.
bool isBesideEdge(const RoofTriangle& a, const RoofTriangle& b) noexcept {
    for (std::size_t n = 0; n < 3; ++n) {
        const Vec3d p = b.corners[n], way = b.corners[(n + 1) % 3] - p;
        const auto isBeyond = [&](const Vec3d& q) { return way.x * (q.y - p.y) - way.y * (q.x - p.x) < 0; };
        if (isBeyond(a.corners[0]) && isBeyond(a.corners[1]) && isBeyond(a.corners[2])) return true;
    }
    return false;
}

// RoofTriangle::heightAt() for many points.
struct Roof {
    const RoofTriangle& triangle;
    double low, high;

    explicit Roof(const RoofTriangle& of) noexcept : triangle(of) {
        std::tie(low, high) = std::minmax({of.corners[0].z, of.corners[1].z, of.corners[2].z});
    }
    [[nodiscard]] double heightAt(PlanPoint p) const noexcept {
        const Vec3d& corner = triangle.corners[0];
        return std::clamp(corner.z + triangle.slopeX * (p.x - corner.x) + triangle.slopeY * (p.y - corner.y), low,
                          high);
    }
};

// The volume over the ground that lies below both triangles.
double commonPrism(const RoofTriangle& a, const RoofTriangle& b, double ground) {
    if (isBesideEdge(a, b)) return 0;
    PlanPolygon polygon;
    for (const Vec3d& corner : a.corners) polygon.add({corner.x, corner.y});
    for (std::size_t n = 0; n < 3 && polygon.count >= 3; ++n) {
        const Vec3d p = b.corners[n], way = b.corners[(n + 1) % 3] - p;
        polygon = clipped(polygon, [&](PlanPoint q) { return way.x * (q.y - p.y) - way.y * (q.x - p.x); });
    }
    if (polygon.count < 3) return 0;
    const Roof roofA(a), roofB(b);
    const auto aOverB = [&](PlanPoint p) { return roofA.heightAt(p) - roofB.heightAt(p); };
    const double underA = integral(polygon, [&](PlanPoint p) { return roofA.heightAt(p) - ground; });
    const PlanPolygon lower = clipped(polygon, aOverB);
    return lower.count < 3 ? underA : underA - integral(lower, aOverB);
}

// Calls visit(t, u) for all pairs whose extents along x overlap.
template <class Visit>
void forPairs(std::span<const RoofTriangle> a, std::span<const RoofTriangle> b, const Visit& visit) {
    std::vector<const RoofTriangle*> openA, openB;
    const auto drop = [](std::vector<const RoofTriangle*>& open, double x) {
        std::erase_if(open, [&](const RoofTriangle* t) { return t->maxX <= x; });
    };
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        const bool isOfA = j == b.size() || (i < a.size() && a[i].minX <= b[j].minX);
        const RoofTriangle& next = isOfA ? a[i++] : b[j++];
        std::vector<const RoofTriangle*>& others = isOfA ? openB : openA;
        drop(others, next.minX);
        for (const RoofTriangle* other : others) isOfA ? visit(next, *other) : visit(*other, next);
        (isOfA ? openA : openB).push_back(&next);
    }
}

}  // namespace

double RoofTriangle::heightAt(double x, double y) const noexcept {
    const auto [low, high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
    return std::clamp(corners[0].z + slopeX * (x - corners[0].x) + slopeY * (y - corners[0].y), low, high);
}

bool makeRoofTriangle(const std::array<Vec3d, 3>& corners, RoofTriangle& triangle) {
    const Vec3d twice = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(std::abs(twice.z) > 1e-12 * length(twice))) return false;
    triangle.corners = corners;
    triangle.sign = twice.z > 0 ? 1 : -1;
    if (twice.z < 0) std::swap(triangle.corners[1], triangle.corners[2]);
    triangle.slopeX = -twice.x / twice.z;
    triangle.slopeY = -twice.y / twice.z;
    std::tie(triangle.minX, triangle.maxX) = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    std::tie(triangle.minY, triangle.maxY) = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    return true;
}

std::uint64_t comparisons(std::span<const RoofTriangle> a, std::span<const RoofTriangle> b) {
    // All pairs, except those where one ends before the other begins.
    std::vector<double> endsA, endsB;
    for (const RoofTriangle& t : a) endsA.push_back(t.maxX);
    for (const RoofTriangle& t : b) endsB.push_back(t.maxX);
    std::sort(endsA.begin(), endsA.end());
    std::sort(endsB.begin(), endsB.end());
    std::uint64_t apart = 0;
    const auto count = [&](std::span<const RoofTriangle> begins, const std::vector<double>& ends) {
        for (const RoofTriangle& t : begins)
            apart += static_cast<std::uint64_t>(std::upper_bound(ends.begin(), ends.end(), t.minX) - ends.begin());
    };
    count(a, endsB);
    count(b, endsA);
    return std::uint64_t{a.size()} * b.size() - std::min(apart, std::uint64_t{a.size()} * b.size());
}

double commonVolume(std::span<const RoofTriangle> a, std::span<const RoofTriangle> b, double ground) {
    double sum = 0;
    forPairs(a, b, [&](const RoofTriangle& t, const RoofTriangle& u) {
        if (t.maxY <= u.minY || u.maxY <= t.minY) return;
        sum += t.sign * u.sign * commonPrism(t, u, ground);
    });
    return sum;
}

}  // namespace svt::plane
