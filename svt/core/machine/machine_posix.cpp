#include <svt/core/machine.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine/control_group.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace svt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxText = 64 * 1024;

void writeAll(int to, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(to, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

[[noreturn]] void workInCopy(int out, const std::function<void(const Say&)>& work) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // otherwise a hanging child would outlive its parent
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);  // a crash is expected, and no reason to write a file
    if (const int nothing = ::open("/dev/null", O_WRONLY); nothing >= 0) ::dup2(nothing, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    int code = EXIT_SUCCESS;
    try {
        work([out](std::string_view text) { writeAll(out, text); });
    } catch (...) {
        code = EXIT_FAILURE;
    }
    // Not exit(), so that the objects and buffers of the waiting process are not closed twice.
    ::_exit(code);
}

// Reads until the other end is closed.
// \return false after `seconds`
bool readAll(int from, double seconds, std::string& text) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::array<char, 4096> buffer;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) return false;
        pollfd poll{from, POLLIN, 0};
        if (::poll(&poll, 1, static_cast<int>(std::min<std::int64_t>(left, 1000))) <= 0) continue;
        const ssize_t got = ::read(from, buffer.data(), buffer.size());
        if (got == 0) return true;
        if (got > 0) text.append(buffer.data(), std::min(static_cast<std::size_t>(got), kMaxText - text.size()));
    }
}

// The limit of this process's data that was set here.
struct OwnLimit {
    std::string by;  // empty: it is that of the machine
    std::uint64_t bytes = 0;
    rlim_t before = RLIM_INFINITY;  // the limit before
    bool isSet = false;
};

OwnLimit& ownLimit() {
    static OwnLimit limit;
    return limit;
}

void setDataLimit(rlim_t bytes) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
    const rlim_t before = limit.rlim_cur;
    limit.rlim_cur = std::min(bytes, limit.rlim_max);
    if (::setrlimit(RLIMIT_DATA, &limit) != 0) return;
    if (!ownLimit().isSet) ownLimit().before = before;
    ownLimit().isSet = true;
}

std::string faultOf(int status) {
    if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
    return WEXITSTATUS(status) == 0 ? "" : fmt::format("ended with code {}", WEXITSTATUS(status));
}

}  // namespace

MemoryFigures memoryFigures() {
    MemoryFigures figures;
    std::ifstream in("/proc/meminfo");
    for (std::string line; std::getline(in, line);) {
        // "MemTotal:       16303428 kB"
        std::istringstream words(line);
        std::string name;
        std::uint64_t kilobytes = 0;
        if (!(words >> name >> kilobytes)) continue;
        if (name == "MemTotal:") figures.totalBytes = kilobytes * 1024;
        if (name == "MemAvailable:") figures.availableBytes = kilobytes * 1024;
        if (name == "SwapTotal:") figures.swapBytes = kilobytes * 1024;
    }
    const auto limit = [&](std::uint64_t bytes, const char* by) {
        if (figures.totalBytes && bytes >= *figures.totalBytes) return;
        if (figures.limitBytes && bytes >= *figures.limitBytes) return;
        figures.limitBytes = bytes;
        figures.limitedBy = by;
    };
    if (const auto bytes = controlGroupLimits("/").memoryBytes) limit(*bytes, "control group");
    rlimit space{};
    if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) limit(space.rlim_cur, "ulimit -v");
    if (!ownLimit().by.empty())
        limit(ownLimit().bytes, ownLimit().by.c_str());
    else if (!ownLimit().isSet && ::getrlimit(RLIMIT_DATA, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        limit(space.rlim_cur, "ulimit -d");
    return figures;
}

void limitMemory(std::uint64_t bytes, std::string_view by) {
    ownLimit().by = by;
    ownLimit().bytes = bytes;
    if (!kIsSanitized) setDataLimit(static_cast<rlim_t>(bytes));
}

void limitMemoryToMachine() {
    rlimit data{};
    if (kIsSanitized || ::getrlimit(RLIMIT_DATA, &data) != 0 || data.rlim_cur != RLIM_INFINITY) return;
    const MemoryFigures figures = memoryFigures();
    const std::optional<std::uint64_t> bytes = figures.limitBytes ? figures.limitBytes : figures.totalBytes;
    if (!bytes || figures.limitedBy == "ulimit -v") return;
    rlimit stack{};
    constexpr std::uint64_t kUsualStack = std::uint64_t{8} << 20;
    const bool hasStack = ::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
    const std::uint64_t stacks =
        static_cast<std::uint64_t>(machineCores().value_or(1)) * (hasStack ? stack.rlim_cur : kUsualStack);
    setDataLimit(static_cast<rlim_t>(*bytes + figures.swapBytes.value_or(0) + stacks));
}

void unlimitMemory() {
    if (ownLimit().isSet && ownLimit().by.empty()) setDataLimit(ownLimit().before);
}

void allowMoreOpenFiles(std::size_t more) noexcept {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    limit.rlim_cur = more < limit.rlim_max - limit.rlim_cur ? limit.rlim_cur + more : limit.rlim_max;
    static_cast<void>(::setrlimit(RLIMIT_NOFILE, &limit));
}

std::optional<int> machineCores() noexcept {
    const long cores = ::sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 0 ? std::optional(static_cast<int>(cores)) : std::nullopt;
}

std::optional<double> grantedCores() { return controlGroupLimits("/").cores; }

std::optional<std::uint64_t> freeBytes(const fs::path& folder) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    return error ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

std::optional<bool> hasDesktop() noexcept {
    return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

fs::path findProgram(std::string_view name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        fs::path file = fs::path(folder.empty() ? "." : folder) / name;
        std::error_code error;
        if (fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

OwnProcessResult inOwnProcess(double seconds, const std::function<void(const Say&)>& work) {
    OwnProcessResult result;
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return {{}, "no pipe could be made"};
    std::fflush(nullptr);  // so that the child does not inherit buffered output
    pid_t child = -1;
    Unfinished unfinished = Unfinished::process([&] {
        child = ::fork();
        if (child == 0) {
            ::close(pipe[0]);
            workInCopy(pipe[1], work);
        }
        return child;
    });
    ::close(pipe[1]);
    if (child < 0) {
        ::close(pipe[0]);
        return {{}, "no process could be started"};
    }
    const bool isAnswered = readAll(pipe[0], seconds, result.text);
    if (!isAnswered) ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    unfinished.forget();
    ::close(pipe[0]);
    result.fault = isAnswered ? faultOf(status) : fmt::format("no answer within {:g} s", seconds);
    return result;
}

}  // namespace svt
