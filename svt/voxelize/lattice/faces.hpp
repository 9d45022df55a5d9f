#pragma once
/// \file
/// Faces of solids as lines along z meet them. Neighbouring triangles on one plane are one face: the edges between
/// them are never scanned, so a face reads the same however it was cut.

#include <svt/core/vec.hpp>
#include <svt/voxelize/lattice/levels.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A triangle of a face in plan: corners counter-clockwise where the face looks up, else clockwise.
struct FaceTriangle {
    std::int32_t x[3], y[3];        ///< quanta
    std::int32_t firstRow, endRow;  ///< samples with firstRow <= j < endRow
    std::int32_t firstColumn, endColumn;
    std::uint32_t face = 0;       ///< triangles of a face stand side by side
    std::uint8_t innerEdges = 0;  ///< bit e: another triangle of the face lies beyond the edge from corner e to e + 1

    /// First sample above a corner.
    [[nodiscard]] std::int32_t column(int corner) const noexcept {
        return static_cast<std::int32_t>(firstSampleAbove(x[corner]));
    }
    [[nodiscard]] std::int32_t row(int corner) const noexcept {
        return static_cast<std::int32_t>(firstSampleAbove(y[corner]));
    }
};

/// True where the triangle meets the rectangle of samples [firstColumn, firstColumn + width) x [firstRow, firstRow +
/// height); exact, borders included.
/// \param looksDown  as its face does
[[nodiscard]] bool touchesSamples(const FaceTriangle& triangle, bool looksDown, std::int32_t firstColumn,
                                  std::int32_t firstRow, std::int32_t width, std::int32_t height) noexcept;

/// Faces of objects: for each the boundary that it is.
struct FaceList {
    std::vector<Boundary> faces;
    std::vector<FaceTriangle> triangles;
};

/// Makes faces of what of a closed mesh crosses sample lines along z within `dimension` (rows and columns).
/// \param planeLevels  level of each plane of the scene; empty where planes do not carry over
/// \param ownLevels    gets levels of faces that share no plane
/// Cost: O(n log n) in the triangles of the largest face.
[[nodiscard]] FaceList makeFaces(const IndexMesh& mesh, std::span<const std::uint32_t> planeLevels, Vec3i dimension,
                                 std::uint32_t claim, LevelTable& ownLevels);

}  // namespace svt::voxelize
