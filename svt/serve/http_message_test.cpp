#include <svt/serve/http_message.hpp>

#include <gtest/gtest.h>

namespace svt::serve {
namespace {

int statusOf(const std::string& head) {
    const auto parsed = parseHead(head);
    const auto* error = std::get_if<HeadError>(&parsed);
    return error == nullptr ? 200 : error->status;
}

TEST(HttpMessage, HeadIsRead) {
    const auto parsed = parseHead(
        "POST /api/a%20b?name=h%C3%A4user+1.gml&x&y=1=2 HTTP/1.1\r\nHost: localhost:8080\r\nContent-Length: 17\r\n"
        "X-Blank:  \t both sides \t \r\nEXPECT: 100-Continue\r\n\r\n");
    ASSERT_TRUE(std::holds_alternative<Head>(parsed));
    const Head& head = std::get<Head>(parsed);
    EXPECT_EQ(head.request.method, "POST");
    EXPECT_EQ(head.request.path, "/api/a b");
    EXPECT_EQ(head.request.parameter("name"), "h\xC3\xA4user 1.gml");
    EXPECT_EQ(head.request.parameter("x"), "");
    EXPECT_EQ(head.request.parameter("y"), "1=2");
    EXPECT_EQ(head.request.header("x-blank"), "both sides");
    EXPECT_EQ(head.bodyBytes, 17u);
    EXPECT_TRUE(head.isKeptAlive);
    EXPECT_TRUE(head.expectsContinue);
}

TEST(HttpMessage, ConnectionIsKeptAsTheClientWants) {
    const auto isKept = [](const std::string& text) { return std::get<Head>(parseHead(text)).isKeptAlive; };
    EXPECT_TRUE(isKept("GET / HTTP/1.1\r\nHost: a\r\n\r\n"));
    EXPECT_FALSE(isKept("GET / HTTP/1.1\r\nHost: a\r\nConnection: Close\r\n\r\n"));
    EXPECT_FALSE(isKept("GET / HTTP/1.0\r\nHost: a\r\n\r\n"));
}

TEST(HttpMessage, WhatIsNotWellFormedOrAmbiguousIsRefused) {
    const std::string host = "Host: a\r\n";
    EXPECT_EQ(statusOf("GET / HTTP/1.1\r\n" + host + "\r\n"), 200);
    struct {
        std::string head;
        int status;
    } const cases[] = {
        {"GET /\r\n" + host + "\r\n", 400},
        {"GET  HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET / / HTTP/1.1\r\n" + host + "\r\n", 400},
        {"G@T / HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET / HTTP/2.0\r\n" + host + "\r\n", 505},
        {"GET / FTP/1.1\r\n" + host + "\r\n", 400},
        {"GET http://a/ HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET * HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET /%0 HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET /%zz HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET /%00 HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET /a%0d%0aX:1 HTTP/1.1\r\n" + host + "\r\n", 400},
        {"GET /?a=%g1 HTTP/1.1\r\n" + host + "\r\n", 400},
        {std::string("GET /\0 HTTP/1.1\r\n", 17) + host + "\r\n", 400},
        {"GET / HTTP/1.1\r\n\r\n", 400},
        {"GET / HTTP/1.1\r\n" + host + host + "\r\n", 400},
        {"GET / HTTP/1.1\r\n" + host + "no colon\r\n\r\n", 400},
        {"GET / HTTP/1.1\r\n" + host + "Blank : 1\r\n\r\n", 400},
        {"GET / HTTP/1.1\r\n" + host + " folded\r\n\r\n", 400},
        {"GET / HTTP/1.1\r\n" + host + "A: b\nC: d\r\n\r\n", 400},
        {"GET / HTTP/1.1\n" + host + "\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: 1\r\nContent-Length: 1\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: +1\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: 0x10\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999\r\n\r\n", 400},
        {"POST / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n", 411},
        {"POST / HTTP/1.1\r\n" + host + "Content-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n", 411},
    };
    for (const auto& wrong : cases) EXPECT_EQ(statusOf(wrong.head), wrong.status) << wrong.head;

    std::string many = "GET / HTTP/1.1\r\n" + host;
    for (std::size_t i = 1; i < kMaxHeaders; ++i) many += "X: 1\r\n";
    EXPECT_EQ(statusOf(many + "\r\n"), 200);
    EXPECT_EQ(statusOf(many + "X: 1\r\n\r\n"), 431);
    const std::string longest(kMaxRequestLineBytes - 13, 'a');
    EXPECT_EQ(statusOf("GET " + longest.substr(0, 1) + " HTTP/1.1\r\n" + host + "\r\n"), 400);
    EXPECT_EQ(statusOf("GET /" + longest.substr(1) + " HTTP/1.1\r\n" + host + "\r\n"), 200);
    EXPECT_EQ(statusOf("GET /" + longest + " HTTP/1.1\r\n" + host + "\r\n"), 414);
}

TEST(HttpMessage, HostsThatRebindingCannotMakeAreKnown) {
    const std::vector<std::string> names{"viewer.example"};
    for (const char* host : {"localhost", "LOCALHOST:8080", "localhost.", "127.0.0.1", "127.0.0.1:1", "192.168.1.7:80",
                             "[::1]", "[::1]:8080", "viewer.example:443"})
        EXPECT_TRUE(isKnownHost(host, names)) << host;
    for (const char* host :
         {"", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "evil.localhost:80", "[::1", "[evil]",
          "127.1", "0x7f000001", "2130706433", "@localhost", "a:localhost"})
        EXPECT_FALSE(isKnownHost(host, names)) << host;
}

TEST(HttpMessage, RangesAreThoseOfTheStandard) {
    const auto kind = [](std::string_view header, std::uint64_t size = 1000) {
        ByteRange range;
        switch (parseRange(header, size, range)) {
            case RangeKind::Whole: return std::string("whole");
            case RangeKind::Unsatisfiable: return std::string("none");
            default: return std::to_string(range.first) + "-" + std::to_string(range.last);
        }
    };
    EXPECT_EQ(kind("bytes=0-0"), "0-0");
    EXPECT_EQ(kind("bytes=10-19"), "10-19");
    EXPECT_EQ(kind("bytes=990-"), "990-999");
    EXPECT_EQ(kind("bytes=-10"), "990-999");
    EXPECT_EQ(kind("bytes=-5000"), "0-999");
    EXPECT_EQ(kind("bytes=999-18446744073709551615"), "999-999");
    EXPECT_EQ(kind("bytes=1000-"), "none");
    EXPECT_EQ(kind("bytes=18446744073709551615-18446744073709551615"), "none");
    EXPECT_EQ(kind("bytes=-0"), "none");
    EXPECT_EQ(kind("bytes=0-", 0), "none");
    for (const char* other : {"", "bytes", "bytes=", "bytes=-", "bytes=5-4", "bytes=a-b", "bytes=1--2", "bytes=0-1,3-4",
                              "bytes=0-18446744073709551616", "bytes=+1-2", "lines=0-1"})
        EXPECT_EQ(kind(other), "whole") << other;
}

}  // namespace
}  // namespace svt::serve
