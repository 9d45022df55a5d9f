// The viewer's page and its data from the real command, with a stand-in for the page.
#include "run_command.hpp"

#include <svt/core/machine.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/serve/http_client_test.hpp>

#include <fcntl.h>
#include <sys/wait.h>

#include <atomic>
#include <csignal>
#include <map>
#include <thread>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

void makePage(const fs::path& folder) {
    fs::create_directories(folder / "page/assets");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    writeText(folder / "page/assets/index-BX3k9a1_.js", "1");
}

// A running `svt <arguments>` that is stopped later.
class Serving {
public:
    Serving(const fs::path& folder, std::vector<std::string> arguments, const std::string& path = {})
        : folder_(folder) {
        arguments.insert(arguments.begin(), "svt");
        std::vector<char*> pointers;
        for (std::string& text : arguments) pointers.push_back(text.data());
        pointers.push_back(nullptr);
        fs::create_directories(folder / "tmp");
        const std::string& command = commandPath();  // found before the fork
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(::open((folder / "out").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), 1);
            ::dup2(::open((folder / "err").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), 2);
            ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
            if (!path.empty()) ::setenv("PATH", path.c_str(), 1);
            ::setenv("DISPLAY", ":99", 1);
            if (::chdir(folder.c_str()) == 0) ::execv(command.c_str(), pointers.data());
            ::_exit(126);
        }
        for (int i = 0; i < 30'000 && port_ == 0; ++i) {
            ::usleep(10000);
            const std::string said = out();
            const std::size_t colon = said.rfind(':');
            if (said.find("/\n") != std::string::npos) port_ = std::atoi(said.c_str() + colon + 1);
        }
        EXPECT_NE(port_, 0) << out() << err();
    }
    ~Serving() {
        if (child_ > 0) stop(SIGKILL);
    }
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

    /// \return the exit code; -1 if it had to be killed
    int stop(int signal) {
        ::kill(child_, signal);
        int status = 0;
        pid_t ended = 0;
        for (int i = 0; i < 30'000 && (ended = ::waitpid(child_, &status, WNOHANG)) == 0; ++i) ::usleep(10000);
        if (ended == 0) {
            ::kill(child_, SIGKILL);
            ::waitpid(child_, &status, 0);
        }
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    [[nodiscard]] serve::Client::Answer ask(const std::string& line, const std::string& body = {}) const {
        serve::Client client(port_);
        client.send(line + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(body.size()) +
                    "\r\n\r\n" + body);
        return client.receive();
    }
    [[nodiscard]] int port() const { return port_; }
    [[nodiscard]] std::string out() const { return readText(folder_ / "out"); }
    [[nodiscard]] std::string err() const { return readText(folder_ / "err"); }

private:
    fs::path folder_;
    pid_t child_ = 0;
    int port_ = 0;
};

struct ServeTest : testing::Test {
    ServeTest() {
        makePage(folder.path());
        prepareHouse(folder.path(), "0.2", {"--vectors", "edges"});
    }
    const TemporaryFolder folder;
};

TEST_F(ServeTest, ModelsAreServedAndBuiltWhereNeeded) {
    Serving serving(folder.path(),
                    {"serve", "house.svt", "house.gml", "--spacing", "0.2", "--viewer", "page", "--port", "0"});
    EXPECT_EQ(serving.ask("GET /").body, "<!doctype html><head></head>");
    const std::string volume = readText(folder / "house.svt");
    const auto list = nlohmann::json::parse(serving.ask("GET /models.json").body);
    ASSERT_EQ(list["models"].size(), 2u);
    EXPECT_EQ(list["models"][0]["name"], "house");
    EXPECT_EQ(list["models"][0]["file"], "models/house.svt");
    EXPECT_EQ(list["models"][0]["bytes"], volume.size());
    EXPECT_EQ(list["models"][0]["title"], "Sample house");
    EXPECT_TRUE(serving.ask("GET /models/house.svt").body == volume);
    EXPECT_TRUE(serving.ask("GET /models/house-2.svt").body == volume);  // built the same way
    EXPECT_EQ(serving.ask("GET /api").body, "{\"picture\":true,\"convert\":false}\n");
    EXPECT_EQ(serving.ask("POST /api/convert", "x").status, 413);
    EXPECT_EQ(serving.stop(SIGINT), 0) << serving.err();
    EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST_F(ServeTest, PicturesAreThoseOfRender) {
    const std::string scene =
        R"({"size":[160,90],"look":"paper","passes":[{"hide":["class=BuildingRoom"],"cut":"y<4","lines":[{}]}]})";
    writeText(folder / "a.scene.json", scene);
    runSvtWell(folder.path(), {"render", "house.svt", "-o", "a.png", "--scene", "a.scene.json"});
    Serving serving(folder.path(), {"serve", "house.svt", "--viewer", "page", "--port", "0"});
    const auto answer = serving.ask("POST /api/picture", "{\"model\":\"house\",\"scene\":" + scene + "}");
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.header("Content-Type"), "image/png");
    EXPECT_TRUE(answer.body == readText(folder / "a.png"));

    EXPECT_TRUE(serving.ask("POST /api/picture", "{\"model\":\"house.svt\",\"scene\":" + scene + "}").body ==
                answer.body);
    EXPECT_TRUE(serving.ask("POST /api/picture", "{\"scene\":" + scene + "}").body == answer.body);

    const auto code = [&](const std::string& body) {
        const auto refused = serving.ask("POST /api/picture", body);
        EXPECT_EQ(refused.status, 422) << body;
        const auto reply = nlohmann::json::parse(refused.body, nullptr, false);
        return reply.is_object() ? reply["code"].get<std::string>() : refused.body;
    };
    EXPECT_EQ(code("{"), "E105");
    EXPECT_EQ(code("[]"), "E105");
    EXPECT_EQ(code(std::string(200000, '[')), "E105");
    EXPECT_EQ(code("{\"scene\":" + std::string(60000, '[') + std::string(60000, ']') + "}"), "E504");
    EXPECT_EQ(code("{\"scene\":{\"sice\":1}}"), "E504");
    EXPECT_EQ(code("{\"scene\":{\"size\":[16384,16384]}}"), "E502");
    EXPECT_EQ(code("{\"model\":\"other\",\"scene\":{}}"), "E904");
    EXPECT_EQ(code("{\"scene\":{\"passes\":[{\"show\":[\"class=Nothing\"]}]}}"), "E902");
    EXPECT_EQ(serving.ask("POST /api/picture", std::string(300000, ' ')).status, 413);
    EXPECT_EQ(serving.stop(SIGTERM), 0) << serving.err();
}

TEST_F(ServeTest, StopsWhileItDraws) {
    Serving serving(folder.path(), {"serve", "house.svt", "--viewer", "page", "--port", "0"});
    serve::Client client(serving.port());
    const std::string body = R"({"scene":{"size":[2000,2000],"samples":4,"ambientOcclusion":1}})";
    client.send("POST /api/picture HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(body.size()) +
                "\r\n\r\n" + body);
    ::usleep(100000);
    EXPECT_EQ(serving.stop(SIGINT), 0);
}

TEST_F(ServeTest, UploadsAreConverted) {
    if (kIsSanitized) GTEST_SKIP() << "a sanitizer needs more address space than a conversion may have";
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "fine.svt", "--vectors", "edges"});
    Serving serving(folder.path(),
                    {"serve", "--viewer", "page", "--port", "0", "--allow-uploads", "--max-upload", "2"});
    EXPECT_EQ(serving.ask("GET /models.json").body, "{\n  \"models\": []\n}\n");
    EXPECT_EQ(serving.ask("GET /api").body, "{\"picture\":true,\"convert\":true,\"maxUploadBytes\":2097152}\n");
    const auto answer = serving.ask("POST /api/convert?name=house.gml", readText(folder / "house.gml"));
    EXPECT_EQ(answer.status, 200);
    EXPECT_TRUE(answer.body == readText(folder / "fine.svt"));
    EXPECT_EQ(serving.ask("POST /api/convert?name=a.gml", "<a").body.substr(0, 14), "{\"code\":\"E103\"");
    EXPECT_EQ(serving.ask("POST /api/convert?name=a.gml", std::string(2097153, ' ')).status, 413);
    EXPECT_EQ(serving.stop(SIGINT), 0);
    EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST_F(ServeTest, ConversionsKeepToTheirLimits) {
    if (kIsSanitized) GTEST_SKIP() << "a sanitizer needs more address space than a conversion may have";
    Serving serving(folder.path(),
                    {"serve", "--viewer", "page", "--port", "0", "--allow-uploads", "--convert-memory", "64"});
    prepare(folder.path(), {"sample", "district", "--columns", "4", "--rows", "4", "-o", "houses.gml"});
    const auto answer = serving.ask("POST /api/convert?name=houses.gml", readText(folder / "houses.gml"));
    EXPECT_EQ(answer.status, 422);
    EXPECT_EQ(answer.body.substr(0, 14), "{\"code\":\"E104\"") << answer.body;
    EXPECT_EQ(serving.ask("GET /").status, 200);
}

TEST_F(ServeTest, ViewOpensABrowser) {
    fs::create_directories(folder / "bin");
    writeText(folder / "bin/xdg-open", "#!/bin/sh\necho \"$1\" > opened\n");
    fs::permissions(folder / "bin/xdg-open", fs::perms::owner_all);
    Serving serving(folder.path(), {"view", "house.svt", "--viewer", "page"},
                    (folder / "bin").string() + ":/usr/bin:/bin");
    for (int i = 0; i < 30'000 && readText(folder / "opened").empty(); ++i) ::usleep(10000);
    EXPECT_EQ(readText(folder / "opened"), serving.out());
    EXPECT_EQ(serving.stop(SIGTERM), 0);
}

TEST_F(ServeTest, PublishedFolderIsWhatIsServed) {
    runSvtWell(folder.path(), {"publish", "house.svt", "-o", "site", "--viewer", "page"});
    const Serving serving(folder.path(), {"serve", "house.svt", "--viewer", "page", "--port", "0"});
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "site")) {
        if (!entry.is_regular_file()) continue;
        const std::string path = entry.path().lexically_relative(folder / "site").generic_string();
        ++files;
        if (path == "preview.png") continue;  // for links to a published page
        if (path == "index.html") {
            EXPECT_NE(readText(entry.path()).find("Content-Security-Policy"), std::string::npos);
            continue;
        }
        EXPECT_TRUE(readText(entry.path()) == serving.ask("GET /" + path).body) << path;
    }
    EXPECT_EQ(files, 5);
}

// The rule of all outputs: a page is replaced by a page, and by nothing else.
TEST_F(ServeTest, PublishedFolderIsReplacedOnlyByAPage) {
    const std::vector<std::string> publish{"publish", "house.svt", "-o", "site", "--viewer", "page"};
    const auto with = [&](const char* option) {
        std::vector<std::string> arguments = publish;
        arguments.emplace_back(option);
        return runSvt(folder.path(), arguments);
    };
    runSvtWell(folder.path(), publish);
    writeText(folder / "site/mine.txt", "mine");
    runSvtWell(folder.path(), publish);
    EXPECT_EQ(readText(folder / "site/mine.txt"), "mine");
    const CommandResult kept = with("--no-clobber");
    EXPECT_EQ(kept.exitCode, kOutput) << kept.toString();
    EXPECT_NE(kept.err.find("E408 WouldDestroy: site: the folder is not empty, and --no-clobber"), std::string::npos)
        << kept.err;
    const CommandResult forced = with("--force");
    EXPECT_EQ(forced.exitCode, kDone) << forced.toString();
    EXPECT_NE(forced.err.find("--force has no effect"), std::string::npos) << forced.err;
    fs::remove_all(folder / "site");
    fs::create_directory(folder / "site");
    writeText(folder / "site/index.html", "a page of mine");
    for (const char* option : {"--quiet", "--force"}) {
        const CommandResult refused = with(option);
        EXPECT_EQ(refused.exitCode, kOutput) << refused.toString();
        EXPECT_NE(refused.err.find("E408 WouldDestroy: site/index.html"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(readText(folder / "site/index.html"), "a page of mine");
}

struct ServedCity : ServeTest {
    ServedCity() {
        runSvtWell(folder.path(), {"sample", "city", "--buildings", "20", "-o", "files"});
        runSvtWell(folder.path(), {"city", "plan", "files", "-o", "city", "--spacing", "0.5", "-q"});
        runSvtWell(folder.path(), {"city", "run", "city", "-q"});
    }
};

TEST_F(ServedCity, FilesThatAreShortenedAreErrorsAndTheServerGoesOn) {
    Serving serving(folder.path(), {"serve", "city", "--viewer", "page", "--port", "0"});
    const std::vector<std::string> names{"packs/00000.svtp", "index.bin", "ids.bin", "words.bin", "packs.bin"};
    for (const std::string& name : names) {
        const auto whole = serving.ask("GET /models/city/" + name);
        EXPECT_EQ(whole.status, 200) << name;
        EXPECT_TRUE(whole.body == readText(folder / "city" / name)) << name;
    }
    for (const std::string& name : names) {
        fs::resize_file(folder / "city" / name, name == "packs.bin" ? 0 : 50);
        const auto answer = serving.ask("GET /models/city/" + name);
        EXPECT_EQ(answer.status, 500) << name;
        EXPECT_NE(answer.body.find("\"HTTP500\""), std::string::npos) << answer.body;
        EXPECT_EQ(serving.ask("GET /").status, 200) << "the server goes on";
    }
    EXPECT_EQ(serving.ask("GET /models/city/city.json").status, 200);
    EXPECT_EQ(serving.ask("POST /api/picture", R"({"scene":{"size":[16,16]}})").status, 422) << "it cannot be drawn";
    EXPECT_EQ(serving.stop(SIGINT), 0) << serving.err();
}

TEST_F(ServedCity, FilesThatAreReplacedAreServedAsTheyWere) {
    Serving serving(folder.path(), {"serve", "city", "--viewer", "page", "--port", "0"});
    const std::string pack = readText(folder / "city/packs/00000.svtp");
    writeText(folder / "new", "new");
    fs::rename(folder / "new", folder / "city/packs/00000.svtp");
    EXPECT_TRUE(serving.ask("GET /models/city/packs/00000.svtp").body == pack);
    EXPECT_EQ(serving.stop(SIGINT), 0) << serving.err();
}

TEST_F(ServedCity, FilesThatChangeWhileTheyAreReadAreErrorsAndNoSignal) {
    const fs::path pack = folder / "city/packs/99999.svtp", index = folder / "city/index.bin";
    writeText(pack, "");
    const std::string whole = readText(index);
    std::atomic<bool> isDone{false}, isIndex{false};
    std::thread writer([&] {
        while (!isDone) {
            // Zeros that take no space.
            for (const std::uintmax_t size : {100'000'000, 60'000'000}) fs::resize_file(pack, size);
            if (!isIndex) continue;
            fs::resize_file(index, 100);
            writeText(index, whole);
        }
    });
    int errors = 0;
    for (int i = 0; i < 6; ++i) {
        isIndex = i >= 3;
        const CommandResult result = runSvt(folder.path(), {"publish", "city", "-o", "site", "--viewer", "page"});
        EXPECT_EQ(result.signal, 0) << result.toString();
        EXPECT_TRUE(result.exitCode == kInput || result.exitCode == kDone) << result.toString();
        EXPECT_TRUE(result.exitCode == kDone || isIndex || result.err.find("99999.svtp") != std::string::npos)
            << result.err;
        errors += result.exitCode == kInput ? 1 : 0;
    }
    isDone = true;
    writer.join();
    EXPECT_GT(errors, 0);
}

// The endings are those of the readers; each is left out of the name by which the page calls a model.
TEST_F(ServeTest, EveryEndingOfAModelIsServed) {
    const auto made = [&](const std::string& ending) {
        const std::map<std::string, std::string> sampled{
            {".xml", ".gml"}, {".citygml", ".gml"}, {".cityjson", ".json"}};
        const auto other = sampled.find(ending);
        const std::string from = "s" + (other == sampled.end() ? ending : other->second), to = "house" + ending;
        if (ending == ".ifczip") return runShell(folder.path(), "python3 -m zipfile -c " + to + " s.ifc").exitCode == 0;
        prepare(folder.path(), {"sample", "house", "-o", from});
        fs::copy_file(folder / from, folder / to, fs::copy_options::overwrite_existing);
        return true;
    };
    if (!hasProgram("python3 --version")) GTEST_SKIP() << "there is no python3 to make a ZIP file";
    std::vector<std::string> arguments{"serve"}, names;
    for (const std::string_view ending : readers::modelEndings()) {
        ASSERT_TRUE(made(std::string(ending))) << ending;
        arguments.push_back("house" + std::string(ending));
        names.push_back(names.empty() ? "house" : "house-" + std::to_string(names.size() + 1));
    }
    ASSERT_EQ(names.size(), 8u);
    for (const char* more : {"--viewer", "page", "--port", "0", "--spacing", "0.5"}) arguments.emplace_back(more);
    Serving serving(folder.path(), arguments);
    const auto list = nlohmann::json::parse(serving.ask("GET /models.json").body);
    ASSERT_EQ(list["models"].size(), names.size());
    for (std::size_t n = 0; n < names.size(); ++n) {
        EXPECT_EQ(list["models"][n]["name"], names[n]) << arguments[n + 1];
        const auto volume = serving.ask("GET /models/" + names[n] + ".svt");
        EXPECT_EQ(volume.status, 200) << arguments[n + 1];
        EXPECT_EQ(list["models"][n]["bytes"], volume.body.size());
        EXPECT_TRUE(volume.body.starts_with("PK")) << arguments[n + 1];
    }
    EXPECT_EQ(serving.stop(SIGINT), 0) << serving.err();
}

TEST_F(ServeTest, WhatIsMissingIsSaid) {
    const auto result = [&](const std::vector<std::string>& arguments) { return runSvt(folder.path(), arguments); };
    const CommandResult noPage = result({"publish", "house.svt", "-o", "site", "--viewer", "nowhere"});
    EXPECT_EQ(noPage.exitCode, 3);
    EXPECT_NE(noPage.err.find("make viewer"), std::string::npos) << noPage.err;
    EXPECT_FALSE(fs::exists(folder / "site"));
    EXPECT_EQ(result({"serve", "missing.svt", "--viewer", "page"}).exitCode, 3);
    EXPECT_EQ(result({"serve", "--viewer", "page"}).exitCode, 2);
    EXPECT_EQ(result({"serve", "house.svt", "--viewer", "page", "--port", "70000"}).exitCode, 2);
    EXPECT_EQ(result({"serve", "house.svt", "--viewer", "page", "--host", "192.0.2.1"}).exitCode, 2);
    EXPECT_EQ(result({"publish", "page/index.html", "-o", "site", "--viewer", "page"}).exitCode, 3);
}

}  // namespace
}  // namespace svt::test
