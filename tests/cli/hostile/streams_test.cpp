// Standard streams that are closed, full or read by nobody: the command ends with its documented exit code, and no message gets
// into a file.
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <svt/serve/http_client_test.hpp>

#include <csignal>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr int kMasksOfStreams = 8;  // bits 0, 1 and 2: stdin, stdout and stderr
constexpr int kReaderGone = 141;    // docs/user/exit-codes.md

void closeStreams(int mask) {
    for (const int stream : {0, 1, 2})
        if ((mask >> stream & 1) != 0) ::close(stream);
}

// stdout becomes a pipe that nobody reads.
void loseReader() {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) ::_exit(125);
    ::close(pipe[0]);
    ::dup2(pipe[1], 1);
}

class Streams : public ::testing::Test {
protected:
    Streams() {
        fs::create_directory(folder / "tmp");
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "1"});
    }

    void removeOutputs() const {
        std::vector<fs::path> outputs;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            if (entry.path().filename().string().starts_with("o")) outputs.push_back(entry.path());
        for (const fs::path& output : outputs) fs::remove_all(output);
    }

    // With each set of closed streams the exit code is 0, and all files are those of a run with open streams.
    void expectSameFiles(const Arguments& arguments) const {
        std::map<std::string, std::string> expected;
        for (int mask = 0; mask < kMasksOfStreams; ++mask) {
            removeOutputs();
            RunningSvt svt(folder.path(), arguments, [mask] { closeStreams(mask); });
            EXPECT_EQ(svt.status(), 0) << arguments[0] << ", closed: " << mask;
            if (mask == 0) expected = contentBelow(folder.path());
            EXPECT_TRUE(contentBelow(folder.path()) == expected) << arguments[0] << ", closed: " << mask;
        }
    }

    TemporaryFolder folder;
};

TEST_F(Streams, ThatAreClosedTakeNoMessage) {
    expectSameFiles({"query", "two.svt", "all", "--json"});
    expectSameFiles({"info", "two.svt"});
    expectSameFiles({"build", "two.gml", "-o", "o.svt", "--spacing", "1", "--verbose"});
    expectSameFiles({"convert", "two.svt", "o.nrrd"});
    expectSameFiles({"convert", "two.svt", "o.zarr"});
    if (hasProgram("ffmpeg -version"))
        expectSameFiles({"render", "two.svt", "-o", "o.gif", "--turn", "90", "--seconds", "0.1", "--size", "32x32"});
}

TEST_F(Streams, ThatAreClosedTakeNoMessageOfACity) {
    runSvtWell(folder.path(), {"city-plan", "two.gml", "-o", "plan", "--spacing", "1"});
    std::map<std::string, std::string> expected;
    for (int mask = 0; mask < kMasksOfStreams; ++mask) {
        fs::remove_all(folder / "city");
        fs::copy(folder / "plan", folder / "city", fs::copy_options::recursive);
        RunningSvt svt(folder.path(), {"city-run", "city"}, [mask] { closeStreams(mask); });
        EXPECT_EQ(svt.status(), 0) << "closed: " << mask;
        if (mask == 0) expected = contentBelow(folder.path());
        EXPECT_TRUE(contentBelow(folder.path()) == expected) << "closed: " << mask;
    }
    EXPECT_TRUE(expected.contains("city/city.json"));
}

// The message of an error has nowhere to go.
TEST_F(Streams, ThatAreClosedKeepTheExitCodeOfAnError) {
    const auto before = contentBelow(folder.path());
    for (int mask = 1; mask < kMasksOfStreams; ++mask)
        for (const Arguments& arguments :
             {Arguments{"info", "missing.gml"}, Arguments{"build", "missing.gml", "-o", "two.svt"},
              Arguments{"convert", "two.gml", "missing/o.nrrd"}, Arguments{"serve", "missing.svt"}}) {
            RunningSvt svt(folder.path(), arguments, [mask] { closeStreams(mask); });
            const int status = svt.status(), expected = arguments[0] == "convert" ? kOutput : kInput;
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == expected)
                << arguments[0] << ", closed: " << mask << ": status " << status;
        }
    EXPECT_TRUE(contentBelow(folder.path()) == before);
}

TEST_F(Streams, ThatAreClosedKeepNoServerFromServing) {
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    const auto before = contentBelow(folder.path());
    for (int mask = 1; mask < kMasksOfStreams; ++mask) {
        RunningSvt svt(folder.path(), {"serve", "two.svt", "--viewer", "page", "--port", "0"},
                       [mask] { closeStreams(mask); });
        const int port = portOf(svt);
        ASSERT_NE(port, 0) << "closed: " << mask;
        serve::Client client(port);
        client.send("GET /models/two.svt HTTP/1.1\r\nHost: localhost\r\n\r\n");
        ASSERT_TRUE(client.receive().body == before.at("two.svt")) << "closed: " << mask;
        svt.send(SIGTERM);
        EXPECT_EQ(svt.status(), 0) << "closed: " << mask;
    }
    EXPECT_TRUE(contentBelow(folder.path()) == before);
}

TEST_F(Streams, ThatAreFullDoNotAbort) {
    for (const Arguments& arguments : {Arguments{"info", "missing.gml"}, Arguments{"query", "two.svt", "gone = ("}}) {
        RunningSvt svt(folder.path(), arguments, [] { ::dup2(::open("/dev/full", O_WRONLY), 2); });
        const int status = svt.status(), expected = arguments[0] == "info" ? kInput : kUsage;
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == expected) << "status " << status;
    }
    for (const Arguments& arguments : {Arguments{"info", "two.svt"}, Arguments{"describe", "json"}}) {
        RunningSvt svt(folder.path(), arguments, [] { ::dup2(::open("/dev/full", O_WRONLY), 1); });
        const int status = svt.status();
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kOutput) << "status " << status;
    }
}

// Outputs are whole: the summary is printed behind them.
TEST_F(Streams, ThatNobodyReadsEndTheCommandAndLeaveWholeFiles) {
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    for (const Arguments& arguments :
         {Arguments{"query", "two.svt", "all", "--json"}, Arguments{"info", "two.svt"}, Arguments{"describe", "json"},
          Arguments{"build", "two.gml", "-o", "o.svt", "--spacing", "1"}, Arguments{"sheets", "two.svt", "-o", "o.pdf"},
          Arguments{"publish", "two.svt", "-o", "o", "--viewer", "page"},
          Arguments{"city-plan", "two.gml", "-o", "o", "--spacing", "1"}}) {
        removeOutputs();
        EXPECT_EQ(RunningSvt(folder.path(), arguments).status(), 0) << arguments[0];
        const auto whole = contentBelow(folder.path());
        for (const bool isIgnored : {false, true}) {
            removeOutputs();
            RunningSvt svt(folder.path(), arguments, [isIgnored] {
                if (isIgnored) std::signal(SIGPIPE, SIG_IGN);
                loseReader();
            });
            const int status = svt.status();
            if (isIgnored)
                EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kReaderGone)
                    << arguments[0] << ": status " << status;
            else
                EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE)
                    << arguments[0] << ": status " << status;
            EXPECT_TRUE(contentBelow(folder.path()) == whole) << arguments[0];
        }
    }
}

// What is printed is more than a pipe holds.
TEST_F(Streams, ThatTheirReaderClosesEndTheCommand) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    RunningSvt svt(folder.path(), {"describe", "json"}, [&] { ::dup2(pipe[1], 1); });
    ::close(pipe[1]);
    char first = 0;
    EXPECT_EQ(::read(pipe[0], &first, 1), 1);
    EXPECT_EQ(first, '{');
    ::close(pipe[0]);
    const int status = svt.status();
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE) << "status " << status;
}

}  // namespace
}  // namespace svt::test
