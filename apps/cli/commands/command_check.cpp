#include <apps/cli/check/check_reports.hpp>
#include <apps/cli/check/feature_batches.hpp>
#include <apps/cli/check/unit_findings.hpp>
#include <apps/cli/check/use_findings.hpp>
#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <optional>

namespace svt::cli {
namespace {

enum class ReportFormat : std::uint8_t { Text, Json, Val3dity };
constexpr auto namesOf(ReportFormat) {
    using enum ReportFormat;
    return std::to_array<Name<ReportFormat>>({{Text, "text"}, {Json, "json"}, {Val3dity, "val3dity"}});
}

struct CheckArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path report;
    ReportFormat format = ReportFormat::Text;
    validate::ValidateOptions validation;
    pipeline::BuildOptions build;  // only its options for reading, the level of detail and the limit of memory
    bool json = false, verbose = false, strict = false;
};

// The reason why the volume of an object is unknown although its mesh is closed; Internal: it is known. An invalid
// polygon does not change the volume of the closed mesh.
Code whyNoVolume(const model::BuildingModel& model, const validate::ValidationReport& report,
                 const mesh::ObjectMesh& object) {
    const model::Feature& feature = model.features[object.feature];
    for (std::size_t g = 0; g < feature.geometries.size(); ++g) {
        if (feature.geometries[g].lod != object.lod) continue;
        const auto found = report.volumes.find({object.feature, static_cast<int>(g)});
        if (found == report.volumes.end() || found->second.volume) continue;
        const Code reason = found->second.reason;
        const bool isClosedAnew = reason == Code::TriangulationFailed || reason == Code::ShellNotClosed ||
                                  reason == Code::TJunction || reason == Code::FaceTurnedOver;
        // Bodies that touch along an edge, or lie apart, enclose a definite volume if no edge leaks.
        const bool isTouching = reason == Code::NonManifold || reason == Code::ShellDisconnected;
        if (!isClosedAnew && !(isTouching && object.leakCount == 0)) return reason;
    }
    return Code::Internal;
}

Json objectJson(const model::BuildingModel& model, const mesh::MeshSet& scene, const mesh::ObjectMesh& object,
                const validate::ValidationReport& report) {
    const model::Feature& feature = model.features[object.feature];
    Json json{{"id", feature.id}, {"class", feature.className}, {"name", feature.name}};
    if (feature.line != 0) json["line"] = feature.line;
    if (object.lod >= 0) json["lod"] = object.lod;
    json["closingMethod"] = mesh::closingMethodName(object.closingMethod);
    json["closure"] = json["closingMethod"];  // deprecated
    json["closed"] = object.leakCount == 0 && object.isSolid();
    json["triangles"] = object.triangles.size();
    json["unmatchedEdges"] = object.unmatchedEdges;
    json["tJunctions"] = object.tJunctionCount;
    json["leakingEdges"] = object.leakCount;
    json["leaks"] = Json::array();
    for (const Vec3d& leak : object.leaks) json["leaks"].push_back(toJson(leak + scene.origin));
    json["stillOpenEdges"] = object.openEdges.size();
    json["flippedFaces"] = object.flippedFaces;
    json["complementedFaces"] = object.complementedFaces;
    json["caps"] = Json::array();
    for (const mesh::Cap& cap : object.caps)
        json["caps"].push_back({{"area", cap.area}, {"center", toJson(cap.center + scene.origin)}});
    json["assembled"] = object.isAssembled;
    const Code reason = whyNoVolume(model, report, object);
    json["volume"] = object.isSolid() && reason == Code::Internal ? Json(object.volume) : Json(nullptr);
    if (object.isSolid() && reason != Code::Internal) json["volumeReason"] = codeTag(reason);
    json["area"] = object.area;
    return json;
}

void printObject(const model::BuildingModel& model, const mesh::MeshSet& scene, const mesh::ObjectMesh& object,
                 const validate::ValidationReport& report, std::FILE* to) {
    const model::Feature& feature = model.features[object.feature];
    fmt::print(to, "{:<28} {:<13}", feature.className, mesh::closingMethodName(object.closingMethod));
    const Code reason = whyNoVolume(model, report, object);
    if (object.isSolid() && reason != Code::Internal)
        fmt::print(to, " {:>15}", "no volume, " + codeTag(reason));
    else if (object.isSolid())
        fmt::print(to, " {:>12.3f} m3", object.volume);
    else
        fmt::print(to, " {:>12.3f} m2", object.area);
    fmt::print(to, "  {}{}{}\n", feature.name, feature.name.empty() ? "" : "  ", feature.id);
    if (object.leakCount != 0 && object.closingMethod != mesh::ClosingMethod::Surface) {
        fmt::print(to, "    {} unmatched edges, {} of them leak", object.unmatchedEdges, object.leakCount);
        for (std::size_t i = 0; i < std::min<std::size_t>(object.leaks.size(), 4); ++i) {
            const Vec3d at = object.leaks[i] + scene.origin;
            fmt::print(to, "{} ({:.3f}, {:.3f}, {:.3f})", i == 0 ? " at" : ",", at.x, at.y, at.z);
        }
        fmt::print(to, "{}\n", object.leaks.size() > 4 ? ", ..." : "");
    }
    for (const mesh::Cap& cap : object.caps) {
        const Vec3d at = cap.center + scene.origin;
        fmt::print(to, "    capped by a ClosureSurface of {:.4f} m2 at ({:.3f}, {:.3f}, {:.3f})\n", cap.area, at.x,
                   at.y, at.z);
    }
    if (object.complementedFaces != 0)
        fmt::print(to, "    completed with {} faces of adjoining features\n", object.complementedFaces);
    if (object.tJunctionCount != 0)
        fmt::print(to, "    {} edges match only up to T-junctions (tight)\n", object.tJunctionCount);
}

void printJson(const Checked& checked, const mesh::MeshSet& scene, const Diagnostics& diagnostics) {
    std::size_t leaking = 0, solids = 0, tight = 0;
    Json json;
    json["objects"] = Json::array();
    for (const mesh::ObjectMesh& object : scene.objects) {
        json["objects"].push_back(objectJson(checked.model, scene, object, checked.report));
        if (object.closingMethod == mesh::ClosingMethod::Surface) continue;
        ++solids;
        leaking += object.leakCount != 0;
        tight += object.closingMethod == mesh::ClosingMethod::TJunctions;
    }
    json["solids"] = solids;
    json["leaking"] = leaking;
    json["tJunctions"] = tight;
    addValidationJson(json, checked);
    json["legalUnits"] = checked.units;
    json["usable"] = !preventsUse(diagnostics);
    json["diagnostics"] = diagnosticsJson(diagnostics);
    for (std::size_t i = 0; i < diagnostics.items().size(); ++i)
        json["diagnostics"][i]["preventsUse"] = preventsUse(diagnostics.items()[i]);
    print(json);
}

// The totals in the last lines of the text.
struct Totals {
    std::size_t objects = 0, solids = 0, leaking = 0, tight = 0, geometries = 0, valid = 0, polygons = 0;
};

void printObjects(const Checked& checked, Totals& totals, std::FILE* to) {
    totals.objects += checked.meshes.objects.size();
    for (const mesh::ObjectMesh& object : checked.meshes.objects) {
        printObject(checked.model, checked.meshes, object, checked.report, to);
        if (object.closingMethod == mesh::ClosingMethod::Surface) continue;
        ++totals.solids;
        totals.leaking += object.leakCount != 0;
        totals.tight += object.closingMethod == mesh::ClosingMethod::TJunctions;
    }
    for (const auto& entry : checked.report.primitives) {
        totals.geometries += entry.second.total;
        totals.valid += entry.second.valid;
    }
    totals.polygons += checked.report.polygonCount;
}

void printTotals(const Totals& totals) {
    fmt::print(resultStream(), "{} objects: {} solids, {} of them leak as read, {} are tight up to T-junctions\n",
               totals.objects, totals.solids, totals.leaking, totals.tight);
    fmt::print(resultStream(), "{} geometries of {} polygons: {} are valid\n", totals.geometries, totals.polygons,
               totals.valid);
}

// Runs the tests by ISO 19107, then builds the meshes of the same model. Findings of both go to `diagnostics`.
Result<void> checkModel(const model::BuildingModel& model, const CheckArguments& arguments, const Progress* progress,
                        Diagnostics& diagnostics, const std::function<Result<void>(const Checked&)>& use) {
    validate::ValidateOptions validation = arguments.validation;
    validation.lod = arguments.build.lod.lod;
    validation.progress = progress;
    SVT_TRY(report, validate::validateModel(model, validation));
    mesh::MeshOptions options;
    options.lod = arguments.build.lod;
    options.progress = progress;
    SVT_TRY(scene, mesh::buildMeshes(model, options, &diagnostics));
    pipeline::BuildOptions build = arguments.build;
    build.progress = progress;
    Json units = checkUnits(model, build, validation.overlap, diagnostics);
    const Diagnostics others = diagnostics;
    const Checked checked{model, *report, validation, *scene, others, std::move(units)};
    addFindings(diagnostics, checked);
    return use(checked);
}

// A temporary file that is deleted when it is closed.
class TemporaryText {
public:
    TemporaryText() : file_(std::tmpfile()) {}
    ~TemporaryText() {
        if (file_ != nullptr) static_cast<void>(std::fclose(file_));
    }
    TemporaryText(const TemporaryText&) = delete;
    TemporaryText& operator=(const TemporaryText&) = delete;
    [[nodiscard]] std::FILE* get() const noexcept { return file_; }
    // Copies the file to stdout; false if the file is incomplete, as on a full disk.
    [[nodiscard]] bool print() const {
        if (std::fflush(file_) != 0 || std::ferror(file_) != 0) return false;
        std::rewind(file_);
        char buffer[1 << 16];
        for (std::size_t size = 0; (size = std::fread(buffer, 1, sizeof buffer, file_)) != 0;)
            if (std::fwrite(buffer, 1, size, stdout) != size)
                return true;  // the reader of stdout is gone: not an error of the file
        return std::ferror(file_) == 0;
    }

private:
    std::FILE* file_;
};

// Checks a large file batch by batch. The lines of its objects wait in a temporary file until it is known that no
// feature refers to another.
Result<bool> checkInBatches(const CheckArguments& arguments, const readers::ReadOptions& reading,
                            const std::function<void()>& endProgress, Diagnostics& diagnostics) {
    const TemporaryText lines;
    if (lines.get() == nullptr) return false;
    Totals totals;
    Diagnostics all;
    const auto done =
        forEachBatch(arguments.inputs.front(), reading, [&](const model::BuildingModel& model, Diagnostics& findings) {
            auto checked = checkModel(model, arguments, nullptr, findings, [&](const Checked& batch) {
                printObjects(batch, totals, lines.get());
                return Result<void>();
            });
            if (checked) all.append(findings);
            return checked;
        });
    if (!done) return done.error();
    if (!*done) return false;
    endProgress();
    if (!lines.print()) return Error(Code::DiskFull, "no space is left for temporary files in /tmp");
    printTotals(totals);
    diagnostics.append(all);
    return true;
}

// The report of val3dity counts every violation, as val3dity does.
int exitCodeFor(const CheckArguments& arguments, const Diagnostics& diagnostics) {
    const bool isStrict = arguments.strict || arguments.format == ReportFormat::Val3dity;
    const bool isFlawed = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error) != 0;
    return isStrict ? (isFlawed ? kInvalid : kDone) : (preventsUse(diagnostics) ? kInvalid : kDone);
}

Result<void> report(const CheckArguments& arguments, const Checked& checked, const Diagnostics& diagnostics) {
    const std::string inputFile = shownText(arguments.inputs.front().string());
    if (!arguments.report.empty()) {
        SVT_TRY(written, writeFileAtomically(arguments.report, htmlReport(checked, inputFile)));
    }
    if (arguments.format == ReportFormat::Val3dity) {
        print(val3dityJson(checked, inputFile));
    } else if (arguments.json || arguments.format == ReportFormat::Json) {
        printJson(checked, checked.meshes, diagnostics);
    } else {
        Totals totals;
        printObjects(checked, totals, resultStream());
        printTotals(totals);
    }
    return {};
}

Result<int> runCheck(const CheckArguments& arguments) {
    if (std::ranges::any_of(arguments.inputs, isCity)) {
        if (arguments.inputs.size() > 1)
            return Error(Code::BadArgument, "a city cannot be checked together with other inputs; check it separately");
        const validate::ValidateOptions usual;
        if (arguments.json || arguments.strict || arguments.format != ReportFormat::Text || !arguments.report.empty() ||
            arguments.validation.planarity != usual.planarity || arguments.validation.overlap != usual.overlap)
            return Error(Code::BadArgument,
                         "the check of a city tests its tiles and prints text; --json, --format, --report, --strict, "
                         "--planarity and --overlap are for models");
        return checkCity(arguments.inputs[0]);
    }
    Diagnostics diagnostics;
    std::optional<TerminalProgress> progress(std::in_place);
    const auto stop = [&](const Error& error) {
        progress.reset();
        printDiagnostics(diagnostics, arguments.verbose);
        return error;
    };
    readers::ReadOptions reading = arguments.build.read;
    reading.progress = progress->get();
    const bool isText = !arguments.json && arguments.format == ReportFormat::Text;
    if (isText && arguments.report.empty() && arguments.inputs.size() == 1 && isWorthBatches(arguments.inputs[0])) {
        const auto done = checkInBatches(
            arguments, reading, [&] { progress.reset(); }, diagnostics);
        if (!done) return stop(done.error());
        if (*done) {
            printByUse(diagnostics, arguments.verbose);
            return exitCodeFor(arguments, diagnostics);
        }
    }
    const auto model = readers::readModels(arguments.inputs, reading, &diagnostics);
    if (!model) return stop(model.error());
    const auto checked = checkModel(*model, arguments, progress->get(), diagnostics, [&](const Checked& whole) {
        progress.reset();
        return report(arguments, whole, diagnostics);
    });
    if (!checked) return stop(checked.error());
    if (isText) printByUse(diagnostics, arguments.verbose);
    return exitCodeFor(arguments, diagnostics);
}

Members<CheckArguments> membersOf(const CheckArguments*) noexcept {
    using All = CheckArguments;
    using validate::ValidateOptions;
    static constexpr Member<All> kMembers[] = {
        member<&All::inputs>("input", "model files, or a city: its folder or address",
                             {.value = "FILE", .isRequired = true, .file = FileUse::Model}),
        part<&All::build>(
            "build",
            "--lod|--crs|--axis-order|--unit|--date|--keep-far-features|--extrude-footprints|--allow-truncated"),
        member<&All::validation, &ValidateOptions::planarity>(
            "--planarity", "maximum distance of a point from the plane of its polygon",
            {.unit = "m", .least = 1e-6, .most = 1000, .group = "Tolerances", .isForProjects = true}),
        member<&All::validation, &ValidateOptions::overlap>(
            "--overlap", "tolerate overlaps of solids up to twice this distance",
            {.unit = "m",
             .least = 0,
             .most = 1000,
             .otherwise = "solids that overlap by more than 1 mm are reported",
             .group = "Tolerances",
             .isForProjects = true}),
        member<&All::report>("--report", "also write a page with counts, findings and a picture of each defect",
                             {.value = "R.html", .group = "Output", .file = FileUse::Output, .formats = "html"}),
        member<&All::format>("--format", "format on stdout: text, JSON, or the JSON report of val3dity",
                             {.group = "Output"}),
        member<&All::strict>("--strict", "exit 4 at any warning, also if it does not prevent the use of the model",
                             {.group = "Output"}),
        jsonOption<&All::json>(),
        part<&All::build>("build", "--memory"),
        quietOption<All>(),
        verboseOption<&All::verbose>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kCheckCommand = commandOf<CheckArguments, runCheck>(
    "check", "Test a model: open shells, dangling links, bad faces; exit 4 if a defect prevents its use");

}  // namespace svt::cli
