#include <svt/simulate/conduction/heat_model.hpp>

#include <svt/fields/check_field.hpp>
#include <svt/simulate/conduction/heat_report.hpp>

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace svt::simulate {
namespace {

// The field has 4 bytes for each voxel.
constexpr std::uint64_t kMostVoxels = std::uint64_t{1} << 33;

Result<void> checkOptions(const volume::SemanticVolume& volume, const HeatOptions& options) {
    const auto isTemperature = [](double t) { return t >= -273.15 && t <= 5000; };
    const auto isResistance = [](double r) { return r >= 0 && r <= 100; };
    if (!isTemperature(options.outside))
        return Error(
            Code::BadArgument,
            fmt::format("outside: {} is not a temperature from -273.15 to 5000 degrees Celsius", options.outside));
    for (const RoomTemperature& rule : options.inside)
        if (!isTemperature(rule.celsius))
            return Error(Code::BadArgument,
                         fmt::format("inside: {} for '{}' is not a temperature from -273.15 to 5000 degrees Celsius",
                                     rule.celsius, rule.query));
    const SurfaceResistances& films = options.resistances;
    for (const double r : {films.inside, films.insideUpwards, films.insideDownwards, films.outside})
        if (!isResistance(r))
            return Error(Code::BadArgument,
                         fmt::format("surface resistances: {} is not a number from 0 to 100 m2 K/W", r));
    if (!(options.tolerance > 0 && options.tolerance < 1) || options.mostIterations < 1)
        return Error(Code::BadArgument,
                     "the tolerance must lie between 0 and 1, and the iterations must be at least 1");
    if (volume.grid.sampleCount() > kMostVoxels)
        return Error(Code::GridTooLarge,
                     fmt::format("the grid has {} voxels; a simulation takes at most {}; choose a coarser --spacing",
                                 volume.grid.sampleCount(), kMostVoxels));
    return {};
}

// Reports the leaks as findings. \return the error of the first, unless leaks are allowed
Result<void> reportLeaks(const volume::SemanticVolume& volume, const HeatOptions& options,
                         const std::vector<AirLeak>& leaks, Diagnostics& findings) {
    for (const AirLeak& leak : leaks) {
        const volume::Label& room = volume.labels.labels[leak.label];
        findings.add(Severity::Warning, Code::AirLeak,
                     fmt::format("the room '{}' is open to outside air at ({:.3f}, {:.3f}, {:.3f}), {:.3f} m2 in total",
                                 room.name.empty() ? room.id : room.name, leak.at.x, leak.at.y, leak.at.z, leak.area),
                     {volume.source, 0, 0, room.id});
    }
    if (leaks.empty() || options.isLeaky) return {};
    const AirLeak& first = leaks.front();
    const std::string where = leaks.size() == 1
                                  ? "a room is open to outside air, at"
                                  : fmt::format("{} rooms are open to outside air, the first at", leaks.size());
    return Error(
        Code::AirLeak,
        fmt::format("{} ({:.3f}, {:.3f}, {:.3f}); close the gaps, choose a finer --spacing, or give --leaky to "
                    "leave out the heat of this air",
                    where, first.at.x, first.at.y, first.at.z),
        {{}, 0, 0, volume.labels.labels[first.label].id});
}

}  // namespace

Result<HeatModel> makeHeatModel(const volume::SemanticVolume& volume, const HeatOptions& options,
                                Diagnostics& findings) {
    SVT_DO(checkOptions(volume, options));
    SVT_DO(fields::checkHead(temperatureHead(volume, options)));
    Progress::tell(options.progress, "cells", 0);
    SVT_TRY(roles, findThermalRoles(volume, options, findings));
    SVT_TRY(map, makeAirMap(volume, *roles));
    HeatModel model{std::move(*roles), std::move(*map), {}, {}};
    for (AirLeak& leak : model.map.leaks) leak.label = model.roles.zones[leak.label].label;
    SVT_DO(reportLeaks(volume, options, model.map.leaks, findings));
    std::vector<char> hasBody;
    for (const OpeningHeat& opening : model.roles.openings)
        hasBody.push_back(volume.labels.labels[opening.label].filling != volume::Filling::Surface);
    model.openings = findOpeningPlaces(model.map, volume.grid.spacing(), hasBody);
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "the simulation was stopped");
    Progress::tell(options.progress, "equations", 0);
    SVT_TRY(finder, FaceFinder::make(volume, options.threads, options.progress));
    std::unique_ptr<render::FaceModel> faces;
    if (!options.priority.empty() && !volume.vectors.triangles.empty()) {
        SVT_TRY(made, render::FaceModel::make(volume, options.priority));
        faces = std::move(*made);
    }
    model.equations =
        makeHeatEquations({volume, model.roles, model.map, *finder, faces.get(), options.resistances, options.threads});
    return model;
}

Result<void> checkSolved(const SolveReport& report, double tolerance) {
    if (report.isCancelled) return Error(Code::Cancelled, "the simulation was stopped");
    if (report.isConverged) return {};
    return Error(
        Code::NotConverged,
        fmt::format("the temperatures did not converge: after {} iterations, the residual is {:.1e} instead of "
                    "{:.1e}; check the conductivities (--materials) for values that are too far apart",
                    report.iterations, report.residual, tolerance));
}

Result<SolveReport> solveSteady(const HeatModel& model, const HeatOptions& options, std::vector<double>& celsius) {
    const CellEquations& cells = model.equations.cells;
    std::vector<double> b(std::size_t{cells.count} + 2, 0);
    double sum = 0, weight = 0;
    for (const BoundaryFace& face : model.equations.faces) {
        const double t = model.roles.zones[face.zone].celsius;
        b[face.cell] += double{face.conductance} * t;
        sum += double{face.conductance} * t;
        weight += double{face.conductance};
    }
    celsius.assign(b.size(), weight > 0 ? sum / weight : 0);
    celsius.front() = celsius.back() = 0;
    const SolveReport report =
        solveEquations(cells, b, celsius, options.tolerance, options.mostIterations, options.threads, options.progress);
    SVT_DO(checkSolved(report, options.tolerance));
    return report;
}

std::uint64_t clearUndetermined(const HeatEquations& equations, std::vector<double>& celsius) {
    const std::vector<char> isDetermined = findDetermined(equations);
    std::uint64_t count = 0;
    for (std::uint32_t u = 1; u <= equations.cells.count; ++u)
        if (isDetermined[u] == 0) {
            celsius[u] = std::numeric_limits<double>::quiet_NaN();
            ++count;
        }
    return count;
}

}  // namespace svt::simulate
