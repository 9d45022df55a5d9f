#pragma once
/// \file
/// An HTTP/1.1 server for a static site and a few calls, built for public networks. A single thread handles all I/O
/// without blocking, so a slow client occupies a connection but no thread. All resources of a client are limited.

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

/// A call: POST to a path, handled by a function on its own thread.
struct Route {
    std::string path;
    /// Handles one request at a time. `stop.cancel` is set when the client disconnects or the server stops; the return
    /// value is then discarded.
    std::function<Reply(const Request& request, const Progress& stop)> handle;
    std::uint64_t maxBodyBytes = 1 << 20;
    int queueLength = 4;        ///< queue length, beyond the request in progress; further requests get 503
    bool isBodyInFile = false;  ///< the body is stored in Request::bodyFile, not in memory
};

struct ServerOptions {
    std::string host = "127.0.0.1";  ///< address or name to listen on
    int port = 8080;                 ///< 0: any free port
    bool mayTakeOtherPort = false;   ///< if `port` is in use: use the next free one of the following 100
    /// Host names to accept besides localhost and addresses (in lower case, without port).
    std::vector<std::string> hostNames;
    std::size_t maxConnections = 256;
    double headSeconds = 10;   ///< timeout from the first byte of a request to the end of its head
    double idleSeconds = 60;   ///< timeout without a request
    double stallSeconds = 20;  ///< timeout without a byte of a body sent or received
    double stopSeconds = 2;    ///< time for replies in progress when the server stops
    /// Bodies sent or received more slowly than this on average are aborted; bytes per second.
    std::uint64_t minRate = 16 * 1024;
    std::filesystem::path bodyFolder;  ///< folder for body files; needed by routes that use them
};

/// Rejects requests and closes their connection for a head over 16 KiB (431), a request line over 8 KiB (414), a body
/// over the limit of its route (413), an unknown Host (421), a call from a page of another site (403). At the
/// connection limit, the connection that has waited longest for its client is closed; if none is waiting, a new one
/// gets 503.
class HttpServer {
public:
    static constexpr std::size_t kMaxHeadBytes = 16 * 1024;

    /// Starts listening; replies once run() is called.
    /// \return BadArgument if the host is unknown, or the port is in use or needs more privileges
    [[nodiscard]] static Result<HttpServer> listen(Site site, std::vector<Route> routes,
                                                   const ServerOptions& options = {});
    HttpServer(HttpServer&&) noexcept;
    HttpServer& operator=(HttpServer&&) noexcept;
    ~HttpServer();

    [[nodiscard]] int port() const noexcept;
    /// Replies until stop(). Memory: 17 KiB per connection, plus the bodies of calls (`queueLength` + 1 per route).
    /// Files of the site are read in parts; if another program shortens a file, its connection is closed within the
    /// reply.
    void run();
    /// Ends run() within stopSeconds plus the time handlers take to react to their `stop`. May be called from any
    /// thread and from a signal handler.
    void stop() noexcept;

private:
    class Loop;
    explicit HttpServer(std::unique_ptr<Loop> loop);
    std::unique_ptr<Loop> loop_;
};

}  // namespace svt::serve
