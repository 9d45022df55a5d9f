// Every command shown in the documents works as written. Blocks of ```sh in README.md and docs/user/*.md are
// run line by line in one folder per document; lines that do not start with the command (or with build/release/bin/svt)
// are skipped. Tutorials, explanation and gallery run from top to bottom, with their programs in Python, and print the
// output that they show. A server command runs until it has printed its address, and must then end successfully when stopped.
// The example of a page in docs/errors is run as a whole, and must print the message that the page shows.
// Links, sources, commands and options that any page of the tree names are there.
#include "run_command.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

struct ShownCommand {
    int line = 0;
    std::string text;
};

// The commands of a document; a backslash at the end of a line continues it.
std::vector<ShownCommand> commandsOf(const fs::path& document) {
    std::ifstream in(document);
    std::vector<ShownCommand> commands;
    bool isShell = false, isContinued = false;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.rfind("```", 0) == 0) {
            isShell = line == "```sh";
            isContinued = false;
            continue;
        }
        if (!isShell) continue;
        const bool startsHere = line.rfind("svt ", 0) == 0 || line.rfind("build/release/bin/svt ", 0) == 0;
        if (isContinued)
            commands.back().text += "\n" + line;
        else if (startsHere)
            commands.push_back({number, line});
        isContinued = (isContinued || startsHere) && !line.empty() && line.back() == '\\';
    }
    return commands;
}

// The command as installed: with a stand-in for the viewer page, and without a browser.
class Installed {
public:
    Installed() {
        fs::create_directories(folder_ / "bin");
        fs::create_directories(folder_ / "share/svt/viewer");
        std::error_code error;
        fs::create_hard_link(commandPath(), folder_ / "bin/svt", error);
        if (error) fs::copy_file(commandPath(), folder_ / "bin/svt");
        writeText(folder_ / "bin/xdg-open", "#!/bin/sh\n");
        fs::permissions(folder_ / "bin/xdg-open", fs::perms::owner_all);
        writeText(folder_ / "share/svt/viewer/index.html", "<!doctype html><head></head>");
    }
    [[nodiscard]] std::string bin() const { return (folder_ / "bin").string(); }

private:
    TemporaryFolder folder_;
};

// A script that starts a server, waits for its address, and stops it.
std::string untilItServes(const std::string& text) {
    // The file may still hold the address of the previous server.
    return "rm -f address\n( exec " + text + "\n) > address 2> messages &\nserver=$!\n" +
           "until grep -qs ^http address; do kill -0 $server || break; sleep 0.02; done\n" +
           "kill -TERM $server\nwait $server\ncode=$?\ncat address messages\nexit $code\n";
}

// Runs text in a shell that has `svt` in its path, as a reader would; stdout goes to run.log, stderr to run.err.
int runScript(const fs::path& folder, const std::string& text) {
    static const Installed installed;
    const std::string at = folder.string();
    // Files with defaults beside a model are read, and none of the user.
    writeText(folder / "run.sh", "unset SVT_NO_CONFIG\nexport XDG_CONFIG_HOME='" + at + "/no settings'\nPATH='" +
                                     installed.bin() + "':$PATH\ncd '" + at + "'\n" + text + "\n");
    const int status =
        std::system(("timeout 900 sh '" + at + "/run.sh' > '" + at + "/run.log' 2> '" + at + "/run.err'").c_str());
    return WEXITSTATUS(status);
}

// Runs a line. A trailing comment `# exit N` states an exit code other than 0.
void expectWorks(const fs::path& folder, const ShownCommand& command, const fs::path& document) {
    int expected = 0;
    const std::size_t at = command.text.rfind("# exit ");
    if (at != std::string::npos) expected = std::atoi(command.text.c_str() + at + 7);
    std::string text = command.text;
    constexpr std::string_view kBuilt = "build/release/bin/svt ";
    if (text.rfind(kBuilt, 0) == 0) text = "svt " + text.substr(kBuilt.size());
    if (text.rfind("svt serve ", 0) == 0 || text.rfind("svt view ", 0) == 0) text = untilItServes(text);
    const int exitCode = runScript(folder, text);
    // Not every machine has a graphics driver.
    constexpr int kNoGraphics = 6;
    if (exitCode == kNoGraphics && text.find(" --gl") != std::string::npos) return;
    EXPECT_EQ(exitCode, expected) << document << ":" << command.line << ": " << command.text << "\n"
                                  << readText(folder / "run.log") << readText(folder / "run.err");
}

// What a page of docs/errors shows under "Example".
struct ErrorExample {
    std::string commands;               ///< of its block ```sh; empty: none is shown
    std::vector<std::string> messages;  ///< lines of its other block
};

ErrorExample exampleOf(const fs::path& page) {
    std::ifstream in(page);
    ErrorExample example;
    bool isExample = false, isOpen = false, isShell = false;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("## ", 0) == 0) isExample = line == "## Example";
        if (!isExample) continue;
        if (line.rfind("```", 0) == 0) {
            isOpen = !isOpen;
            isShell = line == "```sh";
        } else if (isOpen && isShell) {
            example.commands += line + "\n";
        } else if (isOpen) {
            example.messages.push_back(line);
        }
    }
    return example;
}

TEST(Documents, CommandsOfTheReadmeWork) {
    const fs::path readme = fs::path(sourceRoot()) / "README.md";
    if (!fs::exists(readme)) GTEST_SKIP() << "there is no README.md yet";
    const TemporaryFolder folder;
    for (const ShownCommand& command : commandsOf(readme)) expectWorks(folder.path(), command, readme);
}

std::vector<std::string> userPages() {
    std::vector<std::string> pages;
    for (const auto& entry : fs::directory_iterator(fs::path(sourceRoot()) / "docs/user"))
        if (entry.path().extension() == ".md") pages.push_back(entry.path().stem().string());
    std::sort(pages.begin(), pages.end());
    return pages;
}

// Files shown on a page as ```json NAME or ```csv NAME are written before its commands run.
void writeShownFiles(const fs::path& page, const TemporaryFolder& folder) {
    std::ifstream in(page);
    std::string name, content;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("```json ", 0) == 0 || line.rfind("```csv ", 0) == 0) {
            name = line.substr(line.find(' ') + 1);
            content.clear();
        } else if (line.rfind("```", 0) == 0) {
            if (!name.empty()) writeText(folder / name, content);
            name.clear();
        } else {
            content += line + "\n";
        }
    }
}

class UserPage : public ::testing::TestWithParam<std::string> {};

TEST_P(UserPage, ItsCommandsWork) {
    const fs::path page = fs::path(sourceRoot()) / "docs/user" / (GetParam() + ".md");
    const TemporaryFolder folder;
    writeShownFiles(page, folder);
    for (const ShownCommand& command : commandsOf(page)) expectWorks(folder.path(), command, page);
}

INSTANTIATE_TEST_SUITE_P(Documents, UserPage, ::testing::ValuesIn(userPages()), [](const auto& tested) {
    std::string name = tested.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
});

TEST(Documents, TheUserDocsShowCommands) {
    std::size_t count = 0;
    for (const std::string& page : userPages())
        count += commandsOf(fs::path(sourceRoot()) / "docs/user" / (page + ".md")).size();
    EXPECT_GT(count, 100u);
}

// A page that a reader follows from top to bottom.
struct Step {
    enum class Kind { File, Command, Output };
    Kind kind = Kind::Command;
    int line = 0;
    std::string name;  ///< of a file
    std::string text;  ///< content, command, or output as shown
};

bool isFileBlock(const std::string& info) {
    return info.rfind("json ", 0) == 0 || info.rfind("csv ", 0) == 0 || info.rfind("python ", 0) == 0;
}

// Blocks ```json NAME, ```csv NAME and ```python NAME are files, lines of ```sh blocks commands, and ```text output.
std::vector<Step> stepsOf(const fs::path& page) {
    std::ifstream in(page);
    std::vector<Step> steps;
    bool isOpen = false, isContinued = false;
    std::string info;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.rfind("```", 0) == 0) {
            isOpen = !isOpen;
            isContinued = false;
            info = isOpen ? line.substr(3) : std::string();
            if (isFileBlock(info)) steps.push_back({Step::Kind::File, number, info.substr(info.find(' ') + 1), {}});
            if (info == "text") steps.push_back({Step::Kind::Output, number, {}, {}});
        } else if (isFileBlock(info) || info == "text") {
            steps.back().text += line + "\n";
        } else if (info == "sh" && isContinued) {
            steps.back().text += "\n" + line;
            isContinued = !line.empty() && line.back() == '\\';
        } else if (info == "sh" && (line.rfind("svt ", 0) == 0 || line.rfind("python3 ", 0) == 0)) {
            steps.push_back({Step::Kind::Command, number, {}, line});
            isContinued = line.back() == '\\';
        }
    }
    return steps;
}

// One blank for several: the widths of columns depend on their content.
std::string withSingleBlanks(const std::string& text) {
    std::string single;
    for (const char c : text)
        if (c != ' ' || single.empty() || single.back() != ' ') single += c;
    return single;
}

// Whether text occurs in what was printed; "..." stands for any text.
bool isPrinted(const std::string& shownText, const std::string& printedText) {
    const std::string shown = withSingleBlanks(shownText), printed = withSingleBlanks(printedText);
    constexpr std::string_view kAnything = "...";
    std::size_t at = 0;
    for (std::size_t from = 0; from < shown.size();) {
        const std::size_t end = std::min(shown.find(kAnything, from), shown.size());
        std::string piece = shown.substr(from, end - from);
        if (!piece.empty() && piece.front() == '\n') piece.erase(0, 1);
        at = printed.find(piece, at);
        if (at == std::string::npos) return false;
        at += piece.size();
        from = end + kAnything.size();
    }
    return true;
}

// The folder of the built module svt for Python; empty: it is not built.
fs::path pythonModule() {
    const fs::path folder = buildFolder() / "python";
    return fs::exists(folder / "svt" / "__init__.py") ? folder : fs::path();
}

// A Python that can import the module: the first one in the path may be another one than that of the build.
std::string pythonWithModule() {
    for (const std::string name : {"python3", "/usr/bin/python3"})
        if (std::system(("PYTHONPATH='" + pythonModule().string() + "' " + name + " -c 'import svt, numpy' 2>/dev/null")
                            .c_str()) == 0)
            return name;
    return {};
}

// Tutorials, explanation, gallery and the first page, as paths in docs/ without ending.
std::vector<std::string> followedPages() {
    const fs::path docs = fs::path(sourceRoot()) / "docs";
    std::vector<std::string> pages = {"README", "gallery"};
    for (const char* folder : {"tutorials", "explanation"})
        for (const auto& entry : fs::directory_iterator(docs / folder))
            if (entry.path().extension() == ".md")
                pages.push_back(std::string(folder) + "/" + entry.path().stem().string());
    std::sort(pages.begin(), pages.end());
    return pages;
}

class FollowedPage : public ::testing::TestWithParam<std::string> {};

TEST_P(FollowedPage, ItsStepsWorkAndPrintWhatItShows) {
    const fs::path page = fs::path(sourceRoot()) / "docs" / (GetParam() + ".md");
    const std::vector<Step> steps = stepsOf(page);
    const auto isPython = [](const Step& step) {
        return step.kind == Step::Kind::Command && step.text.rfind("python3 ", 0) == 0;
    };
    std::string python;
    if (std::any_of(steps.begin(), steps.end(), isPython)) {
        if (pythonModule().empty()) GTEST_SKIP() << "the module for Python is not built (make python)";
        python = pythonWithModule();
        ASSERT_FALSE(python.empty()) << "no Python can import " << pythonModule();
    }
    const TemporaryFolder folder;
    std::string printed;
    for (const Step& step : steps) {
        if (step.kind == Step::Kind::File) {
            writeText(folder / step.name, step.text);
        } else if (step.kind == Step::Kind::Command) {
            const std::string text = isPython(step) ? "PYTHONPATH='" + pythonModule().string() + "' " + python +
                                                          step.text.substr(std::string_view("python3").size())
                                                    : step.text;
            expectWorks(folder.path(), {step.line, text}, page);
            printed += readText(folder / "run.log") + readText(folder / "run.err");
        } else {
            EXPECT_TRUE(isPrinted(step.text, printed)) << page << ":" << step.line << ": the page shows\n"
                                                       << step.text << "but its commands print\n"
                                                       << printed;
            printed.clear();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Documents, FollowedPage, ::testing::ValuesIn(followedPages()), [](const auto& tested) {
    std::string name = tested.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
});

TEST(Documents, TheTutorialsShowOutput) {
    int commands = 0, outputs = 0;
    for (const std::string& name : followedPages())
        for (const Step& step : stepsOf(fs::path(sourceRoot()) / "docs" / (name + ".md"))) {
            commands += step.kind == Step::Kind::Command;
            outputs += step.kind == Step::Kind::Output;
        }
    EXPECT_GT(commands, 60);
    EXPECT_GT(outputs, 12);
}

TEST(Documents, OutputThatIsNotPrintedIsFound) {
    const std::string printed = "id  name\na   wall\nb   room\n2 rows\n";
    EXPECT_TRUE(isPrinted("a   wall\n", printed));
    EXPECT_TRUE(isPrinted("id  name\n...\nb   room\n...\n", printed));
    EXPECT_TRUE(isPrinted("a   ...\n2 rows\n", printed));
    EXPECT_TRUE(isPrinted("a wall\nb  room\n", printed)) << "columns of other widths";
    EXPECT_FALSE(isPrinted("a   slab\n", printed));
    EXPECT_FALSE(isPrinted("b   room\n...\na   wall\n", printed)) << "in another order";
    EXPECT_FALSE(isPrinted("a   wall\n2 rows\n", printed)) << "a line between is left out";
}

std::vector<std::string> errorPages() {
    std::vector<std::string> pages;
    for (const auto& entry : fs::directory_iterator(fs::path(sourceRoot()) / "docs/errors"))
        if (!exampleOf(entry.path()).commands.empty()) pages.push_back(entry.path().stem().string());
    std::sort(pages.begin(), pages.end());
    return pages;
}

class ErrorPage : public ::testing::TestWithParam<std::string> {};

TEST_P(ErrorPage, ItsCommandsPrintItsMessages) {
    const ErrorExample example = exampleOf(fs::path(sourceRoot()) / "docs/errors" / (GetParam() + ".md"));
    const bool needsFullDevice = example.commands.find("/dev/full") != std::string::npos;
    if (needsFullDevice && !fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const TemporaryFolder folder;
    (void)runScript(folder.path(), example.commands);
    const std::string printed = "\n" + readText(folder / "run.err");
    EXPECT_FALSE(example.messages.empty());
    for (const std::string& message : example.messages)
        EXPECT_NE(printed.find("\n" + message + "\n"), std::string::npos)
            << "it shows\n"
            << message << "\nbut its commands print" << printed;
}

INSTANTIATE_TEST_SUITE_P(Documents, ErrorPage, ::testing::ValuesIn(errorPages()),
                         [](const auto& tested) { return tested.param; });

TEST(Documents, MostErrorPagesHaveCommands) { EXPECT_GT(errorPages().size(), 40u); }

// A piece of a page: of its text, or of its code. A block of code gives one for each line, with the lines that continue it.
struct Piece {
    int line = 0;
    std::string text;
    bool isCode = false;
};

// Splits a line of text at its code in backticks, which may have several on each side.
void addPieces(int line, const std::string& text, std::vector<Piece>& pieces) {
    std::size_t from = 0;
    while (from < text.size()) {
        const std::size_t begin = std::min(text.find('`', from), text.size());
        const std::size_t code = std::min(text.find_first_not_of('`', begin), text.size());
        const std::size_t end = text.find(text.substr(begin, code - begin), code);
        if (begin == text.size() || end == std::string::npos) break;
        pieces.push_back({line, text.substr(from, begin - from), false});
        pieces.push_back({line, text.substr(code, end - code), true});
        from = end + (code - begin);
    }
    pieces.push_back({line, text.substr(from), false});
}

std::vector<Piece> piecesOf(const fs::path& page) {
    std::ifstream in(page);
    std::vector<Piece> pieces;
    bool isBlock = false, isContinued = false;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (line.find("```") == line.find_first_not_of(' ') && line.find("```") != std::string::npos) {
            isBlock = !isBlock;
            isContinued = false;
            continue;
        }
        if (!isBlock) {
            addPieces(number, line, pieces);
            continue;
        }
        const bool continues = line.ends_with('\\');
        if (continues) line.pop_back();
        if (isContinued)
            pieces.back().text += line;
        else
            pieces.push_back({number, line, true});
        isContinued = continues;
    }
    return pieces;
}

// The folders of the tree that have sources or pages.
constexpr std::string_view kFoldersOfTheTree[] = {"apps",   "bench",   "cmake", "docs",  "examples",
                                                  "python", "scripts", "svt",   "tests", "web"};

// All files of these folders and those at the top, but for packages of others.
const std::vector<fs::path>& filesOfTheTree() {
    static const std::vector<fs::path> files = [] {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(sourceRoot()))
            if (entry.is_regular_file()) found.push_back(entry.path());
        for (const std::string_view folder : kFoldersOfTheTree)
            for (fs::recursive_directory_iterator at(sourceRoot() / fs::path(folder)), end; at != end; ++at) {
                if (at->path().filename() == "node_modules") at.disable_recursion_pending();
                if (at->is_regular_file()) found.push_back(at->path());
            }
        std::sort(found.begin(), found.end());
        return found;
    }();
    return files;
}

// The pages of the tree; the log of changes names what there is no more.
const std::vector<fs::path>& allPages() {
    static const std::vector<fs::path> pages = [] {
        std::vector<fs::path> found;
        for (const fs::path& file : filesOfTheTree())
            if (file.extension() == ".md" && file.filename() != "CHANGELOG.md") found.push_back(file);
        return found;
    }();
    return pages;
}

std::string placeOf(const fs::path& page, const Piece& piece) {
    return page.lexically_relative(sourceRoot()).string() + ":" + std::to_string(piece.line) + ": ";
}

// What a heading is called in links: "Two *words*, here" -> "two-words-here".
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char c : heading.substr(std::min(heading.find_first_not_of("# "), heading.size()))) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ')
            anchor += '-';
        else if (byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

bool hasHeading(const fs::path& page, const std::string& anchor) {
    std::ifstream in(page);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with('#') && anchorOf(line) == anchor) return true;
    return false;
}

// Links to files that are not there, and to headings that a page does not have.
std::vector<std::string> faultsOfLinks(const fs::path& page, int& count) {
    std::vector<std::string> faults;
    std::string text;
    for (const Piece& piece : piecesOf(page))
        if (!piece.isCode) text += piece.text + "\n";
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
        if (target.starts_with("http")) continue;
        ++count;
        const std::size_t hash = std::min(target.find('#'), target.size());
        const fs::path file = hash == 0 ? page : page.parent_path() / target.substr(0, hash);
        const bool isGood = fs::exists(file) && (hash == target.size() || hasHeading(file, target.substr(hash + 1)));
        if (!isGood) faults.push_back(page.lexically_relative(sourceRoot()).string() + ": " + target);
    }
    return faults;
}

// Names of files in code. What has a bracket, a star or a word in capitals stands for many.
std::vector<std::string> namesIn(const std::string& code) {
    constexpr std::string_view kPunctuation = "_./*{}<>,-";
    std::vector<std::string> names;
    const auto isOfName = [&](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || kPunctuation.find(c) != std::string_view::npos;
    };
    for (auto at = code.begin(); at != code.end();) {
        const auto begin = std::find_if(at, code.end(), isOfName);
        at = std::find_if_not(begin, code.end(), isOfName);
        std::string name(begin, at);
        while (name.ends_with('.') || name.ends_with(',')) name.pop_back();
        const std::string stem = name.substr(name.rfind('/') + 1).substr(0, name.substr(name.rfind('/') + 1).find('.'));
        const bool isPattern = name.find_first_of("*{<") != std::string::npos ||
                               (name.find(".md") == std::string::npos &&
                                stem.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos);
        if (!name.empty() && !isPattern) names.push_back(std::move(name));
    }
    return names;
}

// Sources and folders that code names and the tree does not have.
std::vector<std::string> faultsOfNames(const fs::path& page, int& count) {
    static const std::set<std::string> kEnds = [] {
        std::set<std::string> ends;  // of the paths of all files, whole parts
        for (const fs::path& file : filesOfTheTree()) {
            const std::string path = file.lexically_relative(sourceRoot()).generic_string();
            for (std::size_t at = 0;; at = path.find('/', at) + 1) {
                ends.insert(path.substr(at));
                if (path.find('/', at) == std::string::npos) break;
            }
        }
        return ends;
    }();
    constexpr std::string_view kSources[] = {".cpp", ".hpp", ".sh", ".py", ".pyi", ".ts", ".mjs", ".glsl", ".cmake"};
    std::vector<std::string> faults;
    std::set<std::string> shown;  // files that the page itself has
    for (const Step& step : stepsOf(page)) shown.insert(step.name);
    for (const Piece& piece : piecesOf(page)) {
        if (!piece.isCode) continue;
        for (const std::string& name : namesIn(piece.text)) {
            const std::string top = name.substr(0, std::min(name.find('/'), name.size()));
            const bool isInTree = name.size() > top.size() + 1 &&
                                  std::ranges::find(kFoldersOfTheTree, top) != std::end(kFoldersOfTheTree);
            const bool isSource = std::ranges::find(kSources, fs::path(name).extension()) != std::end(kSources);
            if (!isInTree && (!isSource || name.starts_with('_'))) continue;
            ++count;
            if (fs::exists(sourceRoot() / fs::path(name)) || fs::exists(page.parent_path() / name) ||
                kEnds.contains(name) || shown.contains(name))
                continue;
            faults.push_back(placeOf(page, piece) + name);
        }
    }
    return faults;
}

// The options of each command, with those that all have.
const std::map<std::string, std::set<std::string>>& knownOptions() {
    static const std::map<std::string, std::set<std::string>> known = [] {
        std::map<std::string, std::set<std::string>> options;
        const TemporaryFolder folder;
        const nlohmann::json described = runSvtForJson(folder.path(), {"describe", "json"});
        for (const auto& command : described.at("commands")) {
            auto& names = options[command.at("name")];
            names = {"-h", "--help"};
            for (const auto& option : command.at("options")) {
                std::istringstream in(option.at("name").get<std::string>());
                for (std::string name; std::getline(in, name, ',');) names.insert(name);
            }
        }
        EXPECT_GT(options.size(), 10u) << described.dump().substr(0, 300);
        return options;
    }();
    return known;
}

std::vector<std::string> wordsOf(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

// "--axes" of "[--axes=world]"; empty where a word is no option.
std::string optionOf(std::string word) {
    word.erase(0, std::min(word.find_first_not_of("[("), word.size()));
    const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
    if (dashes == 0 || dashes > 2 || dashes == word.size() ||
        std::isalpha(static_cast<unsigned char>(word[dashes])) == 0)
        return {};
    const auto isOfOption = [](char c) { return c == '-' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    return {word.begin(), std::find_if_not(word.begin(), word.end(), isOfOption)};
}

// Commands and options of `svt` in one command line that it does not have.
void checkCommand(const std::vector<std::string>& words, const std::string& place, int& count,
                  std::vector<std::string>& faults) {
    const auto& known = knownOptions();
    std::size_t at = 0;
    while (at < words.size() && (words[at] == "$" || words[at].find('=') != std::string::npos)) ++at;
    if (at + 1 >= words.size() || fs::path(words[at]).filename() != "svt") return;
    std::string command = words[at + 1];
    if (at + 2 < words.size() && known.contains(command + "-" + words[at + 2])) command += "-" + words[at + 2];
    if (command.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos || command.starts_with('-'))
        return;  // `svt <command>`, `svt --version`
    ++count;
    const auto begins = [&](const auto& each) { return each.first.starts_with(command + "-"); };
    if (!known.contains(command)) {
        if (std::none_of(known.begin(), known.end(), begins)) faults.push_back(place + "svt " + command);
        return;
    }
    for (std::size_t n = at + 2; n < words.size() && words[n] != "--" && !words[n].starts_with('#'); ++n)
        if (const std::string option = optionOf(words[n]); !option.empty() && !known.at(command).contains(option))
            faults.push_back(place + "svt " + command + " " + option);
}

// Lines with another exit code than 0 show what is wrong.
std::vector<std::string> faultsOfCommands(const fs::path& page, int& count) {
    std::vector<std::string> faults;
    for (const Piece& piece : piecesOf(page)) {
        if (!piece.isCode || piece.text.find("# exit 2") != std::string::npos) continue;
        for (std::size_t from = 0; from <= piece.text.size();) {
            const std::size_t end = std::min(piece.text.find_first_of("|;&", from), piece.text.size());
            checkCommand(wordsOf(piece.text.substr(from, end - from)), placeOf(page, piece), count, faults);
            from = end + 1;
        }
    }
    return faults;
}

using FaultsOfPage = std::vector<std::string> (*)(const fs::path&, int&);

// Expects no fault in any page, and that more than `least` was looked at.
void expectNoFaults(FaultsOfPage faultsOf, int least) {
    int count = 0;
    for (const fs::path& page : allPages())
        for (const std::string& fault : faultsOf(page, count)) ADD_FAILURE() << fault;
    EXPECT_GT(count, least) << "the pages were not read";
}

TEST(Documents, EveryLinkLeadsToAFileOrHeading) { expectNoFaults(faultsOfLinks, 300); }

TEST(Documents, EverySourceThatIsNamedIsThere) { expectNoFaults(faultsOfNames, 300); }

TEST(Documents, EveryCommandAndOptionThatIsShownExists) { expectNoFaults(faultsOfCommands, 300); }

TEST(Documents, WhatIsStaleIsFound) {
    const TemporaryFolder folder;
    writeText(
        folder / "page.md",
        "# Some *words*, here\n[a](page.md#some-words-here) [b](page.md#others) [c](gone.md) `[d](e)`\n"
        "`svt/core/file.hpp`, `svt/core/gone.hpp`, ``core/file.hpp``, `gone.cpp` and `<name>_test.cpp`; "
        "`scripts/gone`\n"
        "`svt info house.svt --json`, `svt info --gone`, `svt city plan a --update --gone`, `svt gone a`, `svt city`\n"
        "```sh\nsvt build a.gml -o a.svt \\\n  --gone=1 -x\nsvt city run a -- --time=1 | svt info --tree --gone2\n"
        "svt build --gone  # exit 2\n```\n");
    const fs::path page = folder / "page.md";
    const std::string name = page.lexically_relative(sourceRoot()).string();
    using Texts = std::vector<std::string>;
    int count = 0;
    EXPECT_EQ(faultsOfLinks(page, count), (Texts{name + ": page.md#others", name + ": gone.md"}));
    EXPECT_EQ(faultsOfNames(page, count),
              (Texts{name + ":3: svt/core/gone.hpp", name + ":3: gone.cpp", name + ":3: scripts/gone"}));
    EXPECT_EQ(faultsOfCommands(page, count),
              (Texts{name + ":4: svt info --gone", name + ":4: svt city-plan --gone", name + ":4: svt gone",
                     name + ":6: svt build --gone", name + ":6: svt build -x", name + ":8: svt info --gone2"}));
}

}  // namespace
}  // namespace svt::test
