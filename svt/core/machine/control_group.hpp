#pragma once
/// \file
/// Limits of control groups, with which containers and service managers share a machine. Plain files on Linux.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace svt {

/// An empty member means no limit, or no readable limit.
struct ControlGroupLimits {
    std::optional<std::uint64_t> memoryBytes;
    std::optional<double> cores;  ///< cores' worth of time
};

/// The lowest limits of this process's control groups and the groups around them, in version 1 or 2 of the files.
/// \param root  holds proc/self/cgroup and sys/fs/cgroup: "/", or a folder of a test
[[nodiscard]] ControlGroupLimits controlGroupLimits(const std::filesystem::path& root);

}  // namespace svt
