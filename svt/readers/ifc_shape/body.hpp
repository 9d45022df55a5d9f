#pragma once
/// \file
/// Polygons of one representation item, in metres, and functions that all of their makers share.

#include <svt/model/building_model.hpp>
#include <svt/plane/rings.hpp>
#include <svt/readers/ifc_shape/transform.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::readers::ifc {

/// One item of a shape.
struct Body {
    std::vector<model::Polygon> faces;  ///< counter-clockwise from outside if it is a solid
    bool isSolid = false;               ///< meant to be closed: a solid, or a face set that is marked as closed
    std::int32_t material = -1;         ///< into BuildingModel::materials
};

/// Appends a face; points closer than 0.1 micrometre to the one before are dropped, and rings of fewer than three
/// points.
/// \param rings  exterior ring, then holes
void addFace(std::vector<model::Polygon>& faces, const std::vector<std::vector<Vec3d>>& rings);

/// Appends a quadrilateral; two triangles if it is not flat within 1 micrometre.
void addQuad(std::vector<model::Polygon>& faces, Vec3d a, Vec3d b, Vec3d c, Vec3d d);

/// The transformed faces; reversed if the map mirrors.
[[nodiscard]] std::vector<model::Polygon> transformed(const std::vector<model::Polygon>& faces,
                                                      const Transform& transform);
[[nodiscard]] Body transformed(const Body& body, const Transform& transform);

/// Reverses all faces.
void turnOver(std::vector<model::Polygon>& faces);

/// Signed volume enclosed by faces, m3, if they are closed: fans of all rings. Cost: O(points).
[[nodiscard]] double enclosedVolume(const std::vector<model::Polygon>& faces) noexcept;

/// Whether each edge is used as often in one direction as in the other. Points within 1 micrometre are one point. Edges
/// are cut at points of other edges that lie on them.
[[nodiscard]] bool isClosed(const std::vector<model::Polygon>& faces);

/// Newell's normal of a ring, or of the exterior ring of a face; its length is twice the area.
using plane::newellNormal;
[[nodiscard]] Vec3d newellNormal(const model::Polygon& face) noexcept;

[[nodiscard]] std::uint64_t pointCount(const std::vector<model::Polygon>& faces) noexcept;

[[nodiscard]] Box3d boundsOf(const std::vector<model::Polygon>& faces) noexcept;

}  // namespace svt::readers::ifc
