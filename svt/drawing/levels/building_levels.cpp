#include <svt/drawing/building_levels.hpp>

#include <svt/drawing/levels/ground_floor.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kLeastSlabArea = 4;  // m2: smaller ones are landings
constexpr double kThickestFloor = 1;  // metres: thicker ones slope, or are foundations
constexpr double kSameHeight = 0.01;  // metres
constexpr double kSmallPart = 0.2;    // of the area of a level, up to which a room that begins elsewhere belongs to it

// A floor without a storey, and the height to which its room reaches.
struct LooseFloor {
    FloorHeight floor;
    double top = -kInfinity;
};

// Levels from floors: the one with most area first, then those of the floors that it does not take.
std::vector<BuildingLevel> levelsOfFloors(std::vector<LooseFloor> floors) {
    std::sort(floors.begin(), floors.end(), [](const LooseFloor& a, const LooseFloor& b) {
        return std::tie(a.floor.at, a.floor.area) < std::tie(b.floor.at, b.floor.area);
    });
    std::vector<BuildingLevel> levels;
    while (!floors.empty()) {
        std::vector<FloorHeight> heights;
        for (const LooseFloor& floor : floors) heights.push_back(floor.floor);
        const FloorHeight main = *mainFloor(heights, -kInfinity, kInfinity);
        levels.push_back({"", main.at, main.bound});
        std::erase_if(floors, [&](const LooseFloor& floor) {
            if (std::abs(floor.floor.at - main.at) < kSameStorey) return true;
            const double cut = main.at + kCutAboveFloor;
            return floor.floor.at < cut && floor.top > cut && floor.floor.area < kSmallPart * main.area;
        });
    }
    std::sort(levels.begin(), levels.end(), [](const auto& a, const auto& b) { return a.floor < b.floor; });
    return levels;
}

std::vector<BuildingLevel> levelsOfRooms(const volume::SemanticVolume& volume,
                                         const std::vector<LabelExtent>& extents) {
    std::vector<LooseFloor> floors;
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (isRoomOfSize(volume.labels.labels[l], extents[l]))
            floors.push_back({{extents[l].floor, extents[l].floorArea, extents[l].bound}, extents[l].box.max.z});
    std::vector<BuildingLevel> levels = levelsOfFloors(std::move(floors));
    for (BuildingLevel& level : levels) level.hasRooms = true;
    return levels;
}

std::vector<BuildingLevel> levelsOfSlabs(const volume::SemanticVolume& volume,
                                         const std::vector<LabelExtent>& extents) {
    std::vector<LooseFloor> tops;
    for (std::size_t l = 0; l < extents.size(); ++l) {
        const Box3d& box = extents[l].box;
        const Vec3d size = box.size();
        if (box.isEmpty() || !isFloorSlab(volume.labels.labels[l]) || size.z > kThickestFloor) continue;
        if (size.x * size.y >= kLeastSlabArea) tops.push_back({{box.max.z, size.x * size.y, extents[l].bound}});
    }
    std::vector<BuildingLevel> levels = levelsOfFloors(std::move(tops));
    // The highest level is a flat roof if nothing stands on it.
    double highest = -kInfinity;
    for (const LabelExtent& extent : extents) highest = std::max(highest, extent.box.max.z);
    while (levels.size() > 1 && highest - levels.back().floor < kLowestRoom) levels.pop_back();
    return levels;
}

// The building of a storey: the nearest label above that is not a storey.
std::uint32_t buildingOf(std::uint32_t storey, const volume::LabelTable& table,
                         const std::vector<std::uint32_t>& storeyOf) {
    std::uint32_t above = table.labels[storey].parent;
    while (above != volume::kNoLabel && storeyOf[above] == above) above = table.labels[above].parent;
    return above;
}

// Whether the rooms of a storey may stand on several floors.
bool isTall(const StoreyHeights& storey) {
    return storey.roomArea > 0 &&
           (storey.top - storey.floor > kSameStorey + kLowestRoom || storey.floor - storey.low > kSameStorey);
}

// The floor area of the rooms at about the height of a level.
double areaNear(const std::vector<LooseFloor>& rooms, double height) {
    double area = 0;
    for (const LooseFloor& room : rooms)
        if (std::abs(room.floor.at - height) < kSameStorey) area += room.floor.area;
    return area;
}

// Adds levels for the rooms of a storey that its plan does not cut: authors of small models put all floors into one
// storey. The plan of another level can cut them. Small ones, such as voids above a ceiling, have no level.
void addFloorsOfStoreys(const volume::SemanticVolume& volume, std::vector<BuildingLevel>& levels) {
    const std::vector<LabelExtent> extents = labelExtents(volume);
    const std::vector<std::uint32_t> storeyOf = storeysOfLabels(volume.labels);
    std::map<std::uint32_t, std::vector<LooseFloor>> roomsOf;  // by storey
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (storeyOf[l] != volume::kNoLabel && isRoomOfSize(volume.labels.labels[l], extents[l]))
            roomsOf[storeyOf[l]].push_back(
                {{extents[l].floor, extents[l].floorArea, extents[l].bound}, extents[l].box.max.z});
    const std::size_t count = levels.size();
    for (std::size_t n = 0; n < count; ++n) {
        std::vector<LooseFloor> rooms;
        for (const std::uint32_t storey : levels[n].storeys)
            rooms.insert(rooms.end(), roomsOf[storey].begin(), roomsOf[storey].end());
        const double least = kSmallPart * areaNear(rooms, levels[n].floor), cut = levels[n].floor + kCutAboveFloor;
        std::vector<LooseFloor> uncut = rooms;
        std::erase_if(uncut, [&](const LooseFloor& room) { return room.floor.at < cut && room.top > cut; });
        for (BuildingLevel& added : levelsOfFloors(std::move(uncut))) {
            const bool isCutElsewhere = std::any_of(levels.begin(), levels.end(), [&](const BuildingLevel& other) {
                return std::abs(other.floor - added.floor) < kSameStorey;
            });
            if (isCutElsewhere || areaNear(rooms, added.floor) < least) continue;
            added.name = levels[n].name;
            added.storeys = levels[n].storeys;
            added.hasRooms = true;
            levels.push_back(std::move(added));
        }
    }
    std::stable_sort(levels.begin(), levels.end(), [](const auto& a, const auto& b) { return a.floor < b.floor; });
}

std::vector<BuildingLevel> levelsOfStoreys(const volume::SemanticVolume& volume, std::vector<StoreyHeights> storeys) {
    // Without rooms, foundations do not give name and height to the floor above them.
    const auto isFoundation = [&](const StoreyHeights& storey) {
        return isNamedBelowGround(volume.labels.labels[storey.label].name);
    };
    std::stable_sort(storeys.begin(), storeys.end(), [&](const StoreyHeights& a, const StoreyHeights& b) {
        return std::tuple(-a.roomArea, isFoundation(a), b.features, a.floor) <
               std::tuple(-b.roomArea, isFoundation(b), a.features, b.floor);
    });
    const std::vector<std::uint32_t> storeyOf = storeysOfLabels(volume.labels);
    struct Group {
        StoreyHeights main;
        std::uint32_t building;
        std::vector<std::uint32_t> storeys;
    };
    std::vector<Group> groups;
    for (const StoreyHeights& storey : storeys) {
        const std::uint32_t building = buildingOf(storey.label, volume.labels, storeyOf);
        Group* nearest = nullptr;
        for (Group& group : groups) {
            const bool areRooms = storey.roomArea > 0 && group.main.roomArea > 0 && building == group.building;
            const double away = std::abs(storey.floor - group.main.floor);
            if (away >= (areRooms ? kFloorBuildUp : kSameStorey)) continue;
            if (nearest == nullptr || away < std::abs(storey.floor - nearest->main.floor)) nearest = &group;
        }
        if (nearest == nullptr) nearest = &groups.emplace_back(Group{storey, building, {}});
        nearest->storeys.push_back(storey.label);
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.main.floor < b.main.floor; });
    const double uncertainty = volume.vectors.triangles.empty() ? volume.grid.spacing().z : kSameHeight;
    std::vector<BuildingLevel> levels;
    for (Group& group : groups) {
        BuildingLevel& level = levels.emplace_back();
        level.name = volume.labels.labels[group.main.label].name;
        level.floor = group.main.floor;
        level.bound = group.main.bound;
        level.storeys = std::move(group.storeys);
        level.hasRooms = group.main.roomArea > 0;
        const std::optional<double> rooms = group.main.measured;
        if (level.hasRooms && rooms && std::abs(*rooms - level.floor) > uncertainty) level.roomFloor = rooms;
    }
    if (std::any_of(storeys.begin(), storeys.end(), isTall)) addFloorsOfStoreys(volume, levels);
    return levels;
}

std::string partsOf(FloorSource source) {
    switch (source) {
        case FloorSource::Rooms: return "most of its rooms stand";
        case FloorSource::Slabs: return "most of its slabs end";
        case FloorSource::Walls: return "most of its walls begin";
        case FloorSource::Declared:
        case FloorSource::Lowest: break;
    }
    return "its components begin";
}

// Reports storeys with rooms on several floors, each of which has a level.
template <class InModel>
void reportSeveralFloors(const volume::SemanticVolume& volume, const InModel& inModel, Diagnostics& log) {
    std::map<std::uint32_t, std::vector<std::string>> floorsOf;  // by storey
    for (const BuildingLevel& level : findLevels(volume))
        for (const std::uint32_t storey : level.storeys)
            floorsOf[storey].push_back(fmt::format("{:.2f} m", inModel(level.floor)));
    for (const auto& [storey, floors] : floorsOf) {
        if (floors.size() < 2) continue;
        const volume::Label& label = volume.labels.labels[storey];
        log.add(
            Severity::Warning, Code::StoreyLevelDiffers,
            fmt::format("the rooms of the storey '{}' stand on {} floors, at {}; each has a plan; make a storey for "
                        "each",
                        label.name.empty() ? label.id : label.name, floors.size(), fmt::join(floors, ", ")),
            {volume.source, 0, 0, label.id});
    }
}

}  // namespace

std::vector<BuildingLevel> findLevels(const volume::SemanticVolume& volume) {
    std::vector<StoreyHeights> storeys = findStoreys(volume);
    std::vector<BuildingLevel> levels;
    if (!storeys.empty()) {
        levels = levelsOfStoreys(volume, std::move(storeys));
    } else {
        const std::vector<LabelExtent> extents = labelExtents(volume);
        levels = levelsOfRooms(volume, extents);
        if (levels.empty()) levels = levelsOfSlabs(volume, extents);
    }
    if (!levels.empty()) levels[groundFloorOf(levels, volume)].isGround = true;
    return levels;
}

double zeroLevel(std::span<const BuildingLevel> levels) noexcept {
    for (const BuildingLevel& level : levels)
        if (level.isGround) return level.floor;
    return levels.empty() ? 0 : levels.front().floor;
}

std::vector<std::size_t> levelsOfLabels(const volume::SemanticVolume& volume, std::span<const BuildingLevel> levels,
                                        std::span<const LabelExtent> extents) {
    std::vector<std::size_t> found(volume.labels.labels.size(), 0);
    if (levels.empty()) return found;
    std::map<std::uint32_t, std::vector<std::size_t>> levelsOf;  // by storey, from the lowest
    for (std::size_t n = 0; n < levels.size(); ++n)
        for (const std::uint32_t storey : levels[n].storeys) levelsOf[storey].push_back(n);
    const std::vector<std::uint32_t> storeys = storeysOfLabels(volume.labels);
    for (std::size_t l = 0; l < found.size(); ++l) {
        if (const auto own = levelsOf.find(storeys[l]); own != levelsOf.end()) {
            for (const std::size_t n : own->second)
                if (n == own->second.front() || levels[n].floor <= extents[l].floor + kFloorBuildUp) found[l] = n;
            continue;
        }
        const double floor = extents[l].floor, top = extents[l].box.max.z;
        std::size_t at = 0;
        while (at + 1 < levels.size() && levels[at + 1].floor <= floor + kFloorBuildUp) ++at;
        const bool reachesNext = at + 1 < levels.size() && levels[at + 1].floor + kCutAboveFloor < top;
        if (reachesNext && levels[at + 1].floor - floor < floor - levels[at].floor) ++at;
        found[l] = at;
    }
    return found;
}

void reportStoreys(const volume::SemanticVolume& volume, Diagnostics& log) {
    const double corner = dot(volume.grid.origin(), volume.grid.axes()[2]);
    // In centimetres, never "-0.00".
    const auto inModel = [&](double height) { return std::round((height + corner) * 100) / 100 + 0.0; };
    for (const StoreyHeights& storey : findStoreys(volume)) {
        if (!storey.disagrees()) continue;
        const volume::Label& label = volume.labels.labels[storey.label];
        log.add(Severity::Warning, Code::StoreyLevelDiffers,
                fmt::format("the storey '{0}' declares the level {1:.2f} m, but {2} at {3:.2f} m; plans, sections and "
                            "areas use {3:.2f} m; correct the elevation or the placement of the storey",
                            label.name.empty() ? label.id : label.name, inModel(*storey.declared),
                            partsOf(storey.source), inModel(storey.floor)),
                {volume.source, 0, 0, label.id});
    }
    reportSeveralFloors(volume, inModel, log);
}

}  // namespace svt::drawing
