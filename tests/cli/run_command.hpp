#pragma once
/// \file
/// Runs the real `svt` as a user would, in a folder of its own, under limits of time and memory, so that a test of
/// "no hang, no unbounded memory" is one.

#include <svt/core/temporary_folder_test.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::test {

struct Limits {
    double seconds = 10;                                 ///< of wall clock; a slower run is killed
    std::uint64_t memoryBytes = std::uint64_t{1} << 30;  ///< of address space; not applied where a sanitizer needs more
    std::uint64_t fileBytes = 0;                         ///< largest file that may be written; 0: no limit
    /// Mounts a file system of 4 KiB over this folder, seen by the command alone; empty: none.
    std::filesystem::path tinyDisk;
    std::filesystem::path stdoutFile;  ///< takes stdout; empty: the result does
};

struct CommandResult {
    int exitCode = -1;  ///< -1 where a signal ended the command
    int signal = 0;
    bool isTimeout = false;
    bool cannotMount = false;  ///< the tiny disk could not be made; nothing was run
    std::string out, err;
    double seconds = 0;

    /// Everything a failed test wants to see.
    [[nodiscard]] std::string toString() const;
    /// stdout as JSON; a test failure and null where it is none.
    [[nodiscard]] nlohmann::json json() const;
};

/// Runs `svt <arguments>` with `folder` as working folder and waits for its end.
[[nodiscard]] CommandResult runSvt(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                                   const Limits& limits = {});

/// Runs `svt`, expects exit code 0, and gives stdout.
std::string runSvtWell(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Runs `svt`, expects exit code 0, and gives stdout as JSON.
nlohmann::json runSvtForJson(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// `objects` of `svt info --json` (or any array of objects) by id.
[[nodiscard]] std::vector<std::string> keysOf(const nlohmann::json& object);

}  // namespace svt::test
