#pragma once
/// \file
/// The transverse Mercator projection (Gauss-Krueger, UTM) by Krueger's series.

#include <svt/core/vec.hpp>

#include <array>

namespace svt::crs::project {

struct Ellipsoid {
    double semiMajorAxis;      ///< metres
    double inverseFlattening;  ///< 1/f
};
inline constexpr Ellipsoid kGrs80{6378137, 298.257222101};
inline constexpr Ellipsoid kWgs84{6378137, 298.257223563};

/// Origin, scale and offsets of a zone; angles in degrees, lengths in metres.
struct Zone {
    double latitude = 0, longitude = 0, scale = 0.9996, falseEasting = 500000, falseNorthing = 0;
};

/// Longitude and latitude to easting and northing of one zone, and back.
///
/// Source: C. F. F. Karney, Transverse Mercator with an accuracy of a few nanometers, J. Geodesy 85 (2011), 475-485:
/// equations 7 to 9 (conformal latitude), 10 and 11 (with 35 for the coefficients to n^6, 14 for the radius); for the
/// way back 12, 13, 15 and 36. Error below 10 nm within 35 degrees of the zone's meridian.
/// The same bits on every machine.
class TransverseMercator {
public:
    TransverseMercator(const Ellipsoid& ellipsoid, const Zone& zone) noexcept;

    /// \param point  x: longitude, y: latitude in degrees; z is kept
    /// \return       easting, northing in metres; NaN for more than 45 degrees from the zone's meridian, or where
    ///               there is no such latitude. Cost: some 0.2 microseconds
    [[nodiscard]] Vec3d forward(Vec3d point) const noexcept;
    /// The inverse of forward().
    [[nodiscard]] Vec3d inverse(Vec3d point) const noexcept;

private:
    // Easting and northing on a sphere of radius 1, the origin on the equator.
    [[nodiscard]] Vec3d unitForward(double latitude, double longitude) const noexcept;

    double eccentricity2_;  ///< e^2
    double radius_;         ///< scale times the radius of a circle as long as a meridian
    double originNorthing_ = 0;
    Zone zone_;
    std::array<double, 6> alpha_, beta_;
};

}  // namespace svt::crs::project
