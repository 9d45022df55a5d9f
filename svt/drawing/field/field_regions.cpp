#include <svt/drawing/field/field_regions.hpp>

#include <svt/drawing/field_drawing.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kSlit = 2.5e-4;       // metres: half the width of a cut along a surface without thickness
constexpr double kLeastRegion = 1e-6;  // m2

void addRing(const Ring& ring, bool isReversed, OutlineUnion& outline) {
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const plane::Point from = onFieldGrid(ring[n]), to = onFieldGrid(ring[(n + 1) % ring.size()]);
        if (isReversed)
            outline.addEdge(to, from);
        else
            outline.addEdge(from, to);
    }
}

void addPolygons(const SectionComponent& component, bool isReversed, OutlineUnion& outline) {
    for (const SectionPolygon& polygon : component.polygons) {
        addRing(polygon.outer, isReversed, outline);
        for (const Ring& hole : polygon.holes) addRing(hole, isReversed, outline);
    }
}

// Cuts a thin rectangle along a line out of an outline.
void addSlits(const std::vector<PlanePoint>& points, OutlineUnion& outline) {
    for (std::size_t n = 0; n + 1 < points.size(); ++n) {
        const PlanePoint a = points[n], b = points[n + 1];
        const double u = b.u - a.u, v = b.v - a.v, length = std::hypot(u, v);
        if (!(length > 0)) continue;
        const double su = kSlit * u / length, sv = kSlit * v / length;
        addRing({{a.u - su + sv, a.v - sv - su},
                 {b.u + su + sv, b.v + sv - su},
                 {b.u + su - sv, b.v + sv + su},
                 {a.u - su - sv, a.v - sv + su}},
                true, outline);
    }
}

void addRegions(const OutlineUnion& outline, bool isAir, std::vector<FieldRegion>& regions) {
    for (SectionPolygon& polygon : fieldPolygons(outline, kLeastRegion)) {
        FieldRegion& region = regions.emplace_back();
        region.isAir = isAir;
        region.rings.push_back(std::move(polygon.outer));
        for (Ring& hole : polygon.holes) region.rings.push_back(std::move(hole));
    }
}

// The extent of the section with its margin, counter-clockwise.
Ring extentOf(const SectionDrawing& drawing) {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    const auto add = [&](const std::vector<PlanePoint>& points) {
        for (const PlanePoint p : points) {
            low = {std::min(low.u, p.u), std::min(low.v, p.v)};
            high = {std::max(high.u, p.u), std::max(high.v, p.v)};
        }
    };
    for (const SectionComponent& component : drawing.components)
        for (const SectionPolygon& polygon : component.polygons) add(polygon.outer);
    for (const SectionLine& line : drawing.lines) add(line.points);
    if (!(low.u <= high.u)) return {};
    low = {low.u - kFieldMargin, low.v - kFieldMargin};
    high = {high.u + kFieldMargin, high.v + kFieldMargin};
    return {low, {high.u, low.v}, high, {low.u, high.v}};
}

}  // namespace

plane::Point onFieldGrid(PlanePoint p) noexcept {
    return {std::llround(p.u / kFieldUnit), std::llround(p.v / kFieldUnit)};
}

std::vector<SectionPolygon> fieldPolygons(const OutlineUnion& outline, double leastArea) {
    std::vector<SectionPolygon> polygons;
    for (const PlanPolygon& from : outline.polygons(kFieldUnit, {0, 0}, leastArea)) {
        SectionPolygon& polygon = polygons.emplace_back();
        polygon.area = areaOf(from);
        for (std::size_t r = 0; r < from.rings.size(); ++r) {
            Ring& ring = r == 0 ? polygon.outer : polygon.holes.emplace_back();
            for (const auto& [u, v] : from.rings[r]) ring.push_back({u, v});
        }
    }
    return polygons;
}

std::vector<FieldRegion> findFieldRegions(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                          const std::vector<char>& isMedium, const std::vector<char>& isAir,
                                          bool areRoomsApart) {
    struct Kind {
        bool isMedium, isAir;
    };
    const auto kindOf = [&](std::uint32_t l) -> Kind {
        const volume::Label& label = volume.labels.labels[l];
        if (label.count > 0) return {isMedium[label.first] != 0, isAir[label.first] != 0};
        // Without voxels: as the air around it, or as most solids.
        const bool isSpace = model::isSpace(label.className);
        return {isSpace && isMedium[0] != 0, isSpace};
    };
    OutlineUnion air, solid;
    std::vector<OutlineUnion> rooms;
    const bool hasEmptySpace = !isMedium.empty() && isMedium[0] != 0;
    if (const Ring extent = extentOf(drawing); hasEmptySpace && !extent.empty()) addRing(extent, false, air);
    for (const SectionComponent& component : drawing.components) {
        const Kind kind = kindOf(component.label);
        const bool isRoom = kind.isAir && kind.isMedium;
        if (hasEmptySpace && (!isRoom || areRoomsApart)) addPolygons(component, true, air);
        if (isRoom && areRoomsApart)
            addPolygons(component, false, rooms.emplace_back());
        else if (isRoom && !hasEmptySpace)
            addPolygons(component, false, air);
        if (!kind.isAir && kind.isMedium) addPolygons(component, false, solid);
    }
    for (const SectionLine& line : drawing.lines)
        if (volume.labels.labels[line.label].className != "ClosureSurface") {
            addSlits(line.points, air);
            for (OutlineUnion& room : rooms) addSlits(line.points, room);
        }
    std::vector<FieldRegion> regions;
    addRegions(air, true, regions);
    for (const OutlineUnion& room : rooms) addRegions(room, true, regions);
    addRegions(solid, false, regions);
    return regions;
}

}  // namespace svt::drawing
