#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kLeastRoomHeight = 1.5;  // metres: lower spaces are voids
constexpr double kLevelReach = 0.3;       // metres
constexpr double kBelowSills = 0.15;      // metres above the floor: below the sills of windows

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

bool isMeasuredRoom(const volume::Label& label) {
    return label.count > 0 && model::isSpace(label.className) &&
           model::classRank(label.className) == model::ClassRank::Room;
}

// Sums over the triangles of each label.
struct MeshSum {
    double below = 0;  // m2: faces that look down, seen from above
    Vec3d largest{};   // twice the area times the normal of the largest triangle
    double seen = 0;   // m2, see ComponentSum::area
};

std::vector<MeshSum> sumMeshes(const volume::SemanticVolume& volume) {
    std::vector<MeshSum> sums(volume.labels.labels.size());
    const Vec3d up = volume.grid.axes()[2];
    const auto crossOf = [&](const volume::VectorParts::Triangle& t) {
        const Vec3d a = volume.vectors.position(t.corners[0], {});
        return cross(volume.vectors.position(t.corners[1], {}) - a, volume.vectors.position(t.corners[2], {}) - a);
    };
    for (const auto& triangle : volume.vectors.triangles) {
        MeshSum& sum = sums[triangle.label];
        const Vec3d twice = crossOf(triangle);
        sum.below += std::max(0.0, -0.5 * dot(twice, up));
        if (dot(twice, twice) > dot(sum.largest, sum.largest)) sum.largest = twice;
    }
    for (const auto& triangle : volume.vectors.triangles) {
        MeshSum& sum = sums[triangle.label];
        if (dot(sum.largest, sum.largest) > 0)
            sum.seen += 0.5 * std::abs(dot(crossOf(triangle), normalized(sum.largest)));
    }
    return sums;
}

bool hasClosedMesh(volume::Filling filling) noexcept {
    return filling >= volume::Filling::Solid && filling <= volume::Filling::Capped;
}

class AreaMaker {
public:
    AreaMaker(const volume::SemanticVolume& volume, const std::vector<BuildingLevel>& levels, int threads,
              const volume::BrickVolume* bricks)
        : volume_(volume), levels_(levels), threads_(threads), bricks_(bricks), meshes_(sumMeshes(volume)) {}

    Result<FloorAreas> run() {
        areas_.levels.resize(levels_.size());
        SVT_DO(cutLevels());
        addRooms();
        addComponents();
        return std::move(areas_);
    }

private:
    // Measures the area that each level encloses, and the area of each label at its level.
    Result<void> cutLevels() {
        areaAt_.assign(levels_.size(), std::vector<double>(volume_.labels.labels.size(), 0));
        const Vec3d up = volume_.grid.axes()[2];
        SectionOptions options;
        options.threads = threads_;
        for (std::size_t n = 0; n < levels_.size(); ++n) {
            const SectionPlane plane{up, volume_.grid.origin() + up * (levels_[n].floor + kBelowSills),
                                     levels_[n].bound};
            areas_.levels[n].isExact = levels_[n].bound == 0;
            if (!meetsGrid(plane, volume_.grid)) continue;
            SVT_TRY(drawing, bricks_ != nullptr ? drawSection(volume_, *bricks_, plane, options)
                                                : drawSection(volume_, plane, options));
            for (const SectionComponent& component : drawing->components) {
                const volume::Label& label = volume_.labels.labels[component.label];
                if (model::classRank(label.className) == model::ClassRank::Other) continue;
                areas_.levels[n].gross += component.area;
                areas_.levels[n].grossBound += component.areaBound;
                areas_.levels[n].isExact = areas_.levels[n].isExact && component.isExact;
                areaAt_[n][component.label] = component.area;
            }
        }
        return {};
    }

    void addRooms() {
        if (levels_.empty()) return;
        const std::vector<LabelExtent> extents = labelExtents(volume_);
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l) {
            const volume::Label& label = volume_.labels.labels[l];
            if (!isMeasuredRoom(label)) continue;
            RoomArea room;
            room.label = l;
            room.name = label.name.empty() ? label.id : label.name;
            if (const std::string* number = attributeText(label, "number")) room.number = *number;
            room.use = roomUseOf(label);
            room.volume = label.volume;
            const LabelExtent& extent = extents[l];
            if (extent.box.isEmpty()) continue;
            room.height = extent.box.size().z;
            if (room.height < kLeastRoomHeight) continue;
            while (room.level + 1 < levels_.size() && levels_[room.level + 1].floor <= extent.floor + kLevelReach)
                ++room.level;
            room.isExact = extent.bound == 0 && hasClosedMesh(label.filling);
            room.area = room.isExact ? meshes_[l].below : areaAt_[room.level][l];
            addToLevel(room);
            areas_.rooms.push_back(std::move(room));
        }
        std::sort(areas_.rooms.begin(), areas_.rooms.end(), [](const RoomArea& a, const RoomArea& b) {
            return std::tie(a.level, a.number, a.name, a.label) < std::tie(b.level, b.number, b.name, b.label);
        });
        for (LevelArea& level : areas_.levels) level.construction = std::max(0.0, level.gross - level.net);
    }

    void addToLevel(const RoomArea& room) {
        LevelArea& level = areas_.levels[room.level];
        ++level.rooms;
        level.isExact = level.isExact && room.isExact;
        level.net += room.area;
        (room.use == RoomUse::Use         ? level.use
         : room.use == RoomUse::Technical ? level.technical
         : room.use == RoomUse::Traffic   ? level.traffic
                                          : level.unknown) += room.area;
    }

    void addComponents() {
        std::map<std::pair<std::string, std::string>, ComponentSum> sums;
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l) {
            const volume::Label& label = volume_.labels.labels[l];
            if (label.count == 0 || model::isSpace(label.className)) continue;
            const std::string* type = attributeText(label, "ifcType");
            ComponentSum& sum = sums[{label.className, type != nullptr ? *type : std::string()}];
            sum.className = label.className;
            if (type != nullptr) sum.type = *type;
            ++sum.count;
            sum.area += hasClosedMesh(label.filling) ? 0.5 * meshes_[l].seen : meshes_[l].seen;
            sum.volume += label.volume;
        }
        for (auto& [key, sum] : sums) areas_.components.push_back(std::move(sum));
    }

    const volume::SemanticVolume& volume_;
    const std::vector<BuildingLevel>& levels_;
    int threads_;
    const volume::BrickVolume* bricks_;
    std::vector<MeshSum> meshes_;              // by label
    std::vector<std::vector<double>> areaAt_;  // by level and label, m2
    FloorAreas areas_;
};

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

LevelArea FloorAreas::total() const noexcept {
    LevelArea sum;
    sum.isExact = true;
    for (const LevelArea& level : levels) {
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
                                     int threads, const volume::BrickVolume* bricks) {
    return AreaMaker(volume, levels, threads, bricks).run();
}

}  // namespace svt::drawing
