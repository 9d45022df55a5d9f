#pragma once
/// \file
/// Points of a drawing as integers, and what is computed with them exactly.

#include <compare>
#include <cstdint>

namespace svt::illustrate {

/// A point of the drawing in drawing units. Coordinates are at most 2^29 in magnitude, so that products of differences
/// fit 64 bits.
struct DrawingPoint {
    std::int32_t u = 0, v = 0;
    friend auto operator<=>(const DrawingPoint&, const DrawingPoint&) = default;
};

/// A difference of points.
struct Step {
    std::int64_t u = 0, v = 0;
};
[[nodiscard]] constexpr Step operator-(DrawingPoint a, DrawingPoint b) noexcept {
    return {std::int64_t{a.u} - b.u, std::int64_t{a.v} - b.v};
}
[[nodiscard]] constexpr std::int64_t cross(Step a, Step b) noexcept { return a.u * b.v - a.v * b.u; }
[[nodiscard]] constexpr std::int64_t dot(Step a, Step b) noexcept { return a.u * b.u + a.v * b.v; }

/// A directed edge of a piece; `label` is on its left.
struct PieceEdge {
    DrawingPoint from, to;
    std::uint32_t label = 0;
};

}  // namespace svt::illustrate
