#pragma once
/// \file
/// An HTTP/1.1 server for a site and a few calls, made to stand in the open: one thread moves all bytes and waits for
/// nobody, so a slow client costs a place among the connections and no thread; everything a client may use has a limit.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/serve/http_message.hpp>
#include <svt/serve/site.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace svt::serve {

/// A call: POST to a path, answered by a function on a thread of its own.
struct Route {
    std::string path;
    /// Called for one request at a time. `stop.cancel` is set where the client has gone or the server stops; what it
    /// returns then is thrown away.
    std::function<Reply(const Request& request, const Progress& stop)> handle;
    std::uint64_t maxBodyBytes = 1 << 20;
    int maxWaiting = 4;         ///< so many requests may be sent or wait beside the one at work; more get 503
    bool isBodyInFile = false;  ///< the body goes to Request::bodyFile, not into memory
};

struct ServerOptions {
    std::string host = "127.0.0.1";  ///< address or name to listen at
    int port = 8080;                 ///< 0: any that is free
    bool mayTakeOtherPort = false;   ///< where `port` is taken: the next free one of the 100 behind it
    /// Names, beside localhost and addresses, that Host may have (in lower case, without port).
    std::vector<std::string> hostNames;
    std::size_t maxConnections = 256;
    double headSeconds = 10;   ///< from the first byte of a request to the end of its head
    double idleSeconds = 60;   ///< without a request
    double stallSeconds = 20;  ///< without a byte of a body sent or taken
    double stopSeconds = 2;    ///< for replies under way when the server stops
    /// A body that comes or goes more slowly than this, on average, is given up; bytes per second.
    std::uint64_t minRate = 16 * 1024;
    std::filesystem::path bodyFolder;  ///< where files of bodies stand; needed by routes that want them
};

/// Refused, with the connection closed: a head over 16 KiB (431), a request line over 8 KiB (414), a body over its
/// route's limit (413), a Host that is not ours (421), a call from another site's page (403). Where all places are
/// taken, the connection that waits longest for its request loses its own; where none waits, a new one gets 503.
class HttpServer {
public:
    static constexpr std::size_t kMaxHeadBytes = 16 * 1024;

    /// Listens from now on; replies once run() is called.
    /// \return BadArgument where the host is unknown, the port is taken or needs more rights
    [[nodiscard]] static Result<HttpServer> listen(Site site, std::vector<Route> routes,
                                                   const ServerOptions& options = {});
    HttpServer(HttpServer&&) noexcept;
    HttpServer& operator=(HttpServer&&) noexcept;
    ~HttpServer();

    [[nodiscard]] int port() const noexcept;
    /// Replies until stop(). Memory: 17 KiB a connection, beside the bodies of calls (`maxWaiting` + 1 each).
    void run();
    /// Ends run() within stopSeconds and what the handlers take to heed their `stop`. From any thread, and from a
    /// signal handler.
    void stop() noexcept;

private:
    class Loop;
    explicit HttpServer(std::unique_ptr<Loop> loop);
    std::unique_ptr<Loop> loop_;
};

}  // namespace svt::serve
