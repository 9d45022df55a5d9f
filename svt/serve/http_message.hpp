#pragma once
/// \file
/// HTTP/1.1 requests and replies, and the parser for request heads (RFC 9110, RFC 9112). Ambiguous input is
/// rejected, never guessed at.

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

/// Bytes with their owner: memory, or a file that is read in parts. Cheap to copy.
struct Bytes {
    std::span<const std::byte> data;  ///< empty if a file holds them
    std::shared_ptr<const void> owner;
    std::shared_ptr<const PartFile> file = nullptr;
    std::uint64_t fileOffset = 0, fileSize = 0;  ///< position and size in the file

    [[nodiscard]] static Bytes of(std::string text);
    [[nodiscard]] static Bytes of(FileBytes file);
    [[nodiscard]] static Bytes of(PartFile file);

    [[nodiscard]] std::uint64_t size() const noexcept { return file ? fileSize : data.size(); }
    /// `count` bytes from `first` on; they must be there.
    [[nodiscard]] Bytes part(std::uint64_t first, std::uint64_t count) const;
    /// Reads up to `most` bytes from `first` on. Read large files in several calls.
    /// \param buffer  receives bytes of a file; keep it as long as the result
    /// \return the bytes, or CannotOpen if another program shortened the file
    [[nodiscard]] Result<std::string_view> read(std::uint64_t first, std::size_t most, std::string& buffer) const;
    /// \return nothing, or CannotOpen if another program changed the file since it was opened
    [[nodiscard]] Result<void> checkUnchanged() const { return file ? file->checkUnchanged() : Result<void>(); }
    /// The bytes as text; only for bytes in memory.
    [[nodiscard]] std::string_view text() const noexcept {
        return {reinterpret_cast<const char*>(data.data()), data.size()};
    }
};

using Fields = std::vector<std::pair<std::string, std::string>>;

struct Request {
    std::string method;  ///< as sent: GET, HEAD, POST, ...
    std::string path;    ///< decoded once, begins with '/', no control characters
    Fields query;        ///< decoded names and values, in order
    Fields headers;      ///< names in lower case
    std::string body;
    std::filesystem::path bodyFile;  ///< holds the body if the route asks for it; deleted after the reply

    /// Value of the first header with this lower-case name; empty if missing.
    [[nodiscard]] std::string_view header(std::string_view name) const noexcept;
    /// Value of the first parameter with this name; empty if missing.
    [[nodiscard]] std::string_view parameter(std::string_view name) const noexcept;
};

struct Reply {
    int status = 200;
    std::string type;  ///< Content-Type
    Bytes body;
    Fields headers;                 ///< additional headers
    std::uint64_t skippedBody = 0;  ///< HEAD: length announced but not sent

    /// A JSON object {code, message}: an error code such as E102, or HTTP404 for errors of HTTP itself.
    [[nodiscard]] static Reply error(int status, std::string_view code, std::string_view message);
    [[nodiscard]] static Reply refusal(int status, std::string_view message);
};

/// Reason phrase, such as "Not Found".
[[nodiscard]] std::string_view reasonPhrase(int status) noexcept;

/// A parsed head, beyond the request itself.
struct Head {
    Request request;
    std::uint64_t bodyBytes = 0;
    bool isKeptAlive = true;
    bool expectsContinue = false;
};

/// Reason for rejecting a head: the status to answer, and a sentence.
struct HeadError {
    int status = 400;
    std::string message;
};

inline constexpr std::size_t kMaxRequestLineBytes = 8192;
inline constexpr std::size_t kMaxHeaders = 100;

/// Parses a head.
/// \param text  from the request line to the empty line, inclusive
/// \return the head, or an error. 400: malformed or ambiguous input (bare line feeds, folded lines, several lengths or
///         hosts, a target that is not a path). 411: a body of unknown length. 414: a request line over 8 KiB. 431:
///         more than 100 headers. 505: another version of HTTP
[[nodiscard]] std::variant<Head, HeadError> parseHead(std::string_view text);

/// Decodes %XX.
/// \return false for an invalid percent encoding
[[nodiscard]] bool decodePercent(std::string_view text, std::string& decoded);

/// Whether the Host header is safe from DNS rebinding: an IP address, localhost, or one of `names`. The port is
/// ignored.
[[nodiscard]] bool isKnownHost(std::string_view host, std::span<const std::string> names);

/// A single range of bytes `first` to `last`, inclusive.
struct ByteRange {
    std::uint64_t first = 0, last = 0;
};
enum class RangeKind : std::uint8_t {
    Whole,         ///< no range, several, or an invalid one: everything is sent, as RFC 9110 allows
    Part,          ///< `range` is set
    Unsatisfiable  ///< begins after the end
};
/// Parses the Range header for content of `size` bytes.
[[nodiscard]] RangeKind parseRange(std::string_view header, std::uint64_t size, ByteRange& range) noexcept;

}  // namespace svt::serve
