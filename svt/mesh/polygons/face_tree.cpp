#include <svt/mesh/polygons/face_tree.hpp>

#include <algorithm>

namespace svt::mesh {
namespace {

constexpr std::uint64_t kFreeTests = std::uint64_t{1} << 25, kMaxTestsPerFace = 256;

std::vector<RayFace> makeRayFaces(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) {
    std::vector<RayFace> faces;
    faces.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const Vec3d a = vertices[triangles[t].corners[0]];
        const Vec3d ab = vertices[triangles[t].corners[1]] - a, ac = vertices[triangles[t].corners[2]] - a;
        const Vec3d normal = cross(ab, ac);
        if (length(normal) > 0) faces.push_back({a, ab, ac, normalized(normal), a + (ab + ac) / 3.0, t});
    }
    return faces;
}

std::vector<Box3d> boxesOf(const std::vector<RayFace>& faces) {
    std::vector<Box3d> boxes(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const Vec3d& corner : {faces[f].a, faces[f].a + faces[f].ab, faces[f].a + faces[f].ac})
            boxes[f].add(corner);
    return boxes;
}

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

FaceTree::FaceTree(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles)
    : faces_(makeRayFaces(vertices, triangles)),
      tree_(boxesOf(faces_)),
      testsLeft_(kFreeTests + kMaxTestsPerFace * faces_.size()) {}

}  // namespace svt::mesh
