// The command in hostile surroundings: every declared option without characters, every input that is not a
// file.
#include <tests/cli/run_command.hpp>
#include <tests/cli/small_model.hpp>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Arguments = std::vector<std::string>;

// The commands with their options, as `svt describe json` prints them.
const json& declaredCommands() {
    static const json commands = [] {
        const TemporaryFolder folder;
        return runSvtForJson(folder.path(), {"describe", "json"}).at("commands");
    }();
    return commands;
}

// "--output" of "-o,--output".
std::string longNameOf(const json& option) {
    const std::string name = option.at("name");
    return name.substr(name.find(',') + 1);
}

// A command line that gives `option` the value `value`, behind any values for the arguments before it.
Arguments given(const json& command, const json& option, const std::string& value) {
    Arguments arguments{command.at("name")};
    if (longNameOf(option).starts_with("--")) {
        arguments.insert(arguments.end(), {longNameOf(option), value});
        return arguments;
    }
    for (const json& other : command.at("options")) {
        if (other == option) break;
        if (longNameOf(other).starts_with("-")) continue;
        arguments.push_back(other.contains("choices") ? std::string(other.at("choices").front()) : "0");
    }
    arguments.push_back(value);
    return arguments;
}

TEST(EmptyValues, AreRefusedForEveryOptionOfEveryCommand) {
    const TemporaryFolder folder;
    int tried = 0;
    for (const json& command : declaredCommands())
        for (const json& option : command.at("options")) {
            if (option.at("kind") == "flag") continue;
            const CommandResult result = runSvt(folder.path(), given(command, option, ""));
            const std::string fault = longNameOf(option) + ": the value is empty; give ";
            EXPECT_EQ(result.exitCode, kUsage) << command.at("name") << ": " << result.toString();
            EXPECT_NE(result.err.find(fault), std::string::npos) << command.at("name") << ": " << result.toString();
            ++tried;
        }
    EXPECT_GT(tried, 150) << "the declarations were not read";
    EXPECT_EQ(folder.count(), 0);
}

TEST(EmptyValues, AreRefusedAfterAnEqualsSign) {
    const TemporaryFolder folder;
    for (const char* option : {"--look=", "--section=", "--output=", "--size=", "--wireframe=", "--fov="}) {
        const CommandResult result = runSvt(folder.path(), {"render", "a.svt", option, "b.png"});
        const std::string name(option, std::string_view(option).size() - 1);
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_NE(result.err.find("svt: " + name + ": the value is empty"), std::string::npos) << result.toString();
    }
}

// An argument for each option that `command` requires, and `path` for `option`.
Arguments complete(const json& command, const json& option, const std::string& path) {
    Arguments arguments{command.at("name")};
    for (const json& other : command.at("options")) {
        if (other != option && !other.value("required", false)) continue;
        std::string value = "all";  // a query
        if (other == option)
            value = path;
        else if (other.contains("choices"))
            value = other.at("choices").front();
        else if (other.value("file", "").starts_with("output"))
            value = other.at("value") == "FILE" ? "o.nrrd" : other.at("value") == "DIR" ? "o" : other.at("value");
        else if (other.value("file", "").starts_with("input"))
            value = "two.gml";
        else if (other.at("kind") == "whole")
            value = "0";
        else if (other.value("value", "") == "X,Y,Z")
            value = "0,0,0";
        if (longNameOf(other).starts_with("--")) arguments.push_back(longNameOf(other));
        arguments.push_back(value);
    }
    return arguments;
}

// Something that is no file, in a folder.
struct NoFile {
    const char* path;
    const char* name;  // what the message calls it
};

class NoFiles : public ::testing::Test {
protected:
    NoFiles() {
        writeText(folder / "two.gml", twoBoxes());
        EXPECT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
        fs::create_directory(folder / "folder");
        socket_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        // A path of a socket has 107 characters at most; the folder's name may be longer.
        const std::string name = "/proc/self/cwd/socket";
        name.copy(address.sun_path, name.size());
        const fs::path before = fs::current_path();
        fs::current_path(folder.path());
        EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        fs::current_path(before);
    }
    ~NoFiles() override { ::close(socket_); }

    TemporaryFolder folder;

private:
    int socket_ = -1;
};

TEST_F(NoFiles, AreRefusedByEveryInputOfEveryCommand) {
    int tried = 0;
    for (const json& command : declaredCommands())
        for (const json& option : command.at("options")) {
            const std::string use = option.value("file", "");
            if (!use.starts_with("input")) continue;
            for (const auto& [path, name] : {NoFile{"pipe", "a pipe"}, NoFile{"socket", "a socket"},
                                             NoFile{"/dev/zero", "a device"}, NoFile{"/dev/null", "a device"}}) {
                const CommandResult result = runSvt(folder.path(), complete(command, option, path));
                EXPECT_EQ(result.exitCode, kInput) << command.at("name") << ": " << result.toString();
                EXPECT_NE(result.err.find(std::string("E101 CannotOpen: ") + path), std::string::npos)
                    << result.toString();
                EXPECT_NE(result.err.find(name), std::string::npos) << result.toString();
                ++tried;
            }
            if (use == "inputFolder") continue;
            // An empty folder is neither a file nor a city.
            const CommandResult result = runSvt(folder.path(), complete(command, option, "folder"));
            EXPECT_TRUE(result.exitCode == kInput || result.exitCode == kUsage)
                << command.at("name") << ": " << result.toString();
        }
    EXPECT_GT(tried, 80) << "the declarations were not read";
}

TEST_F(NoFiles, StandAsFilesOfAStyleAndBesideAnOutput) {
    writeText(folder / "s.style.json",
              R"({"rules": [{"select": "all", "pattern": {"type": "image", "file": "pipe"}}]})");
    const CommandResult style =
        runSvt(folder.path(), {"build", "two.gml", "-o", "o.svt", "--spacing", "0.5", "--style", "s.style.json"});
    EXPECT_EQ(style.exitCode, kInput) << style.toString();
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    ASSERT_EQ(::mkfifo((folder / "o.labels.nrrd").c_str(), 0600), 0);
    const CommandResult beside = runSvt(folder.path(), {"convert", "two.svt", "o.x3d", "--texture", "image"});
    EXPECT_EQ(beside.exitCode, kOutput) << beside.toString();
}

TEST_F(NoFiles, StdinIsAnInputWhereAFileStandsBehindIt) {
    const std::string command = "'" + commandPath() + "' check /dev/stdin < '" + (folder / "two.gml").string() +
                                "' > '" + (folder / "out").string() + "' 2>&1";
    EXPECT_NE(WEXITSTATUS(std::system(command.c_str())), kInput) << readText(folder / "out");
    const std::string piped = "cat '" + (folder / "two.gml").string() + "' | '" + commandPath() +
                              "' check /dev/stdin > '" + (folder / "out").string() + "' 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system(piped.c_str())), kInput);
    EXPECT_NE(readText(folder / "out").find("a pipe"), std::string::npos);
}

// Formats are told by the endings of files, and folders by their names.
TEST_F(NoFiles, ArePipesWhateverTheirEnding) {
    for (const std::string ending : {".svt", ".nrrd", ".nii", ".tif", ".vti", ".zarr", ".ifc", ".ifczip", ".gml.gz",
                                     ".json", ".ade.gml", ".style.json", ".csv"}) {
        const std::string pipe = "pipe" + ending;
        ASSERT_EQ(::mkfifo((folder / pipe).c_str(), 0600), 0);
        const auto before = folder.count();
        for (const Arguments& arguments :
             {Arguments{"info", pipe}, Arguments{"check", pipe}, Arguments{"query", pipe, "all"},
              Arguments{"build", pipe, "-o", "o.svt"}, Arguments{"convert", pipe, "o.nrrd"},
              Arguments{"render", pipe, "-o", "o.png"}, Arguments{"city-plan", pipe, "-o", "o"},
              Arguments{"build", "two.gml", "-o", "o.svt", "--labels", pipe},
              Arguments{"info", "two.gml", "--style", pipe}}) {
            const CommandResult result = runSvt(folder.path(), arguments);
            ASSERT_FALSE(result.isTimeout) << arguments[0] << " " << pipe;
            EXPECT_EQ(result.exitCode, kInput) << arguments[0] << ": " << result.toString();
            EXPECT_NE(result.err.find(pipe), std::string::npos) << result.toString();
            EXPECT_NE(result.err.find("a pipe"), std::string::npos) << result.toString();
        }
        EXPECT_EQ(folder.count(), before);
    }
}

// Folders with a pipe in the place of a file.
class PipesInFolders : public ::testing::Test {
protected:
    // Runs `svt` where `tried` is a copy of the folder `whole` with a pipe for the file `name`.
    CommandResult runWithPipe(const std::string& whole, const std::string& name, const Arguments& arguments) {
        fs::remove_all(folder / "tried");
        fs::copy(folder / whole, folder / "tried", fs::copy_options::recursive);
        fs::remove(folder / "tried" / name);
        EXPECT_EQ(::mkfifo((folder / "tried" / name).c_str(), 0600), 0) << name;
        return runSvt(folder.path(), arguments);
    }

    // The command ends with `exitCode` and a message that names the pipe; it leaves no output.
    void expectRefused(const std::string& whole, const std::string& name, const Arguments& arguments, int exitCode) {
        const CommandResult result = runWithPipe(whole, name, arguments);
        const std::string what = name + ": " + arguments[0] + " " + arguments.back() + ": ";
        ASSERT_FALSE(result.isTimeout) << what;
        EXPECT_EQ(result.exitCode, exitCode) << what << result.toString();
        EXPECT_NE((result.err + result.out).find(fs::path(name).filename().string()), std::string::npos)
            << what << result.toString();
        for (const char* output : {"o", "o.svt", "o.png"}) EXPECT_FALSE(fs::exists(folder / output)) << what << output;
    }

    void makeCity() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"city-plan", "two.gml", "-o", "city", "--spacing", "1"});
        runSvtWell(folder.path(), {"city-run", "city"});
        fs::create_directory(folder / "page");
        writeText(folder / "page/index.html", "<!doctype html><head></head>");
    }

    TemporaryFolder folder;
};

TEST_F(PipesInFolders, AreErrorsOfWhoReadsACity) {
    makeCity();
    const Arguments readers[] = {{"city-info", "tried"},
                                 {"info", "tried"},
                                 {"query", "tried", "all", "--json"},
                                 {"render", "tried", "--size", "32x32", "-o", "o.png"},
                                 {"publish", "tried", "--viewer", "page", "-o", "o"},
                                 {"city-extract", "tried", "--box=-1e7,-1e7,-1e7,1e7,1e7,1e7", "-o", "o.svt"}};
    for (const char* name : {"city.json", "index.bin", "ids.bin", "words.bin", "packs.bin"})
        for (const Arguments& arguments : readers) expectRefused("city", name, arguments, kInput);
    for (const Arguments& arguments : readers)
        if (arguments[0] != "city-info" && arguments[0] != "info")
            expectRefused("city", "packs/00000.svtp", arguments, kInput);
    expectRefused("city", "packs/00000.svtp", {"check", "tried"}, kInvalid);
}

TEST_F(PipesInFolders, AreErrorsOfWhoWritesACity) {
    makeCity();
    for (const char* name : {"plan.json", "tiles.bin", "packs.bin"})
        for (const char* command : {"city-status", "city-run", "city-merge"})
            expectRefused("city", "plan/" + std::string(name), {command, "tried"}, kInput);
    for (const char* name : {"plan.json", "tiles.bin", "packs.bin", "features.bin"})
        expectRefused("city", "plan/" + std::string(name), {"city-plan", "two.gml", "--spacing", "2", "-o", "tried"},
                      kOutput);
    for (const char* name : {"packs/00000.svtp", "reports/00000.json"}) {
        expectRefused("city", name, {"city-task", "tried", "0"}, kOutput);
        expectRefused("city", name, {"city-run", "tried"}, kInput);
    }
    for (const char* name : {"packs.bin", "index.bin", "ids.bin", "words.bin", "city.json"})
        expectRefused("city", name, {"city-merge", "tried"}, kOutput);
}

TEST_F(PipesInFolders, AreErrorsOfWhoWritesFilesIntoAFolder) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "1"});
    runSvtWell(folder.path(), {"sheets", "two.svt", "--svg", "svg", "--dxf", "dxf"});
    runSvtWell(folder.path(), {"sample-city", "--buildings", "1", "-o", "models"});
    expectRefused("svg", "sheet-1.svg", {"sheets", "two.svt", "--svg", "tried"}, kOutput);
    expectRefused("dxf", "plan-1.dxf", {"sheets", "two.svt", "--dxf", "tried"}, kOutput);
    expectRefused("models", "00000.gml", {"sample-city", "--buildings", "1", "-o", "tried"}, kOutput);
}

TEST_F(PipesInFolders, AreErrorsOfWhoReadsZarr) {
    writeText(folder / "two.gml", twoBoxes());
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "1"});
    runSvtWell(folder.path(), {"convert", "two.svt", "two.zarr"});
    runSvtWell(folder.path(), {"convert", "two.svt", "three.zarr", "--zarr", "3"});
    const std::pair<std::string, std::vector<std::string>> files[] = {{"two.zarr", {".zattrs", "0/.zarray", "0/0/0/0"}},
                                                                      {"three.zarr", {"0/zarr.json", "0/c/0/0/0"}}};
    for (const auto& [whole, names] : files)
        for (const std::string& name : names) {
            expectRefused(whole, name, {"info", "tried"}, kInput);
            expectRefused(whole, name, {"build", "tried", "-o", "o.svt"}, kInput);
        }
}

TEST_F(PipesInFolders, AreErrorsOfAPlanOfModels) {
    fs::create_directory(folder / "models");
    writeText(folder / "models/two.gml", twoBoxes());
    for (const char* name : {"pipe.gml", "pipe.json", "pipe.ifc", "pipe.gml.gz"})
        expectRefused("models", name, {"city-plan", "tried", "-o", "o"}, kInput);
    // What does not end as a model is none.
    EXPECT_EQ(runWithPipe("models", "pipe.txt", {"city-plan", "tried", "-o", "o"}).exitCode, kDone);
}

// The page is what the folder has as files.
TEST_F(PipesInFolders, AreNoPartOfAPage) {
    makeCity();
    EXPECT_EQ(runWithPipe("page", "more.js", {"publish", "city", "--viewer", "tried", "-o", "o"}).exitCode, kDone);
    EXPECT_FALSE(fs::exists(folder / "o/more.js"));
    fs::remove_all(folder / "o");
    const CommandResult result = runWithPipe("page", "index.html", {"publish", "city", "--viewer", "tried", "-o", "o"});
    EXPECT_EQ(result.exitCode, kInput) << result.toString();
}

}  // namespace
}  // namespace svt::test
