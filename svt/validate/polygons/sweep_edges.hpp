#pragma once
/// \file
/// Whether the edges of rings meet anywhere but where they should.

#include <svt/validate/exact/lattice.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::validate {

/// An edge of a ring, from one corner to the next.
using FlatEdge = std::array<Point2, 2>;

/// True if two edges have more in common than one end each, more than two edges have an end in common, or an
/// edge has no length. False for simple
/// rings that do not touch each other. Exact.
/// Cost: O(n log n), a sweep with a line (Shamos and Hoey 1976, "Geometric intersection problems").
[[nodiscard]] bool meetBeyondEnds(const std::vector<FlatEdge>& edges);

}  // namespace svt::validate
