#include <svt/mesh/thickness.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace svt::mesh {
namespace {

constexpr std::uint32_t kLeafSize = 4;

// Boxes that the rays of one mesh may be tested against: those of a building take 10 to 200 each. Where thin triangles
// lie across each other's boxes, as in a star of many thousand spikes, each ray meets all of them.
constexpr std::uint64_t kFreeTests = std::uint64_t{1} << 27, kMaxTestsPerFace = 256;

struct Node {
    Box3d box;
    std::uint32_t begin = 0, end = 0;  // faces below the node; tested in leaves
    std::uint32_t right = 0;           // right child of an inner node, whose left child is the next node; 0 for a leaf
};

struct Face {
    Vec3d a, ab, ac, unitNormal, center;
    std::uint32_t triangle;
};

std::uint32_t build(std::vector<Node>& nodes, std::vector<Face>& faces, std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    Box3d box, centers;
    for (std::uint32_t f = begin; f < end; ++f) {
        box.add(faces[f].a);
        box.add(faces[f].a + faces[f].ab);
        box.add(faces[f].a + faces[f].ac);
        centers.add(faces[f].center);
    }
    nodes[index].box = box;
    nodes[index].begin = begin;
    nodes[index].end = end;
    if (end - begin <= kLeafSize) return index;
    const Vec3d size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        faces.begin() + begin, faces.begin() + middle, faces.begin() + end, [axis](const Face& p, const Face& q) {
            return p.center[axis] != q.center[axis] ? p.center[axis] < q.center[axis] : p.triangle < q.triangle;
        });
    build(nodes, faces, begin, middle);
    nodes[index].right = build(nodes, faces, middle, end);
    return index;
}

// Slab test of a ray and a box (Kay & Kajiya 1986).
bool hitsBox(const Box3d& box, Vec3d origin, Vec3d inverse, double nearest) {
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

// Distance along the ray to a triangle, or infinity (Moeller & Trumbore 1997).
double hitFace(const Face& face, Vec3d origin, Vec3d direction) {
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

}  // namespace

void measureThickness(ObjectMesh& mesh) {
    std::vector<Face> faces;
    faces.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle& triangle = mesh.triangles[t];
        triangle.thickness = std::numeric_limits<float>::infinity();
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        const Vec3d ab = mesh.vertices[triangle.corners[1]] - a, ac = mesh.vertices[triangle.corners[2]] - a;
        const Vec3d normal = cross(ab, ac);
        if (length(normal) > 0) faces.push_back({a, ab, ac, normalized(normal), a + (ab + ac) / 3.0, t});
    }
    if (faces.empty()) return;
    std::vector<Node> nodes;
    nodes.reserve(faces.size());
    build(nodes, faces, 0, static_cast<std::uint32_t>(faces.size()));

    std::uint64_t testsLeft = kFreeTests + kMaxTestsPerFace * faces.size();
    std::vector<std::uint32_t> stack;
    for (const Face& face : faces) {
        const Vec3d direction = -face.unitNormal;
        const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
        double nearest = kInfinity;
        stack.assign(1, 0);
        while (!stack.empty()) {
            const std::uint32_t index = stack.back();
            stack.pop_back();
            const Node& node = nodes[index];
            if (testsLeft == 0) return;  // the faces that are left stay unknown, this one too
            --testsLeft;
            if (!hitsBox(node.box, face.center, inverse, nearest)) continue;
            if (node.right != 0) {
                stack.push_back(node.right);
                stack.push_back(index + 1);
                continue;
            }
            for (std::uint32_t f = node.begin; f < node.end; ++f) {
                if (faces[f].triangle == face.triangle || dot(faces[f].unitNormal, face.unitNormal) > -0.7071) continue;
                const double t = hitFace(faces[f], face.center, direction);
                if (t > 1e-7 && t < nearest) nearest = t;
            }
        }
        mesh.triangles[face.triangle].thickness = static_cast<float>(nearest);
    }
}

}  // namespace svt::mesh
