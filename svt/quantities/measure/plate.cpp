#include <svt/quantities/measure/plate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::quantities {
namespace {

constexpr std::size_t kMostDirections = 48;
constexpr double kParallel = 1 - 1e-6;

struct Facet {
    Vec3d normal{}, center{};
    double area = 0;
};

struct Direction {
    Vec3d normal{};
    double area = 0;
};

std::vector<Facet> facetsOf(std::span<const Corners> triangles) {
    std::vector<Facet> facets;
    facets.reserve(triangles.size());
    for (const Corners& t : triangles) {
        const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
        const double twice = length(normal);
        if (twice > 0) facets.push_back({normal / twice, (t[0] + t[1] + t[2]) / 3.0, twice / 2});
    }
    std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.area > b.area; });
    return facets;
}

// The directions of the largest faces, both senses as one.
std::vector<Direction> directionsOf(const std::vector<Facet>& facets) {
    std::vector<Direction> directions;
    for (const Facet& facet : facets) {
        const auto same = std::find_if(directions.begin(), directions.end(), [&](const Direction& d) {
            return std::abs(dot(d.normal, facet.normal)) > kParallel;
        });
        if (same != directions.end())
            same->area += facet.area;
        else if (directions.size() < kMostDirections)
            directions.push_back({facet.normal, facet.area});
    }
    return directions;
}

// The largest plane of the facets that look along a normal: its place and its area.
std::pair<double, double> largestPlane(const std::vector<Facet>& facets, Vec3d normal) {
    std::vector<std::pair<double, double>> places;
    for (const Facet& facet : facets)
        if (dot(facet.normal, normal) > kParallel) places.emplace_back(dot(facet.center, normal), facet.area);
    std::sort(places.begin(), places.end());
    std::pair<double, double> best{0, 0};
    for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
        double area = 0, moment = 0;
        for (end = begin; end < places.size() && places[end].first - places[begin].first <= kFlatness; ++end) {
            area += places[end].second;
            moment += places[end].first * places[end].second;
        }
        if (area > best.second) best = {moment / area, area};
    }
    return best;
}

std::optional<Plate> plateAcross(const std::vector<Facet>& facets, Vec3d normal) {
    double seen = 0;
    for (const Facet& facet : facets) seen += std::max(0.0, dot(facet.normal, normal)) * facet.area;
    const auto [front, frontArea] = largestPlane(facets, normal);
    const auto [back, backArea] = largestPlane(facets, -normal);
    const bool isPlate = frontArea >= 0.5 * seen && backArea >= 0.5 * seen && seen > 0 && front + back > kFlatness;
    if (!isPlate) return std::nullopt;
    Plate plate;
    plate.normal = normal;
    plate.front = front;
    plate.back = -back;
    return plate;
}

// Horizontal, and for bodies that lie flat along their longest straight edges.
Vec3d alongOf(const Plate& plate, const std::vector<Direction>& directions) {
    if (std::abs(plate.normal.z) < 1 - 1e-9) return normalized(cross(Vec3d{0, 0, 1}, plate.normal));
    Direction best{{0, 1, 0}, 0};
    for (const Direction& d : directions)
        if (std::abs(d.normal.z) < 0.1 && d.area > best.area) best = d;
    return normalized(cross(plate.normal, best.normal));
}

}  // namespace

std::optional<Plate> findPlate(std::span<const Corners> triangles) {
    const std::vector<Facet> facets = facetsOf(triangles);
    const std::vector<Direction> directions = directionsOf(facets);
    std::optional<Plate> best;
    for (const Direction& direction : directions) {
        const auto plate = plateAcross(facets, direction.normal);
        if (!plate) continue;
        const double difference = best ? plate->thickness() - best->thickness() : -1;
        const bool isClearlyThinner = difference < -kFlatness;
        const bool isAlikeButUpright = difference < kFlatness && plate->isUpright() && best && !best->isUpright();
        if (!best || isClearlyThinner || isAlikeButUpright) best = plate;
    }
    if (best) best->along = alongOf(*best, directions);
    return best;
}

}  // namespace svt::quantities
