// Every command shown in the documents works as written. Blocks of ```sh in README.md and docs/user/*.md are
// run line by line in one folder per document; lines that do not start with the command (or with build/release/bin/svt)
// are skipped. A server command runs until it has printed its address, and must then end successfully when stopped.
// The example of a page in docs/errors is run as a whole, and must print the message that the page shows.
#include "run_command.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
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
    writeText(folder / "run.sh", "PATH='" + installed.bin() + "':$PATH\ncd '" + at + "'\n" + text + "\n");
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

void expectLinksLeadToFiles(const fs::path& page) {
    const std::string text = readText(page);
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
        if (target.rfind("http", 0) == 0) continue;
        target = target.substr(0, target.find('#'));
        if (target.empty()) continue;
        EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << ": " << target;
    }
}

TEST(Documents, EveryLinkLeadsToAFile) {
    for (const char* folder : {"docs/user", "docs/errors"}) {
        const fs::path docs = fs::path(sourceRoot()) / folder;
        if (!fs::exists(docs)) GTEST_SKIP() << "there is no " << folder;
        for (const auto& entry : fs::directory_iterator(docs))
            if (entry.path().extension() == ".md") expectLinksLeadToFiles(entry.path());
    }
}

}  // namespace
}  // namespace svt::test
