#pragma once
/// \file
/// Divides what is cut of a building's material among its boundary surfaces: each place belongs to the nearest one, by
/// the rule of voxelize/bodies.hpp. The surfaces are nearest in space, not in the plane, so borders may be curved; they
/// are found on cells of a few millimetres, and are straight within one.

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
    std::uint32_t body = 0;  ///< number of the surface; of surfaces that are equally near, the lower one has the place
};

/// The drawing in space, from the same origin: place = u * p.u + v * p.v, with u and v of one drawing unit.
struct BodyPlane {
    Vec3d u, v;
};

/// A border of the material: the material is to the left.
using MaterialEdge = std::pair<plane::Point, plane::Point>;

/// Largest distance of a border between two bodies from where it should be, metres.
inline constexpr double kBodyTolerance = 5e-4;

/// Divides the plane where the material is (and some of the surroundings).
/// \param unit  metres of a drawing unit
/// \return the borders of each body, claims being body numbers; they are closed rings
/// Cost: O(length of the borders between bodies in cells * faces close by).
[[nodiscard]] std::vector<plane::ClaimSegment> divideBodies(std::span<const BodyFace> faces,
                                                            std::span<const MaterialEdge> material,
                                                            const BodyPlane& plane, double unit);

}  // namespace svt::drawing
