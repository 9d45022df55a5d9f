#pragma once
/// \file
/// Divides the cut material of a building among its boundary surfaces: each place belongs to the nearest one, by the
/// rule of voxelize/bodies.hpp. The nearest surface is determined in space, not in the plane, so borders may be curved.
/// They are found on cells of a few millimetres, and are straight within one cell.

#include <svt/core/vec.hpp>
#include <svt/plane/arrangement.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::drawing {

/// A triangle of a boundary surface, metres from the drawing's origin.
struct BodyFace {
    Vec3d a, b, c;
    std::uint32_t body = 0;  ///< number of the surface; the lower one wins if surfaces are equally near
};

/// The drawing in space, from the same origin: place = u * p.u + v * p.v, with u and v of one drawing unit.
struct BodyPlane {
    Vec3d u, v;
};

/// A border of the material: the material is to the left.
using MaterialEdge = std::pair<plane::Point, plane::Point>;

/// Largest distance of a border between two bodies from its exact position, metres.
inline constexpr double kBodyTolerance = 5e-4;

/// Divides the plane within the material (and some of the surroundings).
/// \param unit  metres per drawing unit
/// \return the borders of each body, claims being body numbers; they are closed rings
/// Cost: O(length of the borders between bodies in cells * faces close by).
[[nodiscard]] std::vector<plane::ClaimSegment> divideBodies(std::span<const BodyFace> faces,
                                                            std::span<const MaterialEdge> material,
                                                            const BodyPlane& plane, double unit);

}  // namespace svt::drawing
