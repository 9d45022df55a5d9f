#pragma once
/// \file
/// Distance of a point from a triangle.

#include <svt/core/vec.hpp>

namespace svt {

/// Distance from `p` to the triangle a, b, c, which may have no area (Ericson 2005, Real-Time Collision Detection,
/// 5.1.5).
[[nodiscard]] inline double distanceToTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) noexcept {
    const Vec3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return length(ap);
    const Vec3d bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return length(bp);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 - d3 != 0 ? d1 / (d1 - d3) : 0.0));
    const Vec3d cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return length(cp);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 - d6 != 0 ? d2 / (d2 - d6) : 0.0));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double sum = (d4 - d3) + (d5 - d6);
        return length(bp - (c - b) * (sum != 0 ? (d4 - d3) / sum : 0.0));
    }
    const double sum = va + vb + vc;
    return sum != 0 ? length(ap - ab * (vb / sum) - ac * (vc / sum)) : length(ap);
}

}  // namespace svt
