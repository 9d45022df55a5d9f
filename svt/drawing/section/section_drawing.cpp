#include <svt/drawing/section_drawing.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/drawing/beyond/lines_beyond.hpp>
#include <svt/drawing/dimension/dimension_chains.hpp>
#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/exact/body_cells.hpp>
#include <svt/drawing/room_floor_areas.hpp>
#include <svt/drawing/section/door_swings.hpp>
#include <svt/drawing/section/draw_labels.hpp>
#include <svt/drawing/section/exact_section.hpp>
#include <svt/drawing/section/section_rings.hpp>
#include <svt/drawing/section/wall_joints.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

// Entry per label: 1 if it is drawn.
Result<std::vector<std::uint8_t>> drawnLabels(const volume::SemanticVolume& volume, const SectionOptions& options) {
    const volume::LabelTable& table = volume.labels;
    const analyze::LabelRows rows(volume, options.nothing);
    std::vector<std::uint8_t> isDrawn(table.labels.size(), options.show.empty() ? 1 : 0);
    for (const bool isShown : {true, false})
        for (const std::string& query : isShown ? options.show : options.hide) {
            SVT_TRY(selected, analyze::selectWithParts(rows, query));
            for (const std::uint32_t label : *selected) isDrawn[label] = isShown ? 1 : 0;
        }
    if (!options.spaces)
        for (std::size_t l = 0; l < isDrawn.size(); ++l)
            if (model::isSpace(table.labels[l].className)) isDrawn[l] = 0;
    return isDrawn;
}

// Entry per scalar: its label, or kNoLabel if it is omitted.
std::vector<std::uint32_t> drawnLabelOfScalar(const volume::LabelTable& table,
                                              const std::vector<std::uint8_t>& isDrawn) {
    std::vector<std::uint32_t> labels = table.labelOfScalar();
    for (std::uint32_t& label : labels)
        if (label != kNoLabel && isDrawn[label] == 0) label = kNoLabel;
    return labels;
}

class DrawingMaker {
public:
    /// \param isExact  by label; empty: none
    /// \param reach    metres that borders of exact labels may be off, beside the tolerance
    DrawingMaker(const volume::SemanticVolume& volume, SectionDrawing drawing, double smallestArea,
                 std::vector<std::uint8_t> isExact, double reach)
        : volume_(volume),
          drawing_(std::move(drawing)),
          smallestArea_(smallestArea),
          isExact_(std::move(isExact)),
          reach_(reach) {
        isExact_.resize(volume.labels.labels.size(), 0);
    }

    void addLines(const std::vector<DrawingBorder>& lines) {
        for (const DrawingBorder& line : lines) {
            SectionLine added;
            added.label = line.left != kNoLabel ? line.left : line.right;
            for (const plane::Point p : line.points) added.points.push_back(placed(p));
            drawing_.lines.push_back(std::move(added));
        }
        std::ranges::stable_sort(drawing_.lines, {}, &SectionLine::label);
    }

    SectionDrawing make(const std::vector<DrawingBorder>& borders) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> shown;  // label and border
        for (const DrawingPolygon& polygon : makePolygons(borders)) addPolygon(polygon, shown);
        // Borders of polygons that were left out as too small are not drawn.
        for (std::uint32_t b = 0; b < borders.size(); ++b) {
            SectionBorder border;
            border.left = shown.contains({borders[b].left, b}) ? borders[b].left : kNoLabel;
            border.right = shown.contains({borders[b].right, b}) ? borders[b].right : kNoLabel;
            if (border.left == border.right) continue;
            for (const plane::Point p : borders[b].points) border.points.push_back(placed(p));
            drawing_.borders.push_back(std::move(border));
        }
        addLineLengths();
        addTotals();
        return std::move(drawing_);
    }

private:
    [[nodiscard]] PlanePoint placed(plane::Point p) const noexcept {
        return {double(p.u) * drawing_.drawingUnit, double(p.v) * drawing_.drawingUnit};
    }

    void addPolygon(const DrawingPolygon& polygon, std::set<std::pair<std::uint32_t, std::uint32_t>>& shown) {
        SectionPolygon added;
        double bound = 0;
        for (const auto& ring : polygon.rings) {
            added.area += 0.5 * twiceSignedArea(ring) * drawing_.drawingUnit * drawing_.drawingUnit;
            Ring& points = &ring == &polygon.rings.front() ? added.outer : added.holes.emplace_back();
            for (const RingPoint& p : ring) points.push_back(placed(p.point));
            bound += isExact_[polygon.label] != 0 ? exactBoundOf(points, polygon.label) : boundOf(points);
        }
        if (!(added.area > 0) || added.area < smallestArea_) return;
        for (const auto& ring : polygon.rings)
            for (const RingPoint& p : ring) shown.emplace(polygon.label, p.border);
        if (drawing_.components.empty() || drawing_.components.back().label != polygon.label)
            drawing_.components.push_back({polygon.label, {}, 0, 0, isExact_[polygon.label] != 0, 0});
        SectionComponent& component = drawing_.components.back();
        component.area += added.area;
        component.areaBound += bound;
        component.polygons.push_back(std::move(added));
    }

    // Error bound of a ring's area by how far a border may be off.
    [[nodiscard]] double exactBoundOf(const Ring& ring, std::uint32_t label) const noexcept {
        double length = 0;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            length += std::hypot(b.u - a.u, b.v - a.v);
        }
        const bool isBody = volume_.labels.labels[label].filling == volume::Filling::Body;
        return length * (reach_ + drawing_.tolerance + drawing_.drawingUnit + (isBody ? kBodyTolerance : 0));
    }

    // Lengths of lines; labels that have nothing else become components.
    void addLineLengths() {
        std::vector<SectionComponent>& components = drawing_.components;
        const std::size_t areas = components.size();
        std::unordered_map<std::uint32_t, std::size_t> numberOf;
        for (std::size_t n = 0; n < areas; ++n) numberOf.emplace(components[n].label, n);
        for (const SectionLine& line : drawing_.lines) {
            const auto [found, isNew] = numberOf.emplace(line.label, components.size());
            if (isNew) components.push_back({line.label, {}, 0, 0, true, 0});
            SectionComponent& component = components[found->second];
            for (std::size_t n = 0; n + 1 < line.points.size(); ++n)
                component.lineLength +=
                    std::hypot(line.points[n + 1].u - line.points[n].u, line.points[n + 1].v - line.points[n].v);
        }
        if (components.size() != areas) std::ranges::sort(components, {}, &SectionComponent::label);
    }

    // Error bound of a ring's area: the sum of each edge's length times half the extent of a voxel across it.
    [[nodiscard]] double boundOf(const Ring& ring) const noexcept {
        double bound = 0;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            // Normal of the edge in the plane, times the edge's length.
            const Vec3d across = drawing_.axes.u * (b.v - a.v) - drawing_.axes.v * (b.u - a.u);
            for (int axis = 0; axis < 3; ++axis)
                bound += 0.5 * volume_.grid.spacing()[axis] *
                         std::abs(dot(across, volume_.grid.axes()[static_cast<std::size_t>(axis)]));
            bound += (drawing_.tolerance + drawing_.drawingUnit) * length(across);
        }
        return bound;
    }

    void addTotals() {
        std::map<std::string, ClassArea> classes;
        for (const SectionComponent& component : drawing_.components) {
            const std::string& name = volume_.labels.labels[component.label].className;
            ClassArea& total = classes[name];
            total.className = name;
            ++total.components;
            total.area += component.area;
            drawing_.area += component.area;
        }
        for (auto& [name, total] : classes) drawing_.classes.push_back(std::move(total));
    }

    const volume::SemanticVolume& volume_;
    SectionDrawing drawing_;
    double smallestArea_;
    std::vector<std::uint8_t> isExact_;  // by label
    double reach_;
};

// Intervals of the line v = at inside a polygon: start and end, alternating.
std::vector<double> crossingsOf(const SectionPolygon& polygon, double at) {
    std::vector<double> crossings;
    const auto add = [&](const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            if ((a.v > at) != (b.v > at)) crossings.push_back(a.u + (at - a.v) / (b.v - a.v) * (b.u - a.u));
        }
    };
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
    std::ranges::sort(crossings);
    return crossings;
}

// Narrows [from, to] to its widest intersection with an interval of a level; false if there is none.
bool narrow(const std::vector<double>& level, double& from, double& to) {
    double bestFrom = 0, bestTo = 0;
    for (std::size_t n = 0; n + 1 < level.size(); n += 2) {
        const double left = std::max(from, level[n]), right = std::min(to, level[n + 1]);
        if (right - left > bestTo - bestFrom) {
            bestFrom = left;
            bestTo = right;
        }
    }
    from = bestFrom;
    to = bestTo;
    return to > from;
}

SectionDrawing drawVoxels(const volume::SemanticVolume& volume, const volume::BrickVolume& bricks,
                          const SectionPlane& plane, const std::vector<std::uint8_t>& isDrawn,
                          const SectionOptions& options) {
    SectionDrawing drawing;
    drawing.plane = {normalized(plane.normal), plane.point, plane.bound};
    drawing.axes = makePlaneAxes(plane, volume.grid);
    const CutPlane cut(drawing.plane, drawing.axes, volume.grid);
    const Vec3d spacing = volume.grid.spacing();
    drawing.drawingUnit = cut.drawingUnit();
    drawing.tolerance = options.tolerance >= 0 ? options.tolerance : 0.01 * std::min({spacing.x, spacing.y, spacing.z});
    std::vector<DrawingBorder> borders =
        joinEdges(cutPieces(bricks, volume.planes, cut, drawnLabelOfScalar(volume.labels, isDrawn)));
    // At least 1.5 drawing units: rounded points may be off their line by a drawing unit.
    straighten(borders, std::max(drawing.tolerance / drawing.drawingUnit, 1.5));
    return DrawingMaker(volume, std::move(drawing), options.smallestArea, {}, 0).make(borders);
}

Result<std::optional<SectionDrawing>> drawMeshes(const volume::SemanticVolume& volume,
                                                 const volume::BrickVolume* bricks, const SectionPlane& plane,
                                                 const std::vector<std::uint8_t>& isDrawn,
                                                 const SectionOptions& options, const DrawingTables& tables) {
    SectionDrawing drawing;
    drawing.plane = {normalized(plane.normal), plane.point, plane.bound};
    drawing.axes = makePlaneAxes(plane, volume.grid);
    SVT_TRY(cut, cutExactly(volume, bricks, drawing.plane, drawing.axes, isDrawn, tables, options.threads));
    if (!*cut) return std::optional<SectionDrawing>{};
    ExactSection& section = **cut;
    drawing.isFromMeshes = true;
    drawing.edgesInPlane = section.edgesInPlane;
    drawing.planeShift = section.planeShift;
    drawing.plane.point = drawing.plane.point - drawing.plane.normal * section.planeShift;
    drawing.axes = makePlaneAxes(drawing.plane, volume.grid);
    drawing.drawingUnit = section.drawingUnit;
    const double meeting = section.tolerance * section.drawingUnit;
    drawing.tolerance = options.tolerance >= 0 ? options.tolerance : meeting / 2;
    const double tolerance = std::max(drawing.tolerance / drawing.drawingUnit, 1.5);
    std::vector<DrawingBorder> borders = joinEdges(std::move(section.edges)),
                               lines = joinEdges(std::move(section.lines));
    straighten(borders, tolerance);
    straighten(lines, tolerance);
    const double reach = 1.5 * meeting + volume.vectors.unit;
    DrawingMaker maker(volume, std::move(drawing), options.smallestArea, std::move(section.isExact), reach);
    maker.addLines(lines);
    return std::optional<SectionDrawing>(maker.make(borders));
}

// Plans: the floor areas of rooms, so that stamps and schedules have one number, and which rooms are zones.
void addFloorAreas(SectionDrawing& drawing, const volume::SemanticVolume& volume, const DrawingTables& tables) {
    constexpr double kUpright = 1 - 1e-9;
    if (std::abs(dot(drawing.plane.normal, volume.grid.axes()[2])) < kUpright) return;
    for (SectionComponent& component : drawing.components) {
        component.floorArea = tables.roomAreas()[component.label];
        component.isZone = tables.roomShares()[component.label].isZone;
    }
}

// Adds floor areas, lines beyond the cut, doors and dimensions.
void addDetails(SectionDrawing& drawing, const volume::SemanticVolume& volume, const std::vector<std::uint8_t>& isDrawn,
                const SectionOptions& options, const DrawingTables& tables) {
    addFloorAreas(drawing, volume, tables);
    addLinesBeyond(drawing, volume, isDrawn, options.beyond, tables, options.threads);
    if (options.doorSwings) drawing.doors = findDoorSwings(drawing, volume);
    if (options.dimensions) addDimensions(drawing, volume, options, tables);
    if (options.tables != nullptr || options.beyond.isAny()) drawing.hatches = tables.hatches();
}

Result<SectionDrawing> drawSectionOf(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks,
                                     const SectionPlane& plane, const SectionOptions& options) {
    if (!isFinite(plane.normal) || !isFinite(plane.point) || !(length(plane.normal) > 0))
        return Error(Code::BadSection, "the plane of a section needs a finite point, and a normal that is not zero");
    if (!std::isfinite(options.smallestArea) || !std::isfinite(options.tolerance))
        return Error(Code::BadArgument,
                     fmt::format("smallest area {} m2 and tolerance {} m of a section must be finite",
                                 options.smallestArea, options.tolerance));
    SVT_TRY(drawn, drawnLabels(volume, options));
    const DrawingTables ownTables(volume);
    const DrawingTables& tables = options.tables != nullptr ? *options.tables : ownTables;
    SVT_TRY(drawing, drawLabels(volume, bricks, plane, *drawn, options, tables));
    joinWalls(*drawing, volume.labels, tables);
    return std::move(*drawing);
}

}  // namespace

Result<SectionDrawing> drawLabels(const volume::SemanticVolume& volume, const volume::BrickVolume* bricks,
                                  const SectionPlane& plane, const std::vector<std::uint8_t>& isDrawn,
                                  const SectionOptions& options, const DrawingTables& tables) {
    const bool isCut = options.useMeshes && hasMeshes(volume);
    if (isCut) {
        SVT_TRY(drawing, drawMeshes(volume, bricks, plane, isDrawn, options, tables));
        if (*drawing) {
            addDetails(**drawing, volume, isDrawn, options, tables);
            return std::move(**drawing);
        }
    }
    if (bricks == nullptr) {
        SVT_TRY(made, tables.bricks(options.threads));
        bricks = *made;
    }
    SectionDrawing drawing = drawVoxels(volume, *bricks, plane, isDrawn, options);
    drawing.isUnsettled = isCut;
    drawing.lacksMeshes = options.beyond.isAny() && !hasMeshes(volume);
    addDetails(drawing, volume, isDrawn, options, tables);
    return drawing;
}

PlaneAxes makePlaneAxes(const SectionPlane& plane, const volume::Grid& grid) {
    PlaneAxes axes;
    const Vec3d normal = normalized(plane.normal), up = grid.axes()[2];
    axes.origin = grid.origin() + normal * dot(normal, plane.point - grid.origin());
    const double upright = dot(normal, up);
    if (std::abs(upright) > 1 - 1e-12) {
        axes.u = grid.axes()[0];
        axes.v = grid.axes()[1];
        axes.normal = cross(axes.u, axes.v);
        return axes;
    }
    axes.normal = normal;
    axes.v = normalized(up - normal * upright);
    axes.u = cross(axes.v, normal);
    return axes;
}

Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume, const SectionPlane& plane,
                                   const SectionOptions& options) {
    return drawSectionOf(volume, nullptr, plane, options);
}

Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume, const volume::BrickVolume& bricks,
                                   const SectionPlane& plane, const SectionOptions& options) {
    return drawSectionOf(volume, &bricks, plane, options);
}

TextPlace findTextPlace(const SectionPolygon& polygon) {
    constexpr std::size_t kLevels = 32;
    const auto [low, high] = std::ranges::minmax(polygon.outer, {}, &PlanePoint::v);
    const double step = (high.v - low.v) / kLevels;
    std::vector<std::vector<double>> levels;
    for (std::size_t n = 0; n < kLevels; ++n) levels.push_back(crossingsOf(polygon, low.v + step * (double(n) + 0.5)));
    TextPlace best;
    double bestScore = -1;
    for (std::size_t bottom = 0; bottom < kLevels; ++bottom)
        for (std::size_t n = 0; n + 1 < levels[bottom].size(); n += 2) {
            double from = levels[bottom][n], to = levels[bottom][n + 1];
            for (std::size_t top = bottom; top < kLevels && narrow(levels[top], from, to); ++top) {
                const double height = step * double(top + 1 - bottom);
                // Texts are wide. The highest of equally good rectangles is used, so that the text is centred in it.
                const double score = std::min((to - from) / 2, height);
                if (score < bestScore || (score == bestScore && height <= best.height)) continue;
                bestScore = score;
                best = {{0.5 * (from + to), low.v + step * (0.5 * double(bottom + top + 1))}, to - from, height};
            }
        }
    return best;
}

}  // namespace svt::drawing
