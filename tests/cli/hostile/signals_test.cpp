// Signals: whatever ends the command, no temporary file and no half of an output is left.
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <svt/core/machine.hpp>
#include <svt/serve/http_client_test.hpp>

#include <poll.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr int kEndingSignals[] = {SIGTERM, SIGHUP, SIGINT, SIGPIPE};

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

    // Sends each signal at several times of a run. Nothing temporary is left, and what is left of `output`, a folder or a file, is as a
    // whole run writes it: all of it where `last` is there.
    void expectWholeAtAnyTime(const Arguments& arguments, const std::string& output, const std::string& last,
                              const std::function<void()>& reset) {
        constexpr int kTimes = 6;
        const auto left = [&] {
            return fs::is_regular_file(folder / output)
                       ? std::map<std::string, std::string>{{"", readText(folder / output)}}
                       : contentBelow(folder / output);
        };
        reset();
        const auto start = std::chrono::steady_clock::now();
        EXPECT_EQ(RunningSvt(folder.path(), arguments).status(), 0);
        const auto time = std::chrono::steady_clock::now() - start;
        const auto whole = left();
        ASSERT_TRUE(whole.contains(last));
        int met = 0;
        for (const int signal : {SIGTERM, SIGHUP, SIGPIPE})
            for (int n = 0; n < kTimes; ++n) {
                reset();
                RunningSvt svt(folder.path(), arguments);
                std::this_thread::sleep_for(time * n / kTimes);
                svt.send(signal);
                const int status = svt.status();
                met += WIFSIGNALED(status) && WTERMSIG(status) == signal ? 1 : 0;
                const std::string when = "signal " + std::to_string(signal) + ", " + std::to_string(n) + " of " +
                                         std::to_string(kTimes) + " of the time";
                EXPECT_TRUE(WIFSIGNALED(status) || status == 0) << "status " << status << ", " << when;
                ASSERT_FALSE(hasTemporary(folder.path())) << when;
                ASSERT_TRUE(fs::is_empty(folder / "tmp")) << when;
                const auto now = left();
                for (const auto& [name, content] : now)
                    EXPECT_TRUE(whole.contains(name) && content == whole.at(name)) << name << ", " << when;
                EXPECT_TRUE(!now.contains(last) || now.size() == whole.size()) << when;
            }
        EXPECT_GE(met, 3) << "the signals came too late";
    }

    // Runs `svt`; 120 s of processor time are for sanitizers.
    void runLong(const Arguments& arguments) {
        Limits limits;
        limits.seconds = 120;
        const CommandResult result = runSvt(folder.path(), arguments, limits);
        ASSERT_EQ(result.exitCode, 0) << arguments[0] << ": " << result.toString();
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
    runLong({"sample-city", "--buildings", "40", "-o", "models"});
    runLong({"city-plan", "models", "-o", "city", "--spacing", "1", "--pack-seconds", "0.05"});
    for (const int signal : kEndingSignals)
        expectNothingLeft({"city-run", "city", "--jobs", "2"}, folder / "city", signal, [&] {
            for (const char* part : {"packs", "reports", "city.json", "index.bin", "ids.bin", "words.bin", "packs.bin"})
                fs::remove_all(folder / "city" / part);
        });
    // What is done stays, and the same command goes on from there.
    runLong({"city-run", "city"});
    runLong({"city-info", "city"});
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

TEST_F(Signals, LeaveNothingOfAPublishedPage) {
    writeText(folder / "two.gml", twoBoxes());
    fs::create_directories(folder / "page/assets");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    for (int n = 0; n < 20; ++n) writeText(folder / ("page/assets/" + std::to_string(n) + ".js"), "1");
    const Arguments publish{"publish", "two.gml", "-o", "site", "--viewer", "page", "--spacing", "0.5"};
    for (const int signal : {SIGTERM, SIGHUP, SIGPIPE})
        expectNothingLeft(publish, folder / "site", signal, [&] { fs::remove_all(folder / "site"); });
    expectWholeAtAnyTime(publish, "site", "index.html", [&] { fs::remove_all(folder / "site"); });
}

TEST_F(Signals, LeaveNothingOfSheets) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    // Sheets are written in order.
    runSvtWell(folder.path(), {"sheets", "two.svt", "--svg", "sheets"});
    const std::size_t count = contentBelow(folder / "sheets").size();
    expectWholeAtAnyTime({"sheets", "two.svt", "--svg", "sheets"}, "sheets", "sheet-" + std::to_string(count) + ".svg",
                         [&] { fs::remove_all(folder / "sheets"); });
    expectWholeAtAnyTime({"sheets", "two.svt", "-o", "o.pdf"}, "o.pdf", "", [&] { fs::remove(folder / "o.pdf"); });
}

TEST_F(Signals, LeaveNothingOfAPlanAndOfAMerge) {
    runLong({"sample-city", "--buildings", "40", "-o", "models"});
    const Arguments plan{"city-plan", "models", "-o", "city", "--spacing", "2", "--pack-seconds", "0.05"};
    expectWholeAtAnyTime(plan, "city", "plan/plan.json", [&] { fs::remove_all(folder / "city"); });
    fs::remove_all(folder / "city");
    runLong(plan);
    runLong({"city-run", "city"});
    fs::rename(folder / "city", folder / "run");
    expectWholeAtAnyTime({"city-merge", "city"}, "city", "city.json", [&] {
        fs::remove_all(folder / "city");
        fs::create_directory(folder / "city");
        for (const char* part : {"plan", "reports"})
            fs::copy(folder / "run" / part, folder / "city" / part, fs::copy_options::recursive);
        fs::create_directory(folder / "city/packs");
        // Those behind the packs of the plan are made by the merge.
        for (const auto& report : fs::directory_iterator(folder / "run/reports")) {
            const std::string pack = "packs/" + report.path().stem().string() + ".svtp";
            fs::copy(folder / "run" / pack, folder / "city" / pack);
        }
    });
}

// A server that takes uploads, and a client of it.
class Uploads : public Signals {
protected:
    using IsAtWork = std::function<bool(pid_t server)>;

    Uploads() {
        fs::create_directory(folder / "page");
        writeText(folder / "page/index.html", "<!doctype html><head></head>");
    }

    // Starts a server, sends it bytes of an upload until it is at work, and then the signal: nothing temporary and no child process
    // is left.
    void expectNothingOfAnUpload(int signal, const std::string& sent, std::size_t promised,
                                 const IsAtWork& isAtWorkOf) {
        RunningSvt svt(folder.path(), {"serve", "--viewer", "page", "--port", "0", "--allow-uploads"});
        const auto isAtWork = [&] { return isAtWorkOf(svt.process()); };
        const int port = portOf(svt);
        ASSERT_NE(port, 0);
        serve::Client client(port);
        client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
        ASSERT_EQ(client.receive().status, 200) << "signals are watched from here on";
        ASSERT_FALSE(fs::is_empty(folder / "tmp"));
        // An upload that was done before it was seen is sent again.
        std::vector<serve::Client> uploads;
        for (int attempt = 0; attempt < 20 && !svt.isOver() && !isAtWork(); ++attempt) {
            uploads.emplace_back(port);
            uploads.back().send("POST /api/convert?name=two.gml HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
                                std::to_string(promised) + "\r\n\r\n" + sent);
            const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
            while (!svt.isOver() && !isAtWork() && std::chrono::steady_clock::now() < end) {
            }
        }
        ASSERT_FALSE(svt.isOver()) << "status " << svt.status();
        const std::vector<pid_t> children = childrenOf(svt.process());
        svt.send(signal);
        const int status = svt.status();
        if (signal == SIGTERM)
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "status " << status;
        else
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << "status " << status;
        EXPECT_TRUE(fs::is_empty(folder / "tmp"))
            << "signal " << signal << " leaves " << contentBelow(folder / "tmp").begin()->first;
        for (const pid_t child : children) EXPECT_NE(::kill(child, 0), 0) << "the conversion is at work";
    }

    // Whether a file that `isMeant` lies below the temporary folder.
    bool hasFile(const std::function<bool(const fs::path&)>& isMeant) const {
        std::error_code failed;
        for (fs::recursive_directory_iterator at(folder / "tmp", failed), end; !failed && at != end;
             at.increment(failed))
            if (isMeant(at->path())) return true;
        return false;
    }
};

TEST_F(Uploads, AreRemovedWhereASignalComesInTheMiddle) {
    const auto hasBody = [&](pid_t) {
        return hasFile([](const fs::path& file) {
            std::error_code failed;
            return fs::is_regular_file(file, failed) && fs::file_size(file, failed) > 0 && !failed;
        });
    };
    for (const int signal : {SIGTERM, SIGHUP, SIGPIPE})
        expectNothingOfAnUpload(signal, std::string(400'000, ' '), 1'000'000, hasBody);
}

TEST_F(Uploads, AreRemovedWhereASignalComesDuringTheirConversion) {
    if (kIsSanitized) GTEST_SKIP() << "a sanitizer needs more address space than a conversion may have";
    const std::string model = twoBoxes();
    // Where the system does not tell of children, the file of the model comes just before the child.
    const auto isConverting = [&](pid_t server) {
        return hasFile([](const fs::path& file) { return file.filename() == "two.gml"; }) &&
               (!fs::exists("/proc/thread-self/children") || !childrenOf(server).empty());
    };
    for (const int signal : {SIGTERM, SIGHUP, SIGPIPE})
        expectNothingOfAnUpload(signal, model, model.size(), isConverting);
}

}  // namespace
}  // namespace svt::test
