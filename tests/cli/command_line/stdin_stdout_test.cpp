// '-' as input and output of every command: the same bytes as with files, messages on stderr, nothing left behind.
#include <tests/cli/command_line/shell_line.hpp>
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <fcntl.h>
#include <stdlib.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

class Dash : public ::testing::Test {
protected:
    Dash() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    }

    // The line ends with `exitCode`, `text` on stderr, nothing on stdout, and no temporary file.
    void expectRefused(const std::string& line, int exitCode, const std::string& text) const {
        const LineResult result = runLine(folder.path(), line);
        EXPECT_EQ(result.exitCode, exitCode) << line << ": " << result.toString();
        EXPECT_NE(result.err.find(text), std::string::npos) << line << ": expected " << text << "\n"
                                                            << result.toString();
        EXPECT_EQ(result.out, "") << line;
        EXPECT_TRUE(isTmpEmpty(folder.path())) << line;
    }

    TemporaryFolder folder;
};

TEST_F(Dash, IsStdinForEveryCommandWithOneInput) {
    fs::copy_file(folder / "two.gml", folder / "stdin");
    // Commands that print their result; IN is the model or the volume.
    for (const std::string line :
         {"svt info IN --spacing 0.5", "svt info IN --spacing 0.5 --tree", "svt check IN", "svt check IN --json",
          "svt query IN all --spacing 0.5", "svt query IN all --spacing 0.5 --json",
          "svt section IN --plane z=1 --json --spacing 0.5", "svt shell IN --levels --json --spacing 0.5",
          "svt render IN -o o.png --size 64x36 --spacing 0.5; cat o.png", "svt thumbnail IN -o o.png; cat o.png",
          "svt section IN -o o.svg --plane z=1 --spacing 0.5; cat o.svg",
          "svt sheets IN -o o.pdf --spacing 0.5; cat o.pdf", "svt shell IN -o o.glb --spacing 0.5; cat o.glb",
          "svt convert IN o.nrrd --spacing 0.5; cat o.nrrd"}) {
        const auto with = [&](const std::string& input, const std::string& before) {
            std::string text = line;
            text.replace(text.find("IN"), 2, input);
            const LineResult result = runLine(folder.path(), before + text);
            EXPECT_TRUE(result.exitCode == 0 || result.exitCode == kInvalid) << text << ": " << result.toString();
            return result.out;
        };
        const std::string expected = with("stdin", "");  // volumes keep the name of their source
        EXPECT_FALSE(expected.empty());
        EXPECT_TRUE(with("-", "cat two.gml | ") == expected) << line;
        EXPECT_TRUE(isTmpEmpty(folder.path())) << line;
    }
    for (const std::string line :
         {"svt info IN", "svt query IN all", "svt render IN -o o.png --size 64x36; cat o.png"}) {
        const auto with = [&](const std::string& input, const std::string& before) {
            std::string text = line;
            text.replace(text.find("IN"), 2, input);
            return runLineWell(folder.path(), before + text);
        };
        EXPECT_TRUE(with("-", "cat two.svt | ") == with("two.svt", "")) << line;
    }
    // Other inputs than the first one.
    writeText(folder / "owners.csv", "feature,owner\nleft,A\nright,B\n");
    EXPECT_EQ(runLineWell(folder.path(), "svt query two.svt all --owners - --json < owners.csv"),
              runLineWell(folder.path(), "svt query two.svt all --owners owners.csv --json"));
}

// For each command with outputs: arguments, with OUT for the output, and the format where the command has several.
struct Written {
    std::string arguments, ending, format;
};
const std::vector<Written>& writtenByCommands() {
    static const std::vector<Written> kAll{
        {"sample house -o OUT", ".gml", "citygml3"},
        {"sample house -o OUT", ".json", "cityjson"},
        {"sample house -o OUT", ".ifc", "ifc"},
        {"build two.gml --spacing 0.5 -o OUT", ".svt", ""},
        {"check two.gml --report OUT", ".html", ""},
        {"render two.svt --size 64x36 -o OUT", ".png", ""},
        {"render two.svt --size 64x36 -o OUT", ".svg", "svg"},
        {"render two.gml --spacing 0.5 --size 64x36 -o OUT", ".pdf", "pdf"},
        {"render two.svt --size 64x36 -o /dev/null --labels OUT", ".png", ""},
        {"render two.svt --size 64x36 -o /dev/null --write-scene OUT", ".json", ""},
        {"thumbnail two.svt -o OUT", ".png", ""},
        {"section two.svt --plane z=1 -o OUT", ".svg", "svg"},
        {"section two.svt --plane z=1 -o OUT", ".dxf", "dxf"},
        {"section two.svt --plane z=1 -o OUT", ".geojson", "geojson"},
        {"sheets two.gml --spacing 0.5 -o OUT", ".pdf", "pdf"},
        {"cadastre tower.svt -o OUT", ".gml", "citygml"},
        {"cadastre tower.svt -o OUT", ".pdf", "pdf"},
        {"query two.svt all -o OUT", ".csv", "csv"},
        {"query two.svt all -o OUT", ".geojson", "geojson"},
        {"query two.svt all -o OUT", ".parquet", "objectparquet"},
        {"quantities two.svt -q -o OUT", ".csv", "csv"},
        {"quantities two.svt -q -o OUT", ".json", "json"},
        {"quantities two.svt -q -o OUT", ".parquet", "objectparquet"},
        {"quantities two.svt -q -o OUT", ".xlsx", "xlsx"},
        {"quantities small.ifc --spacing 1 -q -o OUT", ".ifc", "ifc"},
        {"field add two.svt co2.csv --places places.csv --unit [ppm] -o OUT", ".svt", ""},
        {"field remove field.svt co2 -o OUT", ".svt", ""},
        {"simulate heat tower.svt --leaky -q -o OUT", ".svt", ""},
        {"simulate spread air.svt co2 -q -o OUT", ".svt", ""},
        {"field export field.svt co2 -o OUT", ".csv", "csv"},
        {"field export field.svt co2 -o OUT", ".json", "json"},
        {"field export field.svt co2 -o OUT", ".parquet", "objectparquet"},
        {"field export warm.svt temperature -o OUT", ".vti", "vti"},
        {"field export warm.svt temperature -o OUT", ".vtr", "vtr"},
        {"field export warm.svt temperature -o OUT", ".nrrd", "nrrd"},
        {"field stats field.svt co2 -o OUT", ".csv", "csv"},
        {"field stats field.svt co2 -o OUT", ".json", "json"},
        {"field stats field.svt co2 -o OUT", ".parquet", "objectparquet"},
        {"field probe field.svt co2 --at 500002,5400003,101 -o OUT", ".csv", "csv"},
        {"field probe field.svt co2 --at 500002,5400003,101 -o OUT", ".json", "json"},
        {"field probe field.svt co2 --at 500002,5400003,101 -o OUT", ".parquet", "objectparquet"},
        {"diff two.gml two.gml --spacing 0.5 -o OUT", ".csv", "csv"},
        {"diff two.gml two.gml --spacing 0.5 -o OUT", ".svt", "svt"},
        {"diff two.gml two.gml --spacing 0.5 -o OUT", ".html", "html"},
        {"diff two.gml two.gml --spacing 0.5 -o OUT", ".bcf", "bcf"},
        {"shell two.svt -o OUT", ".svt", "svt"},
        {"shell two.svt -o OUT", ".glb", "glb"},
        {"convert two.svt OUT", ".nrrd", "nrrd"},
        {"convert two.svt OUT", ".vti", "vti"},
        {"convert two.svt OUT", ".x3d", "x3d"},
        {"convert two.svt OUT", ".glb", "glb"},
        {"city extract town --box=-1e7,-1e7,-1e7,1e7,1e7,1e7 -o OUT", ".svt", ""},
    };
    return kAll;
}

TEST_F(Dash, IsStdoutForEveryCommandWithOneOutput) {
    runLineWell(folder.path(), "svt city plan two.gml -o town --spacing 1 -q && svt city run town -q");
    runLineWell(folder.path(),
                "svt sample tower --storeys 1 -o tower.gml && svt build tower.gml -o tower.svt --spacing 1 -q && "
                "svt simulate heat tower.svt --leaky -q -o warm.svt && svt sample house -o small.ifc");
    writeText(folder / "co2.csv", "time,sensor,value\n0,s1,400\n900,s1,500\n");
    writeText(folder / "places.csv", "name,x,y,z\ns1,500002,5400003,101\n");
    writeText(folder / "rooms.csv", "name,room\ns1,tower_S00_common\n");
    runLineWell(folder.path(),
                "svt field add tower.svt co2.csv --places rooms.csv --unit [ppm] --name co2 -o air.svt -q");
    runLineWell(
        folder.path(),
        "svt field add two.svt co2.csv --places places.csv --unit [ppm] --medium all --name co2 -o field.svt -q");
    std::set<std::string> tested;
    for (const Written& written : writtenByCommands()) {
        const auto with = [&](const std::string& output) {
            std::string text = written.arguments;
            return "svt " + text.replace(text.find("OUT"), 3, output);
        };
        const std::string format = written.format.empty() ? "" : " --format " + written.format;
        const bool isOfSample = written.arguments.starts_with("sample");
        fs::remove(folder / ("o" + written.ending));
        const LineResult toFile = runLine(folder.path(), with("o" + written.ending) + (isOfSample ? format : ""));
        const LineResult toStdout = runLine(folder.path(), with("-") + format);
        EXPECT_TRUE(toFile.exitCode == 0 || toFile.exitCode == kInvalid) << toFile.toString();
        EXPECT_EQ(toStdout.exitCode, toFile.exitCode) << with("-") << ": " << toStdout.toString();
        EXPECT_TRUE(toStdout.out == readText(folder / ("o" + written.ending)))
            << with("-") << ": " << toStdout.out.size() << " bytes\n"
            << toStdout.err;
        EXPECT_EQ(toStdout.err.find("/tmp/"), std::string::npos) << "a name of a temporary file: " << toStdout.err;
        EXPECT_TRUE(isTmpEmpty(folder.path())) << with("-");
        std::istringstream words(written.arguments);
        std::string command, second;
        words >> command >> second;
        const bool isGroup = command == "city" || command == "field" || command == "simulate";
        tested.insert(isGroup ? command + "-" + second : command);
    }
    // Each command that writes a file is in the table.
    const nlohmann::json described = runSvtForJson(folder.path(), {"describe", "json"});
    for (const auto& command : described.at("commands"))
        for (const auto& option : command.at("options")) {
            if (option.value("file", "") != "output") continue;
            EXPECT_TRUE(tested.contains(command.at("name"))) << command.at("name") << " is not tested";
        }
}

TEST_F(Dash, MakesPipes) {
    const std::string picture =
        runLineWell(folder.path(),
                    "svt sample house -o - --format cityjson | svt build - -o - --spacing 0.3 | "
                    "svt render - -o - --size 64x36 --format png");
    EXPECT_EQ(picture.substr(1, 3), "PNG");
    runLineWell(folder.path(),
                "svt sample house -o house.json && svt build house.json -o house.svt --spacing 0.3 -q && "
                "svt render house.svt -o house.png --size 64x36");
    EXPECT_TRUE(picture == readText(folder / "house.png"));
    EXPECT_TRUE(isTmpEmpty(folder.path()));
}

TEST_F(Dash, PrintsMessagesOnStderr) {
    const LineResult built = runLine(folder.path(), "svt build two.gml -o - --spacing 0.5");
    EXPECT_NE(built.err.find("stdout: 2 objects"), std::string::npos) << built.err;
    EXPECT_EQ(runLine(folder.path(), "svt build two.gml -o - --spacing 0.5 -q").err, "");
    const LineResult checked = runLine(folder.path(), "svt check two.gml --report -");
    EXPECT_NE(checked.err.find("2 objects: 2 solids"), std::string::npos) << checked.err;
    EXPECT_TRUE(checked.out.starts_with("<!"));
    const LineResult broken = runLine(folder.path(), "echo '<a><b></a>' | svt info -");
    EXPECT_EQ(broken.exitCode, kInput);
    EXPECT_NE(broken.err.find(": stdin"), std::string::npos) << broken.err;
    EXPECT_EQ(broken.err.find("tmp/"), std::string::npos) << broken.err;
}

TEST_F(Dash, IsRefusedWhereItHasNoMeaning) {
    writeText(folder / "my.style.json", R"({"rules": []})");
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    expectRefused("cat two.gml | svt build - - -o o.svt", kUsage,
                  "E904 BadArgument: stdin ('-') is given as two inputs");
    expectRefused("cat two.svt | svt render - --with - -o o.png", kUsage, "two inputs");
    expectRefused("cat two.gml | svt city plan - -o town", kUsage, "'input' is '-': later commands read it again");
    expectRefused("cat my.style.json | svt build two.gml -o o.svt --style -", kUsage, "'--style' is '-'");
    expectRefused("svt city info -", kUsage, "'folder' is '-': it reads a folder");
    expectRefused("svt publish two.svt -o - --viewer page", kUsage, "'--output' is '-': it writes a folder");
    expectRefused("svt sheets two.svt --svg -", kUsage, "'--svg' is '-': it writes a folder");
    expectRefused("svt convert two.svt - --format zarr", kUsage, "zarr is a folder");
    expectRefused("svt convert two.svt -", kUsage, "'output' is '-': give its format with --format: nrrd, ");
    expectRefused("svt section two.svt -o - --plane z=1", kUsage,
                  "give its format with --format: svg, pdf, dxf, geojson");
    expectRefused("svt section two.svt --table - --plane z=1", kUsage, "'--table' is '-': its format is unknown");
    expectRefused("svt section two.svt -o - --format png --plane z=1", kUsage, "'png' is not possible");
    expectRefused("svt build two.gml -o - --json", kUsage, "--json writes to stdout, too");
    expectRefused("svt render two.svt -o - --labels -", kUsage, "stdout takes only one output");
    expectRefused("svt render two.svt -o - --frames 3 --section z=1..2", kUsage, "leave out --frames");
    expectRefused("svt section two.svt -o plan --format svg --plane z=1", kUsage, "instead of --format");
    expectRefused("svt query two.svt all --format csv", kUsage, "--format is the format of an output");
    expectRefused("svt section two.svt -o plan.svg --format pdf --plane z=1", kUsage, "cannot write '.svg'");
    // A format that writes a second file.
    expectRefused("svt convert two.svt - --format x3d --texture image", kOutput, "beside the output");
    EXPECT_FALSE(fs::exists(folder / "o.svt"));
}

TEST_F(Dash, LeavesStdoutEmptyAfterAnError) {
    expectRefused("svt build missing.gml -o -", kInput, "E101 CannotOpen: missing.gml");
    expectRefused("echo nonsense | svt build - -o -", kInput, "E103 UnknownFormat: stdin");
    expectRefused("svt section two.svt -o - --format svg --plane z=99", kUsage, "E503");
}

TEST_F(Dash, TakesAFileThatIsNamedSo) {
    fs::copy_file(folder / "two.svt", folder / "-");
    EXPECT_EQ(runLineWell(folder.path(), "svt info ./-"), runLineWell(folder.path(), "svt info two.svt"));
}

// ---- stdin ----------------------------------------------------------------------------------------------------------

TEST_F(Dash, OfAStreamWithoutEndEndsAtALimit) {
    for (const std::string line : {"yes | svt info - --max-input 1", "svt info - --max-input 1 < /dev/zero",
                                   "yes '{' | svt query - all --max-input 2"})
        expectRefused(line, kLimit, "E104 InputTooBig: stdin: stdin has more than");
}

TEST_F(Dash, OfAFileBehindStdinHasNoLimitAndNoCopy) {
    std::string model = twoBoxes();
    model.insert(model.rfind("</"), "<!--" + std::string(1'500'000, ' ') + "-->");
    writeText(folder / "large.gml", model);
    const std::string info = runLineWell(folder.path(), "svt info - --max-input 1 --spacing 0.5 < large.gml");
    EXPECT_NE(info.find("features"), std::string::npos);
    expectRefused("cat large.gml | svt info - --max-input 1", kLimit, "a higher --max-input permits more");
    // The rest of a file that was read in part.
    EXPECT_NE(runLineWell(folder.path(),
                          "{ head -c 5 > /dev/null; svt info - --spacing 0.5; } < <(echo -n 12345; cat two.gml)")
                  .find("features"),
              std::string::npos);
    // The file itself cannot be the output.
    expectRefused("svt build - -o two.svt < two.svt", kOutput, "E408 WouldDestroy: two.svt");
    expectRefused("svt shell - -o two.svt < two.svt", kOutput, "E408");
}

TEST_F(Dash, OfAnEmptyOrClosedStreamIsAnError) {
    for (const std::string line : {"svt info - <&-", "svt info - < /dev/null", "true | svt info -"})
        expectRefused(line, kInput, "E101 CannotOpen: stdin: stdin is empty or closed");
    expectRefused("svt info - < tmp", kInput, "E101 CannotOpen: stdin: stdin cannot be read");
    expectRefused(": > empty; svt info - < empty", kInput, "the file is empty");
}

TEST_F(Dash, NeedsAFolderForTemporaryFiles) {
    const LineResult result = runLine(folder.path(), "export TMPDIR=/missing; cat two.gml | svt info -");
    EXPECT_EQ(result.exitCode, kOutput) << result.toString();
    EXPECT_NE(result.err.find("set TMPDIR"), std::string::npos) << result.err;
}

// A process whose stdin is a pipe that the test fills.
TEST_F(Dash, LeavesNothingAfterASignal) {
    fs::create_directories(folder / "tmp");
    for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
        std::array<int, 2> pipe{};
        ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
        RunningSvt svt(folder.path(), {"info", "-"}, [&] { ::dup2(pipe[0], 0); });
        ::close(pipe[0]);
        EXPECT_EQ(::write(pipe[1], "<a>", 3), 3);
        while (!svt.isOver() && fs::is_empty(folder / "tmp")) ::poll(nullptr, 0, 1);
        svt.send(signal);
        const int status = svt.status();
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << "status " << status;
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "signal " << signal;
        ::close(pipe[1]);
    }
}

// ---- stdout ---------------------------------------------------------------------------------------------------------

TEST_F(Dash, OfAFullOrUnreadStdoutIsAnError) {
    const LineResult full = runLine(folder.path(), "svt build two.gml -o - --spacing 0.5 > /dev/full");
    EXPECT_EQ(full.exitCode, kOutput) << full.toString();
    EXPECT_TRUE(isTmpEmpty(folder.path()));
    const LineResult unread = runLine(folder.path(), "svt sample tower -o - --format citygml3 | head -c 10");
    EXPECT_EQ(unread.exitCode, 141) << unread.toString();
    EXPECT_EQ(unread.out.size(), 10u);
    EXPECT_TRUE(isTmpEmpty(folder.path()));
}

TEST_F(Dash, RefusesBinaryDataToATerminal) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0) GTEST_SKIP() << "there is no terminal";
    const std::string name = ::ptsname(terminal);
    fs::create_directories(folder / "tmp");
    const auto exitCodeOf = [&](const std::vector<std::string>& arguments) {
        RunningSvt svt(folder.path(), arguments, [&] {
            ::dup2(::open(name.c_str(), O_RDWR | O_NOCTTY), 1);
            ::dup2(::open("err", O_CREAT | O_TRUNC | O_WRONLY, 0600), 2);
        });
        std::string shown(100'000, '\0');
        while (!svt.isOver()) {
            pollfd wait{terminal, POLLIN, 0};
            if (::poll(&wait, 1, 10) == 1 && (wait.revents & POLLIN) != 0)
                static_cast<void>(!::read(terminal, shown.data(), shown.size()));
        }
        return WEXITSTATUS(svt.status());
    };
    EXPECT_EQ(exitCodeOf({"build", "two.gml", "-o", "-", "--spacing", "0.5"}), kOutput);
    EXPECT_NE(readText(folder / "err").find("E404 CannotWrite: stdout is a terminal"), std::string::npos)
        << readText(folder / "err");
    EXPECT_EQ(exitCodeOf({"render", "two.svt", "-o", "-", "--format", "png"}), kOutput);
    EXPECT_EQ(exitCodeOf({"section", "two.svt", "-o", "-", "--format", "svg", "--plane", "z=1"}), kDone);
    ::close(terminal);
}

}  // namespace
}  // namespace svt::test
