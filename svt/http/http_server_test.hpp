#pragma once
/// \file
/// A web server for tests, which answers with the bytes that a test makes: good ranges, whole files, lies, endless bodies.

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace svt::test {

/// A server on a port of its own. It closes the connection after each answer.
class TinyServer {
public:
    struct Request {
        std::string path;  ///< with its query
        bool hasRange = false;
        std::size_t first = 0, last = 0;  ///< of the range
    };
    /// Sends bytes. \return false if the client or the test has ended
    using Send = std::function<bool(std::string_view)>;
    using Handler = std::function<void(const Request&, const Send&)>;
    /// Makes the whole answer to a request for bytes [first, last].
    using Answer = std::function<std::string(std::size_t first, std::size_t last)>;

    explicit TinyServer(Handler handler) : handler_(std::move(handler)) {
        socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(address);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
        EXPECT_EQ(::listen(socket_, 8), 0);
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] { run(); });
    }
    explicit TinyServer(Answer answer)
        : TinyServer(Handler([answer = std::move(answer)](const Request& request, const Send& send) {
              send(answer(request.first, request.last));
          })) {}
    ~TinyServer() {
        isStopped_ = true;
        ::shutdown(socket_, SHUT_RDWR);
        ::close(socket_);
        thread_.join();
    }
    TinyServer(const TinyServer&) = delete;
    TinyServer& operator=(const TinyServer&) = delete;

    /// "http://127.0.0.1:PORT/PATH"
    [[nodiscard]] std::string address(const std::string& path) const {
        return "http://127.0.0.1:" + std::to_string(port_) + "/" + path;
    }
    [[nodiscard]] int requests() const { return requests_; }
    [[nodiscard]] const std::atomic<bool>& isStopped() const { return isStopped_; }

private:
    void run() {
        for (int client = 0; (client = ::accept(socket_, nullptr, nullptr)) >= 0; ::close(client)) {
            std::string text;
            char bytes[4096];
            while (text.find("\r\n\r\n") == std::string::npos) {
                const auto got = ::recv(client, bytes, sizeof(bytes), 0);
                if (got <= 0) break;
                text.append(bytes, static_cast<std::size_t>(got));
            }
            ++requests_;
            Request request;
            const std::size_t begin = std::min(text.find(' ') + 1, text.size());
            request.path = text.substr(begin, text.find(' ', begin) - begin);
            const std::size_t range = text.find("bytes=");
            request.hasRange = range != std::string::npos &&
                               std::sscanf(text.c_str() + range, "bytes=%zu-%zu", &request.first, &request.last) == 2;
            handler_(request, [&](std::string_view answer) {
                while (!answer.empty() && !isStopped_) {
                    const auto done = ::send(client, answer.data(), answer.size(), MSG_NOSIGNAL);
                    if (done <= 0) return false;
                    answer.remove_prefix(static_cast<std::size_t>(done));
                }
                return !isStopped_;
            });
        }
    }

    Handler handler_;
    int socket_ = -1, port_ = 0;
    std::atomic<int> requests_{0};
    std::atomic<bool> isStopped_{false};
    std::thread thread_;  // last: it uses the others
};

/// An answer with a body and further headers, each with "\r\n" behind it.
[[nodiscard]] inline std::string httpAnswer(int status, std::string_view body, const std::string& headers = {}) {
    return "HTTP/1.1 " + std::to_string(status) + " X\r\nContent-Length: " + std::to_string(body.size()) +
           "\r\nConnection: close\r\n" + headers + "\r\n" + std::string(body);
}

/// The answer to a request for a range of `text`: 206, or 416 behind its end.
[[nodiscard]] inline std::string httpRange(const std::string& text, std::size_t first, std::size_t last,
                                           const std::string& headers = {}) {
    if (first >= text.size()) return httpAnswer(416, "");
    last = std::min(last, text.size() - 1);
    return httpAnswer(206, std::string_view(text).substr(first, last - first + 1),
                      "Content-Range: bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" +
                          std::to_string(text.size()) + "\r\n" + headers);
}

/// The begin of an answer, whose header promises `missing` more bytes; then the connection is closed.
[[nodiscard]] inline std::string brokenOff(std::string answer, std::size_t missing) {
    answer.resize(answer.size() - missing);
    return answer;
}

}  // namespace svt::test
