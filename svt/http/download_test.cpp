// Files from servers: good ones, slow ones, and those that lie or never end.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/http/download.hpp>
#include <svt/http/http_client.hpp>
#include <svt/http/http_server_test.hpp>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace svt::http {
namespace {

using test::brokenOff, test::httpAnswer, test::httpRange, test::readText, test::TemporaryFolder, test::TinyServer;

constexpr std::size_t kFirst = std::size_t{64} << 10;  // of the first range

std::string textOf(std::size_t size) {
    std::string text(size, 'a');
    for (std::size_t n = 0; n < size; ++n) text[n] = static_cast<char>('a' + n % 23);
    return text;
}

// A download into a folder, without waiting between attempts.
struct Trial {
    TemporaryFolder folder;
    DownloadOptions options;
    std::vector<double> waits;

    Trial() {
        options.maxBytes = 100'000'000;
        options.clock = {[this](double seconds) { waits.push_back(seconds); }, [] { return std::int64_t{784111777}; }};
    }
    Result<std::uint64_t> get(const std::string& address) { return downloadFile(address, folder / "file", options); }
    // The error of a download, which leaves nothing.
    Error errorOf(const std::string& address) {
        const auto done = get(address);
        EXPECT_EQ(folder.count(), 0);
        EXPECT_FALSE(done) << "expected an error";
        if (done) return {};
        EXPECT_EQ(done.error().where().file, address);
        return done.error();
    }
};

bool has(const Error& error, std::string_view text) { return error.message().find(text) != std::string::npos; }

TEST(Download, AddressesAreTold) {
    EXPECT_TRUE(isAddress("http://a"));
    EXPECT_TRUE(isAddress("https://a/b.svt"));
    for (const char* path : {"", "-", "a/http://b", "HTTP://a", "ftp://a", "https:/a", "file:///etc/passwd"})
        EXPECT_FALSE(isAddress(path)) << path;
}

TEST(Download, SavesAFileByRanges) {
    for (const std::size_t size : {std::size_t{1}, kFirst - 1, kFirst, kFirst + 1, std::size_t{10'000'000}}) {
        const std::string text = textOf(size);
        const TinyServer server([&](std::size_t first, std::size_t last) { return httpRange(text, first, last); });
        Trial trial;
        const auto done = trial.get(server.address("a.svt"));
        ASSERT_TRUE(done) << done.error().toString();
        EXPECT_EQ(*done, size);
        EXPECT_TRUE(readText(trial.folder / "file") == text) << size;
        EXPECT_EQ(server.requests(), size <= kFirst ? 1 : size <= kFirst + (8 << 20) ? 2 : 3);
    }
}

TEST(Download, SavesWholeFilesOfServersWithoutRanges) {
    for (const std::size_t size : {std::size_t{1}, kFirst, kFirst + 1, std::size_t{1'000'000}}) {
        const std::string text = textOf(size);
        const TinyServer server([&](std::size_t, std::size_t) { return httpAnswer(200, text); });
        Trial trial;
        const auto done = trial.get(server.address("a.gml"));
        ASSERT_TRUE(done) << done.error().toString();
        EXPECT_TRUE(readText(trial.folder / "file") == text) << size;
        EXPECT_EQ(server.requests(), size <= kFirst ? 1 : 2);
    }
}

TEST(Download, ASizeOverTheLimitIsAnErrorBeforeTheRestIsRequested) {
    const std::string text = textOf(200'000);
    const TinyServer server([&](std::size_t first, std::size_t last) { return httpRange(text, first, last); });
    Trial trial;
    trial.options.maxBytes = 199'999;
    trial.options.remedy = "a higher limit permits more";
    const Error error = trial.errorOf(server.address("a.svt"));
    EXPECT_EQ(error.code(), Code::InputTooBig);
    EXPECT_TRUE(has(error, "the limit; a higher limit permits more")) << error.message();
    EXPECT_EQ(server.requests(), 1);
    trial.options.maxBytes = 200'000;
    EXPECT_TRUE(trial.get(server.address("a.svt")));
}

TEST(Download, ABodyWithoutEndEndsAtTheLimit) {
    const TinyServer server([&](const TinyServer::Request&, const TinyServer::Send& send) {
        if (!send("HTTP/1.1 200 X\r\nConnection: close\r\n\r\n")) return;
        while (send(std::string(100'000, ' '))) {
        }
    });
    Trial trial;
    trial.options.maxBytes = 5'000'000;
    EXPECT_EQ(trial.errorOf(server.address("a.gml")).code(), Code::InputTooBig);
    EXPECT_EQ(server.requests(), 2) << "one for a range, one for the whole file";
}

TEST(Download, HeadersWithoutEndAreAnError) {
    const TinyServer server([&](const TinyServer::Request&, const TinyServer::Send& send) {
        send("HTTP/1.1 200 X\r\n");
        while (send("X-More: " + std::string(1000, 'x') + "\r\n")) {
        }
    });
    Trial trial;
    EXPECT_EQ(trial.errorOf(server.address("a.gml")).code(), Code::CannotOpen);
}

TEST(Download, RedirectionsInACircleAreAnErrorAndNotRepeated) {
    const TinyServer server([&](std::size_t, std::size_t) { return httpAnswer(302, "", "Location: /again\r\n"); });
    Trial trial;
    const Error error = trial.errorOf(server.address("a.gml"));
    EXPECT_TRUE(has(error, "redirects")) << error.message();
    EXPECT_EQ(server.requests(), 6);
    EXPECT_TRUE(trial.waits.empty());
}

TEST(Download, RedirectionsAreFollowedOnlyToServers) {
    const std::string text = textOf(100);
    const TinyServer server([&](const TinyServer::Request& request, const TinyServer::Send& send) {
        send(request.path == "/old" ? httpAnswer(301, "", "Location: /new\r\n")
                                    : httpRange(text, request.first, request.last));
    });
    Trial trial;
    ASSERT_TRUE(trial.get(server.address("old")));
    EXPECT_EQ(readText(trial.folder / "file"), text);
    for (const char* target : {"file:///etc/passwd", "ftp://127.0.0.1/a", "gopher://127.0.0.1/"}) {
        const TinyServer elsewhere(
            [&](std::size_t, std::size_t) { return httpAnswer(302, "", "Location: " + std::string(target) + "\r\n"); });
        Trial other;
        EXPECT_EQ(other.errorOf(elsewhere.address("a")).code(), Code::CannotOpen) << target;
    }
}

TEST(Download, GarbageIsAnError) {
    for (const char* answer : {"", "no HTTP at all", "\x16\x03\x01", "HTTP/1.1 abc\r\n\r\n", "HTTP/9.9 200\r\n\r\nx"}) {
        const TinyServer server([&](std::size_t, std::size_t) { return std::string(answer); });
        Trial trial;
        EXPECT_EQ(trial.errorOf(server.address("a.gml")).code(), Code::CannotOpen) << answer;
    }
}

TEST(Download, RefusalsNameTheirStatus) {
    for (const int status : {401, 403, 404, 410, 416}) {
        const TinyServer server([&](std::size_t, std::size_t) { return httpAnswer(status, "<html>no</html>"); });
        Trial trial;
        const Error error = trial.errorOf(server.address("a.gml"));
        EXPECT_EQ(error.code(), Code::CannotOpen);
        EXPECT_TRUE(has(error, status == 416 ? "is empty" : "status " + std::to_string(status))) << error.message();
        EXPECT_EQ(server.requests(), 1);
    }
    const TinyServer empty([&](std::size_t, std::size_t) { return httpAnswer(200, ""); });
    Trial trial;
    EXPECT_TRUE(has(trial.errorOf(empty.address("a.gml")), "is empty"));
}

TEST(Download, RangesThatDoNotFitAreErrors) {
    const std::string text = textOf(200'000);
    const auto errorOf = [&](const std::string& contentRange, std::size_t size) {
        const TinyServer server([&](std::size_t, std::size_t) {
            return httpAnswer(206, text.substr(0, size), "Content-Range: " + contentRange + "\r\n");
        });
        Trial trial;
        return trial.errorOf(server.address("a.svt"));
    };
    for (const Error& error : {errorOf("bytes 0-65535/*", kFirst), errorOf("bytes 1-65536/200000", kFirst),
                               errorOf("bytes 0-65535/200000", kFirst - 1), errorOf("bytes 0-99/200000", 100),
                               errorOf("", kFirst), errorOf("bytes 0-65535/10", kFirst)})
        EXPECT_TRUE(has(error, "asked for bytes from 0 on")) << error.message();
}

TEST(Download, AFileThatChangesMeanwhileIsAnError) {
    const std::string text = textOf(200'000);
    const auto errorOf = [&](const std::function<std::string(const TinyServer::Request&)>& second) {
        const TinyServer server([&](const TinyServer::Request& request, const TinyServer::Send& send) {
            send(request.first == 0 ? httpRange(text, request.first, request.last, "ETag: \"1\"\r\n")
                                    : second(request));
        });
        Trial trial;
        return trial.errorOf(server.address("a.svt"));
    };
    EXPECT_TRUE(has(errorOf([&](const auto& r) { return httpRange(text, r.first, r.last, "ETag: \"2\"\r\n"); }),
                    "changed while it was read"));
    EXPECT_TRUE(has(errorOf([&](const auto& r) { return httpRange(text + "x", r.first, r.last, "ETag: \"1\"\r\n"); }),
                    "changed while it was read"));
    EXPECT_TRUE(has(errorOf([&](const auto&) { return httpAnswer(200, "short"); }), "now sends whole files"));
}

TEST(Download, TheFirstBytesDecideWhetherTheRestIsRequested) {
    const std::string text = textOf(200'000);
    for (const bool hasRanges : {true, false}) {
        const TinyServer server([&](std::size_t first, std::size_t last) {
            return hasRanges ? httpRange(text, first, last) : httpAnswer(200, text);
        });
        Trial trial;
        std::vector<std::string> heads;
        trial.options.check = [&](std::string_view head) -> Result<void> {
            heads.emplace_back(head);
            return Error(Code::UnknownFormat, "not this");
        };
        const Error error = trial.errorOf(server.address("a.svt"));
        EXPECT_EQ(error.code(), Code::UnknownFormat);
        EXPECT_EQ(heads, std::vector<std::string>{text.substr(0, kFirst)});
        EXPECT_LE(server.requests(), hasRanges ? 1 : 2);
    }
    // Also of a file that is shorter.
    const TinyServer server([&](std::size_t first, std::size_t last) { return httpRange("tiny", first, last); });
    Trial trial;
    std::string head;
    trial.options.check = [&](std::string_view bytes) {
        head = bytes;
        return Result<void>();
    };
    EXPECT_TRUE(trial.get(server.address("a")));
    EXPECT_EQ(head, "tiny");
}

TEST(Download, BrokenAnswersAreRequestedAgain) {
    const std::string text = textOf(300'000);
    for (const bool hasRanges : {true, false}) {
        int answers = 0;
        const TinyServer server([&](std::size_t first, std::size_t last) {
            const std::string answer = hasRanges ? httpRange(text, first, last) : httpAnswer(200, text);
            ++answers;
            return answers == 2 || answers == 3 ? brokenOff(answer, 1000) : answer;
        });
        Trial trial;
        const auto done = trial.get(server.address("a.svt"));
        ASSERT_TRUE(done) << done.error().toString();
        EXPECT_TRUE(readText(trial.folder / "file") == text) << "nothing of the broken answers";
        EXPECT_EQ(trial.waits, (std::vector<double>{0.25, 0.5}));
    }
    const TinyServer broken(
        [&](std::size_t first, std::size_t last) { return brokenOff(httpRange(text, first, last), 10); });
    Trial trial;
    EXPECT_TRUE(has(trial.errorOf(broken.address("a.svt")), "breaks off after"));
    EXPECT_EQ(broken.requests(), kMostAttempts);
}

TEST(Download, NobodyAnswers) {
    Trial trial;
    EXPECT_TRUE(has(trial.errorOf("http://127.0.0.1:1/a.svt"), "does not answer"));
    EXPECT_EQ(trial.waits.size(), std::size_t{kMostAttempts - 1});
}

TEST(Download, StopsWhereNothingArrives) {
    std::atomic<bool> isOver{false};
    const TinyServer server([&](const TinyServer::Request&, const TinyServer::Send& send) {
        send("HTTP/1.1 200 X\r\nContent-Length: 1000000\r\n\r\nbegin");
        while (!isOver && send("")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    });
    Progress progress;
    std::thread stop([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        progress.cancel = true;
    });
    Trial trial;
    trial.options.progress = &progress;
    const auto start = std::chrono::steady_clock::now();
    const Error error = trial.errorOf(server.address("a.svt"));
    isOver = true;
    stop.join();
    EXPECT_EQ(error.code(), Code::Cancelled);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace svt::http
