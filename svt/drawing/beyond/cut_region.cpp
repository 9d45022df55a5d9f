#include <svt/drawing/beyond/cut_region.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
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
    sortIntoRows();
}

// Borders by the rows of the drawing that they meet, from the left.
void CutRegion::sortIntoRows() {
    if (corners_.empty()) return;
    double top = -kInfinity;
    for (const PlanePoint p : corners_) {
        bottom_ = std::min(bottom_, p.v);
        top = std::max(top, p.v);
    }
    const std::size_t count = std::min<std::size_t>(corners_.size() / 2, kMostRows);
    rowHeight_ = std::max((top - bottom_) / static_cast<double>(count), 1e-6);
    rows_.resize(count + 1);
    for (std::size_t n = 0; n < corners_.size(); n += 2) {
        const PlanePoint a = corners_[n], b = corners_[n + 1];
        // Computed from the lower end, so that both copies of a border give the same.
        const Border border{a.v < b.v ? a : b, a.v < b.v ? b : a, std::min(a.u, b.u)};
        for (std::size_t row = rowOf(border.low.v); row <= rowOf(border.high.v); ++row) rows_[row].push_back(border);
    }
    for (std::vector<Border>& row : rows_)
        std::sort(row.begin(), row.end(), [](const Border& a, const Border& b) { return a.left < b.left; });
}

std::size_t CutRegion::rowOf(double v) const noexcept {
    return static_cast<std::size_t>(std::min((v - bottom_) / rowHeight_, static_cast<double>(rows_.size() - 1)));
}

// By the number of borders to the left. A border between two components is there twice.
bool CutRegion::contains(PlanePoint p) const {
    constexpr double kRounding = 1e-6;  // metres
    if (!(p.v >= bottom_)) return false;
    bool isInside = false;
    for (const Border& border : rows_[rowOf(p.v)]) {
        if (border.left > p.u + kRounding) break;
        const PlanePoint low = border.low, high = border.high;
        if ((low.v > p.v) == (high.v > p.v)) continue;
        if (low.u + (p.v - low.v) / (high.v - low.v) * (high.u - low.u) < p.u) isInside = !isInside;
    }
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
        if (!contains({from.u + t * du, from.v + t * dv})) continue;
        if (!covered.empty() && covered.back().to >= crossings[n] - least)
            covered.back().to = crossings[n + 1];
        else
            covered.push_back({crossings[n], crossings[n + 1]});
    }
}

}  // namespace svt::drawing
