#include <svt/core/text.hpp>
#include <svt/serve/http_message.hpp>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace svt::serve {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

bool isTokenCharacter(char c) noexcept {
    return isDigit(c) || isLetter(c) || std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool isToken(std::string_view text) noexcept {
    return !text.empty() && std::all_of(text.begin(), text.end(), isTokenCharacter);
}

// Control characters other than tab.
bool hasControl(std::string_view text) noexcept {
    return std::any_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < 0x20 && c != '\t') || byte == 0x7F;
    });
}

std::string_view trimmed(std::string_view text) noexcept {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

std::string_view valueOf(const Fields& fields, std::string_view name) noexcept {
    for (const auto& [key, value] : fields)
        if (key == name) return value;
    return {};
}

std::ptrdiff_t countOf(const Fields& fields, std::string_view name) {
    return std::count_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
}

std::optional<HeadError> readTarget(std::string_view target, Request& request) {
    if (target.empty() || target.front() != '/')
        return HeadError{400, "the target of a request is a path that begins with '/'"};
    const std::size_t mark = target.find('?');
    if (!decodePercent(target.substr(0, mark), request.path))
        return HeadError{400, "the path has a '%' without two hexadecimal digits"};
    if (hasControl(request.path) || request.path.find('\t') != std::string::npos)
        return HeadError{400, "the path has control characters"};
    if (mark == std::string_view::npos) return std::nullopt;
    for (std::string_view rest = target.substr(mark + 1); !rest.empty();) {
        std::string part(rest.substr(0, rest.find('&')));
        rest.remove_prefix(std::min(rest.size(), part.size() + 1));
        std::replace(part.begin(), part.end(), '+', ' ');
        const std::string_view text = part;
        const std::size_t equals = std::min(text.find('='), text.size());
        std::pair<std::string, std::string> field;
        if (!decodePercent(text.substr(0, equals), field.first) ||
            !decodePercent(text.substr(std::min(text.size(), equals + 1)), field.second))
            return HeadError{400, "the query has a '%' without two hexadecimal digits"};
        request.query.push_back(std::move(field));
    }
    return std::nullopt;
}

std::optional<HeadError> readRequestLine(std::string_view line, Head& head) {
    if (line.size() > kMaxRequestLineBytes) return HeadError{414, "the request line is over 8 KiB"};
    const std::size_t first = line.find(' '), last = line.rfind(' ');
    if (first == std::string_view::npos || first == last)
        return HeadError{400, "a request line is a method, a target and a version"};
    const std::string_view method = line.substr(0, first), version = line.substr(last + 1);
    const std::string_view target = line.substr(first + 1, last - first - 1);
    if (!isToken(method) || target.find(' ') != std::string_view::npos || hasControl(line))
        return HeadError{400, "a request line is a method, a target and a version"};
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
        return version.substr(0, 5) == "HTTP/" ? HeadError{505, "only HTTP/1.0 and HTTP/1.1 are possible here"}
                                               : HeadError{400, "the request line ends without a version of HTTP"};
    head.request.method = method;
    head.isKeptAlive = version == "HTTP/1.1";
    return readTarget(target, head.request);
}

std::optional<HeadError> readHeader(std::string_view line, Fields& headers) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !isToken(line.substr(0, colon)))
        return HeadError{400, "a header is a name, a colon and a value"};
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (hasControl(value)) return HeadError{400, "a header has control characters"};
    if (headers.size() == kMaxHeaders) return HeadError{431, fmt::format("over {} headers", kMaxHeaders)};
    headers.emplace_back(lowerAscii(line.substr(0, colon)), value);
    return std::nullopt;
}

// Interprets the headers that concern the connection and the body.
std::optional<HeadError> readMeaning(Head& head) {
    const Fields& headers = head.request.headers;
    if (countOf(headers, "host") != 1) return HeadError{400, "exactly one Host is expected"};
    if (countOf(headers, "transfer-encoding") != 0)
        return HeadError{411, "a body needs a Content-Length; it cannot come in chunks"};
    if (countOf(headers, "content-length") > 1) return HeadError{400, "several Content-Lengths"};
    if (countOf(headers, "content-length") == 1) {
        const auto length = parseInteger<std::uint64_t>(valueOf(headers, "content-length"));
        if (!length) return HeadError{400, "Content-Length is not a whole number"};
        head.bodyBytes = *length;
    }
    const std::string connection = lowerAscii(valueOf(headers, "connection"));
    if (connection.find("close") != std::string::npos) head.isKeptAlive = false;
    head.expectsContinue = lowerAscii(valueOf(headers, "expect")) == "100-continue";
    return std::nullopt;
}

std::string_view withoutPort(std::string_view host) noexcept {
    if (!host.empty() && host.front() == '[') {
        const std::size_t end = host.find(']');
        return end == std::string_view::npos ? std::string_view{} : host.substr(0, end + 1);
    }
    return host.substr(0, host.find(':'));
}

}  // namespace

Bytes Bytes::of(std::string text) {
    auto owner = std::make_shared<const std::string>(std::move(text));
    return {std::as_bytes(std::span(*owner)), owner};
}

Bytes Bytes::of(FileBytes file) {
    auto owner = std::make_shared<const FileBytes>(std::move(file));
    return {owner->bytes(), owner};
}

Bytes Bytes::of(PartFile file) {
    const std::uint64_t size = file.size();
    return {{}, {}, std::make_shared<const PartFile>(std::move(file)), 0, size};
}

Bytes Bytes::part(std::uint64_t first, std::uint64_t count) const {
    Bytes part = *this;
    if (!file) part.data = data.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    part.fileOffset += first;
    part.fileSize = count;
    return part;
}

Result<std::string_view> Bytes::read(std::uint64_t first, std::size_t most, std::string& buffer) const {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, size() - first));
    if (!file) return text().substr(static_cast<std::size_t>(first), count);
    SVT_TRY(read, file->readAll(fileOffset + first, count));
    buffer = std::move(*read);
    return std::string_view(buffer);
}

std::string_view Request::header(std::string_view name) const noexcept { return valueOf(headers, name); }
std::string_view Request::parameter(std::string_view name) const noexcept { return valueOf(query, name); }

Reply Reply::error(int status, std::string_view code, std::string_view message) {
    nlohmann::ordered_json json;
    json["code"] = code;
    json["message"] = message;
    Reply reply;
    reply.status = status;
    reply.type = "application/json";
    reply.body = Bytes::of(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    reply.headers = {{"Cache-Control", "no-store"}};
    return reply;
}

Reply Reply::refusal(int status, std::string_view message) {
    return error(status, fmt::format("HTTP{}", status), message);
}

std::string_view reasonPhrase(int status) noexcept {
    switch (status) {
        case 200: return "OK";
        case 206: return "Partial Content";
        case 304: return "Not Modified";
        case 400: return "Bad Request";
        case 403: return "Forbidden";
        case 404: return "Not Found";
        case 405: return "Method Not Allowed";
        case 408: return "Request Timeout";
        case 411: return "Length Required";
        case 413: return "Content Too Large";
        case 414: return "URI Too Long";
        case 416: return "Range Not Satisfiable";
        case 421: return "Misdirected Request";
        case 422: return "Unprocessable Content";
        case 431: return "Request Header Fields Too Large";
        case 500: return "Internal Server Error";
        case 503: return "Service Unavailable";
        case 505: return "HTTP Version Not Supported";
        default: return "Unknown";
    }
}

bool decodePercent(std::string_view text, std::string& decoded) {
    decoded.clear();
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const auto code = i + 2 < text.size() ? parseInteger<std::uint8_t>(text.substr(i + 1, 2), 16) : std::nullopt;
        if (!code) return false;
        decoded += static_cast<char>(*code);
        i += 2;
    }
    return true;
}

std::variant<Head, HeadError> parseHead(std::string_view text) {
    Head head;
    for (bool isFirst = true;; isFirst = false) {
        const std::size_t end = text.find(kLineEnd);
        if (end == std::string_view::npos) return HeadError{400, "a line does not end with CR LF"};
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end + kLineEnd.size());
        if (line.empty() && !isFirst) break;
        if (auto error = isFirst ? readRequestLine(line, head) : readHeader(line, head.request.headers)) return *error;
    }
    if (auto error = readMeaning(head)) return *error;
    return head;
}

bool isKnownHost(std::string_view host, std::span<const std::string> names) {
    std::string name = lowerAscii(withoutPort(host));
    if (name.size() > 1 && name.back() == '.') name.pop_back();
    if (name == "localhost" || std::find(names.begin(), names.end(), name) != names.end()) return true;
    std::array<unsigned char, sizeof(in6_addr)> address{};
    if (::inet_pton(AF_INET, name.c_str(), address.data()) == 1) return true;
    return name.size() > 2 && name.front() == '[' &&
           ::inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), address.data()) == 1;
}

RangeKind parseRange(std::string_view header, std::uint64_t size, ByteRange& range) noexcept {
    constexpr std::string_view kUnit = "bytes=";
    if (header.substr(0, kUnit.size()) != kUnit) return RangeKind::Whole;
    header = trimmed(header.substr(kUnit.size()));
    const std::size_t dash = header.find('-');
    if (dash == std::string_view::npos || header.find(',') != std::string_view::npos) return RangeKind::Whole;
    const std::string_view from = header.substr(0, dash), to = header.substr(dash + 1);
    const auto first = parseInteger<std::uint64_t>(from), last = parseInteger<std::uint64_t>(to);
    if ((!from.empty() && !first) || (!to.empty() && !last) || (!first && !last)) return RangeKind::Whole;
    if (!first) {  // a suffix range: the last bytes
        if (*last == 0 || size == 0) return RangeKind::Unsatisfiable;
        range = {size - std::min(size, *last), size - 1};
        return RangeKind::Part;
    }
    if (last && *last < *first) return RangeKind::Whole;
    if (*first >= size) return RangeKind::Unsatisfiable;
    range = {*first, last ? std::min(*last, size - 1) : size - 1};
    return RangeKind::Part;
}

}  // namespace svt::serve
