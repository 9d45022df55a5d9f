#include <svt/drawing/beyond/cut_region.hpp>

#include <svt/model/classes.hpp>

#include <cmath>

namespace svt::drawing {
namespace {

std::vector<PlanePoint> segmentsOf(const SectionDrawing& drawing, const volume::LabelTable& table) {
    std::vector<PlanePoint> corners;
    const auto add = [&](const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            corners.push_back(ring[n]);
            corners.push_back(ring[(n + 1) % ring.size()]);
        }
    };
    for (const SectionComponent& component : drawing.components) {
        if (model::isSpace(table.labels[component.label].className)) continue;
        for (const SectionPolygon& polygon : component.polygons) {
            add(polygon.outer);
            for (const Ring& hole : polygon.holes) add(hole);
        }
    }
    return corners;
}

std::vector<std::uint32_t> pairStarts(std::size_t corners) {
    std::vector<std::uint32_t> starts;
    for (std::uint32_t n = 0; n <= corners; n += 2) starts.push_back(n);
    return starts;
}

}  // namespace

CutRegion::CutRegion(const SectionDrawing& drawing, const volume::LabelTable& table)
    : corners_(segmentsOf(drawing, table)), index_(corners_, pairStarts(corners_.size()), 1e-6) {
    for (const PlanePoint p : corners_) leftmost_ = std::min(leftmost_, p.u - 1);
}

// By the number of borders to the left. A border between two components is there twice.
bool CutRegion::contains(PlanePoint p, PlaneIndex::Seen& seen) const {
    bool isInside = false;
    index_.visitNear({leftmost_, p.v}, p, seen, [&](std::uint32_t item) {
        const PlanePoint a = corners_[2 * item], b = corners_[2 * item + 1];
        if ((a.v > p.v) != (b.v > p.v)) {
            // Computed from the lower end, so that both copies of a border give the same.
            const PlanePoint low = a.v < b.v ? a : b, high = a.v < b.v ? b : a;
            if (low.u + (p.v - low.v) / (high.v - low.v) * (high.u - low.u) < p.u) isInside = !isInside;
        }
        return true;
    });
    return isInside;
}

void CutRegion::addCovered(PlanePoint from, PlanePoint to, Scratch& scratch, std::vector<LinePart>& covered) const {
    if (corners_.empty()) return;
    std::vector<double>& crossings = scratch.crossings;
    crossings.assign({0, 1});
    const double du = to.u - from.u, dv = to.v - from.v;
    index_.visitNear(from, to, scratch.seen, [&](std::uint32_t item) {
        const PlanePoint a = corners_[2 * item], b = corners_[2 * item + 1];
        const double eu = b.u - a.u, ev = b.v - a.v;
        const double turn = du * ev - dv * eu;
        if (std::abs(turn) <= 1e-12 * std::hypot(du, dv) * std::hypot(eu, ev)) return true;
        const double t = ((a.u - from.u) * ev - (a.v - from.v) * eu) / turn;
        if (t > 0 && t < 1) crossings.push_back(t);
        return true;
    });
    std::sort(crossings.begin(), crossings.end());
    const double least = 1e-6 / std::hypot(du, dv);
    for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
        const double t = 0.5 * (crossings[n] + crossings[n + 1]);
        if (crossings[n + 1] - crossings[n] < least) continue;
        if (!contains({from.u + t * du, from.v + t * dv}, scratch.seen)) continue;
        if (!covered.empty() && covered.back().to >= crossings[n] - least)
            covered.back().to = crossings[n + 1];
        else
            covered.push_back({crossings[n], crossings[n + 1]});
    }
}

}  // namespace svt::drawing
