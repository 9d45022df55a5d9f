// Hostile clients and their cost: no file outside the folder is served, memory, threads and time are bounded, and an
// honest client is still answered.
#include <svt/core/machine.hpp>
#include <svt/serve/http_client_test.hpp>

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>

namespace svt::serve {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::writeText;

std::uint64_t residentBytes() {
    std::ifstream in("/proc/self/statm");
    std::uint64_t all = 0, resident = 0;
    in >> all >> resident;
    return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::ptrdiff_t threadCount() {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

// Memory growth caused by `attack`, after a first round has warmed up all buffers.
template <class Attack>
void expectNoGrowth(int rounds, const Attack& attack) {
    constexpr std::int64_t kMaxGrowth = 4 << 20;
    attack();
    const auto before = static_cast<std::int64_t>(residentBytes());
    for (int round = 0; round < rounds; ++round) attack();
    const std::int64_t growth = static_cast<std::int64_t>(residentBytes()) - before;
    testing::Test::RecordProperty("growthBytes", std::to_string(growth));
    // The sanitizer would measure its own memory.
    EXPECT_TRUE(kIsSanitized || growth < kMaxGrowth) << growth << " bytes";
}

// Sends `part` repeatedly; the server must close the connection.
void expectCutOff(Client& client, const std::string& part) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kHangSeconds);
    while (std::chrono::steady_clock::now() < end)
        if (!client.send(part)) return;
    ADD_FAILURE() << "the server still reads";
}

struct HostileRequests : testing::Test {
    HostileRequests() {
        fs::create_directories(folder / "site/assets");
        writeText(folder / "site/index.html", "page");
        writeText(folder / "site/assets/a.js", "script");
        writeText(folder / "site/.htpasswd", "SECRET");
        writeText(folder / "secret.txt", "SECRET");
        fs::create_symlink("../secret.txt", folder / "site/link.txt");
        EXPECT_TRUE(site.addFolder(folder / "site"));
        site.add("/data.svt", Bytes::of(std::string(8 << 20, 'd')));
        // A thousand connections need two descriptors each, since client and server share one process.
        rlimit limit{};
        ::getrlimit(RLIMIT_NOFILE, &limit);
        limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 4096);
        ::setrlimit(RLIMIT_NOFILE, &limit);
    }

    const TemporaryFolder folder;
    Site site;
};

TEST_F(HostileRequests, NoSpellingLeadsOutOfTheFolder) {
    const RunningServer server(site);
    const std::string root = folder.path().string();
    std::vector<std::string> paths{"/link.txt",
                                   "/.htpasswd",
                                   "//secret.txt",
                                   "/assets",
                                   "/assets/",
                                   "/./index.html",
                                   "/assets/../index.html",
                                   "/index.html/",
                                   "/index.html%00.txt",
                                   "/index.html%00",
                                   "/%2e/index.html",
                                   "/C:/secret.txt",
                                   "/\\..\\secret.txt",
                                   "/~root/.profile",
                                   root + "/secret.txt",
                                   "/" + root + "/secret.txt",
                                   "/index.html;/../secret.txt",
                                   "/index.html?/../../secret.txt#",
                                   "/proc/self/environ",
                                   "/etc/passwd"};
    for (const char* up : {"..", "%2e%2e", "%2E%2e", ".%2e", "%252e%252e", "..%00", "%c0%ae%c0%ae",
                           "%e0%80%ae%e0%80%ae", "%uff0e%uff0e", "\xC0\xAE\xC0\xAE", "....", "..;", "..%20", ". ."})
        for (const char* slash : {"/", "%2f", "%2F", "\\", "%5c", "%252f", "%c0%af", "//", "/./"})
            for (const char* goal : {"secret.txt", "etc/passwd"})
                for (const int depth : {1, 2, 12}) {
                    std::string path = "/assets";
                    for (int i = 0; i < depth; ++i) path += slash + std::string(up);
                    paths.push_back(path + slash + goal);
                }
    int leaked = 0, served = 0;
    for (const std::string& path : paths) {
        const auto answer = server.ask("GET " + path);
        leaked += answer.body.find("SECRET") != std::string::npos || answer.body.find("root:") != std::string::npos;
        served += answer.status == 200 && path.rfind("/index.html?", 0) != 0;
        EXPECT_TRUE(answer.status == 404 || answer.status == 400 || answer.status == 200)
            << path << " " << answer.status;
    }
    EXPECT_EQ(leaked, 0);
    EXPECT_EQ(served, 0);
    EXPECT_GT(paths.size(), 700u);
}

TEST_F(HostileRequests, LongAndEndlessHeadsAreCutOff) {
    const RunningServer server(site);
    const auto attack = [&] {
        {
            Client client = server.client();  // one header of 1 MB
            client.send("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(1 << 20, 'x'));
            const int status = client.receive().status;
            EXPECT_TRUE(status == 431 || status == 0) << status;
            EXPECT_TRUE(client.isClosed());
        }
        {
            Client client = server.client();  // endless headers
            client.send("GET / HTTP/1.1\r\nHost: localhost\r\n");
            expectCutOff(client, "X-Header: " + std::string(60000, 'x') + "\r\n");
        }
        {
            Client client = server.client();  // an endless line
            client.send("GET /");
            expectCutOff(client, std::string(1 << 16, 'a'));
        }
        {
            Client client = server.client();  // a complete request line of 9 KiB
            client.send("GET /" + std::string(9 << 10, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
            EXPECT_EQ(client.receive().status, 414);
        }
        {
            Client client = server.client();  // endless invalid lines
            expectCutOff(client, std::string(1 << 16, '\n'));
        }
        EXPECT_EQ(server.ask("GET /").status, 200);
    };
    expectNoGrowth(2, attack);
}

TEST_F(HostileRequests, BodiesOverTheLimitAreNotTaken) {
    Route route;
    route.path = "/api/call";
    route.maxBodyBytes = 1000;
    route.handle = [](const Request&, const Progress&) { return Reply{}; };
    const RunningServer server(site, {route});
    const std::string body(1 << 20, 'b');
    const auto attack = [&] {
        for (const char* length : {"1001", "1048576", "18446744073709551615"}) {
            Client client = server.client();
            client.send(
                fmt::format("POST /api/call HTTP/1.1\r\nHost: localhost\r\nContent-Length: {}\r\n\r\n", length));
            EXPECT_EQ(client.receive().status, 413) << length;
            for (int i = 0; i < 64 && client.send(body); ++i) continue;
            EXPECT_TRUE(client.isClosed());
        }
        // More than Content-Length: the excess is read as the next request, which is invalid.
        Client client = server.client();
        client.send("POST /api/call HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\n" + body);
        EXPECT_EQ(client.receive().status, 200);
        EXPECT_TRUE(client.isClosed());
        EXPECT_EQ(server.ask("POST /api/call", "Transfer-Encoding: chunked\r\n", "fffffffffffffff\r\n").status, 411);
        EXPECT_EQ(server.ask("GET /").status, 200);
    };
    expectNoGrowth(2, attack);
}

TEST_F(HostileRequests, SlowClientsLoseTheirPlaceAndHoldUpNobody) {
    Route route;
    route.path = "/api/call";
    route.handle = [](const Request&, const Progress&) { return Reply{}; };
    std::vector<Client> heads, bodies, readers;
    const auto attack = [&](const RunningServer& server) {
        for (int i = 0; i < 20; ++i) {
            heads.push_back(server.client());
            heads.back().send("GET / HTTP/1.1\r\nHost: local");
            readers.push_back(server.client());
            readers.back().send("GET /data.svt HTTP/1.1\r\nHost: localhost\r\n\r\n");
        }
        for (int i = 0; i < 4; ++i) {
            bodies.push_back(server.client());
            bodies.back().send("POST /api/call HTTP/1.1\r\nHost: localhost\r\nContent-Length: 500\r\n\r\n");
        }
    };
    ServerOptions options;
    options.maxConnections = 64;
    {
        // Who waits for one of them here waits for an hour.
        options.headSeconds = options.stallSeconds = 3600;
        const RunningServer patient(site, {route}, options);
        attack(patient);
        EXPECT_EQ(patient.ask("GET /").status, 200);
        heads.clear();
        bodies.clear();
        readers.clear();
    }
    options.headSeconds = options.stallSeconds = 0.6;
    const RunningServer server(site, {route}, options);
    attack(server);
    for (int i = 0; i < 12; ++i) {  // one byte at a time, for 1.2 s
        for (Client& client : heads) client.send("h");
        EXPECT_EQ(server.ask("GET /").status, 200);
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    for (Client& client : heads) EXPECT_TRUE(client.isClosed());
    for (Client& client : bodies) EXPECT_TRUE(client.isClosed());
    for (Client& client : readers) EXPECT_TRUE(client.isClosed());  // after the data in flight
}

TEST_F(HostileRequests, RangesCannotMultiplyWhatIsSent) {
    const RunningServer server(site);
    std::string many = "Range: bytes=0-";
    for (int i = 0; i < 1000; ++i) many += ",0-";
    const auto answer = server.ask("GET /data.svt", many + "\r\n");
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.body.size(), std::size_t{8} << 20);
    for (const char* range : {"bytes=9223372036854775807-", "bytes=8388608-8388608", "bytes=-0"})
        EXPECT_EQ(server.ask("GET /data.svt", fmt::format("Range: {}\r\n", range)).status, 416) << range;
    EXPECT_EQ(server.ask("GET /data.svt", "Range: bytes=8388607-99999999999\r\n").body, "d");
}

TEST_F(HostileRequests, AThousandConnectionsAtOnce) {
    ServerOptions options;
    options.maxConnections = 128;
    const RunningServer server(site, {}, options);
    const std::ptrdiff_t threads = threadCount();
    const auto attack = [&] {
        std::vector<Client> clients;
        for (int i = 0; i < 1000; ++i) {
            clients.push_back(server.client());
            switch (i % 4) {  // silent, half a head, a request awaiting its reply, one that never reads its reply
                case 1: clients.back().send("GET / HT"); break;
                case 2: clients.back().send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"); break;
                case 3: clients.back().send("GET /data.svt HTTP/1.1\r\nHost: localhost\r\n\r\n"); break;
                default: break;
            }
        }
        EXPECT_EQ(threadCount(), threads);
        // With a thousand connections held open: answered as soon as some are given up.
        int status = 0;
        for (int i = 0; i < 1200 && status != 200; ++i) {
            status = server.ask("GET /").status;
            if (status != 200) std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        EXPECT_EQ(status, 200);
    };
    expectNoGrowth(4, attack);
    EXPECT_EQ(server.ask("GET /").status, 200);
}

// Random bytes, the same in every run.
TEST_F(HostileRequests, NonsenseIsSurvived) {
    const RunningServer server(site);
    std::uint32_t state = 1;
    const auto random = [&] { return state = state * 1664525u + 1013904223u, state >> 16; };
    const std::string good =
        "GET /index.html HTTP/1.1\r\nHost: localhost\r\nRange: bytes=1-2\r\nAccept-Encoding: gzip\r\n\r\n";
    for (int round = 0; round < 2000; ++round) {
        std::string bytes = good;
        for (std::uint32_t i = 0; i < 1 + random() % 8; ++i) {
            const std::size_t at = random() % bytes.size();
            if (random() % 3 == 0)
                bytes.erase(at, 1 + random() % 5);
            else if (random() % 2 == 0)
                bytes[at] = static_cast<char>(random());
            else
                bytes.insert(at, 1 + random() % 5, static_cast<char>(random()));
            if (bytes.empty()) bytes = "x";
        }
        Client client = server.client();
        client.send(bytes);
    }
    EXPECT_EQ(server.ask("GET /").body, "page");
}

}  // namespace
}  // namespace svt::serve
