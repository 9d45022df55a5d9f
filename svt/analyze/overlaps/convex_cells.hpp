#pragma once
/// \file
/// Closed meshes as convex cells, which can be taken from each other one by one.
///
/// Inclusion and exclusion compares tuples of triangles: with k meshes at one place, the number of tuples grows with the
/// power k. Cells do not have this growth: a cell without another one is a few convex cells.
///
///     +-------+            +--+----+
///     |   P   |            |  | 2  |      P without Q: for each face of Q in turn, the part of P beyond it
///     |   +---+---+  -->   | 1|----+
///     +---|---+ Q |        |  |
///         +-------+        +--+
///
/// A mesh is divided by the planes of its own faces (binary space partition: Fuchs, Kedem and Naylor 1980; Thibault and
/// Naylor 1987). Cuts change volumes continuously, so rounding causes slivers, but no errors above it.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::analyze {

/// The points p with dot(normal, p) <= offset. The normal has length 1.
struct HalfSpace {
    Vec3d normal{};
    double offset = 0;
    [[nodiscard]] double beyond(Vec3d p) const noexcept { return dot(normal, p) - offset; }
};

/// A convex body with flat faces.
struct ConvexCell {
    struct Face {
        HalfSpace plane;  ///< the cell is inside
        std::uint32_t begin = 0, end = 0;
    };
    std::vector<Face> faces;
    std::vector<Vec3d> corners;  ///< of all faces, each counter-clockwise from outside
    Box3d box;
};

[[nodiscard]] ConvexCell cellOfBox(const Box3d& box);
[[nodiscard]] double volumeOf(const ConvexCell& cell);

/// The convex cells of a closed mesh, without common volume.
/// \param triangles  counter-clockwise from outside
/// \param volume     of the mesh, m3, for a check
/// \param work       maximum number of steps; the function reduces it
/// \return nothing if the work does not suffice, or if the cells do not have the volume of the mesh: it is open, or covers
///         itself
/// Cost: O(faces^2) steps for bodies like a wall with openings.
[[nodiscard]] std::optional<std::vector<ConvexCell>> convexCells(std::span<const std::array<Vec3d, 3>> triangles,
                                                                 double volume, std::uint64_t& work);

/// The volume of the cells at places that `others` have, too; places of several of them count once.
/// \param cells   without common volume
/// \param others  in any order; they may overlap
/// \return nothing if the work does not suffice
/// Cost: O(pairs of cells whose boxes overlap).
[[nodiscard]] std::optional<double> volumeWithin(std::span<const ConvexCell> cells,
                                                 std::span<const std::vector<ConvexCell>* const> others,
                                                 std::uint64_t& work);

}  // namespace svt::analyze
