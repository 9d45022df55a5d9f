#pragma once
/// \file
/// A program run under limits, for work on what strangers send.

#include <svt/core/progress.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::serve {

struct ChildLimits {
    std::uint64_t memoryBytes = std::uint64_t{2} << 30;  ///< of address space
    double seconds = 120;                                ///< of wall clock, and of each core's time
    std::uint64_t fileBytes = std::uint64_t{1} << 30;    ///< of the largest file it may write
};

struct ChildResult {
    int exitCode = -1;  ///< -1 where a signal ended it
    int signal = 0;
    bool isTimeout = false, isCancelled = false, cannotStart = false;
    std::string messages;  ///< the last 64 KiB of its stderr
};

/// Runs `arguments[0]` (a path) in `folder` and waits for its end. It has no input, its stdout is thrown away, and it
/// ends with all its children where it is over a limit, where `stop` says so, or with this thread.
[[nodiscard]] ChildResult runChild(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                   const ChildLimits& limits, const Progress& stop);

/// A new folder that only this user can read, removed with all it holds at the end.
class PrivateFolder {
public:
    PrivateFolder();
    PrivateFolder(PrivateFolder&& other) noexcept;
    PrivateFolder& operator=(PrivateFolder&&) = delete;
    ~PrivateFolder();
    /// Empty where none could be made.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace svt::serve
