#pragma once
/// \file
/// The plane nearest to a set of points, by least squares of the distances.

#include <svt/core/vec.hpp>

#include <span>

namespace svt::validate {

struct PlaneFit {
    Vec3d center{};
    Vec3d normal{0, 0, 1};     ///< unit length
    Vec3d along{1, 0, 0};      ///< unit length, the direction in which the points spread most
    double thickness = 0;      ///< largest distance of a point from the plane
    double width = 0;          ///< largest distance of a point from the line through `center` along `along`
    std::size_t farthest = 0;  ///< the point that is `thickness` away
};

/// Principal axes of the points (Pearson 1901), eigenvectors by Jacobi rotations. Requires at least one point.
[[nodiscard]] PlaneFit fitPlane(std::span<const Vec3d> points) noexcept;

}  // namespace svt::validate
