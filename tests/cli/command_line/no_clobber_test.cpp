// --no-clobber of every command that writes: existing files and folders stay, whatever their kind.
#include <tests/cli/command_line/shell_line.hpp>
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

class NoClobber : public ::testing::Test {
protected:
    NoClobber() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
        fs::create_directory(folder / "page");
        writeText(folder / "page/index.html", "<!doctype html><head></head>");
    }

    // The line succeeds where `outputs` are missing, and is refused where one of them exists.
    void expectKept(const std::string& line, const std::vector<std::string>& outputs) const {
        runLineWell(folder.path(), line + " --no-clobber");
        for (const std::string& output : outputs) ASSERT_TRUE(fs::exists(folder / output)) << line << ": " << output;
        for (const std::string& output : outputs) {
            for (const std::string& other : outputs)
                if (other != output) fs::remove_all(folder / other);
            const auto before = contentBelow(folder.path());
            const LineResult result = runLine(folder.path(), line + " --no-clobber");
            EXPECT_EQ(result.exitCode, kOutput) << line << ": " << result.toString();
            EXPECT_NE(result.err.find("E408 WouldDestroy: " + output), std::string::npos) << line << ": " << result.err;
            EXPECT_NE(result.err.find("--no-clobber keeps existing"), std::string::npos) << result.err;
            EXPECT_TRUE(contentBelow(folder.path()) == before) << line << ": files have changed";
            runLineWell(folder.path(), line);  // writes all of them again
        }
    }

    TemporaryFolder folder;
};

TEST_F(NoClobber, KeepsTheFilesOfAllCommands) {
    expectKept("svt sample house -o o.gml", {"o.gml"});
    expectKept("svt build two.gml -o o.svt --spacing 0.5", {"o.svt"});
    expectKept("svt render two.svt --size 64x36 -o o.png --labels l.png --depth d.png --write-scene s.scene.json",
               {"o.png", "l.png", "d.png", "s.scene.json"});
    expectKept("svt render two.svt --size 64x36 -o p.png --frames 2 --section z=1..2", {"p_0000.png", "p_0001.png"});
    expectKept("svt thumbnail two.svt -o t.png", {"t.png"});
    expectKept("svt section two.svt --plane z=1 -o o.svg -o o.dxf --table o.csv", {"o.svg", "o.dxf", "o.csv"});
    expectKept("svt query two.svt all -o q.csv", {"q.csv"});
    expectKept("svt query two.svt all -o q.gpkg", {"q.gpkg"});
    expectKept("svt shell two.svt -o o.glb", {"o.glb"});
    expectKept("svt convert two.svt o.nrrd", {"o.nrrd"});
    expectKept("svt sheets two.svt -o o.pdf", {"o.pdf"});
}

TEST_F(NoClobber, KeepsFolders) {
    expectKept("svt sheets two.svt --svg sheets", {"sheets"});
    expectKept("svt sample city --buildings 1 -o models", {"models"});
    expectKept("svt publish two.svt -o site --viewer page", {"site"});
    expectKept("svt city plan two.gml -o town --spacing 1", {"town"});
    // An empty folder holds nothing that could be lost.
    fs::create_directory(folder / "empty");
    runLineWell(folder.path(), "svt publish two.svt -o empty --viewer page --no-clobber");
}

// A file that no option names.
TEST_F(NoClobber, KeepsFilesBesideAnOutput) {
    runLineWell(folder.path(), "svt convert two.svt o.x3d --texture image --no-clobber");
    const auto before = contentBelow(folder.path());
    fs::remove(folder / "o.x3d");
    const LineResult result = runLine(folder.path(), "svt convert two.svt o.x3d --texture image --no-clobber");
    EXPECT_EQ(result.exitCode, kOutput) << result.toString();
    EXPECT_NE(result.err.find("E408 WouldDestroy"), std::string::npos) << result.err;
    for (const auto& [name, content] : contentBelow(folder.path())) EXPECT_TRUE(before.at(name) == content) << name;
}

TEST_F(NoClobber, KeepsFilesOfAnyKindAndEmptyOnes) {
    writeText(folder / "text.png", "milk");
    writeText(folder / "empty.png", "");
    fs::create_symlink("two.svt", folder / "link.svt");
    for (const std::string line : {"svt render two.svt -o text.png", "svt render two.svt -o empty.png",
                                   "svt shell house.svt -o link.svt", "svt build two.gml -o two.svt"}) {
        const LineResult result = runLine(folder.path(), line + " --no-clobber");
        EXPECT_EQ(result.exitCode, kOutput) << line << ": " << result.toString();
        EXPECT_NE(result.err.find("E408"), std::string::npos) << result.err;
    }
    EXPECT_EQ(readText(folder / "text.png"), "milk");
    EXPECT_EQ(readText(folder / "empty.png"), "");
    // Devices, stdout and links to nothing hold nothing that could be lost.
    runLineWell(folder.path(), "svt render two.svt --size 32x32 -o /dev/null --no-clobber");
    runLineWell(folder.path(), "svt render two.svt --size 32x32 -o - --format png --no-clobber > text.png");
    fs::create_symlink("new.png", folder / "new-link.png");
    runLineWell(folder.path(), "svt render two.svt --size 32x32 -o new-link.png --no-clobber");
}

TEST_F(NoClobber, IsAnOptionOfEveryCommandThatWrites) {
    const nlohmann::json described = runSvtForJson(folder.path(), {"describe", "json"});
    for (const auto& command : described.at("commands")) {
        bool writes = false, has = false;
        for (const auto& option : command.at("options")) {
            writes = writes || option.value("file", "").starts_with("output");
            has = has || option.at("name") == "--no-clobber";
        }
        EXPECT_EQ(writes, has) << command.at("name");
    }
}

// --format of the results on stdout is not that of the report, whose existing file was not checked.
TEST_F(NoClobber, ReportsOfAnyFormatAreChecked) {
    writeText(folder / "report.html", "milk, bread");
    for (const char* format : {"text", "json", "val3dity"}) {
        const LineResult result =
            runLine(folder.path(), std::string("svt check two.gml --report report.html --format ") + format);
        EXPECT_EQ(result.exitCode, kOutput) << format << ": " << result.toString();
        EXPECT_NE(result.err.find("E408"), std::string::npos) << result.err;
    }
    EXPECT_EQ(readText(folder / "report.html"), "milk, bread");
}

}  // namespace
}  // namespace svt::test
