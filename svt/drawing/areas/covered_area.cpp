#include <svt/drawing/areas/covered_area.hpp>

#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kMeetDistance = 8e-6;  // metres, as in exact sections
constexpr std::uint32_t kCovered = 1;

}  // namespace

void CoveredArea::add(const SectionComponent& component, const SectionDrawing& drawing) {
    auto known = std::find(drawings_.begin(), drawings_.end(), &drawing);
    if (known == drawings_.end()) known = drawings_.insert(drawings_.end(), &drawing);
    parts_.push_back({&component, static_cast<std::uint32_t>(known - drawings_.begin())});
}

std::optional<double> CoveredArea::get() const {
    double unit = 0;
    for (const SectionDrawing* drawing : drawings_) unit = std::max(unit, drawing->drawingUnit);
    if (!(unit > 0)) return 0.0;
    const auto pointOf = [&](PlanePoint p) { return plane::Point{std::llround(p.u / unit), std::llround(p.v / unit)}; };
    std::vector<plane::ClaimSegment> segments;
    const auto addRing = [&](const Ring& ring, std::uint32_t claim) {
        for (std::size_t n = 0; n < ring.size(); ++n)
            segments.push_back({pointOf(ring[n]), pointOf(ring[(n + 1) % ring.size()]), claim, 1});
    };
    for (const Part& part : parts_)
        for (const SectionPolygon& polygon : part.component->polygons) {
            addRing(polygon.outer, part.claim);
            for (const Ring& hole : polygon.holes) addRing(hole, part.claim);
        }
    const auto arranged =
        plane::arrangeSegments(segments, std::max(2, static_cast<std::int32_t>(std::lround(kMeetDistance / unit))));
    if (!arranged) return std::nullopt;
    const auto sides = plane::sweepRegions(*arranged, [](std::span<const plane::ClaimCount> counts) {
        return std::any_of(counts.begin(), counts.end(), [](const auto& count) { return count.winding > 0; }) ? kCovered
                                                                                                              : 0u;
    });
    double twice = 0;  // in units; the covered side counts
    for (std::size_t e = 0; e < sides.size(); ++e) {
        const auto& [from, to] = std::pair(arranged->edges[e].from, arranged->edges[e].to);
        const double area = static_cast<double>(plane::cross(from, to));
        if (sides[e].left == kCovered) twice += area;
        if (sides[e].right == kCovered) twice -= area;
    }
    return 0.5 * twice * unit * unit;
}

}  // namespace svt::drawing
