#include <svt/drawing/dimension/dimension_chains.hpp>

#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kOnePlace = 0.3;      // metres: windows nearer than this are one, as frame and pane
constexpr double kLeastOpening = 0.3;  // metres of width and height
constexpr double kHighestDoor = 6;     // metres
constexpr double kBesideWall = 0.2;    // metres from the face, where rooms are looked for
constexpr double kThreshold = 0.05;    // metres

// A window or door in a plan.
struct CutOpening {
    std::uint32_t label = 0;
    PlanePoint middle, along;  // along: unit vector of the wall
    double length = 0, depth = 0;
    double low = -kInfinity, high = kInfinity;  // faces of the hull below and above the plane, metres above the grid
};

bool isDoorLabel(const volume::Label& label) {
    return label.className.starts_with("Door") || lowerTexts(label, {"ifcType"}).find("ifcdoor") != std::string::npos;
}

PlanePoint moved(PlanePoint p, PlanePoint direction, double by) noexcept {
    return {p.u + direction.u * by, p.v + direction.v * by};
}

// The whole window or door that a frame or a pane belongs to.
std::uint32_t wholeOf(std::uint32_t label, const volume::LabelTable& table, const std::vector<PartRole>& roles) {
    std::uint32_t whole = label;
    for (std::uint32_t above = label; above < roles.size() && roles[above] == PartRole::Opening;
         above = table.labels[above].parent)
        whole = above;
    return whole;
}

// The box of an opening along the longest edge of its border.
std::optional<CutOpening> openingOf(std::uint32_t label, const std::vector<SectionPolygon>& polygons) {
    CutOpening opening;
    opening.label = label;
    double longest = 0;
    for (const SectionPolygon& polygon : polygons)
        for (std::size_t n = 0; n < polygon.outer.size(); ++n) {
            const PlanePoint a = polygon.outer[n], b = polygon.outer[(n + 1) % polygon.outer.size()];
            const double length = std::hypot(b.u - a.u, b.v - a.v);
            if (length <= longest) continue;
            longest = length;
            opening.along = {(b.u - a.u) / length, (b.v - a.v) / length};
        }
    if (longest == 0) return std::nullopt;
    const PlanePoint x = opening.along, y{-x.v, x.u};
    double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};
    for (const SectionPolygon& polygon : polygons)
        for (const PlanePoint p : polygon.outer)
            for (const int axis : {0, 1}) {
                const double at = axis == 0 ? p.u * x.u + p.v * x.v : p.u * y.u + p.v * y.v;
                low[axis] = std::min(low[axis], at);
                high[axis] = std::max(high[axis], at);
            }
    opening.middle = moved(moved({}, x, 0.5 * (low[0] + high[0])), y, 0.5 * (low[1] + high[1]));
    opening.length = high[0] - low[0];
    opening.depth = high[1] - low[1];
    return opening.length >= kLeastOpening ? std::optional(opening) : std::nullopt;
}

bool isInRing(PlanePoint p, const Ring& ring) noexcept {
    bool inside = false;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
    }
    return inside;
}

// Finds the faces of the hull above and below the middle of each opening.
class EdgeFinder {
public:
    EdgeFinder(std::vector<CutOpening>& openings, const SectionDrawing& drawing, const volume::SemanticVolume& volume,
               double cut)
        : openings_(openings),
          axes_(drawing.axes),
          parts_(volume.vectors),
          origin_(volume.grid.origin()),
          up_(volume.grid.axes()[2]),
          cut_(cut) {
        std::sort(openings.begin(), openings.end(),
                  [](const CutOpening& a, const CutOpening& b) { return a.middle.u < b.middle.u; });
    }

    void run(const std::vector<MeshRun>& runs, const std::vector<PartRole>& roles) {
        constexpr double kNear = 8;  // metres: faces farther away matter only for openings without nearer ones
        for (const bool isNear : {true, false}) {
            for (const MeshRun& run : runs) {
                if (roles[run.label] != PartRole::Hull) continue;
                const auto [low, high] = run.rangeAlong(up_);
                const bool isIn = low * parts_.unit <= cut_ + kNear && high * parts_.unit >= cut_ - kNear;
                if (isIn == isNear && hasOpening(run))
                    for (std::uint32_t t = run.first; t < run.end; ++t) add(parts_.triangles[t]);
            }
            const bool isDone = std::all_of(openings_.begin(), openings_.end(), [&](const CutOpening& opening) {
                return opening.low >= cut_ - kNear && opening.high <= cut_ + kNear;
            });
            if (isDone) return;
        }
    }

private:
    using Openings = std::vector<CutOpening>::iterator;
    [[nodiscard]] Openings firstFrom(double u) const {
        return std::lower_bound(openings_.begin(), openings_.end(), u,
                                [](const CutOpening& o, double at) { return o.middle.u < at; });
    }
    [[nodiscard]] bool hasOpening(const MeshRun& run) const {
        constexpr double kRounding = 1e-6;  // metres
        const auto [low, high] = run.rangeAlong(axes_.u);
        const double base = dot(origin_ - axes_.origin, axes_.u);
        const auto opening = firstFrom(low * parts_.unit + base - kRounding);
        return opening != openings_.end() && opening->middle.u <= high * parts_.unit + base + kRounding;
    }

    void add(const volume::VectorParts::Triangle& triangle) {
        PlanePoint p[3];
        double height[3];
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3d at = parts_.position(triangle.corners[n], {});
            height[n] = dot(at, up_);
            p[n] = axes_.planeFromWorld(at + origin_);
        }
        const auto [left, right] = std::minmax({p[0].u, p[1].u, p[2].u});
        const double twice = (p[1].u - p[0].u) * (p[2].v - p[0].v) - (p[2].u - p[0].u) * (p[1].v - p[0].v);
        if (std::abs(twice) < 1e-9) return;
        for (auto opening = firstFrom(left); opening != openings_.end() && opening->middle.u <= right; ++opening) {
            const PlanePoint m = opening->middle;
            const double b = ((m.u - p[0].u) * (p[2].v - p[0].v) - (p[2].u - p[0].u) * (m.v - p[0].v)) / twice,
                         c = ((p[1].u - p[0].u) * (m.v - p[0].v) - (m.u - p[0].u) * (p[1].v - p[0].v)) / twice;
            if (b < 0 || c < 0 || b + c > 1) continue;
            const double at = height[0] + b * (height[1] - height[0]) + c * (height[2] - height[0]);
            if (at <= cut_)
                opening->low = std::max(opening->low, at);
            else
                opening->high = std::min(opening->high, at);
        }
    }

    std::vector<CutOpening>& openings_;
    const PlaneAxes& axes_;
    const volume::VectorParts& parts_;
    Vec3d origin_, up_;
    double cut_;  // metres above the grid's lower corner
};

// The side of the wall for the mark: outside of all rooms, otherwise away from where a door opens.
PlanePoint awayOf(const CutOpening& opening, const SectionDrawing& drawing, const std::vector<PartRole>& roles) {
    const PlanePoint y{-opening.along.v, opening.along.u};
    const auto isInRoom = [&](PlanePoint p) {
        return std::any_of(
            drawing.components.begin(), drawing.components.end(), [&](const SectionComponent& component) {
                return roles[component.label] == PartRole::Space &&
                       std::any_of(component.polygons.begin(), component.polygons.end(),
                                   [&](const SectionPolygon& polygon) { return isInRing(p, polygon.outer); });
            });
    };
    const double beside = 0.5 * opening.depth + kBesideWall;
    const bool isLeft = isInRoom(moved(opening.middle, y, beside)),
               isRight = isInRoom(moved(opening.middle, y, -beside));
    double sign = isLeft ? -1 : 1;
    if (isLeft == isRight) {
        // Two rooms, or none: away from the swing of the door, otherwise from the middle of the drawing.
        PlanePoint from{};
        std::size_t count = 0;
        const auto add = [&](PlanePoint p) {
            from = {from.u + p.u, from.v + p.v};
            ++count;
        };
        for (const DoorSwing& swing : drawing.doors)
            if (swing.label == opening.label)
                for (const DoorSwing::Arc& arc : swing.arcs) {
                    add(arc.from);
                    add(arc.to);
                }
        if (count == 0)
            for (const SectionComponent& component : drawing.components)
                for (const SectionPolygon& polygon : component.polygons) add(polygon.outer.front());
        const double side =
            (from.u / double(count) - opening.middle.u) * y.u + (from.v / double(count) - opening.middle.v) * y.v;
        sign = side > 0 ? -1 : 1;
    }
    return {sign * y.u, sign * y.v};
}

// Half the thickness of the wall: the distance to the last border of the hull beside the opening, up to 1 m.
double halfWall(const CutOpening& opening, PlanePoint away, const SectionDrawing& drawing,
                const std::vector<PartRole>& roles) {
    double half = 0.5 * opening.depth;
    const PlanePoint x = opening.along;
    for (const SectionBorder& border : drawing.borders) {
        const auto isHull = [&](std::uint32_t label) {
            return label != volume::kNoLabel && roles[label] == PartRole::Hull;
        };
        if (isHull(border.left) == isHull(border.right)) continue;
        for (const PlanePoint p : border.points) {
            const PlanePoint d{p.u - opening.middle.u, p.v - opening.middle.v};
            const double along = std::abs(d.u * x.u + d.v * x.v), off = d.u * away.u + d.v * away.v;
            // Corners of the jambs.
            if (std::abs(along - 0.5 * opening.length) < 0.1 && off > half && off < 0.6) half = off;
        }
    }
    return half;
}

// Lowest and highest point of the meshes of a label and its parts; infinite without one.
std::pair<double, double> ownHeights(std::uint32_t label, const volume::SemanticVolume& volume) {
    const auto& triangles = volume.vectors.triangles;
    auto triangle = std::lower_bound(triangles.begin(), triangles.end(), label,
                                     [](const auto& t, std::uint32_t l) { return t.label < l; });
    const std::uint32_t end = std::max(label + 1, volume.labels.labels[label].subtreeEnd);
    std::pair<double, double> heights{kInfinity, -kInfinity};
    for (; triangle != triangles.end() && triangle->label < end; ++triangle)
        for (const std::uint32_t corner : triangle->corners) {
            const double height = dot(volume.vectors.position(corner, {}), volume.grid.axes()[2]);
            heights = {std::min(heights.first, height), std::max(heights.second, height)};
        }
    return heights;
}

}  // namespace

std::vector<OpeningHeights> findOpeningHeights(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                               const std::vector<PartRole>& roles,
                                               std::span<const BuildingLevel> levels, const DrawingTables& tables) {
    std::map<std::uint32_t, std::vector<SectionPolygon>> parts;  // by the whole window or door
    for (const SectionComponent& component : drawing.components) {
        if (roles[component.label] != PartRole::Opening) continue;
        auto& polygons = parts[wholeOf(component.label, volume.labels, roles)];
        polygons.insert(polygons.end(), component.polygons.begin(), component.polygons.end());
    }
    std::vector<CutOpening> openings;
    for (const auto& [label, polygons] : parts) {
        const auto opening = openingOf(label, polygons);
        const auto isSamePlace = [&](const CutOpening& other) {
            return std::hypot(other.middle.u - opening->middle.u, other.middle.v - opening->middle.v) < kOnePlace;
        };
        if (opening && std::none_of(openings.begin(), openings.end(), isSamePlace)) openings.push_back(*opening);
    }
    std::vector<OpeningHeights> found;
    if (openings.empty()) return found;
    const Vec3d up = volume.grid.axes()[2];
    const double cut = dot(drawing.plane.point - volume.grid.origin(), up);
    double floor = 0;
    for (const BuildingLevel& level : levels)
        if (level.floor <= cut) floor = level.roomFloor.value_or(level.floor);
    EdgeFinder(openings, drawing, volume, cut).run(tables.runs(), roles);
    for (const CutOpening& opening : openings) {
        OpeningHeights heights{opening.label, {}, awayOf(opening, drawing, roles), 0, 0, true};
        double low = opening.low, high = opening.high;
        // Without a lintel, the opening reaches through the ceiling: its window is all that is known.
        if (!(low > floor - kLeastOpening) || high > floor + kHighestDoor) {
            heights.isExact = false;
            std::tie(low, high) = ownHeights(opening.label, volume);
        }
        if (!(high - low >= kLeastOpening)) continue;
        // The threshold of a door does not count as a sill.
        const bool isDoor = isDoorLabel(volume.labels.labels[opening.label]);
        heights.sill = low - floor < (isDoor ? kThreshold : 0) ? 0 : low - floor;
        heights.head = high - floor;
        heights.at = moved(opening.middle, heights.away, halfWall(opening, heights.away, drawing, roles));
        found.push_back(heights);
    }
    std::ranges::stable_sort(found, {}, &OpeningHeights::label);
    return found;
}

}  // namespace svt::drawing
