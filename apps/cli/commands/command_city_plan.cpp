#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/city/city_plan.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct CityPlanArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    city::PlanOptions options;
    std::string crs;
    bool verbose = false, isUpdate = false;
};

int runCityPlan(CityPlanArguments& arguments) {
    const auto crs = parseCrs(arguments.crs);
    if (!crs) return fail(crs.error());
    city::PlanOptions& options = arguments.options;
    options.city.crs = *crs;
    options.program = programOfCity();
    const auto files = city::cityInputs(arguments.inputs);
    if (!files) return fail(files.error());
    Diagnostics diagnostics;
    std::optional<TerminalProgress> progress(std::in_place);
    options.progress = progress->get();
    city::PlanChanges changes;
    const auto plan = arguments.isUpdate ? city::updatePlan(*files, arguments.output, options, diagnostics, changes)
                                         : city::makePlan(*files, arguments.output, options, diagnostics);
    progress.reset();
    printDiagnostics(diagnostics, arguments.verbose);
    if (!plan) return fail(plan.error());
    if (!isQuiet())
        fmt::print("{}: {} features of {} files in {} tiles and {} packs; {} replicas, {} left out; {}\n",
                   arguments.output.string(), plan->features, plan->files.size(), plan->tiles.size(), plan->packs,
                   plan->replicas, plan->skipped, plan->crsName.empty() ? "no CRS" : plan->crsName);
    if (!isQuiet() && arguments.isUpdate)
        fmt::print(
            "{} features are new or changed, {} gone; {} tiles are new, {} changed, {} gone; {} of {} packs are "
            "built, 'svt city run {}' builds the others\n",
            changes.newFeatures, changes.goneFeatures, changes.newTiles, changes.changedTiles, changes.goneTiles,
            changes.keptPacks, plan->packs, arguments.output.string());
    return kDone;
}

}  // namespace

namespace {

constexpr Option kCityPlan[] = {
    {.name = "input",
     .value = "FILE",
     .help = kModelFiles,
     .isRequired = true,
     .mayRepeat = true,
     .file = FileUse::Model},
    {.name = "-o,--output",
     .value = "DIR",
     .help = "the folder of the city",
     .isRequired = true,
     .file = FileUse::OutputFolder},
    {.name = "--spacing",
     .kind = Number,
     .unit = "metres",
     .least = 0.001,
     .most = 100,
     .byDefault = "0.5",
     .help = "distance of samples of the finest level",
     .group = "Grid"},
    kModel[0],
    kModel[2],
    kModel[5],
    {.name = "--tasks",
     .kind = Whole,
     .least = 1,
     .most = 1000000,
     .otherwise = "some 5 minutes each, at most 1000",
     .help = "number of tasks that a cluster is to run; the city does not depend on it",
     .group = "Work"},
    {.name = "--pack-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.01,
     .most = 3600,
     .byDefault = "10",
     .help = "expected work in a pack, the smallest part that is built, proven and built again",
     .group = "Work"},
    {.name = "--update",
     .kind = Flag,
     .help = "the folder has a plan: say which tiles change, and keep packs whose content stays",
     .group = "Work"},
};

Action connectCityPlan(Command& command) {
    auto arguments = std::make_shared<CityPlanArguments>();
    command.set("input", arguments->inputs);
    command.set("--output", arguments->output);
    command.set("--spacing", arguments->options.city.spacing);
    command.set("--lod", arguments->options.city.lod);
    command.set("--crs", arguments->crs);
    command.set("--allow-truncated", arguments->options.allowTruncated);
    command.set("--tasks", arguments->options.tasks);
    command.set("--pack-seconds", arguments->options.city.packSeconds);
    command.set("--update", arguments->isUpdate);
    command.set("--threads", arguments->options.threads);
    command.set("--verbose", arguments->verbose);
    return [arguments] { return runCityPlan(*arguments); };
}

}  // namespace

extern const CommandText kCityPlanCommand{.name = "city-plan",
                                          .help = "Plan a city of many files: which features make which tiles",
                                          .sets = {kCityPlan, kThreads, kQuiet, kVerbose},
                                          .connect = connectCityPlan};

}  // namespace svt::cli
