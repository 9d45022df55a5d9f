#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/analyze/space_boundaries.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/areas/covered_area.hpp>
#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/drawing/room_floor_areas.hpp>
#include <svt/drawing/side_by_side.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kLeastRoomHeight = 1.5;  // metres: lower spaces are voids
constexpr double kSameFloor = 0.01;       // metres
constexpr double kBelowSills = 0.15;      // metres above the floor: below the sills of windows
constexpr double kBelowCeiling = 0.1;     // metres: above the heads of doors and windows

constexpr std::string_view kTechnical[] = {"technik", "technical",  "heizung",     "boiler",   "plant room",
                                           "server",  "hausanschl", "mechanical",  "electric", "elektro",
                                           "lüftung", "luftung",    "machine room"};
constexpr std::string_view kTraffic[] = {"flur",     "diele",       "treppe",    "korridor", "corridor", "eingang",
                                         "foyer",    "stair",       "lobby",     "aufzug",   "elevator", "vestibul",
                                         "windfang", "circulation", "hallway",   "passage",  "entrance", "landing",
                                         "rampe",    "schleuse",    "laubengang"};
constexpr std::string_view kUse[] = {
    "living",    "wohn",   "schlaf",   "bed",     "kitchen",  "küche",   "kueche",     "bath",    "toilet",
    "office",    "büro",   "buero",    "study",   "storage",  "store",   "lager",      "abstell", "keller",
    "cellar",    "garage", "dining",   "kind",    "child",    "arbeit",  "zimmer",     "galerie", "gallery",
    "class",     "sanit",  "umkleide", "utility", "hauswirt", "meeting", "besprech",   "laundry", "workshop",
    "werkstatt", "shop",   "laden",    "lounge",  "closet",   "pantry",  "laboratory", "labor",   "conference",
    "archiv",    "gast",   "guest",    "archive"};
// Whole words only.
constexpr std::string_view kTrafficWords[] = {"hall", "gang", "lift", "vf"};
constexpr std::string_view kTechnicalWords[] = {"tf", "hvac"};
constexpr std::string_view kUseWords[] = {"bad", "wc", "essen", "flat", "room", "raum", "nuf", "halle"};

bool isWordPart(char c) noexcept { return isLetter(c) || isDigit(c) || (c & 0x80) != 0; }

bool hasAny(std::string_view text, std::span<const std::string_view> parts, std::span<const std::string_view> words) {
    for (const std::string_view part : parts)
        if (text.find(part) != std::string_view::npos) return true;
    for (const std::string_view word : words)
        for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
            const std::size_t end = at + word.size();
            if ((at == 0 || !isWordPart(text[at - 1])) && (end == text.size() || !isWordPart(text[end]))) return true;
        }
    return false;
}

const std::string* attributeText(const volume::Label& label, std::string_view name) noexcept {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name) return std::get_if<std::string>(&attribute.value);
    return nullptr;
}

// The type of IFC, else the function of a component of no class in particular, if it is a word: not "31001_1000".
std::string typeOrFunction(const volume::Label& label) {
    if (const std::string* type = attributeText(label, "ifcType")) return *type;
    const bool isAnyClass =
        label.className == "BuildingConstructiveElement" || label.className == "BuildingInstallation";
    const std::string* function = isAnyClass ? attributeText(label, "function") : nullptr;
    const bool isWord = function != nullptr && function->size() <= 40 &&
                        std::all_of(function->begin(), function->end(), [](char c) { return isLetter(c) || c == ' '; });
    return isWord ? *function : std::string();
}

// Whether a space is the hollow of a roof by its name, which does not count as a floor.
bool isRoofSpace(const volume::Label& label) {
    constexpr std::string_view kNames[] = {"roof", "roof space", "roofspace", "dach", "dachraum", "spitzboden"};
    return std::find(std::begin(kNames), std::end(kNames), lowerAscii(label.name)) != std::end(kNames);
}

// A space outdoors, such as a terrace.
bool isExternal(const volume::Label& label) {
    const std::string* type = attributeText(label, "predefinedType");
    return type != nullptr && *type == "EXTERNAL";
}

bool isMeasuredRoom(const volume::Label& label) {
    return label.count > 0 && isRoomSpace(label) && !isRoofSpace(label) && !isExternal(label);
}

// Sums over the triangles of each label.
struct MeshSum {
    Vec3d largest{};  // twice the area times the normal of the largest triangle
    double seen = 0;  // m2, see ComponentSum::area
};

std::vector<MeshSum> sumMeshes(const volume::SemanticVolume& volume) {
    std::vector<MeshSum> sums(volume.labels.labels.size());
    const auto crossOf = [&](const volume::VectorParts::Triangle& t) {
        const Vec3d a = volume.vectors.position(t.corners[0], {});
        return cross(volume.vectors.position(t.corners[1], {}) - a, volume.vectors.position(t.corners[2], {}) - a);
    };
    for (const auto& triangle : volume.vectors.triangles) {
        MeshSum& sum = sums[triangle.label];
        const Vec3d twice = crossOf(triangle);
        if (dot(twice, twice) > dot(sum.largest, sum.largest)) sum.largest = twice;
    }
    for (const auto& triangle : volume.vectors.triangles) {
        MeshSum& sum = sums[triangle.label];
        if (dot(sum.largest, sum.largest) > 0)
            sum.seen += 0.5 * std::abs(dot(crossOf(triangle), normalized(sum.largest)));
    }
    return sums;
}

class AreaMaker {
public:
    AreaMaker(const volume::SemanticVolume& volume, const std::vector<BuildingLevel>& levels, int threads,
              const DrawingTables& tables)
        : volume_(volume),
          levels_(levels),
          threads_(threads),
          tables_(tables),
          meshes_(sumMeshes(volume)),
          roomAreas_(tables.roomAreas()),
          spaces_(analyze::spacesOfLabels(volume.labels)),
          extents_(labelExtents(volume)),
          levelOf_(levelsOfLabels(volume, levels, extents_)) {}

    Result<FloorAreas> run() {
        areas_.levels.resize(levels_.size());
        findCeilings();
        SVT_DO(cutLevels());
        SVT_DO(addRooms());
        SVT_DO(countRooms());
        addComponents();
        return std::move(areas_);
    }

private:
    // The height below which most of the rooms of each level end.
    void findCeilings() {
        ceilings_.assign(levels_.size(), -kInfinity);
        std::vector<std::vector<FloorHeight>> tops(levels_.size());
        if (levels_.empty()) return;
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l)
            if (isMeasuredRoom(volume_.labels.labels[l]) && isRoomOfSize(volume_.labels.labels[l], extents_[l]))
                tops[levelOf_[l]].push_back({extents_[l].box.max.z, extents_[l].floorArea, extents_[l].bound});
        for (std::size_t n = 0; n < levels_.size(); ++n) {
            std::sort(tops[n].begin(), tops[n].end(),
                      [](const FloorHeight& a, const FloorHeight& b) { return a.at < b.at; });
            if (const auto main = mainFloor(tops[n], -kInfinity, kInfinity)) ceilings_[n] = main->at;
        }
    }

    Result<SectionDrawing> cutAt(double height, int threads) const {
        const Vec3d up = volume_.grid.axes()[2];
        const SectionPlane plane{up, volume_.grid.origin() + up * height};
        SectionOptions options;
        options.threads = threads;
        options.tables = &tables_;
        if (!meetsGrid(plane, volume_.grid)) return SectionDrawing{};
        return drawSection(volume_, plane, options);
    }

    // Measures the area that each level encloses, and the area of each label at its level.
    Result<void> cutLevels() {
        areasAt_.resize(levels_.size());
        std::vector<Result<void>> cut(levels_.size());
        drawSideBySide(levels_.size(), threads_, [&](std::size_t n, int threads) { cut[n] = cutLevel(n, threads); });
        for (const Result<void>& level : cut) SVT_DO(level);
        return {};
    }

    Result<void> cutLevel(std::size_t n, int threads) {
        const double floor = levels_[n].roomFloor.value_or(levels_[n].floor);
        LevelArea& level = areas_.levels[n];
        level.isExact = levels_[n].bound == 0;
        SVT_TRY(drawing, cutAt(floor + kBelowSills, threads));
        CoveredArea covered;
        for (const SectionComponent& component : drawing->components) {
            const volume::Label& label = volume_.labels.labels[component.label];
            if (model::classRank(label.className) == model::ClassRank::Other) continue;
            addTo(level, component);
            level.gross += component.area;
            level.isGrossKnown = level.isGrossKnown || !model::isSpace(label.className);
            areasAt_[n].emplace_back(component.label, component.area);
            covered.add(component, *drawing);
        }
        return closeOpenings(n, floor, *drawing, covered, threads);
    }

    static void addTo(LevelArea& level, const SectionComponent& component) {
        level.grossBound += component.areaBound;
        level.isExact = level.isExact && component.isExact;
    }

    // Adds the openings of walls to the gross area. Below the ceiling, above doors and windows, a wall is whole.
    Result<void> closeOpenings(std::size_t n, double floor, const SectionDrawing& plan, CoveredArea& covered,
                               int threads) {
        const double height = ceilings_[n] - kBelowCeiling;
        if (!(height > floor + kBelowSills)) return {};
        SVT_TRY(above, cutAt(height, threads));
        bool hasWalls = false;
        for (const SectionComponent& component : above->components) {
            const bool isCut = areaAt(n, component.label) > 0;
            if (!isCut || !isWallPart(volume_.labels.labels[component.label])) continue;
            covered.add(component, *above);
            addTo(areas_.levels[n], component);
            hasWalls = true;
        }
        if (!hasWalls || plan.components.empty()) return {};
        if (const auto area = covered.get()) areas_.levels[n].gross = std::max(areas_.levels[n].gross, *area);
        return {};
    }

    // The area of a label at its level's cut, m2; 0 if it is not cut there.
    [[nodiscard]] double areaAt(std::size_t level, std::uint32_t label) const noexcept {
        const auto& areas = areasAt_[level];
        const auto found = std::lower_bound(areas.begin(), areas.end(), label,
                                            [](const auto& area, std::uint32_t l) { return area.first < l; });
        return found != areas.end() && found->first == label ? found->second : 0;
    }

    // The area of a room without a closed mesh: at the cut of its level, or above its own floor if that is elsewhere. Furniture
    // and sheets in the room take voxels from it, but no floor.
    Result<double> cutArea(const RoomArea& room, const LabelExtent& extent) const {
        const BuildingLevel& level = levels_[room.level];
        const double floor = level.roomFloor.value_or(level.floor);
        double sum = 0;
        if (std::abs(extent.floor - floor) <= kSameFloor + extent.bound)
            for (const auto& [label, area] : areasAt_[room.level]) sum += spaces_[label] == room.label ? area : 0;
        if (sum > 0) return sum;
        SVT_TRY(drawing, cutAt(extent.floor + kBelowSills, threads_));
        for (const SectionComponent& component : drawing->components)
            if (spaces_[component.label] == room.label) sum += component.area;
        return sum;
    }

    Result<void> addRooms() {
        if (levels_.empty()) return {};
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l) {
            const volume::Label& label = volume_.labels.labels[l];
            if (!isMeasuredRoom(label)) continue;
            RoomArea room;
            room.label = l;
            room.name = label.name.empty() ? label.id : label.name;
            if (const std::string* number = attributeText(label, "number")) room.number = *number;
            room.use = roomUseOf(label);
            room.volume = label.volume;
            const LabelExtent& extent = extents_[l];
            if (extent.box.isEmpty()) continue;
            room.height = extent.box.size().z;
            if (room.height < kLeastRoomHeight) continue;
            room.level = levelOf_[l];
            room.isExact = extent.bound == 0 && roomAreas_[l];
            SVT_TRY(area, room.isExact ? Result<double>(*roomAreas_[l]) : cutArea(room, extent));
            room.area = *area;
            room.stated = statedFloorArea(label);
            room.isZone = tables_.roomShares()[l].isZone;
            room.isShared = tables_.roomShares()[l].isShared;
            areas_.rooms.push_back(std::move(room));
        }
        std::sort(areas_.rooms.begin(), areas_.rooms.end(), [](const RoomArea& a, const RoomArea& b) {
            return std::tie(a.level, a.number, a.name, a.label) < std::tie(b.level, b.number, b.name, b.label);
        });
        return {};
    }

    // The sums of the levels. Rooms that share space count with their area in a section of all rooms.
    Result<void> countRooms() {
        std::optional<volume::SemanticVolume> solidRooms;  // made when needed
        std::map<std::int64_t, SectionDrawing> sections;   // by millimetres
        for (RoomArea& room : areas_.rooms) {
            const double own = room.isZone ? 0 : tables_.roomShares()[room.label].own;
            room.countedVolume = room.volume * own;
            room.countedArea = room.isShared ? room.area * own : room.area;
            if (room.isZone) room.unclaimedArea = room.area * tables_.roomShares()[room.label].own;
            if (room.isShared && !room.isZone && room.isExact) {
                if (!solidRooms) solidRooms = keepRooms();
                SVT_TRY(area, ownArea(room, *solidRooms, sections));
                room.countedArea = std::min(*area, room.area);
            }
            addToLevel(room);
        }
        for (LevelArea& level : areas_.levels) level.construction = level.gross - level.net;
        return {};
    }

    // Rooms with a closed mesh, without zones.
    [[nodiscard]] volume::SemanticVolume keepRooms() const {
        std::vector<char> isKept(volume_.labels.labels.size(), 0);
        for (const RoomArea& room : areas_.rooms) isKept[room.label] = room.isExact && !room.isZone;
        return analyze::keepLabels(volume_, isKept);
    }

    // The area of a room in a section above its floor that cuts only rooms.
    Result<double> ownArea(const RoomArea& room, const volume::SemanticVolume& rooms,
                           std::map<std::int64_t, SectionDrawing>& sections) const {
        const double height = extents_[room.label].floor + kBelowSills;
        const std::int64_t key = std::llround(height * 1000);
        auto known = sections.find(key);
        if (known == sections.end()) {
            const Vec3d up = rooms.grid.axes()[2];
            SectionOptions options;
            options.threads = threads_;
            SVT_TRY(drawing, drawSection(rooms, {up, rooms.grid.origin() + up * height}, options));
            known = sections.emplace(key, std::move(*drawing)).first;
        }
        for (const SectionComponent& component : known->second.components)
            if (component.label == room.label) return component.area;
        return 0.0;
    }

    void addToLevel(const RoomArea& room) {
        LevelArea& level = areas_.levels[room.level];
        if (room.isZone) return;
        ++level.rooms;
        level.isFloor = true;
        level.isExact = level.isExact && room.isExact;
        level.net += room.countedArea;
        (room.use == RoomUse::Use         ? level.use
         : room.use == RoomUse::Technical ? level.technical
         : room.use == RoomUse::Traffic   ? level.traffic
                                          : level.unknown) += room.countedArea;
    }

    void addComponents() {
        std::map<std::pair<std::string, std::string>, ComponentSum> sums;
        const auto& labels = volume_.labels.labels;
        std::vector<char> isCounted(labels.size(), 0);
        for (std::uint32_t l = 0; l < labels.size(); ++l) {
            const volume::Label& label = labels[l];
            // A pane or a frame belongs to its window.
            const bool isPart = model::isPhase(label.className) && label.parent < labels.size();
            const std::uint32_t object = isPart ? label.parent : l;
            const volume::Label& owner = labels[object];
            if (label.count == 0 || model::isSpace(owner.className) || owner.className == "Annotation") continue;
            std::string type = typeOrFunction(owner);
            ComponentSum& sum = sums[{owner.className, type}];
            sum.className = owner.className;
            sum.type = std::move(type);
            sum.count += std::exchange(isCounted[object], 1) == 0;
            sum.area += volume::hasClosedMesh(label.filling) ? 0.5 * meshes_[l].seen : meshes_[l].seen;
            sum.volume += label.volume;
        }
        for (auto& [key, sum] : sums) areas_.components.push_back(std::move(sum));
    }

    const volume::SemanticVolume& volume_;
    const std::vector<BuildingLevel>& levels_;
    int threads_;
    const DrawingTables& tables_;
    std::vector<MeshSum> meshes_;                          // by label
    const std::vector<std::optional<double>>& roomAreas_;  // by label
    std::vector<std::uint32_t> spaces_;                    // of each label, see analyze::spacesOfLabels()
    std::vector<LabelExtent> extents_;                     // by label
    std::vector<std::size_t> levelOf_;                     // by label
    std::vector<double> ceilings_;                         // by level, metres above the grid's lower corner
    std::vector<std::vector<std::pair<std::uint32_t, double>>> areasAt_;  // by level, label; m2
    FloorAreas areas_;
};

std::string levelName(const BuildingLevel& level, const volume::SemanticVolume& volume) {
    if (!level.name.empty()) return fmt::format("'{}'", level.name);
    return fmt::format("{:.2f} m", level.floor + dot(volume.grid.origin(), volume.grid.axes()[2]));
}

// The names of rooms, each once: "'Flat 1', 'Flat 2' and 3 others".
std::string namesOf(const std::vector<const RoomArea*>& rooms) {
    constexpr std::size_t kMostNames = 5;
    std::vector<std::string> names;
    for (const RoomArea* room : rooms)
        if (std::find(names.begin(), names.end(), room->name) == names.end()) names.push_back(room->name);
    const std::size_t others = names.size() > kMostNames ? names.size() - kMostNames : 0;
    names.resize(names.size() - others);
    const std::string text = fmt::format("'{}'", fmt::join(names, "', '"));
    return others == 0 ? text : fmt::format("{} and {} others", text, others);
}

// Reports the zones of a level, and the rooms that share space, with the area that does not count.
void reportShared(const FloorAreas& areas, std::size_t level, const std::string& name,
                  const volume::SemanticVolume& volume, Diagnostics& log) {
    std::vector<const RoomArea*> zones, overlapping;
    double shared = 0, unclaimed = 0;
    for (const RoomArea& room : areas.rooms) {
        if (room.level != level || !room.isShared) continue;
        (room.isZone ? zones : overlapping).push_back(&room);
        if (!room.isZone) shared += room.area - room.countedArea;
        unclaimed += room.unclaimedArea;
    }
    const auto report = [&](const std::string& text) {
        log.add(Severity::Warning, Code::RoomsShareSpace, text, {volume.source, 0, 0, {}});
    };
    if (!zones.empty())
        report(
            fmt::format("the level {} has zones that consist mostly of other rooms: {}; they do not count in sums "
                        "and have no stamps. No other room covers about {:.1f} m2 of their floor",
                        name, namesOf(zones), unclaimed));
    if (!overlapping.empty())
        report(fmt::format("the level {} has rooms that overlap smaller ones by {:.2f} m2, which count once: {}", name,
                           shared, namesOf(overlapping)));
}

}  // namespace

std::string_view roomUseName(RoomUse use) noexcept {
    switch (use) {
        case RoomUse::Use: return "NUF";
        case RoomUse::Technical: return "TF";
        case RoomUse::Traffic: return "VF";
        case RoomUse::Unknown: break;
    }
    return "";
}

RoomUse roomUseOf(const volume::Label& label) {
    std::string words = label.name;
    for (const std::string_view name : {"longName", "function", "usage", "class", "type"})
        if (const std::string* text = attributeText(label, name)) words += " " + *text;
    for (char& c : words) c = lowerAscii(c);
    if (hasAny(words, kTechnical, kTechnicalWords)) return RoomUse::Technical;
    if (hasAny(words, kTraffic, kTrafficWords)) return RoomUse::Traffic;
    if (hasAny(words, kUse, kUseWords)) return RoomUse::Use;
    return RoomUse::Unknown;
}

bool LevelArea::netExceedsGross() const noexcept {
    constexpr double kRounding = 1e-6;  // of the area
    return isFloor && isGrossKnown && net > gross * (1 + kRounding) + grossBound;
}

LevelArea FloorAreas::total() const noexcept {
    LevelArea sum;
    sum.isExact = sum.isGrossKnown = true;
    for (const LevelArea& level : levels) {
        if (!level.isFloor) continue;
        sum.isFloor = true;
        sum.isGrossKnown = sum.isGrossKnown && level.isGrossKnown && !level.netExceedsGross();
        sum.gross += level.gross;
        sum.net += level.net;
        sum.construction += level.construction;
        sum.use += level.use;
        sum.technical += level.technical;
        sum.traffic += level.traffic;
        sum.unknown += level.unknown;
        sum.grossBound += level.grossBound;
        sum.rooms += level.rooms;
        sum.isExact = sum.isExact && level.isExact;
    }
    return sum;
}

Result<FloorAreas> measureFloorAreas(const volume::SemanticVolume& volume, const std::vector<BuildingLevel>& levels,
                                     int threads, const DrawingTables* tables) {
    const DrawingTables own(volume);
    return AreaMaker(volume, levels, threads, tables != nullptr ? *tables : own).run();
}

void reportAreas(const FloorAreas& areas, const std::vector<BuildingLevel>& levels,
                 const volume::SemanticVolume& volume, Diagnostics& log) {
    for (std::size_t n = 0; n < levels.size() && n < areas.levels.size(); ++n) {
        const LevelArea& level = areas.levels[n];
        const std::string name = levelName(levels[n], volume);
        reportShared(areas, n, name, volume, log);
        if (!level.netExceedsGross()) continue;
        log.add(Severity::Warning, Code::NetExceedsGross,
                fmt::format("the rooms of the level {} have {:.2f} m2, more than the {:.2f} m2 that its plan encloses; "
                            "its area of construction is unknown; check for rooms that lie on another level",
                            name, level.net, level.gross),
                {volume.source, 0, 0, {}});
    }
}

}  // namespace svt::drawing
