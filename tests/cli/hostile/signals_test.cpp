// Signals and closed streams: whatever ends the command, no temporary file and no half of an output is left, and no
// message gets into a file.
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <functional>
#include <optional>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr int kEndingSignals[] = {SIGTERM, SIGHUP, SIGINT, SIGPIPE};

// A process of `svt` that the test can send signals to. Its temporary folder is `folder`/tmp.
class RunningSvt {
public:
    RunningSvt(const fs::path& folder, const Arguments& arguments, const std::function<void()>& prepare = {}) {
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

    void send(int signal) const { ::kill(child_, signal); }
    // Whether it has ended.
    bool isOver() {
        int status = 0;
        if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
        return status_.has_value();
    }
    // Waits for its end.
    int status() {
        int status = 0;
        if (!status_ && ::waitpid(child_, &status, 0) == child_) status_ = status;
        return status_.value_or(-1);
    }

private:
    pid_t child_ = -1;
    std::optional<int> status_;
};

// The names of what lies below a folder.
std::vector<std::string> namesBelow(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
        names.push_back(at->path().lexically_relative(folder).string());
    return names;
}

bool hasTemporary(const fs::path& folder) {
    for (const std::string& name : namesBelow(folder))
        if (name.find(".svt-") != std::string::npos || name.find(".part") != std::string::npos) return true;
    return false;
}

class Signals : public ::testing::Test {
protected:
    Signals() { fs::create_directory(folder / "tmp"); }

    // Sends `signal` as soon as a temporary file is seen below `place`, again and again until one run was met by it:
    // runs that end before are whole. Nothing is left after any of them.
    void expectNothingLeft(const Arguments& arguments, const fs::path& place, int signal,
                           const std::function<void()>& reset) {
        constexpr int kRuns = 200;
        for (int run = 0; run < kRuns; ++run) {
            reset();
            RunningSvt svt(folder.path(), arguments);
            while (!svt.isOver() && !hasTemporary(place)) {
            }
            const bool isAtWork = !svt.isOver();
            svt.send(signal);
            const int status = svt.status();
            ASSERT_FALSE(hasTemporary(folder.path())) << "signal " << signal << ", run " << run;
            ASSERT_TRUE(fs::is_empty(folder / "tmp"));
            if (WIFSIGNALED(status)) {
                EXPECT_EQ(WTERMSIG(status), signal);
                return;
            }
            // Ctrl-C asks long work to stop; a step that is nearly done comes to its end.
            if (WIFEXITED(status) && WEXITSTATUS(status) == kCancelled && signal == SIGINT) return;
            if (signal == SIGINT && isAtWork) return;
            ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "status " << status;
        }
        ADD_FAILURE() << "signal " << signal << " never came in the middle of the work";
    }

    TemporaryFolder folder;
};

TEST_F(Signals, LeaveNothingOfABuild) {
    writeText(folder / "two.gml", twoBoxes());
    for (const int signal : kEndingSignals) {
        expectNothingLeft({"build", "two.gml", "-o", "o.svt", "--spacing", "0.05"}, folder.path(), signal,
                          [&] { fs::remove(folder / "o.svt"); });
        if (fs::exists(folder / "o.svt")) runSvtWell(folder.path(), {"info", "o.svt"});
    }
}

TEST_F(Signals, LeaveNothingOfAConversion) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.05"});
    for (const int signal : kEndingSignals) {
        expectNothingLeft({"convert", "two.svt", "o.nrrd", "--encoding", "raw"}, folder.path(), signal,
                          [&] { fs::remove(folder / "o.nrrd"); });
        expectNothingLeft({"convert", "two.svt", "o.zarr"}, folder.path(), signal,
                          [&] { fs::remove_all(folder / "o.zarr"); });
    }
}

TEST_F(Signals, KeepTheOldFile) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "o.svt", "--spacing", "1"});
    const std::string old = readText(folder / "o.svt");
    expectNothingLeft({"build", "two.gml", "-o", "o.svt", "--spacing", "0.05"}, folder.path(), SIGTERM,
                      [&] { writeText(folder / "o.svt", old); });
    const bool isOld = readText(folder / "o.svt") == old;
    if (!isOld) runSvtWell(folder.path(), {"info", "o.svt"});
}

TEST_F(Signals, LeaveNothingOfAFilmAndEndItsEncoder) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    // An encoder that never ends, and says so in a file.
    fs::create_directory(folder / "bin");
    writeText(folder / "bin/ffmpeg",
              "#!/bin/sh\necho $$ > \"$STARTED.new\"\nmv \"$STARTED.new\" \"$STARTED\"\n"
              "while :; do sleep 1; done\n");
    fs::permissions(folder / "bin/ffmpeg", fs::perms::all);
    const fs::path started = folder / "started";
    for (const int signal : kEndingSignals) {
        fs::remove(started);
        RunningSvt svt(folder.path(),
                       {"render", "two.svt", "-o", "o.webm", "--turn", "90", "--seconds", "0.2", "--size", "64x36"},
                       [&] {
                           ::setenv("PATH", ((folder / "bin").string() + ":/usr/bin:/bin").c_str(), 1);
                           ::setenv("STARTED", started.c_str(), 1);
                       });
        while (!svt.isOver() && !fs::exists(started)) ::poll(nullptr, 0, 1);
        ASSERT_FALSE(svt.isOver()) << "status " << svt.status();
        EXPECT_FALSE(fs::is_empty(folder / "tmp"));
        const pid_t encoder = std::stoi(readText(started));
        svt.send(signal);
        const int status = svt.status();
        if (signal == SIGINT)
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kCancelled) << "status " << status;
        else
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << "status " << status;
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "signal " << signal;
        EXPECT_FALSE(fs::exists(folder / "o.webm"));
        EXPECT_NE(::kill(encoder, 0), 0) << "the encoder is at work";
    }
}

TEST_F(Signals, LeaveNothingOfACity) {
    const auto runWell = [&](const Arguments& arguments) {
        Limits limits;
        limits.seconds = 120;
        const CommandResult result = runSvt(folder.path(), arguments, limits);
        ASSERT_EQ(result.exitCode, 0) << arguments[0] << ": " << result.toString();
    };
    runWell({"sample-city", "--buildings", "40", "-o", "models"});
    runWell({"city-plan", "models", "-o", "city", "--spacing", "1", "--pack-seconds", "0.05"});
    for (const int signal : kEndingSignals)
        expectNothingLeft({"city-run", "city", "--jobs", "2"}, folder / "city", signal, [&] {
            for (const char* part : {"packs", "reports", "city.json", "index.bin", "ids.bin", "packs.bin"})
                fs::remove_all(folder / "city" / part);
        });
    // What is done stays, and the same command goes on from there.
    runWell({"city-run", "city"});
    runWell({"city-info", "city"});
}

TEST_F(Signals, AFileSizeLimitIsAnErrorOfEveryOutput) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.2"});
    const Arguments commands[] = {
        {"build", "two.gml", "-o", "o.svt", "--spacing", "0.2"},
        {"convert", "two.svt", "o.nrrd", "--encoding", "raw"},
        {"convert", "two.svt", "o.zarr"},
        {"render", "two.svt", "-o", "o.png"},
        {"section", "two.svt", "-o", "o.dxf"},
        {"sample", "house", "-o", "o.gml"},
    };
    for (const Arguments& arguments : commands) {
        Limits limits;
        limits.fileBytes = 64;
        const CommandResult result = runSvt(folder.path(), arguments, limits);
        EXPECT_EQ(result.exitCode, kOutput) << arguments[0] << ": " << result.toString();
        EXPECT_FALSE(hasTemporary(folder.path())) << arguments[0];
        for (const std::string& name : namesBelow(folder.path()))
            EXPECT_FALSE(name.starts_with("o.")) << arguments[0] << " left " << name;
    }
}

TEST_F(Signals, ThatAreIgnoredStayIgnored) {
    writeText(folder / "two.gml", twoBoxes());
    RunningSvt svt(folder.path(), {"build", "two.gml", "-o", "o.svt", "--spacing", "0.1"}, [] {
        std::signal(SIGHUP, SIG_IGN);
        std::signal(SIGINT, SIG_IGN);
    });
    while (!svt.isOver()) {
        svt.send(SIGHUP);
        svt.send(SIGINT);
        ::poll(nullptr, 0, 1);
    }
    EXPECT_EQ(svt.status(), 0);
    runSvtWell(folder.path(), {"info", "o.svt"});
}

TEST_F(Signals, ClosedStreamsGetIntoNoFile) {
    writeText(folder / "two.gml", twoBoxes());
    const Arguments build{"build", "two.gml", "-o", "o.svt", "--spacing", "0.5", "--verbose"};
    runSvtWell(folder.path(), build);
    const std::string expected = readText(folder / "o.svt");
    for (int closed = 1; closed < 8; ++closed) {
        fs::remove(folder / "o.svt");
        const auto close = [closed] {
            for (const int stream : {0, 1, 2})
                if ((closed >> stream & 1) != 0) ::close(stream);
        };
        RunningSvt svt(folder.path(), build, close);
        EXPECT_EQ(svt.status(), 0) << closed;
        EXPECT_TRUE(readText(folder / "o.svt") == expected) << closed;
        // A message of an error has nowhere to go.
        RunningSvt wrong(folder.path(), {"build", "missing.gml", "-o", "o.svt"}, close);
        const int status = wrong.status();
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << closed << ": status " << status;
        EXPECT_TRUE(readText(folder / "o.svt") == expected) << closed;
    }
}

TEST_F(Signals, MessagesThatCannotBeWrittenDoNotAbort) {
    RunningSvt svt(folder.path(), {"info", "missing.gml"}, [] {
        const int full = ::open("/dev/full", O_WRONLY);
        ::dup2(full, 2);
    });
    const int status = svt.status();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << "status " << status;
}

}  // namespace
}  // namespace svt::test
