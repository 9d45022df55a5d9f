#pragma once
/// \file
/// Finds the lines where the shells of two objects pierce each other. Meshes have no edge there, but a drawing has a
/// line: a slab that reaches into a wall meets the wall's face in the corner of the room.

#include <svt/drawing/beyond/view_shapes.hpp>

#include <vector>

namespace svt::drawing {

/// Lines where faces of two labels cross each other. A face that ends at the other one touches it, which gives no line.
/// \return the lines, by their faces; with `isPiercing`
/// Cost: O(n log n) and the pairs of faces whose boxes meet.
[[nodiscard]] std::vector<ViewEdge> findPiercingLines(const std::vector<ViewFace>& faces);

}  // namespace svt::drawing
