#pragma once
/// \file
/// Union, difference and intersection of closed polyhedra, as a closed polyhedron.
///
/// The boundary of the result lies on planes of faces of the operands. On each such plane P, all operands are cut just
/// below it and just above it, and the plane is divided along all these cuts. A cell is a face of the result that looks
/// up if the result is filled below P and not above it. It is a face that looks down in the opposite case:
///
///       wall, opening flush with its face P          just above P     just below P      result on P
///      --+-----+-----+-- P                           nothing          wall: yes         face (up)
///        | wall|open |                                                opening: yes      nothing: wall - opening
///
/// The algorithm does not test on which side of a face a point lies. Faces on one plane, the usual case for openings,
/// therefore need no special treatment. Points within kSnap of a plane lie on it.

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/step/read_guard.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace svt::readers::ifc {

enum class BooleanOperator : std::uint8_t {
    Union,
    Difference,   ///< the first operand without all others
    Intersection  ///< of all
};

/// \param operands  closed, faces flat within kSnap; looking outwards or all inwards. An operand may overlap itself.
/// \return the closed faces (none if the result is empty); nothing if an operand has too many faces, or if the result
///         is not closed, for example because faces are not flat
/// Cost: O(faces^2), and for each plane O(n^2) in the pieces of cuts through it.
[[nodiscard]] std::optional<std::vector<model::Polygon>> evaluateBoolean(
    BooleanOperator op, const std::vector<std::vector<model::Polygon>>& operands);

/// The same within the budget of a file; nothing if the budget is spent.
[[nodiscard]] std::optional<std::vector<model::Polygon>> evaluateBoolean(
    BooleanOperator op, const std::vector<std::vector<model::Polygon>>& operands, step::ReadGuard& guard);

/// A box that contains all of `around` on one side of a plane, with one face on the plane.
/// \param inside  direction from the plane to the side of the half-space, not zero
[[nodiscard]] std::vector<model::Polygon> halfSpaceAround(const Box3d& around, Vec3d onPlane, Vec3d inside);

}  // namespace svt::readers::ifc
