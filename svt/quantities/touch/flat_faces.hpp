#pragma once
/// \file
/// The flat faces of a mesh: its triangles by planes. Local space, see mesh_sections.hpp.

#include <svt/core/vec.hpp>
#include <svt/volume/vector_parts.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::quantities {

/// Triangles in one plane that look the same way.
struct FlatFace {
    Vec3d normal{};
    std::vector<std::array<Vec3d, 3>> triangles;
};

/// The faces of a label; collapsed triangles are left out. Where a plane is just at the border of two cells of its
/// search, its triangles may be two faces.
/// Cost: O(n log n) in triangles.
[[nodiscard]] std::vector<FlatFace> flatFaces(const volume::VectorParts& parts, std::uint32_t label);

}  // namespace svt::quantities
