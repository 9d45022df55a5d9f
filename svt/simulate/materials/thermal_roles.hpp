#pragma once
/// \file
/// The role of each scalar in a simulation of heat: air of a room, a solid with its conductivity, a window or door.

#include <svt/simulate/heat.hpp>

#include <cstdint>
#include <vector>

namespace svt::simulate {

enum class Role : std::uint8_t {
    Background,  ///< no label
    Passive,     ///< furniture, installations: counts as the air around it
    Room,        ///< air of a zone: `number` is its number
    Solid,       ///< conducts
    Ground,      ///< conducts; its cut sides at the border of the grid are adiabatic
    Opening,     ///< a window or door: `number` is that of the opening
    Blocked      ///< no heat passes
};

struct ScalarRole {
    Role role = Role::Background;
    std::uint32_t number = 0;
    std::uint32_t label = volume::kNoLabel;  ///< a phase of an object has the label of the object
    double conductivity = 0;                 ///< W/(m K), of Solid and Ground
    double heatCapacity = 0;                 ///< J/(m3 K), of Solid and Ground
};

struct ThermalRoles {
    std::vector<ScalarRole> ofScalar;
    std::vector<ZoneHeat> zones;        ///< 0: outside air; then the rooms, ascending by label
    std::vector<OpeningHeat> openings;  ///< ascending by label
    std::vector<ThermalAssumption> assumed;
    std::vector<CapacityAssumption> capacities;
};

/// \return the roles; BadQuery, NothingSelected of a query; BadArgument without rooms
/// Cost: O(labels * words), and O(runs) if a component states a U-value.
[[nodiscard]] Result<ThermalRoles> findThermalRoles(const volume::SemanticVolume& volume, const HeatOptions& options,
                                                    Diagnostics& findings);

}  // namespace svt::simulate
