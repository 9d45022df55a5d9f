#include <svt/mesh/polygons/face_tree.hpp>

#include <algorithm>

namespace svt::mesh {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

double hitFace(const RayFace& face, Vec3d origin, Vec3d direction) noexcept {
    const Vec3d p = cross(direction, face.ac);
    const double determinant = dot(face.ab, p);
    if (determinant == 0) return kInfinity;
    const Vec3d s = origin - face.a;
    const double u = dot(s, p) / determinant;
    if (!(u >= -1e-9 && u <= 1 + 1e-9)) return kInfinity;
    const Vec3d q = cross(s, face.ab);
    const double v = dot(direction, q) / determinant;
    if (!(v >= -1e-9 && u + v <= 1 + 1e-9)) return kInfinity;
    return dot(face.ac, q) / determinant;
}

FaceTree::FaceTree(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) {
    faces_.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const Vec3d a = vertices[triangles[t].corners[0]];
        const Vec3d ab = vertices[triangles[t].corners[1]] - a, ac = vertices[triangles[t].corners[2]] - a;
        const Vec3d normal = cross(ab, ac);
        if (length(normal) > 0) faces_.push_back({a, ab, ac, normalized(normal), a + (ab + ac) / 3.0, t});
    }
    if (faces_.empty()) return;
    nodes_.reserve(faces_.size());
    build(0, static_cast<std::uint32_t>(faces_.size()));
}

std::uint32_t FaceTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box3d box, centers;
    for (std::uint32_t f = begin; f < end; ++f) {
        box.add(faces_[f].a);
        box.add(faces_[f].a + faces_[f].ab);
        box.add(faces_[f].a + faces_[f].ac);
        centers.add(faces_[f].center);
    }
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (end - begin <= kLeafSize) return index;
    const Vec3d size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
                     [axis](const RayFace& p, const RayFace& q) {
                         return p.center[axis] != q.center[axis] ? p.center[axis] < q.center[axis]
                                                                 : p.triangle < q.triangle;
                     });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[index].right = right;
    return index;
}

// Slab test of a ray and a box (Kay & Kajiya 1986).
bool FaceTree::hitsBox(const Box3d& box, Vec3d origin, Vec3d inverse, double nearest) noexcept {
    double low = 0, high = nearest;
    for (int axis = 0; axis < 3; ++axis) {
        const double t0 = (box.min[axis] - origin[axis]) * inverse[axis];
        const double t1 = (box.max[axis] - origin[axis]) * inverse[axis];
        // NaN (0 * inf, for a ray in a face of the slab) leaves the bounds unchanged.
        low = std::max(low, std::min(t0, t1) == std::min(t0, t1) ? std::min(t0, t1) : low);
        high = std::min(high, std::max(t0, t1) == std::max(t0, t1) ? std::max(t0, t1) : high);
    }
    return low <= high * (1 + 1e-12) + 1e-12;
}

}  // namespace svt::mesh
