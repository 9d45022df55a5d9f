#pragma once
/// \file
/// The figures of a solved simulation: heat of zones, extreme surfaces, the field.

#include <svt/simulate/conduction/heat_equations.hpp>
#include <svt/simulate/conduction/opening_areas.hpp>

#include <span>
#include <string>
#include <vector>

namespace svt::simulate {

/// A solved simulation. All members must outlive the functions.
struct SolvedHeat {
    const volume::SemanticVolume& volume;
    const HeatOptions& options;
    const ThermalRoles& roles;
    const AirMap& map;
    const HeatEquations& equations;
    std::span<const OpeningPlace> openings;
    std::span<const double> celsius;  ///< by cell; NaN where no zone determines it
};

/// The result without the field and without the numbers of the solution.
[[nodiscard]] HeatResult reportHeat(const SolvedHeat& solved);

/// The head of the field, without parameters.
[[nodiscard]] fields::FieldHead temperatureHead(const volume::SemanticVolume& volume, const HeatOptions& options);

/// Everything that was assumed, as a JSON object.
[[nodiscard]] std::string temperatureParameters(const SolvedHeat& solved, const HeatResult& result);

/// The temperature at each voxel; NaN elsewhere than in solids. Memory: 4 bytes for each voxel.
[[nodiscard]] std::vector<float> temperatureValues(const SolvedHeat& solved);

/// The field of temperatures; `result` gives its parameters. Memory: 4 bytes for each voxel.
[[nodiscard]] fields::Field temperatureField(const SolvedHeat& solved, const HeatResult& result);

}  // namespace svt::simulate
