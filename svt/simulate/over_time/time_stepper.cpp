#include <svt/simulate/over_time/time_stepper.hpp>

#include <svt/simulate/conduction/heat_model.hpp>
#include <svt/simulate/solver/cell_sums.hpp>

#include <numbers>
#include <utility>

namespace svt::simulate {
namespace {

constexpr double kGamma = 2 - std::numbers::sqrt2;
constexpr double kAlpha = kGamma / 2;
constexpr double kWeight = std::numbers::sqrt2 / 4;  // of the begin and the middle; kAlpha is that of the end

}  // namespace

TimeStepper::TimeStepper(HeatEquations& equations, std::vector<double> capacities, double seconds,
                         const HeatOptions& options)
    : equations_(equations), options_(options), seconds_(seconds), mass_(std::move(capacities)) {
    CellEquations& cells = equations.cells;
    for (std::uint32_t u = 1; u <= cells.count; ++u) {
        // m is the difference of two floats, so that m + K minus m gives K exactly.
        const float before = cells.toZones[u];
        cells.toZones[u] += static_cast<float>(mass_[u] / (kAlpha * seconds));
        mass_[u] = double{cells.toZones[u]} - double{before};
        capacity_ += mass_[u] * kAlpha * seconds;
    }
    for (std::vector<double>* one : {&zones_, &before_, &flow_, &middle_, &change_}) one->assign(mass_.size(), 0);
    multigrid_ = std::make_unique<Multigrid>(cells, options.threads);
}

double TimeStepper::content(const std::vector<double>& celsius) const {
    return kAlpha * seconds_ *
           sumOverCells(equations_.cells.count, options_.threads, [&](std::size_t u) { return mass_[u] * celsius[u]; });
}

// The heat from zones into cells, without their temperatures.
void TimeStepper::setZones(const ThermalRoles& roles, double outside) {
    std::fill(zones_.begin(), zones_.end(), 0);
    for (const BoundaryFace& face : equations_.faces)
        zones_[face.cell] += double{face.conductance} * (face.zone == 0 ? outside : roles.zones[face.zone].celsius);
}

// F = b - K T of each cell. \return W from all zones into cells
double TimeStepper::flow(const std::vector<double>& celsius, std::vector<double>& flow) const {
    applyEquations(equations_.cells, celsius, flow, options_.threads);
    forCells(equations_.cells.count, options_.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t u = begin; u < end; ++u) flow[u] = zones_[u] - (flow[u] - mass_[u] * celsius[u]);
    });
    return sumOverCells(equations_.cells.count, options_.threads, [&](std::size_t u) { return flow[u]; });
}

Result<int> TimeStepper::solve(std::vector<double>& rightSide, std::vector<double>& change) {
    std::fill(change.begin(), change.end(), 0);
    const SolveReport report = solveEquations(equations_.cells, *multigrid_, rightSide, change, options_.tolerance,
                                              options_.mostIterations, options_.threads);
    SVT_DO(checkSolved(report, options_.tolerance));
    return report.iterations;
}

Result<int> TimeStepper::step(const ThermalRoles& roles, const std::function<double(double)>& outside,
                              std::vector<double>& celsius) {
    const std::size_t size = celsius.size();
    if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "the simulation was stopped");
    setZones(roles, outside(0));
    before_ = zones_;
    const double atBegin = flow(celsius, flow_);
    setZones(roles, outside(kGamma));
    std::vector<double>& rightSide = middle_;
    for (std::size_t u = 0; u < size; ++u) rightSide[u] = 2 * flow_[u] + zones_[u] - before_[u];
    SVT_TRY(first, solve(rightSide, change_));
    for (std::size_t u = 0; u < size; ++u) change_[u] += celsius[u];  // T*
    const double inMiddle = flow(change_, middle_);
    setZones(roles, outside(1));
    for (std::size_t u = 0; u < size; ++u)
        rightSide[u] = kWeight / kAlpha * (flow_[u] + middle_[u]) + flow_[u] + zones_[u] - before_[u];
    SVT_TRY(second, solve(rightSide, change_));
    for (std::size_t u = 0; u < size; ++u) celsius[u] += change_[u];
    const double atEnd = flow(celsius, flow_);
    received_ += seconds_ * (kWeight * (atBegin + inMiddle) + kAlpha * atEnd);
    return *first + *second;
}

}  // namespace svt::simulate
