#include <svt/writers/foam/foam_case.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/model/query.hpp>
#include <svt/record/record.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/foam/air_cells.hpp>
#include <svt/writers/foam/foam_file.hpp>
#include <svt/writers/foam/foam_mesh.hpp>
#include <svt/writers/foam/foam_settings.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::writers {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

constexpr double kZeroCelsius = 273.15;  // kelvins
constexpr double kDefaultCelsius = 20;   // of surfaces
constexpr double kLeastCelsius = -100, kMostCelsius = 1000;

// A patch with its temperature; none: adiabatic.
struct Surface {
    FoamPatch patch;
    std::optional<double> celsius;
};

Result<std::vector<Surface>> surfacesOf(const SemanticVolume& volume, std::vector<FoamPatch> patches,
                                        const FoamWriteOptions& options) {
    std::vector<Surface> surfaces;
    for (FoamPatch& patch : patches) {
        const bool isMaterial = patch.label != kNoLabel && !patch.isAir;
        surfaces.push_back({std::move(patch), isMaterial ? std::optional(kDefaultCelsius) : std::nullopt});
    }
    for (const std::string& text : options.temperatures) {
        SVT_TRY(rule,
                model::parseQueryValue(text, "QUERY:CELSIUS of --surface-temperature, such as 'class=Window:12'"));
        if (!(rule->value >= kLeastCelsius && rule->value <= kMostCelsius))
            return Error(Code::BadArgument, fmt::format("a temperature of {} degrees Celsius is not between {} and {}",
                                                        rule->value, kLeastCelsius, kMostCelsius));
        SVT_TRY(selected, analyze::selectWithParts(volume, rule->query));
        bool isUsed = false;
        for (Surface& surface : surfaces)
            if (surface.celsius && std::binary_search(selected->begin(), selected->end(), surface.patch.label)) {
                surface.celsius = rule->value;
                isUsed = true;
            }
        if (!isUsed)
            return Error(
                Code::BadArgument,
                fmt::format("'{}' of --surface-temperature selects no component that the air touches", rule->query));
    }
    return surfaces;
}

// The mean by area; the default where all surfaces are adiabatic.
double meanCelsius(const std::vector<Surface>& surfaces) {
    double sum = 0, area = 0;
    for (const Surface& surface : surfaces) {
        if (!surface.celsius) continue;
        sum += *surface.celsius * surface.patch.area;
        area += surface.patch.area;
    }
    return area > 0 ? sum / area : kDefaultCelsius;
}

class CaseWriter {
public:
    CaseWriter(const SemanticVolume& volume, std::vector<Surface> surfaces, NewFolder& folder)
        : volume_(volume), surfaces_(std::move(surfaces)), mean_(meanCelsius(surfaces_)), folder_(folder) {}

    Result<void> write() {
        SVT_DO(writeTemperature());
        SVT_DO(writeField("U", "volVectorField", "0 1 -1 0 0 0 0", "(0 0 0)", "type noSlip;", "type slip;"));
        SVT_DO(writeField("p_rgh", "volScalarField", "0 2 -2 0 0 0 0", "0",
                          "type fixedFluxPressure; rho rhok; value $internalField;", {}));
        SVT_DO(writeField("k", "volScalarField", "0 2 -2 0 0 0 0", "0.01",
                          "type kqRWallFunction; value $internalField;", "type zeroGradient;"));
        SVT_DO(writeField("epsilon", "volScalarField", "0 2 -3 0 0 0 0", "0.01",
                          "type epsilonWallFunction; value $internalField;", "type zeroGradient;"));
        SVT_DO(writeField("nut", "volScalarField", "0 2 -1 0 0 0 0", "0",
                          "type nutkWallFunction; value $internalField;", "type calculated; value $internalField;"));
        SVT_DO(writeField("alphat", "volScalarField", "0 2 -1 0 0 0 0", "0",
                          "type alphatJayatillekeWallFunction; Prt 0.85; value $internalField;",
                          "type calculated; value $internalField;"));
        for (const FoamSetting& setting : foamSettings()) {
            FoamFile file(folder_, std::string(setting.file), setting.className);
            file.add(setting.text);
            SVT_DO(file.end());
        }
        SVT_DO(writeTransport());
        for (const FoamText& text : foamTexts()) SVT_DO(folder_.write(std::string(text.file), text.text));
        return writePatchTable();
    }

    [[nodiscard]] bool hasOneTemperature() const {
        std::optional<double> first;
        for (const Surface& surface : surfaces_) {
            if (!surface.celsius) continue;
            if (first && *first != *surface.celsius) return false;
            first = surface.celsius;
        }
        return true;
    }

private:
    // \param air  of patches to other spaces; empty: as `wall`
    Result<void> writeField(std::string_view name, std::string_view className, std::string_view dimensions,
                            std::string_view inside, std::string_view wall, std::string_view air) {
        FoamFile file(folder_, fmt::format("0/{}", name), className);
        file.line("dimensions [{}];\ninternalField uniform {};\nboundaryField\n{{", dimensions, inside);
        for (const Surface& surface : surfaces_)
            file.line("    {} {{ {} }}", surface.patch.name, surface.patch.isAir && !air.empty() ? air : wall);
        file.line("}}");
        return file.end();
    }

    Result<void> writeTemperature() {
        FoamFile file(folder_, "0/T", "volScalarField");
        file.line("dimensions [0 0 0 1 0 0 0];\ninternalField uniform {:.7g};\nboundaryField\n{{",
                  mean_ + kZeroCelsius);
        for (const Surface& surface : surfaces_)
            if (surface.celsius)
                file.line("    {} {{ type fixedValue; value uniform {:.7g}; }}", surface.patch.name,
                          *surface.celsius + kZeroCelsius);
            else
                file.line("    {} {{ type zeroGradient; }}", surface.patch.name);
        file.line("}}");
        return file.end();
    }

    Result<void> writeTransport() {
        FoamFile file(folder_, "constant/transportProperties", "dictionary");
        const double kelvin = mean_ + kZeroCelsius;
        file.line(
            "transportModel Newtonian;\n// Air at 20 degrees Celsius.\nnu 1.5e-05;\nPr 0.71;\nPrt 0.85;\n"
            "// The mean of the surfaces by area, and its reciprocal.\nTRef {:.7g};\nbeta {:.7g};",
            kelvin, 1 / kelvin);
        return file.end();
    }

    Result<void> writePatchTable() {
        std::string csv = csvLine(Row{"patch", "kind", "id", "class", "name", "faces", "area", "celsius"});
        for (const Surface& surface : surfaces_) {
            const FoamPatch& patch = surface.patch;
            const volume::Label background;
            const volume::Label& label = patch.label == kNoLabel ? background : volume_.labels.labels[patch.label];
            Row row{patch.name, patch.label == kNoLabel ? "background" : patch.isAir ? "space" : "component",
                    label.id,   label.className,
                    label.name, patch.faces,
                    patch.area, Cell()};
            if (surface.celsius) row.back() = *surface.celsius;
            csv += csvLine(row);
        }
        return folder_.write("patches.csv", csv);
    }

    const SemanticVolume& volume_;
    std::vector<Surface> surfaces_;
    double mean_;  // degrees Celsius
    NewFolder& folder_;
};

void note(const VolumeWriteOptions& options, std::string message) {
    if (options.diagnostics != nullptr) options.diagnostics->add(Severity::Note, Code::Internal, std::move(message));
}

}  // namespace

Result<std::uint64_t> writeFoamCase(const SemanticVolume& volume, const std::filesystem::path& path,
                                    const VolumeWriteOptions& options) {
    NewFolder folder(path);
    SVT_DO(folder.create());
    SVT_TRY(cells, airCells(volume, options.foam.air, options.maxVoxels));
    Progress::tell(options.progress, "write", 0.1);
    SVT_DO(checkNotStopped(options.progress, "nothing"));
    SVT_TRY(patches, writeFoamMesh(volume, *cells, folder));
    SVT_DO(checkNotStopped(options.progress, "nothing"));
    SVT_TRY(surfaces, surfacesOf(volume, std::move(*patches), options.foam));
    CaseWriter writer(volume, std::move(*surfaces), folder);
    SVT_DO(writer.write());
    if (cells->leftOut > 0)
        note(options, fmt::format("voxels of air that do not touch the other {} cells are left out: {}", cells->count,
                                  cells->leftOut));
    if (writer.hasOneTemperature())
        note(
            options,
            "all surfaces have the same temperature, so the air stays at rest; give others with --surface-temperature, "
            "such as 'class=Window:12'");
    return folder.commit();
}

record::Members<FoamWriteOptions> membersOf(const FoamWriteOptions*) noexcept {
    using All = FoamWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::air>("air",
                                  "of a .foam: rooms whose air is computed; a flat or storey stands for its rooms",
                                  {.value = "QUERY", .otherwise = "all rooms", .group = "Output", .option = "--air"}),
        record::member<&All::temperatures>("temperatures",
                                           "of a .foam: temperature in degrees Celsius of the components that a query "
                                           "selects, such as 'class=Window:12'",
                                           {.value = "QUERY:C",
                                            .otherwise = "20 degrees Celsius",
                                            .group = "Output",
                                            .option = "--surface-temperature"}),
    };
    return kMembers;
}

extern const VolumeFormat kFoam{.name = "foam",
                                .endings = ".foam",
                                .holds =
                                    "case of OpenFOAM: a folder with the air of rooms as a mesh, a patch per "
                                    "component, and all that a run needs",
                                .readers = "OpenFOAM, ParaView",
                                .content = FileContent::Nothing,
                                .write = writeFoamCase};

}  // namespace svt::writers
