#include <svt/core/machine.hpp>
#include <svt/serve/http_client_test.hpp>
#include <svt/serve/site.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace svt::serve {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::TemporaryFolder;
using test::writeText;

Request get(const std::string& path, Fields headers = {}) { return {"GET", path, {}, std::move(headers), {}, {}}; }

std::string headerOf(const Reply& reply, const std::string& name) {
    for (const auto& [key, value] : reply.headers)
        if (key == name) return value;
    return "";
}

std::string unpacked(std::string_view gzip) {
    std::string out(1 << 20, '\0');
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(gzip.data()));
    stream.avail_in = static_cast<uInt>(gzip.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    inflateEnd(&stream);
    return out;
}

std::string longScript() {
    std::string text;
    for (int i = 0; i < 500; ++i)
        text += "export const value" + std::to_string(i) + " = " + std::to_string(i * i) + ";\n";
    return text;
}

// A page as built by the viewer's build, surrounded by files that must not be served.
void makeViewer(const fs::path& folder) {
    fs::create_directories(folder / "viewer/assets");
    writeText(folder / "viewer/index.html", "<!doctype html><title>page</title>");
    writeText(folder / "viewer/assets/index-BX3k9a1_.js", longScript());
    writeText(folder / "viewer/assets/svt-Qa81bZ-x.wasm", std::string("\0asm\1\0\0\0", 8));
    writeText(folder / "viewer/.hidden", "hidden");
    writeText(folder / "secret.txt", "secret");
}

TEST(Site, FolderBecomesATable) {
    const TemporaryFolder folder;
    makeViewer(folder.path());
    fs::create_directories(folder / "viewer/.git");
    writeText(folder / "viewer/.git/config", "hidden");
    fs::create_symlink("../secret.txt", folder / "viewer/out.txt");
    fs::create_directory_symlink("..", folder / "viewer/up");
    fs::create_symlink("index.html", folder / "viewer/alias.html");
    fs::create_symlink("nowhere", folder / "viewer/dangling.html");
    ASSERT_EQ(::mkfifo((folder / "viewer/pipe.txt").c_str(), 0600), 0);
    Site site;
    ASSERT_TRUE(site.addFolder(folder / "viewer"));
    std::vector<std::string> paths;
    for (const auto& [path, resource] : site.resources()) paths.push_back(path);
    EXPECT_EQ(paths, (std::vector<std::string>{"/alias.html", "/assets/index-BX3k9a1_.js", "/assets/svt-Qa81bZ-x.wasm",
                                               "/index.html"}));
    EXPECT_EQ(site.find("/")->bytes.text(), "<!doctype html><title>page</title>");
    EXPECT_EQ(site.addFolder(folder / "missing").error().code(), Code::CannotOpen);
    EXPECT_EQ(site.addFolder(folder / "secret.txt").error().code(), Code::CannotOpen);
}

TEST(Site, TypesAndCachingFollowTheName) {
    const TemporaryFolder folder;
    makeViewer(folder.path());
    Site site;
    ASSERT_TRUE(site.addFolder(folder / "viewer"));
    site.add("/models/house.svt", Bytes::of("PK"));
    site.add("/api", Bytes::of("{}"));
    const auto typeOf = [&](const std::string& path) { return site.reply(get(path)).type; };
    EXPECT_EQ(typeOf("/"), "text/html; charset=utf-8");
    EXPECT_EQ(typeOf("/assets/index-BX3k9a1_.js"), "text/javascript; charset=utf-8");
    EXPECT_EQ(typeOf("/assets/svt-Qa81bZ-x.wasm"), "application/wasm");
    EXPECT_EQ(typeOf("/models/house.svt"), "application/vnd.svt+zip");
    EXPECT_EQ(typeOf("/api"), "application/json");
    const auto caching = [&](const std::string& path) { return headerOf(site.reply(get(path)), "Cache-Control"); };
    EXPECT_EQ(caching("/assets/index-BX3k9a1_.js"), "public, max-age=31536000, immutable");
    EXPECT_EQ(caching("/assets/svt-Qa81bZ-x.wasm"), "public, max-age=31536000, immutable");
    EXPECT_EQ(caching("/"), "no-cache");
    EXPECT_EQ(caching("/models/house.svt"), "no-cache");
}

// A folder's files stand beside the page; of an address the page may ask that server, and no other.
TEST(Site, CitiesAreListedWithTheirFilesOrTheirAddress) {
    const TemporaryFolder folder;
    makeViewer(folder.path());
    writeText(folder / "viewer/index.html", "<!doctype html><html><head><meta charset=\"utf-8\" /></head></html>");
    const std::vector<SiteModel> models{
        {"town",
         "Town",
         {},
         "/data/town",
         {{"city.json", Bytes::of("{}")}, {"packs/00000.svtp", Bytes::of("0123456789")}}},
        {"far", "Far", {}, "https://example.org:8080/far?x=\"", {}}};
    auto site = viewerSite(folder / "viewer", models);
    ASSERT_TRUE(site) << site.error().toString();
    const std::string list(site->find("/models.json")->bytes.text());
    EXPECT_NE(list.find("\"file\": \"models/town/\""), std::string::npos) << list;
    EXPECT_NE(list.find("\"file\": \"https://example.org:8080/far"), std::string::npos) << list;
    EXPECT_NE(list.find("\"city\": true"), std::string::npos) << list;
    const Reply part = site->reply(get("/models/town/packs/00000.svtp", {{"range", "bytes=2-4"}}));
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body.text(), "234");
    EXPECT_EQ(site->origins(), " https://example.org:8080");
    ASSERT_TRUE(addPageHead(*site, {}));
    EXPECT_NE(site->find("/index.html")->bytes.text().find("connect-src 'self' https://example.org:8080;"),
              std::string_view::npos);
}

// The file, as it is now.
Bytes stored(const fs::path& path) {
    auto file = PartFile::open(path);
    EXPECT_TRUE(file) << path;
    return Bytes::of(std::move(*file));
}

TEST(Site, AStoredFileIsAnsweredAsOneInMemory) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 400'000; ++i) text += std::to_string(i);  // of several pieces
    for (const std::string& content : {std::string(), std::string("0123456789"), text}) {
        writeText(folder / "a.svtp", content);
        Site site;
        ASSERT_TRUE(site.addStored("/a.svtp", stored(folder / "a.svtp")));
        site.add("/b.svtp", Bytes::of(content));
        EXPECT_EQ(site.find("/a.svtp")->tag, site.find("/b.svtp")->tag);
        EXPECT_EQ(site.find("/a.svtp")->type, site.find("/b.svtp")->type);
        for (const char* range : {"", "bytes=2-4", "bytes=0-0", "bytes=5-", "bytes=-3", "bytes=1500000-1500009"}) {
            const Reply disk = site.reply(get("/a.svtp", {{"range", range}})),
                        memory = site.reply(get("/b.svtp", {{"range", range}}));
            EXPECT_EQ(disk.status, memory.status) << range;
            EXPECT_EQ(headerOf(disk, "Content-Range"), headerOf(memory, "Content-Range"));
            std::string buffer;
            const auto body = disk.body.read(0, ~std::size_t{0}, buffer);
            ASSERT_TRUE(body) << range;
            EXPECT_TRUE(memory.status == 416 || *body == memory.body.text()) << range;
        }
        Request head = get("/a.svtp");
        head.method = "HEAD";
        EXPECT_EQ(site.reply(head).skippedBody, content.size());
    }
}

TEST(Site, AStoredFileThatIsReplacedIsServedAsItWas) {
    const TemporaryFolder folder;
    writeText(folder / "a.svtp", "0123456789");
    Site site;
    ASSERT_TRUE(site.addStored("/a.svtp", stored(folder / "a.svtp")));
    ASSERT_TRUE(writeFileAtomically(folder / "a.svtp", "new"));
    const Reply reply = site.reply(get("/a.svtp"));
    EXPECT_EQ(reply.status, 200);
    std::string buffer;
    EXPECT_EQ(*reply.body.read(0, 100, buffer), "0123456789");
}

// Its tag would promise bytes that are there no longer.
TEST(Site, AStoredFileThatIsChangedInPlaceIsNotServed) {
    const TemporaryFolder folder;
    for (const char* now : {"01234", "9876543210", "0123456789more"}) {
        writeText(folder / "a.svtp", "0123456789");
        const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
        fs::last_write_time(folder / "a.svtp", before);
        Site site;
        ASSERT_TRUE(site.addStored("/a.svtp", stored(folder / "a.svtp")));
        site.add("/index.html", Bytes::of("page"));
        ASSERT_EQ(site.reply(get("/a.svtp")).status, 200);
        const std::string tag = site.find("/a.svtp")->tag;
        writeText(folder / "a.svtp", now);
        for (const Fields& headers : {Fields{}, Fields{{"range", "bytes=2-4"}}, Fields{{"if-none-match", tag}}}) {
            const Reply reply = site.reply(get("/a.svtp", headers));
            EXPECT_EQ(reply.status, 500) << now;
            EXPECT_EQ(headerOf(reply, "ETag"), "");
        }
        EXPECT_EQ(site.reply(get("/")).status, 200);
        const auto written = writeSite(site, folder / "site");
        ASSERT_FALSE(written) << now;
        EXPECT_EQ(written.error().code(), Code::CannotOpen);
        EXPECT_EQ(written.error().where().file, (folder / "a.svtp").string());
        EXPECT_FALSE(fs::exists(folder / "site"));
    }
}

TEST(Site, AStoredFileThatIsShortenedBeforeItIsAddedIsAnError) {
    const TemporaryFolder folder;
    for (const std::uintmax_t size : {std::uintmax_t{0}, std::uintmax_t{100}, std::uintmax_t{2'000'000}}) {
        writeText(folder / "a.svtp", std::string(3'000'000, 'a'));
        const Bytes bytes = stored(folder / "a.svtp");
        fs::resize_file(folder / "a.svtp", size);
        Site site;
        const auto added = site.addStored("/a.svtp", bytes);
        ASSERT_FALSE(added);
        EXPECT_EQ(added.error().code(), Code::CannotOpen);
        EXPECT_EQ(site.find("/a.svtp"), nullptr);
        makeViewer(folder.path());
        const std::vector<SiteModel> models{{"town", "Town", {}, "/town", {{"a.svtp", bytes}}}};
        EXPECT_EQ(viewerSite(folder / "viewer", models).error().code(), Code::CannotOpen);
    }
}

TEST(Site, StoredFilesLargerThanMemoryAreAdded) {
    const TemporaryFolder folder;
    writeText(folder / "a.svtp", "pack");
    fs::resize_file(folder / "a.svtp", std::uintmax_t{250} << 20);  // its zeros take no space
    const auto result = inOwnProcess(600, [&](const Say& say) {
        Site site;
        site.add("/index.html", Bytes::of("page"));
        limitMemory(100'000'000, "the test");
        if (!site.addStored("/a.svtp", stored(folder / "a.svtp"))) return;
        const Reply reply = site.reply(get("/a.svtp"));
        std::string buffer;
        if (reply.body.size() == std::uintmax_t{250} << 20 && reply.body.read(1, 3, buffer)) say(buffer);
    });
    EXPECT_EQ(result.fault, "");
    EXPECT_EQ(result.text, "ack");
}

TEST(Site, WhatTheClientHasIsNotSentAgain) {
    Site site;
    site.add("/a.js", Bytes::of(longScript()));
    const Reply first = site.reply(get("/a.js", {{"accept-encoding", "gzip"}}));
    const std::string tag = headerOf(first, "ETag");
    ASSERT_EQ(tag.substr(0, 3), "W/\"");
    for (const std::string& said : {tag, tag.substr(2), "\"x\", " + tag, std::string("*")}) {
        const Reply again = site.reply(get("/a.js", {{"if-none-match", said}}));
        EXPECT_EQ(again.status, 304) << said;
        EXPECT_TRUE(again.body.data.empty());
    }
    EXPECT_EQ(site.reply(get("/a.js", {{"if-none-match", "\"other\""}})).status, 200);
    site.add("/a.js", Bytes::of(longScript() + " "));
    EXPECT_EQ(site.reply(get("/a.js", {{"if-none-match", tag}})).status, 200);
}

TEST(Site, CompressedWhereItHelpsAndIsAccepted) {
    Site site;
    site.add("/a.js", Bytes::of(longScript()));
    site.add("/small.js", Bytes::of("1"));
    site.add("/models/a.svt", Bytes::of(longScript()));
    const auto encoding = [&](const std::string& path, const std::string& accepted) {
        return headerOf(site.reply(get(path, {{"accept-encoding", accepted}})), "Content-Encoding");
    };
    for (const char* accepted : {"gzip", "br, gzip;q=0.5", "deflate,gzip", "*"})
        EXPECT_EQ(encoding("/a.js", accepted), "gzip") << accepted;
    for (const char* accepted : {"", "br", "gzip;q=0", "*;q=0.0", "gzip;q=0, *", "xgzip"})
        EXPECT_EQ(encoding("/a.js", accepted), "") << accepted;
    EXPECT_EQ(encoding("/small.js", "gzip"), "");
    EXPECT_EQ(encoding("/models/a.svt", "gzip"), "");
    const Reply reply = site.reply(get("/a.js", {{"accept-encoding", "gzip"}}));
    EXPECT_LT(reply.body.data.size(), longScript().size() / 2);
    EXPECT_EQ(unpacked(reply.body.text()), longScript());
    EXPECT_EQ(headerOf(reply, "Vary"), "Accept-Encoding");
}

TEST(Site, RangesAreOfThePlainBytes) {
    Site site;
    const std::string text = longScript();
    site.add("/a.js", Bytes::of(text));
    const Reply part = site.reply(get("/a.js", {{"range", "bytes=10-19"}, {"accept-encoding", "gzip"}}));
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body.text(), text.substr(10, 10));
    EXPECT_EQ(headerOf(part, "Content-Range"), "bytes 10-19/" + std::to_string(text.size()));
    EXPECT_EQ(headerOf(part, "Content-Encoding"), "");
    const std::string tag = headerOf(part, "ETag");
    EXPECT_EQ(site.reply(get("/a.js", {{"range", "bytes=1-2"}, {"if-range", tag}})).status, 206);
    EXPECT_EQ(site.reply(get("/a.js", {{"range", "bytes=1-2"}, {"if-range", "\"old\""}})).status, 200);
    const Reply behind = site.reply(get("/a.js", {{"range", "bytes=99999-"}}));
    EXPECT_EQ(behind.status, 416);
    EXPECT_EQ(headerOf(behind, "Content-Range"), "bytes */" + std::to_string(text.size()));
    EXPECT_EQ(site.reply(get("/a.js", {{"range", "bytes=0-1,5-6"}})).body.data.size(), text.size());
}

TEST(Site, ModelsAreListedInTheirOrder) {
    const TemporaryFolder folder;
    makeViewer(folder.path());
    const std::vector<SiteModel> models{{"tower", "T\xC3\xBCrme \"A\"", Bytes::of("1234")},
                                        {"house", "House", Bytes::of("12")}};
    const auto site = viewerSite(folder / "viewer", models);
    ASSERT_TRUE(site) << site.error().toString();
    const auto json = nlohmann::json::parse(site->find("/models.json")->bytes.text());
    EXPECT_EQ(json, nlohmann::json::parse(R"({"models":[
        {"name":"tower","file":"models/tower.svt","bytes":4,"title":"T\u00fcrme \"A\""},
        {"name":"house","file":"models/house.svt","bytes":2,"title":"House"}]})"));
    EXPECT_EQ(site->find("/models/tower.svt")->bytes.text(), "1234");
    EXPECT_EQ(viewerSite(folder.path(), models).error().code(), Code::CannotOpen);
}

TEST(Site, NamesAreToldApart) {
    const std::vector<fs::path> files{"a/house.gml", "b/House.svt", "house.city.json", "Geb\xC3\xA4ude 1.gml.gz",
                                      "..svt",       "x/",          "HOUSE.IFCZIP",    "other.png"};
    const std::vector<std::string_view> extensions{".svt", ".gml", ".json", ".ifczip"};
    EXPECT_EQ(uniqueNames(files, extensions), (std::vector<std::string>{"house", "House-2", "house-3", "Geb_ude_1",
                                                                        "model", "model-2", "HOUSE-4", "other.png"}));
}

TEST(PublishedSite, FolderHoldsWhatIsServed) {
    const TemporaryFolder folder;
    makeViewer(folder.path());
    const std::vector<SiteModel> models{{"house", "House", Bytes::of(std::string(100000, 'v'))}};
    const auto site = viewerSite(folder / "viewer", models);
    ASSERT_TRUE(site);
    const fs::path out = folder / "new/site";
    const auto written = writeSite(*site, out);
    ASSERT_TRUE(written) << written.error().toString();
    std::uint64_t total = 0;
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
        if (!entry.is_regular_file()) continue;
        const std::string path = "/" + entry.path().lexically_relative(out).generic_string();
        ASSERT_NE(site->find(path), nullptr) << path;
        EXPECT_TRUE(readText(entry.path()) == site->find(path)->bytes.text()) << path;
        total += entry.file_size();
        ++files;
    }
    EXPECT_EQ(files, site->resources().size());
    EXPECT_EQ(total, *written);

    // An earlier page is replaced, and only its files are touched.
    writeText(out / "mine.txt", "mine");
    writeText(out / "index.html", "old");
    ASSERT_TRUE(writeSite(*site, out));
    EXPECT_EQ(readText(out / "mine.txt"), "mine");
    EXPECT_EQ(readText(out / "index.html"), site->find("/")->bytes.text());
    EXPECT_EQ(std::count_if(fs::directory_iterator(out), fs::directory_iterator(),
                            [](const auto& entry) { return entry.path().filename().string().front() == '.'; }),
              0);
}

TEST(PublishedSite, FailureLeavesNothing) {
    const TemporaryFolder folder;
    Site site;
    site.add("/index.html", Bytes::of("new"));
    site.add("/models/a.svt", Bytes::of("a"));
    writeText(folder / "file", "");
    EXPECT_EQ(writeSite(site, folder / "file").error().code(), Code::CannotWrite);
    EXPECT_EQ(writeSite(site, folder / "file/site").error().code(), Code::CannotWrite);
    // A file exists where a folder is needed: the old page is kept.
    fs::create_directories(folder / "site");
    writeText(folder / "site/models", "");
    writeText(folder / "site/index.html", "old");
    writeText(folder / "site/models.json", R"({"models": []})");
    EXPECT_EQ(writeSite(site, folder / "site").error().code(), Code::CannotWrite);
    EXPECT_EQ(readText(folder / "site/index.html"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "site"), fs::directory_iterator()), 3);
}

TEST(PublishedSite, FilesOfOthersAreNotReplaced) {
    const TemporaryFolder folder;
    Site site;
    site.add("/index.html", Bytes::of("new"));
    site.add("/assets/a.js", Bytes::of("new"));
    // The page of another program, also with a list that is no list of models.
    for (const char* list : {"", "{}", R"({"models": 1})", "[]"}) {
        const fs::path page = folder / "page";
        fs::remove_all(page);
        fs::create_directories(page);
        writeText(page / "index.html", "mine");
        if (*list != '\0') writeText(page / "models.json", list);
        EXPECT_EQ(checkSiteFolder(page).error().code(), Code::WouldDestroy) << list;
        EXPECT_EQ(writeSite(site, page).error().code(), Code::WouldDestroy) << list;
        EXPECT_EQ(readText(page / "index.html"), "mine");
    }
    // A folder with other files takes the page, unless a file is in the place of one of the page.
    fs::create_directories(folder / "docs/assets");
    writeText(folder / "docs/readme.txt", "mine");
    writeText(folder / "docs/assets/a.js", "mine");
    EXPECT_TRUE(checkSiteFolder(folder / "docs"));
    const auto refused = writeSite(site, folder / "docs");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code(), Code::WouldDestroy);
    EXPECT_EQ(refused.error().where().file, (folder / "docs/assets/a.js").string());
    EXPECT_EQ(readText(folder / "docs/assets/a.js"), "mine");
    EXPECT_FALSE(fs::exists(folder / "docs/index.html"));
    fs::remove(folder / "docs/assets/a.js");
    EXPECT_TRUE(writeSite(site, folder / "docs"));
    EXPECT_EQ(readText(folder / "docs/readme.txt"), "mine");
}

// Any web server can serve a published folder.
TEST(PublishedSite, PythonServesIt) {
    if (std::system("command -v python3 >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
    const TemporaryFolder folder;
    makeViewer(folder.path());
    const std::vector<SiteModel> models{{"house", "House", Bytes::of(std::string(300000, 'v'))}};
    const auto site = viewerSite(folder / "viewer", models);
    ASSERT_TRUE(site && writeSite(*site, folder / "site"));
    const std::string log = (folder / "log").string(), out = (folder / "site").string();
    const pid_t child = ::fork();
    if (child == 0) {
        const int file = ::open(log.c_str(), O_CREAT | O_WRONLY, 0600);
        ::dup2(file, 1);
        ::dup2(file, 2);
        ::execlp("python3", "python3", "-u", "-m", "http.server", "0", "--bind", "127.0.0.1", "--directory",
                 out.c_str(), nullptr);
        ::_exit(1);
    }
    int port = 0;
    for (int i = 0; i < 6000 && port == 0; ++i) {
        ::usleep(20000);
        const std::string said = readText(log);
        if (const std::size_t at = said.find(" port "); at != std::string::npos)
            port = std::atoi(said.c_str() + at + 6);
    }
    EXPECT_NE(port, 0) << readText(log);
    for (const auto& [path, resource] : site->resources()) {
        Client client(port);
        client.send("GET " + path + " HTTP/1.0\r\nHost: localhost\r\n\r\n");
        const Client::Answer answer = client.receive();
        EXPECT_EQ(answer.status, 200) << path;
        EXPECT_EQ(answer.body, resource.bytes.text()) << path;
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
}

TEST(PageHead, HasAPolicyAndAPreview) {
    Site site;
    site.add("/index.html", Bytes::of("<!doctype html><html><head><title>x</title></head><body></body></html>"));
    PagePreview preview{
        "A \"house\" & <more>", "to look into", "https://example.org/h/", Bytes::of("png"), {1200, 630, 0}};
    ASSERT_TRUE(addPageHead(site, preview));
    const Resource& page = *site.find("/");
    const std::string text(reinterpret_cast<const char*>(page.bytes.data.data()), page.bytes.data.size());
    EXPECT_LT(text.find("Content-Security-Policy\" content=\"default-src 'none'; script-src 'self'"),
              text.find("<title>"))
        << "it holds for what follows it";
    EXPECT_NE(text.find("og:title\" content=\"A &quot;house&quot; &amp; &lt;more>\""), std::string::npos);
    EXPECT_NE(text.find("og:image\" content=\"https://example.org/h/preview.png\""), std::string::npos);
    EXPECT_NE(text.find("og:url\" content=\"https://example.org/h/\""), std::string::npos);
    EXPECT_NE(
        text.find("<body>\n    <img id=\"preview\" src=\"preview.png\" alt=\"A &quot;house&quot; &amp; &lt;more>\" />"),
        std::string::npos)
        << text;
    EXPECT_EQ(site.find("/preview.png")->type, "image/png");
    Site bare;
    bare.add("/index.html", Bytes::of("hello"));
    EXPECT_EQ(addPageHead(bare, preview).error().code(), Code::CannotOpen);
}

}  // namespace
}  // namespace svt::serve
