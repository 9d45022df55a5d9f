#include <svt/crs/project/transverse_mercator.hpp>

#include <svt/crs/project/elementary.hpp>

#include <cmath>
#include <limits>

namespace svt::crs::project {
namespace {

constexpr double kRadians = 0.017453292519943295769;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMaxLongitude = 45;

// Sum over j of c_j sin(2 j z), z = xi + i eta, as a pair of real and imaginary part.
Vec3d sineSum(const std::array<double, 6>& c, double xi, double eta) noexcept {
    const SineCosine angle = sineCosine(2 * xi);
    const SineCosine side = hyperbolic(2 * eta);
    // sin(j w) = 2 cos w sin((j - 1) w) - sin((j - 2) w), of complex w = 2 z.
    const double cosX = angle.cosine * side.cosine, cosY = -angle.sine * side.sine;
    double x = angle.sine * side.cosine, y = angle.cosine * side.sine, lastX = 0, lastY = 0;
    Vec3d sum;
    for (const double factor : c) {
        sum.x += factor * x;
        sum.y += factor * y;
        const double nextX = 2 * (cosX * x - cosY * y) - lastX;
        const double nextY = 2 * (cosX * y + cosY * x) - lastY;
        lastX = x;
        lastY = y;
        x = nextX;
        y = nextY;
    }
    return sum;
}

// e atanh(e sine): the difference between the isometric latitudes of the sphere and the ellipsoid.
double ellipticPart(double e2, double sine) noexcept {
    const double e = std::sqrt(e2);
    return e * inverseHyperbolicTangent(e * sine);
}

// Tangent of the conformal latitude (equation 7 with 9).
double conformal(double tangent, double e2) noexcept {
    const double secant = std::sqrt(1 + tangent * tangent);
    const SineCosine sigma = hyperbolic(ellipticPart(e2, tangent / secant));
    return tangent * sigma.cosine - sigma.sine * secant;
}

}  // namespace

TransverseMercator::TransverseMercator(const Ellipsoid& ellipsoid, const Zone& zone) noexcept : zone_(zone) {
    const double f = 1 / ellipsoid.inverseFlattening;
    const double n = f / (2 - f), n2 = n * n, n3 = n2 * n, n4 = n2 * n2, n5 = n4 * n, n6 = n3 * n3;
    eccentricity2_ = f * (2 - f);
    radius_ = zone.scale * ellipsoid.semiMajorAxis / (1 + n) * (1 + n2 / 4 + n4 / 64 + n6 / 256);
    alpha_ = {n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180 - 127 * n5 / 288 + 7891 * n6 / 37800,
              13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440 + 281 * n5 / 630 - 1983433 * n6 / 1935360,
              61 * n3 / 240 - 103 * n4 / 140 + 15061 * n5 / 26880 + 167603 * n6 / 181440,
              49561 * n4 / 161280 - 179 * n5 / 168 + 6601661 * n6 / 7257600,
              34729 * n5 / 80640 - 3418889 * n6 / 1995840,
              212378941 * n6 / 319334400};
    beta_ = {n / 2 - 2 * n2 / 3 + 37 * n3 / 96 - n4 / 360 - 81 * n5 / 512 + 96199 * n6 / 604800,
             n2 / 48 + n3 / 15 - 437 * n4 / 1440 + 46 * n5 / 105 - 1118711 * n6 / 3870720,
             17 * n3 / 480 - 37 * n4 / 840 - 209 * n5 / 4480 + 5569 * n6 / 90720,
             4397 * n4 / 161280 - 11 * n5 / 504 - 830251 * n6 / 7257600,
             4583 * n5 / 161280 - 108847 * n6 / 3991680,
             20648693 * n6 / 638668800};
    originNorthing_ = zone.latitude == 0 ? 0 : radius_ * unitForward(zone.latitude, 0).y;
}

Vec3d TransverseMercator::unitForward(double latitude, double longitude) const noexcept {
    const SineCosine phi = sineCosine(latitude * kRadians);
    const SineCosine lambda = sineCosine(longitude * kRadians);
    if (phi.cosine <= 0) return {kNan, kNan, 0};
    const double tangent = conformal(phi.sine / phi.cosine, eccentricity2_);
    const double xi = arcTangent(tangent / lambda.cosine);
    const double eta =
        inverseHyperbolicSine(lambda.sine / std::sqrt(tangent * tangent + lambda.cosine * lambda.cosine));
    const Vec3d sum = sineSum(alpha_, xi, eta);
    return {eta + sum.y, xi + sum.x, 0};
}

Vec3d TransverseMercator::forward(Vec3d point) const noexcept {
    double longitude = point.x - zone_.longitude;
    if (longitude > 180) longitude -= 360;
    if (longitude < -180) longitude += 360;
    if (!(std::abs(longitude) <= kMaxLongitude && std::abs(point.y) < 90)) return {kNan, kNan, point.z};
    const Vec3d unit = unitForward(point.y, longitude);
    return {zone_.falseEasting + radius_ * unit.x, zone_.falseNorthing + (radius_ * unit.y - originNorthing_), point.z};
}

Vec3d TransverseMercator::inverse(Vec3d point) const noexcept {
    const double xi = (point.y - zone_.falseNorthing + originNorthing_) / radius_;
    const double eta = (point.x - zone_.falseEasting) / radius_;
    if (!(std::abs(xi) < 1.6 && std::abs(eta) < 1)) return {kNan, kNan, point.z};
    const Vec3d sum = sineSum(beta_, xi, eta);
    const SineCosine north = sineCosine(xi - sum.x);
    const SineCosine east = hyperbolic(eta - sum.y);
    const double wanted = north.sine / std::sqrt(east.sine * east.sine + north.cosine * north.cosine);
    // Newton's method on the conformal latitude; its derivative is nearly that of the sphere.
    double tangent = wanted / std::sqrt(1 - eccentricity2_);
    for (int step = 0; step < 8; ++step) {
        const double now = conformal(tangent, eccentricity2_);
        tangent += (wanted - now) / std::sqrt(1 + now * now) * (1 + (1 - eccentricity2_) * tangent * tangent) /
                   ((1 - eccentricity2_) * std::sqrt(1 + tangent * tangent));
    }
    return {zone_.longitude + arcTangent(east.sine / north.cosine) / kRadians, arcTangent(tangent) / kRadians, point.z};
}

}  // namespace svt::crs::project
