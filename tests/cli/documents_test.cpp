// Every command shown in the documents works as written. Blocks of ```sh in README.md and docs/user/*.md are
// run line by line in one folder per document; lines that do not start with the command (or with build/release/bin/svt)
// are skipped. A server command runs until it has printed its address, and must then end successfully when stopped.
#include "run_command.hpp"

#include <algorithm>
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
        fs::create_hard_link(SVT_COMMAND, folder_ / "bin/svt", error);
        if (error) fs::copy_file(SVT_COMMAND, folder_ / "bin/svt");
        writeText(folder_ / "bin/xdg-open", "#!/bin/sh\n");
        fs::permissions(folder_ / "bin/xdg-open", fs::perms::owner_all);
        writeText(folder_ / "share/svt/viewer/index.html", "<!doctype html>");
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

// Runs a line in a shell that has `svt` in its path, as a reader would. A trailing comment `# exit N` states an exit
// code other than 0.
void expectWorks(const fs::path& folder, const ShownCommand& command, const fs::path& document) {
    int expected = 0;
    const std::size_t at = command.text.rfind("# exit ");
    if (at != std::string::npos) expected = std::atoi(command.text.c_str() + at + 7);
    std::string text = command.text;
    constexpr std::string_view kBuilt = "build/release/bin/svt ";
    if (text.rfind(kBuilt, 0) == 0) text = "svt " + text.substr(kBuilt.size());
    static const Installed installed;
    if (text.rfind("svt serve ", 0) == 0 || text.rfind("svt view ", 0) == 0) text = untilItServes(text);
    writeText(folder / "run.sh", "PATH='" + installed.bin() + "':$PATH\ncd '" + folder.string() + "'\n" + text + "\n");
    const std::string log = (folder / "run.log").string();
    const int status =
        std::system(("timeout 60 sh '" + (folder / "run.sh").string() + "' > '" + log + "' 2>&1").c_str());
    // Not every machine has a graphics driver.
    constexpr int kNoGraphics = 6;
    if (WEXITSTATUS(status) == kNoGraphics && text.find(" --gl") != std::string::npos) return;
    EXPECT_EQ(WEXITSTATUS(status), expected) << document << ":" << command.line << ": " << command.text << "\n"
                                             << readText(log);
}

TEST(Documents, CommandsOfTheReadmeWork) {
    const fs::path readme = fs::path(SVT_SOURCE_DIR) / "README.md";
    if (!fs::exists(readme)) GTEST_SKIP() << "there is no README.md yet";
    const TemporaryFolder folder;
    for (const ShownCommand& command : commandsOf(readme)) expectWorks(folder.path(), command, readme);
}

TEST(Documents, CommandsOfTheUserDocsWork) {
    const fs::path docs = fs::path(SVT_SOURCE_DIR) / "docs/user";
    if (!fs::exists(docs)) GTEST_SKIP() << "there is no docs/user";
    std::vector<fs::path> pages;
    for (const auto& entry : fs::directory_iterator(docs))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    std::sort(pages.begin(), pages.end());
    std::size_t count = 0;
    for (const fs::path& page : pages) {
        const TemporaryFolder folder;
        // Files shown on a page as ```json NAME or ```csv NAME are written before its commands run.
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
        for (const ShownCommand& command : commandsOf(page)) {
            expectWorks(folder.path(), command, page);
            ++count;
        }
    }
    EXPECT_GT(count, 20u);
}

TEST(Documents, EveryLinkLeadsToAFile) {
    const fs::path docs = fs::path(SVT_SOURCE_DIR) / "docs/user";
    if (!fs::exists(docs)) GTEST_SKIP() << "there is no docs/user";
    for (const auto& entry : fs::directory_iterator(docs)) {
        if (entry.path().extension() != ".md") continue;
        const std::string text = readText(entry.path());
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
            std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
            if (target.rfind("http", 0) == 0) continue;
            target = target.substr(0, target.find('#'));
            if (target.empty()) continue;
            EXPECT_TRUE(fs::exists(entry.path().parent_path() / target)) << entry.path() << ": " << target;
        }
    }
}

}  // namespace
}  // namespace svt::test
