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

/// Runs `svt sample`, `svt build` or `svt convert` to set a test up and expects exit code 0. The output is kept in the build
/// folder: the same command with the same arguments and inputs runs once for all tests. Not for the commands under test.
void prepare(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Prepares the generated house as house.gml and its volume as house.svt; `more`: options of `svt build`.
void prepareHouse(const std::filesystem::path& folder, const std::string& spacing,
                  const std::vector<std::string>& more = {});

/// Keys of a JSON object.
[[nodiscard]] std::vector<std::string> keysOf(const nlohmann::json& object);

/// How a shell command ended, such as one that reads with another program what `svt` has written.
struct ShellResult {
    int exitCode = -1;
    std::string text;  ///< stdout and stderr

    /// Whether the program, or a package that it needs, is not on this machine.
    [[nodiscard]] bool isMissing() const { return exitCode == 77 || exitCode == 127; }
};

/// Runs a shell command with `folder` as working folder; writes `output.txt` there.
[[nodiscard]] ShellResult runShell(const std::filesystem::path& folder, const std::string& command);

/// Runs a shell command, expects exit code 0, and returns its output.
std::string runShellWell(const std::filesystem::path& folder, const std::string& command);

/// Runs a shell command and expects exit code 0, unless its program is missing; `said` receives the output.
/// \return whether the program is there
[[nodiscard]] bool isRun(const std::filesystem::path& folder, const std::string& command, std::string& said);

/// Whether a program is installed, by a command that prints its version.
[[nodiscard]] bool hasProgram(const std::string& command);

/// The command that runs a script, of tests/scripts unless its path is absolute, with the system's own Python: readers of
/// other formats are packages of the system.
[[nodiscard]] std::string pythonOf(const std::string& script);

/// The command that runs a script of tests/formats with Node.js and the packages in $SVT_ORACLES, else in build/oracles.
[[nodiscard]] std::string nodeOf(const std::string& script);

}  // namespace svt::test
