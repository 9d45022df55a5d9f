// Under Node.js, where a program cannot start others.
#include <apps/cli/city/run_packs.hpp>

namespace svt::cli {

std::vector<FailedPack> runPacks(const std::filesystem::path& folder, const city::Plan& plan, int jobs,
                                 const city::PackOptions& options, const Progress* progress) {
    static_cast<void>(jobs);
    std::vector<FailedPack> failed;
    ProgressCounter counter(progress, "build", plan.packs);
    for (std::uint32_t pack = 0; pack < plan.packs && !Progress::isCancelled(progress); ++pack) {
        const auto report = city::runPack(folder, plan, pack, options);
        if (!report) failed.push_back({pack, report.error().toString()});
        counter.add();
    }
    return failed;
}

ToolAnswer runTool(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    static_cast<void>(arguments);
    static_cast<void>(folder);
    return {127, "other programs cannot be started under Node.js"};
}

}  // namespace svt::cli
