#include <svt/writers/marks/room_stamps.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kStampSizes[] = {2.5, 2, 1.8};  // millimetres
constexpr double kAround = 0.8;                  // millimetres between a text and lines
constexpr int kMostLines = 6;                    // lines of furniture that a stamp may interrupt

// The largest polygon of a room, millimetres on paper.
class RoomOutline {
public:
    RoomOutline(const drawing::SectionComponent& component, double millimetres) {
        const auto& largest = *std::max_element(component.polygons.begin(), component.polygons.end(),
                                                [](const auto& a, const auto& b) { return a.area < b.area; });
        const auto add = [&](const drawing::Ring& ring) {
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
                sides_.push_back({{a.u * millimetres, a.v * millimetres}, {b.u * millimetres, b.v * millimetres}});
            }
        };
        add(largest.outer);
        for (const drawing::Ring& hole : largest.holes) add(hole);
        box = {sides_.front().first, sides_.front().first};
        for (const auto& [a, b] : sides_) {
            box.low = {std::min(box.low.u, a.u), std::min(box.low.v, a.v)};
            box.high = {std::max(box.high.u, a.u), std::max(box.high.v, a.v)};
        }
        const drawing::TextPlace place = drawing::findTextPlace(largest);
        center = {place.center.u * millimetres, place.center.v * millimetres};
    }

    [[nodiscard]] bool contains(PlanePoint p) const noexcept {
        if (p.u < box.low.u || p.u > box.high.u || p.v < box.low.v || p.v > box.high.v) return false;
        bool inside = false;
        for (const auto& [a, b] : sides_)
            if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
        return inside;
    }
    [[nodiscard]] bool contains(const MarkBox& rectangle) const noexcept {
        return contains(PlanePoint{0.5 * (rectangle.low.u + rectangle.high.u),
                                   0.5 * (rectangle.low.v + rectangle.high.v)}) &&
               std::none_of(sides_.begin(), sides_.end(),
                            [&](const auto& side) { return meets(side.first, side.second, rectangle); });
    }

    MarkBox box;
    PlanePoint center;

private:
    std::vector<std::pair<PlanePoint, PlanePoint>> sides_;
};

MarkBox boxAt(PlanePoint center, std::pair<double, double> size) noexcept {
    const double u = 0.5 * size.first + kAround, v = 0.5 * size.second + kAround;
    return {{center.u - u, center.v - v}, {center.u + u, center.v + v}};
}

MarkPath ringOf(const MarkBox& box) {
    return {box.low, {box.high.u, box.low.v}, box.high, {box.low.u, box.high.v}, box.low};
}

class StampPlacer {
public:
    StampPlacer(double millimetres, const MarkBox& allowed, FreeSpace& space, MarkShapes& shapes)
        : millimetres_(millimetres), allowed_(allowed), space_(space), shapes_(shapes) {}

    void addRoom(const drawing::SectionComponent& component) { rooms_.emplace_back(component, millimetres_); }

    // In the room. A place that covers lines is only taken if `mayCover`.
    bool placeInside(std::size_t room, const std::vector<std::string>& lines, bool mayCover) {
        for (const double size : kStampSizes) {
            const auto place = insideOf(rooms_[room], sizeOfLines(lines, size), mayCover ? kMostLines : 0);
            if (!place) continue;
            write(*place, lines, size);
            return true;
        }
        return false;
    }

    // Outside, with a leader from a dot in the room: in its middle, or where texts do not stand in the leader's way.
    bool placeOutside(std::size_t room, const std::vector<std::string>& lines) {
        const RoomOutline& outline = rooms_[room];
        const double u = 0.3 * (outline.box.high.u - outline.box.low.u),
                     v = 0.3 * (outline.box.high.v - outline.box.low.v);
        const PlanePoint middle = outline.center;
        for (const PlanePoint from : {middle, PlanePoint{middle.u, middle.v - v}, PlanePoint{middle.u, middle.v + v},
                                      PlanePoint{middle.u - u, middle.v}, PlanePoint{middle.u + u, middle.v}})
            if (outline.contains(from) && placeFrom(from, room, lines)) return true;
        return false;
    }

private:
    bool placeFrom(PlanePoint from, std::size_t room, const std::vector<std::string>& lines) {
        constexpr double kNearest = 6, kFarthest = 120, kStep = 2;  // millimetres
        constexpr int kDirections = 72;
        constexpr double kOtherRoom = 60;  // millimetres that a place in another room counts more
        const double size = kStampSizes[1];
        const auto extent = sizeOfLines(lines, size);
        std::array<PlanePoint, kDirections> directions;
        for (int n = 0; n < kDirections; ++n) {
            const double turn = 2 * std::numbers::pi * n / kDirections;
            directions[static_cast<std::size_t>(n)] = {std::cos(turn), std::sin(turn)};
        }
        std::optional<PlanePoint> best;
        double least = std::numeric_limits<double>::infinity();
        for (int n = 0; kNearest + n * kStep <= std::min(kFarthest, least); ++n)
            for (const PlanePoint direction : directions) {
                const double away = kNearest + n * kStep;
                const PlanePoint at{from.u + away * direction.u, from.v + away * direction.v};
                const MarkBox box = boxAt(at, extent);
                if (away >= least || !isAllowed(box) || meets(from, from, box)) continue;
                if (!space_.isClear(box) || space_.crossesTaken(from, endOf(from, box))) continue;
                const double cost = away + (isInOtherRoom(at, room) ? kOtherRoom : 0);
                if (cost >= least) continue;
                least = cost;
                best = at;
            }
        if (!best) return false;
        const MarkBox box = boxAt(*best, extent);
        const PlanePoint end = endOf(from, box);
        write(*best, lines, size);
        shapes_.thin.push_back({from, end});
        space_.add(from, end, Obstacle::Border);
        addDot(from);
        return true;
    }

    [[nodiscard]] bool isAllowed(const MarkBox& box) const noexcept {
        return box.low.u >= allowed_.low.u && box.low.v >= allowed_.low.v && box.high.u <= allowed_.high.u &&
               box.high.v <= allowed_.high.v;
    }
    [[nodiscard]] bool isInOtherRoom(PlanePoint p, std::size_t own) const noexcept {
        for (std::size_t n = 0; n < rooms_.size(); ++n)
            if (n != own && rooms_[n].contains(p)) return true;
        return false;
    }
    // The middle of the side of a rectangle that faces a point.
    [[nodiscard]] static PlanePoint endOf(PlanePoint from, const MarkBox& box) noexcept {
        const PlanePoint middle{0.5 * (box.low.u + box.high.u), 0.5 * (box.low.v + box.high.v)};
        if (from.u < box.low.u) return {box.low.u, middle.v};
        if (from.u > box.high.u) return {box.high.u, middle.v};
        return {middle.u, from.v < middle.v ? box.low.v : box.high.v};
    }

    // The place with the fewest lines, and nearest to the middle among these.
    [[nodiscard]] std::optional<PlanePoint> insideOf(const RoomOutline& room, std::pair<double, double> extent,
                                                     int mostLines) const {
        constexpr int kSteps = 24;
        constexpr double kLineCost = 20, kLightCost = 2;  // millimetres of distance
        std::optional<PlanePoint> best;
        double least = std::numeric_limits<double>::infinity();
        const auto attempt = [&](PlanePoint at) {
            const MarkBox box = boxAt(at, extent);
            const double away = std::hypot(at.u - room.center.u, at.v - room.center.v);
            if (away >= least || !room.contains(box)) return;
            const FreeSpace::Hits hits = space_.hitsOf(box, mostLines);
            if (hits.isTaken || hits.borders > 0 || hits.lines > mostLines) return;
            const double cost = away + kLineCost * hits.lines + kLightCost * hits.light;
            if (cost >= least) return;
            least = cost;
            best = at;
        };
        attempt(room.center);
        const double width = room.box.high.u - room.box.low.u, height = room.box.high.v - room.box.low.v;
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; j <= kSteps; ++j)
                attempt({room.box.low.u + width * i / kSteps, room.box.low.v + height * j / kSteps});
        return best;
    }

    void write(PlanePoint center, const std::vector<std::string>& lines, double size) {
        const MarkBox box = boxAt(center, sizeOfLines(lines, size));
        space_.take(box);
        shapes_.masks.push_back(ringOf(box));
        double baseline = box.high.v - kAround - 0.85 * size;
        for (const std::string& line : lines) {
            shapes_.texts.push_back({{center.u, baseline}, size, line, false});
            baseline -= kLinePitch * size;
        }
    }

    void addDot(PlanePoint at) {
        MarkPath dot;
        for (int n = 0; n <= 8; ++n) {
            const double turn = std::numbers::pi * (n % 8) / 4;
            dot.push_back({at.u + 0.4 * std::cos(turn), at.v + 0.4 * std::sin(turn)});
        }
        shapes_.filled.push_back(std::move(dot));
    }

    double millimetres_;
    const MarkBox& allowed_;
    FreeSpace& space_;
    MarkShapes& shapes_;
    std::vector<RoomOutline> rooms_;
};

// Two lines: the first, and the others joined.
std::vector<std::string> compactLines(const std::vector<std::string>& lines) {
    if (lines.size() < 3) return lines;
    std::vector<std::string> compact{lines[0], lines[1]};
    for (std::size_t n = 2; n < lines.size(); ++n) compact.back() += ", " + lines[n];
    return compact;
}

// The first line broken in two, at the space nearest to its middle.
std::vector<std::string> wrappedLines(const std::vector<std::string>& lines) {
    const std::string& name = lines.front();
    const std::size_t middle = name.size() / 2, before = name.rfind(' ', middle), after = name.find(' ', middle);
    if (before == std::string::npos && after == std::string::npos) return lines;
    const bool isBefore =
        after == std::string::npos || (before != std::string::npos && middle - before < after - middle);
    const std::size_t at = isBefore ? before : after;
    std::vector<std::string> wrapped{name.substr(0, at), name.substr(at + 1)};
    wrapped.insert(wrapped.end(), lines.begin() + 1, lines.end());
    return wrapped;
}

}  // namespace

PlacedStamps placeStamps(const drawing::SectionDrawing& drawing, std::span<const RoomStamp> stamps, double millimetres,
                         const MarkBox& allowed, FreeSpace& space) {
    PlacedStamps placed;
    placed.shapes.layer = "Names";
    StampPlacer placer(millimetres, allowed, space, placed.shapes);
    for (const RoomStamp& stamp : stamps) {
        const auto component = std::find_if(drawing.components.begin(), drawing.components.end(),
                                            [&](const drawing::SectionComponent& c) { return c.label == stamp.label; });
        placer.addRoom(*component);
    }
    // Stamps in their own rooms come first, so that others do not take their places.
    std::vector<std::size_t> left;
    for (std::size_t n = 0; n < stamps.size(); ++n) left.push_back(n);
    for (const bool mayCover : {false, true}) {
        std::vector<std::size_t> remaining;
        for (const std::size_t n : left)
            if (!placer.placeInside(n, stamps[n].lines, mayCover) &&
                !placer.placeInside(n, compactLines(stamps[n].lines), mayCover) &&
                !placer.placeInside(n, wrappedLines(stamps[n].lines), mayCover) &&
                !placer.placeInside(n, wrappedLines(compactLines(stamps[n].lines)), mayCover))
                remaining.push_back(n);
        left = std::move(remaining);
    }
    for (const std::size_t n : left) {
        if (placer.placeOutside(n, stamps[n].lines)) continue;
        const std::vector<std::string> first{stamps[n].lines.front()};
        const bool isPlaced = placer.placeInside(n, first, true) || placer.placeOutside(n, first);
        (isPlaced ? placed.shortened : placed.withoutPlace).push_back(n);
    }
    return placed;
}

}  // namespace svt::writers
