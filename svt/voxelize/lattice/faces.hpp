#pragma once
/// \file
/// Faces of solids, prepared for crossing by lines along z. Neighbouring coplanar triangles form one face. The edges
/// between them are never scanned, so the result does not depend on how a face was triangulated.

#include <svt/core/vec.hpp>
#include <svt/voxelize/lattice/height_planes.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A triangle of a face in plan view: corners counter-clockwise if the face looks up, else clockwise.
struct FaceTriangle {
    std::int32_t x[3], y[3];        ///< quanta
    std::int32_t firstRow, endRow;  ///< samples with firstRow <= j < endRow
    std::int32_t firstColumn, endColumn;
    std::uint32_t face = 0;       ///< index of its face; triangles of a face are contiguous
    std::uint8_t innerEdges = 0;  ///< bit e: the edge from corner e to e + 1 is shared with a triangle of the same face

    /// First sample at or above a corner.
    [[nodiscard]] std::int32_t column(int corner) const noexcept {
        return static_cast<std::int32_t>(firstSampleAbove(x[corner]));
    }
    [[nodiscard]] std::int32_t row(int corner) const noexcept {
        return static_cast<std::int32_t>(firstSampleAbove(y[corner]));
    }
};

/// True if the triangle intersects the rectangle of samples [firstColumn, firstColumn + width) x [firstRow, firstRow +
/// height); exact, borders included.
/// \param facesDown  whether its face looks down
[[nodiscard]] bool touchesSamples(const FaceTriangle& triangle, bool facesDown, std::int32_t firstColumn,
                                  std::int32_t firstRow, std::int32_t width, std::int32_t height) noexcept;

/// The faces of an object, each given by its boundary, and their triangles.
struct FaceList {
    std::vector<Boundary> faces;
    std::vector<FaceTriangle> triangles;
};

/// Groups the non-vertical triangles of a closed mesh into faces of coplanar, edge-connected triangles. Triangles that
/// cross no sample line along z within `dimension` (rows and columns) are left out.
/// \param heightPlaneOfPlane  height plane of each plane of the meshes; empty if planes cannot be carried over to the
///                            grid
/// \param ownHeightPlanes    receives the height planes of faces without a shared plane
/// Cost: O(n log n) in the triangles of the largest face.
[[nodiscard]] FaceList groupCoplanarFaces(const IndexMesh& mesh, std::span<const std::uint32_t> heightPlaneOfPlane,
                                          Vec3i dimension, std::uint32_t claim, HeightPlanes& ownHeightPlanes);

}  // namespace svt::voxelize
