#pragma once
/// \file
/// A process of `svt` that a test stops or starts in a way of its own, and what it leaves.

#include <tests/cli/run_command.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace svt::test {

/// A process of `svt` that the test can send signals to. Its streams lead to /dev/null, its temporary folder is `folder`/tmp.
class RunningSvt {
public:
    /// \param prepare  what the child does before it becomes svt
    RunningSvt(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
               const std::function<void()>& prepare = {}) {
        const std::string command = commandPath(), temporary = (folder / "tmp").string();
        std::vector<std::string> texts{"svt"};
        texts.insert(texts.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        for (std::string& text : texts) pointers.push_back(text.data());
        pointers.push_back(nullptr);
        std::array<int, 2> started{};  // closed when the child becomes svt
        if (::pipe2(started.data(), O_CLOEXEC) != 0) ADD_FAILURE() << "no pipe";
        child_ = ::fork();
        if (child_ != 0) {
            ::close(started[1]);
            char none = 0;
            while (::read(started[0], &none, 1) < 0 && errno == EINTR) {
            }
            ::close(started[0]);
            return;
        }
        for (const int signal : {SIGTERM, SIGHUP, SIGINT, SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
        const int nothing = ::open("/dev/null", O_RDWR);
        for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
        ::setenv("TMPDIR", temporary.c_str(), 1);
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        if (prepare) prepare();
        ::execv(command.c_str(), pointers.data());
        ::_exit(126);
    }
    ~RunningSvt() {
        if (status_) return;
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    RunningSvt(const RunningSvt&) = delete;
    RunningSvt& operator=(const RunningSvt&) = delete;

    [[nodiscard]] pid_t process() const { return child_; }
    void send(int signal) const { ::kill(child_, signal); }
    /// Whether it has ended.
    bool isOver() {
        int status = 0;
        if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
        return status_.has_value();
    }
    /// Waits for its end. \return as waitpid() has it
    int status() {
        int status = 0;
        if (!status_ && ::waitpid(child_, &status, 0) == child_) status_ = status;
        return status_.value_or(-1);
    }

private:
    pid_t child_ = -1;
    std::optional<int> status_;
};

/// The files and folders below a folder, with their content; that of folders is empty.
[[nodiscard]] inline std::map<std::string, std::string> contentBelow(const std::filesystem::path& folder) {
    std::map<std::string, std::string> content;
    std::error_code failed;
    for (std::filesystem::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        std::error_code ignored;
        const bool isFile = at->is_regular_file(ignored);
        content[at->path().lexically_relative(folder).string()] = isFile ? readText(at->path()) : "";
    }
    return content;
}

/// Whether a temporary file or folder of `svt` lies below a folder.
[[nodiscard]] inline bool hasTemporary(const std::filesystem::path& folder) {
    std::error_code failed;
    for (std::filesystem::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        const std::string name = at->path().filename().string();
        if (name.find(".svt-") != std::string::npos || name.find(".part") != std::string::npos) return true;
    }
    return false;
}

/// The processes that a process has started, by any of its threads; none where the system does not tell.
[[nodiscard]] inline std::vector<pid_t> childrenOf(pid_t process) {
    std::vector<pid_t> children;
    std::error_code failed;
    for (std::filesystem::directory_iterator at("/proc/" + std::to_string(process) + "/task", failed), end;
         !failed && at != end; at.increment(failed)) {
        std::istringstream in(readText(at->path() / "children"));
        children.insert(children.end(), std::istream_iterator<pid_t>(in), {});
    }
    return children;
}

/// The port that a process listens on; 0: none.
[[nodiscard]] inline int listeningPort(pid_t process) {
    std::set<std::string> sockets;
    std::error_code failed;
    for (std::filesystem::directory_iterator at("/proc/" + std::to_string(process) + "/fd", failed), end;
         !failed && at != end; at.increment(failed)) {
        std::error_code ignored;
        const std::string target = std::filesystem::read_symlink(at->path(), ignored).string();
        if (target.starts_with("socket:[")) sockets.insert(target.substr(8, target.size() - 9));
    }
    std::istringstream table(readText("/proc/net/tcp"));
    for (std::string line; std::getline(table, line);) {
        std::istringstream in(line);
        std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
        // number, local address, remote address, state, ..., inode; 0A: it listens
        if (words.size() > 9 && words[3] == "0A" && sockets.contains(words[9]))
            return std::stoi(words[1].substr(words[1].find(':') + 1), nullptr, 16);
    }
    return 0;
}

/// Waits until a server listens. \return its port; 0 where it has ended, or does not listen after two minutes
[[nodiscard]] inline int portOf(RunningSvt& svt) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    int port = 0;
    while (!svt.isOver() && (port = listeningPort(svt.process())) == 0 && std::chrono::steady_clock::now() < end)
        ::poll(nullptr, 0, 1);
    return port;
}

}  // namespace svt::test
