#include <svt/simulate/spread/room_air.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/analyze/space_boundaries.hpp>
#include <svt/model/classes.hpp>
#include <svt/simulate/conduction/air_map.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace svt::simulate {
namespace {

using volume::kNoLabel;
using volume::Label;
using volume::Run;
using volume::SemanticVolume;

constexpr std::uint64_t kMostVoxels = 0xFFFFFFFFu;

// Rooms are zones, open components have cells, and all other components are blocked.
Result<ThermalRoles> rolesOf(const SemanticVolume& volume, std::span<const std::string> open) {
    const std::vector<Label>& labels = volume.labels.labels;
    const std::vector<std::uint32_t> spaces = analyze::spacesOfLabels(volume.labels);
    std::vector<char> isOpen(labels.size(), 0);
    const analyze::LabelRows rows(volume);
    for (const std::string& query : open) {
        SVT_TRY(selected, analyze::selectWithParts(rows, query));
        for (const std::uint32_t l : *selected) isOpen[l] = 1;
    }
    ThermalRoles roles;
    roles.ofScalar.resize(volume.labels.scalarCount());
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const bool isRoom = spaces[l] == l;
        // A phase of a door, such as its pane, is as open as the door. Parents come before their children.
        if (model::isPhase(labels[l].className) && labels[l].parent < l && isOpen[labels[l].parent] != 0) isOpen[l] = 1;
        const Role role = isOpen[l] != 0 || labels[l].className == "ClosureSurface" ? Role::Solid
                          : isRoom                                                  ? Role::Room
                                                                                    : Role::Blocked;
        for (volume::Scalar s = 0; s < labels[l].count; ++s)
            roles.ofScalar[labels[l].first + s] = {role, l + 1, isRoom ? l : kNoLabel, 0};
    }
    return roles;
}

void fillZones(const AirMap& map, const ThermalRoles& roles, RoomAir& air) {
    const std::size_t layer = static_cast<std::size_t>(map.size.x) * static_cast<std::size_t>(map.size.y);
    air.zones.assign(layer * static_cast<std::size_t>(map.size.z), RoomAir::kNone);
    for (std::size_t column = 0; column < layer; ++column) {
        const auto i = static_cast<std::int32_t>(column % static_cast<std::size_t>(map.size.x));
        const auto j = static_cast<std::int32_t>(column / static_cast<std::size_t>(map.size.x));
        std::size_t r = map.columnStart[column];
        std::uint32_t begin = 0;
        for (const Run& run : map.columns->column(i, j)) {
            const RunPlace& place = map.runs[r++];
            const ScalarRole& role = roles.ofScalar[run.scalar];
            std::uint32_t zone = RoomAir::kNone;
            if (role.role == Role::Room)
                zone = 2 + role.label;
            else if (place.kind == RunKind::Solid || (place.kind == RunKind::Air && place.number != 0))
                zone = RoomAir::kCommon;
            if (zone != RoomAir::kNone)
                for (std::uint32_t k = begin; k < run.end; ++k) air.zones[column + layer * k] = zone;
            begin = run.end;
        }
    }
}

void findTouching(RoomAir& air) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    const auto across = static_cast<std::size_t>(air.size.x), layer = across * static_cast<std::size_t>(air.size.y);
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
        if (a != b && a > RoomAir::kCommon && b > RoomAir::kCommon) found.insert(std::minmax(a - 2, b - 2));
    };
    for (std::size_t v = 0; v < air.zones.size(); ++v) {
        const std::uint32_t own = air.zones[v];
        if (own <= RoomAir::kCommon) continue;
        if ((v + 1) % across != 0) compare(own, air.zones[v + 1]);
        if (v % layer + across < layer) compare(own, air.zones[v + across]);
        if (v + layer < air.zones.size()) compare(own, air.zones[v + layer]);
    }
    air.touching.assign(found.begin(), found.end());
}

}  // namespace

Result<RoomAir> findRoomAir(const SemanticVolume& volume, std::span<const std::string> open) {
    if (volume.grid.sampleCount() > kMostVoxels)
        return Error(Code::GridTooLarge,
                     fmt::format("the grid has {} voxels; air has at most {}; choose a coarser --spacing",
                                 volume.grid.sampleCount(), kMostVoxels));
    SVT_TRY(roles, rolesOf(volume, open));
    SVT_TRY(map, makeAirMap(volume, *roles));
    RoomAir air;
    air.size = volume.grid.dimension();
    for (const ScalarRole& role : roles->ofScalar) air.roomOfScalar.push_back(role.label);
    const std::vector<std::uint32_t> spaces = analyze::spacesOfLabels(volume.labels);
    for (std::uint32_t l = 0; l < spaces.size(); ++l)
        if (spaces[l] == l && volume.labels.labels[l].voxels > 0) air.rooms.push_back(l);
    if (air.rooms.empty())
        return Error(Code::BadArgument,
                     "the volume has no rooms, so sensors have no air; build it from a model with rooms (BuildingRoom, "
                     "IfcSpace)");
    fillZones(*map, *roles, air);
    findTouching(air);
    return air;
}

}  // namespace svt::simulate
