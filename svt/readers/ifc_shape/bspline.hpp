#pragma once
/// \file
/// B-spline curves and surfaces, with and without weights (ISO 10303-42). Points in metres.

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <optional>
#include <vector>

namespace svt::readers::ifc {

/// Degree and knots of one direction.
struct KnotVector {
    std::size_t degree = 0, count = 0;  ///< count: of control points
    std::vector<double> knots;          ///< count + degree + 1, ascending

    [[nodiscard]] double begin() const noexcept { return knots[degree]; }
    [[nodiscard]] double end() const noexcept { return knots[count]; }
    /// The basis functions that are not zero at t, clamped to [begin, end]: those of the points first .. first +
    /// degree.
    /// \param values  receives degree + 1 numbers  \return first
    std::size_t basis(double t, std::vector<double>& values) const;
};

/// From lists of multiplicities and knots; nothing if they do not match the number of points.
[[nodiscard]] std::optional<KnotVector> readKnots(Value degree, Value multiplicities, Value knots, std::size_t count);

struct BSplineCurve {
    KnotVector knots;
    std::vector<Vec3d> points;
    std::vector<double> weights;
    [[nodiscard]] Vec3d at(double t) const;
};

struct BSplineSurface {
    KnotVector u, v;
    std::vector<Vec3d> points;  ///< v fastest
    std::vector<double> weights;
    [[nodiscard]] Vec3d at(double u, double v) const;
};

/// IfcBSplineCurveWithKnots, IfcRationalBSplineCurveWithKnots; nothing if the values are invalid.
[[nodiscard]] std::optional<BSplineCurve> readBSplineCurve(const IfcFile& file, RecordIndex curve);

/// IfcBSplineSurfaceWithKnots, IfcRationalBSplineSurfaceWithKnots; nothing if the values are invalid.
[[nodiscard]] std::optional<BSplineSurface> readBSplineSurface(const IfcFile& file, RecordIndex surface);

}  // namespace svt::readers::ifc
