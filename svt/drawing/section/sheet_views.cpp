#include <svt/drawing/sheet_views.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace svt::drawing {
namespace {

// Whether a component is a stair by its class, type or name; the door of a stairwell is not a stair.
bool isStair(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    if (rank != model::ClassRank::Installation && rank != model::ClassRank::Element) return false;
    if (model::isBoundarySurface(label.className)) return false;
    const std::string words =
        lowerAscii(label.className + " " + label.name) + lowerTexts(label, {"ifcType", "function"});
    return words.find("stair") != std::string::npos || words.find("treppe") != std::string::npos;
}

// Selects one of nine planes across an axis, through the stair or the middle half of the building: the one that cuts
// most of the rooms and least of the walls along their length.
Result<double> placeOfSection(const volume::SemanticVolume& volume, int axis, const Box3d& all,
                              const std::optional<Box3d>& stair, int threads) {
    const Box3d& through = stair ? *stair : all;
    const double low = through.min[axis], size = through.max[axis] - low, spread = stair ? 0.09 : 0.0571;
    const Vec3d along = volume.grid.axes()[static_cast<std::size_t>(axis)];
    const auto& labels = volume.labels.labels;
    const bool hasRooms = std::any_of(labels.begin(), labels.end(),
                                      [](const volume::Label& label) { return label.count > 0 && isRoomSpace(label); });
    SectionOptions options;
    options.threads = threads;
    double best = low + 0.5 * size, most = -kInfinity;
    for (int n = 0; n < 9; ++n) {
        // From the middle outwards, avoiding round fractions of the extent, where walls often stand.
        const int step = (n + 1) / 2;
        const double at = low + (0.487 + (n % 2 == 0 ? 1 : -1) * spread * step) * size;
        const auto drawing =
            drawSection(volume, {along * (axis == 1 ? -1.0 : 1.0), volume.grid.origin() + along * at}, options);
        if (!drawing) return drawing.error();
        // Without rooms, the plane that cuts most of the buildings wins.
        double score = 0;
        for (const SectionComponent& component : drawing->components) {
            const volume::Label& label = volume.labels.labels[component.label];
            if (isRoomSpace(label))
                score += component.area + 2;
            else if (!model::isSpace(label.className))
                score += hasRooms ? -component.area : component.area + component.lineLength;
        }
        if (drawing->edgesInPlane > 0) score -= 1;
        if (score > most + 0.5) {
            best = at;
            most = score;
        }
    }
    return best;
}

}  // namespace

Result<SheetViews> chooseSheetViews(const volume::SemanticVolume& volume, int threads) {
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
    Box3d all;
    std::optional<Box3d> stair;
    const std::vector<LabelExtent> extents = labelExtents(volume);
    for (std::size_t l = 0; l < extents.size(); ++l) {
        const volume::Label& label = volume.labels.labels[l];
        const Box3d& box = extents[l].box;
        if (model::classRank(label.className) == model::ClassRank::Other) continue;  // terrain
        all.add(box);
        if (!box.isEmpty() && box.size().z > kLowestRoom && isStair(label) && !stair) stair = box;
    }
    if (all.isEmpty()) {
        all.add(Vec3d{});
        all.add(scaled(toDouble(grid.dimension()), grid.spacing()));
    }
    // A-A along the shorter side, so that it cuts the ridge of most roofs.
    const int first = all.size().x >= all.size().y ? 0 : 1;
    for (int n = 0; n < 2; ++n) {
        const int axis = n == 0 ? first : 1 - first;
        SVT_TRY(at, placeOfSection(volume, axis, all, stair, threads));
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
