#include <apps/cli/city/run_packs.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/serve/child_process.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace svt::cli {
namespace {

// A process ends its own task if that hangs. These limits are high enough to have no effect.
constexpr serve::ChildLimits kNoLimits{std::uint64_t{1} << 46, 30.0 * 24 * 3600, std::uint64_t{1} << 46};

}  // namespace

std::vector<FailedPack> runPacks(const std::filesystem::path& folder, const city::Plan& plan, int jobs,
                                 const city::PackOptions& options, const Progress* progress) {
    const std::string program = executablePath().string(), where = std::filesystem::absolute(folder).string();
    const auto workers = static_cast<std::uint32_t>(std::max(1, jobs != 0 ? jobs : machineCores().value_or(1)));
    std::atomic<std::uint32_t> next{0};
    std::mutex mutex;
    std::vector<FailedPack> failed;
    ProgressCounter counter(progress, "build", plan.packs);
    const Progress none;
    const auto work = [&] {
        for (std::uint32_t pack = next++; pack < plan.packs && !Progress::isCancelled(progress); pack = next++) {
            const serve::ChildResult result = runChild(
                {program, "city-task", where, std::to_string(pack), "--of", std::to_string(plan.packs), "--threads",
                 std::to_string(options.threads), "--tile-seconds", fmt::format("{}", options.tileSeconds),
                 "--feature-seconds", fmt::format("{}", options.featureSeconds), "--quiet", "--no-config"},
                folder, kNoLimits, progress == nullptr ? none : *progress);
            counter.add();
            if (result.exitCode == 0) continue;
            const std::lock_guard lock(mutex);
            failed.push_back(
                {pack, result.messages.empty() ? fmt::format("ended by signal {}", result.signal) : result.messages});
        }
    };
    std::vector<std::thread> threads;
    for (std::uint32_t n = 1; n < std::min(workers, plan.packs); ++n) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    std::sort(failed.begin(), failed.end(), [](const FailedPack& a, const FailedPack& b) { return a.pack < b.pack; });
    return failed;
}

ToolAnswer runTool(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    // The shell finds the program, and redirects stdout to stderr, which runChild() stores.
    std::vector<std::string> call{"/bin/sh", "-c", "exec \"$@\" >&2", "sh"};
    call.insert(call.end(), arguments.begin(), arguments.end());
    const serve::ChildResult result = runChild(call, folder, kNoLimits, Progress());
    return {result.exitCode, result.messages};
}

}  // namespace svt::cli
