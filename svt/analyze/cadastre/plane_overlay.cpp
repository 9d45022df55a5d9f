#include <svt/analyze/cadastre/plane_overlay.hpp>

#include <svt/plane/regions.hpp>
#include <svt/plane/rings.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace svt::analyze {
namespace {

using plane::Point;

// Coordinates of an arrangement are at most 2^29.
constexpr double kLargestCoordinate = 0x1p28;
constexpr std::int64_t kCollinear = 4;  // units by which a corner may deviate from a straight line

using Walk = std::vector<Point>;

// Order of directions at a node, clockwise from `reference`, which comes last.
int sectorOf(Point reference, Point direction) noexcept {
    const plane::Wide side = plane::cross(reference, direction);
    if (side != 0) return side < 0 ? 0 : 2;
    return plane::dot(reference, direction) < 0 ? 1 : 3;
}

bool comesFirstClockwise(Point reference, Point a, Point b) noexcept {
    const int sectorA = sectorOf(reference, a), sectorB = sectorOf(reference, b);
    return sectorA != sectorB ? sectorA < sectorB : plane::cross(a, b) < 0;
}

// Walks along the borders of a region, which lies to the left.
std::vector<Walk> walksAround(const std::vector<std::pair<Point, Point>>& edges) {
    std::multimap<Point, std::size_t> leaving;
    for (std::size_t e = 0; e < edges.size(); ++e) leaving.emplace(edges[e].first, e);
    std::vector<char> isUsed(edges.size(), 0);
    std::vector<Walk> walks;
    for (std::size_t first = 0; first < edges.size(); ++first) {
        if (isUsed[first] != 0) continue;
        Walk walk;
        for (std::size_t at = first; isUsed[at] == 0;) {
            isUsed[at] = 1;
            walk.push_back(edges[at].first);
            const Point back = edges[at].first - edges[at].second;
            const auto [begin, end] = leaving.equal_range(edges[at].second);
            std::size_t next = at;
            for (auto it = begin; it != end; ++it) {
                if (isUsed[it->second] != 0 && it->second != first) continue;
                const Point direction = edges[it->second].second - edges[it->second].first;
                if (next == at || comesFirstClockwise(back, direction, edges[next].second - edges[next].first))
                    next = it->second;
            }
            at = next;
        }
        walks.push_back(std::move(walk));
    }
    return walks;
}

double areaOf(const Walk& ring) noexcept {
    double twice = 0;
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
        twice += static_cast<double>(plane::cross(ring[n] - ring[0], ring[n + 1] - ring[0]));
    return 0.5 * twice;
}

// Without corners on straight lines.
Walk simplified(const Walk& ring) {
    Walk kept;
    const auto isStraight = [](Point a, Point b, Point c) {
        const double along = std::hypot(double(c.u - a.u), double(c.v - a.v));
        return std::abs(static_cast<double>(plane::cross(b - a, c - a))) <= kCollinear * along &&
               plane::dot(b - a, c - b) > 0;
    };
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Point before = kept.empty() ? ring.back() : kept.back();
        if (!isStraight(before, ring[n], ring[(n + 1) % ring.size()])) kept.push_back(ring[n]);
    }
    while (kept.size() > 3 && isStraight(kept[kept.size() - 1], kept[0], kept[1])) kept.erase(kept.begin());
    return kept;
}

double borderOf(const Walk& ring) noexcept {
    double sum = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Point side = ring[(n + 1) % ring.size()] - ring[n];
        sum += std::hypot(double(side.u), double(side.v));
    }
    return sum;
}

// Whether a ring encloses the middle of a line, by the odd rule; coordinates are doubled to be whole.
bool encloses(const Walk& ring, Point from, Point to) noexcept {
    const Point p{from.u + to.u, from.v + to.v};
    bool isInside = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Point a{2 * ring[n].u, 2 * ring[n].v}, next = ring[(n + 1) % ring.size()];
        const Point b{2 * next.u, 2 * next.v};
        if ((a.v > p.v) == (b.v > p.v)) continue;
        if ((plane::turn(a, b, p) > 0) == (b.v > a.v)) isInside = !isInside;
    }
    return isInside;
}

class RegionMaker {
public:
    RegionMaker(double unit, double thinnest) : unit_(unit), thinnest_(thinnest / unit) {}

    [[nodiscard]] std::vector<OverlayPolygon> make(const std::vector<std::pair<Point, Point>>& edges) const {
        std::vector<Walk> outers, holes;
        for (const Walk& walk : walksAround(edges))
            plane::splitAtRepeats(
                walk, [](Point p) { return p; },
                [&](const Walk& ring) {
                    if (ring.size() < 3) return;
                    const double area = areaOf(ring);
                    // The mean width of a strip is its area by half of its border.
                    if (std::abs(area) < 0.5 * thinnest_ * borderOf(ring)) return;
                    (area > 0 ? outers : holes).push_back(ring);
                });
        std::vector<OverlayPolygon> polygons;
        for (const Walk& outer : outers) polygons.push_back({ringOf(outer), {}, areaOf(outer) * unit_ * unit_});
        for (const Walk& hole : holes) {
            std::size_t best = outers.size();
            for (std::size_t n = 0; n < outers.size(); ++n)
                if (encloses(outers[n], hole[0], hole[1]) &&
                    (best == outers.size() || areaOf(outers[n]) < areaOf(outers[best])))
                    best = n;
            if (best == outers.size()) continue;
            polygons[best].holes.push_back(ringOf(hole));
            polygons[best].area += areaOf(hole) * unit_ * unit_;
        }
        std::erase_if(polygons, [](const OverlayPolygon& polygon) { return polygon.outer.size() < 3; });
        return polygons;
    }

private:
    [[nodiscard]] OverlayRing ringOf(const Walk& walk) const {
        OverlayRing ring;
        for (const Point p : simplified(walk)) ring.push_back({double(p.u) * unit_, double(p.v) * unit_});
        return ring;
    }

    double unit_, thinnest_;
};

}  // namespace

OverlayAxes OverlayAxes::across(Vec3d normal) noexcept {
    if (std::hypot(normal.x, normal.y) < 1e-9)
        return normal.z > 0 ? OverlayAxes{} : OverlayAxes{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    const Vec3d u = normalized(cross(Vec3d{0, 0, 1}, normal));
    return {u, cross(normal, u), normal};
}

PlaneOverlay::PlaneOverlay(double extent, double snap) : unit_(0x1p-20), snap_(snap) {
    while (extent / unit_ > kLargestCoordinate) unit_ *= 2;
}

void PlaneOverlay::add(const OverlayRing& ring, std::uint32_t claim) {
    const auto whole = [&](double value) { return std::int64_t(std::llround(value / unit_)); };
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const OverlayPoint &a = ring[n], &b = ring[(n + 1) % ring.size()];
        const Segment segment{{whole(a[0]), whole(a[1]), whole(b[0]), whole(b[1])}, claim};
        if (segment.ends[0] != segment.ends[2] || segment.ends[1] != segment.ends[3]) segments_.push_back(segment);
    }
}

std::optional<std::vector<OverlayRegion>> PlaneOverlay::run() const {
    std::vector<plane::ClaimSegment> segments;
    segments.reserve(segments_.size());
    for (const Segment& s : segments_) segments.push_back({{s.ends[0], s.ends[1]}, {s.ends[2], s.ends[3]}, s.claim, 1});
    const auto tolerance = static_cast<std::int32_t>(std::max(2.0, std::ceil(snap_ / unit_)));
    const auto arrangement = plane::arrangeSegments(segments, tolerance);
    if (!arrangement) return std::nullopt;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numberOf{{{}, 0}};
    const auto sides = plane::sweepRegions(*arrangement, [&](std::span<const plane::ClaimCount> counts) {
        std::vector<std::uint32_t> claims;
        for (const plane::ClaimCount& count : counts)
            if (count.winding > 0) claims.push_back(count.claim);
        return numberOf.try_emplace(std::move(claims), static_cast<std::uint32_t>(numberOf.size())).first->second;
    });
    std::vector<std::vector<std::pair<Point, Point>>> edgesOf(numberOf.size());
    for (std::size_t e = 0; e < sides.size(); ++e) {
        const plane::ArrangementEdge& edge = arrangement->edges[e];
        if (sides[e].left == sides[e].right) continue;
        edgesOf[sides[e].left].emplace_back(edge.from, edge.to);
        edgesOf[sides[e].right].emplace_back(edge.to, edge.from);
    }
    const RegionMaker maker(unit_, 5 * snap_);
    std::vector<OverlayRegion> regions;
    for (const auto& [claims, number] : numberOf) {
        if (claims.empty()) continue;
        auto polygons = maker.make(edgesOf[number]);
        if (!polygons.empty()) regions.push_back({claims, std::move(polygons)});
    }
    return regions;
}

std::vector<OverlayPoint> pointsInside(const OverlayPolygon& polygon) {
    constexpr int kLevels = 8, kPerStretch = 4;
    double low = polygon.outer.front()[1], high = low;
    for (const OverlayPoint& p : polygon.outer) {
        low = std::min(low, p[1]);
        high = std::max(high, p[1]);
    }
    std::vector<OverlayPoint> points;
    for (int level = 0; level < kLevels; ++level) {
        const double v = low + (high - low) * (level + 0.5) / kLevels;
        std::vector<double> crossings;
        const auto cut = [&](const OverlayRing& ring) {
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const OverlayPoint &a = ring[n], &b = ring[(n + 1) % ring.size()];
                if ((a[1] > v) != (b[1] > v)) crossings.push_back(a[0] + (b[0] - a[0]) * (v - a[1]) / (b[1] - a[1]));
            }
        };
        cut(polygon.outer);
        for (const OverlayRing& hole : polygon.holes) cut(hole);
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
            for (int part = 0; part < kPerStretch; ++part)
                points.push_back({crossings[n] + (crossings[n + 1] - crossings[n]) * (part + 0.5) / kPerStretch, v});
    }
    return points;
}

}  // namespace svt::analyze
