#pragma once
/// \file
/// Runs the real `svt` as a user would, in a separate folder, with limits of processor time and memory, so that tests detect
/// unbounded work and memory. What hangs ends after ten minutes.

#include <svt/core/temporary_folder_test.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::test {

/// Exit codes of the command.
inline constexpr int kDone = 0, kUsage = 2, kInput = 3, kInvalid = 4, kOutput = 5, kLimit = 8, kCancelled = 9;

/// Root of the checkout that the test was built from.
[[nodiscard]] const std::string& sourceRoot();
/// Folder of the build that the running test belongs to.
[[nodiscard]] const std::filesystem::path& buildFolder();
/// The `svt` of that build.
[[nodiscard]] const std::string& commandPath();

struct Limits {
    double seconds = 60;  ///< of processor time, of all threads together; a run that needs more is killed
    std::uint64_t memoryBytes = std::uint64_t{1} << 30;  ///< address space; no limit if a sanitizer needs more
    std::uint64_t fileBytes = 0;                         ///< largest file that may be written; 0: no limit
    /// Mounts a file system of 4 KiB over this folder, seen by the command alone; empty: none.
    std::filesystem::path tinyDisk{};
    std::filesystem::path stdoutFile{};  ///< receives stdout; empty: stdout is stored in the result
};

struct CommandResult {
    int exitCode = -1;  ///< -1 if the command was ended by a signal
    int signal = 0;
    bool isTimeout = false;
    bool cannotMount = false;  ///< the tiny disk could not be mounted; nothing was run
    std::string out, err;
    double seconds = 0;  ///< of processor time

    /// All details, for the message of a failed test.
    [[nodiscard]] std::string toString() const;
    /// stdout as JSON; a test failure and null if it is not JSON.
    [[nodiscard]] nlohmann::json json() const;
};

/// Runs `svt <arguments>` with `folder` as working folder and waits for its end.
[[nodiscard]] CommandResult runSvt(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                                   const Limits& limits = {});

/// Runs `svt`, expects exit code 0, and returns stdout.
std::string runSvtWell(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Runs `svt`, expects exit code 0, and returns stdout as JSON.
nlohmann::json runSvtForJson(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// `objects` of `svt info --json` (or any array of objects) by id.
[[nodiscard]] std::vector<std::string> keysOf(const nlohmann::json& object);

}  // namespace svt::test
