#pragma once
/// \file
/// Everything that a simulation of heat knows before it solves, and the steady state.

#include <svt/simulate/conduction/heat_equations.hpp>
#include <svt/simulate/conduction/opening_areas.hpp>
#include <svt/simulate/solver/multigrid.hpp>

#include <vector>

namespace svt::simulate {

struct HeatModel {
    ThermalRoles roles;
    AirMap map;
    std::vector<OpeningPlace> openings;
    HeatEquations equations;
};

/// Checks the options, and makes the equations. Reports leaks.
/// \return or the errors of simulateHeat()
[[nodiscard]] Result<HeatModel> makeHeatModel(const volume::SemanticVolume& volume, const HeatOptions& options,
                                              Diagnostics& findings);

/// Solves the steady state with the temperatures of the zones.
/// \param celsius  receives the temperature of each cell; count + 2 entries
/// \return how it was solved, or NotConverged, Cancelled
[[nodiscard]] Result<SolveReport> solveSteady(const HeatModel& model, const HeatOptions& options,
                                              std::vector<double>& celsius);

/// Sets cells that no zone determines to NaN. \return their number
std::uint64_t clearUndetermined(const HeatEquations& equations, std::vector<double>& celsius);

/// NotConverged or Cancelled, if the solver says so.
[[nodiscard]] Result<void> checkSolved(const SolveReport& report, double tolerance);

}  // namespace svt::simulate
