#pragma once
/// \file
/// Builds the packs of a city on this machine.

#include <svt/city/city_pack.hpp>
#include <svt/city/city_plan.hpp>
#include <svt/core/progress.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::cli {

/// A pack that could not be built.
struct FailedPack {
    std::uint32_t pack = 0;
    std::string messages;  ///< the output of its process
};

/// Builds all packs of the plan, each in a separate process (`svt city-task`), `jobs` at a time. If no process can be
/// started, builds them one by one in this process.
/// \param jobs  0: one per core
/// \return the failed packs, in order
[[nodiscard]] std::vector<FailedPack> runPacks(const std::filesystem::path& folder, const city::Plan& plan, int jobs,
                                               const city::PackOptions& options, const Progress* progress);

/// The result of another program.
struct ToolAnswer {
    int exitCode = -1;  ///< 127 if the program is missing
    std::string text;   ///< the last 64 KiB of stdout and stderr
};
/// Runs a program by its name and waits for it. Under Node.js, every program counts as missing.
[[nodiscard]] ToolAnswer runTool(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace svt::cli
