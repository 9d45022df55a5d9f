#include <svt/quantities/touch/mesh_sections.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace svt::quantities {
namespace {

Box3d boxAround(const std::array<Vec3d, 3>& corners) {
    Box3d box;
    for (const Vec3d& corner : corners) box.add(corner);
    return box;
}

// Where an edge passes height 0: the same to the last bit from both triangles that share the edge.
Vec3d passing(Vec3d p, double atP, Vec3d q, double atQ) {
    if (q < p) {
        std::swap(p, q);
        std::swap(atP, atQ);
    }
    return p + (q - p) * (atP / (atP - atQ));
}

}  // namespace

SectionPlane SectionPlane::across(Vec3d normal, Vec3d origin) noexcept {
    const Vec3d axis = std::abs(normal.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    const Vec3d u = normalized(cross(axis, normal));
    return {origin, u, cross(normal, u), normal};
}

std::array<Vec3d, 3> MeshSections::cornersOf(const volume::VectorParts::Triangle& triangle) const noexcept {
    const volume::VectorParts& parts = volume_.vectors;
    return {parts.position(triangle.corners[0], {}), parts.position(triangle.corners[1], {}),
            parts.position(triangle.corners[2], {})};
}

// Divides the triangles of a label into bodies. \param parent  by point, any values
void MeshSections::addBodies(std::span<const volume::VectorParts::Triangle> triangles,
                             std::vector<std::uint32_t>& parent) {
    const auto rootOf = [&](std::uint32_t n) {
        while (parent[n] != n) n = parent[n] = parent[parent[n]];
        return n;
    };
    for (const auto& triangle : triangles)
        for (const std::uint32_t point : triangle.corners) parent[point] = point;
    for (const auto& triangle : triangles)
        for (std::size_t n = 1; n < 3; ++n) parent[rootOf(triangle.corners[0])] = rootOf(triangle.corners[n]);
    std::map<std::uint32_t, std::size_t> bodyOf;  // by root
    for (const auto& triangle : triangles) {
        const auto [at, isNew] = bodyOf.try_emplace(rootOf(triangle.corners[0]), bodies_.size());
        if (isNew) bodies_.push_back({triangle.label, {}, {}});
        bodies_[at->second].triangles.push_back(triangle);
    }
}

MeshSections::MeshSections(const volume::SemanticVolume& volume)
    : volume_(volume), isClosed_(volume.labels.labels.size(), 0) {
    const std::span<const volume::VectorParts::Triangle> triangles = volume.vectors.triangles;
    std::vector<std::uint32_t> parent(volume.vectors.points.size());
    for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
        const std::uint32_t label = triangles[begin].label;
        while (end < triangles.size() && triangles[end].label == label) ++end;
        if (!volume::hasClosedMesh(volume.labels.labels[label].filling)) continue;
        isClosed_[label] = 1;
        addBodies(triangles.subspan(begin, end - begin), parent);
    }
    std::vector<Box3d> boxes;
    for (Body& body : bodies_) {
        std::vector<Box3d> own;
        Box3d around;
        for (const auto& triangle : body.triangles) {
            own.push_back(boxAround(cornersOf(triangle)));
            around.add(own.back());
        }
        body.tree = plane::BoxTree(std::move(own));
        boxes.push_back(around);
    }
    boxes_ = plane::BoxTree(std::move(boxes));
}

std::optional<std::vector<std::uint32_t>> MeshSections::bodiesNear(const Box3d& box, std::size_t most) const {
    std::vector<std::uint32_t> found;
    const bool areMore = boxes_.visit([&](const Box3d& other) { return other.overlaps(box); },
                                      [&](std::uint32_t body) {
                                          found.push_back(body);
                                          return found.size() > most;
                                      });
    if (areMore) return std::nullopt;
    std::sort(found.begin(), found.end());
    return found;
}

void MeshSections::addSection(std::uint32_t body, const SectionPlane& plane, std::uint32_t claim,
                              std::vector<FlatSegment>& segments) const {
    const Vec3d n = plane.normal;
    const auto heightOf = [&](Vec3d p) { return dot(p - plane.origin, n); };
    const auto isCut = [&](const Box3d& box) {
        const Vec3d half = (box.max - box.min) * 0.5;
        const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
        return std::abs(heightOf(box.center())) <= reach + 1e-9;
    };
    const auto& triangles = bodies_[body].triangles;
    bodies_[body].tree.forEach(isCut, [&](std::uint32_t t) {
        const std::array<Vec3d, 3> c = cornersOf(triangles[t]);
        const std::array<double, 3> at{heightOf(c[0]), heightOf(c[1]), heightOf(c[2])};
        // Counter-clockwise from outside, an edge of the triangle that rises begins the segment.
        FlatSegment segment{{}, {}, claim};
        int found = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3;
            if ((at[a] > 0) == (at[b] > 0)) continue;
            (at[b] > 0 ? segment.to : segment.from) = plane.flat(passing(c[a], at[a], c[b], at[b]));
            ++found;
        }
        if (found == 2 && segment.from != segment.to) segments.push_back(segment);
    });
}

double MeshSections::hitAt(std::uint32_t body, Vec3d from, Vec3d way) const {
    double first = 2;
    Box3d box;
    box.add(from);
    box.add(from + way);
    const auto& triangles = bodies_[body].triangles;
    bodies_[body].tree.forEach(box, [&](std::uint32_t t) {
        const std::array<Vec3d, 3> c = cornersOf(triangles[t]);
        const Vec3d ab = c[1] - c[0], ac = c[2] - c[0], across = cross(way, ac);
        const double turn = dot(ab, across);
        if (turn == 0) return;
        const Vec3d s = from - c[0], q = cross(s, ab);
        const double u = dot(s, across) / turn, v = dot(way, q) / turn, at = dot(ac, q) / turn;
        if (u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1) first = std::min(first, at);
    });
    return first;
}

}  // namespace svt::quantities
