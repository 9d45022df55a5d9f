#pragma once
/// \file
/// Places of the nodes of a lattice.

#include <svt/fields/field.hpp>

#include <cstddef>

namespace svt::fields {

/// Position of a node in the index space of the volume.
/// \param node  i + size.x * (j + size.y * k)
[[nodiscard]] inline Vec3d nodeAt(const Lattice& lattice, std::size_t node) noexcept {
    Vec3d at{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto size = static_cast<std::size_t>(lattice.size[axis]);
        const auto& positions = lattice.positions[static_cast<std::size_t>(axis)];
        const std::size_t n = node % size;
        at[axis] = positions.empty() ? lattice.first[axis] + double(n) * lattice.step[axis] : positions[n];
        node /= size;
    }
    return at;
}

}  // namespace svt::fields
