#pragma once
/// \file
/// Objects that are far larger than all others together, such as one stratum of 24 km below a house.

#include <svt/mesh/mesh_set.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::pipeline {

/// The model without its huge objects.
struct ModelCore {
    Box3d box;                        ///< of the other objects and of a margin around them
    double area = 0;                  ///< m2 of all faces in it, at most
    std::vector<std::uint32_t> huge;  ///< objects that reach out of it
};

/// Finds up to 5 % of the objects, at least one, whose horizontal extent is eight times that of all others together.
/// The margin is half the longest side of the others, at least 10 m.
/// \param boxes  of the objects, along the axes of the grid
/// \return nothing without such objects
[[nodiscard]] std::optional<ModelCore> coreOf(const mesh::MeshSet& meshes, std::span<const Box3d> boxes);

}  // namespace svt::pipeline
