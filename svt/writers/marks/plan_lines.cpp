#include <svt/writers/marks/plan_lines.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/clip_segment.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/drawing/drawing_style.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

MarkPath circleAt(PlanePoint at, double radius) {
    MarkPath path;
    for (int n = 0; n <= 32; ++n) {
        const double turn = 2 * std::numbers::pi * (n % 32) / 32;
        path.push_back({at.u + radius * std::cos(turn), at.v + radius * std::sin(turn)});
    }
    return path;
}

PlanePoint between(PlanePoint a, PlanePoint b, double t) noexcept {
    return {a.u + (b.u - a.u) * t, a.v + (b.v - a.v) * t};
}

class TravelMaker {
public:
    TravelMaker(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, double millimetres)
        : drawing_(drawing), up_(volume.grid.axes()[2]), millimetres_(millimetres) {}

    // The line up to the cut, and whether the cut ends it.
    [[nodiscard]] std::pair<MarkPath, bool> lineOf(const drawing::StairFlight& flight, double cut) const {
        MarkPath line;
        for (std::size_t n = 0; n < flight.treads.size(); ++n) {
            const PlanePoint at = onPaper(flight.treads[n].center);
            if (flight.treads[n].height <= cut) {
                line.push_back(at);
                continue;
            }
            if (n > 0) {
                const double low = flight.treads[n - 1].height, high = flight.treads[n].height;
                line.push_back(between(line.back(), at, (cut - low) / (high - low)));
            }
            return {line, true};
        }
        return {line, false};
    }

    // Two strokes with a kink across the end of a line.
    [[nodiscard]] MarkPath breakLine(const drawing::StairFlight& flight, const MarkPath& line) const {
        const PlanePoint end = line.back(), before = line[line.size() - 2];
        const double size = std::hypot(end.u - before.u, end.v - before.v);
        const PlanePoint along{(end.u - before.u) / size, (end.v - before.v) / size};
        const double half = 0.55 * widthOf(flight) * millimetres_, kink = std::min(1.2, 0.3 * half);
        const auto at = [&](double across, double ahead) {
            const double skew = 0.5 * across + ahead;
            return PlanePoint{end.u - along.v * across + along.u * skew, end.v + along.u * across + along.v * skew};
        };
        return {at(-half, 0),      at(-0.5 * kink, 0), at(-0.5 * kink, 1.5 * kink), at(0.5 * kink, -1.5 * kink),
                at(0.5 * kink, 0), at(half, 0)};
    }

private:
    [[nodiscard]] PlanePoint onPaper(Vec3d world) const noexcept {
        const PlanePoint p = drawing_.axes.planeFromWorld(world);
        return {p.u * millimetres_, p.v * millimetres_};
    }
    // The width of the usual tread across the line of travel, metres.
    [[nodiscard]] static double widthOf(const drawing::StairFlight& flight) {
        std::vector<double> areas;
        for (const drawing::StairTread& tread : flight.treads) areas.push_back(tread.area);
        std::sort(areas.begin(), areas.end());
        return areas[areas.size() / 2] / std::max(flight.going, 0.1);
    }

    const drawing::SectionDrawing& drawing_;
    Vec3d up_;
    double millimetres_;
};

void addArrowHead(const MarkPath& line, MarkShapes& shapes) {
    const PlanePoint tip = line.back();
    PlanePoint from = line.front();
    for (const PlanePoint p : line)
        if (std::hypot(tip.u - p.u, tip.v - p.v) > 2) from = p;
    const double size = std::hypot(tip.u - from.u, tip.v - from.v);
    if (!(size > 0)) return;
    const double u = (tip.u - from.u) / size, v = (tip.v - from.v) / size;
    shapes.filled.push_back({tip,
                             {tip.u - 2 * u - 0.6 * v, tip.v - 2 * v + 0.6 * u},
                             {tip.u - 2 * u + 0.6 * v, tip.v - 2 * v - 0.6 * u},
                             tip});
}

// A number of centimetres with at most one decimal.
std::string centimetres(double metres, bool hasComma) {
    std::string text = fmt::format("{:.1f}", metres * 100);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    if (hasComma) std::replace(text.begin(), text.end(), '.', ',');
    return text;
}

// A text near the line, clear of borders if possible; it interrupts the lines of treads.
void addTravelText(const MarkPath& line, const std::string& text, MarkShapes& shapes, FreeSpace& space) {
    constexpr double kText = 1.8;
    const double half = 0.5 * widthOnPaper(text, kText) + 0.4, high = 0.5 * kText + 0.4;
    std::optional<PlanePoint> best;
    double least = 1e300;
    for (std::size_t n = 0; n < line.size(); ++n)
        for (int turn = 0; turn < 12; ++turn)
            for (int step = 0; step <= 8; ++step) {
                const double angle = 2 * std::numbers::pi * turn / 12, away = 1.5 * step;
                if (away >= least) continue;
                const PlanePoint at{line[n].u + away * std::cos(angle), line[n].v + away * std::sin(angle)};
                const FreeSpace::Hits hits = space.hitsOf({{at.u - half, at.v - high}, {at.u + half, at.v + high}});
                const double cost = away + 10 * hits.lines + 50 * hits.borders + (hits.isTaken ? 500 : 0);
                if (cost >= least) continue;
                least = cost;
                best = at;
            }
    if (!best) return;
    const MarkBox box{{best->u - half, best->v - high}, {best->u + half, best->v + high}};
    space.take(box);
    shapes.masks.push_back({box.low, {box.high.u, box.low.v}, box.high, {box.low.u, box.high.v}, box.low});
    shapes.texts.push_back({{best->u, best->v - 0.36 * kText}, kText, text, false});
}

// The points of an axis as the reader writes them: "x y z, x y z", more for curves.
std::vector<Vec3d> axisPoints(const Attribute& attribute) {
    const std::string* text = std::get_if<std::string>(&attribute.value);
    if (text == nullptr || !attribute.name.starts_with("axis ")) return {};
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text->size();) {
        const std::size_t end = std::min(text->find_first_of(" ,", at), text->size());
        if (end > at) {
            const auto number = parseNumber(std::string_view(*text).substr(at, end - at));
            if (!number) return {};
            numbers.push_back(*number);
        }
        at = end + 1;
    }
    std::vector<Vec3d> points;
    if (numbers.size() < 6 || numbers.size() % 3 != 0) return points;
    for (std::size_t n = 0; n < numbers.size(); n += 3) points.push_back({numbers[n], numbers[n + 1], numbers[n + 2]});
    return points;
}

double lengthOf(const MarkPath& path) {
    double length = 0;
    for (std::size_t n = 0; n + 1 < path.size(); ++n)
        length += std::hypot(path[n + 1].u - path[n].u, path[n + 1].v - path[n].v);
    return length;
}

// The parts of an axis within a rectangle; those of a closed axis go on beyond its first point.
std::vector<MarkPath> partsWithin(const MarkPath& axis, const MarkBox& box) {
    constexpr double kLeast = 1;  // millimetres
    std::vector<MarkPath> parts;
    for (std::size_t n = 0; n + 1 < axis.size(); ++n) {
        const auto part = drawing::clipSegment(axis[n], axis[n + 1], box.low, box.high);
        if (!part) continue;
        if (parts.empty() || !(parts.back().back() == part->first)) parts.push_back({part->first});
        parts.back().push_back(part->second);
    }
    if (parts.size() > 1 && axis.front() == axis.back() && parts.front().front() == parts.back().back()) {
        parts.back().insert(parts.back().end(), parts.front().begin() + 1, parts.front().end());
        parts.erase(parts.begin());
    }
    std::erase_if(parts, [](const MarkPath& part) { return !(lengthOf(part) > kLeast); });
    return parts;
}

constexpr double kGridRadius = 3.5, kGridText = 2.5;  // millimetres

// The ends of the axes of a plan, and the circles there.
class GridEnds {
public:
    GridEnds(const MarkBox& drawing, const MarkBox& dimensions) : drawing_(drawing), dimensions_(dimensions) {}

    // Moves an end of an axis to where its circle has a place: outside of the dimensions if it is outside of the drawing,
    // and beside the circles before it. Returns the centre of the circle; nothing if the name stands there already, as
    // where each storey has the same grid.
    std::optional<PlanePoint> extend(MarkPath& path, bool isFront, const std::string& name) {
        constexpr int kMostCircles = 3;  // circles one behind the other
        PlanePoint& end = isFront ? path.front() : path.back();
        const PlanePoint before = isFront ? path[1] : path[path.size() - 2];
        const double size = std::hypot(end.u - before.u, end.v - before.v);
        const PlanePoint along{(end.u - before.u) / size, (end.v - before.v) / size};
        const auto centre = [&] { return PlanePoint{end.u + along.u * kGridRadius, end.v + along.v * kGridRadius}; };
        if (reachesBeyond(centre(), drawing_)) {
            const double way = wayOut(end, along);
            end = {end.u + along.u * way, end.v + along.v * way};
        }
        for (int n = 0; n < kMostCircles && takenBy(centre()) != nullptr; ++n) {
            if (*takenBy(centre()) == name) return std::nullopt;
            end = {end.u + along.u * 2 * kGridRadius, end.v + along.v * 2 * kGridRadius};
        }
        circles_.emplace_back(centre(), name);
        return centre();
    }

private:
    [[nodiscard]] static bool reachesBeyond(PlanePoint at, const MarkBox& box) noexcept {
        return at.u - kGridRadius < box.low.u || at.u + kGridRadius > box.high.u || at.v - kGridRadius < box.low.v ||
               at.v + kGridRadius > box.high.v;
    }
    // The way from a point to the edge of the dimensions; 0 beyond them.
    [[nodiscard]] double wayOut(PlanePoint from, PlanePoint along) const noexcept {
        constexpr double kLeast = 1e-9;
        double way = kInfinity;
        if (std::abs(along.u) > kLeast)
            way = std::min(way, ((along.u > 0 ? dimensions_.high.u : dimensions_.low.u) - from.u) / along.u);
        if (std::abs(along.v) > kLeast)
            way = std::min(way, ((along.v > 0 ? dimensions_.high.v : dimensions_.low.v) - from.v) / along.v);
        return way < kInfinity ? std::max(0.0, way) : 0;
    }
    // The name of the circle that a circle would overlap.
    [[nodiscard]] const std::string* takenBy(PlanePoint at) const noexcept {
        for (const auto& [other, name] : circles_)
            if (std::hypot(other.u - at.u, other.v - at.v) < 2 * kGridRadius - 1e-6) return &name;
        return nullptr;
    }

    MarkBox drawing_, dimensions_;
    std::vector<std::pair<PlanePoint, std::string>> circles_;
};

}  // namespace

MarkShapes drawTravel(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                      std::span<const drawing::StairFlight> flights, const PlanHeights& heights, double millimetres,
                      std::string_view risers, bool hasCommas, FreeSpace& space) {
    constexpr double kOfLevel = 0.5;  // metres around a floor
    MarkShapes shapes;
    shapes.layer = "Stairs";
    const TravelMaker maker(drawing, volume, millimetres);
    for (const drawing::StairFlight& flight : flights) {
        const double low = flight.treads.front().height, top = flight.treads.back().height;
        const bool begins = low > heights.floor - kOfLevel && low < heights.cut;
        const bool arrives = top > heights.floor - kOfLevel && top < heights.cut;
        if (!begins && !arrives) continue;
        const auto [line, isCut] = maker.lineOf(flight, heights.cut);
        if (line.size() < 2) continue;
        shapes.thin.push_back(line);
        shapes.thin.push_back(circleAt(line.front(), 0.6));
        addArrowHead(line, shapes);
        if (isCut) shapes.thin.push_back(maker.breakLine(flight, line));
        for (const MarkPath& path : {shapes.thin.back(), line}) space.add(path, Obstacle::Line);
        const int count = flight.risersTo(begins ? heights.floorAbove : heights.floor);
        addTravelText(line,
                      fmt::format("{} {} {}/{}", count, risers, centimetres(flight.riser, hasCommas),
                                  centimetres(flight.going, hasCommas)),
                      shapes, space);
    }
    return shapes;
}

bool hasGrids(const volume::LabelTable& labels) noexcept {
    return std::any_of(labels.labels.begin(), labels.labels.end(),
                       [](const volume::Label& label) { return label.className == "Grid"; });
}

MarkShapes drawGrids(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume, double millimetres,
                     const MarkBox& dimensions, FreeSpace& space) {
    MarkShapes shapes;
    shapes.layer = "Grids";
    const auto [low, high] = drawnBox(drawing);
    GridEnds ends({{low.u * millimetres, low.v * millimetres}, {high.u * millimetres, high.v * millimetres}},
                  dimensions);
    for (const volume::Label& label : volume.labels.labels) {
        if (label.className != "Grid") continue;
        for (const Attribute& attribute : label.attributes) {
            MarkPath axis;
            for (const Vec3d& world : axisPoints(attribute)) {
                const PlanePoint p = drawing.axes.planeFromWorld(world);
                const PlanePoint at{p.u * millimetres, p.v * millimetres};
                if (axis.empty() || !(axis.back() == at)) axis.push_back(at);
            }
            const std::string name =
                axis.empty() ? std::string() : shortened(attribute.name.substr(5), kGridText, 2 * kGridRadius - 1);
            for (MarkPath part : partsWithin(axis, dimensions)) {
                // A whole circle has its name once.
                std::vector<PlanePoint> places;
                if (part.front() == part.back())
                    places.push_back(part.front());
                else
                    for (const bool isFront : {true, false})
                        if (const auto place = ends.extend(part, isFront, name)) places.push_back(*place);
                shapes.axes.push_back(std::move(part));
                for (const PlanePoint at : places) {
                    shapes.masks.push_back(circleAt(at, kGridRadius));
                    shapes.medium.push_back(circleAt(at, kGridRadius));
                    shapes.texts.push_back({{at.u, at.v - 0.36 * kGridText}, kGridText, name, false});
                    space.take({{at.u - kGridRadius, at.v - kGridRadius}, {at.u + kGridRadius, at.v + kGridRadius}});
                }
            }
        }
    }
    return shapes;
}

}  // namespace svt::writers
