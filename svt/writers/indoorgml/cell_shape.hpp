#pragma once
/// \file
/// Closed bodies of cell spaces, as triangles: those of stored meshes, or the faces of voxels.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::writers::indoor {

/// Metres from Grid::origin(), world axes. One point per place.
struct CellShape {
    std::vector<Vec3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside

    [[nodiscard]] Vec3d corner(std::size_t triangle, int i) const {
        return points[triangles[triangle][std::size_t(i)]];
    }
    [[nodiscard]] Box3d bounds() const;
};

/// Every edge is used equally often in both directions, and there is one.
[[nodiscard]] bool isClosed(const CellShape& shape);

/// The volume of a closed shape, m3; negative if its triangles face inwards.
[[nodiscard]] double volumeOf(const CellShape& shape);

/// True if `p` is enclosed, by the parity of a ray. The result for a point on the surface is unspecified.
[[nodiscard]] bool encloses(const CellShape& shape, Vec3d p);

/// The stored mesh of a label; empty if there is none.
[[nodiscard]] CellShape keptMesh(const volume::SemanticVolume& volume, std::uint32_t label);

/// The faces of the voxels of labels, closed.
/// \param ownerOf  per label: the label to which its voxels belong, volume::kNoLabel: none
/// \return per label its shape, empty for labels that own none; or an error of labelSurfaces()
[[nodiscard]] Result<std::vector<CellShape>> voxelShapes(const volume::SemanticVolume& volume,
                                                         const std::vector<std::uint32_t>& ownerOf, int threads,
                                                         const Progress* progress);

/// A body in one piece.
struct CellBody {
    CellShape shell;
    std::vector<CellShape> cavities;  ///< triangles look into them
};

/// The pieces of a closed shape, each with the cavities in it, the largest first.
[[nodiscard]] std::vector<CellBody> piecesOf(const CellShape& shape);

/// A polygon of a shape: rings of points, the first the exterior one.
using FaceRings = std::vector<std::vector<std::uint32_t>>;

/// Merges connected triangles in one plane (within 20 micrometres) to one polygon with holes, so that every edge of a
/// polygon is an edge of another one. If rings would touch themselves, the triangles are kept.
[[nodiscard]] std::vector<FaceRings> facesOf(const CellShape& shape);

/// A point well inside of a body: the point of a lattice in it that is farthest from its surface.
[[nodiscard]] Vec3d innerPoint(const CellBody& body);

}  // namespace svt::writers::indoor
