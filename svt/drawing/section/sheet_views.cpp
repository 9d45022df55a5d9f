#include <svt/drawing/sheet_views.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace svt::drawing {
namespace {

constexpr double kCutHeight = 1.1;    // metres above the floor
constexpr double kLeastRoom = 1.5;    // metres: lower spaces are voids
constexpr double kSameLevel = 1.2;    // metres
constexpr double kLeastSlabArea = 4;  // m2: smaller ones are landings
constexpr double kThickestSlab = 1;   // metres

bool isRoom(const volume::Label& label) {
    return model::isSpace(label.className) && model::classRank(label.className) == model::ClassRank::Room;
}

// Whether a component is a stair by its class, type or name; the door of a stairwell is not a stair.
bool isStair(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    if (rank != model::ClassRank::Installation && rank != model::ClassRank::Element) return false;
    if (model::isBoundarySurface(label.className)) return false;
    std::string words = label.className + " " + label.name;
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == "ifcType" || attribute.name == "function")
            if (const auto* text = std::get_if<std::string>(&attribute.value)) words += " " + *text;
    for (char& c : words) c = lowerAscii(c);
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
                                      [](const volume::Label& label) { return label.count > 0 && isRoom(label); });
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
            if (isRoom(label))
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

// Whether a component is a slab by class or IFC type, or a floor that is a surface. Roof slabs do not count.
bool isSlab(const volume::Label& label) {
    if (label.className == "FloorSurface") return true;
    std::string type, words = label.name;
    for (const Attribute& attribute : label.attributes)
        if (const auto* text = std::get_if<std::string>(&attribute.value)) {
            if (attribute.name == "ifcType" || attribute.name == "function") type += " " + *text;
            if (attribute.name == "predefinedType" || attribute.name == "PredefinedType") words += " " + *text;
        }
    for (char& c : type) c = lowerAscii(c);
    for (char& c : words) c = lowerAscii(c);
    const auto has = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
    if (has(words, "roof") || has(words, "dach")) return false;
    return has(type, "slab") || has(type, "floor");
}

// Levels from floors, each at the height of most of its area.
std::vector<BuildingLevel> levelsOf(const std::vector<FloorHeight>& floors) {
    std::vector<BuildingLevel> levels;
    for (const FloorHeight& floor : floors) {
        if (!levels.empty() && floor.at - levels.back().floor < kSameLevel) continue;
        const FloorHeight main = *mainFloor(floors, floor.at, floor.at + kSameLevel);
        levels.push_back({"", main.at, main.bound});
    }
    return levels;
}

std::vector<BuildingLevel> levelsOfSlabs(const volume::SemanticVolume& volume,
                                         const std::vector<LabelExtent>& extents) {
    std::vector<FloorHeight> tops;
    for (std::size_t l = 0; l < extents.size(); ++l) {
        const Box3d& box = extents[l].box;
        const Vec3d size = box.size();
        // Thicker components are not slabs, or slope.
        if (box.isEmpty() || !isSlab(volume.labels.labels[l]) || size.z > kThickestSlab) continue;
        if (size.x * size.y >= kLeastSlabArea) tops.push_back({box.max.z, size.x * size.y, extents[l].bound});
    }
    std::sort(tops.begin(), tops.end(), [](const FloorHeight& a, const FloorHeight& b) {
        return std::tie(a.at, a.area) < std::tie(b.at, b.area);
    });
    std::vector<BuildingLevel> levels = levelsOf(tops);
    // The highest level is a flat roof if nothing stands on it.
    double highest = -kInfinity;
    for (const LabelExtent& extent : extents) highest = std::max(highest, extent.box.max.z);
    while (levels.size() > 1 && highest - levels.back().floor < kLeastRoom) levels.pop_back();
    return levels;
}

}  // namespace

std::vector<BuildingLevel> findLevels(const volume::SemanticVolume& volume) {
    std::vector<BuildingLevel> levels;
    for (const StoreyHeights& storey : findStoreys(volume))
        // Storeys of several buildings or parts may share a floor.
        if (levels.empty() || storey.floor - levels.back().floor >= kSameLevel)
            levels.push_back({volume.labels.labels[storey.label].name, storey.floor, storey.bound});
    if (!levels.empty()) return levels;
    const std::vector<LabelExtent> extents = labelExtents(volume);
    levels = levelsOf(roomFloors(volume, extents));
    return levels.empty() ? levelsOfSlabs(volume, extents) : levels;
}

Result<SheetViews> chooseSheetViews(const volume::SemanticVolume& volume, int threads) {
    SheetViews chosen;
    chosen.levels = findLevels(volume);
    const volume::Grid& grid = volume.grid;
    const Vec3d up = grid.axes()[2];
    for (const BuildingLevel& level : chosen.levels) {
        const SectionPlane plane{up, grid.origin() + up * (level.floor + kCutHeight), level.bound};
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
        if (!box.isEmpty() && box.size().z > kLeastRoom && isStair(label) && !stair) stair = box;
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
    for (const char* side : {"north", "east", "south", "west"}) {
        SVT_TRY(plane, elevationPlane(side, volume));
        chosen.views.push_back({ViewKind::Elevation, side, *plane, 0, {.visible = true}});
    }
    return chosen;
}

}  // namespace svt::drawing
