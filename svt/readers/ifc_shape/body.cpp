#include <svt/readers/ifc_shape/body.hpp>

#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/welder.hpp>

#include <algorithm>
#include <map>

namespace svt::readers::ifc {
namespace {

constexpr double kFlat = 1e-6;

void turnRing(model::Polygon& face, std::size_t begin, std::size_t end) {
    std::reverse(face.points.begin() + std::ptrdiff_t(begin), face.points.begin() + std::ptrdiff_t(end));
}

template <class Visit>
void forEachRing(const model::Polygon& face, Visit&& visit) {
    std::size_t begin = 0;
    for (const std::uint32_t end : face.ringEnds) {
        visit(begin, std::size_t(end));
        begin = end;
    }
}

// Edges that remain after opposite ones cancelled, with the number of those from the lower id to the higher.
using EdgeCounts = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void dropMatched(EdgeCounts& counts) {
    std::erase_if(counts, [](const auto& entry) { return entry.second == 0; });
}

// Cuts unmatched edges at the ends of other unmatched edges on them. Cost: quadratic in the number of unmatched edges.
EdgeCounts cutAtPoints(const EdgeCounts& counts, const std::vector<Vec3d>& points) {
    EdgeCounts cut;
    std::vector<std::uint32_t> ends;
    for (const auto& [edge, count] : counts) {
        ends.push_back(edge.first);
        ends.push_back(edge.second);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const auto& [edge, count] : counts) {
        const Vec3d a = points[edge.first], ab = points[edge.second] - a;
        const double size = dot(ab, ab);
        std::vector<std::pair<double, std::uint32_t>> on{{0, edge.first}, {1, edge.second}};
        for (const std::uint32_t end : ends) {
            if (end == edge.first || end == edge.second) continue;
            const double share = dot(points[end] - a, ab) / size;
            if (share > 0 && share < 1 && length(points[end] - (a + ab * share)) < 1e-5) on.emplace_back(share, end);
        }
        std::sort(on.begin(), on.end());
        for (std::size_t i = 0; i + 1 < on.size(); ++i) {
            const std::uint32_t p = on[i].second, q = on[i + 1].second;
            if (p != q) cut[std::minmax(p, q)] += p < q ? count : -count;
        }
    }
    dropMatched(cut);
    return cut;
}

}  // namespace

void addFace(std::vector<model::Polygon>& faces, const std::vector<std::vector<Vec3d>>& rings) {
    model::Polygon face;
    for (std::size_t r = 0; r < rings.size(); ++r) {
        std::vector<Vec3d> ring = rings[r];
        closeRing(ring);
        if (ring.size() < 3) {
            if (r == 0) return;
            continue;
        }
        face.points.insert(face.points.end(), ring.begin(), ring.end());
        face.ringEnds.push_back(static_cast<std::uint32_t>(face.points.size()));
    }
    if (!face.ringEnds.empty()) faces.push_back(std::move(face));
}

void addQuad(std::vector<model::Polygon>& faces, Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    const Vec3d normal = normalized(cross(c - a, d - b));
    if (std::abs(dot(normal, b - a)) + std::abs(dot(normal, d - a)) + std::abs(dot(normal, c - a)) <= kFlat)
        return addFace(faces, {{a, b, c, d}});
    addFace(faces, {{a, b, c}});
    addFace(faces, {{a, c, d}});
}

std::vector<model::Polygon> transformed(const std::vector<model::Polygon>& faces, const Transform& transform) {
    std::vector<model::Polygon> result = faces;
    for (model::Polygon& face : result)
        for (Vec3d& p : face.points) p = transform.point(p);
    if (transform.determinant() < 0) turnOver(result);
    return result;
}

Body transformed(const Body& body, const Transform& transform) {
    return {transformed(body.faces, transform), body.isSolid, body.material};
}

void turnOver(std::vector<model::Polygon>& faces) {
    for (model::Polygon& face : faces)
        forEachRing(face, [&](std::size_t begin, std::size_t end) { turnRing(face, begin, end); });
}

double enclosedVolume(const std::vector<model::Polygon>& faces) noexcept {
    if (faces.empty() || faces.front().points.empty()) return 0;
    const Vec3d origin = faces.front().points.front();
    double sum = 0;
    for (const model::Polygon& face : faces)
        forEachRing(face, [&](std::size_t begin, std::size_t end) {
            const Vec3d a = face.points[begin] - origin;
            for (std::size_t i = begin + 1; i + 1 < end; ++i)
                sum += dot(a, cross(face.points[i] - origin, face.points[i + 1] - origin));
        });
    return sum / 6;
}

bool isClosed(const std::vector<model::Polygon>& faces) {
    if (faces.size() < 4) return false;
    Welder welder(1e-6);
    EdgeCounts counts;
    for (const model::Polygon& face : faces)
        forEachRing(face, [&](std::size_t begin, std::size_t end) {
            std::uint32_t last = welder.add(face.points[end - 1]);
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t next = welder.add(face.points[i]);
                if (last != next) counts[std::minmax(last, next)] += last < next ? 1 : -1;
                last = next;
            }
        });
    dropMatched(counts);
    constexpr std::size_t kMaxCut = 4000;
    for (int pass = 0; pass < 2 && !counts.empty() && counts.size() < kMaxCut; ++pass)
        counts = cutAtPoints(counts, welder.points());
    return counts.empty();
}

Vec3d newellNormal(const model::Polygon& face) noexcept {
    return plane::newellNormal(std::span(face.points).first(face.ringEnds.empty() ? 0 : face.ringEnds.front()));
}

std::uint64_t pointCount(const std::vector<model::Polygon>& faces) noexcept {
    std::uint64_t count = 0;
    for (const model::Polygon& face : faces) count += face.points.size();
    return count;
}

Box3d boundsOf(const std::vector<model::Polygon>& faces) noexcept {
    Box3d box;
    for (const model::Polygon& face : faces)
        for (const Vec3d p : face.points) box.add(p);
    return box;
}

}  // namespace svt::readers::ifc
