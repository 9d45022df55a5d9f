#pragma once
/// \file
/// Affine maps of placements and mapped items.

#include <svt/core/vec.hpp>

namespace svt::readers::ifc {

/// p -> origin + x * p.x + y * p.y + z * p.z. The axes need be neither of unit length nor at right angles.
struct Transform {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    [[nodiscard]] Vec3d direction(Vec3d v) const noexcept { return x * v.x + y * v.y + z * v.z; }
    [[nodiscard]] Vec3d point(Vec3d p) const noexcept { return origin + direction(p); }
    [[nodiscard]] double determinant() const noexcept { return dot(cross(x, y), z); }
    /// This map after `inner`.
    [[nodiscard]] Transform after(const Transform& inner) const noexcept {
        return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
    }
    /// \pre determinant() is not 0
    [[nodiscard]] Transform inverse() const noexcept {
        const double d = determinant();
        const Vec3d rowX = cross(y, z) / d, rowY = cross(z, x) / d, rowZ = cross(x, y) / d;
        Transform result{{rowX.x, rowY.x, rowZ.x}, {rowX.y, rowY.y, rowZ.y}, {rowX.z, rowY.z, rowZ.z}, {}};
        result.origin = -result.direction(origin);
        return result;
    }
    friend bool operator==(const Transform&, const Transform&) = default;
};

/// Axes at right angles from a z axis and a hint for x, by IfcBuildAxes and IfcFirstProjAxis. Both may have any length.
/// A hint along z is replaced.
[[nodiscard]] inline Transform axesFrom(Vec3d origin, Vec3d z, Vec3d xHint) noexcept {
    Transform axes;
    axes.origin = origin;
    axes.z = length(z) > 0 ? normalized(z) : Vec3d{0, 0, 1};
    Vec3d x = xHint - axes.z * dot(xHint, axes.z);
    if (length(x) < 1e-9 * (length(xHint) + 1e-300)) {
        const Vec3d other = std::abs(axes.z.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        x = other - axes.z * dot(other, axes.z);
    }
    axes.x = normalized(x);
    axes.y = cross(axes.z, axes.x);
    return axes;
}

}  // namespace svt::readers::ifc
