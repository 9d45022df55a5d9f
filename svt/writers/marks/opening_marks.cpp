#include <svt/writers/marks/opening_marks.hpp>

#include <svt/model/classes.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using volume::kNoLabel;

constexpr double kMarkText = 1.8, kMarkRadius = 2.6;  // millimetres

// An opening as a plan cuts it: a rectangle along its wall, millimetres on paper.
struct CutOpening {
    PlanePoint center{};
    PlanePoint along{1, 0}, across{0, 1};
    double halfLength = 0, halfDepth = 0;
    std::size_t points = 0, polygons = 0;
};

std::map<std::uint32_t, CutOpening> cutOpenings(const drawing::SectionDrawing& drawing,
                                                const drawing::OpeningSchedule& schedule, double millimetres) {
    std::map<std::uint32_t, std::vector<PlanePoint>> points;  // by opening
    std::map<std::uint32_t, CutOpening> cut;
    for (const drawing::SectionComponent& component : drawing.components) {
        const std::uint32_t opening = schedule.openings[component.label];
        if (opening == kNoLabel || schedule.marks[opening].empty()) continue;
        for (const auto& polygon : component.polygons) {
            for (const PlanePoint p : polygon.outer) points[opening].push_back({p.u * millimetres, p.v * millimetres});
            ++cut[opening].polygons;
            cut[opening].points += polygon.outer.size() + (polygon.holes.empty() ? 0 : 100);
        }
    }
    for (const drawing::SectionLine& line : drawing.lines) {
        const std::uint32_t opening = schedule.openings[line.label];
        if (opening == kNoLabel || schedule.marks[opening].empty()) continue;
        for (const PlanePoint p : line.points) points[opening].push_back({p.u * millimetres, p.v * millimetres});
        ++cut[opening].polygons;
    }
    for (const auto& [opening, all] : points) {
        CutOpening& of = cut[opening];
        if (const auto& place = schedule.places[opening]) {
            const PlanePoint normal{dot(place->normal, drawing.axes.u), dot(place->normal, drawing.axes.v)};
            const double size = std::hypot(normal.u, normal.v);
            if (size > 0.1) of.across = {normal.u / size, normal.v / size};
            of.along = {of.across.v, -of.across.u};
        }
        double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
        for (const PlanePoint p : all) {
            const double at[2] = {p.u * of.along.u + p.v * of.along.v, p.u * of.across.u + p.v * of.across.v};
            for (std::size_t n = 0; n < 2; ++n) {
                low[n] = std::min(low[n], at[n]);
                high[n] = std::max(high[n], at[n]);
            }
        }
        const double a = 0.5 * (low[0] + high[0]), b = 0.5 * (low[1] + high[1]);
        of.center = {of.along.u * a + of.across.u * b, of.along.v * a + of.across.v * b};
        of.halfLength = 0.5 * (high[0] - low[0]);
        of.halfDepth = 0.5 * (high[1] - low[1]);
    }
    return cut;
}

MarkPath outlineOf(PlanePoint at, bool isDoor, double radius) {
    const int corners = isDoor ? 24 : 6;
    MarkPath path;
    for (int n = 0; n <= corners; ++n) {
        const double turn = 2 * std::numbers::pi * (n % corners) / corners;
        path.push_back({at.u + radius * std::cos(turn), at.v + radius * std::sin(turn)});
    }
    return path;
}

// The nearest clear place beside an opening: first in front of its middle on both sides, then along it.
std::optional<PlanePoint> placeBeside(const CutOpening& opening, double radius, const FreeSpace& space) {
    constexpr double kNearest = 1, kFarthest = 14, kStep = 0.75;  // millimetres
    constexpr double kShifts[] = {0, 0.35, -0.35, 0.7, -0.7, 1, -1};
    std::optional<PlanePoint> best;
    double least = 1e300;
    for (int n = 0; kNearest + n * kStep <= kFarthest; ++n)
        for (const double shift : kShifts)
            for (const double side : {1.0, -1.0}) {
                const double away = kNearest + n * kStep;
                const double out = side * (opening.halfDepth + radius + away), by = shift * opening.halfLength;
                const PlanePoint at{opening.center.u + out * opening.across.u + by * opening.along.u,
                                    opening.center.v + out * opening.across.v + by * opening.along.v};
                const double cost = away + 0.5 * std::abs(by);
                if (cost >= least) continue;
                if (!space.isClear({{at.u - radius, at.v - radius}, {at.u + radius, at.v + radius}})) continue;
                least = cost;
                best = at;
            }
    return best;
}

}  // namespace

MarkShapes placeOpeningMarks(const drawing::SectionDrawing& drawing, const drawing::OpeningSchedule& schedule,
                             double millimetres, FreeSpace& space) {
    MarkShapes shapes;
    shapes.layer = "Openings";
    for (const auto& [label, opening] : cutOpenings(drawing, schedule, millimetres)) {
        const std::string& mark = schedule.marks[label];
        const bool isDoor = mark.front() == 'D';
        const double radius = std::max(kMarkRadius, 0.5 * widthOnPaper(mark, kMarkText) + 0.9);
        const auto place = placeBeside(opening, radius, space);
        const PlanePoint at = place.value_or(opening.center);
        space.take({{at.u - radius, at.v - radius}, {at.u + radius, at.v + radius}});
        shapes.masks.push_back(outlineOf(at, isDoor, radius));
        shapes.thin.push_back(outlineOf(at, isDoor, radius));
        shapes.texts.push_back({{at.u, at.v - 0.36 * kMarkText}, kMarkText, mark, false});
        if (!place) continue;
        const double u = opening.center.u - at.u, v = opening.center.v - at.v, size = std::hypot(u, v);
        const double end = size - opening.halfDepth;
        if (end > radius + 2) {
            shapes.thin.push_back(
                {{at.u + u / size * radius, at.v + v / size * radius}, {at.u + u / size * end, at.v + v / size * end}});
        }
    }
    return shapes;
}

MarkShapes drawPanes(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                     const drawing::OpeningSchedule& schedule, double millimetres) {
    constexpr double kMerged = 1.2, kInset = 0.25;  // millimetres
    MarkShapes shapes;
    shapes.layer = "Panes";
    for (const auto& item : cutOpenings(drawing, schedule, millimetres)) {
        const std::uint32_t label = item.first;
        const CutOpening& opening = item.second;
        if (!volume.labels.labels[label].className.starts_with("Window") || opening.halfLength < 1) continue;
        const auto at = [&](double along, double across) {
            return PlanePoint{opening.center.u + along * opening.along.u + across * opening.across.u,
                              opening.center.v + along * opening.along.v + across * opening.across.v};
        };
        const double end = opening.halfLength - kInset, deep = opening.halfDepth;
        const bool isMerged = 2 * deep < kMerged && opening.polygons > 0;
        const bool isBlock = opening.polygons == 1 && opening.points <= 6;
        if (isMerged && !(deep > 0.01)) continue;
        if (isMerged) {
            const double out = deep + 0.1;
            shapes.masks.push_back({at(-end, -out), at(end, -out), at(end, out), at(-end, out), at(-end, -out)});
            for (const double side : {-end, end}) shapes.thin.push_back({at(side, -deep), at(side, deep)});
        }
        if (isMerged || isBlock) shapes.thin.push_back({at(-end, 0), at(end, 0)});
    }
    return shapes;
}

}  // namespace svt::writers
