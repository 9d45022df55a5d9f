#include <svt/readers/ifc_shape/sweeps.hpp>

#include <svt/readers/ifc_shape/curves.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::readers::ifc {
namespace {

using Polygons = std::vector<model::Polygon>;
using Ring = std::vector<Vec3d>;

constexpr int kDiskSegments = 24;  // minimum for the section of a bar

Ring reversed(Ring ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
}

// Caps at both ends of a sweep.
void addCaps(const Region& bottom, const Region& top, Polygons& faces) {
    std::vector<Ring> low{reversed(bottom.outer)}, high{top.outer};
    for (const Ring& hole : bottom.holes) low.push_back(reversed(hole));
    for (const Ring& hole : top.holes) high.push_back(hole);
    addFace(faces, low);
    addFace(faces, high);
}

void addSides(const Ring& bottom, const Ring& top, Polygons& faces) {
    for (std::size_t i = 0; i < bottom.size(); ++i) {
        const std::size_t j = (i + 1) % bottom.size();
        addQuad(faces, bottom[i], bottom[j], top[j], top[i]);
    }
}

void addSides(const Region& bottom, const Region& top, Polygons& faces) {
    addSides(bottom.outer, top.outer, faces);
    for (std::size_t h = 0; h < bottom.holes.size(); ++h) addSides(bottom.holes[h], top.holes[h], faces);
}

// The body through sections of the same corners; a closed one, which ends with its first section, has no caps.
Polygons skin(const std::vector<Region>& sections, bool isClosed) {
    Polygons faces;
    for (std::size_t s = 1; s < sections.size(); ++s) addSides(sections[s - 1], sections[s], faces);
    if (!isClosed) addCaps(sections.front(), sections.back(), faces);
    if (enclosedVolume(faces) < 0) turnOver(faces);
    return faces;
}

// Points of a ring turned about an axis; those on the axis stay exactly.
Ring turned(const Ring& ring, const Transform& axis, double angle) {
    const auto [sine, cosine] = sineCosine(angle);
    Ring result;
    for (const Vec3d p : ring) {
        const Vec3d local = p - axis.origin;
        const double along = dot(local, axis.z);
        const Vec3d across = local - axis.z * along;
        if (length(across) < 1e-7)
            result.push_back(axis.origin + axis.z * along);
        else
            result.push_back(axis.origin + axis.z * along + across * cosine + cross(axis.z, across) * sine);
    }
    return result;
}

// The ring of a bar at a bend, on the plane that halves the angle.
Ring mitre(const Ring& before, Vec3d at, Vec3d direction, Vec3d next) {
    const Vec3d sum = direction + next;
    const Vec3d normal = length(sum) > 1e-6 ? normalized(sum) : direction;
    const double along = std::max(dot(direction, normal), 0.05);
    Ring ring;
    for (const Vec3d p : before) ring.push_back(p + direction * (dot(at - p, normal) / along));
    return ring;
}

// The part of a vector across a direction.
Vec3d across(Vec3d v, Vec3d direction) noexcept { return v - direction * dot(v, direction); }

// A ring that is turned about the bar, within its plane.
Ring spun(const Ring& ring, Vec3d at, Vec3d direction, Vec3d normal, double angle) {
    const auto [sine, cosine] = sineCosine(angle);
    const double along = std::max(dot(direction, normal), 0.05);
    Ring result;
    for (const Vec3d p : ring) {
        const Vec3d flat = across(p - at, direction);
        const Vec3d turned = flat * cosine + cross(direction, flat) * sine;
        result.push_back(at + turned - direction * (dot(turned, normal) / along));
    }
    return result;
}

// Rings that were carried around a closed line come back turned by an angle. Whole corners of it are a shift of the corners,
// and all rings share the rest.
void closeRings(std::vector<Ring>& rings, const Ring& line) {
    const std::size_t n = line.size(), count = rings.front().size();
    const auto directionOf = [&](std::size_t s) { return normalized(line[(s + 1) % n] - line[s % n]); };
    const Vec3d first = directionOf(0), a = across(rings.front()[0] - line[0], first),
                b = across(rings.back()[0] - line[0], first);
    const double step = 2 * kPi / double(count), angle = std::atan2(dot(first, cross(a, b)), dot(a, b));
    const double corners = std::round(angle / step), rest = angle - corners * step;
    double whole = 0, passed = 0;
    for (std::size_t s = 0; s < n; ++s) whole += length(line[(s + 1) % n] - line[s]);
    for (std::size_t s = 1; s < n; ++s) {
        passed += length(line[s] - line[s - 1]);
        const Vec3d before = directionOf(s - 1), sum = before + directionOf(s);
        const Vec3d normal = length(sum) > 1e-6 ? normalized(sum) : before;
        rings[s] = spun(rings[s], line[s], before, normal, -rest * passed / whole);
    }
    const auto shift = static_cast<std::size_t>(corners + double(count)) % count;
    for (std::size_t i = 0; i < count; ++i) rings.back()[i] = rings.front()[(i + shift) % count];
}

// Rings of a tube along a line; the last has the corners of the first if the line is closed.
std::vector<Ring> tube(const Ring& line, bool isClosed, double radius) {
    const std::size_t n = line.size();
    const auto directionOf = [&](std::size_t segment) {
        return normalized(line[(segment + 1) % n] - line[segment % n]);
    };
    const Vec3d first = directionOf(0);
    const Transform axes = axesFrom(line[0], first, {0.3, 0.5, 0.8});
    const int count = std::min(arcSegments(radius, 2 * kPi, kDiskSegments), kMaxDiskSegments);
    // Corners lie outside of the circle, so that the polygon has the area of the circle.
    const double step = 2 * kPi / count, outwards = radius * std::sqrt(step / std::sin(step));
    Ring ring;
    for (int i = 0; i < count; ++i) {
        const auto [sine, cosine] = sineCosine(step * i);
        ring.push_back(axes.point({outwards * cosine, outwards * sine, 0}));
    }
    std::vector<Ring> rings;
    if (isClosed) ring = mitre(ring, line[0], first, directionOf(n - 1));
    rings.push_back(ring);
    const std::size_t segments = isClosed ? n : n - 1;
    for (std::size_t s = 0; s < segments; ++s) {
        const bool isEnd = !isClosed && s + 1 == segments;
        rings.push_back(
            mitre(rings.back(), line[(s + 1) % n], directionOf(s), isEnd ? directionOf(s) : directionOf(s + 1)));
    }
    if (isClosed) closeRings(rings, line);
    return rings;
}

void addTube(const std::vector<Ring>& rings, Polygons& faces) {
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) addSides(rings[r], rings[r + 1], faces);
}

}  // namespace

Polygons extrude(const Region& region, Vec3d sweep) { return extrudeTapered(region, region, sweep); }

Polygons extrudeTapered(const Region& region, const Region& end, Vec3d sweep) {
    if (!(std::abs(sweep.z) > 1e-9) || !region.hasCornersOf(end)) return {};
    const Region top = end.mapped([&](Ring ring) {
        for (Vec3d& p : ring) p = p + sweep;
        return ring;
    });
    Polygons faces;
    addCaps(region, top, faces);
    addSides(region, top, faces);
    if (!(sweep.z > 0)) turnOver(faces);
    return faces;
}

Polygons revolve(const Region& region, const Transform& axis, double angle) {
    double reach = 0;
    for (const Vec3d p : region.outer) reach = std::max(reach, length(cross(p - axis.origin, axis.z)));
    const bool isWhole = std::abs(angle) >= 2 * kPi - 1e-9;
    if (isWhole) angle = angle > 0 ? 2 * kPi : -2 * kPi;
    const int count = arcSegments(reach, angle);
    if (std::abs(angle) < 1e-9) return {};
    std::vector<Region> sections;
    for (int step = 0; step <= count; ++step) {
        const double turn = isWhole && step == count ? 0 : angle * step / count;
        sections.push_back(region.mapped([&](const Ring& ring) { return turned(ring, axis, turn); }));
    }
    return skin(sections, isWhole);
}

Polygons sweepDisk(Ring line, double radius, double inner) {
    const bool isClosed = line.size() > 3 && length(line.front() - line.back()) < 1e-6;
    closeRing(line, 1e-6);
    if (line.size() < 2 || !(radius > 0)) return {};
    const std::vector<Ring> outside = tube(line, isClosed, radius);
    Polygons faces;
    addTube(outside, faces);
    const bool isHollow = inner > 0 && inner < radius;
    if (isHollow) {
        Polygons inside;
        const std::vector<Ring> rings = tube(line, isClosed, inner);
        addTube(rings, inside);
        turnOver(inside);
        faces.insert(faces.end(), inside.begin(), inside.end());
        if (!isClosed) {
            addFace(faces, {reversed(outside.front()), rings.front()});
            addFace(faces, {outside.back(), reversed(rings.back())});
        }
    } else if (!isClosed) {
        addFace(faces, {reversed(outside.front())});
        addFace(faces, {outside.back()});
    }
    return faces;
}

Polygons sweepAlong(const Region& region, Ring line, Vec3d reference) {
    const bool isClosed = line.size() > 3 && length(line.front() - line.back()) < 1e-6;
    closeRing(line, 1e-6);
    const std::size_t n = line.size(), segments = isClosed ? n : n - 1;
    if (n < 2) return {};
    const auto axesOf = [&](std::size_t segment) {
        return axesFrom({}, line[(segment + 1) % n] - line[segment % n], reference);
    };
    // A ring of the profile at a corner of the line, on the plane that halves the angle between two segments. Where the
    // line winds, both segments put a point at different places; the middle between these is taken.
    const auto ringAt = [&](const Ring& profile, std::size_t corner) {
        const bool isFirst = !isClosed && corner == 0, isLast = !isClosed && corner == segments;
        const Transform before = axesOf(isFirst ? 0 : (corner + n - 1) % n),
                        after = axesOf(isLast ? n - 2 : corner % n);
        const Transform low = isFirst ? after : before, high = isLast ? before : after;
        const Vec3d sum = low.z + high.z, normal = length(sum) > 1e-6 ? normalized(sum) : low.z;
        const double along = std::max(dot(low.z, normal), 0.05);
        Ring ring;
        for (const Vec3d p : profile) {
            const Vec3d a = low.direction({p.x, p.y, 0}), b = high.direction({p.x, p.y, 0});
            ring.push_back(line[corner % n] +
                           (a - low.z * (dot(a, normal) / along) + b - high.z * (dot(b, normal) / along)) / 2);
        }
        return ring;
    };
    std::vector<Region> sections;
    for (std::size_t corner = 0; corner < n; ++corner)
        sections.push_back(region.mapped([&](const Ring& ring) { return ringAt(ring, corner); }));
    if (isClosed) sections.push_back(sections.front());
    return skin(sections, isClosed);
}

Polygons loft(const std::vector<Region>& sections) {
    if (sections.size() < 2) return {};
    for (const Region& section : sections)
        if (!section.hasCornersOf(sections[0])) return {};
    return skin(sections, false);
}

Polygons block(Vec3d size) {
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) return {};
    return extrude({{{0, 0, 0}, {size.x, 0, 0}, {size.x, size.y, 0}, {0, size.y, 0}}, {}}, {0, 0, size.z});
}

Polygons pyramid(double x, double y, double height) {
    if (!(x > 0 && y > 0 && height > 0)) return {};
    const Ring base{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}};
    Polygons faces;
    addFace(faces, {reversed(base)});
    for (std::size_t i = 0; i < 4; ++i) addFace(faces, {{base[i], base[(i + 1) % 4], {x / 2, y / 2, height}}});
    return faces;
}

Polygons cone(double radius, double top, double height) {
    if (!(radius > 0 && height > 0)) return {};
    Ring low, high;
    appendArc({}, radius, radius, 0, 2 * kPi, low);
    low.pop_back();
    for (const Vec3d p : low) high.push_back({p.x * (top / radius), p.y * (top / radius), height});
    Polygons faces;
    addFace(faces, {reversed(low)});
    addSides(low, high, faces);
    if (top > 0) addFace(faces, {high});
    return faces;
}

Polygons sphere(double radius) {
    if (!(radius > 0)) return {};
    Transform axis;
    axis.z = {0, 1, 0};
    Region half;
    appendArc({}, radius, radius, -kPi / 2, kPi / 2, half.outer);
    half.outer.front() = {0, -radius, 0};
    half.outer.back() = {0, radius, 0};
    return revolve(half, axis, 2 * kPi);
}

}  // namespace svt::readers::ifc
