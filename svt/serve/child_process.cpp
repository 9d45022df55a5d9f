#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/serve/child_process.hpp>

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <system_error>
#include <utility>

namespace svt::serve {
namespace {

constexpr int kCannotStart = 126;
constexpr std::size_t kMaxMessages = 64 * 1024;

void limit(int resource, std::uint64_t value) noexcept {
    const rlimit both{value, value};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// Runs between fork and exec; nothing here allocates.
[[noreturn]] void execChild(char* const* arguments, const char* folder, const ChildLimits& limits, int errors,
                            pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(kCannotStart);
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, 0);
    ::dup2(nothing, 1);
    ::dup2(errors, 2);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGXFSZ, SIG_IGN);  // writing past the file size limit becomes an error instead of a signal
    limit(RLIMIT_AS, limits.memoryBytes);
    limit(RLIMIT_FSIZE, limits.fileBytes);
    limit(RLIMIT_CORE, 0);
    if (::chdir(folder) == 0) ::execv(arguments[0], arguments);
    ::_exit(kCannotStart);
}

// Appends the available output.
// \return false at the end
bool readAvailable(int from, std::string& messages) {
    std::array<char, 4096> buffer;
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got <= 0) return got < 0 && (errno == EAGAIN || errno == EINTR);
    messages.append(buffer.data(), static_cast<std::size_t>(got));
    if (messages.size() > kMaxMessages) messages.erase(0, messages.size() - kMaxMessages);
    return true;
}

}  // namespace

ChildResult runChild(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                     const ChildLimits& limits, const Progress& stop) {
    ChildResult result;
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
        result.cannotStart = true;
        return result;
    }
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    const pid_t parent = ::getpid();
    pid_t child = -1;
    const Unfinished unfinished = Unfinished::process([&] {
        child = ::fork();
        if (child == 0) execChild(pointers.data(), folder.c_str(), limits, pipe[1], parent);
        return child;
    });
    ::close(pipe[1]);
    ::fcntl(pipe[0], F_SETFL, O_NONBLOCK);

    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limits.seconds);
    int status = 0;
    bool isOpen = true;
    while (child > 0) {
        constexpr int kPauseMs = 20;
        pollfd poll{isOpen ? pipe[0] : -1, POLLIN, 0};
        ::poll(&poll, 1, kPauseMs);
        if (poll.revents != 0) isOpen = readAvailable(pipe[0], result.messages);
        if (::waitpid(child, &status, WNOHANG) != 0) break;
        result.isTimeout = std::chrono::steady_clock::now() >= end;
        result.isCancelled = Progress::isCancelled(&stop);
        if (!result.isTimeout && !result.isCancelled) continue;
        if (result.isCancelled) {
            status = endProcess(child);
        } else {
            ::kill(-child, SIGKILL);
            ::kill(child, SIGKILL);  // in case it has no process group yet
            ::waitpid(child, &status, 0);
        }
        break;
    }
    if (child > 0) ::kill(-child, SIGKILL);  // its descendants
    while (isOpen && child > 0) {
        const std::size_t had = result.messages.size();
        isOpen = readAvailable(pipe[0], result.messages) && result.messages.size() != had;
    }
    ::close(pipe[0]);
    if (child > 0 && WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
    if (child > 0 && WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.cannotStart = child < 0 || result.exitCode == kCannotStart;
    return result;
}

}  // namespace svt::serve
