#include <apps/cli/city/engines.hpp>
#include <apps/cli/city/run_packs.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/city/city_folder.hpp>
#include <svt/city/city_plan.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

enum class Engine : std::uint8_t { Local, Slurm, Kubernetes };
constexpr auto namesOf(Engine) {
    using enum Engine;
    return std::to_array<Name<Engine>>({{Local, "local"}, {Slurm, "slurm"}, {Kubernetes, "kubernetes"}});
}

struct CityRunArguments {
    std::filesystem::path folder;
    city::PackOptions packs;
    int jobs = 0;
    bool isPrinted = false;
    Engine engine = Engine::Local;
    std::vector<std::string> options;
};

struct CityTaskArguments {
    std::filesystem::path folder;
    city::PackOptions packs;
    std::uint32_t task = 0, tasks = 0;
};

struct CityStatusArguments {
    std::filesystem::path folder;
    bool json = false, isProven = false;
};

struct CityMergeArguments {
    std::filesystem::path folder;
};

void tellSkipped(const std::vector<city::SkippedFeature>& skipped) {
    constexpr std::size_t kShown = 12;
    Diagnostics findings;
    for (const city::SkippedFeature& feature : skipped)
        findings.add(Severity::Warning, Code::FeatureSkipped,
                     fmt::format("the feature at byte {} is left out: {}", feature.begin, feature.reason),
                     {feature.file, 0, 0, {}});
    printDiagnostics(findings, skipped.size() <= kShown);
}

// Prints the reasons of the first failures; tellMissing() lists all missing packs.
void tellFailed(const std::vector<FailedPack>& failed) {
    constexpr std::size_t kShown = 8;
    for (std::size_t n = 0; n < std::min(kShown, failed.size()); ++n) {
        std::string_view why = failed[n].messages;
        while (why.ends_with('\n')) why.remove_suffix(1);
        note(fmt::format("pack {}: {}", failed[n].pack, why));
    }
    if (failed.size() > kShown) note(fmt::format("{} more packs failed", failed.size() - kShown));
}

Result<int> tellMissing(const std::filesystem::path& folder, const city::CityStatus& status) {
    if (status.missing.empty()) return kDone;
    return Error(Code::CityIncomplete,
                 fmt::format("{} of {} packs are not done: {}; 'svt city run {}' builds them", status.missing.size(),
                             status.packs, rangesOf(status.missing), folder.string()),
                 {folder.string(), 0, 0, {}});
}

void printCall(const std::vector<std::string>& call) {
    for (std::size_t n = 0; n < call.size(); ++n) fmt::print("{}{}", n == 0 ? "" : " ", shellQuoted(call[n]));
    fmt::print("\n");
}

Result<int> runSlurm(const CityRunArguments& arguments, const EngineJob& job, const city::Plan& plan) {
    const city::CityStatus status = city::cityStatus(arguments.folder, plan, false);
    const std::uint32_t tasks = slurmTasks(plan);
    const std::vector<std::uint32_t> open = openTasks(plan, status.missing, tasks);
    if (arguments.isPrinted) {
        printCall(slurmArray(job, open, tasks));
        printCall(slurmMerge(job, "ID"));
        return kDone;
    }
    if (open.empty()) {
        note("all packs are done; 'svt city merge' makes their index");
        return kDone;
    }
    SVT_TRY(jobs, submitToSlurm(job, open, tasks));
    SVT_DO(keepOptions(job, *jobs));
    if (!isQuiet())
        fmt::print("{} of {} tasks as job {}, their merge as job {}; logs in {}\n", open.size(), tasks, jobs->array,
                   jobs->merge, (job.folder / "logs").string());
    return kDone;
}

Result<int> runEngine(const CityRunArguments& arguments, const city::Plan& plan) {
    std::error_code failed;
    const EngineJob job{std::filesystem::absolute(arguments.folder, failed).lexically_normal(), arguments.options,
                        arguments.packs};
    if (arguments.engine == Engine::Slurm) return runSlurm(arguments, job, plan);
    if (!arguments.isPrinted)
        return Error(Code::BadArgument,
                     "--engine kubernetes needs --print: the job is printed as YAML for 'kubectl apply -f -'");
    SVT_TRY(yaml, kubernetesJobs(job, plan));
    fmt::print("{}", *yaml);
    return kDone;
}

Result<int> runCityRun(const CityRunArguments& arguments) {
    SVT_TRY(plan, city::readPlan(arguments.folder, programOfCity()));
    SVT_DO(city::publishUpdate(arguments.folder));
    if (arguments.engine != Engine::Local) return runEngine(arguments, *plan);
    if (!arguments.options.empty() || arguments.isPrinted)
        return Error(Code::BadArgument, "--print and options after -- need --engine slurm or kubernetes");
    std::optional<TerminalProgress> progress(std::in_place);
    const auto failed = runPacks(arguments.folder, *plan, arguments.jobs, arguments.packs, progress->get());
    if (Progress::isCancelled(progress->get()))
        return Error(Code::Cancelled, "stopped; finished packs stay, and the same command continues from there");
    // Also after failures, so that the finished packs can be used.
    const auto merged = city::mergeCity(arguments.folder, *plan, arguments.jobs, progress->get());
    progress.reset();
    tellFailed(failed);
    if (!merged) return merged.error();
    tellSkipped(merged->skipped);
    if (!isQuiet())
        fmt::print("{}: {} buildings in {} of {} packs, {:.1f} MB; {} features left out\n", arguments.folder.string(),
                   merged->buildings, merged->packs - merged->missing.size(), merged->packs,
                   double(merged->bytes) / 1e6, merged->skipped.size() + plan->skipped);
    return tellMissing(arguments.folder, *merged);
}

Result<int> runCityTask(const CityTaskArguments& arguments) {
    SVT_TRY(plan, city::readPlan(arguments.folder, programOfCity()));
    const std::uint32_t tasks = arguments.tasks == 0 ? plan->tasks : arguments.tasks;
    if (arguments.task >= tasks)
        return Error(Code::BadArgument,
                     fmt::format("task {}: there are {} tasks, numbered from 0", arguments.task, tasks));
    int worst = kDone;
    const auto [first, last] = plan->packsOf(arguments.task, tasks);
    for (std::uint32_t pack = first; pack < last; ++pack) {
        const auto report = city::runPack(arguments.folder, *plan, pack, arguments.packs);
        if (!report) {
            worst = fail(report.error());
            continue;  // the others do not depend on it
        }
        if (!isQuiet())
            fmt::print("pack {}: {} buildings, {:.2f} MB, {} features left out\n", pack, report->buildings,
                       double(report->bytes) / 1e6, report->skipped.size());
    }
    return worst;
}

Result<int> runCityMerge(const CityMergeArguments& arguments) {
    SVT_TRY(plan, city::readPlan(arguments.folder, programOfCity()));
    SVT_TRY(merged, city::mergeCity(arguments.folder, *plan));
    if (!isQuiet())
        fmt::print("{}: {} buildings in {} of {} packs\n", arguments.folder.string(), merged->buildings,
                   merged->packs - merged->missing.size(), merged->packs);
    return tellMissing(arguments.folder, *merged);
}

// Names the removed and changed source files.
void tellChanged(const std::filesystem::path& folder, const std::vector<city::ChangedInput>& changed) {
    constexpr std::size_t kShown = 12;
    if (changed.empty()) return;
    for (std::size_t n = 0; n < std::min(kShown, changed.size()); ++n)
        fmt::print("{} since the plan: {}\n", changed[n].isRemoved ? "removed" : "changed", changed[n].path);
    if (changed.size() > kShown) fmt::print("{} more source files\n", changed.size() - kShown);
    fmt::print("'svt city plan FILES -o {} --update' with the same options plans the city again\n", folder.string());
}

Result<int> runCityStatus(const CityStatusArguments& arguments) {
    SVT_TRY(plan, city::readPlan(arguments.folder, {}));
    SVT_TRY(changed, city::changedInputs(arguments.folder, *plan, arguments.isProven));
    const city::CityStatus status = city::cityStatus(arguments.folder, *plan, arguments.isProven);
    if (arguments.json) {
        Json json{{"packs", status.packs},        {"tasks", plan->tasks},          {"missing", status.missing},
                  {"bytes", status.bytes},        {"buildings", status.buildings}, {"features", plan->features},
                  {"replicas", plan->replicas},   {"skipped", Json::array()},      {"isUpdate", status.isUpdate},
                  {"changedFiles", Json::array()}};
        for (const city::ChangedInput& input : *changed)
            json["changedFiles"].push_back({{"file", input.path}, {"isRemoved", input.isRemoved}});
        for (const city::SkippedFeature& feature : status.skipped)
            json["skipped"].push_back({{"file", feature.file}, {"begin", feature.begin}, {"reason", feature.reason}});
        print(json);
        return kDone;
    }
    fmt::print("{} of {} packs are done: {} buildings of {} features, {:.1f} MB; {} features left out\n",
               status.packs - status.missing.size(), status.packs, status.buildings, plan->features,
               double(status.bytes) / 1e6, status.skipped.size());
    if (!status.missing.empty())
        fmt::print("missing: {}\n{}\n", rangesOf(status.missing), resubmitLine(arguments.folder));
    if (status.isUpdate) fmt::print("this is an update: the city before it stays readable until all packs are done\n");
    tellChanged(arguments.folder, *changed);
    tellSkipped(status.skipped);
    return kDone;
}

template <class All>
constexpr auto tileSeconds() {
    return member<&All::packs, &city::PackOptions::tileSeconds>(
        "--tile-seconds", "time limit of a tile; over it, its features are tried one by one",
        {.unit = "seconds", .least = 0.1, .most = 1000000, .group = "Limits"});
}
template <class All>
constexpr auto featureSeconds() {
    return member<&All::packs, &city::PackOptions::featureSeconds>(
        "--feature-seconds", "time limit of a feature that is built by itself; a feature over it is left out",
        {.unit = "seconds", .least = 0.1, .most = 1000000, .group = "Limits"});
}

Members<CityRunArguments> membersOf(const CityRunArguments*) noexcept {
    using All = CityRunArguments;
    static constexpr Member<All> kMembers[] = {
        cityFolder<&All::folder>(),
        member<&All::options>("options",
                              "after --: with slurm, options of sbatch, such as --partition=batch; with kubernetes, "
                              "image=, claim=, mount=, namespace=, cpu=, memory=, parallelism=",
                              {.value = "OPTION"}),
        member<&All::engine>(
            "--engine",
            "place of the build: this machine; a job array of Slurm; an Indexed Job of Kubernetes, which is printed",
            {.group = "Work"}),
        member<&All::isPrinted>("--print", "print the jobs instead of submitting them", {.group = "Work"}),
        member<&All::jobs>("--jobs", "number of packs that are built at the same time; the city does not depend on it",
                           {.least = 0, .most = 1024, .otherwise = "one per core", .group = "Work"}),
        tileSeconds<All>(),
        featureSeconds<All>(),
        quietOption<All>(),
    };
    return kMembers;
}

Members<CityTaskArguments> membersOf(const CityTaskArguments*) noexcept {
    using All = CityTaskArguments;
    static constexpr Member<All> kMembers[] = {
        cityFolder<&All::folder>(),
        member<&All::task>("task", "number of the task, from 0", {.least = 0, .isRequired = true}),
        member<&All::tasks>("--of", "number of tasks; each builds its share of the packs",
                            {.least = 1, .otherwise = "that of the plan", .group = "Work"}),
        member<&All::packs, &city::PackOptions::threads>(
            "--threads", "number of threads, 0 for all cores; the result does not depend on it",
            {.least = 0, .most = 1024, .group = "Work", .isForProjects = true}),
        tileSeconds<All>(),
        featureSeconds<All>(),
        quietOption<All>(),
    };
    return kMembers;
}

Members<CityStatusArguments> membersOf(const CityStatusArguments*) noexcept {
    using All = CityStatusArguments;
    static constexpr Member<All> kMembers[] = {
        cityFolder<&All::folder>(),
        jsonOption<&All::json>(),
        member<&All::isProven>("--proven",
                               "read all packs and compare their SHA-256 with the reports, not only their sizes"),
        quietOption<All>(),
    };
    return kMembers;
}

Members<CityMergeArguments> membersOf(const CityMergeArguments*) noexcept {
    using All = CityMergeArguments;
    static constexpr Member<All> kMembers[] = {cityFolder<&All::folder>(), quietOption<All>()};
    return kMembers;
}

}  // namespace

extern const CommandText kCityRunCommand =
    commandOf<CityRunArguments, runCityRun>("city-run", "Build the missing packs of a city, and merge them");
extern const CommandText kCityTaskCommand =
    commandOf<CityTaskArguments, runCityTask>("city-task", "Build one task's share of a city");
extern const CommandText kCityStatusCommand =
    commandOf<CityStatusArguments, runCityStatus>("city-status", "Report the built part of a city, and the next step");
extern const CommandText kCityMergeCommand =
    commandOf<CityMergeArguments, runCityMerge>("city-merge", "Make the index of all finished packs of a city");

}  // namespace svt::cli
