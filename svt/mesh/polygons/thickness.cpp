#include <svt/mesh/thickness.hpp>

#include <svt/mesh/polygons/face_tree.hpp>

#include <limits>

namespace svt::mesh {

void measureThickness(ObjectMesh& mesh) {
    for (Triangle& triangle : mesh.triangles) triangle.thickness = std::numeric_limits<float>::infinity();
    FaceTree tree(mesh.vertices, mesh.triangles);
    for (const RayFace& face : tree.faces()) {
        const Vec3d direction = -face.unitNormal;
        double nearest = kInfinity;
        tree.forEachNear(face.center, direction, nearest, [&](const RayFace& other) {
            if (other.triangle == face.triangle || dot(other.unitNormal, face.unitNormal) > -0.7071) return;
            const double t = hitFace(other, face.center, direction);
            if (t > 1e-7 && t < nearest) nearest = t;
        });
        if (tree.isExhausted()) return;  // the faces that are left stay unknown, this one too
        mesh.triangles[face.triangle].thickness = static_cast<float>(nearest);
    }
}

}  // namespace svt::mesh
