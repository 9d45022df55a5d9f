#include <svt/crs/project/elementary.hpp>

#include <cmath>

namespace svt::crs::project {
namespace {

// pi/2 as a sum: the first part has 33 bits, so its product with a small whole number is exact.
constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
constexpr double kHalfPiLow = 6.07710050650619224932e-11;

// Sum of the terms of a power series in x^2, from the term `first`, until a term no longer changes the sum. Each term
// is the previous one times x2 / ((k + 1) (k + 2)).
double factorialSeries(double first, double x2, int k) noexcept {
    double sum = first, term = first;
    for (; std::abs(term) > 1e-18 * std::abs(sum); k += 2) {
        term *= x2 / static_cast<double>((k + 1) * (k + 2));
        sum += term;
    }
    return sum;
}

// x + sign x^3/3 + x^5/5 + sign x^7/7 ...
double oddSeries(double x, double x2) noexcept {
    double sum = x, power = x;
    for (int k = 3; std::abs(power) > 1e-18 * std::abs(sum); k += 2) {
        power *= x2;
        sum += power / static_cast<double>(k);
    }
    return sum;
}

}  // namespace

SineCosine sineCosine(double radians) noexcept {
    const double turns = std::floor(radians / kHalfPiHigh + 0.5);
    const double x = radians - turns * kHalfPiHigh - turns * kHalfPiLow;
    const double sine = x == 0 ? 0 : factorialSeries(x, -x * x, 1);
    const double cosine = factorialSeries(1, -x * x, 0);
    switch (static_cast<long>(turns) & 3) {
        case 0: return {sine, cosine};
        case 1: return {cosine, -sine};
        case 2: return {-sine, -cosine};
        default: return {-cosine, sine};
    }
}

SineCosine hyperbolic(double x) noexcept {
    return {x == 0 ? 0 : factorialSeries(x, x * x, 1), factorialSeries(1, x * x, 0)};
}

double arcTangent(double x) noexcept {
    // atan x = 2 atan(x / (1 + sqrt(1 + x^2))), three times: then |x| is below 0.2.
    for (int half = 0; half < 3; ++half) x /= 1 + std::sqrt(1 + x * x);
    return x == 0 ? 0 : 8 * oddSeries(x, -x * x);
}

double inverseHyperbolicSine(double x) noexcept {
    // asinh x = 2 asinh(x / sqrt(2 (1 + sqrt(1 + x^2)))), then asinh x = atanh(x / sqrt(1 + x^2)).
    int halves = 0;
    for (; std::abs(x) > 0.25 && halves < 20; ++halves) x /= std::sqrt(2 * (1 + std::sqrt(1 + x * x)));
    return std::ldexp(inverseHyperbolicTangent(x / std::sqrt(1 + x * x)), halves);
}

double inverseHyperbolicTangent(double x) noexcept { return x == 0 ? 0 : oddSeries(x, x * x); }

}  // namespace svt::crs::project
