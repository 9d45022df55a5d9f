#include <svt/core/parallel.hpp>
#include <svt/mesh/thickness.hpp>

#include <svt/mesh/polygons/face_tree.hpp>

#include <limits>

namespace svt::mesh {

void measureThickness(ObjectMesh& mesh, double limit) {
    for (Triangle& triangle : mesh.triangles) triangle.thickness = std::numeric_limits<float>::infinity();
    FaceTree tree(mesh.vertices, mesh.triangles);
    for (const RayFace& face : tree.faces()) {
        const Vec3d direction = -face.unitNormal;
        double nearest = limit;
        tree.forEachNear(face.center, direction, nearest, [&](const RayFace& other) {
            if (other.triangle == face.triangle || dot(other.unitNormal, face.unitNormal) > -0.7071) return;
            const double t = hitFace(other, face.center, direction);
            if (t > 1e-7 && t < nearest) nearest = t;
        });
        if (tree.isExhausted()) return;  // the remaining faces stay unknown, also this one
        if (nearest < limit) mesh.triangles[face.triangle].thickness = static_cast<float>(nearest);
    }
}

void measureThickness(MeshSet& meshes, double limit, int threads) {
    parallelFor(meshes.objects.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (meshes.objects[i].isSolid()) measureThickness(meshes.objects[i], limit);
    });
}

}  // namespace svt::mesh
