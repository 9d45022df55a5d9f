#include "run_command.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include <svt/core/machine.hpp>
#include <svt/core/test_data_test.hpp>

namespace svt::test {
namespace {

constexpr int kExecFailed = 126, kMountFailed = 125;

// Files with defaults of this user do not change what tests expect.
[[maybe_unused]] const int kNoConfig = ::setenv("SVT_NO_CONFIG", "1", 1);

constexpr double kSlowdown = kIsSanitized ? 20 : 1;
constexpr double kHangSeconds = 600 * kSlowdown;

// Mounts a file system of 4 KiB that is visible only to this process and disappears with it.
bool mountTinyDisk(const char* folder) {
    if (::unshare(CLONE_NEWNS) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    if (::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
    return ::mount("none", folder, "tmpfs", 0, "size=4k") == 0;
}

void limit(int resource, std::uint64_t most) {
    const rlimit value{most, most};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

double secondsOf(const timeval& time) { return double(time.tv_sec) + double(time.tv_usec) / 1e6; }

[[noreturn]] void becomeSvt(const char* command, const std::string& folder, std::vector<char*>& arguments,
                            const Limits& limits, const std::string& tinyDisk, int out, int err) {
    ::setpgid(0, 0);
    if (::chdir(folder.c_str()) != 0) ::_exit(kExecFailed);
    if (!tinyDisk.empty() && !mountTinyDisk(tinyDisk.c_str())) ::_exit(kMountFailed);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, 0);
    ::dup2(out, 1);
    ::dup2(err, 2);
    if (!kIsSanitized) limit(RLIMIT_AS, limits.memoryBytes);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<std::uint64_t>(std::ceil(limits.seconds * kSlowdown)));
    if (limits.fileBytes != 0) limit(RLIMIT_FSIZE, limits.fileBytes);
    ::execv(command, arguments.data());
    ::_exit(kExecFailed);
}

namespace fs = std::filesystem;

// Size and time of a file, which change when it is written anew.
std::string stampOf(const fs::path& file) {
    return std::to_string(fs::file_size(file)) + "-" +
           std::to_string(fs::last_write_time(file).time_since_epoch().count());
}

// Outputs of prepare() by the command of this build. Those of earlier commands are removed, one folder at a time: other tests
// that start now may already write into the folder of this command.
const fs::path& preparedFolder() {
    static const fs::path folder = [] {
        const fs::path parent = buildFolder() / "tests/prepared", own = parent / stampOf(commandPath());
        fs::create_directories(own);
        std::error_code ignored;
        for (const fs::directory_entry& entry : fs::directory_iterator(parent))
            if (entry.path() != own) fs::remove_all(entry.path(), ignored);
        return own;
    }();
    return folder;
}

// The arguments, with the content of those that name a file in `folder` and the stamp of those that name one elsewhere.
std::string keyOf(const fs::path& folder, const std::vector<std::string>& arguments, const std::string& output) {
    std::string key;
    for (const std::string& argument : arguments) {
        key += argument + '\0';
        const fs::path file = folder / argument;
        if (argument == output || !fs::exists(file)) continue;
        EXPECT_FALSE(fs::is_directory(file)) << "the key has no content of folders: " << file;
        key += (fs::path(argument).is_absolute() ? stampOf(file) : readText(file)) + '\0';
    }
    return std::to_string(std::hash<std::string>()(key));
}

}  // namespace

const std::string& sourceRoot() {
    static const std::string root = kSourceRoot;
    return root;
}

const std::filesystem::path& buildFolder() {
    static const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
    return folder;
}

const std::string& commandPath() {
    static const std::string path = (buildFolder() / "bin/svt").string();
    return path;
}

std::string CommandResult::toString() const {
    std::string text = isTimeout     ? "killed after the time limit"
                       : signal != 0 ? "ended by signal " + std::to_string(signal)
                                     : "exit " + std::to_string(exitCode);
    return text + "\n--- stdout\n" + out.substr(0, 4000) + "\n--- stderr\n" + err.substr(0, 4000);
}

nlohmann::json CommandResult::json() const {
    nlohmann::json value = nlohmann::json::parse(out, nullptr, false);
    if (!value.is_discarded()) return value;
    ADD_FAILURE() << "stdout is no JSON: " << toString();
    return {};
}

CommandResult runSvt(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                     const Limits& limits) {
    // The streams go to files outside the folder, so that endless output cannot block the command.
    const TemporaryFolder streams;
    const std::filesystem::path outFile = limits.stdoutFile.empty() ? streams / "out" : limits.stdoutFile;
    const int out = ::open(outFile.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    const int err = ::open((streams / "err").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    std::vector<std::string> texts{"svt"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    const std::string folderName = folder.string(), tinyDisk = limits.tinyDisk.string();

    CommandResult result;
    const auto start = std::chrono::steady_clock::now();
    const char* const command = commandPath().c_str();  // found before the fork
    const pid_t child = ::fork();
    if (child == 0) becomeSvt(command, folderName, pointers, limits, tinyDisk, out, err);
    ::close(out);
    ::close(err);
    int status = 0;
    if (child < 0) {
        ADD_FAILURE() << "cannot start a process";
        return result;
    }
    auto pause = std::chrono::microseconds(500);
    rusage used{};
    while (::wait4(child, &status, WNOHANG, &used) == 0) {
        if (!result.isTimeout &&
            std::chrono::steady_clock::now() - start > std::chrono::duration<double>(kHangSeconds)) {
            result.isTimeout = true;
            ::kill(child, SIGKILL);
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::microseconds(10000));
    }
    result.seconds = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
    if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    // The limit of processor time is a hard one, which the system enforces by SIGKILL, at one of its ticks.
    if (result.signal == SIGKILL && result.seconds > limits.seconds * kSlowdown - 0.5) result.isTimeout = true;
    result.cannotMount = result.exitCode == kMountFailed;
    EXPECT_NE(result.exitCode, kExecFailed) << commandPath() << " cannot be run in " << folder;
    result.out = readText(streams / "out");
    result.err = readText(streams / "err");
    return result;
}

std::string runSvtWell(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
    CommandResult result = runSvt(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << (arguments.empty() ? "svt" : "svt " + arguments.front()) << ": "
                                  << result.toString();
    return std::move(result.out);
}

nlohmann::json runSvtForJson(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
    const CommandResult result = runSvt(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << (arguments.empty() ? "svt" : "svt " + arguments.front()) << ": "
                                  << result.toString();
    return result.json();
}

void prepare(const fs::path& folder, const std::vector<std::string>& arguments) {
    const auto option = std::find(arguments.begin(), arguments.end(), "-o");
    const std::string& output = option != arguments.end() ? option[1] : arguments.at(2);  // of `svt convert`
    const fs::path kept = preparedFolder() / keyOf(folder, arguments, output);
    if (!fs::exists(kept)) {
        runSvtWell(folder, arguments);
        // Under its final name only when it is whole: other tests run beside this one.
        const fs::path whole = kept.string() + "-" + std::to_string(::getpid());
        fs::copy(folder / output, whole, fs::copy_options::recursive);
        std::error_code isThere;  // a folder that another test has made meanwhile
        fs::rename(whole, kept, isThere);
        if (isThere) fs::remove_all(whole);
        return;
    }
    fs::copy(kept, folder / output, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

void prepareHouse(const fs::path& folder, const std::string& spacing, const std::vector<std::string>& more) {
    prepare(folder, {"sample", "house", "-o", "house.gml"});
    std::vector<std::string> arguments{"build", "house.gml", "-o", "house.svt", "--spacing", spacing};
    arguments.insert(arguments.end(), more.begin(), more.end());
    prepare(folder, arguments);
}

std::vector<std::string> keysOf(const nlohmann::json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

ShellResult runShell(const fs::path& folder, const std::string& command) {
    const int status = std::system(("cd '" + folder.string() + "' && { " + command + "; } > output.txt 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(folder / "output.txt")};
}

std::string runShellWell(const fs::path& folder, const std::string& command) {
    ShellResult result = runShell(folder, command);
    EXPECT_EQ(result.exitCode, 0) << command << ":\n" << result.text;
    return std::move(result.text);
}

bool isRun(const fs::path& folder, const std::string& command, std::string& said) {
    const ShellResult result = runShell(folder, command);
    said = result.text;
    if (result.isMissing()) return false;
    EXPECT_EQ(result.exitCode, 0) << command << ":\n" << said;
    return true;
}

bool hasProgram(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()) == 0; }

std::string pythonOf(const std::string& script) {
    const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
    return python + " " + (fs::path(sourceRoot()) / "tests/scripts" / script).string() + " ";
}

std::string nodeOf(const std::string& script) {
    const char* folder = std::getenv("SVT_ORACLES");
    const std::string oracles = folder != nullptr ? folder : sourceRoot() + "/build/oracles";
    return "node " + sourceRoot() + "/tests/formats/" + script + " " + oracles + " ";
}

}  // namespace svt::test
