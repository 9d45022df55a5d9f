#include <svt/writers/marks/room_stamps.hpp>

#include <svt/writers/marks/blocked_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kStampSizes[] = {2.5, 2, 1.8};  // millimetres
constexpr double kAround = 0.8;                  // millimetres between a text and lines
constexpr int kMostLines = 6;                    // lines of furniture that a stamp may interrupt

// The largest polygon of a room, or one of a cut part, millimetres on paper.
class RoomOutline {
public:
    RoomOutline(const drawing::SectionComponent& component, double millimetres)
        : RoomOutline(largestOf(component), millimetres) {
        const drawing::TextPlace place = drawing::findTextPlace(largestOf(component));
        center = {place.center.u * millimetres, place.center.v * millimetres};
    }
    // Without a centre.
    RoomOutline(const drawing::SectionPolygon& polygon, double millimetres) {
        const auto add = [&](const drawing::Ring& ring) {
            for (std::size_t n = 0; n < ring.size(); ++n) {
                const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
                sides_.push_back({{a.u * millimetres, a.v * millimetres}, {b.u * millimetres, b.v * millimetres}});
            }
        };
        add(polygon.outer);
        for (const drawing::Ring& hole : polygon.holes) add(hole);
        box = {sides_.front().first, sides_.front().first};
        for (const auto& [a, b] : sides_) {
            box.low = {std::min(box.low.u, a.u), std::min(box.low.v, a.v)};
            box.high = {std::max(box.high.u, a.u), std::max(box.high.v, a.v)};
        }
    }

    /// A place for the middle of a stamp.
    struct Place {
        PlanePoint at;
        double away = 0;  // from the centre, millimetres
        int order = 0;    // of places with equal cost, the first is taken
    };
    /// The centre and the points of a lattice that lie in the room, nearest to the centre first.
    const std::vector<Place>& places() {
        constexpr int kSteps = 24;
        if (!places_.empty()) return places_;
        const double width = box.high.u - box.low.u, height = box.high.v - box.low.v;
        int order = 0;
        const auto add = [&](PlanePoint at) {
            places_.push_back({at, std::hypot(at.u - center.u, at.v - center.v), order++});
        };
        add(center);
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; j <= kSteps; ++j) add({box.low.u + width * i / kSteps, box.low.v + height * j / kSteps});
        std::erase_if(places_, [&](const Place& place) { return place.order > 0 && !contains(place.at); });
        std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
            return a.away != b.away ? a.away < b.away : a.order < b.order;
        });
        return places_;
    }

    [[nodiscard]] bool contains(PlanePoint p) const noexcept {
        if (p.u < box.low.u || p.u > box.high.u || p.v < box.low.v || p.v > box.high.v) return false;
        bool inside = false;
        for (const auto& [a, b] : sides_)
            if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
        return inside;
    }
    [[nodiscard]] bool contains(const MarkBox& rectangle) const noexcept {
        // A rectangle that reaches beyond the room's box meets a side.
        if (rectangle.low.u < box.low.u || rectangle.high.u > box.high.u || rectangle.low.v < box.low.v ||
            rectangle.high.v > box.high.v)
            return false;
        return contains(PlanePoint{0.5 * (rectangle.low.u + rectangle.high.u),
                                   0.5 * (rectangle.low.v + rectangle.high.v)}) &&
               std::none_of(sides_.begin(), sides_.end(),
                            [&](const auto& side) { return meets(side.first, side.second, rectangle); });
    }

    MarkBox box;
    PlanePoint center{};

private:
    static const drawing::SectionPolygon& largestOf(const drawing::SectionComponent& component) {
        return *std::max_element(component.polygons.begin(), component.polygons.end(),
                                 [](const auto& a, const auto& b) { return a.area < b.area; });
    }

    std::vector<std::pair<PlanePoint, PlanePoint>> sides_;
    std::vector<Place> places_;
};

MarkBox boxAt(PlanePoint center, std::pair<double, double> size) noexcept {
    const double u = 0.5 * size.first + kAround, v = 0.5 * size.second + kAround;
    return {{center.u - u, center.v - v}, {center.u + u, center.v + v}};
}

// The size of the box of a text.
std::pair<double, double> sizeOfBox(std::pair<double, double> extent) noexcept {
    return {extent.first + 2 * kAround, extent.second + 2 * kAround};
}

MarkPath ringOf(const MarkBox& box) {
    return {box.low, {box.high.u, box.low.v}, box.high, {box.low.u, box.high.v}, box.low};
}

// Finds the rooms at a point: a grid of cells lists the rooms whose boxes meet them.
class RoomIndex {
public:
    explicit RoomIndex(const std::vector<RoomOutline>& rooms) : rooms_(rooms) {
        if (rooms.empty()) return;
        MarkBox all = rooms.front().box;
        for (const RoomOutline& room : rooms) {
            all.low = {std::min(all.low.u, room.box.low.u), std::min(all.low.v, room.box.low.v)};
            all.high = {std::max(all.high.u, room.box.high.u), std::max(all.high.v, room.box.high.v)};
        }
        low_ = all.low;
        cell_ = std::max({kCell, (all.high.u - all.low.u) / kMostCells, (all.high.v - all.low.v) / kMostCells});
        columns_ = 1 + static_cast<std::size_t>((all.high.u - low_.u) / cell_);
        rows_ = 1 + static_cast<std::size_t>((all.high.v - low_.v) / cell_);
        cells_.resize(columns_ * rows_);
        for (std::size_t n = 0; n < rooms.size(); ++n) {
            const MarkBox& box = rooms[n].box;
            for (std::size_t row = rowOf(box.low.v); row <= rowOf(box.high.v); ++row)
                for (std::size_t column = columnOf(box.low.u); column <= columnOf(box.high.u); ++column)
                    cells_[row * columns_ + column].push_back(n);
        }
    }

    /// Whether a point lies in a room other than `own`.
    [[nodiscard]] bool isInOther(PlanePoint p, std::size_t own) const noexcept {
        if (cells_.empty() || p.u < low_.u || p.v < low_.v) return false;
        const std::size_t column = columnOf(p.u), row = rowOf(p.v);
        if (column >= columns_ || row >= rows_) return false;
        const std::vector<std::size_t>& rooms = cells_[row * columns_ + column];
        return std::any_of(rooms.begin(), rooms.end(),
                           [&](std::size_t n) { return n != own && rooms_[n].contains(p); });
    }

private:
    static constexpr double kCell = 6, kMostCells = 500;  // millimetres; per side
    [[nodiscard]] std::size_t columnOf(double u) const noexcept {
        return static_cast<std::size_t>((u - low_.u) / cell_);
    }
    [[nodiscard]] std::size_t rowOf(double v) const noexcept { return static_cast<std::size_t>((v - low_.v) / cell_); }

    const std::vector<RoomOutline>& rooms_;
    PlanePoint low_{};
    double cell_ = kCell;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::vector<std::size_t>> cells_;
};

class StampPlacer {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1), kDirections = 72;

public:
    StampPlacer(double millimetres, const MarkBox& allowed, FreeSpace& space, MarkShapes& shapes)
        : millimetres_(millimetres), allowed_(allowed), space_(space), shapes_(shapes) {
        for (std::size_t n = 0; n < directions_.size(); ++n) {
            const double turn = 2 * std::numbers::pi * static_cast<double>(n) / double(directions_.size());
            directions_[n] = {std::cos(turn), std::sin(turn)};
        }
    }

    void addRoom(const drawing::SectionComponent& component) { rooms_.emplace_back(component, millimetres_); }

    // Stamps outside of rooms do not stand on cut parts.
    void addCutPart(const drawing::SectionComponent& component) {
        for (const drawing::SectionPolygon& polygon : component.polygons)
            if (polygon.outer.size() > 2) cutParts_.emplace_back(polygon, millimetres_);
    }

    // In the room. A place that covers lines is only taken if `mayCover`.
    bool placeInside(std::size_t room, const std::vector<std::string>& lines, bool mayCover) {
        const int mostLines = mayCover ? kMostLines : 0;
        // If the smallest text does not fit, no larger one does.
        const double smallest = *std::prev(std::end(kStampSizes));
        const auto last = insideOf(rooms_[room], sizeOfLines(lines, smallest), mostLines);
        if (!last) return false;
        for (const double size : kStampSizes) {
            const auto place = size == smallest ? last : insideOf(rooms_[room], sizeOfLines(lines, size), mostLines);
            if (!place) continue;
            write(*place, lines, size);
            break;
        }
        return true;
    }

    // Outside, with a leader from a dot in the room: in its middle, or where texts do not stand in the leader's way.
    // \param mayCross  whether the leader may cross other rooms, and the stamp stand in them
    bool placeOutside(std::size_t room, const std::vector<std::string>& lines, bool mayCross) {
        if (!index_) index_.emplace(rooms_);
        if (!cutIndex_) cutIndex_.emplace(cutParts_);
        const RoomOutline& outline = rooms_[room];
        const double u = 0.3 * (outline.box.high.u - outline.box.low.u),
                     v = 0.3 * (outline.box.high.v - outline.box.low.v);
        const PlanePoint middle = outline.center;
        for (const PlanePoint from : {middle, PlanePoint{middle.u, middle.v - v}, PlanePoint{middle.u, middle.v + v},
                                      PlanePoint{middle.u - u, middle.v}, PlanePoint{middle.u + u, middle.v}})
            if (outline.contains(from) && placeFrom(from, room, lines, mayCross)) return true;
        return false;
    }

private:
    static constexpr double kNearest = 6, kFarthest = 120, kStep = 2;  // millimetres from a dot to a stamp outside

    // A place for a stamp outside that is clear of everything and not on a cut part.
    struct LeaderPlace {
        PlanePoint at, end;     // of the leader
        bool isInside = false;  // meets another room
        std::size_t direction = 0;
        std::optional<bool> isCrossing;  // whether the leader crosses a text; found when it matters
    };
    // The places around a dot, by distance, as far as a search needed them: searches with other rules use them again.
    struct LeaderPlaces {
        PlanePoint from;
        std::pair<double, double> extent;
        std::vector<std::vector<LeaderPlace>> steps;
        std::array<FreeSpace::Found, kDirections> inWay{}, acrossWay{};  // of the last place in each direction
    };
    // Those of one room, for one state of the space.
    struct RoomPlaces {
        std::size_t room = 0;
        std::vector<std::pair<std::pair<double, double>, BlockedPlaces>> blocked;  // by extent
        std::vector<LeaderPlaces> around;
    };

    bool placeFrom(PlanePoint from, std::size_t room, const std::vector<std::string>& lines, bool mayCross) {
        constexpr double kOtherRoom = 60;  // millimetres that a place in another room counts more
        constexpr double kCrossed = 3;     // millimetres that a millimetre across another room counts more
        const double size = kStampSizes[1];
        const auto extent = sizeOfLines(lines, size);
        LeaderPlaces& around = placesAround(from, room, extent);
        std::optional<LeaderPlace> best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; awayAt(n) <= std::min(kFarthest, least); ++n) {
            if (n == around.steps.size()) around.steps.push_back(placesAt(around, n, room));
            for (LeaderPlace& place : around.steps[n]) {
                const double away = awayAt(n);
                double cost = away + (place.isInside ? kOtherRoom : 0);
                if (cost >= least || (place.isInside && !mayCross)) continue;
                if (!place.isCrossing)
                    place.isCrossing = space_.crossesTaken(from, place.end, around.acrossWay[place.direction]);
                if (*place.isCrossing) continue;
                const double most = mayCross ? (least - cost) / kCrossed : 0;
                cost += kCrossed * lengthInOtherRooms(from, place.end, room, most);
                if (cost >= least || (!mayCross && cost > away)) continue;
                least = cost;
                best = place;
            }
        }
        if (!best) return false;
        write(best->at, lines, size);
        shapes_.thin.push_back({from, best->end});
        space_.add(from, best->end, Obstacle::Border);
        addDot(from);
        return true;
    }

    [[nodiscard]] static double awayAt(std::size_t step) noexcept {
        return kNearest + static_cast<double>(step) * kStep;
    }

    LeaderPlaces& placesAround(PlanePoint from, std::size_t room, std::pair<double, double> extent) {
        if (!tried_ || tried_->room != room) tried_ = RoomPlaces{room, {}, {}};
        for (LeaderPlaces& around : tried_->around)
            if (around.from.u == from.u && around.from.v == from.v && around.extent == extent) return around;
        return tried_->around.emplace_back(LeaderPlaces{from, extent, {}, {}, {}});
    }

    // Where stamps of a size cannot stand around a room.
    const BlockedPlaces& blockedAround(std::size_t room, std::pair<double, double> extent) {
        for (const auto& [size, blocked] : tried_->blocked)
            if (size == extent) return blocked;
        const MarkBox& own = rooms_[room].box;
        const double u = extent.first + kFarthest, v = extent.second + kFarthest;
        const MarkBox reach{{std::max(own.low.u - u, allowed_.low.u), std::max(own.low.v - v, allowed_.low.v)},
                            {std::min(own.high.u + u, allowed_.high.u), std::min(own.high.v + v, allowed_.high.v)}};
        tried_->blocked.emplace_back(extent, BlockedPlaces(space_, reach, sizeOfBox(extent), true));
        return tried_->blocked.back().second;
    }

    [[nodiscard]] std::vector<LeaderPlace> placesAt(LeaderPlaces& around, std::size_t step, std::size_t room) {
        const BlockedPlaces& blocked = blockedAround(room, around.extent);
        const PlanePoint from = around.from;
        const double away = awayAt(step);
        std::vector<LeaderPlace> places;
        for (std::size_t n = 0; n < kDirections; ++n) {
            const PlanePoint at{from.u + away * directions_[n].u, from.v + away * directions_[n].v};
            const MarkBox box = boxAt(at, around.extent);
            if (!isAllowed(box)) continue;
            if (blocked.isBlocked(box)) {
                space_.countRefused();
                continue;
            }
            if (meets(from, from, box) || !space_.isClear(box, around.inWay[n])) continue;
            const PlanePoint end = endOf(from, box);
            if (cutIndex_->isInOther(at, kNone)) continue;
            places.push_back({at, end, meetsOtherRoom(box, room), n, {}});
        }
        return places;
    }

    [[nodiscard]] bool isAllowed(const MarkBox& box) const noexcept {
        return box.low.u >= allowed_.low.u && box.low.v >= allowed_.low.v && box.high.u <= allowed_.high.u &&
               box.high.v <= allowed_.high.v;
    }
    [[nodiscard]] bool meetsOtherRoom(const MarkBox& box, std::size_t own) const noexcept {
        for (const double u : {0.0, 0.5, 1.0})
            for (const double v : {0.0, 0.5, 1.0})
                if (index_->isInOther(
                        {box.low.u + u * (box.high.u - box.low.u), box.low.v + v * (box.high.v - box.low.v)}, own))
                    return true;
        return false;
    }
    // The length of a leader within other rooms, in steps of a millimetre; more than `most` need not be exact.
    [[nodiscard]] double lengthInOtherRooms(PlanePoint from, PlanePoint to, std::size_t own,
                                            double most) const noexcept {
        const int steps = 1 + static_cast<int>(std::hypot(to.u - from.u, to.v - from.v));
        int inside = 0;
        for (int n = 0; n <= steps && inside <= most; ++n) {
            const double t = static_cast<double>(n) / steps;
            if (index_->isInOther({from.u + (to.u - from.u) * t, from.v + (to.v - from.v) * t}, own)) ++inside;
        }
        return inside;
    }
    // The middle of the side of a rectangle that faces a point.
    [[nodiscard]] static PlanePoint endOf(PlanePoint from, const MarkBox& box) noexcept {
        const PlanePoint middle{0.5 * (box.low.u + box.high.u), 0.5 * (box.low.v + box.high.v)};
        if (from.u < box.low.u) return {box.low.u, middle.v};
        if (from.u > box.high.u) return {box.high.u, middle.v};
        return {middle.u, from.v < middle.v ? box.low.v : box.high.v};
    }

    // The place with the fewest lines, and nearest to the middle among these.
    [[nodiscard]] std::optional<PlanePoint> insideOf(RoomOutline& room, std::pair<double, double> extent,
                                                     int mostLines) const {
        constexpr double kLineCost = 20, kLightCost = 2;  // millimetres of distance
        if (extent.first + 2 * kAround > room.box.high.u - room.box.low.u ||
            extent.second + 2 * kAround > room.box.high.v - room.box.low.v)
            return std::nullopt;
        const BlockedPlaces blocked(space_, room.box, sizeOfBox(extent), mostLines == 0);
        const RoomOutline::Place* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        // With lines or without, a place costs at least its distance.
        const auto isWorse = [&](double cost, const RoomOutline::Place& place) {
            return cost > least || (cost == least && place.order > best->order);
        };
        for (const RoomOutline::Place& place : room.places()) {
            if (place.away > least) break;
            const MarkBox box = boxAt(place.at, extent);
            if (isWorse(place.away, place)) continue;
            if (blocked.isBlocked(box)) {
                space_.countRefused();
                continue;
            }
            if (!room.contains(box)) continue;
            const FreeSpace::Hits hits = space_.hitsOf(box, mostLines);
            if (hits.isTaken || hits.borders > 0 || hits.lines > mostLines) continue;
            const double cost = place.away + kLineCost * hits.lines + kLightCost * hits.light;
            if (isWorse(cost, place)) continue;
            least = cost;
            best = &place;
        }
        return best != nullptr ? std::optional(best->at) : std::nullopt;
    }

    void write(PlanePoint center, const std::vector<std::string>& lines, double size) {
        const MarkBox box = boxAt(center, sizeOfLines(lines, size));
        tried_.reset();
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

    std::array<PlanePoint, kDirections> directions_;  // of leaders
    double millimetres_;
    const MarkBox& allowed_;
    FreeSpace& space_;
    MarkShapes& shapes_;
    std::vector<RoomOutline> rooms_, cutParts_;
    std::optional<RoomIndex> index_, cutIndex_;  // of all rooms and cut parts, made for the first leader
    std::optional<RoomPlaces> tried_;
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

// The forms of a stamp, the preferred one first; each once.
std::vector<std::vector<std::string>> formsOf(const std::vector<std::string>& lines) {
    std::vector<std::vector<std::string>> forms;
    for (auto& form : {lines, compactLines(lines), wrappedLines(lines), wrappedLines(compactLines(lines))})
        if (std::find(forms.begin(), forms.end(), form) == forms.end()) forms.push_back(form);
    return forms;
}

}  // namespace

PlacedStamps placeStamps(const drawing::SectionDrawing& drawing, std::span<const RoomStamp> stamps, double millimetres,
                         const MarkBox& allowed, FreeSpace& space) {
    PlacedStamps placed;
    placed.shapes.layer = "Names";
    StampPlacer placer(millimetres, allowed, space, placed.shapes);
    std::unordered_map<std::uint32_t, const drawing::SectionComponent*> componentOf;
    for (const drawing::SectionComponent& component : drawing.components)
        componentOf.emplace(component.label, &component);
    std::unordered_set<std::uint32_t> spaces;
    for (const RoomStamp& stamp : stamps) {
        placer.addRoom(*componentOf.find(stamp.label)->second);
        spaces.insert(stamp.label);
    }
    for (const drawing::SectionComponent& component : drawing.components)
        if (!spaces.contains(component.label)) placer.addCutPart(component);
    // Stamps in their own rooms come first, so that others do not take their places.
    std::vector<std::size_t> left;
    for (std::size_t n = 0; n < stamps.size(); ++n) left.push_back(n);
    for (const bool mayCover : {false, true})
        std::erase_if(left, [&](std::size_t n) {
            const auto forms = formsOf(stamps[n].lines);
            return std::any_of(forms.begin(), forms.end(),
                               [&](const auto& lines) { return placer.placeInside(n, lines, mayCover); });
        });
    for (const std::size_t n : left) {
        if (placer.placeOutside(n, stamps[n].lines, false)) continue;
        const std::vector<std::string> first{stamps[n].lines.front()};
        const auto firstForms = formsOf(first);
        const bool isInside = std::any_of(firstForms.begin(), firstForms.end(),
                                          [&](const auto& lines) { return placer.placeInside(n, lines, true); });
        if (!isInside && !placer.placeOutside(n, first, false)) {
            if (placer.placeOutside(n, stamps[n].lines, true)) continue;
            if (!placer.placeOutside(n, first, true)) {
                placed.withoutPlace.push_back(n);
                continue;
            }
        }
        placed.shortened.push_back(n);
    }
    return placed;
}

}  // namespace svt::writers
