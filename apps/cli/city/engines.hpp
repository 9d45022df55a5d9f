#pragma once
/// \file
/// Tasks of a city on a cluster: a Slurm job array and its merge, or a Kubernetes Indexed Job as YAML.

#include <svt/city/city_folder.hpp>
#include <svt/city/city_pack.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::cli {

/// Text in single quotes for a shell; without quotes if a shell reads it the same.
[[nodiscard]] std::string shellQuoted(const std::string& text);

/// "0-3,7": numbers as ranges, in the notation of Slurm.
[[nodiscard]] std::string rangesOf(const std::vector<std::uint32_t>& numbers);

/// A city to build, and its options.
struct EngineJob {
    std::filesystem::path folder;      ///< absolute
    std::vector<std::string> options;  ///< of the user, for sbatch or the YAML
    city::PackOptions packs;
};

/// The tasks with at least one missing pack, out of `tasks`.
[[nodiscard]] std::vector<std::uint32_t> openTasks(const city::Plan& plan, const std::vector<std::uint32_t>& missing,
                                                   std::uint32_t tasks);

/// The number of tasks that Slurm's arrays allow (MaxArraySize); that of the plan if Slurm's command is missing.
[[nodiscard]] std::uint32_t slurmTasks(const city::Plan& plan);

/// Arguments of sbatch for the array, and for the merge after it. \param job  number of the array's job
[[nodiscard]] std::vector<std::string> slurmArray(const EngineJob& job, const std::vector<std::uint32_t>& open,
                                                  std::uint32_t tasks);
[[nodiscard]] std::vector<std::string> slurmMerge(const EngineJob& job, const std::string& array);

/// The jobs that were submitted.
struct SlurmJobs {
    std::string array, merge;  ///< numbers
};
/// Submits both. \return their numbers, or TaskFailed with the messages of Slurm
[[nodiscard]] Result<SlurmJobs> submitToSlurm(const EngineJob& job, const std::vector<std::uint32_t>& open,
                                              std::uint32_t tasks);

/// The command that submits the missing tasks with the same options.
[[nodiscard]] std::string resubmitLine(const std::filesystem::path& folder);
/// Stores the options for resubmitLine(), next to the reports.
Result<void> keepOptions(const EngineJob& job, const SlurmJobs& jobs);

/// An Indexed Job for all tasks and a Job for the merge. Options: image=, claim=, mount=, namespace=, cpu=, memory=,
/// parallelism=.
/// \return YAML, or BadArgument for another option, or if files of the plan lie outside of the mounted folder
[[nodiscard]] Result<std::string> kubernetesJobs(const EngineJob& job, const city::Plan& plan);

}  // namespace svt::cli
