#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/drawing/side_by_side.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/drawing/views/main_building.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {
namespace {

// The places along an axis where a section may stand.
struct PlaceRange {
    double low = 0, size = 0;  // metres above the grid's lower corner
    double spread = 0.0571;    // between two of nine places, as a share of the size
    double leastHull = 0;      // metres of height that the hull has in the section, if it is cut
};

// The height of the parts of the hull that a section cuts.
double hullHeight(const SectionDrawing& drawing, const std::vector<PartRole>& roles) {
    double low = kInfinity, high = -kInfinity;
    for (const SectionComponent& component : drawing.components) {
        if (roles[component.label] != PartRole::Hull) continue;
        for (const SectionPolygon& polygon : component.polygons)
            for (const PlanePoint p : polygon.outer) {
                low = std::min(low, p.v);
                high = std::max(high, p.v);
            }
    }
    return std::max(0.0, high - low);
}

// Selects the plane that cuts most of the rooms and least of the walls along their length; nothing if none of nine
// planes cuts a building.
Result<std::optional<double>> placeInRange(const volume::SemanticVolume& volume, int axis, const PlaceRange& range,
                                           const DrawingTables& tables, int threads) {
    const Vec3d along = volume.grid.axes()[static_cast<std::size_t>(axis)];
    const auto& labels = volume.labels.labels;
    const bool hasRooms = std::any_of(labels.begin(), labels.end(),
                                      [](const volume::Label& label) { return label.count > 0 && isRoomSpace(label); });
    const std::vector<PartRole>& roles = tables.roles();
    // From the middle outwards, avoiding round fractions of the extent, where walls often stand.
    const auto placeOf = [&](std::size_t n) {
        const std::size_t stepNumber = (n + 1) / 2;
        const auto step = static_cast<double>(stepNumber);
        return range.low + (0.487 + (n % 2 == 0 ? 1 : -1) * range.spread * step) * range.size;
    };
    std::array<std::optional<Result<SectionDrawing>>, 9> drawings;
    drawSideBySide(drawings.size(), threads, [&](std::size_t n, int own) {
        SectionOptions options;
        options.threads = own;
        options.tables = &tables;
        drawings[n] =
            drawSection(volume, {along * (axis == 1 ? -1.0 : 1.0), volume.grid.origin() + along * placeOf(n)}, options);
    });
    std::optional<double> best;
    double most = -kInfinity;
    for (std::size_t n = 0; n < drawings.size(); ++n) {
        const Result<SectionDrawing>& drawing = *drawings[n];
        if (!drawing) return drawing.error();
        // Without rooms, the plane that cuts most of the buildings wins.
        double score = 0;
        bool cutsBuilding = false;
        for (const SectionComponent& component : drawing->components) {
            const volume::Label& label = volume.labels.labels[component.label];
            cutsBuilding = cutsBuilding || roles[component.label] == PartRole::Hull || isRoomSpace(label);
            if (isRoomSpace(label))
                score += component.area + 2;
            else if (!model::isSpace(label.className))
                score += hasRooms ? -component.area : component.area + component.lineLength;
        }
        if (drawing->edgesInPlane > 0) score -= 1;
        const double hull = hullHeight(*drawing, roles);
        if (cutsBuilding && score > most + 0.5 && (hull == 0 || hull >= range.leastHull)) {
            best = placeOf(n);
            most = score;
        }
    }
    return best;
}

// The place of a section across an axis: through the stair, then through the ridge, then in the middle half of the main
// building, then anywhere in it. A stair outside, before the wall, shows nothing of the building.
Result<double> placeOfSection(const volume::SemanticVolume& volume, int axis, const MainBuilding& main,
                              const DrawingTables& tables, int threads) {
    constexpr double kHullShare = 0.5;  // of the height of the building
    std::vector<PlaceRange> ranges;
    const auto add = [&](const Box3d& box, double spread, double leastHull) {
        ranges.push_back({box.min[axis], box.size()[axis], spread, leastHull});
    };
    if (main.stair) add(*main.stair, 0.09, kHullShare * main.box.size().z);
    if (main.ridge && main.ridge->size()[axis] > main.ridge->size()[1 - axis]) add(*main.ridge, 0.06, 0);
    add(main.box, 0.0571, 0);
    add(main.box, 0.12, 0);
    for (const PlaceRange& range : ranges) {
        SVT_TRY(place, placeInRange(volume, axis, range, tables, threads));
        if (*place) return **place;
    }
    return main.box.min[axis] + 0.5 * main.box.size()[axis];
}

}  // namespace

Result<SheetViews> chooseSheetViews(const volume::SemanticVolume& volume, int threads, const DrawingTables* tables) {
    const DrawingTables own(volume);
    SheetViews chosen;
    chosen.levels = findLevels(volume);
    const volume::Grid& grid = volume.grid;
    const Vec3d up = grid.axes()[2];
    for (const BuildingLevel& level : chosen.levels) {
        const SectionPlane plane{up, grid.origin() + up * (level.floor + kCutAboveFloor), level.bound};
        if (meetsGrid(plane, grid))
            chosen.views.push_back({ViewKind::Plan, level.name, plane, level.floor, {.visible = true, .above = true}});
    }
    if (chosen.views.empty())
        chosen.views.push_back({ViewKind::Plan, "", defaultSectionPlane(volume), 0, {.visible = true, .above = true}});
    MainBuilding main = findMainBuilding(volume, labelExtents(volume));
    if (main.box.isEmpty()) {
        main.box.add(Vec3d{});
        main.box.add(scaled(toDouble(grid.dimension()), grid.spacing()));
    }
    // A-A across the ridge; without one, along the shorter side.
    const Vec3d size = main.ridge ? main.ridge->size() : main.box.size();
    const int first = size.x >= size.y ? 0 : 1;
    for (int n = 0; n < 2; ++n) {
        const int axis = n == 0 ? first : 1 - first;
        SVT_TRY(at, placeOfSection(volume, axis, main, tables != nullptr ? *tables : own, threads));
        const Vec3d along = grid.axes()[static_cast<std::size_t>(axis)];
        chosen.views.push_back({ViewKind::Section,
                                n == 0 ? "A" : "B",
                                {along * (axis == 1 ? -1.0 : 1.0), grid.origin() + along * *at},
                                0,
                                {.visible = true}});
    }
    for (const std::string_view side : elevationSides(volume)) {
        SVT_TRY(plane, elevationPlane(side, volume));
        chosen.views.push_back({ViewKind::Elevation, std::string(side), *plane, 0, {.visible = true}});
    }
    return chosen;
}

}  // namespace svt::drawing
