// svt FILE: the viewer at the terminal of a desktop, else svt info.
#include <tests/cli/command_line/shell_line.hpp>
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <svt/serve/http_client_test.hpp>

#include <fcntl.h>
#include <stdlib.h>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

class ImpliedCommand : public ::testing::Test {
protected:
    ImpliedCommand() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    }
    TemporaryFolder folder;
};

TEST_F(ImpliedCommand, IsInfoWithoutADisplay) {
    const std::string expected = runSvtWell(folder.path(), {"info", "two.svt"});
    const LineResult plain = runLine(folder.path(), "unset DISPLAY WAYLAND_DISPLAY; svt two.svt");
    EXPECT_EQ(plain.exitCode, 0) << plain.toString();
    EXPECT_EQ(plain.out, expected);
    EXPECT_EQ(plain.err, "svt: there is no display: svt info\n");
    const LineResult piped = runLine(folder.path(), "export DISPLAY=:99; svt two.svt");
    EXPECT_EQ(piped.out, expected);
    EXPECT_EQ(piped.err, "svt: stdout is not a terminal: svt info\n");
    EXPECT_EQ(runLine(folder.path(), "svt two.svt --quiet").err, "");
    // Options are those of svt info.
    EXPECT_EQ(runLineWell(folder.path(), "svt two.svt --json"),
              runSvtWell(folder.path(), {"info", "two.svt", "--json"}));
    EXPECT_EQ(runLineWell(folder.path(), "svt ./two.gml --spacing 0.5"),
              runSvtWell(folder.path(), {"info", "two.gml", "--spacing", "0.5"}));
    EXPECT_EQ(runLineWell(folder.path(), "cat two.svt | svt -"), expected);
    EXPECT_NE(runLineWell(folder.path(), "svt two.svt --help").find("--tree"), std::string::npos);
}

TEST_F(ImpliedCommand, TakesTheFolderOfACity) {
    runLineWell(folder.path(), "svt city plan two.gml -o town --spacing 1 -q && svt city run town -q");
    EXPECT_EQ(runLineWell(folder.path(), "svt town"), runSvtWell(folder.path(), {"info", "town"}));
    EXPECT_EQ(runLineWell(folder.path(), "svt town/ --json"), runSvtWell(folder.path(), {"info", "town", "--json"}));
}

TEST_F(ImpliedCommand, CommandsPrecedeFiles) {
    fs::copy_file(folder / "two.svt", folder / "info");
    fs::copy_file(folder / "two.svt", folder / "city");
    EXPECT_EQ(runLine(folder.path(), "svt info").exitCode, kUsage);
    EXPECT_NE(runLine(folder.path(), "svt city").err.find("one of"), std::string::npos);
    EXPECT_EQ(runLineWell(folder.path(), "svt ./info"), runSvtWell(folder.path(), {"info", "two.svt"}));
}

TEST_F(ImpliedCommand, OtherWordsAreErrorsAsBefore) {
    for (const auto& [word, text] :
         std::vector<std::pair<std::string, std::string>>{{"biuld", "did you mean build?"},
                                                          {"missing.gml", "svt: see 'svt --help'"},
                                                          {"renderr", "did you mean render?"}}) {
        const CommandResult result = runSvt(folder.path(), {word});
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
        EXPECT_EQ(result.out, "");
    }
    EXPECT_EQ(runSvt(folder.path(), {"--nonsense"}).exitCode, kUsage);
    EXPECT_EQ(runSvt(folder.path(), {""}).exitCode, kUsage);
    // A file of another kind is an error of svt info.
    writeText(folder / "notes.txt", "milk");
    const CommandResult other = runSvt(folder.path(), {"notes.txt"});
    EXPECT_EQ(other.exitCode, kInput);
    EXPECT_NE(other.err.find("E103"), std::string::npos) << other.err;
}

TEST_F(ImpliedCommand, IsViewAtTheTerminalOfADesktop) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0) GTEST_SKIP() << "there is no terminal";
    const std::string name = ::ptsname(terminal);
    fs::create_directories(folder / "tmp");
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    const auto prepare = [&](bool hasDisplay) {
        return [&, hasDisplay] {
            ::dup2(::open(name.c_str(), O_RDWR | O_NOCTTY), 1);
            ::unsetenv("WAYLAND_DISPLAY");
            hasDisplay ? ::setenv("DISPLAY", ":99", 1) : ::unsetenv("DISPLAY");
        };
    };
    RunningSvt view(folder.path(), {"two.svt", "--viewer", "page", "--no-browser"}, prepare(true));
    const int port = portOf(view);
    ASSERT_NE(port, 0);
    serve::Client client(port);
    client.send("GET /models/two.svt HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_TRUE(client.receive().body == readText(folder / "two.svt"));
    view.send(SIGTERM);
    EXPECT_EQ(view.status(), 0);
    // Without a display, --tree is an option: it is svt info.
    RunningSvt info(folder.path(), {"two.svt", "--tree"}, prepare(false));
    EXPECT_EQ(info.status(), 0);
    ::close(terminal);
}

}  // namespace
}  // namespace svt::test
