// Defaults of options in svt.json, of a project and of the user: precedence, errors, and files that strangers made.
#include <tests/cli/command_line/shell_line.hpp>
#include <tests/cli/small_model.hpp>

#include <svt/image/png.hpp>

#include <sys/stat.h>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class DefaultsTest : public ::testing::Test {
protected:
    DefaultsTest() {
        fs::create_directories(folder / "settings/svt");
        fs::create_directory(folder / "project");
        writeText(folder / "project/two.gml", twoBoxes());
    }

    // A line with the files with defaults of this test.
    LineResult run(const std::string& line) const {
        return runLine(folder.path(), "unset SVT_NO_CONFIG; export XDG_CONFIG_HOME=\"$PWD/settings\"; " + line);
    }
    std::string runWell(const std::string& line) const {
        LineResult result = run(line);
        EXPECT_EQ(result.exitCode, 0) << line << ": " << result.toString();
        return std::move(result.out);
    }
    void project(const std::string& text) const { writeText(folder / "project/svt.json", text); }
    void user(const std::string& text) const { writeText(folder / "settings/svt/svt.json", text); }

    // The spacing that `svt info` used, in metres.
    double spacingOf(const std::string& options = {}) const {
        const json info = json::parse(runWell("svt info project/two.gml --json " + options), nullptr, false);
        EXPECT_FALSE(info.is_discarded());
        return info.is_discarded() ? 0 : info.at("grid").at("spacing").at(0).get<double>();
    }
    // The file is refused, with `text` in the message.
    void expectRefused(const std::string& text, const std::string& line = "svt info project/two.gml") const {
        const LineResult result = run(line);
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_EQ(result.out, "");
        EXPECT_NE(result.err.find("E905 BadDefaults"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(text), std::string::npos) << "expected " << text << "\n" << result.err;
        EXPECT_NE(result.err.find("--no-config"), std::string::npos) << "the remedy: " << result.err;
        EXPECT_NE(run(line + " --no-config").exitCode, kUsage) << line;
    }

    TemporaryFolder folder;
};

TEST_F(DefaultsTest, TheCommandLinePrecedesTheProjectAndTheProjectTheUser) {
    user(R"({"info": {"spacing": 1}})");
    EXPECT_EQ(spacingOf(), 1);
    project(R"({"*": {"spacing": 0.5}})");
    EXPECT_EQ(spacingOf(), 0.5) << "the project, though its value is for all commands";
    EXPECT_EQ(spacingOf("--spacing 0.25"), 0.25);
    project(R"({"*": {"spacing": 0.5}, "info": {"spacing": "2"}})");
    EXPECT_EQ(spacingOf(), 2) << "the value of the command";
    project(R"({"render": {"spacing": 0.5}})");
    EXPECT_EQ(spacingOf(), 1) << "of another command";
    EXPECT_NE(spacingOf("--no-config"), 1);
    EXPECT_NE(json::parse(runWell("SVT_NO_CONFIG=1 svt info project/two.gml --json"))["grid"]["spacing"][0], 1);
}

TEST_F(DefaultsTest, ExcludedDefaultsAreLeftOut) {
    user(R"({"*": {"spacing": 1}})");
    const json info = json::parse(runWell("svt info project/two.gml --json --dimension 20"));
    EXPECT_EQ(info["grid"]["dimension"][0], 20);
    project(R"({"*": {"dimension": "20"}})");
    EXPECT_EQ(json::parse(runWell("svt info project/two.gml --json"))["grid"]["dimension"][0], 20);
    EXPECT_EQ(spacingOf("--spacing 1"), 1);
    project(R"({"*": {"dimension": "20"}, "info": {"spacing": 1}})");
    expectRefused("'spacing' and 'dimension' exclude each other");
}

TEST_F(DefaultsTest, VolumesNeedNoDefaultsForModels) {
    runWell("svt build project/two.gml -o project/two.svt --spacing 0.5");
    project(R"({"*": {"spacing": 1, "no-bodies": true, "threads": 1}})");
    EXPECT_EQ(json::parse(runWell("svt info project/two.svt --json"))["grid"]["spacing"][0], 0.5);
    EXPECT_EQ(run("svt info project/two.svt --spacing 1").exitCode, kUsage) << "as it is given";
}

TEST_F(DefaultsTest, FlagsAndListsAreTakenAsOnTheCommandLine) {
    user(R"({"render": {"ortho": true, "size": "64x36", "show": ["id=left", "id=right"], "background": "white"}})");
    runWell("svt render project/two.gml -o a.png --spacing 0.5");
    runWell(
        "svt render project/two.gml -o b.png --spacing 0.5 --ortho --size 64x36 --show id=left --show id=right "
        "--background white --no-config");
    EXPECT_TRUE(readText(folder / "a.png") == readText(folder / "b.png"));
    // A list on the command line replaces that of the file, and false hides a flag of the user.
    project(R"({"render": {"ortho": false}})");
    runWell("svt render project/two.gml -o c.png --spacing 0.5 --show id=left");
    runWell(
        "svt render project/two.gml -o d.png --spacing 0.5 --size 64x36 --show id=left --background white --no-config");
    EXPECT_TRUE(readText(folder / "c.png") == readText(folder / "d.png"));
    user(R"({"render": {"wireframe": true, "size": "64x36", "spacing": 0.5}})");
    runWell("svt render project/two.gml -o e.png");
    runWell("svt render project/two.gml -o f.png --size 64x36 --spacing 0.5 --wireframe --no-config");
    EXPECT_TRUE(readText(folder / "e.png") == readText(folder / "f.png"));
}

TEST_F(DefaultsTest, TheFileIsBesideTheModel) {
    project(R"({"*": {"spacing": 1}})");
    const auto spacing = [&](const std::string& line) {
        return json::parse(runWell(line))["grid"]["spacing"][0].get<double>();
    };
    EXPECT_EQ(spacing("cd project; svt info two.gml --json"), 1);
    EXPECT_EQ(spacing("svt info ./project/../project/two.gml --json"), 1);
    EXPECT_EQ(spacing("cd project; svt two.gml --json"), 1) << "of the command that the file stands for";
    EXPECT_NE(spacing("svt info - --json < project/two.gml"), 1) << "nothing is beside stdin";
    writeText(folder / "two.gml", twoBoxes());
    EXPECT_NE(spacing("cd project; svt info ../two.gml --json"), 1) << "not that of the working folder";
    // That of a city is beside its folder.
    writeText(folder / "svt.json", R"({"*": {"siez": 1}})");
    runWell("svt city plan two.gml -o town --spacing 1 -q --no-config && svt city run town -q --no-config");
    for (const std::string line : {"svt city info town", "svt city info town/", "cd town; svt city info ."})
        expectRefused("*.siez", line);
}

TEST_F(DefaultsTest, PathsOfTheUserAreRelativeToTheirFile) {
    writeText(folder / "settings/svt/red.style.json", R"({"rules": [{"select": "all", "color": "#ff0000"}]})");
    user(R"({"*": {"style": "red.style.json"}})");
    runWell("svt render project/two.gml -o a.png --size 64x36 --spacing 0.5");
    runWell(
        "svt render project/two.gml -o b.png --size 64x36 --spacing 0.5 --no-config --style "
        "settings/svt/red.style.json");
    EXPECT_TRUE(readText(folder / "a.png") == readText(folder / "b.png"));
}

TEST_F(DefaultsTest, VerboseNamesTheUsedFiles) {
    project(R"({"*": {"spacing": 1, "threads": 1}})");
    user(R"({"*": {"threads": 2, "lod": 2}, "render": {"zoom": 2}})");
    const LineResult result = run("svt info project/two.gml --verbose");
    EXPECT_NE(result.err.find("svt: defaults of project/svt.json: --spacing, --threads\n"), std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("settings/svt/svt.json: --lod\n"), std::string::npos) << result.err;
    EXPECT_EQ(run("svt info project/two.gml").err.find("defaults of"), std::string::npos);
    // Also where a default may be the cause of an error.
    project(R"({"*": {"spacing": -1}})");
    const LineResult wrong = run("svt info project/two.gml");
    EXPECT_EQ(wrong.exitCode, kUsage) << wrong.toString();
    EXPECT_NE(wrong.err.find("defaults of project/svt.json: --spacing"), std::string::npos) << wrong.err;
}

TEST_F(DefaultsTest, FaultsNameTheirPlaceAndTheRemedy) {
    for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
             {"{\"*\": {\"threads\": 1}\n,\n}", "line 3: this is not well-formed JSON"},
             {"", "line 1: this is not well-formed JSON"},
             {"[]", "expected an object with commands"},
             {"3", "expected an object with commands"},
             {R"({"rendr": {}})",
              "rendr: there is no such command; expected a command, or '*' for all; did you mean 'render'?"},
             {R"({"render": 4})", "render: expected an object with options"},
             {R"({"info": {"spacin": 1}})",
              "info.spacin: there is no such option of this command; did you mean 'spacing'?"},
             {R"({"*": {"thread": 1}})", "*.thread: there is no such option; did you mean 'threads'?"},
             {R"({"info": {"threads": "many"}})", "info.threads: 'many' is not a number"},
             {R"({"info": {"threads": 4000}})", "info.threads: 4000 is out of range; possible is 0 to 1024"},
             {R"({"info": {"threads": true}})", "info.threads: expected a text or a number, found true"},
             {R"({"info": {"threads": [1, 2]}})", "info.threads: expected a text or a number, found"},
             {R"({"info": {"threads": null}})", "info.threads: expected a text or a number, found null"},
             {R"({"info": {"patterns": "yes"}})", "info.patterns: expected true or false, found"},
             {R"({"render": {"look": "nice"}})", "render.look: 'nice' is not possible; possible are"},
             {R"({"render": {"show": [1, {}]}})",
              "render.show: expected a text or a number, or a list of them, found {}"},
             {R"({"render": {"show": []}})", "render.show: the list is empty"},
             {R"({"info": {"input": "a.gml"}})", "info.input: arguments have no defaults"},
             {R"({"info": {"lod": 1e999}})", "a number is out of range"},
             {R"({"city plan": {"spacing": 0}})", "city plan.spacing: 0 is out of range"}}) {
        project(text);
        expectRefused(fault);
    }
    // The same for the file of the user.
    project("{}");
    user("{");
    expectRefused("settings/svt/svt.json: line 1");
    // Commands without such options do not read it.
    EXPECT_EQ(run("svt describe json").exitCode, kDone);
    EXPECT_EQ(run("svt --version").exitCode, kDone);
}

// ---- files of strangers ---------------------------------------------------------------------------------------------

TEST_F(DefaultsTest, AProjectSetsOnlyWhatIsDeclaredForIt) {
    const json described = runSvtForJson(folder.path(), {"describe", "json"});
    int refused = 0, allowed = 0;
    for (const auto& command : described.at("commands"))
        for (const auto& option : command.at("options")) {
            const std::string names = option.at("name"), name = names.substr(names.find(',') + 1);
            if (option.contains("project")) {
                EXPECT_FALSE(option.contains("file")) << command.at("name") << " " << name << " names a file";
                EXPECT_TRUE(name.starts_with("--")) << name;
                ++allowed;
                continue;
            }
            ++refused;
            json text;
            text[command.at("name").get<std::string>()][name.substr(name.find_first_not_of('-'))] =
                option.at("kind") == "flag" ? json(true) : json("1");
            project(text.dump());
            const LineResult result = run("svt info project/two.gml --spacing 1");
            EXPECT_EQ(result.exitCode, kUsage) << text << result.toString();
            EXPECT_NE(result.err.find("E905"), std::string::npos) << text << result.err;
        }
    EXPECT_GT(refused, 100);
    EXPECT_GT(allowed, 100);
    // Harmful options: files, outputs, programs, servers, limits.
    for (const char* text :
         {R"({"*": {"memory": 999999}})", R"({"*": {"style": "x"}})", R"({"*": {"max-input": 999999}})",
          R"({"render": {"output": "/tmp/x.png"}})", R"({"render": {"write-scene": "x.json"}})",
          R"({"render": {"scene": "x.json"}})", R"({"serve": {"host": "0.0.0.0"}})",
          R"({"serve": {"allow-uploads": true}})", R"({"view": {"viewer": "/tmp"}})",
          R"({"city-run": {"engine": "slurm"}})", R"({"publish": {"force": true}})",
          R"({"thumbnail": {"max-seconds": 3600}})", R"({"*": {"no-config": true}})", R"({"*": {"quiet": true}})"}) {
        project(text);
        EXPECT_NE(run("svt info project/two.gml").err.find("E905"), std::string::npos) << text;
    }
}

TEST_F(DefaultsTest, WhatIsNoFileIsRefusedAtOnce) {
    const fs::path file = folder / "project/svt.json";
    const auto expect = [&](const std::string& text) {
        expectRefused(text);
        fs::remove_all(file);
    };
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    expect("this is a pipe or device");
    fs::create_directory(file);
    expect("this is a folder");
    fs::create_symlink("svt.json", file);
    expect("the file cannot be opened");
    fs::create_symlink("/dev/zero", file);
    expect("this is a pipe or device");
    fs::create_symlink("nowhere", file);
    expect("the file does not exist");
    writeText(file, "{}");
    fs::resize_file(file, 1'000'000'000);
    expect("the file has 1000000000 bytes, the limit is 1048576");
    writeText(file, R"({"*": )" + std::string(100'000, '['));
    expect("line 1: this is not well-formed JSON");
    writeText(file, R"({"*": )" + std::string(100'000, '[') + std::string(100'000, ']') + "}");
    expect("nested too deeply");
    writeText(file, std::string("{\"*\": {\"thr\0eads\": 1}}", 22));
    expect("not well-formed JSON");
    writeText(file, "{\"*\": {\"\xff\": 1}}");
    expect("not well-formed JSON");
    // Its content is not shown: a link may lead to any file.
    writeText(folder / "secret", "password: 12345");
    fs::create_symlink("../secret", file);
    EXPECT_EQ(run("svt info project/two.gml").err.find("12345"), std::string::npos);
}

// A folder of settings that cannot be searched, and one that is not there.
TEST_F(DefaultsTest, NoFileIsNoError) {
    for (const std::string settings : {"export XDG_CONFIG_HOME=/nowhere", "export XDG_CONFIG_HOME=relative",
                                       "unset XDG_CONFIG_HOME HOME", "export XDG_CONFIG_HOME=\"$PWD/project/two.gml\""})
        EXPECT_EQ(run(settings + "; svt info project/two.gml --spacing 1").exitCode, kDone) << settings;
    // Without the variable, the folder is in the home.
    fs::create_directories(folder / "home/.config/svt");
    writeText(folder / "home/.config/svt/svt.json", R"({"info": {"spacing": 1}})");
    const std::string home = "unset XDG_CONFIG_HOME; export HOME=\"$PWD/home\"; ";
    EXPECT_EQ(json::parse(runWell(home + "svt info project/two.gml --json"))["grid"]["spacing"][0], 1);
}

// The header of a .svt that somebody has unpacked.
TEST_F(DefaultsTest, TheHeaderOfAnUnpackedVolumeHasNoDefaults) {
    if (!hasProgram("python3 --version")) GTEST_SKIP() << "there is no python3 to unpack a ZIP file";
    runWell("svt build project/two.gml -o two.svt --spacing 0.5");
    runWell("cd project; python3 -m zipfile -e ../two.svt .");
    EXPECT_TRUE(fs::exists(folder / "project/svt.json"));
    EXPECT_EQ(spacingOf("--spacing 1"), 1);
}

// An option of several commands that a project may set only in some of them.
TEST_F(DefaultsTest, ValuesForAllCommandsAreTakenWhereTheyArePossible) {
    project(R"({"*": {"labels": "groups", "spacing": 0.5, "level": "storey"}})");
    EXPECT_EQ(run("svt render project/two.gml -o a.png --size 32x32").exitCode, kUsage) << "its level is a number";
    project(R"({"*": {"labels": "groups", "spacing": 0.5}})");
    runWell("svt render project/two.gml -o a.png --size 32x32");
    EXPECT_FALSE(fs::exists(folder / "groups")) << "--labels of svt render names an output";
}

// A model with the name of a file with defaults is a model.
TEST_F(DefaultsTest, AModelOfThatNameIsAModel) {
    project(cityJson());
    EXPECT_EQ(run("svt info project/svt.json --spacing 1").exitCode, kDone);
}

}  // namespace
}  // namespace svt::test
