#pragma once
/// \file
/// Open shells for tests: meshes with holes, and the list of their open edges.

#include <svt/voxelize/solids_test.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::test {

/// Marks a mesh as an open solid and lists the edges that are used more often in one direction than in the other.
inline ObjectMesh asOpen(ObjectMesh mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const mesh::Triangle& t : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t from = t.corners[c], to = t.corners[(c + 1) % 3];
            uses[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
        }
    mesh.openEdges.clear();
    for (const auto& [edge, count] : uses)
        for (int n = 0; n < std::abs(count); ++n)
            mesh.openEdges.push_back(count > 0 ? mesh::OpenEdge{edge.first, edge.second}
                                               : mesh::OpenEdge{edge.second, edge.first});
    mesh.closingMethod = mesh.openEdges.empty() ? mesh::ClosingMethod::Closed : mesh::ClosingMethod::Open;
    return mesh;
}

/// The mesh without the triangles for which `isRemoved(number)`.
template <class IsRemoved>
ObjectMesh withoutTriangles(ObjectMesh mesh, IsRemoved&& isRemoved) {
    std::vector<mesh::Triangle> kept;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (!isRemoved(t)) kept.push_back(mesh.triangles[t]);
    mesh.triangles = std::move(kept);
    return asOpen(std::move(mesh));
}

/// A house with a ridge along x over [0, 10] x [0, 8] x [0, 7], its six faces cut into n x n quads each (the gables
/// share the short sides with the walls), turned by `degrees` about z. Every `pitch`-th block of `size` x `size` quads
/// is left out of each face; size 0: closed.
inline ObjectMesh houseWithHoles(int n, int pitch, int size, double degrees = 0) {
    ObjectMesh mesh;
    std::map<std::array<std::int64_t, 3>, std::uint32_t> numbers;
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    const auto numberOf = [&](Vec3d p) {
        const std::array<std::int64_t, 3> key{std::llround(p.x * 1e6), std::llround(p.y * 1e6),
                                              std::llround(p.z * 1e6)};
        const auto [at, isNew] = numbers.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (isNew) mesh.vertices.push_back({c * p.x - s * p.y, s * p.x + c * p.y, p.z});
        return at->second;
    };
    // (u, v) of a face to space; the surface of a cube whose upper side is bent to a roof.
    const auto onHouse = [](Vec3d cube) {
        const double eaves = 4, ridge = 7;
        const double top = eaves + (ridge - eaves) * (1 - std::abs(2 * cube.y - 1));
        return Vec3d{10 * cube.x, 8 * cube.y, cube.z * top};
    };
    const auto corner = [&](int face, int i, int j) {
        const double u = double(i) / n, v = double(j) / n;
        const Vec3d cube[6] = {{u, v, 1}, {v, u, 0}, {u, 0, v}, {1, u, v}, {v, 1, u}, {0, v, u}};
        return numberOf(onHouse(cube[face]));
    };
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const int shift = std::max(1, (pitch - size) / 2);
                if (i % pitch >= shift && i % pitch < shift + size && j % pitch >= shift && j % pitch < shift + size)
                    continue;
                const std::uint32_t q[4] = {corner(face, i, j), corner(face, i + 1, j), corner(face, i + 1, j + 1),
                                            corner(face, i, j + 1)};
                addTriangle(mesh, q[0], q[1], q[2]);
                addTriangle(mesh, q[0], q[2], q[3]);
            }
    return asOpen(std::move(mesh));
}

}  // namespace svt::test
