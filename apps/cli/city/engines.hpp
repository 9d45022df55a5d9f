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

/// Text in single quotes for a shell; as it is where that means the same.
[[nodiscard]] std::string shellQuoted(const std::string& text);

/// "0-3,7": numbers as Slurm and people write them.
[[nodiscard]] std::string rangesOf(const std::vector<std::uint32_t>& numbers);

/// What is to be run, and how.
struct EngineJob {
    std::filesystem::path folder;      ///< absolute
    std::vector<std::string> options;  ///< of the user, for sbatch or the YAML
    city::PackOptions packs;
};

/// The tasks of `tasks` that have a pack that is missing.
[[nodiscard]] std::vector<std::uint32_t> openTasks(const city::Plan& plan, const std::vector<std::uint32_t>& missing,
                                                   std::uint32_t tasks);

/// How many tasks Slurm's arrays allow (MaxArraySize); that of the plan where the command is not there to be asked.
[[nodiscard]] std::uint32_t slurmTasks(const city::Plan& plan);

/// Arguments of sbatch for the array, and for the merge after it. \param job  number of the array's job
[[nodiscard]] std::vector<std::string> slurmArray(const EngineJob& job, const std::vector<std::uint32_t>& open,
                                                  std::uint32_t tasks);
[[nodiscard]] std::vector<std::string> slurmMerge(const EngineJob& job, const std::string& array);

/// The jobs that were submitted.
struct SlurmJobs {
    std::string array, merge;  ///< numbers
};
/// Submits both. \return their numbers, or TaskFailed with what Slurm says
[[nodiscard]] Result<SlurmJobs> submitToSlurm(const EngineJob& job, const std::vector<std::uint32_t>& open,
                                              std::uint32_t tasks);

/// The command that submits what is missing with the same options.
[[nodiscard]] std::string resubmitLine(const std::filesystem::path& folder);
/// Keeps the options for resubmitLine(), beside the reports.
Result<void> keepOptions(const EngineJob& job, const SlurmJobs& jobs);

/// An Indexed Job for all tasks and a Job for the merge. Options: image=, claim=, mount=, namespace=, cpu=, memory=,
/// parallelism=.
/// \return YAML, or BadArgument for another option, or where files of the plan lie outside of what is mounted
[[nodiscard]] Result<std::string> kubernetesJobs(const EngineJob& job, const city::Plan& plan);

}  // namespace svt::cli
