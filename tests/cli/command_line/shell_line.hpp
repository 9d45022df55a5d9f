#pragma once
/// \file
/// Lines of a shell with `svt` in them, as users write them: pipes, redirections, environment.

#include <tests/cli/run_command.hpp>

#include <sys/wait.h>

#include <cstdlib>
#include <string>

namespace svt::test {

/// How a line ended, with its streams.
struct LineResult {
    int exitCode = -1;
    std::string out, err;

    [[nodiscard]] std::string toString() const {
        return "exit " + std::to_string(exitCode) + "\n--- stdout\n" + out.substr(0, 2000) + "\n--- stderr\n" +
               err.substr(0, 4000);
    }
};

/// Runs a line with `folder` as working folder and `folder`/tmp for temporary files, at most ten minutes. `svt` is the
/// command of this build. The exit code is that of the last command of a pipe that fails.
[[nodiscard]] inline LineResult runLine(const std::filesystem::path& folder, const std::string& line) {
    const TemporaryFolder streams;
    std::filesystem::create_directories(folder / "tmp");
    writeText(streams / "line.sh", "set -o pipefail\nsvt() { command '" + commandPath() + "' \"$@\"; }\ncd '" +
                                       folder.string() + "'\nexport TMPDIR=\"$PWD/tmp\"\n" + line + "\n");
    const std::string at = streams.path().string();
    const int status = std::system(
        ("timeout 600 bash '" + at + "/line.sh' > '" + at + "/out' 2> '" + at + "/err' < /dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(streams / "out"), readText(streams / "err")};
}

/// Runs a line, expects exit code 0, and returns stdout.
inline std::string runLineWell(const std::filesystem::path& folder, const std::string& line) {
    LineResult result = runLine(folder, line);
    EXPECT_EQ(result.exitCode, 0) << line << ": " << result.toString();
    return std::move(result.out);
}

/// Whether the temporary files of all lines are gone.
[[nodiscard]] inline bool isTmpEmpty(const std::filesystem::path& folder) {
    return std::filesystem::is_empty(folder / "tmp");
}

}  // namespace svt::test
