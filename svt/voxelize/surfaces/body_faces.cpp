#include <svt/voxelize/surfaces/body_faces.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::voxelize {
namespace {

// The triangles of a mesh that come from polygons of the model, by polygon.
std::vector<const mesh::Triangle*> trianglesByPolygon(const mesh::ObjectMesh& body) {
    std::vector<const mesh::Triangle*> sorted;
    sorted.reserve(body.triangles.size());
    for (const mesh::Triangle& triangle : body.triangles)
        if (triangle.polygon != mesh::kNoPolygon) sorted.push_back(&triangle);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const mesh::Triangle* p, const mesh::Triangle* q) { return p->polygon < q->polygon; });
    return sorted;
}

// The triangles of one polygon.
std::span<const mesh::Triangle* const> polygonTriangles(std::span<const mesh::Triangle* const> sorted,
                                                        model::PolygonIndex polygon) {
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), polygon,
                                        [](const mesh::Triangle* t, model::PolygonIndex n) { return t->polygon < n; });
    const auto last = std::upper_bound(first, sorted.end(), polygon,
                                       [](model::PolygonIndex n, const mesh::Triangle* t) { return n < t->polygon; });
    return sorted.subspan(std::size_t(first - sorted.begin()), std::size_t(last - first));
}

Vec3d faceNormal(const mesh::ObjectMesh& mesh, const mesh::Triangle& triangle) {
    const Vec3d a = mesh.vertices[triangle.corners[0]];
    return cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a);
}

// The mesh of a surface with the triangles of the body in place of its own. Their orientation is that of the surface.
mesh::ObjectMesh facesOnBody(const mesh::ObjectMesh& surface, const mesh::ObjectMesh& body,
                             std::span<const mesh::Triangle* const> ofBody) {
    mesh::ObjectMesh faces;
    faces.vertices = surface.vertices;
    std::map<model::PolygonIndex, Vec3d> normals;  // of polygons that the body has
    for (const mesh::Triangle& triangle : surface.triangles) {
        const bool isOfBody =
            triangle.polygon != mesh::kNoPolygon && !polygonTriangles(ofBody, triangle.polygon).empty();
        if (isOfBody)
            normals[triangle.polygon] = normals[triangle.polygon] + faceNormal(surface, triangle);
        else
            faces.triangles.push_back(triangle);
    }
    for (const auto& [polygon, normal] : normals)
        for (const mesh::Triangle* const known : polygonTriangles(ofBody, polygon)) {
            mesh::Triangle triangle = *known;
            if (dot(faceNormal(body, triangle), normal) < 0) std::swap(triangle.corners[1], triangle.corners[2]);
            for (std::uint32_t& corner : triangle.corners) {
                faces.vertices.push_back(body.vertices[corner]);
                corner = static_cast<std::uint32_t>(faces.vertices.size() - 1);
            }
            faces.triangles.push_back(triangle);
        }
    return faces;
}

}  // namespace

std::vector<BoundedBody> findBoundedBodies(const mesh::MeshSet& meshes, std::span<const ObjectClaim> claims) {
    std::vector<std::uint32_t> surfaces;
    for (std::uint32_t o = 0; o < claims.size(); ++o)
        if (claims[o].body != kNoBody && meshes.objects[o].closingMethod == mesh::ClosingMethod::Surface)
            surfaces.push_back(o);
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [&](std::uint32_t p, std::uint32_t q) { return claims[p].body < claims[q].body; });
    std::vector<BoundedBody> bodies;
    for (const std::uint32_t o : surfaces) {
        if (bodies.empty() || bodies.back().body != claims[o].body) bodies.push_back({claims[o].body, {}});
        bodies.back().surfaces.push_back(o);
    }
    return bodies;
}

std::vector<mesh::ObjectMesh> makeBodyFaces(const mesh::MeshSet& meshes, std::span<const BoundedBody> bodies,
                                            int threads) {
    std::vector<mesh::ObjectMesh> faces(meshes.objects.size());
    parallelFor(bodies.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const mesh::ObjectMesh& body = meshes.objects[bodies[n].body];
            const std::vector<const mesh::Triangle*> sorted = trianglesByPolygon(body);
            for (const std::uint32_t o : bodies[n].surfaces) faces[o] = facesOnBody(meshes.objects[o], body, sorted);
        }
    });
    return faces;
}

}  // namespace svt::voxelize
