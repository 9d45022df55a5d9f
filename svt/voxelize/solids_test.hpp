#pragma once
/// \file
/// Meshes with known answers, and an exact point-in-solid oracle, for tests of the voxelizer.

#include <svt/mesh/mesh_set.hpp>
#include <svt/mesh/planes.hpp>
#include <svt/mesh/thickness.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace svt::test {

using mesh::ObjectMesh;

inline void addTriangle(ObjectMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh::Triangle triangle;
    triangle.corners = {a, b, c};
    triangle.thickness = std::numeric_limits<float>::infinity();
    mesh.triangles.push_back(triangle);
}

/// Extrudes a plan polygon (counter-clockwise, convex) from z0 to z1.
inline ObjectMesh prism(const std::vector<std::array<double, 2>>& plan, double z0, double z1) {
    ObjectMesh mesh;
    const auto n = static_cast<std::uint32_t>(plan.size());
    for (const double z : {z0, z1})
        for (const auto& p : plan) mesh.vertices.push_back({p[0], p[1], z});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        addTriangle(mesh, i, next, n + next);
        addTriangle(mesh, i, n + next, n + i);
        if (i >= 1 && i + 1 < n) {
            addTriangle(mesh, 0, i + 1, i);
            addTriangle(mesh, n, n + i, n + i + 1);
        }
    }
    mesh.closingMethod = mesh::ClosingMethod::Closed;
    return mesh;
}

inline ObjectMesh box(Vec3d low, Vec3d high) {
    return prism({{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, low.z, high.z);
}

/// A box turned about z by `degrees` around its own middle.
inline ObjectMesh turnedBox(Vec3d low, Vec3d high, double degrees) {
    ObjectMesh mesh = box(low, high);
    const Vec3d center = (low + high) * 0.5;
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    for (Vec3d& v : mesh.vertices) {
        const Vec3d d = v - center;
        v = {center.x + c * d.x - s * d.y, center.y + s * d.x + c * d.y, v.z};
    }
    return mesh;
}

/// A triangulated ball with its vertices on the sphere.
inline ObjectMesh ball(Vec3d center, double radius, int slices = 24) {
    ObjectMesh mesh;
    const int stacks = slices / 2;
    mesh.vertices.push_back(center - Vec3d{0, 0, radius});
    for (int s = 1; s < stacks; ++s)
        for (int t = 0; t < slices; ++t) {
            const double theta = std::numbers::pi * s / stacks - std::numbers::pi / 2,
                         phi = 2 * std::numbers::pi * t / slices;
            mesh.vertices.push_back(center + Vec3d{radius * std::cos(theta) * std::cos(phi),
                                                   radius * std::cos(theta) * std::sin(phi), radius * std::sin(theta)});
        }
    mesh.vertices.push_back(center + Vec3d{0, 0, radius});
    const auto at = [&](int s, int t) { return static_cast<std::uint32_t>(1 + (s - 1) * slices + t % slices); };
    const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (int t = 0; t < slices; ++t) {
        addTriangle(mesh, 0, at(1, t + 1), at(1, t));
        addTriangle(mesh, top, at(stacks - 1, t), at(stacks - 1, t + 1));
        for (int s = 1; s + 1 < stacks; ++s) {
            addTriangle(mesh, at(s, t), at(s, t + 1), at(s + 1, t + 1));
            addTriangle(mesh, at(s, t), at(s + 1, t + 1), at(s + 1, t));
        }
    }
    mesh.closingMethod = mesh::ClosingMethod::Closed;
    return mesh;
}

/// Joins two meshes as shells of one object; `isVoid` turns the second inside out.
inline ObjectMesh join(ObjectMesh a, const ObjectMesh& b, bool isVoid) {
    const auto first = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const mesh::Triangle& t : b.triangles)
        isVoid ? addTriangle(a, first + t.corners[0], first + t.corners[2], first + t.corners[1])
               : addTriangle(a, first + t.corners[0], first + t.corners[1], first + t.corners[2]);
    return a;
}

inline mesh::MeshSet meshSetOf(std::vector<ObjectMesh> objects, Vec3d origin = {}) {
    mesh::MeshSet meshes;
    meshes.origin = origin;
    meshes.objects = std::move(objects);
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        ObjectMesh& object = meshes.objects[o];
        object.feature = o;
        object.bounds = {};
        for (const Vec3d& v : object.vertices) object.bounds.add(v);
        if (object.isSolid()) {
            object.volume = mesh::signedVolume(object.vertices, object.triangles);
            mesh::measureThickness(object);
        }
        meshes.bounds.add(object.bounds);
    }
    mesh::assignPlanes(meshes, 2e-5);
    return meshes;
}

/// Exact point-in-solid test: vertices and point are rounded to a lattice of 1 nm, and a ray is cast in 128-bit
/// integers; if it meets an edge, another direction is tried. Shares no code with the voxelizer.
class SolidOracle {
public:
    explicit SolidOracle(const ObjectMesh& mesh) : mesh_(mesh) {
        for (const Vec3d& v : mesh.vertices) points_.push_back(lattice(v));
    }

    /// Winding number > 0.
    [[nodiscard]] bool contains(Vec3d local) const {
        const Point p = lattice(local);
        for (const Point& step : {Point{1000003, 7919, 104729}, Point{-7919, 1000003, 611953},
                                  Point{104729, -611953, 1000003}, Point{-999983, -15485863 / 16, 32452843 / 64}}) {
            const Point far{p[0] + step[0] * 100000, p[1] + step[1] * 100000, p[2] + step[2] * 100000};
            int winding = 0;
            bool isDegenerate = false;
            for (const mesh::Triangle& t : mesh_.triangles) {
                const Point &a = points_[t.corners[0]], &b = points_[t.corners[1]], &c = points_[t.corners[2]];
                const int sp = orient(a, b, c, p), sf = orient(a, b, c, far);
                if (sp == 0 && sf == 0) continue;
                const int ab = orient(p, far, a, b), bc = orient(p, far, b, c), ca = orient(p, far, c, a);
                const bool mayHit = !((ab < 0 || bc < 0 || ca < 0) && (ab > 0 || bc > 0 || ca > 0));
                if (!mayHit || sp == sf) continue;
                if (ab == 0 || bc == 0 || ca == 0 || sp == 0 || sf == 0) {
                    isDegenerate = true;
                    break;
                }
                winding += sp > sf ? 1 : -1;
            }
            if (!isDegenerate) return winding > 0;
        }
        return false;
    }

    /// Smallest distance to a face in index units (voxels, per-axis scaled), brute force.
    [[nodiscard]] double distance(Vec3d local, Vec3d spacing) const {
        double nearest = 1e300;
        const auto scale = [&](Vec3d v) { return Vec3d{v.x / spacing.x, v.y / spacing.y, v.z / spacing.z}; };
        for (const mesh::Triangle& t : mesh_.triangles)
            nearest = std::min(nearest,
                               pointTriangle(scale(local), scale(mesh_.vertices[t.corners[0]]),
                                             scale(mesh_.vertices[t.corners[1]]), scale(mesh_.vertices[t.corners[2]])));
        return nearest;
    }

private:
    __extension__ using Int = __int128;
    using Point = std::array<std::int64_t, 3>;

    static Point lattice(Vec3d v) {
        return {static_cast<std::int64_t>(std::llround(v.x * 1e9)), static_cast<std::int64_t>(std::llround(v.y * 1e9)),
                static_cast<std::int64_t>(std::llround(v.z * 1e9))};
    }
    static int orient(const Point& a, const Point& b, const Point& c, const Point& d) {
        const Int ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
        const Int bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
        const Int cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
        const Int det = ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
        return det > 0 ? 1 : det < 0 ? -1 : 0;
    }
    static double pointTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
        // Minimum over the three edges and, where the projection falls inside the triangle, the plane.
        const auto segment = [&](Vec3d s, Vec3d e) {
            const Vec3d d = e - s;
            const double l = dot(d, d);
            const double t = l > 0 ? std::clamp(dot(p - s, d) / l, 0.0, 1.0) : 0;
            return length(p - (s + d * t));
        };
        double nearest = std::min({segment(a, b), segment(b, c), segment(c, a)});
        const Vec3d n = cross(b - a, c - a);
        if (length(n) > 0) {
            const double side[3] = {dot(cross(b - a, p - a), n), dot(cross(c - b, p - b), n),
                                    dot(cross(a - c, p - c), n)};
            if (side[0] >= 0 && side[1] >= 0 && side[2] >= 0)
                nearest = std::min(nearest, std::abs(dot(p - a, normalized(n))));
        }
        return nearest;
    }

    const ObjectMesh& mesh_;
    std::vector<Point> points_;
};

}  // namespace svt::test
