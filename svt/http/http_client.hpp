#pragma once
/// \file
/// Requests to web servers by HTTP and HTTPS. They use libcurl, which is loaded with the first request and not linked,
/// because few runs need it. Programs under Node.js and in browsers make no requests here.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace svt::http {

/// Whether a location is an address (http://, https://) and not a path.
[[nodiscard]] bool isAddress(std::string_view location) noexcept;

/// A request for a file, or for a range of its bytes.
struct HttpRequest {
    std::string address;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;  ///< bytes of the range; 0: the whole file
    /// Receives the body of a request for a whole file in pieces. \return false to end the request
    std::function<bool(std::string_view piece)> take{};
    const Progress* progress = nullptr;  ///< ends the request when it is cancelled; may be null
};

struct HttpAnswer {
    int status = 0;             ///< of the last redirection; 0: no answer
    std::string body;           ///< of a request for a range, never longer than it
    std::string contentRange;   ///< header Content-Range
    std::string retryAfter;     ///< header Retry-After
    std::string tag;            ///< header ETag: changes with the content
    std::uint64_t bytes = 0;    ///< received bytes of the body
    bool isTooLong = false;     ///< the body is longer than the range, or `take` ended it; the rest was not read
    std::string fault;          ///< why the answer is missing or breaks off; empty: it is complete
    bool isFaultFinal = false;  ///< another attempt would end alike: too many redirections, a wrong certificate
    [[nodiscard]] bool isRefused() const noexcept { return status == 404 || status == 410; }
    /// Whether another attempt may succeed.
    [[nodiscard]] bool isWorthRetry() const noexcept {
        return (!fault.empty() && !isFaultFinal) || status == 429 || status >= 500;
    }
};

/// The fault of an answer as a message, with a remedy; empty without a fault.
[[nodiscard]] std::string faultMessage(const HttpAnswer& answer);

/// "bytes 0-99/1234" -> 0, 99, 1234
struct ContentRange {
    std::uint64_t first = 0, last = 0, total = 0;
};
/// \return the range; nothing where the text has another form or is inconsistent
[[nodiscard]] std::optional<ContentRange> parseContentRange(std::string_view text) noexcept;

/// Keeps connections for further requests. It follows up to 5 redirections, from https only to https. A server that
/// sends fewer than 1000 bytes per second during 30 s ends the request. Certificates are checked.
/// Threads: any number may ask at once.
class HttpClient {
public:
    HttpClient();
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    /// \return the answer, also of a server that refuses; CannotOpen where this program cannot make requests; Cancelled
    [[nodiscard]] Result<HttpAnswer> ask(const HttpRequest& request) const;

private:
    struct Connections;
    std::unique_ptr<Connections> connections_;
};

}  // namespace svt::http
