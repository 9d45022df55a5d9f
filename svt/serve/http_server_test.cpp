#include <svt/serve/http_client_test.hpp>

#include <atomic>
#include <csignal>
#include <future>

namespace svt::serve {
namespace {

using test::TemporaryFolder;

Site smallSite() {
    Site site;
    site.add("/index.html", Bytes::of("<!doctype html>"));
    site.add("/data.svt", Bytes::of(std::string(3000000, 'd')));
    return site;
}

Route echo() {
    Route route;
    route.path = "/api/echo";
    route.handle = [](const Request& request, const Progress&) {
        Reply reply;
        reply.type = "text/plain";
        reply.body = Bytes::of(std::string(request.parameter("name")) + ":" + request.body);
        return reply;
    };
    return route;
}

TEST(HttpServer, AnswersWithTheHeadersOfSafety) {
    const RunningServer server(smallSite());
    const auto answer = server.ask("GET /");
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.body, "<!doctype html>");
    EXPECT_EQ(answer.header("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(answer.header("Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(answer.header("Cross-Origin-Embedder-Policy"), "require-corp");
    EXPECT_EQ(answer.header("Cross-Origin-Resource-Policy"), "same-origin");
    EXPECT_EQ(answer.header("X-Content-Type-Options"), "nosniff");
    const std::string policy = answer.header("Content-Security-Policy");
    EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
    EXPECT_NE(policy.find("script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'"), std::string::npos);
    EXPECT_EQ(policy.find("http"), std::string::npos);
    // Rejections have the header as well.
    EXPECT_EQ(server.ask("GET /missing").header("X-Content-Type-Options"), "nosniff");
}

TEST(HttpServer, LetsThePageFetchFromAllowedSites) {
    Site site = smallSite();
    site.allowOrigin(originOf("https://tile.example.org/{z}/{x}/{y}.png"));
    const RunningServer server(std::move(site));
    const std::string policy = server.ask("GET /").header("Content-Security-Policy");
    EXPECT_NE(policy.find("img-src 'self' data: blob: https://tile.example.org;"), std::string::npos) << policy;
    EXPECT_NE(policy.find("connect-src 'self' https://tile.example.org;"), std::string::npos) << policy;
    for (const char* address : {"", "tile.example.org", "https://", "https://a'b.org", "https://a.org;script-src *"})
        EXPECT_EQ(originOf(address), "") << address;
}

TEST(HttpServer, MethodsAndPaths) {
    const RunningServer server(smallSite(), {echo()});
    EXPECT_EQ(server.ask("GET /missing").status, 404);
    EXPECT_EQ(server.ask("GET /missing").body,
              "{\"code\":\"HTTP404\",\"message\":\"there is nothing at this address\"}\n");
    const auto head = server.ask("HEAD /data.svt");
    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(head.header("Content-Length"), "3000000");
    EXPECT_EQ(head.body, "");
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "BREW"})
        EXPECT_EQ(server.ask(method + std::string(" /")).status, 405) << method;
    EXPECT_EQ(server.ask("GET /api/echo").status, 405);
    EXPECT_EQ(server.ask("GET /api/echo").header("Allow"), "POST");
    EXPECT_EQ(server.ask("POST /", "Content-Length: 5\r\n", "12345").status, 413);
    EXPECT_EQ(server.ask("GET /data.svt").body.size(), 3000000u);
    EXPECT_EQ(server.ask("GET /data.svt", "Range: bytes=2999990-\r\n").body, "dddddddddd");
}

TEST(HttpServer, OneConnectionTakesManyRequests) {
    const RunningServer server(smallSite(), {echo()});
    Client client = server.client();
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"));
        EXPECT_EQ(client.receive().status, 200);
    }
    // Sent at once, including a call with its body; replies come in order.
    std::string all;
    for (int i = 0; i < 50; ++i) {
        const std::string number = std::to_string(i);
        all += "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n\r\n";
        all += "POST /api/echo?name=" + number + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\n\r\nbody";
    }
    ASSERT_TRUE(client.send(all));
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(client.receive().body, "<!doctype html>");
        EXPECT_EQ(client.receive().body, std::to_string(i) + ":body");
    }
    ASSERT_TRUE(client.send("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"));
    EXPECT_EQ(client.receive().header("Connection"), "close");
    EXPECT_TRUE(client.isClosed());
}

TEST(HttpServer, RequestsMayComeByteByByte) {
    const RunningServer server(smallSite(), {echo()});
    Client client = server.client();
    for (const char c :
         std::string("POST /api/echo?name=a HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nxyz")) {
        ASSERT_TRUE(client.send(std::string(1, c)));
        std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    EXPECT_EQ(client.receive().body, "a:xyz");
}

TEST(HttpServer, PagesOfOthersMayNotCall) {
    const RunningServer server(smallSite(), {echo()});
    const auto status = [&](const std::string& headers) {
        return server.ask("POST /api/echo", headers + "Content-Length: 1\r\n", "x").status;
    };
    EXPECT_EQ(status(""), 200);
    EXPECT_EQ(status("Origin: http://localhost\r\nSec-Fetch-Site: same-origin\r\n"), 200);
    EXPECT_EQ(status("Origin: http://evil.example\r\n"), 403);
    EXPECT_EQ(status("Origin: null\r\n"), 403);
    EXPECT_EQ(status("Origin: http://localhost:1\r\n"), 403);
    EXPECT_EQ(status("Sec-Fetch-Site: cross-site\r\n"), 403);
    Client client = server.client();
    client.send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
    EXPECT_EQ(client.receive().status, 421);
}

TEST(HttpServer, BodiesGoToFilesThatAreRemoved) {
    const TemporaryFolder folder;
    Route route;
    route.path = "/api/size";
    route.isBodyInFile = true;
    route.maxBodyBytes = 10000000;
    route.handle = [](const Request& request, const Progress&) {
        Reply reply;
        reply.body = Bytes::of(std::to_string(std::filesystem::file_size(request.bodyFile)));
        EXPECT_TRUE(request.body.empty());
        return reply;
    };
    ServerOptions options;
    options.bodyFolder = folder.path();
    const RunningServer server(smallSite(), {route}, options);
    EXPECT_EQ(server.ask("POST /api/size", "Content-Length: 5000000\r\n", std::string(5000000, 'b')).body, "5000000");
    EXPECT_EQ(server.ask("POST /api/size", "Content-Length: 10000001\r\n").status, 413);
    const auto holds = [&](int count) {  // at last
        for (int i = 0; i < 12'000; ++i) {
            if (folder.count() == count) return true;
            ::usleep(10000);
        }
        return false;
    };
    EXPECT_TRUE(holds(0));
    {
        Client client = server.client();
        client.send("POST /api/size HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5000000\r\n\r\nhalf");
        EXPECT_TRUE(holds(1));
    }  // disconnects in the middle
    EXPECT_TRUE(holds(0));
}

TEST(HttpServer, ClientIsToldToGoOnWithItsBody) {
    const RunningServer server(smallSite(), {echo()});
    Client client = server.client();
    client.send(
        "POST /api/echo?name=a HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
    EXPECT_EQ(client.receive().status, 100);
    client.send("ab");
    EXPECT_EQ(client.receive().body, "a:ab");
    Client large = server.client();
    large.send("POST /api/echo HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 2000000\r\n\r\n");
    EXPECT_EQ(large.receive().status, 413);
}

// A site with a file of that many bytes at /a.svtp.
Site storedSite(const std::filesystem::path& path, std::size_t size) {
    std::string text;
    for (int i = 0; text.size() < size; ++i) text += std::to_string(i) + ' ';
    test::writeText(path, std::string_view(text).substr(0, size));
    Site site = smallSite();
    auto file = PartFile::open(path);
    EXPECT_TRUE(file && site.addStored("/a.svtp", Bytes::of(std::move(*file))));
    return site;
}

TEST(HttpServer, SendsStoredFilesToSlowAndFastClients) {
    const TemporaryFolder folder;
    const RunningServer server(storedSite(folder / "a.svtp", 5'000'000));
    const std::string text = test::readText(folder / "a.svtp");
    Client slow = server.client();
    slow.send("GET /a.svtp HTTP/1.1\r\nHost: localhost\r\n\r\n");
    std::vector<Client> fast;
    for (int i = 0; i < 3; ++i) {
        fast.push_back(server.client());
        fast.back().send("GET /a.svtp HTTP/1.1\r\nHost: localhost\r\nRange: bytes=" + std::to_string(i * 1'000'000) +
                         "-3999999\r\n\r\n");
    }
    for (int i = 0; i < 3; ++i) {
        const auto answer = fast[std::size_t(i)].receive();
        EXPECT_EQ(answer.status, 206);
        EXPECT_TRUE(answer.body == text.substr(std::size_t(i) * 1'000'000, 4'000'000 - std::size_t(i) * 1'000'000));
    }
    EXPECT_TRUE(slow.receive().body == text);
    const auto head = server.ask("HEAD /a.svtp");
    EXPECT_EQ(head.header("Content-Length"), "5000000");
    EXPECT_EQ(head.body, "");
}

TEST(HttpServer, AFileThatIsShortenedWithinAReplyEndsThatConnectionAlone) {
    const TemporaryFolder folder;
    const RunningServer server(storedSite(folder / "a.svtp", 40'000'000));  // more than sockets hold
    Client other = server.client();
    Client client = server.client();
    client.send("GET /a.svtp HTTP/1.1\r\nHost: localhost\r\n\r\n");
    ASSERT_TRUE(client.hasBegun()) << "the reply has begun";
    std::filesystem::resize_file(folder / "a.svtp", 100);
    EXPECT_TRUE(client.isClosed());
    EXPECT_EQ(server.ask("GET /a.svtp").status, 500);
    EXPECT_EQ(server.ask("GET /a.svtp", "Range: bytes=0-9\r\n").status, 500);
    other.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(other.receive().status, 200);
}

// A call that runs until it is cancelled.
struct Slow {
    std::atomic<int> begun{0}, stopped{0};
    Route route() {
        Route route;
        route.path = "/api/slow";
        route.queueLength = 2;
        route.handle = [this](const Request&, const Progress& stop) {
            ++begun;
            while (!stop.cancel) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ++stopped;
            return Reply{};
        };
        return route;
    }
    void await(const std::atomic<int>& count, int value) const {
        for (int i = 0; i < 120'000 && count < value; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_EQ(count, value);
    }
};

TEST(HttpServer, CallsWaitInAShortQueueAndEndWithTheirClient) {
    Slow slow;
    RunningServer server(smallSite(), {slow.route()});
    const std::string call = "POST /api/slow HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n";
    std::vector<Client> clients;
    for (int i = 0; i < 3; ++i) {
        clients.push_back(server.client());
        clients.back().send(call);
    }
    slow.await(slow.begun, 1);
    EXPECT_EQ(server.ask("GET /").status, 200);  // other requests are not blocked
    for (int i = 0; i < 10'000 && server.ask("POST /api/slow", "Content-Length: 0\r\n").status != 503; ++i)
        ::usleep(1000);
    EXPECT_EQ(server.ask("POST /api/slow", "Content-Length: 0\r\n").status, 503);
    clients.clear();  // all disconnect: the call in progress is cancelled, the queued ones never start
    slow.await(slow.stopped, 1);
    for (int i = 0; i < 100; ++i) ::usleep(1000);
    EXPECT_EQ(slow.begun, 1);
    Client again = server.client();
    again.send(call);
    slow.await(slow.begun, 2);
    server.stop();
    EXPECT_EQ(slow.stopped, 2);
}

TEST(HttpServer, FailuresOfAHandlerAreReplies) {
    Route route;
    route.path = "/api/throw";
    route.handle = [](const Request& request, const Progress&) -> Reply {
        if (request.body == "memory") throw std::bad_alloc();
        throw std::runtime_error("broken");
    };
    const RunningServer server(smallSite(), {route});
    EXPECT_EQ(server.ask("POST /api/throw", "Content-Length: 6\r\n", "memory").status, 503);
    const auto answer = server.ask("POST /api/throw", "Content-Length: 1\r\n", "x");
    EXPECT_EQ(answer.status, 500);
    EXPECT_EQ(answer.body, "{\"code\":\"E999\",\"message\":\"broken\"}\n");
}

TEST(HttpServer, StopsFromASignalAndInBoundedTime) {
    ServerOptions options;
    options.stopSeconds = 0.5;
    options.headSeconds = options.stallSeconds = 3600;  // who waits for a client waits for an hour
    RunningServer server(smallSite(), {}, options);
    Client idle = server.client(), half = server.client(), deaf = server.client();
    idle.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(idle.receive().status, 200);
    half.send("GET / HT");
    for (int i = 0; i < 20; ++i) deaf.send("GET /data.svt HTTP/1.1\r\nHost: localhost\r\n\r\n");  // never reads
    ::usleep(100000);
    server.stop();  // comes to an end, though one sends no more and one never reads
    EXPECT_TRUE(idle.isClosed());
}

TEST(HttpServer, PortsThatAreTakenAreSaidOrPassedBy) {
    ServerOptions options;
    options.port = 0;
    const auto first = HttpServer::listen(smallSite(), {}, options);
    ASSERT_TRUE(first);
    options.port = first->port();
    const auto second = HttpServer::listen(smallSite(), {}, options);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code(), Code::BadArgument);
    EXPECT_NE(second.error().message().find(std::to_string(options.port)), std::string::npos);
    options.mayTakeOtherPort = true;
    const auto other = HttpServer::listen(smallSite(), {}, options);
    ASSERT_TRUE(other) << other.error().toString();
    EXPECT_GT(other->port(), first->port());
    options.host = "no such host";
    EXPECT_EQ(HttpServer::listen(smallSite(), {}, options).error().code(), Code::BadArgument);
}

}  // namespace
}  // namespace svt::serve
