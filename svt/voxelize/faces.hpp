#pragma once
/// \file
/// Faces of solids as lines along z meet them. Neighbouring triangles on one plane are one face: the edges between
/// them are never scanned, so a face reads the same however it was cut.

#include <svt/core/vec.hpp>
#include <svt/voxelize/scan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// What all triangles of a face have in common.
struct ScanFace {
    FaceHeight height;
    std::uint32_t claim = 0;  ///< priority order of the claim it bounds
    std::int8_t sign = 0;     ///< winding change when passing upwards: +1 enters (face looks down), -1 leaves
};

/// A triangle of a face in plan: quanta, corners counter-clockwise where the face looks up, else clockwise.
struct FaceTriangle {
    std::int32_t x[3], y[3];
    std::int32_t firstRow, endRow;  ///< samples with firstRow <= j < endRow
    std::int32_t firstColumn, endColumn;
    std::uint32_t face = 0;       ///< triangles of a face stand side by side
    std::uint8_t innerEdges = 0;  ///< bit e: another triangle of the face lies beyond the edge from corner e to e + 1
};

/// True where the triangle meets the rectangle of samples [firstColumn, firstColumn + width) x [firstRow, firstRow +
/// height); exact, borders included. \param sign  that of its face
[[nodiscard]] bool touchesSamples(const FaceTriangle& triangle, std::int8_t sign, std::int32_t firstColumn,
                                  std::int32_t firstRow, std::int32_t width, std::int32_t height) noexcept;

/// Faces and triangles of many objects.
struct FaceList {
    std::vector<ScanFace> faces;
    std::vector<FaceTriangle> triangles;

    /// Appends all of `other`.
    void append(const FaceList& other);
};

/// Appends what of a closed mesh crosses sample lines along z within `dimension` (rows and columns).
/// \param planes  of the scene in index space; empty where planes do not carry over
/// Cost: O(n log n) in the triangles of the largest face.
void addFaces(const IndexMesh& mesh, std::span<const mesh::Plane> planes, Vec3i dimension, std::uint32_t claim,
              FaceList& list);

}  // namespace svt::voxelize
