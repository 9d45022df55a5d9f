// Areas of use, and the scale of projections of the whole world.
#include <svt/crs/crs_facts.hpp>
#include <svt/crs/facts/table_search.hpp>
#include <svt/crs/project/proj_library.hpp>
#include <svt/crs/project/zones.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace svt::crs {
namespace {

constexpr double kMargin = 1;      // degrees
constexpr double kZoneReach = 12;  // degrees from the middle of a zone, in which its coordinates are used
constexpr double kDegrees = 57.295779513082320877;

// `area` may cross the 180th meridian.
bool isInArea(const Box3d& area, Vec3d place) noexcept {
    if (!isFinite(place) || place.y < area.min.y - kMargin || place.y > area.max.y + kMargin) return false;
    const double west = area.min.x - kMargin;
    const double east = area.max.x + kMargin + (area.max.x < area.min.x ? 360 : 0);
    const double x = place.x < west ? place.x + 360 : place.x;
    return x >= west && x <= east;
}

std::optional<Box3d> areaOfDatum(int degrees) noexcept {
    const facts::Datum* const datum = facts::findDatum(degrees);
    if (datum == nullptr) return std::nullopt;
    return Box3d{{datum->west, datum->south, 0}, {datum->east, datum->north, 0}};
}

}  // namespace

std::optional<bool> isInAreaOfUse(int epsg, Vec3d place) {
    const CrsFacts facts = factsOf(epsg);
    if (facts.isDegrees) {
        auto area = areaOfDatum(facts.horizontal);
        if (!area) area = project::projAreaOf(facts.horizontal);
        return area ? std::optional(isInArea(*area, place)) : std::nullopt;
    }
    if (const auto zone = project::findZone(facts.horizontal)) {
        const Vec3d degrees = project::TransverseMercator(zone->ellipsoid, zone->zone).inverse(place);
        const auto area = areaOfDatum(zone->datum);
        return std::abs(degrees.x - zone->zone.longitude) <= kZoneReach && area && isInArea(*area, degrees);
    }
    const auto area = project::projAreaOf(facts.horizontal);
    if (!area) return std::nullopt;
    const auto degrees = project::placeInDegrees(facts.horizontal, place);
    return degrees && isInArea(*area, degrees->place);
}

MapScale mapScaleAt(int epsg, Vec3d place) {
    constexpr int kWorldMercators[] = {3857, 3785, 900913, 102100, 102113, 3395};
    constexpr double kRadius = 6378137;
    const int horizontal = factsOf(epsg).horizontal;
    if (std::find(std::begin(kWorldMercators), std::end(kWorldMercators), horizontal) == std::end(kWorldMercators))
        return {};
    const double north = std::clamp(place.y / kRadius, -3.2, 3.2);
    const Vec3d degrees{place.x / kRadius * kDegrees, std::atan(std::sinh(north)) * kDegrees, 0};
    const auto zone = project::usualZone(4326, degrees);
    return {std::cosh(north), zone ? zone->epsg : 0};
}

}  // namespace svt::crs
