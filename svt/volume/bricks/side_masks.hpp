#pragma once
/// \file
/// Finds the side of a plane on which each sample of a brick lies. SIMD by Google Highway: compiled for several
/// instruction sets, the best one available is chosen at run time; all give the same results.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>

namespace svt::volume {

/// The voxels of a brick on the positive side of a plane, or beyond a cut: bit i + 8 j of word k.
using SideMask = std::array<std::uint64_t, 8>;

/// Finds the samples (i, j, k) of a brick, each 0..7, at which `first + dot(normal, (i, j, k))` is positive.
/// \return whether the value of each sample is at least `margin` away from 0
[[nodiscard]] bool findSides(double first, Vec3d normal, double margin, SideMask& mask) noexcept;

}  // namespace svt::volume
