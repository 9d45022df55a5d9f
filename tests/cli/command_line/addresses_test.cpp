// Models and volumes at addresses: the same results as from files, and servers that lie, never end or redirect in a circle.
#include <tests/cli/command_line/shell_line.hpp>
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <svt/http/http_server_test.hpp>

#include <mutex>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

class Addresses : public ::testing::Test {
protected:
    Addresses() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
    }

    // Answers with ranges of the files in the folder of the test.
    TinyServer::Handler files() {
        return [this](const TinyServer::Request& request, const TinyServer::Send& send) {
            const fs::path file = folder / request.path.substr(1, request.path.find('?') - 1);
            std::error_code ignored;
            const bool isFile = fs::is_regular_file(file, ignored);
            hasWhole_ = hasWhole_ || !request.hasRange;
            send(isFile ? httpRange(readText(file), request.first, request.last)
                        : httpAnswer(404, "<html>none</html>"));
        };
    }

    // The line ends with `exitCode` and a message on `address`; nothing is left.
    void expectRefused(const std::string& line, const std::string& address, int exitCode,
                       const std::string& text) const {
        const LineResult result = runLine(folder.path(), line);
        EXPECT_EQ(result.exitCode, exitCode) << line << ": " << result.toString();
        EXPECT_NE(result.err.find(address), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(text), std::string::npos) << "expected " << text << "\n" << result.err;
        EXPECT_EQ(result.err.find("/tmp/svt-"), std::string::npos) << "a temporary name: " << result.err;
        EXPECT_TRUE(isTmpEmpty(folder.path())) << line;
    }

    TemporaryFolder folder;
    std::atomic<bool> hasWhole_{false};
};

TEST_F(Addresses, AreInputsOfEveryCommand) {
    const TinyServer server(files());
    for (const std::string line :
         {"svt info IN", "svt info IN --json", "svt query IN all", "svt section IN --plane z=1 --json",
          "svt render IN -o o.png --size 64x36; cat o.png", "svt thumbnail IN -o o.png; cat o.png",
          "svt shell IN -o o.glb; cat o.glb", "svt convert IN o.nrrd; cat o.nrrd", "svt sheets IN -o o.pdf; cat o.pdf",
          "svt publish IN -o site --viewer page > /dev/null; cat site/models/two.svt",
          "svt render two.svt --with IN -o o.png --size 64x36; cat o.png",
          "svt build two.gml --grid-of IN -o o.svt > /dev/null; cat o.svt"}) {
        fs::create_directories(folder / "page");
        writeText(folder / "page/index.html", "<!doctype html><head></head>");
        const auto with = [&](const std::string& input) {
            std::string text = line;
            return runLineWell(folder.path(), text.replace(text.find("IN"), 2, input));
        };
        EXPECT_TRUE(with(server.address("two.svt")) == with("two.svt")) << line;
        EXPECT_TRUE(isTmpEmpty(folder.path())) << line;
    }
    EXPECT_FALSE(hasWhole_) << "a volume was not requested in ranges";
    for (const std::string line :
         {"svt info IN --spacing 0.5 --json", "svt build IN -o o.svt --spacing 0.5 -q; cat o.svt",
          "svt IN --spacing 0.5", "svt check IN --json"}) {
        const auto with = [&](const std::string& input) {
            std::string text = line;
            const LineResult result = runLine(folder.path(), text.replace(text.find("IN"), 2, input));
            EXPECT_TRUE(result.exitCode == 0 || result.exitCode == kInvalid) << result.toString();
            return result.out;
        };
        EXPECT_TRUE(with(server.address("two.gml")) == with("two.gml")) << line;
        EXPECT_TRUE(with(server.address("two.gml?key=1#part")) == with("two.gml")) << line;
    }
    // Options beside the model of an address are those of nobody.
    writeText(folder / "svt.json", "nonsense");
    EXPECT_EQ(runLine(folder.path(),
                      "unset SVT_NO_CONFIG; export XDG_CONFIG_HOME=/nowhere; svt info " + server.address("two.svt"))
                  .exitCode,
              kDone);
}

TEST_F(Addresses, OfModelsNeedNoEndingAndNoRanges) {
    fs::copy_file(folder / "two.gml", folder / "download");
    const TinyServer server(files());
    const std::string expected = runLineWell(folder.path(), "svt query two.gml all --spacing 0.5");
    EXPECT_EQ(runLineWell(folder.path(), "svt query " + server.address("download") + " all --spacing 0.5"), expected);
    const TinyServer whole([&](std::size_t, std::size_t) { return httpAnswer(200, twoBoxes()); });
    EXPECT_EQ(runLineWell(folder.path(), "svt query " + whole.address("two.gml") + " all --spacing 0.5"), expected);
}

TEST_F(Addresses, OfCitiesAreReadInPlace) {
    runLineWell(folder.path(), "svt city plan two.gml -o town --spacing 1 -q && svt city run town -q");
    const TinyServer server(files());
    for (const std::string line :
         {"svt info IN", "svt IN --json", "svt query IN all", "svt city info IN", "svt check IN"})
        for (const std::string& address : {server.address("town"), server.address("town/")}) {
            const auto with = [&](const std::string& input) {
                std::string text = line;
                return runLineWell(folder.path(), text.replace(text.find("IN"), 2, input));
            };
            EXPECT_EQ(with(address), with("town")) << line;
        }
    EXPECT_FALSE(hasWhole_);
}

TEST_F(Addresses, AreCheckedBeforeTheyAreRead) {
    const TinyServer login([&](std::size_t, std::size_t) {
        return httpAnswer(200, "<!DOCTYPE html><html><head><title>Login</title></head></html>");
    });
    for (const std::string name : {"two.svt", "two.gml", "two.ifc"})
        expectRefused(
            "svt info " + login.address(name), login.address(name), kInput,
            "E103 UnknownFormat: " + login.address(name) + ": the server sends an HTML page instead of a model");
    expectRefused("svt render two.svt -o o.png --with " + login.address("a.svt"), login.address("a.svt"), kInput,
                  "E103");
    const TinyServer picture([&](std::size_t first, std::size_t last) {
        return httpRange("\x89PNG\r\n\x1a\n" + std::string(500'000, 'x'), first, last);
    });
    expectRefused("svt info " + picture.address("a.svt"), picture.address("a.svt"), kInput, "a PNG picture");
    EXPECT_EQ(picture.requests(), 1) << "the rest was requested";
    const TinyServer nonsense([&](std::size_t first, std::size_t last) {
        return httpRange("PK\3\4 nonsense" + std::string(500'000, 'x'), first, last);
    });
    expectRefused("svt info " + nonsense.address("a.svt"), nonsense.address("a.svt"), kInput, "svt: error E");
    // A volume that is cut short on the server.
    const std::string volume = readText(folder / "two.svt");
    const TinyServer cut([&](std::size_t first, std::size_t last) {
        return httpRange(volume.substr(0, volume.size() / 2), first, last);
    });
    expectRefused("svt info " + cut.address("a.svt"), cut.address("a.svt"), kInput,
                  "E401 BadVolume: " + cut.address("a.svt"));
}

TEST_F(Addresses, AreLimited) {
    const TinyServer large([&](std::size_t first, std::size_t last) {
        const std::string piece(std::min<std::size_t>(last, first + 100'000'000) - first + 1, ' ');
        return httpAnswer(
            206, piece,
            "Content-Range: bytes " + std::to_string(first) + "-" + std::to_string(last) + "/5000000000\r\n");
    });
    expectRefused("svt info " + large.address("a.gml"), large.address("a.gml"), kLimit,
                  "E104 InputTooBig: " + large.address("a.gml") +
                      ": the file has more than 2.0 GB, the limit; a higher "
                      "--max-input permits more");
    EXPECT_EQ(large.requests(), 1);
    const TinyServer endless([&](const TinyServer::Request&, const TinyServer::Send& send) {
        if (!send("HTTP/1.1 200 X\r\nConnection: close\r\n\r\n<?xml version='1.0'?>")) return;
        while (send(std::string(100'000, ' '))) {
        }
    });
    expectRefused("svt info --max-input 2 " + endless.address("a.gml"), endless.address("a.gml"), kLimit, "E104");
}

TEST_F(Addresses, OfBadServersAreErrors) {
    const auto expect = [&](const TinyServer& server, const std::string& text) {
        for (const std::string name : {"a.svt", "a.gml", "town"})
            expectRefused("svt info " + server.address(name), server.address(name), kInput, text);
    };
    expect(TinyServer([](std::size_t, std::size_t) { return httpAnswer(302, "", "Location: /again\r\n"); }),
           "redirects");
    expect(TinyServer([](std::size_t, std::size_t) { return httpAnswer(302, "", "Location: file:///etc/passwd\r\n"); }),
           "E101");
    expect(TinyServer([](std::size_t, std::size_t) { return std::string("no HTTP\r\n\r\n"); }), "E101");
    expect(TinyServer([](std::size_t, std::size_t) { return httpAnswer(404, ""); }), "no such file (status 404)");
    expect(TinyServer([](std::size_t, std::size_t) { return httpAnswer(403, ""); }), "status 403");
    expectRefused("svt info http://127.0.0.1:1/a.svt", "http://127.0.0.1:1/a.svt", kInput, "does not answer");
    expectRefused("svt info 'http://127.0.0.1:1/a b.svt'", "http://127.0.0.1:1/a b.svt", kInput, "E101");
    expectRefused("svt info 'http://'", "http://", kInput, "E101");
}

TEST_F(Addresses, AreRefusedWhereFilesAreReadAgain) {
    writeText(folder / "o.txt", "");
    expectRefused("svt city plan http://127.0.0.1:1/a.gml -o town", "http://127.0.0.1:1/a.gml", kUsage,
                  "later commands read it again");
    expectRefused("svt render two.gml -o o.png --style http://127.0.0.1:1/a.json", "http://127.0.0.1:1/a.json", kUsage,
                  "a style names files beside it");
    EXPECT_FALSE(fs::exists(folder / "town"));
}

TEST_F(Addresses, LeaveNothingAfterASignal) {
    std::atomic<bool> isOver{false};
    const TinyServer stalling([&](const TinyServer::Request&, const TinyServer::Send& send) {
        send("HTTP/1.1 200 X\r\nContent-Length: 1000000\r\n\r\n<?xml");
        while (!isOver && send("")) ::usleep(5000);
    });
    fs::create_directory(folder / "tmp");
    for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
        RunningSvt svt(folder.path(), {"info", stalling.address("a.gml")});
        while (!svt.isOver() && fs::is_empty(folder / "tmp")) ::poll(nullptr, 0, 1);
        svt.send(signal);
        const int status = svt.status();
        if (signal == SIGINT)
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kCancelled) << "status " << status;
        else
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << "status " << status;
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "signal " << signal;
    }
    isOver = true;
}

// ---- https ----------------------------------------------------------------------------------------------------------

// A server of Python with a certificate of its own.
TEST_F(Addresses, OfHttpsNeedACertificateThatIsKnown) {
    if (!hasProgram("openssl version") || !hasProgram("python3 --version"))
        GTEST_SKIP() << "there is no openssl or no python3";
    const std::string server = "rm -f port\n" + pythonOf("https_server.py") +
                               " 2> /dev/null & server=$!\ntrap 'kill $server' EXIT\n"
                               "until [ -f port ]; do kill -0 $server || exit 77; sleep 0.02; done\n";
    const LineResult unknown = runLine(folder.path(), server + "svt info https://localhost:$(cat port)/two.svt");
    if (unknown.exitCode == 77) GTEST_SKIP() << "the server does not start: " << unknown.err;
    EXPECT_EQ(unknown.exitCode, kInput) << unknown.toString();
    EXPECT_NE(unknown.err.find("certificate"), std::string::npos) << unknown.err;
    // The certificate becomes known to this process and its children.
    const std::string bundle = "/etc/ssl/certs/ca-certificates.crt";
    if (!fs::exists(bundle)) GTEST_SKIP() << "there is no " << bundle;
    const LineResult known =
        runLine(folder.path(), server + "unshare -m bash -c \"mount --bind cert.pem " + bundle + " || exit 77\n'" +
                                   commandPath() + "' info https://localhost:$(cat port)/two.svt\" || exit $?");
    if (known.exitCode == 77 || known.err.find("unshare") != std::string::npos)
        GTEST_SKIP() << "this user may not mount: " << known.err;
    EXPECT_EQ(known.exitCode, kDone) << known.toString();
    EXPECT_EQ(known.out, runLineWell(folder.path(), "svt info two.svt"));
}

}  // namespace
}  // namespace svt::test
