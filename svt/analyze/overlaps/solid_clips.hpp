#pragma once
/// \file
/// Closed meshes of labels, and the parts of them that matter for the volume in a box. Local space: metres from the
/// grid's lower corner along world axes.

#include <svt/core/vec.hpp>
#include <svt/plane/common_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// A label with a closed mesh.
struct MeshSolid {
    std::uint32_t label = 0;
    std::span<const volume::VectorParts::Triangle> triangles;
    Box3d box;
    Vec3d offset{};  ///< added to all corners: from the lower corner of another grid
};

/// The labels with closed meshes that enclose the stated volume, ascending. The result refers to the triangles of `volume`.
/// \param offset  see MeshSolid
[[nodiscard]] std::vector<MeshSolid> meshSolids(const volume::SemanticVolume& volume, Vec3d offset = {});

/// The box that two boxes share; empty where they have no volume in common.
[[nodiscard]] Box3d commonBox(const Box3d& a, const Box3d& b);

/// The part of a solid in a box.
struct SolidClip {
    std::vector<plane::RoofTriangle> roofs;  ///< above, in and below the box, in order of minX
    double area = 0;                         ///< m2 in the box, at most
    double lowest = kInfinity;
};
[[nodiscard]] SolidClip clipSolid(const MeshSolid& solid, const volume::VectorParts& parts, const Box3d& box);

/// m3 by which plane::commonVolume() of two clips may be off: each face lies within the rounding of its corners, and the sum of
/// prisms rounds, too, also where no face is in the box.
/// \param area    m2 of both clips
/// \param unit    of the points, metres
/// \param lowest  of both clips
[[nodiscard]] double boundOfCommonVolume(double area, double unit, const Box3d& box, double lowest);

}  // namespace svt::analyze
