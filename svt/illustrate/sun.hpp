#pragma once
/// \file
/// The position of the sun by date, hour and place: the key light of a picture.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string_view>

namespace svt::illustrate {

/// Degrees. Elevation is the true one, without refraction, which lifts the sun by 0.5 degrees at the horizon but does
/// not change shadows visibly.
struct SunPosition {
    double azimuth = 0;    ///< clockwise from true north, 0..360
    double elevation = 0;  ///< above the horizon, negative at night
};

/// The position of the sun as seen from a place. Uses the series of low accuracy of Meeus, Astronomical Algorithms
/// (1998), chapters 25 and 28, like the NOAA Solar Calculator. The error is below 0.02 degrees from 1950 to 2050.
/// \param julianDay  of universal time
/// \param latitude, longitude  degrees, north and east positive
[[nodiscard]] SunPosition sunPosition(double julianDay, double latitude, double longitude) noexcept;

/// The Julian day of a text such as "2026-06-21 15:00", "2026-06-21T15:00:30+02:00" or "2026-06-21 13:00Z".
/// \param longitude  degrees; without an offset or Z, the time zone is longitude / 15, rounded to whole hours,
///                   without summer time
/// \return the day, or BadScene with the expected form
[[nodiscard]] Result<double> parseSunTime(std::string_view text, double longitude);

/// The light of Scene::sun on a volume.
struct Sunlight {
    SunPosition position;
    Vec3d direction;  ///< towards the sun; world space, unit length
    double latitude = 0, longitude = 0;
};

/// The place is that of Scene::sun, otherwise that of the CRS, otherwise the attributes `latitude` and `longitude` of a
/// feature (IfcSite). True north is that of drawing::northOf().
/// \return the light, or BadScene for a bad time or an unknown place of the building
[[nodiscard]] Result<Sunlight> sunlightOf(const Sun& sun, const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
