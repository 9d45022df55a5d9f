#include <svt/simulate/heat.hpp>

#include <svt/simulate/conduction/heat_model.hpp>
#include <svt/simulate/conduction/heat_report.hpp>

namespace svt::simulate {

Result<HeatResult> simulateHeat(const volume::SemanticVolume& volume, const HeatOptions& options,
                                Diagnostics& findings) {
    SVT_TRY(model, makeHeatModel(volume, options, findings));
    std::vector<double> celsius;
    SVT_TRY(report, solveSteady(*model, options, celsius));
    const std::uint64_t undetermined = clearUndetermined(model->equations, celsius);
    const SolvedHeat solved{volume, options, model->roles, model->map, model->equations, model->openings, celsius};
    HeatResult result = reportHeat(solved);
    result.leaks = model->map.leaks;
    result.cells = model->map.cells;
    result.undetermined = undetermined;
    result.iterations = report->iterations;
    model->equations.cells = {};  // makes room for the field
    result.temperature = temperatureField(solved, result);
    return result;
}

}  // namespace svt::simulate
