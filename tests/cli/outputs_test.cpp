// Nothing that exists is destroyed: what a command would write is checked before it begins.
#include "run_command.hpp"
#include "small_model.hpp"

#include <svt/image/png.hpp>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <regex>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

class Outputs : public ::testing::Test {
protected:
    Outputs() {
        writeText(folder / "two.gml", twoBoxes());
        prepare(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    }

    // Expects that the command is refused and that nothing in the folder has changed.
    void expectRefused(const Arguments& arguments, const char* message, int exitCode = kOutput) {
        const std::map<std::string, std::string> before = contents();
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.toString();
        EXPECT_TRUE(std::regex_search(result.err, std::regex(message))) << message << "\n" << result.toString();
        EXPECT_TRUE(contents() == before) << "files have changed: " << result.toString();
    }

    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
            if (entry.is_regular_file()) all[entry.path().string()] = readText(entry.path());
        return all;
    }

    TemporaryFolder folder;
};

Arguments render(const std::string& input, const std::string& output, const Arguments& more = {}) {
    Arguments arguments{"render", input, "--size", "64x36", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST_F(Outputs, AnInputIsNotWrittenOver) {
    fs::copy_file(folder / "two.gml", folder / "two.png");
    fs::copy_file(folder / "two.svt", folder / "volume.png");
    expectRefused(render("two.png", "two.png"), "E408 WouldDestroy: two.png: '--output' .* is read \\('input'\\)");
    expectRefused(render("volume.png", "./volume.png"), "E408 WouldDestroy: \\./volume.png");
    fs::copy_file(folder / "two.gml", folder / "model.svt");
    expectRefused({"build", "model.svt", "-o", "model.svt"}, "E408");
    expectRefused({"build", "two.gml", "model.svt", "-o", "model.svt"}, "E408");
    expectRefused({"build", "two.gml", "-o", "two.svt", "--grid-of", "two.svt"}, "E408.*'--grid-of'");
    expectRefused({"shell", "two.svt", "-o", "two.svt"}, "E408");
}

TEST_F(Outputs, AnInputIsKnownByAnotherPathAndThroughLinks) {
    fs::copy_file(folder / "two.gml", folder / "model.svt");
    fs::create_directory(folder / "sub");
    fs::create_symlink("../model.svt", folder / "sub/link.svt");
    fs::create_hard_link(folder / "model.svt", folder / "hard.svt");
    fs::create_directory_symlink("sub", folder / "other");
    expectRefused({"build", "model.svt", "-o", "sub/../model.svt"}, "E408");
    expectRefused({"build", "model.svt", "-o", (folder / "model.svt").string()}, "E408");
    expectRefused({"build", "model.svt", "-o", "sub/link.svt"}, "E408");
    expectRefused({"build", "other/link.svt", "-o", "model.svt"}, "E408");
    expectRefused({"build", "model.svt", "-o", "hard.svt"}, "E408");
}

TEST_F(Outputs, FilesOfAStyleAreInputs) {
    runSvtWell(folder.path(), render("two.svt", "bricks.png"));
    writeText(folder / "my.style.json",
              R"({"rules": [{"select": "all", "pattern": {"type": "image", "file": "bricks.png"}}]})");
    expectRefused(render("two.gml", "bricks.png", {"--style", "my.style.json"}),
                  "E408 WouldDestroy: bricks.png: .*a file that '--style' names");
    expectRefused(render("two.gml", "p.png", {"--style", "my.style.json", "--write-scene", "my.style.json"}),
                  "E408 WouldDestroy: my.style.json: .*'--style'");
}

TEST_F(Outputs, ASceneIsNotWrittenOverWhereItIsRead) {
    runSvtWell(folder.path(), render("two.svt", "p.png", {"--write-scene", "s.scene.json"}));
    expectRefused(render("two.svt", "p.png", {"--scene", "s.scene.json", "--write-scene", "s.scene.json"}),
                  "E408.*'--write-scene'.*'--scene'");
}

TEST_F(Outputs, TwoOutputsAreNotOneFile) {
    expectRefused(render("two.svt", "p.png", {"--labels", "p.png"}), "E408.*'--labels' and '--output'");
    expectRefused(render("two.svt", "p.png", {"--labels", "l.png", "--depth", "./l.png"}), "E408.*'--depth'");
    fs::create_symlink("p.png", folder / "link.png");
    expectRefused(render("two.svt", "p.png", {"--depth", "link.png"}), "E408");
    expectRefused(render("two.svt", "p.png", {"--frames", "2", "--section", "z=1..2", "--depth", "p.png"}),
                  "E408.*p_0000.png");
    expectRefused({"section", "two.svt", "-o", "d.svg", "-o", "d.svg"}, "E408");
    EXPECT_FALSE(fs::exists(folder / "p.png"));
}

TEST_F(Outputs, AFileOfAnotherKindStays) {
    writeText(folder / "notes.png", "milk, bread\n");
    writeText(folder / "photo.svt", "\x89PNG\r\n\x1a\n....");
    writeText(folder / "archive.svt", "PK\3\4 some other archive");
    writeText(folder / "model.json", cityJson());
    writeText(folder / "my.json", R"({"rules": []})");
    fs::copy_file(folder / "two.svt", folder / "scene.json");
    fs::copy_file(folder / "two.svt", folder / "p_0001.png");
    expectRefused(render("two.svt", "notes.png"), "E408.*writes a PNG picture, but the existing file is a text file");
    expectRefused({"build", "two.gml", "-o", "photo.svt"}, "E408.*a PNG picture");
    expectRefused({"build", "two.gml", "-o", "archive.svt"}, "E408.*a ZIP archive");
    expectRefused(render("two.svt", "q.png", {"--write-scene", "scene.json"}), "E408.*scene.json.*a volume");
    expectRefused(render("two.svt", "q.png", {"--write-scene", "model.json"}), "E408.*a CityJSON model");
    expectRefused(render("two.svt", "q.png", {"--write-scene", "my.json"}), "E408.*a style file");
    expectRefused(render("two.svt", "p.png", {"--frames", "3", "--section", "z=1..2"}), "E408.*p_0001.png");
    expectRefused({"section", "two.svt", "--table", "model.json"}, "E408");
    EXPECT_FALSE(fs::exists(folder / "q.png"));
}

TEST_F(Outputs, AFileOfTheSameKindIsReplaced) {
    const Arguments commands[] = {
        {"build", "two.gml", "-o", "o.svt", "--spacing", "0.5"},
        {"sample", "house", "-o", "o.gml"},
        {"sample", "house", "-o", "o.json"},
        {"sample", "house", "-o", "o.jsonl"},
        render("two.svt", "o.png", {"--labels", "l.png", "--depth", "d.png", "--write-scene", "s.scene.json"}),
        {"section", "two.svt", "-o", "o.svg", "-o", "o.dxf", "-o", "o.geojson", "--table", "t.csv", "--table",
         "t.json"},
        {"convert", "two.svt", "o.nrrd"},
        {"convert", "two.svt", "o.glb"},
        {"shell", "two.svt", "-o", "hull.svt"},
    };
    for (const Arguments& arguments : commands)
        for (int i = 0; i < 2; ++i) runSvtWell(folder.path(), arguments);
    writeText(folder / "empty.png", "");
    runSvtWell(folder.path(), render("two.svt", "empty.png"));
    EXPECT_TRUE(image::readPng(folder / "empty.png"));
}

TEST_F(Outputs, TheEndingIsThatOfTheFormat) {
    expectRefused(render("two.svt", "p.jpg"), "E904.*'p.jpg': cannot write '.jpg'; possible are .png, .svg, .pdf",
                  kUsage);
    expectRefused({"build", "two.gml", "-o", "o.gml"}, "E904.*possible is .svt", kUsage);
    expectRefused(render("two.svt", "p.png", {"--labels", "l.tif"}), "E904.*--labels 'l.tif'", kUsage);
    expectRefused(render("two.svt", "p.png", {"--write-scene", "s.svt"}), "E904.*--write-scene 's.svt'", kUsage);
    expectRefused({"convert", "two.svt", "o"}, "E904.*possible are .nrrd, .glb", kUsage);
    expectRefused({"sample", "house", "-o", "o.json", "--format", "citygml2"}, "E904.*possible are .gml, .xml", kUsage);
    runSvtWell(folder.path(), render("two.svt", "P.PNG"));
    runSvtWell(folder.path(), render("two.svt", "picture"));
    runSvtWell(folder.path(), {"convert", "two.svt", "O.GLB"});
    EXPECT_EQ(readText(folder / "O.GLB").substr(0, 4), "glTF");
    runSvtWell(folder.path(), {"sample", "house", "-o", "house", "--format", "citygml2"});
}

TEST_F(Outputs, WhatCannotBeWrittenIsToldBeforeAnInputIsRead) {
    // The input is not there: had it been looked for first, the exit code would be 3.
    const auto expectTold = [&](const std::string& output, const char* message) {
        const CommandResult result = runSvt(folder.path(), {"build", "missing.gml", "-o", output});
        EXPECT_EQ(result.exitCode, kOutput) << result.toString();
        EXPECT_TRUE(std::regex_search(result.err, std::regex(message))) << message << "\n" << result.toString();
    };
    fs::create_directory(folder / "folder.svt");
    fs::create_symlink("nowhere/o.svt", folder / "link.svt");
    expectTold("nowhere/o.svt", "E404 CannotWrite: nowhere/o.svt: the folder nowhere does not exist");
    expectTold("two.gml/o.svt", "E404.*is a file, not a folder");
    expectTold("folder.svt", "E404.*this is a folder");
    expectTold("link.svt", "E404 CannotWrite: link.svt: this is a link to nowhere/o.svt, and the folder nowhere does");
    if (fs::exists("/proc/self")) expectTold("/proc/x.svt", "E404 CannotWrite: /proc/x.svt: the system makes no files");
    EXPECT_EQ(runSvt(folder.path(), {"publish", "missing.gml", "-o", "two.gml/site"}).exitCode, kOutput);
    EXPECT_EQ(runSvt(folder.path(), {"section", "missing.gml", "-o", "a.svg", "--table", "nowhere/t.csv"}).exitCode,
              kOutput);
    EXPECT_EQ(runSvt(folder.path(), {"build", "missing.gml", "-o", "o.svt"}).exitCode, 3);
    EXPECT_EQ(folder.count(), 4) << "the attempt has left something";
}

TEST_F(Outputs, AFullDiskIsToldBeforeAnInputIsRead) {
    fs::create_directory(folder / "disk");
    Limits limits;
    limits.tinyDisk = folder / "disk";
    const CommandResult result = runSvt(folder.path(), {"build", "missing.gml", "-o", "disk/o.svt"}, limits);
    if (result.cannotMount) GTEST_SKIP() << "this user may not mount a file system";
    EXPECT_EQ(result.exitCode, kOutput) << result.toString();
    EXPECT_NE(result.err.find("E405 DiskFull: disk/o.svt: no space is left"), std::string::npos) << result.err;
}

TEST_F(Outputs, DevicesAndPipesAreWrittenAsTheyAre) {
    runSvtWell(folder.path(), render("two.svt", "/dev/null", {"--labels", "/dev/null"}));
    const std::string picture = runSvtWell(folder.path(), render("two.svt", "/dev/stdout"));
    EXPECT_EQ(picture.substr(1, 3), "PNG");
    const fs::path pipe = folder / "pipe.png";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        // Waits until the command opens the pipe, and reads all of it.
        const std::string read = readText(pipe);
        ::_exit(read.substr(1, 3) == "PNG" && read.ends_with("IEND\xae\x42\x60\x82") ? 0 : 1);
    }
    runSvtWell(folder.path(), render("two.svt", "pipe.png"));
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "the pipe was opened twice, or the picture is not whole";
}

TEST_F(Outputs, PublishedFolderIsNotThatOfAnInput) {
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    fs::create_directory(folder / "site");
    fs::copy_file(folder / "two.svt", folder / "site/two.svt");
    expectRefused({"publish", "site/two.svt", "-o", "site", "--viewer", "page"}, "E408.*site/two.svt");
    expectRefused({"publish", "two.svt", "-o", "page", "--viewer", "page"}, "E408.*'--viewer'");
    expectRefused({"publish", "two.svt", "-o", "two.svt", "--viewer", "page"}, "E40[48]");
}

TEST_F(Outputs, LeftoversOfAKilledCommandGo) {
    writeText(folder / ".svt-1a2b-0-3c4d5e.tmp", "half a volume");
    writeText(folder / ".svt-notes.tmp", "mine");
    runSvtWell(folder.path(), {"build", "two.gml", "-o", "o.svt", "--spacing", "0.5"});
    EXPECT_FALSE(fs::exists(folder / ".svt-1a2b-0-3c4d5e.tmp"));
    EXPECT_TRUE(fs::exists(folder / ".svt-notes.tmp"));
}

// What of the options is meant for models, and values that no model can have.

TEST_F(Outputs, OptionsForModelsAreToldWhereAVolumeIsGiven) {
    expectRefused({"info", "two.svt", "--spacing", "0.1"},
                  "E904 BadArgument: two.svt: --spacing is for building a volume from a model", kUsage);
    expectRefused(render("two.svt", "p.png", {"--lod", "2"}), "E904.*--lod", kUsage);
    expectRefused({"query", "two.svt", "all", "--dimension", "10"}, "E904.*--dimension", kUsage);
    expectRefused({"convert", "two.svt", "o.glb", "--no-bodies"}, "E904.*--no-bodies", kUsage);
    runSvtWell(folder.path(), {"info", "two.svt", "--threads", "1"});
    // The parcels are a model, though the input is a volume.
    runSvtWell(folder.path(), {"query", "two.svt", "all", "--parcels", "two.gml", "--no-bodies"});
}

TEST_F(Outputs, BadSpacingIsToldBeforeAModelIsRead) {
    for (const char* spacing : {"-1", "0", "0.1,0.1,-1"})
        expectRefused({"info", "missing.gml", "--spacing", spacing}, "E301 BadDimension: --spacing", kUsage);
    for (const char* spacing : {"nan", "inf", "1e999"})
        expectRefused({"info", "missing.gml", "--spacing", spacing}, "E904 BadArgument: --spacing", kUsage);
}

TEST_F(Outputs, AQueryThatFindsNothingIsAnAnswer) {
    const CommandResult result = runSvt(folder.path(), {"query", "two.svt", "class=Bilding", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_EQ(result.json(), nlohmann::json::array());
    EXPECT_NE(result.err.find("svt: the query 'class=Bilding' selects nothing: no class 'Bilding'; did you mean"),
              std::string::npos)
        << result.err;
}

TEST_F(Outputs, HidingAllIsSaid) {
    const CommandResult result = runSvt(folder.path(), render("two.svt", "p.png", {"--hide", "all"}));
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("svt: nothing is visible:"), std::string::npos) << result.err;
    EXPECT_EQ(runSvt(folder.path(), render("two.svt", "p.png")).err, "");
}

TEST_F(Outputs, QuietPrintsErrorsAlone) {
    const CommandResult built = runSvt(folder.path(), {"build", "two.gml", "-o", "o.svt", "--spacing", "0.5", "-q"});
    EXPECT_EQ(built.exitCode, 0) << built.toString();
    EXPECT_EQ(built.out + built.err, "");
    const CommandResult query = runSvt(folder.path(), {"query", "two.svt", "none", "--quiet", "--json"});
    EXPECT_EQ(query.exitCode, 0) << query.toString();
    EXPECT_EQ(query.err, "");
    EXPECT_EQ(query.json(), nlohmann::json::array());
    EXPECT_NE(runSvt(folder.path(), {"build", "missing.gml", "-o", "o.svt", "-q"}).err, "");
    EXPECT_EQ(runSvt(folder.path(), {"build", "two.gml", "-o", "o.svt", "-q", "-v"}).exitCode, kUsage);
}

}  // namespace
}  // namespace svt::test
