#include <svt/core/machine/control_group.hpp>

#include <svt/core/text.hpp>

#include <fstream>
#include <string>
#include <string_view>

namespace svt {
namespace {

namespace fs = std::filesystem;

std::string firstLine(const fs::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return line;
}

// Empty for "max" and "-1", which mean no limit.
std::optional<std::uint64_t> wholeNumber(std::string_view text) { return parseInteger<std::uint64_t>(text); }

template <class T>
void lower(std::optional<T>& limit, std::optional<T> other) {
    if (other && (!limit || *other < *limit)) limit = other;
}

// Both in microseconds; the quota is the time per period on all cores together.
std::optional<double> coresOf(std::string_view quota, std::string_view period) {
    const auto granted = wholeNumber(quota), whole = wholeNumber(period);
    if (!granted || !whole || *whole == 0) return {};
    return double(*granted) / double(*whole);
}

void readGroup(const fs::path& group, ControlGroupLimits& limits) {
    // Version 2; cpu.max is "150000 100000".
    lower(limits.memoryBytes, wholeNumber(firstLine(group / "memory.max")));
    const std::string both = firstLine(group / "cpu.max");
    if (const std::size_t blank = both.find(' '); blank != std::string::npos)
        lower(limits.cores, coresOf(std::string_view(both).substr(0, blank), std::string_view(both).substr(blank + 1)));
    // Version 1.
    lower(limits.memoryBytes, wholeNumber(firstLine(group / "memory.limit_in_bytes")));
    lower(limits.cores, coresOf(firstLine(group / "cpu.cfs_quota_us"), firstLine(group / "cpu.cfs_period_us")));
}

}  // namespace

ControlGroupLimits controlGroupLimits(const fs::path& root) {
    ControlGroupLimits limits;
    std::ifstream groups(root / "proc/self/cgroup");
    // Lines such as "4:memory:/user.slice" (version 1) and "0::/user.slice" (version 2).
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        fs::path mount = root / "sys/fs/cgroup";
        if (second > first + 1) mount /= line.substr(first + 1, second - first - 1);
        fs::path group = fs::path(line.substr(second + 1)).relative_path();
        // In a container the path may be that of the host, but the group at the top is its own.
        for (;; group = group.parent_path()) {
            readGroup(mount / group, limits);
            if (group.empty()) break;
        }
    }
    return limits;
}

}  // namespace svt
