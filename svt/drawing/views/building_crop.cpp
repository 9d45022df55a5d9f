#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/clip_segment.hpp>

#include <svt/drawing/dimension/part_roles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kMarginShare = 0.05, kLeastMargin = 1;  // of the building; metres

struct CropBox {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};

    void add(PlanePoint p) noexcept {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    [[nodiscard]] bool contains(PlanePoint p) const noexcept {
        return p.u >= low.u && p.u <= high.u && p.v >= low.v && p.v <= high.v;
    }
};

// The pieces of a polyline within the box.
std::vector<std::vector<PlanePoint>> piecesOf(const std::vector<PlanePoint>& points, const CropBox& box) {
    std::vector<std::vector<PlanePoint>> pieces;
    for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        const auto part = clipSegment(points[n], points[n + 1], box.low, box.high);
        if (!part) continue;
        if (pieces.empty() || !(pieces.back().back() == part->first)) pieces.push_back({part->first});
        pieces.back().push_back(part->second);
    }
    return pieces;
}

// The part of a ring within the box (Sutherland and Hodgman). Where it leaves the box, the ring runs along it.
Ring clippedRing(Ring ring, const CropBox& box) {
    for (const auto& [isU, limit, sign] : {std::tuple(true, box.low.u, 1.0), std::tuple(true, box.high.u, -1.0),
                                           std::tuple(false, box.low.v, 1.0), std::tuple(false, box.high.v, -1.0)}) {
        Ring kept;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            const double x = sign * ((isU ? a.u : a.v) - limit), y = sign * ((isU ? b.u : b.v) - limit);
            if (x >= 0) kept.push_back(a);
            if ((x >= 0) == (y >= 0)) continue;
            const double t = x / (x - y);
            kept.push_back({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)});
        }
        ring = std::move(kept);
    }
    return ring.size() >= 3 ? ring : Ring{};
}

double ringArea(const Ring& ring) noexcept {
    double twice = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        twice += a.u * b.v - b.u * a.v;
    }
    return 0.5 * twice;
}

// Calls `add` with the points of all parts that are drawn, and their label.
template <class Add>
void visitPoints(const SectionDrawing& drawing, const Add& add) {
    for (const SectionComponent& component : drawing.components)
        for (const SectionPolygon& polygon : component.polygons)
            for (const PlanePoint p : polygon.outer) add(component.label, p);
    for (const SectionLine& line : drawing.lines)
        for (const PlanePoint p : line.points) add(line.label, p);
    for (const BeyondLine& line : drawing.beyond) {
        add(line.label, line.from);
        add(line.label, line.to);
    }
    for (const DoorSwing& door : drawing.doors)
        for (const DoorSwing::Arc& arc : door.arcs) {
            add(door.label, arc.from);
            add(door.label, arc.to);
        }
}

void cropComponents(SectionDrawing& drawing, const CropBox& box) {
    for (SectionComponent& component : drawing.components) {
        double area = 0;
        for (SectionPolygon& polygon : component.polygons) {
            if (!std::all_of(polygon.outer.begin(), polygon.outer.end(),
                             [&](PlanePoint p) { return box.contains(p); })) {
                polygon.outer = clippedRing(std::move(polygon.outer), box);
                for (Ring& hole : polygon.holes) hole = clippedRing(std::move(hole), box);
                std::erase_if(polygon.holes, [](const Ring& hole) { return hole.empty(); });
                polygon.area = ringArea(polygon.outer);
                for (const Ring& hole : polygon.holes) polygon.area += ringArea(hole);
            }
            area += polygon.area;
        }
        std::erase_if(component.polygons, [](const SectionPolygon& polygon) { return polygon.outer.empty(); });
        component.area = area;
    }
}

}  // namespace

SectionDrawing croppedToBuilding(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    SectionDrawing cropped = drawing;
    const std::vector<PartRole> roles = partRoles(volume.labels);
    CropBox box;
    visitPoints(drawing, [&](std::uint32_t label, PlanePoint p) {
        if (roles[label] != PartRole::Surroundings) box.add(p);
    });
    if (!(box.low.u <= box.high.u)) return cropped;
    const double margin =
        std::max(kLeastMargin, kMarginShare * std::max(box.high.u - box.low.u, box.high.v - box.low.v));
    box.low = {box.low.u - margin, box.low.v - margin};
    box.high = {box.high.u + margin, box.high.v + margin};
    bool isWithin = true;
    visitPoints(drawing, [&](std::uint32_t, PlanePoint p) { isWithin = isWithin && box.contains(p); });
    if (isWithin) return cropped;
    cropComponents(cropped, box);
    cropped.borders.clear();
    for (const SectionBorder& border : drawing.borders)
        for (auto& piece : piecesOf(border.points, box))
            cropped.borders.push_back({std::move(piece), border.left, border.right});
    cropped.lines.clear();
    for (const SectionLine& line : drawing.lines)
        for (auto& piece : piecesOf(line.points, box)) cropped.lines.push_back({std::move(piece), line.label});
    cropped.beyond.clear();
    for (const BeyondLine& line : drawing.beyond)
        if (const auto part = clipSegment(line.from, line.to, box.low, box.high))
            cropped.beyond.push_back({part->first, part->second, line.label, line.kind});
    return cropped;
}

}  // namespace svt::drawing
