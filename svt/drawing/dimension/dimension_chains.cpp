#include <svt/drawing/dimension/dimension_chains.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/dimension/side_reader.hpp>
#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

constexpr double kAlong = 0.0175;       // sine of 1 degree: walls along an axis
constexpr double kLeastAlong = 0.6;     // share of the length of walls
constexpr std::size_t kMostParts = 80;  // of a chain
constexpr double kSameFoot = 0.5;       // metres: a room stands on a level

// The lengths of the borders of walls, by their direction.
struct WallDirections {
    static constexpr std::size_t kSteps = 180;  // half degrees of a right angle
    std::array<double, kSteps> lengths{};
    double all = 0, alongAxes = 0;

    [[nodiscard]] bool areAlongAxes() const noexcept { return all > 0 && alongAxes >= kLeastAlong * all; }
    // Along another direction and across it, within a degree.
    [[nodiscard]] bool areTurned() const noexcept {
        double most = 0;
        for (std::size_t n = 0; n < kSteps; ++n)
            most = std::max(most, lengths[n] + lengths[(n + 1) % kSteps] + lengths[(n + 2) % kSteps]);
        return !areAlongAxes() && all > 0 && most >= kLeastAlong * all;
    }
};

WallDirections wallDirections(const SectionDrawing& drawing, const std::vector<PartRole>& roles) {
    constexpr double kRightAngle = 1.57079632679489661923;
    WallDirections directions;
    const auto isWall = [&](std::uint32_t label) { return label != kNoLabel && roles[label] == PartRole::Hull; };
    for (const SectionBorder& border : drawing.borders) {
        if (isWall(border.left) == isWall(border.right)) continue;
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
            const double du = border.points[n + 1].u - border.points[n].u,
                         dv = border.points[n + 1].v - border.points[n].v, length = std::hypot(du, dv);
            const double turns = std::atan2(dv, du) / kRightAngle, share = turns - std::floor(turns);
            const auto step = static_cast<std::size_t>(share * WallDirections::kSteps);
            directions.lengths[std::min(step, WallDirections::kSteps - 1)] += length;
            directions.all += length;
            if (std::min(std::abs(du), std::abs(dv)) <= kAlong * length) directions.alongAxes += length;
        }
    }
    return directions;
}

bool isSameChain(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](double x, double y) { return std::abs(x - y) < 0.5 * kShortestPart; });
}

// The extent of the hull that is cut: of its polygons and lines, and of its lines beyond the cut if asked for. Without a
// hull, of windows and doors.
std::vector<double> extentOf(const SectionDrawing& drawing, const std::vector<PartRole>& roles, bool isAlongU,
                             bool withBeyond = false) {
    for (const PartRole role : {PartRole::Hull, PartRole::Opening}) {
        std::vector<double> extent{kInfinity, -kInfinity};
        const auto add = [&](std::uint32_t label, const std::vector<PlanePoint>& points) {
            if (roles[label] != role) return;
            for (const PlanePoint p : points) {
                extent[0] = std::min(extent[0], isAlongU ? p.u : p.v);
                extent[1] = std::max(extent[1], isAlongU ? p.u : p.v);
            }
        };
        for (const SectionLine& line : drawing.lines) add(line.label, line.points);
        if (withBeyond)
            for (const BeyondLine& line : drawing.beyond) add(line.label, {line.from, line.to});
        for (const SectionComponent& component : drawing.components)
            for (const SectionPolygon& polygon : component.polygons) add(component.label, polygon.outer);
        if (extent[1] - extent[0] > kShortestPart) return extent;
    }
    return {};
}

// Rows of a side, each once; those that repeat the one before are omitted.
class ChainRows {
public:
    explicit ChainRows(DimensionSide side) : side_(side) {}
    void add(std::vector<double> stops, std::size_t least) {
        if (stops.size() < least || stops.size() > kMostParts + 1) return;
        if (!rows_.empty() && isSameChain(rows_.back(), stops)) return;
        rows_.push_back(std::move(stops));
    }
    void moveTo(std::vector<DimensionChain>& chains) {
        for (std::size_t row = 0; row < rows_.size(); ++row)
            chains.push_back({side_, static_cast<int>(row), std::move(rows_[row])});
    }

private:
    DimensionSide side_;
    std::vector<std::vector<double>> rows_;
};

// Ascending, with parts of at least kShortestPart.
std::vector<double> cleanStops(std::vector<double> stops) {
    std::sort(stops.begin(), stops.end());
    std::vector<double> kept;
    for (const double stop : stops)
        if (kept.empty() || stop - kept.back() > kShortestPart) kept.push_back(stop);
    return kept;
}

// The clear height of a room where a section cuts it.
struct RoomHeight {
    double area = 0, low = 0, high = 0;
};

std::vector<RoomHeight> roomHeights(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    std::vector<RoomHeight> heights;
    const BorderStrips strips(drawing);
    for (const SectionComponent& component : drawing.components) {
        if (!isRoomSpace(volume.labels.labels[component.label])) continue;
        for (const SectionPolygon& polygon : component.polygons) {
            const auto [low, high] = findClearHeight(strips, volume, polygon, component.label);
            if (high - low >= kLowestRoom) heights.push_back({polygon.area, low, high});
        }
    }
    return heights;
}

// Floors and ceilings of the room with the largest section per level. Spaces above the hull, such as roof terraces, have
// no ceiling.
std::vector<double> clearHeights(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                 const std::vector<double>& floors, double top) {
    std::vector<double> stops;
    const std::vector<RoomHeight> rooms = floors.empty() ? std::vector<RoomHeight>() : roomHeights(drawing, volume);
    for (const double floor : floors) {
        double area = 0;
        std::pair<double, double> best;
        for (const RoomHeight& room : rooms) {
            if (room.area <= area || std::abs(room.low - floor) > kSameFoot || room.high > top + kShortestPart)
                continue;
            area = room.area;
            best = {room.low, room.high};
        }
        // A room of two storeys ends the chain of those that it passes.
        if (area == 0 || (!stops.empty() && best.first < stops.back() - kShortestPart)) continue;
        stops.push_back(best.first);
        stops.push_back(best.second);
    }
    return cleanStops(std::move(stops));
}

bool isRoofPart(const volume::Label& label) {
    if (label.className.starts_with("Roof")) return true;
    const std::string type = lowerTexts(label, {"ifcType", "function", "predefinedType"});
    if (type.find("roof") != std::string::npos) return true;
    const std::string name = lowerAscii(label.name);
    return type.find("slab") != std::string::npos &&
           (name.find("roof") != std::string::npos || name.find("dach") != std::string::npos);
}

bool isRafter(const volume::Label& label) {
    const std::string words =
        lowerTexts(label, {"ifcType", "function", "predefinedType"}) + " " + lowerAscii(label.name);
    for (const char* const word : {"rafter", "purlin", "sparren", "pfette"})
        if (words.find(word) != std::string::npos) return true;
    return false;
}

// The box around the cut parts of the hull; empty without any.
struct HullBox {
    double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};

    void add(const SectionComponent& component) {
        for (const SectionPolygon& polygon : component.polygons)
            for (const PlanePoint p : polygon.outer)
                for (const int axis : {0, 1}) {
                    low[axis] = std::min(low[axis], axis == 0 ? p.u : p.v);
                    high[axis] = std::max(high[axis], axis == 0 ? p.u : p.v);
                }
    }
};

// The roles in a plan. A slope is cut wherever the plane happens to meet it: in an attic, walls are measured and not the
// roof, unless the walls are only those of a part of it.
std::vector<PartRole> withoutRoofs(const SectionDrawing& drawing, const std::vector<PartRole>& roles,
                                   const volume::LabelTable& table) {
    constexpr double kLeastShare = 0.75;
    HullBox all, walls;
    std::vector<PartRole> others = roles;
    for (const SectionComponent& component : drawing.components) {
        if (roles[component.label] == PartRole::Frame && isRafter(table.labels[component.label]))
            others[component.label] = PartRole::Nothing;
        if (roles[component.label] != PartRole::Hull) continue;
        all.add(component);
        if (isRoofPart(table.labels[component.label]))
            others[component.label] = PartRole::Nothing;
        else
            walls.add(component);
    }
    // Rafters belong to the roof, also where they touch a wall.
    const auto isRoof = [&](std::uint32_t label) {
        return label != kNoLabel && roles[label] == PartRole::Hull && others[label] == PartRole::Nothing;
    };
    for (const SectionBorder& border : drawing.borders)
        for (const auto& [roof, frame] : {std::pair(border.left, border.right), std::pair(border.right, border.left)})
            if (isRoof(roof) && frame != kNoLabel && roles[frame] == PartRole::Frame) others[frame] = PartRole::Nothing;
    bool hasWalls = true;
    for (const int axis : {0, 1})
        hasWalls = hasWalls && walls.high[axis] - walls.low[axis] >= kLeastShare * (all.high[axis] - all.low[axis]);
    return rolesIn(drawing, hasWalls ? others : roles);
}

}  // namespace

void addDimensions(SectionDrawing& drawing, const volume::SemanticVolume& volume, const SectionOptions& options,
                   const DrawingTables& tables) {
    drawing.dimensionUnit = options.dimensionUnit;
    const double upright = std::abs(dot(drawing.axes.normal, volume.grid.axes()[2]));
    const bool isPlan = upright > 1 - 1e-12;
    if (!isPlan && upright > 1e-9) return;
    const std::vector<PartRole> roles = rolesIn(drawing, tables.roles());
    const std::vector<BuildingLevel> levels = options.levels != nullptr ? *options.levels : findLevels(volume);
    drawing.dimensions = isPlan ? findPlanChains(drawing, withoutRoofs(drawing, tables.roles(), volume.labels))
                                : findHeightChains(drawing, volume, roles, levels);
    // An elevation cuts nothing.
    const bool isCut = std::any_of(drawing.components.begin(), drawing.components.end(),
                                   [&](const auto& part) { return roles[part.label] != PartRole::Space; });
    if (drawing.dimensions.empty() && isCut)
        drawing.chainsLeftOut = isPlan && wallDirections(drawing, roles).areTurned() ? ChainsLeftOut::TurnedWalls
                                                                                     : ChainsLeftOut::NothingMeasured;
    if (!isPlan) return;
    drawing.roomDimensions = findRoomDimensions(drawing, volume);
    drawing.openings = findOpeningHeights(drawing, volume, roles, levels, tables);
}

std::vector<DimensionChain> findPlanChains(const SectionDrawing& drawing, const std::vector<PartRole>& roles) {
    std::vector<DimensionChain> chains;
    const WallDirections directions = wallDirections(drawing, roles);
    if (directions.areTurned()) return chains;
    const bool isAlongAxes = directions.areAlongAxes();
    for (const DimensionSide side :
         {DimensionSide::Below, DimensionSide::Right, DimensionSide::Above, DimensionSide::Left}) {
        std::vector<double> extent =
            extentOf(drawing, roles, side == DimensionSide::Below || side == DimensionSide::Above);
        if (extent.empty()) continue;
        ChainRows rows(side);
        SideReader reader(drawing, roles, side);
        if (isAlongAxes && reader.read()) {
            rows.add(reader.openings(), 3);
            rows.add(reader.rooms(), 3);
        }
        rows.add(std::move(extent), 2);
        rows.moveTo(chains);
    }
    return chains;
}

std::vector<DimensionChain> findHeightChains(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                             const std::vector<PartRole>& roles,
                                             std::span<const BuildingLevel> levels) {
    std::vector<DimensionChain> chains;
    // An elevation cuts nothing.
    if (extentOf(drawing, roles, false).empty()) return chains;
    // The ridge may lie beyond the cut.
    const std::vector<double> extent = extentOf(drawing, roles, false, true);
    std::vector<double> floors;
    const Vec3d up = volume.grid.axes()[2];
    for (const BuildingLevel& level : levels) {
        const double v = drawing.axes.planeFromWorld(volume.grid.origin() + up * level.floor).v;
        if (v > extent[0] - kSameFoot && v < extent[1]) floors.push_back(v);
    }
    for (const DimensionSide side : {DimensionSide::Right, DimensionSide::Left}) {
        ChainRows rows(side);
        SideReader reader(drawing, roles, side);
        if (reader.read() && reader.hasOpenings()) rows.add(reader.openings(), 3);
        if (side == DimensionSide::Left) {
            rows.add(clearHeights(drawing, volume, floors, extent[1]), 2);
            std::vector<double> storeys = floors;
            storeys.insert(storeys.end(), extent.begin(), extent.end());
            rows.add(cleanStops(std::move(storeys)), 3);
            rows.add(extent, 2);
        }
        rows.moveTo(chains);
    }
    return chains;
}

}  // namespace svt::drawing
