#pragma once
/// \file
/// Closed meshes of labels, and the parts of them that matter for the volume in a box. Local space: metres from the
/// grid's lower corner along world axes.

#include <svt/analyze/overlaps/common_volume.hpp>
#include <svt/core/vec.hpp>
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
};

/// Whether the mesh of a label is closed, so that its volume is exact.
[[nodiscard]] bool hasClosedMesh(volume::Filling filling) noexcept;

/// The labels with closed meshes, ascending. The result refers to the triangles of `volume`.
[[nodiscard]] std::vector<MeshSolid> meshSolids(const volume::SemanticVolume& volume);

/// The box that two boxes share; empty where they have no volume in common.
[[nodiscard]] Box3d commonBox(const Box3d& a, const Box3d& b);

/// The part of a solid in a box.
struct SolidClip {
    std::vector<RoofTriangle> roofs;  ///< above, in and below the box, in order of minX
    double area = 0;                  ///< m2 in the box, at most
    double lowest = kInfinity;
};
[[nodiscard]] SolidClip clipSolid(const MeshSolid& solid, const volume::VectorParts& parts, const Box3d& box);

}  // namespace svt::analyze
