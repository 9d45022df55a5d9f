#pragma once
/// \file
/// Sine, cosine and inverse functions that use only sums, products and square roots. Mathematical libraries differ in
/// the last bit from machine to machine; these do not, so a model in degrees gives the same volume everywhere.

namespace svt::crs::project {

struct SineCosine {
    double sine, cosine;
};

/// Sine and cosine of an angle. Error: some units in the last place.
/// \param radians  at most 100 in magnitude
[[nodiscard]] SineCosine sineCosine(double radians) noexcept;

/// Hyperbolic sine and cosine.
/// \param x  at most 2 in magnitude
[[nodiscard]] SineCosine hyperbolic(double x) noexcept;

/// Angle whose tangent is `x`, in radians.
[[nodiscard]] double arcTangent(double x) noexcept;

/// Inverse of the hyperbolic sine.
[[nodiscard]] double inverseHyperbolicSine(double x) noexcept;

/// Inverse of the hyperbolic tangent.
/// \param x  at most 0.5 in magnitude
[[nodiscard]] double inverseHyperbolicTangent(double x) noexcept;

}  // namespace svt::crs::project
