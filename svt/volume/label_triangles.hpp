#pragma once
/// \file
/// The triangles of one label: a digest of them, and whether they are a closed mesh.

#include <svt/volume/label_table.hpp>
#include <svt/volume/vector_parts.hpp>

#include <cstdint>
#include <span>

namespace svt::volume {

/// The triangles of a label. Cost: O(log n) for n triangles of all labels.
[[nodiscard]] std::span<const VectorParts::Triangle> trianglesOf(const VectorParts& parts,
                                                                 std::uint32_t label) noexcept;

/// A digest of the places of the corners, with their orientation, from any first corner. The sum over the triangles of a
/// label does not depend on their order.
/// \param seed  other seeds give independent digests
[[nodiscard]] std::uint64_t digestOf(const VectorParts& parts, const VectorParts::Triangle& triangle,
                                     std::uint64_t seed = 1) noexcept;

/// Whether triangles of a label are the closed mesh whose volume the label states. Those of a file may not be, whatever
/// it states.
/// \param enclosed  m3: the sum over signed tetrahedra of the triangles
/// \param area      m2 of the triangles
/// \param unit      VectorParts::unit
[[nodiscard]] bool enclosesStatedVolume(const Label& label, double enclosed, double area, double unit) noexcept;

}  // namespace svt::volume
