#pragma once
/// \file
/// A server on its own thread, and a client that sends arbitrary bytes.

#include <svt/core/temporary_folder_test.hpp>
#include <svt/serve/http_server.hpp>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace svt::serve {

/// Ends what hangs; no test measures how soon an answer comes.
constexpr double kHangSeconds = 120;

class Client {
public:
    explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        isConnected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    Client(Client&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)), isConnected_(other.isConnected_), in_(std::move(other.in_)) {}
    Client& operator=(Client&&) = delete;
    ~Client() {
        if (socket_ >= 0) ::close(socket_);
    }

    [[nodiscard]] bool isConnected() const { return isConnected_; }

    /// \return false if the server has closed the connection
    bool send(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    struct Answer {
        int status = 0;  ///< 0: no reply
        std::string head, body;
        [[nodiscard]] std::string header(const std::string& name) const {
            const std::size_t at = head.find("\r\n" + name + ": ");
            if (at == std::string::npos) return "";
            const std::size_t from = at + name.size() + 4;
            return head.substr(from, head.find("\r\n", from) - from);
        }
    };

    /// Receives one reply; `hasBody` is false after HEAD.
    Answer receive(bool hasBody = true, double seconds = kHangSeconds) {
        const auto end = endAfter(seconds);
        Answer answer;
        std::size_t at = 0;
        while ((at = in_.find("\r\n\r\n")) == std::string::npos)
            if (!more(end)) return answer;
        answer.head = in_.substr(0, at + 4);
        in_.erase(0, at + 4);
        answer.status = std::atoi(answer.head.c_str() + 9);
        const std::string length = answer.header("Content-Length");
        const std::size_t bytes = hasBody && !length.empty() ? std::strtoull(length.c_str(), nullptr, 10) : 0;
        while (in_.size() < bytes)
            if (!more(end)) return {};
        answer.body = in_.substr(0, bytes);
        in_.erase(0, bytes);
        return answer;
    }

    /// Waits for the first bytes of a reply, and keeps them. False if none come.
    bool hasBegun() { return more(endAfter(kHangSeconds)); }

    /// Waits until the server closes the connection; discards what it still sends. False if it never does.
    bool isClosed() {
        const auto end = endAfter(kHangSeconds);
        while (more(end)) in_.clear();
        return isClosed_;
    }

private:
    static std::chrono::steady_clock::time_point endAfter(double seconds) {
        return std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<int>(seconds * 1000));
    }

    bool more(std::chrono::steady_clock::time_point end) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
        pollfd poll{socket_, POLLIN, 0};
        if (left <= 0 || ::poll(&poll, 1, static_cast<int>(left)) <= 0) return false;
        char buffer[65536];
        const ssize_t got = ::recv(socket_, buffer, sizeof buffer, 0);
        isClosed_ = got <= 0;
        if (got > 0) in_.append(buffer, static_cast<std::size_t>(got));
        return got > 0;
    }

    int socket_;
    bool isConnected_ = false, isClosed_ = false;
    std::string in_;
};

/// A server that runs for the lifetime of the object.
class RunningServer {
public:
    explicit RunningServer(Site site, std::vector<Route> routes = {}, ServerOptions options = {}) {
        options.port = 0;
        auto server = HttpServer::listen(std::move(site), std::move(routes), options);
        if (!server) {
            ADD_FAILURE() << server.error().toString();
            return;
        }
        server_.emplace(std::move(*server));
        thread_ = std::thread([this] { server_->run(); });
    }
    ~RunningServer() { stop(); }
    RunningServer(const RunningServer&) = delete;
    RunningServer& operator=(const RunningServer&) = delete;

    /// Waits until the server has stopped.
    void stop() {
        if (!thread_.joinable()) return;
        server_->stop();
        thread_.join();
    }

    [[nodiscard]] int port() const { return server_->port(); }
    [[nodiscard]] Client client() const { return Client(port()); }
    /// The reply to one request on a new connection; the Host header is added.
    [[nodiscard]] Client::Answer ask(const std::string& line, const std::string& headers = {},
                                     const std::string& body = {}) const {
        Client to = client();
        to.send(line + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n" + body);
        return to.receive(line.rfind("HEAD", 0) != 0);
    }

private:
    std::optional<HttpServer> server_;
    std::thread thread_;
};

}  // namespace svt::serve
