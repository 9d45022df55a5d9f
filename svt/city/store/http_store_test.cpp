// What a server of a city may answer, and what is made of it: good ranges, whole files, lies.
#include <svt/city/store/store.hpp>
#include <svt/http/http_server_test.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace svt::city {
namespace {

using http::kMostAttempts, http::retrySeconds, http::RetryClock;
using test::brokenOff;

// A server of one text.
class TinyServer : public test::TinyServer {
public:
    explicit TinyServer(Answer answer) : test::TinyServer(std::move(answer)) {}
    std::string address() const { return test::TinyServer::address("town/"); }
};

std::string textOf(std::size_t size) {
    std::string text;
    for (std::size_t n = 0; n < size; ++n) text += static_cast<char>('a' + n % 23);
    return text;
}

std::string answerOf(int status, const std::string& body, const std::string& headers = {}) {
    return test::httpAnswer(status, body, headers);
}

std::string rangeOf(const std::string& text, std::size_t first, std::size_t last) {
    return test::httpRange(text, first, last);
}

// What reading bytes [100, 200) says.
std::string faultOf(TinyServer::Answer answer) {
    const TinyServer server(std::move(answer));
    const auto bytes = openHttpStore(server.address())->read("index.bin", 100, 100);
    return bytes ? "" : bytes.error().toString();
}

TEST(HttpStore, ReadsRanges) {
    const std::string text = textOf(1000);
    const TinyServer server([&](std::size_t first, std::size_t last) { return rangeOf(text, first, last); });
    const auto traffic = std::make_shared<Traffic>();
    const auto store = openHttpStore(server.address(), traffic);
    EXPECT_EQ(store->place("index.bin"), server.address() + "index.bin");
    for (const auto& [offset, size] : {std::pair<std::size_t, std::size_t>{0, 1}, {100, 100}, {990, 10}, {999, 1}}) {
        const auto bytes = store->read("index.bin", offset, size);
        ASSERT_TRUE(bytes) << bytes.error().toString();
        EXPECT_EQ(*bytes, text.substr(offset, size));
    }
    EXPECT_EQ(*store->read("index.bin", 950, 500), text.substr(950)) << "it ends there";
    EXPECT_EQ(*store->read("index.bin", 5000, 10), "") << "behind its end";
    EXPECT_EQ(*store->size("index.bin"), 1000u);
    EXPECT_EQ(traffic->requests, 6u) << "the size is known by then";
    EXPECT_EQ(traffic->bytes, 1u + 100 + 10 + 1 + 50);
}

TEST(HttpStore, TakesAWholeFileThatIsNoLonger) {
    const std::string text = textOf(50);
    const TinyServer server([&](std::size_t, std::size_t) { return answerOf(200, text); });
    const auto bytes = openHttpStore(server.address())->read("city.json", 0, 100);
    ASSERT_TRUE(bytes) << bytes.error().toString();
    EXPECT_EQ(*bytes, text);
}

TEST(HttpStore, NamesServersWithoutRanges) {
    const std::string text = textOf(1000);
    const std::string fault = faultOf([&](std::size_t, std::size_t) { return answerOf(200, text); });
    EXPECT_NE(fault.find("sends whole files where a range is asked for"), std::string::npos) << fault;
}

TEST(HttpStore, NamesServersThatLie) {
    const std::string text = textOf(1000);
    const auto lie = [&](const char* contentRange, std::size_t size) {
        return faultOf([&, contentRange, size](std::size_t, std::size_t) {
            return answerOf(206, text.substr(0, size), fmt::format("Content-Range: {}\r\n", contentRange));
        });
    };
    for (const std::string& fault :
         {lie("bytes 0-99/1000", 100), lie("bytes 100-199/1000", 90), lie("bytes 100-149/1000", 50), lie("", 100),
          lie("bytes 100-199", 100), lie("bytes 100-199/*", 100), lie("bytes 100-199/150", 100),
          lie("bytes 199-100/1000", 100), lie("bytes 100-99999999999999999999999/1000", 100)})
        EXPECT_NE(fault.find("it does not support ranges"), std::string::npos) << fault;
    // More than was asked for is not read to its end.
    const std::string fault = faultOf([&](std::size_t, std::size_t) {
        return answerOf(206, textOf(1 << 20), "Content-Range: bytes 100-199/1048676\r\n");
    });
    EXPECT_NE(fault.find("E101"), std::string::npos) << fault;
}

TEST(HttpStore, NoticesAFileThatChanges) {
    std::size_t size = 1000;
    const TinyServer server([&](std::size_t first, std::size_t last) { return rangeOf(textOf(size), first, last); });
    const auto store = openHttpStore(server.address());
    ASSERT_TRUE(store->read("packs.bin", 0, 10));
    size = 1001;
    const auto bytes = store->read("packs.bin", 0, 10);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code(), Code::BadCity);
}

// A clock that stands still and notes how long it was to wait.
struct TestClock {
    std::vector<double> waits;
    RetryClock clock() {
        return {[this](double seconds) { waits.push_back(seconds); }, [] { return std::int64_t{784111777}; }};
    }
};

TEST(HttpStore, TriesAgainLaterEachTimeAndGivesUp) {
    for (const int status : {429, 500, 503}) {
        int failures = 2;
        const std::string text = textOf(1000);
        const TinyServer server([&](std::size_t first, std::size_t last) {
            return failures-- > 0 ? answerOf(status, "") : rangeOf(text, first, last);
        });
        TestClock time;
        const auto store = openHttpStore(server.address(), {}, time.clock());
        const auto bytes = store->read("index.bin", 3, 4);
        ASSERT_TRUE(bytes) << bytes.error().toString();
        EXPECT_EQ(*bytes, text.substr(3, 4));
        EXPECT_EQ(server.requests(), 3);
        EXPECT_EQ(time.waits, (std::vector<double>{0.25, 0.5}));
        time.waits.clear();
        failures = 100;
        EXPECT_FALSE(store->read("index.bin", 3, 4));
        EXPECT_EQ(server.requests(), 3 + kMostAttempts);
        EXPECT_EQ(time.waits, (std::vector<double>{0.25, 0.5, 1}));
    }
}

TEST(HttpStore, ABodyThatBreaksOffIsAskedForAgain) {
    const std::string text = textOf(1000);
    const auto chunked = [&](std::size_t first, std::size_t last) {
        return fmt::format(
            "HTTP/1.1 206 X\r\nTransfer-Encoding: chunked\r\nContent-Range: bytes {}-{}/{}\r\n\r\n20\r\n{}\r\n", first,
            last, text.size(), text.substr(first, 32));
    };
    for (const bool isChunked : {false, true}) {
        int failures = 2;
        const TinyServer server([&](std::size_t first, std::size_t last) {
            if (failures-- <= 0) return rangeOf(text, first, last);
            return isChunked ? chunked(first, last) : brokenOff(rangeOf(text, first, last), 40);
        });
        TestClock time;
        const auto store = openHttpStore(server.address(), {}, time.clock());
        const auto bytes = store->read("index.bin", 100, 100);
        ASSERT_TRUE(bytes) << bytes.error().toString();
        EXPECT_EQ(*bytes, text.substr(100, 100)) << "nothing of the answers before";
        EXPECT_EQ(server.requests(), 3);
        EXPECT_EQ(time.waits, (std::vector<double>{0.25, 0.5}));
        failures = 100;
        const auto never = store->read("index.bin", 100, 100);
        ASSERT_FALSE(never);
        EXPECT_EQ(server.requests(), 3 + kMostAttempts);
        EXPECT_EQ(never.error().where().file, server.address() + "index.bin");
        EXPECT_NE(never.error().message().find("breaks off after"), std::string::npos) << never.error().message();
    }
}

TEST(HttpStore, AWholeFileThatBreaksOffIsAskedForAgain) {
    const std::string text = textOf(50);
    int failures = 1;
    const TinyServer server([&](std::size_t, std::size_t) {
        return failures-- > 0 ? brokenOff(answerOf(200, text), 20) : answerOf(200, text);
    });
    TestClock time;
    const auto bytes = openHttpStore(server.address(), {}, time.clock())->read("city.json", 0, 100);
    ASSERT_TRUE(bytes) << bytes.error().toString();
    EXPECT_EQ(*bytes, text);
    EXPECT_EQ(server.requests(), 2);
}

TEST(HttpStore, RefusalsAreNotTriedAgain) {
    const TinyServer closed([&](std::size_t, std::size_t) { return answerOf(403, "", "Retry-After: 1\r\n"); });
    TestClock time;
    const auto refused = openHttpStore(closed.address(), {}, time.clock())->read("index.bin", 0, 4);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find("status 403"), std::string::npos) << refused.error().message();
    EXPECT_EQ(closed.requests(), 1);
    EXPECT_TRUE(time.waits.empty());
}

TEST(HttpStore, WaitsAsLongAsTheServerAsks) {
    const std::string text = textOf(100);
    std::vector<std::string> headers{"Retry-After: 7\r\n", "retry-after:  Sun, 06 Nov 1994 08:49:49 GMT \r\n", ""};
    std::size_t asked = 0;
    const TinyServer server([&](std::size_t first, std::size_t last) {
        return asked < headers.size() ? answerOf(503, "", headers[asked++]) : rangeOf(text, first, last);
    });
    TestClock time;
    ASSERT_TRUE(openHttpStore(server.address(), {}, time.clock())->read("index.bin", 3, 4));
    EXPECT_EQ(time.waits, (std::vector<double>{7, 12, 1}));
}

TEST(HttpStore, DoesNotWaitForEver) {
    const TinyServer server([](std::size_t, std::size_t) { return answerOf(503, "", "Retry-After: 3600\r\n"); });
    TestClock time;
    const auto bytes = openHttpStore(server.address(), {}, time.clock())->read("index.bin", 3, 4);
    ASSERT_FALSE(bytes);
    EXPECT_NE(bytes.error().message().find("asks to wait 3600 s"), std::string::npos) << bytes.error().message();
    EXPECT_EQ(server.requests(), 1);
    EXPECT_TRUE(time.waits.empty());
}

TEST(HttpStore, ReadsWhatRetryAfterSays) {
    constexpr std::int64_t kNow = 784111777;  // Sun, 06 Nov 1994 08:49:37 GMT
    EXPECT_EQ(retrySeconds(1, "", kNow), 0.25);
    EXPECT_EQ(retrySeconds(5, "", kNow), 4);
    EXPECT_EQ(retrySeconds(1, "120", kNow), 120);
    EXPECT_EQ(retrySeconds(1, "0", kNow), 0.25);
    EXPECT_EQ(retrySeconds(3, "Sun, 06 Nov 1994 08:49:36 GMT", kNow), 1) << "in the past";
    EXPECT_EQ(retrySeconds(1, "Mon, 07 Nov 1994 08:49:37 GMT", kNow), 86400);
    for (const char* bad : {"-5", "1.5", "soon", "5 s", "99999999999999999999", "Sun, 06 Now 1994 08:49:50 GMT",
                            "Sun, 36 Nov 1994 08:49:50 GMT", "Sun, 06 Nov 1994 08:49:50 GMT+1"})
        EXPECT_EQ(retrySeconds(1, bad, kNow), 0.25) << bad;
}

TEST(HttpStore, SaysThatNobodyAnswers) {
    TestClock time;
    const auto bytes = openHttpStore("http://127.0.0.1:1/town", {}, time.clock())->read("city.json", 0, 10);
    ASSERT_FALSE(bytes);
    EXPECT_NE(bytes.error().message().find("does not answer"), std::string::npos) << bytes.error().message();
    EXPECT_EQ(time.waits, (std::vector<double>{0.25, 0.5, 1}));
}

}  // namespace
}  // namespace svt::city
