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
    std::string messages;  ///< of its process
};

/// Builds packs [first, last), each in a process of its own (`svt city-task`), `jobs` at a time; without processes one
/// after the other in this one.
/// \param jobs  0: one for each core
/// \return those that failed, in order
[[nodiscard]] std::vector<FailedPack> runPacks(const std::filesystem::path& folder, const city::Plan& plan, int jobs,
                                               const city::PackOptions& options, const Progress* progress);

/// What another program said.
struct ToolAnswer {
    int exitCode = -1;  ///< 127 where it is not there
    std::string text;   ///< the last 64 KiB of stdout and stderr
};
/// Runs a program by its name and waits for it. Under Node.js no program is there.
[[nodiscard]] ToolAnswer runTool(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace svt::cli
