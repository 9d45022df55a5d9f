#include <svt/drawing/footprint/outline_union.hpp>

#include <svt/drawing/section/section_rings.hpp>
#include <svt/plane/arrangement.hpp>
#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr std::int64_t kReach = std::int64_t{1} << 28;  // the arrangement accepts twice as much
constexpr double kMeetingDistance = 8e-6;               // metres
constexpr std::uint32_t kInside = 0;                    // label of the union

using MapRing = std::vector<std::array<double, 2>>;

double signedAreaOf(const MapRing& ring) noexcept {
    double twice = 0;
    const auto [x0, y0] = ring.front();
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
        twice += (ring[n][0] - x0) * (ring[n + 1][1] - y0) - (ring[n][1] - y0) * (ring[n + 1][0] - x0);
    return twice / 2;
}

}  // namespace

double areaOf(const PlanPolygon& polygon) noexcept {
    double area = 0;
    for (const MapRing& ring : polygon.rings) area += signedAreaOf(ring);
    return area;
}

void OutlineUnion::addTriangle(const std::array<plane::Point, 3>& corners) {
    const int turn = plane::turn(corners[0], corners[1], corners[2]);
    if (turn == 0) return;
    for (std::size_t n = 0; n < 3; ++n) {
        const plane::Point from = corners[n], to = corners[(n + 1) % 3];
        if (turn > 0)
            addEdge(from, to);
        else
            addEdge(to, from);
    }
}

void OutlineUnion::addEdge(plane::Point from, plane::Point to) {
    if (from < to)
        borders_.push_back({from, to, 1});
    else if (to < from)
        borders_.push_back({to, from, -1});
}

// Sums equal borders: those between adjacent faces vanish.
std::vector<OutlineUnion::Border> OutlineUnion::cancelled() const {
    std::vector<Border> borders = borders_;
    std::sort(borders.begin(), borders.end(),
              [](const Border& a, const Border& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    std::size_t kept = 0;
    for (std::size_t begin = 0, end = 0; begin < borders.size(); begin = end) {
        Border sum = borders[begin];
        for (end = begin + 1; end < borders.size() && borders[end].from == sum.from && borders[end].to == sum.to; ++end)
            sum.winding += borders[end].winding;
        if (sum.winding != 0) borders[kept++] = sum;
    }
    borders.resize(kept);
    return borders;
}

std::vector<PlanPolygon> OutlineUnion::polygons(double unit, std::array<double, 2> origin, double leastArea) const {
    const std::vector<Border> borders = cancelled();
    plane::Box box;
    for (const Border& border : borders) {
        box.add(border.from);
        box.add(border.to);
    }
    if (borders.empty()) return {};
    // Relative to the lower corner, in coarser units where the extent needs it.
    int shift = 0;
    while (std::max(box.high.u - box.low.u, box.high.v - box.low.v) >> shift > kReach) ++shift;
    const double step = std::ldexp(unit, shift);
    const auto placed = [&](plane::Point p) -> plane::Point {
        return {(p.u - box.low.u) >> shift, (p.v - box.low.v) >> shift};
    };
    std::vector<plane::ClaimSegment> segments;
    for (const Border& border : borders) {
        const plane::Point from = placed(border.from), to = placed(border.to);
        if (from != to) segments.push_back({from, to, kInside, border.winding});
    }
    std::optional<plane::Arrangement> arranged;
    auto tolerance = std::max(2, static_cast<std::int32_t>(std::lround(kMeetingDistance / step)));
    for (int trial = 0; trial < 3 && !arranged; ++trial, tolerance *= 8)
        arranged = plane::arrangeSegments(segments, tolerance);
    if (!arranged) return {};
    const auto sides = plane::sweepRegions(*arranged, [](std::span<const plane::ClaimCount> counts) -> std::uint32_t {
        return !counts.empty() && counts.front().winding > 0 ? 1 : 0;
    });
    std::vector<PieceEdge> edges;
    for (std::size_t e = 0; e < sides.size(); ++e) {
        const plane::ArrangementEdge& edge = arranged->edges[e];
        if (sides[e].left == sides[e].right) continue;
        edges.push_back(sides[e].left != 0 ? PieceEdge{edge.from, edge.to, kInside}
                                           : PieceEdge{edge.to, edge.from, kInside});
    }
    std::vector<DrawingBorder> joined = joinEdges(std::move(edges));
    straighten(joined, 1);

    std::vector<std::pair<double, PlanPolygon>> sorted;
    for (const DrawingPolygon& drawn : makePolygons(joined)) {
        PlanPolygon polygon;
        for (const auto& points : drawn.rings) {
            MapRing ring;
            for (const RingPoint& p : points)
                ring.push_back({origin[0] + (double(box.low.u) + std::ldexp(double(p.point.u), shift)) * unit,
                                origin[1] + (double(box.low.v) + std::ldexp(double(p.point.v), shift)) * unit});
            if (ring.size() >= 3 && std::abs(signedAreaOf(ring)) >= leastArea)
                polygon.rings.push_back(std::move(ring));
            else if (polygon.rings.empty())
                break;
        }
        if (!polygon.rings.empty()) sorted.emplace_back(areaOf(polygon), std::move(polygon));
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<PlanPolygon> polygons;
    for (auto& [area, polygon] : sorted) polygons.push_back(std::move(polygon));
    return polygons;
}

}  // namespace svt::drawing
