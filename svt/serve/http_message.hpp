#pragma once
/// \file
/// Requests and replies of HTTP/1.1, and the reading of a request's head (RFC 9110, RFC 9112). Whatever two readers
/// could understand in two ways is refused, not guessed at.

#include <svt/core/file.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace svt::serve {

/// Bytes, and what keeps them alive. Cheap to copy.
struct Bytes {
    std::span<const std::byte> data;
    std::shared_ptr<const void> owner;

    [[nodiscard]] static Bytes of(std::string text);
    [[nodiscard]] static Bytes of(MappedFile file);
    [[nodiscard]] std::string_view text() const noexcept {
        return {reinterpret_cast<const char*>(data.data()), data.size()};
    }
};

using Fields = std::vector<std::pair<std::string, std::string>>;

struct Request {
    std::string method;  ///< as sent: GET, HEAD, POST, ...
    std::string path;    ///< decoded once, begins with '/', no control characters
    Fields query;        ///< decoded names and values, in their order
    Fields headers;      ///< names in lower case
    std::string body;
    std::filesystem::path bodyFile;  ///< holds the body instead where the route says so; gone after the reply

    /// Value of the first header of this lower-case name; empty where there is none.
    [[nodiscard]] std::string_view header(std::string_view name) const noexcept;
    /// Value of the first parameter of this name; empty where there is none.
    [[nodiscard]] std::string_view parameter(std::string_view name) const noexcept;
};

struct Reply {
    int status = 200;
    std::string type;  ///< Content-Type
    Bytes body;
    Fields headers;                 ///< further ones
    std::uint64_t skippedBody = 0;  ///< HEAD: so many bytes are announced and not sent

    /// A JSON object {code, message}: an error code such as E102, or HTTP404 where only HTTP was broken.
    [[nodiscard]] static Reply error(int status, std::string_view code, std::string_view message);
    [[nodiscard]] static Reply refusal(int status, std::string_view message);
};

/// "Not Found"
[[nodiscard]] std::string_view reasonOf(int status) noexcept;

/// What a head says beyond the request itself.
struct Head {
    Request request;
    std::uint64_t bodyBytes = 0;
    bool isKeptAlive = true;
    bool expectsContinue = false;
};

/// Why a head is refused: the status to answer, and a sentence.
struct HeadError {
    int status = 400;
    std::string message;
};

inline constexpr std::size_t kMaxRequestLineBytes = 8192;
inline constexpr std::size_t kMaxHeaders = 100;

/// Reads a head.
/// \param text  from the request line to the empty line, both included
/// \return the head; 400 for what is not well-formed or ambiguous (bare line feeds, folded lines, several lengths or
///         hosts, a target that is no path), 411 for a body of unknown length, 414 for a request line over 8 KiB, 431
///         over 100 headers, 505 for another version of HTTP
[[nodiscard]] std::variant<Head, HeadError> parseHead(std::string_view text);

/// Undoes %XX. \return false where a percent sign leads nowhere
[[nodiscard]] bool decodePercent(std::string_view text, std::string& decoded);

/// Whether a page of another name could not have sent this Host (DNS rebinding): an address, localhost, or one of
/// `names`. The port does not count.
[[nodiscard]] bool isKnownHost(std::string_view host, std::span<const std::string> names);

/// A single range of bytes `first` to `last`, both included.
struct ByteRange {
    std::uint64_t first = 0, last = 0;
};
enum class RangeKind : std::uint8_t {
    Whole,         ///< none, several, or none that can be understood: the whole is sent, as RFC 9110 allows
    Part,          ///< `range` is set
    Unsatisfiable  ///< begins behind the end
};
/// What a Range header asks of `size` bytes.
[[nodiscard]] RangeKind parseRange(std::string_view header, std::uint64_t size, ByteRange& range) noexcept;

}  // namespace svt::serve
