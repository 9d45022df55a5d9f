#pragma once
/// \file
/// Placement of a plan in the world: rotation of the building about its centre, translation onto its lot, rotation of
/// the whole model about its centre, and the origin.

#include <svt/samples/parts/solid.hpp>

#include <cstdint>

namespace svt::samples {

/// A rotation in plan about a centre, counter-clockwise.
struct Rotation {
    double cosine = 1, sine = 0;
    double centerX = 0, centerY = 0;  ///< millimetres

    /// By any angle; quarter turns are exact, others rounded to 1e-12 so that all machines agree.
    [[nodiscard]] static Rotation byDegrees(double degrees, double centerX, double centerY);
    /// True for multiples of a quarter turn about whole or half millimetres that map whole millimetres to whole
    /// millimetres.
    [[nodiscard]] bool isExact() const;
};

using WorldPoint = Vec3<std::int64_t>;  ///< world coordinates as whole numbers of 10^-decimals metres

class Placement {
public:
    Placement() = default;
    /// world = modelRotation(buildingRotation(p) + shift) + origin, all in millimetres.
    Placement(const Rotation& buildingRotation, Point shift, const Rotation& modelRotation, Point origin)
        : buildingRotation_(buildingRotation), shift_(shift), modelRotation_(modelRotation), origin_(origin) {}

    /// 3 if every point is a whole millimetre, else 6.
    [[nodiscard]] int decimals() const { return buildingRotation_.isExact() && modelRotation_.isExact() ? 3 : 6; }
    /// Rounded to decimals().
    [[nodiscard]] WorldPoint at(Point p) const;
    /// Unrounded; metres.
    [[nodiscard]] Vec3d worldPosition(Vec3d millimetres) const;
    [[nodiscard]] Vec3d worldDirection(Vec3d direction) const;

    [[nodiscard]] Placement lifted(Length height) const;

private:
    [[nodiscard]] Vec3d rotated(Vec3d p) const;  // without the origin; millimetres

    Rotation buildingRotation_;
    Point shift_;
    Rotation modelRotation_;
    Point origin_;
};

}  // namespace svt::samples
