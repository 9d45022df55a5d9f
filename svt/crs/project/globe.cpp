#include <svt/crs/globe.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/crs/project/elementary.hpp>
#include <svt/crs/project/proj_library.hpp>
#include <svt/crs/project/zones.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::crs {
namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295769;
constexpr double kStep = 64;  // metres to both sides, for the directions of a projection

bool isPlaceOnEarth(Vec3d place) noexcept { return std::abs(place.x) <= 360 && std::abs(place.y) <= 90; }

}  // namespace

Result<Vec3d> placeOnEarth(int epsg, Vec3d place) {
    const int horizontal = factsOf(epsg).horizontal;
    if (factsOf(horizontal).isDegrees)
        return Error(Code::CannotProject,
                     fmt::format("EPSG:{} is in degrees, but the coordinates are metres of an unknown projection; "
                                 "name a projection",
                                 epsg));
    Vec3d found = place;
    if (const auto zone = project::findZone(horizontal)) {
        found = project::TransverseMercator(zone->ellipsoid, zone->zone).inverse(place);
    } else {
        SVT_TRY(degrees, project::placeInDegrees(horizontal, place));
        found = {degrees->place.x, degrees->place.y, place.z};
    }
    if (!isPlaceOnEarth(found))
        return Error(Code::CannotProject,
                     fmt::format("({}, {}) is outside the range of EPSG:{}", place.x, place.y, epsg));
    return found;
}

std::optional<double> geoidHeight(int epsg, int vertical, Vec3d place) {
    if (epsg == 0 || vertical == 0) return std::nullopt;
    return project::projGeoidHeight(factsOf(epsg).horizontal, vertical, place);
}

Vec3d earthCentred(Vec3d place) noexcept {
    const auto [semiMajorAxis, inverseFlattening] = project::kWgs84;
    const double f = 1 / inverseFlattening, e2 = f * (2 - f);
    const auto latitude = project::sineCosine(place.y * kRadiansPerDegree),
               longitude = project::sineCosine(place.x * kRadiansPerDegree);
    const double n = semiMajorAxis / std::sqrt(1 - e2 * latitude.sine * latitude.sine);
    const double fromAxis = (n + place.z) * latitude.cosine;
    return {fromAxis * longitude.cosine, fromAxis * longitude.sine, (n * (1 - e2) + place.z) * latitude.sine};
}

GlobeFrame frameAt(Vec3d place) noexcept {
    const auto latitude = project::sineCosine(place.y * kRadiansPerDegree),
               longitude = project::sineCosine(place.x * kRadiansPerDegree);
    return {earthCentred(place),
            {Vec3d{-longitude.sine, longitude.cosine, 0},
             Vec3d{-latitude.sine * longitude.cosine, -latitude.sine * longitude.sine, latitude.cosine},
             Vec3d{latitude.cosine * longitude.cosine, latitude.cosine * longitude.sine, latitude.sine}}};
}

Result<GlobeFrame> frameOf(int epsg, Vec3d place) {
    SVT_TRY(at, placeOnEarth(epsg, place));
    GlobeFrame frame = frameAt(*at);
    for (int axis = 0; axis < 2; ++axis) {
        Vec3d ahead = place, behind = place;
        ahead[axis] += kStep;
        behind[axis] -= kStep;
        SVT_TRY(to, placeOnEarth(epsg, ahead), from = placeOnEarth(epsg, behind));
        if (!from) return from.error();
        frame.axes[static_cast<std::size_t>(axis)] = (earthCentred(*to) - earthCentred(*from)) * (1 / (2 * kStep));
    }
    return frame;
}

}  // namespace svt::crs
