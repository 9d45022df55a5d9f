#pragma once
/// \file
/// Runs a program under resource limits, to process untrusted input.

#include <svt/core/progress.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::serve {

struct ChildLimits {
    std::uint64_t memoryBytes = std::uint64_t{2} << 30;  ///< address space
    double seconds = 120;                                ///< wall-clock time; CPU time has no limit of its own
    std::uint64_t fileBytes = std::uint64_t{1} << 30;    ///< size of the largest file it may write
};

struct ChildResult {
    int exitCode = -1;  ///< -1 if ended by a signal
    int signal = 0;
    bool isTimeout = false, isCancelled = false, cannotStart = false;
    std::string messages;  ///< the last 64 KiB of its stderr
};

/// Runs `arguments[0]` (a path) in `folder` and waits for it to end. The program gets no input and its stdout is
/// discarded. When its time is over or `stop` requests it, the program is killed with all its descendants. When this
/// thread ends, only the program itself is killed. Beyond the limits of memory and file size its allocations and writes
/// fail.
[[nodiscard]] ChildResult runChild(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                   const ChildLimits& limits, const Progress& stop);

}  // namespace svt::serve
