#include <svt/writers/drawing/name_place.hpp>

#include <svt/drawing/clip_segment.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kTextSize = 2.5, kLeastTextSize = 1.2;  // millimetres

struct Segment {
    PlanePoint from, to;
};
struct Rectangle {
    PlanePoint low, high;
};

// Whether a segment has a point within a rectangle.
bool meets(const Segment& s, const Rectangle& r) noexcept {
    return drawing::meetsRectangle(s.from, s.to, r.low, r.high);
}

void addRing(const drawing::Ring& ring, std::vector<Segment>& segments) {
    for (std::size_t n = 0; n < ring.size(); ++n) segments.push_back({ring[n], ring[(n + 1) % ring.size()]});
}

bool isInside(PlanePoint p, const std::vector<Segment>& borders) noexcept {
    bool inside = false;
    for (const auto& [a, b] : borders)
        if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
    return inside;
}

// The lines and texts of the drawing that may cross the name of a component with the box `all`.
std::vector<Segment> linesAcross(const drawing::SectionComponent& component, const drawing::SectionDrawing& drawing,
                                 const Rectangle& all, double millimetres) {
    std::vector<Segment> crossing;
    for (const drawing::BeyondLine& line : drawing.beyond)
        if (meets({line.from, line.to}, all)) crossing.push_back({line.from, line.to});
    for (const drawing::RoomDimension& dimension : drawing.roomDimensions)
        if (dimension.label == component.label) {
            // The line, and the number above it.
            const double above = 2 / millimetres;
            const bool isFlat = dimension.from.v == dimension.to.v;
            const auto raised = [&](PlanePoint p) {
                return isFlat ? PlanePoint{p.u, p.v + above} : PlanePoint{p.u - above, p.v};
            };
            crossing.push_back({dimension.from, dimension.to});
            crossing.push_back({raised(dimension.from), raised(dimension.to)});
        }
    for (const drawing::OpeningHeights& opening : drawing.openings) {
        const double off = 2 / millimetres, half = 4.5 / millimetres;
        const PlanePoint at{opening.at.u + off * opening.away.u, opening.at.v + off * opening.away.v};
        const Segment text{{at.u - half * opening.away.v, at.v + half * opening.away.u},
                           {at.u + half * opening.away.v, at.v - half * opening.away.u}};
        if (meets(text, all)) crossing.push_back(text);
    }
    for (const drawing::DoorSwing& door : drawing.doors) {
        std::vector<std::vector<PlanePoint>> parts = door.lines;
        for (const auto& arc : door.arcs) parts.push_back(drawing::pointsOf(arc));
        for (const auto& line : parts)
            for (std::size_t n = 0; n + 1 < line.size(); ++n)
                if (meets({line[n], line[n + 1]}, all)) crossing.push_back({line[n], line[n + 1]});
    }
    return crossing;
}

}  // namespace

std::optional<NamePlace> placeName(const drawing::SectionComponent& component, const drawing::SectionDrawing& drawing,
                                   double millimetres, double width, double lines) {
    const auto& largest = *std::max_element(component.polygons.begin(), component.polygons.end(),
                                            [](const auto& a, const auto& b) { return a.area < b.area; });
    const drawing::TextPlace place = drawing::findTextPlace(largest);
    const double size =
        std::min({kTextSize, 0.9 * place.width * millimetres / width, 0.8 * place.height * millimetres / lines});
    if (!(size >= kLeastTextSize)) return std::nullopt;
    std::vector<Segment> borders;
    addRing(largest.outer, borders);
    for (const auto& hole : largest.holes) addRing(hole, borders);
    Rectangle all{largest.outer.front(), largest.outer.front()};
    for (const PlanePoint p : largest.outer) {
        all.low = {std::min(all.low.u, p.u), std::min(all.low.v, p.v)};
        all.high = {std::max(all.high.u, p.u), std::max(all.high.v, p.v)};
    }
    const std::vector<Segment> crossing = linesAcross(component, drawing, all, millimetres);
    const double halfWidth = 0.5 * (size * width + 0.8) / millimetres,
                 halfHeight = 0.5 * (size * lines + 0.8) / millimetres;
    const auto countCrossings = [&](PlanePoint p) {
        const Rectangle text{{p.u - halfWidth, p.v - halfHeight}, {p.u + halfWidth, p.v + halfHeight}};
        return std::count_if(crossing.begin(), crossing.end(), [&](const Segment& s) { return meets(s, text); });
    };
    NamePlace best{place.center, size};
    auto least = countCrossings(place.center);
    if (least == 0) return best;
    // The nearest place with the fewest lines.
    constexpr int kSteps = 20;
    double distance = 0;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
            const PlanePoint p{all.low.u + (all.high.u - all.low.u) * i / kSteps,
                               all.low.v + (all.high.v - all.low.v) * j / kSteps};
            const Rectangle text{{p.u - halfWidth, p.v - halfHeight}, {p.u + halfWidth, p.v + halfHeight}};
            if (std::any_of(borders.begin(), borders.end(), [&](const Segment& s) { return meets(s, text); })) continue;
            if (!isInside(p, borders)) continue;
            const auto count = countCrossings(p);
            const double away = std::hypot(p.u - place.center.u, p.v - place.center.v);
            if (count > least || (count == least && (distance == 0 || away >= distance))) continue;
            least = count;
            distance = away;
            best.center = p;
        }
    return best;
}

}  // namespace svt::writers
