#pragma once
/// \file
/// Steps of TR-BDF2 for C dT/dt = b(t) - K T, with the heat capacities C of cells and the equations K T = b of heat
/// conduction.
///
/// The middle T* and the end T' of a step h:
///
///     (m + K) (T* - T)  = 2 F(T, t) + b(t + gamma h) - b(t)
///     (m + K) (T' - T)  = w / alpha (F(T, t) + F(T*, t + gamma h)) + F(T, t) + b(t + h) - b(t)
///
/// with m = C / (alpha h), alpha = gamma / 2, w = sqrt(2) / 4 and F = b - K T.

#include <svt/simulate/conduction/heat_equations.hpp>
#include <svt/simulate/solver/multigrid.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace svt::simulate {

class TimeStepper {
public:
    /// \param equations   must outlive this; its toZones gets m in addition
    /// \param capacities  J/K of each cell; count + 2 entries
    /// \param seconds     of a step
    TimeStepper(HeatEquations& equations, std::vector<double> capacities, double seconds, const HeatOptions& options);

    /// One step.
    /// \param outside  the temperature of outside air at a part of the step, 0 to 1
    /// \param celsius  in: at the begin; out: at the end
    /// \return the iterations of both stages, or NotConverged, Cancelled
    [[nodiscard]] Result<int> step(const ThermalRoles& roles, const std::function<double(double)>& outside,
                                   std::vector<double>& celsius);

    /// J/K of all cells.
    [[nodiscard]] double capacity() const noexcept { return capacity_; }
    /// J that the cells hold, relative to 0 degrees Celsius.
    [[nodiscard]] double content(const std::vector<double>& celsius) const;
    /// J that all steps brought from the air of zones into the cells.
    [[nodiscard]] double received() const noexcept { return received_; }

private:
    void setZones(const ThermalRoles& roles, double outside);
    double flow(const std::vector<double>& celsius, std::vector<double>& flow) const;
    [[nodiscard]] Result<int> solve(std::vector<double>& rightSide, std::vector<double>& change);

    HeatEquations& equations_;
    const HeatOptions& options_;
    double seconds_ = 0, capacity_ = 0, received_ = 0;
    std::vector<double> mass_;            // W/K: m of each cell
    std::vector<double> zones_, before_;  // W of each cell from the air of zones: at a time, and as the step begins
    std::vector<double> flow_, middle_, change_;
    std::unique_ptr<Multigrid> multigrid_;
};

}  // namespace svt::simulate
