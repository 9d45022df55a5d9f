#pragma once
/// \file
/// Small handmade building models, for tests of the meshes and of the steps after them.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/building_model.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace svt::test {

using Ring = std::vector<Vec3d>;

/// Adds a polygon with an exterior ring and holes.
inline model::PolygonIndex addRings(model::BuildingModel& model, const std::vector<Ring>& rings) {
    model::Polygon polygon;
    for (const Ring& ring : rings) {
        polygon.points.insert(polygon.points.end(), ring.begin(), ring.end());
        polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
    }
    polygon.id = "polygon-" + std::to_string(model.polygons.size());
    return model.addPolygon(std::move(polygon));
}

/// Sides of a box, in the order in which boxRing() numbers them.
enum Side : int { kBottom, kTop, kSouth, kEast, kNorth, kWest };

/// One side of the box as a ring, counter-clockwise from outside.
inline Ring boxRing(Vec3d low, Vec3d high, int side) {
    const auto at = [&](int i) {
        return Vec3d{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    };
    static constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    Ring ring;
    for (const int corner : kCorners[side]) ring.push_back(at(corner));
    return ring;
}

/// Adds polygons for all sides of the box except those in `without`, and returns their uses.
inline std::vector<model::SurfaceUse> addBox(model::BuildingModel& model, Vec3d low, Vec3d high,
                                             const std::vector<int>& without = {}) {
    std::vector<model::SurfaceUse> uses;
    for (int side = 0; side < 6; ++side)
        if (std::find(without.begin(), without.end(), side) == without.end())
            uses.push_back({addRings(model, {boxRing(low, high, side)}), false});
    return uses;
}

inline model::Geometry solidOf(std::vector<model::SurfaceUse> uses, double lod = 3) {
    model::Geometry geometry;
    geometry.kind = model::GeometryKind::Solid;
    geometry.lod = lod;
    geometry.solids.push_back({"", std::move(uses), {}});
    return geometry;
}

inline model::Geometry surfaceOf(std::vector<model::SurfaceUse> uses, double lod = 3) {
    model::Geometry geometry;
    geometry.lod = lod;
    geometry.surfaces = std::move(uses);
    return geometry;
}

inline model::FeatureIndex addFeature(model::BuildingModel& model, const std::string& className, const std::string& id,
                                      model::FeatureIndex parent = model::kNoFeature,
                                      std::vector<model::Geometry> geometries = {}) {
    model::Feature feature;
    feature.id = id;
    feature.className = className;
    feature.geometries = std::move(geometries);
    return model.addFeature(std::move(feature), parent);
}

/// A feature whose solid is a box.
inline model::FeatureIndex addBoxFeature(model::BuildingModel& model, const std::string& className,
                                         const std::string& id, Vec3d low, Vec3d high,
                                         model::FeatureIndex parent = model::kNoFeature) {
    return addFeature(model, className, id, parent, {solidOf(addBox(model, low, high))});
}

/// The mesh of the feature with this id, or null.
inline const mesh::ObjectMesh* meshOf(const model::BuildingModel& model, const mesh::MeshSet& meshes,
                                      const std::string& id) {
    for (const mesh::ObjectMesh& object : meshes.objects)
        if (model.features[object.feature].id == id) return &object;
    return nullptr;
}

/// Triangles from corner indices.
inline std::vector<mesh::Triangle> trianglesOf(const std::vector<std::array<std::uint32_t, 3>>& corners) {
    std::vector<mesh::Triangle> triangles(corners.size());
    for (std::size_t t = 0; t < corners.size(); ++t) triangles[t].corners = corners[t];
    return triangles;
}

/// A mesh of rings of vertex indices, each triangulated as a fan.
inline mesh::ObjectMesh meshOfRings(std::vector<Vec3d> vertices, const std::vector<std::vector<std::uint32_t>>& rings) {
    mesh::ObjectMesh mesh;
    mesh.vertices = std::move(vertices);
    for (const auto& ring : rings)
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            mesh::Triangle triangle;
            triangle.corners = {ring[0], ring[i], ring[i + 1]};
            mesh.triangles.push_back(triangle);
        }
    return mesh;
}

/// Closed box; vertex i has high x, y, z where bits 0, 1, 2 of i are set.
inline mesh::ObjectMesh boxMesh(Vec3d low, Vec3d high) {
    std::vector<Vec3d> vertices;
    for (int i = 0; i < 8; ++i)
        vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    return meshOfRings(std::move(vertices),
                       {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}});
}

/// Appends `other`, with its corner indices shifted.
inline void append(mesh::ObjectMesh& mesh, const mesh::ObjectMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (mesh::Triangle triangle : other.triangles) {
        for (std::uint32_t& corner : triangle.corners) corner += first;
        mesh.triangles.push_back(triangle);
    }
}

inline void turnOver(std::vector<mesh::Triangle>& triangles) {
    for (mesh::Triangle& triangle : triangles) std::swap(triangle.corners[1], triangle.corners[2]);
}

inline double areaOf(const std::vector<Vec3d>& vertices, const mesh::Triangle& triangle) {
    const Vec3d a = vertices[triangle.corners[0]];
    return length(cross(vertices[triangle.corners[1]] - a, vertices[triangle.corners[2]] - a)) / 2;
}

inline double areaOf(const std::vector<Vec3d>& vertices, const std::vector<mesh::Triangle>& triangles) {
    double area = 0;
    for (const mesh::Triangle& triangle : triangles) area += areaOf(vertices, triangle);
    return area;
}

}  // namespace svt::test
