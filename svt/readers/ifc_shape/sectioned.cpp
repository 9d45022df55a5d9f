#include <svt/readers/ifc_shape/sectioned.hpp>

#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/profiles.hpp>
#include <svt/readers/ifc_shape/sweeps.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::ifc {
namespace {

using Regions = std::vector<Region>;

std::size_t cornerCount(const Regions& regions) noexcept {
    std::size_t count = 0;
    for (const Region& region : regions) count += region.pointCount();
    return count;
}

// The place of a section: x and y of the profile, and their origin.
struct Station {
    Vec3d origin{}, x{1, 0, 0}, y{0, 1, 0};
    double distance = 0;  // along the directrix, metres
};

// A directrix with the length up to each of its points.
struct Directrix {
    std::vector<Vec3d> points;
    std::vector<double> lengths;
    bool isInPlan;  // whether `lengths` are in plan

    Directrix(const std::vector<Vec3d>& line, bool areLengthsInPlan) : isInPlan(areLengthsInPlan) {
        for (const Vec3d p : line) {
            const Vec3d ahead = points.empty() ? Vec3d{} : p - points.back();
            const double step = isInPlan ? std::hypot(ahead.x, ahead.y) : length(ahead);
            if (!points.empty() && step < 1e-9) continue;
            lengths.push_back(points.empty() ? 0 : lengths.back() + step);
            points.push_back(p);
        }
    }

    // Across the curve, x to the left, y up; at a corner on the plane that halves the angle.
    [[nodiscard]] Station at(double distance, bool isVertical) const {
        std::size_t s = 0;
        while (s + 2 < points.size() && distance > lengths[s + 1] + 1e-9) ++s;
        const Vec3d before = normalized(points[s + 1] - points[s]);
        Vec3d along = before;
        const bool isCorner = s + 2 < points.size() && std::abs(distance - lengths[s + 1]) <= 1e-6;
        if (isCorner) along = normalized(before + normalized(points[s + 2] - points[s + 1]));
        const Vec3d flat = cross(Vec3d{0, 0, 1}, along);
        Station station;
        station.distance = distance;
        const double stretch = isInPlan ? length(points[s + 1] - points[s]) / (lengths[s + 1] - lengths[s]) : 1;
        station.origin = points[s] + before * ((distance - lengths[s]) * stretch);
        station.x = length(flat) > 1e-9 ? normalized(flat) : Vec3d{0, 1, 0};
        station.y = isVertical ? Vec3d{0, 0, 1} : cross(along, station.x);
        // Seen along the segment before, the section keeps its width.
        station.x = station.x / std::max(0.2, dot(along, before));
        return station;
    }
};

Region placed(const Region& region, const Station& station) {
    return region.mapped([&](const std::vector<Vec3d>& ring) {
        std::vector<Vec3d> result;
        for (const Vec3d p : ring) result.push_back(station.origin + station.x * p.x + station.y * p.y);
        return result;
    });
}

Region mixed(const Region& a, const Region& b, double share) {
    const auto mix = [&](const std::vector<Vec3d>& p, const std::vector<Vec3d>& q) {
        std::vector<Vec3d> ring;
        for (std::size_t i = 0; i < p.size(); ++i) ring.push_back(p[i] + (q[i] - p[i]) * share);
        return ring;
    };
    Region result{mix(a.outer, b.outer), {}};
    for (std::size_t h = 0; h < a.holes.size(); ++h) result.holes.push_back(mix(a.holes[h], b.holes[h]));
    return result;
}

// The profiles of all sections; empty, with a reason, if one is unreadable or differs from the others in its corners.
std::vector<Regions> readSections(const IfcFile& file, Value list, std::string& why) {
    std::vector<Regions> sections;
    for (const RecordIndex profile : file.followAll(list)) {
        Regions regions;
        if (!readProfile(file, profile, regions, why)) return {};
        const bool isAlike =
            sections.empty() || (regions.size() == sections.front().size() &&
                                 std::equal(regions.begin(), regions.end(), sections.front().begin(),
                                            [](const Region& a, const Region& b) { return a.hasCornersOf(b); }));
        if (!isAlike) {
            why = "a sectioned solid between sections of unlike corners";
            return {};
        }
        sections.push_back(std::move(regions));
    }
    return sections;
}

// The places of the sections on the directrix.
bool readStations(const IfcFile& file, const Fields& fields, const Directrix& directrix, bool isVertical,
                  std::vector<Station>& stations, std::string& why) {
    namespace linear = at::Axis2PlacementLinear;
    namespace expression = at::PointByDistanceExpression;
    for (const RecordIndex position : file.followAll(fields[at::SectionedSolidHorizontal::CrossSectionPositions])) {
        if (!file.guard().takeSteps(directrix.points.size())) return false;
        const Fields place = file.fieldsOf(position), point = file.fieldsOf(file.follow(place[linear::Location]));
        const Value distance = point[expression::DistanceAlong];
        if (file.entityOf(position) != Entity::Axis2PlacementLinear || !distance.number() ||
            distance.typeName() == "IFCPARAMETERVALUE") {
            why = "a sectioned solid whose sections stand at no distances";
            return false;
        }
        Station station = directrix.at(file.metres(distance), isVertical);
        const bool isTurned =
            file.follow(place[linear::Axis]) != kNoRecord || file.follow(place[linear::RefDirection]) != kNoRecord;
        if (const auto axes = isTurned ? file.linearAxes(position) : std::nullopt) {
            station.x = axes->y;
            station.y = axes->z;
        }
        const Vec3d along = normalized(cross(station.x, station.y));
        station.origin = station.origin + station.x * file.metres(point[expression::OffsetLateral]) +
                         station.y * file.metres(point[expression::OffsetVertical]) +
                         along * file.metres(point[expression::OffsetLongitudinal]);
        stations.push_back(station);
    }
    return true;
}

// Adds a section at each bend of the directrix between two sections.
bool addAtBends(const IfcFile& file, const Directrix& directrix, bool isVertical, std::vector<Station>& stations,
                std::vector<Regions>& sections) {
    const auto canLookUp = [&](std::size_t times) { return file.guard().takeSteps(times * directrix.points.size()); };
    std::vector<Station> all;
    std::vector<Regions> between;
    for (std::size_t s = 0; s < stations.size(); ++s) {
        if (!canLookUp(1)) return false;
        for (std::size_t p = 0; s > 0 && p < directrix.points.size(); ++p) {
            const double from = stations[s - 1].distance, to = stations[s].distance, at = directrix.lengths[p];
            if (!(at > from + 1e-6 && at < to - 1e-6)) continue;
            if (!canLookUp(3) || !file.guard().takeElements(cornerCount(sections[s]))) return false;
            const double share = (at - from) / (to - from);
            Station corner = directrix.at(at, isVertical);
            const auto offset = [&](const Station& station) {
                return station.origin - directrix.at(station.distance, isVertical).origin;
            };
            // Offsets turn with the curve.
            const Station low = directrix.at(from, isVertical);
            const Vec3d moved = offset(stations[s - 1]);
            corner.origin = corner.origin + corner.x * dot(moved, normalized(low.x)) + corner.y * dot(moved, low.y);
            all.push_back(corner);
            Regions regions;
            for (std::size_t r = 0; r < sections[s].size(); ++r)
                regions.push_back(mixed(sections[s - 1][r], sections[s][r], share));
            between.push_back(std::move(regions));
        }
        all.push_back(stations[s]);
        between.push_back(sections[s]);
    }
    stations = std::move(all);
    sections = std::move(between);
    return true;
}

// Along the directrix, with sections between where it bends.
bool addAlong(const IfcFile& file, const Fields& fields, std::vector<Station>& stations, std::vector<Regions>& sections,
              std::string& why) {
    std::vector<Vec3d> line;
    const RecordIndex curve = file.follow(fields[at::SectionedSolidHorizontal::Directrix]);
    if (!readCurve(file, curve, line, why)) return false;
    const Directrix directrix(line, isMeasuredInPlan(file, curve));
    if (directrix.points.size() < 2) {
        why = "a sectioned solid whose directrix has no length";
        return false;
    }
    const bool isVertical = fields[at::SectionedSolidHorizontal::FixedAxisVertical].enumeration() == "T";
    if (!readStations(file, fields, directrix, isVertical, stations, why)) return false;
    if (stations.size() != sections.size()) {
        why = "a sectioned solid with more sections than places, or fewer";
        return false;
    }
    return addAtBends(file, directrix, isVertical, stations, sections);
}

bool addSpine(const IfcFile& file, const Fields& fields, std::vector<Station>& stations, std::size_t sections,
              std::string& why) {
    for (const RecordIndex position : file.followAll(fields[at::SectionedSpine::CrossSectionPositions])) {
        const Transform axes = file.axes(position);
        stations.push_back({axes.origin, axes.x, axes.y, 0});
    }
    if (stations.size() == sections) return true;
    why = "a sectioned spine with more sections than places, or fewer";
    return false;
}

}  // namespace

std::vector<std::vector<model::Polygon>> readSectioned(const IfcFile& file, RecordIndex item, std::string& why) {
    const Fields fields = file.fieldsOf(item);
    std::vector<Regions> sections = readSections(file, fields[at::SectionedSpine::CrossSections], why);
    std::vector<Station> stations;
    const bool isSpine = file.entityOf(item) == Entity::SectionedSpine;
    if (sections.size() < 2) {
        if (why.empty()) why = fmt::format("an {} of fewer than two sections", file.typeName(item));
        return {};
    }
    if (isSpine ? !addSpine(file, fields, stations, sections.size(), why)
                : !addAlong(file, fields, stations, sections, why)) {
        if (file.guard().isSpent()) why = file.guard().whatIsSpent();
        return {};
    }
    std::vector<std::vector<model::Polygon>> bodies;
    std::uint64_t made = 0;
    for (std::size_t r = 0; r < sections.front().size(); ++r) {
        if (!file.guard().affords(made + sections.front()[r].pointCount() * 6 * sections.size())) {
            why = file.guard().whatIsSpent();
            return {};
        }
        Regions rings;
        for (std::size_t s = 0; s < sections.size(); ++s) rings.push_back(placed(sections[s][r], stations[s]));
        std::vector<model::Polygon> faces = loft(rings);
        made += pointCount(faces);
        if (!faces.empty()) bodies.push_back(std::move(faces));
    }
    if (bodies.empty()) why = fmt::format("an {} whose measures make no body", file.typeName(item));
    return bodies;
}

}  // namespace svt::readers::ifc
