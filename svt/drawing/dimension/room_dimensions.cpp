#include <svt/drawing/dimension/dimension_chains.hpp>

#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr std::size_t kProbes = 33;      // lines across a room
constexpr double kSameWidth = 0.005;     // metres
constexpr double kNarrowestWidth = 0.5;  // metres
constexpr double kLeastShare = 0.25;     // of the lines that have the width of a room
constexpr double kFromWall = 0.22;       // of a room: where its dimensions stand
constexpr double kSquare = 0.0175;       // slope of a wall at an end, 1 degree

// A stretch of the line v = at (for dimensions along u) or u = at.
struct Probe {
    double at = 0, from = 0, to = 0;
};

struct RoomEdge {
    PlanePoint a, b;
};

// A room, its borders with anything else, and those of the room and its furniture with walls and other rooms.
struct RoomBorders {
    std::vector<RoomEdge> own, clear;
};

// Furniture and installations stand in a room. A suspended ceiling bounds it.
bool isMovable(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    return rank == model::ClassRank::Furniture || rank == model::ClassRank::Installation;
}

RoomBorders bordersOf(const BorderStrips& strips, const SectionPolygon& polygon, std::uint32_t room,
                      const volume::SemanticVolume& volume) {
    constexpr double kFurniture = 1;  // metres of furniture along a wall
    RoomBorders borders;
    const auto addRing = [&](const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) borders.own.push_back({ring[n], ring[(n + 1) % ring.size()]});
    };
    addRing(polygon.outer);
    for (const Ring& hole : polygon.holes) addRing(hole);
    PlanePoint low = polygon.outer.front(), high = low;
    for (const PlanePoint p : polygon.outer) {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    const auto isClear = [&](std::uint32_t label) {
        return label != volume::kNoLabel && (label == room || isMovable(volume.labels.labels[label]));
    };
    for (const auto& [border, a, b] : strips.between(low.v - kFurniture, high.v + kFurniture)) {
        const bool isNear = std::max(a.u, b.u) >= low.u - kFurniture && std::min(a.u, b.u) <= high.u + kFurniture &&
                            std::max(a.v, b.v) >= low.v - kFurniture && std::min(a.v, b.v) <= high.v + kFurniture;
        if (isNear && isClear(border->left) != isClear(border->right)) borders.clear.push_back({a, b});
    }
    return borders;
}

struct RoomCrossing {
    double s = 0;
    bool isAcross = false;  // the border stands across the line
};

std::vector<RoomCrossing> crossingsAt(const std::vector<RoomEdge>& edges, double at, bool isAlongU) {
    std::vector<RoomCrossing> crossings;
    for (const auto& [p, q] : edges) {
        const double s0 = isAlongU ? p.u : p.v, t0 = isAlongU ? p.v : p.u, s1 = isAlongU ? q.u : q.v,
                     t1 = isAlongU ? q.v : q.u;
        if ((t0 > at) != (t1 > at))
            crossings.push_back(
                {s0 + (at - t0) / (t1 - t0) * (s1 - s0), std::abs(s1 - s0) <= kSquare * std::abs(t1 - t0)});
    }
    std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.s < b.s; });
    return crossings;
}

// The clear stretch around the widest part of the room, between borders that stand across it.
std::optional<Probe> probeOf(const RoomBorders& borders, double at, bool isAlongU) {
    const auto own = crossingsAt(borders.own, at, isAlongU);
    double from = 0, to = 0;
    for (std::size_t n = 0; n + 1 < own.size(); n += 2)
        if (own[n + 1].s - own[n].s > to - from) std::tie(from, to) = std::pair(own[n].s, own[n + 1].s);
    if (!(to > from)) return std::nullopt;
    const double middle = 0.5 * (from + to);
    const auto clear = crossingsAt(borders.clear, at, isAlongU);
    for (std::size_t n = 0; n + 1 < clear.size(); ++n) {
        const RoomCrossing &a = clear[n], &b = clear[n + 1];
        if (a.s > middle || b.s < middle) continue;
        if (!a.isAcross || !b.isAcross || b.s - a.s < kNarrowestWidth) return std::nullopt;
        return Probe{at, a.s, b.s};
    }
    return std::nullopt;
}

// The dimension that most lines of a room share, on the line nearest to its place.
std::optional<RoomDimension> dimensionOf(const RoomBorders& borders, std::uint32_t label, bool isAlongU) {
    double low = kInfinity, high = -kInfinity;
    for (const RoomEdge& edge : borders.own) {
        const double across = isAlongU ? edge.a.v : edge.a.u;
        low = std::min(low, across);
        high = std::max(high, across);
    }
    std::vector<Probe> probes;
    for (std::size_t n = 0; n < kProbes; ++n)
        if (const auto probe = probeOf(borders, low + (high - low) * (double(n) + 0.5) / kProbes, isAlongU))
            probes.push_back(*probe);
    const auto isSameAs = [](const Probe& a) {
        return [&](const Probe& b) { return std::abs(a.from - b.from) + std::abs(a.to - b.to) < kSameWidth; };
    };
    const Probe* best = nullptr;
    std::ptrdiff_t most = 0;
    for (const Probe& probe : probes) {
        const auto count = std::count_if(probes.begin(), probes.end(), isSameAs(probe));
        if (count <= most) continue;
        most = count;
        best = &probe;
    }
    if (best == nullptr || double(most) < kLeastShare * kProbes) return std::nullopt;
    const double place = low + kFromWall * (high - low);
    const Probe width = *best;
    const auto isNearer = [&](const Probe& a, const Probe& b) {
        return std::abs(a.at - place) < std::abs(b.at - place);
    };
    for (const Probe& probe : probes)
        if (isSameAs(width)(probe) && isNearer(probe, *best)) best = &probe;
    return isAlongU ? RoomDimension{label, {best->from, best->at}, {best->to, best->at}}
                    : RoomDimension{label, {best->at, best->from}, {best->at, best->to}};
}

}  // namespace

std::vector<RoomDimension> findRoomDimensions(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    std::vector<RoomDimension> found;
    const BorderStrips strips(drawing);
    for (const SectionComponent& component : drawing.components) {
        if (!isRoomSpace(volume.labels.labels[component.label]) || component.isZone || component.polygons.empty())
            continue;
        const SectionPolygon& largest = *std::ranges::max_element(component.polygons, {}, &SectionPolygon::area);
        const RoomBorders borders = bordersOf(strips, largest, component.label, volume);
        for (const bool isAlongU : {true, false})
            if (const auto dimension = dimensionOf(borders, component.label, isAlongU)) found.push_back(*dimension);
    }
    return found;
}

std::pair<double, double> findClearHeight(const BorderStrips& strips, const volume::SemanticVolume& volume,
                                          const SectionPolygon& polygon, std::uint32_t room) {
    if (const auto common = dimensionOf(bordersOf(strips, polygon, room, volume), room, false))
        return {common->from.v, common->to.v};
    const auto [low, high] = std::ranges::minmax(polygon.outer, {}, &PlanePoint::v);
    return {low.v, high.v};
}

}  // namespace svt::drawing
