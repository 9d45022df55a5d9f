#include <svt/drawing/beyond/covered_region.hpp>

#include <svt/drawing/beyond/line_parts.hpp>
#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kMeetTolerance = 8e-6;  // metres, as in exact sections
constexpr double kInsideBorder = 3e-5;   // metres: lines this near to a border of faces or of the cut are not drawn
constexpr double kAroundThin = 2e-4;     // metres: of sheets that stand upright, and where their lines would be seen
constexpr double kLeastFacing = 0.1;     // cosine: steeper faces do not count as cover
constexpr std::uint32_t kIsCovered = 1;

// Whether a line has a part within a convex ring, at least `slack` from its sides.
bool isWithin(const Ring& ring, PlanePoint from, PlanePoint to, double slack) {
    LinePart part;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        const double eu = b.u - a.u, ev = b.v - a.v, side = std::hypot(eu, ev);
        if (!(side > 0)) continue;
        const auto distance = [&](PlanePoint p) { return (eu * (p.v - a.v) - ev * (p.u - a.u)) / side - slack; };
        if (!clipPart(part, distance(from), distance(to) - distance(from))) return false;
        // A sheet that stands upright has two sides, which do not bound it along itself.
        const auto before = [&](PlanePoint p) { return (eu * (p.u - a.u) + ev * (p.v - a.v)) / side - slack; };
        if (ring.size() == 2 && !clipPart(part, before(from), before(to) - before(from))) return false;
    }
    return true;
}

bool isThin(const Ring& ring) {
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        const double eu = b.u - a.u, ev = b.v - a.v, side = std::hypot(eu, ev);
        double farthest = 0;
        for (const PlanePoint p : ring) farthest = std::max(farthest, (eu * (p.v - a.v) - ev * (p.u - a.u)) / side);
        if (!(farthest > 2 * kAroundThin)) return true;
    }
    return false;
}

}  // namespace

CoveredRegion::CoveredRegion(const SectionDrawing& drawing, const std::vector<LabelFacts>& facts) {
    for (const SectionComponent& component : drawing.components) {
        if (facts[component.label].isSpace) continue;
        for (const SectionPolygon& polygon : component.polygons) {
            addRing(polygon.outer);
            for (const Ring& hole : polygon.holes) addRing(hole);
        }
    }
}

void CoveredRegion::add(const std::vector<ViewFace>& faces, double from, double to) {
    for (const ViewFace& face : faces) {
        if (!(face.normal.z > kLeastFacing)) continue;
        double deepest = 0;
        Ring ring;
        for (std::uint32_t n = 0; n < face.cornerCount; ++n) {
            deepest = std::max(deepest, face.corners[n].z);
            ring.push_back({face.corners[n].x, face.corners[n].y});
        }
        if (deepest > from && deepest <= to) addRing(ring);
    }
    arrange();
}

void CoveredRegion::addRing(const Ring& ring) {
    for (std::size_t n = 0; n < ring.size(); ++n) segments_.emplace_back(ring[n], ring[(n + 1) % ring.size()]);
}

// Keeps only the borders of the region, which stand for all that is covered so far.
void CoveredRegion::arrange() {
    double extent = 1e-3;
    for (const auto& [a, b] : segments_)
        extent = std::max({extent, std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)});
    const double unit = std::ldexp(1.0, std::ilogb(extent) + 1 - 28);
    const auto placed = [&](PlanePoint p) { return plane::Point{std::llround(p.u / unit), std::llround(p.v / unit)}; };
    std::vector<plane::ClaimSegment> segments;
    for (const auto& [a, b] : segments_) segments.push_back({placed(a), placed(b), kIsCovered, 1});
    borders_.clear();
    index_.reset();
    leftmost_ = 0;
    const auto arranged =
        plane::arrangeSegments(segments, std::max(2, static_cast<std::int32_t>(std::lround(kMeetTolerance / unit))));
    if (!arranged) return;
    const auto sides = plane::sweepRegions(*arranged, [](std::span<const plane::ClaimCount> counts) {
        return !counts.empty() && counts.front().winding > 0 ? kIsCovered : 0u;
    });
    segments_.clear();
    std::vector<std::uint32_t> starts{0};
    const auto world = [&](plane::Point p) { return PlanePoint{double(p.u) * unit, double(p.v) * unit}; };
    for (std::size_t e = 0; e < sides.size(); ++e) {
        if (sides[e].left == sides[e].right) continue;
        const PlanePoint from = world(arranged->edges[e].from), to = world(arranged->edges[e].to);
        borders_.push_back(from);
        borders_.push_back(to);
        starts.push_back(static_cast<std::uint32_t>(borders_.size()));
        leftmost_ = std::min({leftmost_, from.u - 1, to.u - 1});
        segments_.emplace_back(sides[e].left == kIsCovered ? from : to, sides[e].left == kIsCovered ? to : from);
    }
    index_.emplace(borders_, starts, 2 * kAroundThin);
}

bool CoveredRegion::contains(const Ring& ring) {
    if (borders_.empty() || ring.size() < 2) return false;
    PlanePoint middle;
    for (const PlanePoint p : ring)
        middle = {middle.u + p.u / double(ring.size()), middle.v + p.v / double(ring.size())};
    const double slack = isThin(ring) ? -kAroundThin : kInsideBorder;
    if (!isWithin(ring, middle, middle, slack)) return false;
    bool isCrossed = false;
    index_->visitNear(ring, seen_, [&](std::uint32_t item) {
        isCrossed = isWithin(ring, borders_[2 * item], borders_[2 * item + 1], slack);
        return !isCrossed;
    });
    return !isCrossed && isCovered(middle);
}

// By the number of borders to the left.
bool CoveredRegion::isCovered(PlanePoint p) {
    bool isInside = false;
    index_->visitNear({leftmost_, p.v}, p, seen_, [&](std::uint32_t item) {
        const PlanePoint a = borders_[2 * item], b = borders_[2 * item + 1];
        if ((a.v > p.v) != (b.v > p.v) && a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u) < p.u) isInside = !isInside;
        return true;
    });
    return isInside;
}

}  // namespace svt::drawing
