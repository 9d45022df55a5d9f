// What `svt doctor` says of this machine, and of one that lacks something.
#include "run_command.hpp"

#include <svt/core/machine.hpp>

#include <cstdlib>
#include <optional>
#include <regex>
#include <sstream>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A graphics driver compiles shaders, and maps more memory than it uses.
Limits limits() {
    Limits limits;
    limits.seconds = 60;
    limits.memoryBytes = std::uint64_t{8} << 30;
    return limits;
}

// A variable of the environment while the object lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
    }
    ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

json answers() {
    const TemporaryFolder folder;
    const CommandResult result = runSvt(folder.path(), {"doctor", "--json"}, limits());
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(folder.count(), 0) << "something was left in the folder";
    return result.json();
}

TEST(Doctor, SaysOneLineAPoint) {
    const TemporaryFolder folder;
    const CommandResult result = runSvt(folder.path(), {"doctor"}, limits());
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    std::vector<std::string> titles;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(std::regex_match(line, std::regex("[a-zA-Z ]{16}  (ok     |warning)  [^ ].*"))) << line;
        titles.push_back(line.substr(0, line.find("  ")));
    }
    const std::vector<std::string> always{"program",        "processor",   "memory",      "graphics",
                                          "viewer",         "browser",     "font",        "temporary folder",
                                          "current folder", "test volume", "test picture"};
    titles.resize(always.size());  // "test OpenGL" comes last, where there is a driver
    EXPECT_EQ(titles, always);
}

TEST(Doctor, SaysTheSameAsJson) {
    const json all = answers();
    EXPECT_GE(all["processor"]["cores"].get<int>(), 1);
    EXPECT_GT(all["memory"]["total"].get<double>(), 1e8);
    EXPECT_EQ(all["font"]["state"], "ok");
    EXPECT_EQ(all["currentFolder"]["writable"], true);
    EXPECT_EQ(all["testVolume"]["dimension"].size(), 3u);
    EXPECT_GT(all["testVolume"]["seconds"].get<double>(), 0);
    EXPECT_GT(all["testPicture"]["seconds"].get<double>(), 0);
    std::string worst = "ok";
    for (const auto& [key, answer] : all.items()) {
        if (key == "state") continue;
        EXPECT_FALSE(answer["text"].get<std::string>().empty()) << key;
        if (answer["state"] != "ok") worst = answer["state"];
    }
    EXPECT_EQ(all["state"], worst);
}

TEST(Doctor, NamesTheBuildAsVersionDoes) {
    const TemporaryFolder folder;
    const std::string version = runSvtWell(folder.path(), {"--version"});
    const json program = answers()["program"];
    for (const char* key : {"version", "commit", "compiler", "kind", "openGl"})
        EXPECT_NE(version.find(program[key].get<std::string>()), std::string::npos) << key << "\n" << version;
    EXPECT_FALSE(program["simdTargets"].empty());
}

TEST(Doctor, OpenGlDrawsThePictureOfTheCpu) {
    const json all = answers();
    if (!all["graphics"]["available"]) GTEST_SKIP() << all["graphics"]["text"];
    EXPECT_FALSE(all["graphics"]["renderer"].get<std::string>().empty());
    EXPECT_EQ(all["graphics"]["version"].get<std::string>().find("OpenGL ES 3"), 0u);
    EXPECT_EQ(all["testOpenGl"]["state"], "ok") << all["testOpenGl"];
    EXPECT_EQ(all["testOpenGl"]["pixels"], 320 * 180);
}

TEST(Doctor, WithoutADriverIsWellAllTheSame) {
    // The driver loader then finds no driver.
    const Variable drivers("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere");
    const json all = answers();
    if (all["graphics"]["available"]) GTEST_SKIP() << "this machine's EGL has no loader of drivers";
    EXPECT_EQ(all["graphics"]["state"], "warning");
    const std::string text = all["graphics"]["text"];
    EXPECT_NE(text.find("install one"), std::string::npos) << text;
    EXPECT_NE(text.find("drawn on the CPU, with the same result"), std::string::npos) << text;
    EXPECT_FALSE(all.contains("testOpenGl"));
    EXPECT_EQ(all["testPicture"]["state"], "ok");
}

TEST(Doctor, KnowsWhetherABrowserCanBeOpened) {
    const TemporaryFolder folder;
    writeText(folder / "xdg-open", "#!/bin/sh\n");
    const Variable path("PATH", folder.path().c_str());
    {
        const Variable noWindows("DISPLAY", nullptr), noWayland("WAYLAND_DISPLAY", nullptr);
        const json browser = answers()["browser"];
        EXPECT_EQ(browser["state"], "warning");
        EXPECT_EQ(browser["desktop"], false);
        EXPECT_EQ(browser["opener"], nullptr) << "it cannot be run";
        EXPECT_NE(browser["text"].get<std::string>().find("xdg-utils"), std::string::npos);
    }
    fs::permissions(folder / "xdg-open", fs::perms::owner_all);
    // Nothing is at this display; neither a driver nor the browser may be waited for.
    const Variable display("DISPLAY", ":4711");
    const json browser = answers()["browser"];
    EXPECT_EQ(browser["state"], "ok") << browser;
    EXPECT_EQ(browser["opener"], (folder / "xdg-open").string());
}

TEST(Doctor, LooksForTheViewerBesideTheProgram) {
    const json viewer = answers()["viewer"];
    const fs::path folder = viewer["path"].get<std::string>();
    EXPECT_EQ(folder, fs::canonical(commandPath()).parent_path().parent_path() / "share/svt/viewer");
    EXPECT_EQ(viewer["available"], fs::exists(folder / "index.html"));
    EXPECT_EQ(viewer["state"], viewer["available"] ? "ok" : "warning");
}

TEST(Doctor, AFolderThatCannotBeWrittenIsAnError) {
    // Nobody can make a file in /proc, not even root.
    const CommandResult result = runSvt("/proc", {"doctor", "--json"}, limits());
    EXPECT_EQ(result.exitCode, kOutput) << result.toString();
    EXPECT_NE(result.err.find("E404 CannotWrite: /proc"), std::string::npos) << result.err;
    const json all = result.json();
    EXPECT_EQ(all["state"], "error");
    EXPECT_EQ(all["currentFolder"]["state"], "error");
    EXPECT_EQ(all["currentFolder"]["writable"], false);
    EXPECT_EQ(all["testPicture"]["state"], "ok") << "the rest is looked at all the same";
}

TEST(Doctor, WithoutATemporaryFolderPicturesAreDrawn) {
    const Variable tests("TEST_TMPDIR", ::testing::TempDir().c_str()), folder("TMPDIR", "/nowhere");
    const json all = answers();
    EXPECT_EQ(all["temporaryFolder"]["state"], "warning");
    EXPECT_EQ(all["temporaryFolder"]["writable"], false);
    EXPECT_NE(all["temporaryFolder"]["text"].get<std::string>().find("set TMPDIR"), std::string::npos);
    EXPECT_EQ(all["testPicture"]["state"], "ok");
}

TEST(Doctor, SeesADiskThatIsNearlyFull) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "disk");
    Limits withDisk = limits();
    withDisk.tinyDisk = folder / "disk";
    const Variable tests("TEST_TMPDIR", ::testing::TempDir().c_str()), temporary("TMPDIR", (folder / "disk").c_str());
    const CommandResult result = runSvt(folder.path(), {"doctor", "--json"}, withDisk);
    if (result.cannotMount) GTEST_SKIP() << "this user may not mount a file system";
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    const json answer = result.json()["temporaryFolder"];
    EXPECT_EQ(answer["state"], "warning");
    EXPECT_LE(answer["free"].get<std::uint64_t>(), 4096u);
}

TEST(Doctor, SeesALimitOfMemory) {
    if (kIsSanitized) GTEST_SKIP() << "no limit is set for a sanitizer";
    const TemporaryFolder folder;
    Limits small;  // 1 GiB
    small.seconds = 60;
    const CommandResult result = runSvt(folder.path(), {"doctor", "--json"}, limits());
    const json free = result.json()["memory"];
    if (free["total"].get<std::uint64_t>() <= small.memoryBytes) GTEST_SKIP() << "this machine has no more";
    const json memory = runSvt(folder.path(), {"doctor", "--json"}, small).json()["memory"];
    EXPECT_LE(memory["limit"].get<std::uint64_t>(), small.memoryBytes);
    EXPECT_TRUE(memory["limitedBy"] == "ulimit -v" || memory["limitedBy"] == "control group") << memory;
}

}  // namespace
}  // namespace svt::test
