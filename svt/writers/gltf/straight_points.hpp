#pragma once
/// \file
/// Leaves out points on straight borders of faces. Files cut an edge where a neighbour once had a corner.
///
///     +---o-------+     o: on a straight border of each face that has it, so that it can go
///     |   | roof  |     A point that is a corner of any face stays in all of them: no T-junction appears.
///     +---x-------+     x: a corner of a part of the wall below

#include <svt/writers/gltf/sheet_surfaces.hpp>

namespace svt::writers {

/// How far a border may be from the point that is left out, metres.
inline constexpr double kStraight = 5e-4;

/// Triangles lose the point, positions keep it. Triangles without area are left out. A surface changes only where its triangles are in a plane, by less than
/// kStraight, and keeps its border. Points inside of a closed mesh stay. Deterministic.
/// Cost: O(n log n) for n corners of triangles.
void dropStraightPoints(SheetSurfaces& sheets);

}  // namespace svt::writers
