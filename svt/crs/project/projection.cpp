#include <svt/crs/projection.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/crs/facts/table_search.hpp>
#include <svt/crs/project/elementary.hpp>
#include <svt/crs/project/proj_library.hpp>
#include <svt/crs/project/way.hpp>
#include <svt/crs/project/zones.hpp>

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

namespace svt::crs {
namespace {

class MercatorWay final : public Projection::Way {
public:
    explicit MercatorWay(const project::DatumZone& zone) : mercator_(zone.ellipsoid, zone.zone) {}
    void apply(std::span<Vec3d> points) const override {
        for (Vec3d& point : points) point = mercator_.forward(point);
    }

private:
    project::TransverseMercator mercator_;
};

class UnitWay final : public Projection::Way {
public:
    explicit UnitWay(const facts::MetricTwin& twin) : twin_(twin) {}
    void apply(std::span<Vec3d> points) const override {
        for (Vec3d& point : points)
            point = {point.x * twin_.metresPerUnit + twin_.offset.x, point.y * twin_.metresPerUnit + twin_.offset.y,
                     point.z};
    }

private:
    facts::MetricTwin twin_;
};

Projection toTwin(const facts::MetricTwin& twin) {
    return {twin.epsg, {}, twin.metresPerUnit, std::make_shared<const UnitWay>(twin)};
}

Projection toZone(project::DatumZone zone) {
    auto way = std::make_shared<const MercatorWay>(zone);
    return {zone.epsg, std::move(zone.name), 1, std::move(way)};
}

bool isOnEarth(Vec3d place) noexcept { return std::abs(place.x) <= 360 && std::abs(place.y) <= 90; }

// Conversions without PROJ: degrees of a known datum to one of its zones, feet to the same projection in metres.
std::optional<Projection> ownWay(int source, int target) {
    if (const auto twin = facts::findMetricTwin(source); twin && twin->epsg == target) return toTwin(*twin);
    const auto zone = project::findZone(target);
    if (zone && factsOf(source).isDegrees && zone->datum == facts::datumOfDegrees(source)) return toZone(*zone);
    return std::nullopt;
}

}  // namespace

Result<Projection> Projection::toUsualMetres(int source, Vec3d place) {
    source = factsOf(source).horizontal;
    if (const auto twin = facts::findMetricTwin(source)) return toTwin(*twin);
    if (factsOf(source).isDegrees) {
        if (!isOnEarth(place))
            return Error(Code::CannotProject,
                         fmt::format("({}, {}) is not a longitude and latitude in degrees", place.x, place.y));
        if (auto zone = project::usualZone(source, place)) return toZone(std::move(*zone));
        const auto zone = project::usualZone(4326, place);
        return project::projBetween(source, zone->epsg);
    }
    SVT_TRY(degrees, project::placeInDegrees(source, place));
    if (!isOnEarth(degrees->place))
        return Error(Code::CannotProject,
                     fmt::format("({}, {}) is outside the range of EPSG:{}", place.x, place.y, source));
    auto zone = project::usualZone(degrees->epsg, degrees->place);
    if (!zone) zone = project::usualZone(4326, degrees->place);
    return project::projBetween(source, zone->epsg);
}

Result<Projection> Projection::between(int source, int target, Vec3d place) {
    source = factsOf(source).horizontal;
    if (factsOf(source).isDegrees && !isOnEarth(place))
        return Error(Code::CannotProject,
                     fmt::format("({}, {}) is not a longitude and latitude in degrees", place.x, place.y));
    if (auto way = ownWay(source, target)) return std::move(*way);
    return project::projBetween(source, target);
}

Vec3d metresPerDegree(double latitude) noexcept {
    constexpr double kRadians = 0.017453292519943295769;
    const auto [semiMajorAxis, inverseFlattening] = project::kGrs80;
    const double f = 1 / inverseFlattening, e2 = f * (2 - f);
    const auto [sine, cosine] = project::sineCosine(latitude * kRadians);
    const double w = std::sqrt(1 - e2 * sine * sine);
    return {kRadians * cosine * semiMajorAxis / w, kRadians * semiMajorAxis * (1 - e2) / (w * w * w), 1};
}

void Projection::apply(std::span<Vec3d> points) const { way_->apply(points); }

}  // namespace svt::crs
