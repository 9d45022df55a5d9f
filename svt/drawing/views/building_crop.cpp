#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/clip_segment.hpp>

#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kMarginShare = 0.05, kLeastMargin = 1;  // of the building; metres
constexpr double kReachShare = 0.25, kLeastReach = 2;    // of the building; metres: parts within it belong to it
constexpr double kSmallShare = 0.3;                      // of the building: larger parts belong to it
constexpr double kPlotShare = 1.5;                       // of the building: larger slabs of the site are plots
constexpr std::uint8_t kAround = 1, kPlant = 2;          // values of labelsAroundBuilding()

struct CropBox {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};

    void add(PlanePoint p) noexcept {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    void add(const CropBox& other) noexcept {
        add(other.low);
        add(other.high);
    }
    [[nodiscard]] bool contains(PlanePoint p) const noexcept {
        return p.u >= low.u && p.u <= high.u && p.v >= low.v && p.v <= high.v;
    }
    [[nodiscard]] bool isEmpty() const noexcept { return !(low.u <= high.u); }
    [[nodiscard]] double width() const noexcept { return high.u - low.u; }
    [[nodiscard]] double depth() const noexcept { return high.v - low.v; }
    [[nodiscard]] double length() const noexcept { return std::max(width(), depth()); }
    // Along one axis; negative if the boxes overlap.
    [[nodiscard]] double distanceTo(const CropBox& other) const noexcept {
        return std::max({other.low.u - high.u, low.u - other.high.u, other.low.v - high.v, low.v - other.high.v});
    }
};

// The meshes of each label seen from above, along the grid's axes.
std::vector<CropBox> planBoxes(const volume::SemanticVolume& volume) {
    std::vector<CropBox> boxes(volume.labels.labels.size());
    const auto axes = volume.grid.axes();
    for (const auto& triangle : volume.vectors.triangles)
        for (const auto corner : triangle.corners) {
            const Vec3d p = volume.vectors.position(corner, {});
            boxes[triangle.label].add(PlanePoint{dot(p, axes[0]), dot(p, axes[1])});
        }
    return boxes;
}

bool isInBuilding(std::uint32_t label, const volume::LabelTable& table) {
    for (std::uint32_t at = label; at < table.labels.size(); at = table.labels[at].parent) {
        const model::ClassRank rank = model::classRank(table.labels[at].className);
        if (rank == model::ClassRank::Storey || rank == model::ClassRank::Building) return true;
        if (table.labels[at].parent >= at) return false;
    }
    return false;
}

// Labels outside of the building, by their meshes.
struct OutsideParts {
    std::vector<std::uint32_t> plots, away;
};

OutsideParts findOutsideParts(const volume::SemanticVolume& volume, const std::vector<PartRole>& roles) {
    OutsideParts found;
    const std::vector<CropBox> boxes = planBoxes(volume);
    CropBox building;
    std::vector<std::uint32_t> ofSite, unmeasured;
    for (std::uint32_t l = 0; l < boxes.size(); ++l) {
        if (boxes[l].isEmpty() || roles[l] == PartRole::Surroundings) continue;
        if (roles[l] == PartRole::Nothing)
            unmeasured.push_back(l);
        else if (isInBuilding(l, volume.labels))
            building.add(boxes[l]);
        else
            ofSite.push_back(l);
    }
    const bool hasBuilding = !building.isEmpty();
    const CropBox core = building;
    for (const std::uint32_t l : ofSite) {
        const bool isPlot =
            hasBuilding && std::max(boxes[l].width() / core.width(), boxes[l].depth() / core.depth()) > kPlotShare;
        if (isPlot)
            found.plots.push_back(l);
        else
            building.add(boxes[l]);
    }
    if (building.isEmpty()) return found;
    const double reach = std::max(kLeastReach, kReachShare * building.length());
    const double small = kSmallShare * building.length();
    for (bool isChanged = true; isChanged;) {
        const auto isFar = [&](std::uint32_t l) {
            return boxes[l].length() <= small && boxes[l].distanceTo(building) > reach;
        };
        const auto near = std::stable_partition(unmeasured.begin(), unmeasured.end(), isFar);
        isChanged = near != unmeasured.end();
        for (auto part = near; part != unmeasured.end(); ++part) building.add(boxes[*part]);
        unmeasured.erase(near, unmeasured.end());
    }
    found.away = std::move(unmeasured);
    return found;
}

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

// A plan has a tree or shrub whole or not at all. In elevations, it also hides what lies behind it, and is cut off.
void leaveOutPlantsAtTheEdge(SectionDrawing& drawing, std::span<const std::uint8_t> isAround, const CropBox& box) {
    constexpr double kUpright = 1 - 1e-9;
    if (std::abs(normalized(drawing.plane.normal).z) < kUpright) return;
    std::vector<std::uint8_t> isAtEdge(isAround.size(), 0);
    visitPoints(drawing, [&](std::uint32_t label, PlanePoint p) {
        if (isAround[label] == kPlant && !box.contains(p)) isAtEdge[label] = 1;
    });
    const auto isLeftOut = [&](std::uint32_t label) { return label != volume::kNoLabel && isAtEdge[label] != 0; };
    std::erase_if(drawing.components, [&](const SectionComponent& part) { return isLeftOut(part.label); });
    std::erase_if(drawing.lines, [&](const SectionLine& line) { return isLeftOut(line.label); });
    std::erase_if(drawing.beyond, [&](const BeyondLine& line) { return isLeftOut(line.label); });
    for (SectionBorder& border : drawing.borders)
        for (std::uint32_t* const side : {&border.left, &border.right})
            if (isLeftOut(*side)) *side = volume::kNoLabel;
    std::erase_if(drawing.borders, [](const SectionBorder& border) { return border.left == border.right; });
}

}  // namespace

std::vector<std::uint8_t> labelsAroundBuilding(const volume::SemanticVolume& volume) {
    const std::vector<PartRole> roles = partRoles(volume.labels);
    const OutsideParts outside = findOutsideParts(volume, roles);
    std::vector<std::uint8_t> isAround;
    for (std::size_t l = 0; l < roles.size(); ++l) {
        const bool isPlant = volume.labels.labels[l].className == "SolitaryVegetationObject";
        isAround.push_back(roles[l] != PartRole::Surroundings ? 0 : isPlant ? kPlant : kAround);
    }
    for (const auto* parts : {&outside.plots, &outside.away})
        for (const std::uint32_t label : *parts) isAround[label] = kAround;
    return isAround;
}

SectionDrawing croppedToBuilding(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    return croppedToBuilding(drawing, labelsAroundBuilding(volume));
}

SectionDrawing croppedToBuilding(const SectionDrawing& drawing, std::span<const std::uint8_t> isAround) {
    SectionDrawing cropped = drawing;
    CropBox box;
    visitPoints(drawing, [&](std::uint32_t label, PlanePoint p) {
        if (isAround[label] == 0) box.add(p);
    });
    // Removed parts may lie beyond the building.
    for (const RevisionLines& revision : drawing.revisions)
        for (const RevisionLines::Line& line : revision.removed) {
            box.add(line.from);
            box.add(line.to);
        }
    if (box.isEmpty()) return cropped;
    const double margin =
        std::max(kLeastMargin, kMarginShare * std::max(box.high.u - box.low.u, box.high.v - box.low.v));
    box.low = {box.low.u - margin, box.low.v - margin};
    box.high = {box.high.u + margin, box.high.v + margin};
    bool isWithin = true;
    visitPoints(drawing, [&](std::uint32_t, PlanePoint p) { isWithin = isWithin && box.contains(p); });
    if (isWithin) return cropped;
    leaveOutPlantsAtTheEdge(cropped, isAround, box);
    cropComponents(cropped, box);
    const auto borders = std::exchange(cropped.borders, {});
    const auto lines = std::exchange(cropped.lines, {});
    const auto beyond = std::exchange(cropped.beyond, {});
    for (const SectionBorder& border : borders)
        for (auto& piece : piecesOf(border.points, box))
            cropped.borders.push_back({std::move(piece), border.left, border.right});
    for (const SectionLine& line : lines)
        for (auto& piece : piecesOf(line.points, box)) cropped.lines.push_back({std::move(piece), line.label});
    for (const BeyondLine& line : beyond)
        if (const auto part = clipSegment(line.from, line.to, box.low, box.high))
            cropped.beyond.push_back({part->first, part->second, line.label, line.kind});
    return cropped;
}

std::vector<std::uint32_t> partsAwayFromBuilding(const volume::SemanticVolume& volume) {
    return findOutsideParts(volume, partRoles(volume.labels)).away;
}

}  // namespace svt::drawing
