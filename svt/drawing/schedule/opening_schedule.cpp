#include <svt/drawing/opening_schedule.hpp>

#include <svt/analyze/stated_facts.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

// "Family:Type" of a name such as "Family:Type:285860", as some programs write it.
std::string typeInName(const std::string& name) {
    const std::size_t last = name.rfind(':');
    if (last == std::string::npos || last == 0 || name.find(':') == last) return {};
    const bool isNumber = name.find_first_not_of("0123456789", last + 1) == std::string::npos;
    return isNumber ? name.substr(0, last) : std::string();
}

std::string typeOf(const volume::Label& label) {
    if (std::string type = typeInName(label.name); !type.empty()) return type;
    for (const std::string_view name : {"type", "objectType", "function"})
        if (std::string text = analyze::statedText(label, name); !text.empty()) return text;
    return {};
}

// Files of CityGML 3.0 may have doors and windows as elements that state their type in IFC.
enum class OpeningKind : std::uint8_t { None, Door, Window };
OpeningKind kindOf(const volume::Label& label) {
    if (model::isFilling(label.className))
        return label.className.starts_with("Door") ? OpeningKind::Door : OpeningKind::Window;
    if (label.className != "BuildingConstructiveElement") return OpeningKind::None;
    const std::string type = lowerTexts(label, {"ifcType"});
    return type.find("ifcdoor") != std::string::npos     ? OpeningKind::Door
           : type.find("ifcwindow") != std::string::npos ? OpeningKind::Window
                                                         : OpeningKind::None;
}

// The outermost opening that each label is part of.
std::vector<std::uint32_t> openingOfLabels(const volume::LabelTable& table) {
    std::vector<std::uint32_t> openings(table.labels.size(), kNoLabel);
    for (std::uint32_t l = 0; l < openings.size(); ++l) {
        const volume::Label& label = table.labels[l];
        if (label.parent != kNoLabel && label.parent < l && openings[label.parent] != kNoLabel)
            openings[l] = openings[label.parent];
        else if (kindOf(label) != OpeningKind::None)
            openings[l] = l;
    }
    return openings;
}

// Sums over the triangles of an opening: the products of their normals, weighted by area.
struct NormalSum {
    std::array<std::array<double, 3>, 3> products{};
    std::vector<std::uint32_t> points;

    void add(Vec3d twice) {
        const double size = length(twice);
        if (!(size > 0)) return;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) products[std::size_t(i)][std::size_t(j)] += twice[i] * twice[j] / size;
    }
    // The direction that most of the faces look along: the eigenvector of the largest eigenvalue, by iteration.
    // \param start  the result lies in the space of eigenvectors that this one has a part in
    [[nodiscard]] std::optional<Vec3d> main(Vec3d start = {0.6, 0.7, 0.4}) const {
        Vec3d at = start;
        for (int n = 0; n < 100; ++n) {
            Vec3d next{};
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) next[i] += products[std::size_t(i)][std::size_t(j)] * at[j];
            const double size = length(next);
            if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
            at = next / size;
        }
        return at;
    }
};

// The extent of the points of an opening along a direction.
double extentAlong(const NormalSum& sum, const volume::SemanticVolume& volume, Vec3d direction) {
    double low = kInfinity, high = -kInfinity;
    for (const std::uint32_t point : sum.points) {
        const double at = dot(volume.vectors.position(point, {}), direction);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return high - low;
}

// Reveals and casings of a deep wall may have more area than the pane: then most faces look along the wall, or up. An
// opening in a wall is wider than deep, and one in a floor is flat. A stated width decides where it fits only one side.
Vec3d acrossWall(Vec3d normal, const NormalSum& sum, const volume::SemanticVolume& volume,
                 const std::optional<double>& statedWidth) {
    constexpr double kFlat = 0.95, kUpright = 0.3;  // cosines
    constexpr double kClearly = 1.2;                // times deeper than wide
    const Vec3d up = volume.grid.axes()[2];
    const double rise = std::abs(dot(normal, up));
    if (rise > kUpright && rise <= kFlat) return normal;
    if (rise > kFlat) {
        Vec3d start = volume.grid.axes()[0] + volume.grid.axes()[1] * 0.7;
        const auto found = sum.main(start - up * dot(start, up));
        if (!found || std::abs(dot(*found, up)) > kUpright) return normal;
        // Slanted sills tilt the direction, and the window would be deeper than it is.
        const Vec3d flat = normalized(*found - up * dot(*found, up));
        const Vec3d along = normalized(cross(up, flat));
        const double depth = std::min(extentAlong(sum, volume, flat), extentAlong(sum, volume, along));
        if (extentAlong(sum, volume, up) <= depth) return normal;
        normal = flat;
    }
    const Vec3d along = normalized(cross(up, normal));
    const double width = extentAlong(sum, volume, along), depth = extentAlong(sum, volume, normal);
    if (statedWidth && std::abs(width - *statedWidth) <= std::abs(depth - *statedWidth)) return normal;
    return depth > kClearly * width ? along : normal;
}

std::optional<OpeningPlace> placeOf(const NormalSum& sum, const volume::SemanticVolume& volume,
                                    const std::optional<double>& statedWidth) {
    constexpr double kFlat = 0.95;  // cosine: hatches lie in floors
    auto normal = sum.main();
    if (!normal) return std::nullopt;
    normal = acrossWall(*normal, sum, volume, statedWidth);
    const Vec3d up = volume.grid.axes()[2], origin = volume.grid.origin();
    OpeningPlace place;
    place.normal = *normal;
    const bool isFlat = std::abs(dot(*normal, up)) > kFlat;
    const Vec3d across = isFlat ? volume.grid.axes()[0] : normalized(cross(up, *normal));
    const Vec3d along = isFlat ? volume.grid.axes()[1] : normalized(cross(*normal, across));
    const Vec3d directions[] = {across, along, *normal, up};
    double low[4], high[4];
    std::fill(std::begin(low), std::end(low), kInfinity);
    std::fill(std::begin(high), std::end(high), -kInfinity);
    for (const std::uint32_t point : sum.points)
        for (std::size_t n = 0; n < 4; ++n) {
            const double at = dot(volume.vectors.position(point, origin) - origin, directions[n]);
            low[n] = std::min(low[n], at);
            high[n] = std::max(high[n], at);
        }
    place.width = high[0] - low[0];
    place.height = high[1] - low[1];
    place.low = low[3];
    place.center = origin;
    for (std::size_t n = 0; n < 3; ++n) place.center = place.center + directions[n] * (0.5 * (low[n] + high[n]));
    return place;
}

std::vector<std::optional<OpeningPlace>> placesOf(const volume::SemanticVolume& volume,
                                                  const std::vector<std::uint32_t>& openings) {
    std::map<std::uint32_t, NormalSum> sums;
    for (const auto& triangle : volume.vectors.triangles) {
        const std::uint32_t opening = openings[triangle.label];
        if (opening == kNoLabel) continue;
        NormalSum& sum = sums[opening];
        const Vec3d a = volume.vectors.position(triangle.corners[0], {});
        sum.add(cross(volume.vectors.position(triangle.corners[1], {}) - a,
                      volume.vectors.position(triangle.corners[2], {}) - a));
        sum.points.insert(sum.points.end(), triangle.corners.begin(), triangle.corners.end());
    }
    std::vector<std::optional<OpeningPlace>> places(openings.size());
    for (const auto& [opening, sum] : sums)
        places[opening] = placeOf(sum, volume, numberOf(volume.labels.labels[opening], "overallWidth"));
    return places;
}

// Openings with equal keys share a mark. Sizes are in millimetres; -1: unknown.
struct OpeningKey {
    bool isWindow = false;
    std::string type;
    std::array<long, 5> size{-1, -1, -1, -1, -1};
    friend bool operator<(const OpeningKey& a, const OpeningKey& b) {
        return std::tie(a.isWindow, a.type, a.size) < std::tie(b.isWindow, b.type, b.size);
    }
};

// Points of meshes are whole micrometres; sizes do not show this rounding.
double roundedSize(double metres) { return std::round(metres * 1e5) / 1e5 + 0.0; }

// The clear width of a door, as its file states it, or between its linings.
std::optional<double> clearWidthOf(const volume::Label& label, const std::optional<double>& statedWidth) {
    constexpr std::string_view kNames[] = {"clearwidth",          "clearopeningwidth", "cleardoorwidth",
                                           "lichtebreite",        "durchgangsbreite",  "lichtedurchgangsbreite",
                                           "lichtet\u00FCrbreite"};
    for (const Attribute& attribute : label.attributes) {
        if (attribute.unit != "m") continue;
        std::string name = lowerAscii(attribute.name.substr(attribute.name.rfind('.') + 1));
        std::erase_if(name, [](char c) { return c == ' ' || c == '_' || c == '-'; });
        if (std::find(std::begin(kNames), std::end(kNames), name) == std::end(kNames)) continue;
        if (const auto width = numberOf(label, attribute.name); width > 0.0) return width;
    }
    const auto lining = numberOf(label, "liningThickness");
    const std::string operation =
        analyze::statedText(label, "operationType");  // SWING_FIXED_LEFT: one of two panels swings
    const auto has = [&](std::string_view word) { return operation.find(word) != std::string::npos; };
    if (!has("SWING") || has("FIXED") || !statedWidth || !lining || !(*statedWidth > 2 * *lining)) return std::nullopt;
    return roundedSize(*statedWidth - 2 * *lining);
}

// Surfaces of doors and windows count only where the model has no bodies of their kind. The two sides of a wall count
// once, also those of doors and windows without thickness: a surface is left out if another one of its size is nearer
// than a wall is thick.
bool isOtherSide(const OpeningPlace& place, bool isDoor, const std::vector<std::pair<bool, OpeningPlace>>& surfaces) {
    constexpr double kWall = 0.7, kSameSize = 0.05;  // metres
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const auto& other) {
        return other.first == isDoor && length(other.second.center - place.center) < kWall &&
               std::abs(other.second.width - place.width) < kSameSize &&
               std::abs(other.second.height - place.height) < kSameSize;
    });
}

// The facts of one opening, without its mark.
OpeningRow rowOf(const volume::Label& label, const std::optional<OpeningPlace>& place, std::size_t level,
                 std::span<const BuildingLevel> levels) {
    constexpr double kThreshold = 0.05;  // metres
    OpeningRow row;
    row.isDoor = kindOf(label) == OpeningKind::Door;
    row.type = typeOf(label);
    row.level = level;
    row.statedWidth = numberOf(label, "overallWidth");
    row.statedHeight = numberOf(label, "overallHeight");
    if (row.isDoor) row.clearWidth = clearWidthOf(label, row.statedWidth);
    if (!place) return row;
    row.measuredWidth = roundedSize(place->width);
    row.measuredHeight = roundedSize(place->height);
    if (levels.empty()) return row;
    row.sill = roundedSize(place->low - levels[level].roomFloor.value_or(levels[level].floor));
    // The threshold of a door does not count.
    if (row.isDoor && std::abs(*row.sill) < kThreshold) row.sill = 0;
    return row;
}

long millimetresOf(const std::optional<double>& metres) { return metres ? std::lround(*metres * 1000) : -1; }

}  // namespace

OpeningSchedule scheduleOpenings(const volume::SemanticVolume& volume, std::span<const BuildingLevel> levels) {
    OpeningSchedule schedule;
    const auto& labels = volume.labels.labels;
    schedule.openings = openingOfLabels(volume.labels);
    schedule.places = placesOf(volume, schedule.openings);
    schedule.marks.resize(labels.size());
    const std::vector<std::size_t> levelOf = levels.empty() ? std::vector<std::size_t>(labels.size(), 0)
                                                            : levelsOfLabels(volume, levels, labelExtents(volume));
    const auto hasBodies = [&](OpeningKind kind) {
        return std::any_of(labels.begin(), labels.end(), [&](const auto& label) {
            return kindOf(label) == kind && !label.className.ends_with("Surface");
        });
    };
    const bool hasDoors = hasBodies(OpeningKind::Door), hasWindows = hasBodies(OpeningKind::Window);
    std::vector<std::pair<bool, OpeningPlace>> surfaces;             // whether it is a door
    std::map<OpeningKey, std::map<std::size_t, OpeningRow>> groups;  // by key, then level
    std::map<OpeningKey, std::size_t> lowest;                        // level at which a key first occurs
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (schedule.openings[l] != l) continue;
        const auto& place = schedule.places[l];
        OpeningRow row = rowOf(labels[l], place, levelOf[l], levels);
        if (!place && !row.statedWidth && !row.statedHeight) {
            ++schedule.unknown;
            continue;
        }
        const bool isSurface = labels[l].className.ends_with("Surface");
        if (place && isSurface && (row.isDoor ? hasDoors : hasWindows)) continue;
        if (place && (isSurface || labels[l].filling == volume::Filling::Surface)) {
            if (isOtherSide(*place, row.isDoor, surfaces)) continue;
            surfaces.emplace_back(row.isDoor, *place);
        }
        const OpeningKey key{
            !row.isDoor,
            row.type,
            {millimetresOf(row.statedWidth), millimetresOf(row.statedHeight), millimetresOf(row.measuredWidth),
             millimetresOf(row.measuredHeight), millimetresOf(row.clearWidth)}};
        const auto [known, isNew] = lowest.try_emplace(key, row.level);
        if (!isNew) known->second = std::min(known->second, row.level);
        OpeningRow& group = groups[key].try_emplace(row.level, row).first->second;
        if (row.sill && (!group.sill || *row.sill < *group.sill)) group.sill = row.sill;
        group.labels.push_back(l);
    }
    std::vector<std::pair<OpeningKey, std::size_t>> order(lowest.begin(), lowest.end());
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first.isWindow, a.second) < std::tie(b.first.isWindow, b.second);
    });
    int doors = 0, windows = 0;
    for (const auto& [key, level] : order) {
        const std::string mark = key.isWindow ? fmt::format("W{}", ++windows) : fmt::format("D{}", ++doors);
        for (auto& [of, row] : groups[key]) {
            row.mark = mark;
            for (const std::uint32_t label : row.labels) schedule.marks[label] = mark;
            schedule.rows.push_back(std::move(row));
        }
    }
    return schedule;
}

}  // namespace svt::drawing
