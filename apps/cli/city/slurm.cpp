#include <apps/cli/city/engines.hpp>
#include <apps/cli/city/run_packs.hpp>
#include <apps/cli/output/json_output.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

constexpr int kAtATime = 64;  // elements of an array that run at the same time

std::filesystem::path optionsFile(const std::filesystem::path& folder) { return folder / "reports" / "slurm.json"; }

// The last line of the output of sbatch --parsable that is a job: "17" or "17;cluster".
std::string jobOf(const std::string& text) {
    std::string found;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, std::min(text.find(';', at), end) - at);
        if (!line.empty() && line.find_first_not_of("0123456789") == std::string::npos) found = line;
        at = end + 1;
    }
    return found;
}

Result<std::string> submit(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const ToolAnswer answer = runTool(arguments, folder);
    const std::string job = answer.exitCode == 0 ? jobOf(answer.text) : std::string();
    if (!job.empty()) return job;
    std::string said = answer.text;
    while (said.ends_with('\n')) said.pop_back();
    return Error(Code::TaskFailed,
                 fmt::format("sbatch did not accept the job ({}); finished packs are kept, and 'svt city run' without "
                             "--engine builds the city on this machine",
                             said.empty() ? "it is not installed, or printed nothing" : said));
}

std::vector<std::string> common(const EngineJob& job, const char* name, const char* log) {
    std::vector<std::string> arguments{"sbatch", "--parsable", fmt::format("--job-name={}", name), "--open-mode=append",
                                       fmt::format("--output={}", (job.folder / "logs" / log).string())};
    arguments.insert(arguments.end(), job.options.begin(), job.options.end());
    return arguments;
}

std::string program() { return shellQuoted(executablePath().string()); }

}  // namespace

std::string shellQuoted(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string rangesOf(const std::vector<std::uint32_t>& numbers) {
    std::string text;
    for (std::size_t n = 0; n < numbers.size();) {
        std::size_t end = n;
        while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
        text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[n]);
        if (end > n) text += fmt::format("-{}", numbers[end]);
        n = end + 1;
    }
    return text;
}

std::vector<std::uint32_t> openTasks(const city::Plan& plan, const std::vector<std::uint32_t>& missing,
                                     std::uint32_t tasks) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t task = 0; task < tasks; ++task) {
        const auto [first, last] = plan.packsOf(task, tasks);
        const auto next = std::lower_bound(missing.begin(), missing.end(), first);
        if (next != missing.end() && *next < last) open.push_back(task);
    }
    return open;
}

std::uint32_t slurmTasks(const city::Plan& plan) {
    const ToolAnswer answer = runTool({"scontrol", "show", "config"}, ".");
    constexpr std::string_view kKey = "MaxArraySize";
    const std::size_t at = answer.text.find(kKey);
    if (answer.exitCode != 0 || at == std::string::npos) return plan.tasks;
    const std::size_t digits = answer.text.find_first_of("0123456789", at + kKey.size());
    if (digits == std::string::npos) return plan.tasks;
    const std::size_t end = answer.text.find_first_not_of("0123456789", digits);
    const auto most = parseInteger<std::uint32_t>(answer.text.substr(digits, end - digits));
    return most ? std::clamp<std::uint32_t>(*most, 1, plan.tasks) : plan.tasks;
}

std::vector<std::string> slurmArray(const EngineJob& job, const std::vector<std::uint32_t>& open, std::uint32_t tasks) {
    std::vector<std::string> arguments = common(job, "svt-city", "%A_%a.txt");
    arguments.emplace_back("--requeue");
    arguments.push_back(fmt::format("--array={}%{}", rangesOf(open), kAtATime));
    arguments.push_back(fmt::format(
        "--wrap=exec {} city task {} $SLURM_ARRAY_TASK_ID --of {} --tile-seconds {} --feature-seconds {}", program(),
        shellQuoted(job.folder.string()), tasks, job.packs.tileSeconds, job.packs.featureSeconds));
    return arguments;
}

std::vector<std::string> slurmMerge(const EngineJob& job, const std::string& array) {
    std::vector<std::string> arguments = common(job, "svt-city-merge", "merge_%j.txt");
    arguments.emplace_back("--requeue");
    // Also after failed tasks, so that the finished packs can be used and the missing ones are listed.
    arguments.push_back(fmt::format("--dependency=afterany:{}", array));
    arguments.push_back(fmt::format("--wrap=exec {} city merge {}", program(), shellQuoted(job.folder.string())));
    return arguments;
}

Result<SlurmJobs> submitToSlurm(const EngineJob& job, const std::vector<std::uint32_t>& open, std::uint32_t tasks) {
    std::error_code failed;
    std::filesystem::create_directories(job.folder / "logs", failed);
    if (failed) return Error(Code::CannotWrite, "the folder of logs cannot be made", {job.folder.string(), 0, 0, {}});
    SVT_TRY(array, submit(slurmArray(job, open, tasks), job.folder));
    const auto merge = submit(slurmMerge(job, *array), job.folder);
    if (!merge)
        return Error(merge.error().code(),
                     fmt::format("the tasks are submitted as job {}, but not their merge: {}; when they are done, run "
                                 "'svt city merge {}'",
                                 *array, merge.error().message(), shellQuoted(job.folder.string())));
    return SlurmJobs{*array, *merge};
}

Result<void> keepOptions(const EngineJob& job, const SlurmJobs& jobs) {
    std::error_code ignored;
    std::filesystem::create_directories(job.folder / "reports", ignored);
    const Json json{
        {"format", "svt-city-slurm"}, {"options", job.options}, {"array", jobs.array}, {"merge", jobs.merge}};
    SVT_DO(
        writeFileAtomically(optionsFile(job.folder), json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"));
    return {};
}

std::string resubmitLine(const std::filesystem::path& folder) {
    std::string line = fmt::format("svt city run {}", shellQuoted(folder.string()));
    const auto file = FileBytes::read(optionsFile(folder), 1 << 20);
    if (!file) return line;
    const Json json = Json::parse(file->text(), nullptr, false);
    if (!json.is_object() || !json.contains("options") || !json["options"].is_array()) return line;
    line += " --engine slurm";
    if (!json["options"].empty()) line += " --";
    for (const Json& option : json["options"])
        if (option.is_string()) line += " " + shellQuoted(option.get<std::string>());
    return line;
}

}  // namespace svt::cli
