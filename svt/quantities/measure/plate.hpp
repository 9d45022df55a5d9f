#pragma once
/// \file
/// The two faces of a body that is thin in one direction.

#include <svt/core/vec.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

using Corners = std::array<Vec3d, 3>;

/// Two parallel planes, each of them at least half of the faces that are seen across them.
struct Plate {
    Vec3d normal{};              ///< unit vector, of the front
    double front = 0, back = 0;  ///< places of the planes along the normal; front > back
    Vec3d along{1, 0, 0};        ///< unit vector in the planes: horizontal, along the edges of bodies that lie flat

    [[nodiscard]] double thickness() const noexcept { return front - back; }
    [[nodiscard]] bool isUpright() const noexcept { return std::abs(normal.z) < 0.1; }
};

inline constexpr double kFlatness = 1e-3;  // metres: largest distance of a corner from its plane

/// The thinnest plate; nothing for other shapes, such as spheres and stairs.
/// \param triangles  of a closed mesh; coordinates near 0
/// Cost: O(t) for t triangles, times at most 48 directions.
[[nodiscard]] std::optional<Plate> findPlate(std::span<const Corners> triangles);

}  // namespace svt::quantities
