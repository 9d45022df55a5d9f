#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/city/city_plan.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct CityPlanArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    city::PlanOptions options;
    pipeline::BuildOptions build;  // only its options for reading, and the level of detail
    bool verbose = false, isUpdate = false;
};

Result<int> runCityPlan(CityPlanArguments& arguments) {
    city::PlanOptions& options = arguments.options;
    options.city.crs = arguments.build.read.crs;
    options.city.lod = arguments.build.lod.lod;
    options.city.axisOrder = arguments.build.read.axisOrder;
    options.city.unit = arguments.build.read.unit;
    options.city.date = arguments.build.read.date;
    options.allowTruncated = arguments.build.read.allowTruncated;
    options.program = programOfCity();
    SVT_TRY(files, city::cityInputs(arguments.inputs));
    Diagnostics diagnostics;
    std::optional<TerminalProgress> progress(std::in_place);
    options.progress = progress->get();
    city::PlanChanges changes;
    const auto plan = arguments.isUpdate ? city::updatePlan(*files, arguments.output, options, diagnostics, changes)
                                         : city::makePlan(*files, arguments.output, options, diagnostics);
    progress.reset();
    printDiagnostics(diagnostics, arguments.verbose);
    if (!plan) return plan.error();
    if (!isQuiet())
        fmt::print("{}: {} features of {} files in {} tiles and {} packs; {} replicas, {} left out; {}\n",
                   arguments.output.string(), plan->features, plan->files.size(), plan->tiles.size(), plan->packs,
                   plan->replicas, plan->skipped, plan->crsName.empty() ? "no CRS" : plan->crsName);
    if (isQuiet() || !arguments.isUpdate) return kDone;
    fmt::print("{} features are new, {} changed, {} gone; {} tiles are new, {} changed, {} gone\n", changes.newFeatures,
               changes.changedFeatures, changes.goneFeatures, changes.newTiles, changes.changedTiles,
               changes.goneTiles);
    fmt::print(
        "{} of {} packs are built, 'svt city run {}' builds the others; the city before stays readable until then\n",
        changes.keptPacks, plan->packs, arguments.output.string());
    return kDone;
}

Members<CityPlanArguments> membersOf(const CityPlanArguments*) noexcept {
    using All = CityPlanArguments;
    using city::CityOptions, city::PlanOptions;
    static const std::string kInputs = fmt::format("model files ({}, each also with .gz), and folders with such files",
                                                   fmt::join(readers::modelEndings(), ", "));
    static const Member<All> kMembers[] = {
        member<&All::inputs>("input", kInputs,
                             {.value = "FILE", .isRequired = true, .file = FileUse::Model, .isReadAgain = true}),
        member<&All::output>("-o,--output", "the folder of the city",
                             {.value = "DIR", .isRequired = true, .file = FileUse::OutputFolder}),
        member<&All::options, &PlanOptions::city, &CityOptions::spacing>(
            "--spacing", "distance between samples of the finest level",
            {.unit = "metres", .least = 0.001, .most = 100, .group = "Grid", .isForProjects = true}),
        part<&All::build>("build", "--lod|--crs|--axis-order|--unit|--date|--allow-truncated"),
        member<&All::options, &PlanOptions::mostLeftOut>(
            "--max-left-out", "end with an error if more of the features cannot be read and would be left out",
            {.unit = "percent", .least = 0, .most = 100, .group = "Model"}),
        member<&All::options, &PlanOptions::tasks>(
            "--tasks", "number of tasks for a cluster; the city does not depend on it",
            {.least = 1, .most = 1000000, .otherwise = "about 5 minutes each, up to 1000", .group = "Work"}),
        member<&All::options, &PlanOptions::city, &CityOptions::packSeconds>(
            "--pack-seconds", "expected work per pack, the smallest part that is built, verified and rebuilt",
            {.unit = "seconds", .least = 0.01, .most = 3600, .group = "Work"}),
        member<&All::isUpdate>("--update",
                               "update the plan of the folder: report changed tiles, and keep unchanged packs",
                               {.group = "Work"}),
        threadsOption<&All::options, &PlanOptions::threads>(),
        quietOption<All>(),
        verboseOption<&All::verbose>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kCityPlanCommand =
    commandOf<CityPlanArguments, runCityPlan>("city-plan", "Plan a city of many files: assign features to tiles");

}  // namespace svt::cli
