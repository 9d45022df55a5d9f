#pragma once
/// \file
/// Where the sun stands, by date, hour and place: the key light of a picture.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string_view>

namespace svt::illustrate {

/// Degrees. Elevation is the true one: refraction, which lifts the sun by 0.5 degrees at the horizon, is left out, since it
/// does not change shadows by what could be seen.
struct SunPosition {
    double azimuth = 0;    ///< clockwise from true north, 0..360
    double elevation = 0;  ///< above the horizon, negative at night
};

/// The sun as seen from a place. The series of low accuracy of Meeus, Astronomical Algorithms (1998), chapters 25 and 28,
/// that the NOAA Solar Calculator uses: within 0.02 degrees from 1950 to 2050.
/// \param julianDay  of universal time
/// \param latitude, longitude  degrees, north and east positive
[[nodiscard]] SunPosition sunPosition(double julianDay, double latitude, double longitude) noexcept;

/// The Julian day of a text such as "2026-06-21 15:00", "2026-06-21T15:00:30+02:00" or "2026-06-21 13:00Z".
/// \param longitude  degrees: without an offset or Z, time is that of the meridian, longitude / 15 rounded to whole hours;
///                   summer time is not known
/// \return the day, or BadScene that says what is expected
[[nodiscard]] Result<double> parseSunTime(std::string_view text, double longitude);

/// The light of Scene::sun on a volume.
struct Sunlight {
    SunPosition position;
    Vec3d direction;  ///< towards the sun; world space, unit length
    double latitude = 0, longitude = 0;
};

/// The place is that of Scene::sun, else that of the CRS, else the attributes `latitude` and `longitude` of a feature (IfcSite).
/// North is that of the map, turned by the convergence of its meridians where the place is from the CRS; by the attribute
/// `trueNorth` where it is from attributes; else +y.
/// \return the light, or BadScene for a bad time, or where nothing says where the building stands
[[nodiscard]] Result<Sunlight> sunlightOf(const Sun& sun, const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
