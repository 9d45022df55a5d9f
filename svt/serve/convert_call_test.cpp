#include <svt/serve/convert_call.hpp>
#include <svt/serve/http_client_test.hpp>

#include <signal.h>

namespace svt::serve {
namespace {

using test::readText;
using test::TemporaryFolder;
using test::writeText;

// A server whose conversions are done by a shell script: $1 is the model, $3 the volume.
struct Conversions {
    explicit Conversions(const std::string& script, ChildLimits limits = {}) {
        writeText(folder / "convert.sh", script);
        ConvertOptions convert;
        convert.command = {"/bin/sh", (folder / "convert.sh").string()};
        convert.options = {"--spacing", "0.1"};
        convert.maxUploadBytes = 1000000;
        convert.limits = limits;
        ServerOptions options;
        std::filesystem::create_directory(folder / "bodies");
        options.bodyFolder = folder / "bodies";
        server.emplace(Site(), std::vector<Route>{convertRoute(convert)}, options);
    }
    [[nodiscard]] Client::Answer convert(const std::string& name, const std::string& body) const {
        return server->ask("POST /api/convert?name=" + name, fmt(body.size()), body);
    }
    static std::string fmt(std::size_t bytes) { return "Content-Length: " + std::to_string(bytes) + "\r\n"; }

    TemporaryFolder folder;
    std::optional<RunningServer> server;
};

TEST(ConvertCall, ModelBecomesAVolume) {
    const Conversions calls("test \"$2\" = -o || exit 1; { echo \"$1 $4 $5\"; cat \"$1\"; } > \"$3\"");
    const auto answer = calls.convert("my%20house.gml", "<gml/>");
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.header("Content-Type"), "application/vnd.svt+zip");
    EXPECT_EQ(answer.body, "my_house.gml --spacing 0.1\n<gml/>");
    EXPECT_EQ(std::filesystem::is_empty(calls.folder / "bodies"), true);
}

TEST(ConvertCall, NamesAreMadeHarmless) {
    const Conversions calls("echo \"$1\" > \"$3\"");
    EXPECT_EQ(calls.convert("..%2f..%2fetc%2fpasswd", "x").body, "_.._etc_passwd\n");
    EXPECT_EQ(calls.convert("--help", "x").body, "help\n");
    EXPECT_EQ(calls.convert("$(id);%0a.gml", "x").body, "__id___.gml\n");
    EXPECT_EQ(calls.convert("", "x").body, "model\n");
    EXPECT_EQ(calls.convert(std::string(3000, 'a'), "x").body, std::string(100, 'a') + "\n");
}

TEST(ConvertCall, FailuresAreToldWithTheirCode) {
    const auto said = [](const std::string& script) {
        const auto answer = Conversions(script).convert("a.gml", "x");
        EXPECT_EQ(answer.status, 422);
        return answer.body;
    };
    EXPECT_EQ(said("echo 'svt: 3 notes' >&2; echo 'svt: error E102 BadXml: a.gml:1:5: no root' >&2; exit 3"),
              "{\"code\":\"E102\",\"message\":\"a.gml:1:5: no root\"}\n");
    EXPECT_EQ(said("echo 'svt: error: out of memory' >&2; exit 8"),
              "{\"code\":\"E104\",\"message\":\"out of memory\"}\n");
    EXPECT_NE(said("kill -SEGV $$").find("\"E104\",\"message\":\"the conversion was ended by signal 11"),
              std::string::npos);
    EXPECT_NE(said("exit 1").find("\"E104\""), std::string::npos);
    EXPECT_EQ(Conversions("exit 0").convert("a.gml", "x").status, 500);
}

TEST(ConvertCall, LimitsHold) {
    ChildLimits limits;
    limits.seconds = 0.5;
    const auto slow = Conversions("sleep 3600 & sleep 3600", limits).convert("a.gml", "x");
    EXPECT_EQ(slow.status, 422);
    EXPECT_NE(slow.body.find("longer than 0.5 s"), std::string::npos) << slow.body;

    ChildLimits small;
    small.memoryBytes = std::uint64_t{64} << 20;
    const std::string hungry = "a=x; while :; do a=$a$a; done";
    EXPECT_EQ(Conversions(hungry, small).convert("a.gml", "x").status, 422);

    ChildLimits narrow;
    narrow.fileBytes = 1 << 20;
    EXPECT_EQ(Conversions("head -c 2000000 /dev/zero > \"$3\" || exit 5", narrow).convert("a.gml", "x").status, 422);

    const Conversions calls("cat >&2; head -c 10000000 /dev/zero >&2; exit 3");  // no input; endless messages
    EXPECT_EQ(calls.convert("a.gml", "x").status, 422);
    EXPECT_EQ(calls.server->ask("POST /api/convert?name=a", "Content-Length: 1000001\r\n").status, 413);
}

TEST(ConvertCall, StopsWithTheServer) {
    Conversions calls("echo $$ > \"${0%/*}/pid\"; sleep 3600");
    Client client = calls.server->client();
    client.send("POST /api/convert?name=a HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\n\r\nx");
    std::string text;
    for (int i = 0; i < 6000 && text.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        text = readText(calls.folder / "pid");
    }
    const int child = std::atoi(text.c_str());
    ASSERT_GT(child, 0);
    EXPECT_EQ(::kill(child, 0), 0);
    calls.server->stop();  // does not wait for its end
    EXPECT_NE(::kill(child, 0), 0);
}

}  // namespace
}  // namespace svt::serve
