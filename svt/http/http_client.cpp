#include <svt/http/http_client.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <mutex>
#include <vector>

namespace svt::http {
namespace {

// libcurl's functions and the numbers of its options, which are the same in all versions of its fourth interface (since
// 2006).
struct Curl {
    using Handle = void;
    enum Option : int {
        kWriteData = 10001,
        kUrl = 10002,
        kRange = 10007,
        kErrorBuffer = 10010,
        kUserAgent = 10018,
        kHeaderData = 10029,
        kProgressData = 10057,
        kWriteFunction = 20011,
        kHeaderFunction = 20079,
        kProgressFunction = 20219,
        kLowSpeedLimit = 19,
        kLowSpeedTime = 20,
        kNoProgress = 43,
        kFollow = 52,
        kMostRedirects = 68,
        kConnectSeconds = 78,
        kNoSignal = 99,
        kProtocols = 181,
        kRedirectProtocols = 182
    };
    static constexpr int kResponseCode = 0x200002;
    static constexpr long kHttps = 2, kHttpAndHttps = 3;
    static constexpr int kTooManyRedirects = 47, kBadUrl = 3, kUnsupportedProtocol = 1, kCertificate = 60;

    int (*globalInit)(long) = nullptr;
    Handle* (*init)() = nullptr;
    int (*set)(Handle*, int, ...) = nullptr;
    int (*perform)(Handle*) = nullptr;
    int (*get)(Handle*, int, ...) = nullptr;
    void (*cleanup)(Handle*) = nullptr;
    const char* (*textOf)(int) = nullptr;
};

Result<Curl> loadCurl() {
#ifdef __EMSCRIPTEN__
    return Error(Code::CannotOpen,
                 "this program under Node.js does not read addresses; download the file, and give its name");
#else
    for (const char* name : {"libcurl.so.4", "libcurl-gnutls.so.4", "libcurl.4.dylib"}) {
        const auto library = SharedLibrary::load(name);
        Curl curl;
        if (library && library->find("curl_global_init", curl.globalInit) &&
            library->find("curl_easy_init", curl.init) && library->find("curl_easy_setopt", curl.set) &&
            library->find("curl_easy_perform", curl.perform) && library->find("curl_easy_getinfo", curl.get) &&
            library->find("curl_easy_cleanup", curl.cleanup) && library->find("curl_easy_strerror", curl.textOf)) {
            curl.globalInit(3);
            return curl;
        }
    }
    return Error(
        Code::CannotOpen,
        "addresses need libcurl, which is not installed (Debian: libcurl4); install it, or copy the files here");
#endif
}

const Result<Curl>& loadedCurl() {
    static const Result<Curl> curl = loadCurl();
    return curl;
}

// The answer to a request while it arrives.
struct Arriving {
    const HttpRequest& request;
    HttpAnswer answer{};
    std::size_t headerBytes = 0;
};

std::size_t takeBody(char* bytes, std::size_t one, std::size_t count, void* to) {
    auto& [request, answer, ignored] = *static_cast<Arriving*>(to);
    const std::string_view piece(bytes, one * count);
    if (request.size == 0 && answer.status >= 300) return piece.size();  // the page of an error
    const bool isTaken = request.size == 0 ? request.take(piece) : piece.size() <= request.size - answer.body.size();
    if (!isTaken) {
        answer.isTooLong = true;
        return 0;
    }
    if (request.size != 0) answer.body.append(piece);
    answer.bytes += piece.size();
    return piece.size();
}

std::size_t takeHeader(char* bytes, std::size_t one, std::size_t count, void* to) {
    constexpr std::size_t kMostHeaderBytes = std::size_t{256} << 10;
    auto& [request, answer, headerBytes] = *static_cast<Arriving*>(to);
    const std::string_view line(bytes, count * one);
    headerBytes += line.size();
    if (headerBytes > kMostHeaderBytes) return 0;
    if (line.starts_with("HTTP/")) {  // of a redirection
        answer.contentRange.clear();
        answer.retryAfter.clear();
        answer.tag.clear();
        const std::string_view after = line.substr(std::min(line.find(' '), line.size() - 1) + 1);
        answer.status = parseInteger<int>(after.substr(0, 3)).value_or(0);
    }
    const auto take = [line](std::string_view name, std::string& value) {
        if (line.size() > name.size() && lowerAscii(std::string(line.substr(0, name.size()))) == name)
            value = std::string(withoutBlanks(line.substr(name.size())));
    };
    take("content-range:", answer.contentRange);
    take("retry-after:", answer.retryAfter);
    take("etag:", answer.tag);
    return line.size();
}

// libcurl calls it about once per second, also while no bytes arrive.
int isStopped(void* of, long long, long long, long long, long long) {
    return Progress::isCancelled(static_cast<Arriving*>(of)->request.progress) ? 1 : 0;
}

}  // namespace

bool isAddress(std::string_view location) noexcept {
    return location.starts_with("http://") || location.starts_with("https://");
}

std::string faultMessage(const HttpAnswer& answer) {
    if (answer.fault.empty()) return {};
    if (answer.isFaultFinal)
        return fmt::format("the server cannot be used ({}); check the address, or download the file in another way",
                           answer.fault);
    if (answer.status != 0)
        return fmt::format("the answer of the server breaks off after {} bytes ({}); try it later", answer.bytes,
                           answer.fault);
    return fmt::format("the server does not answer ({}); try it later, or check the address", answer.fault);
}

std::optional<ContentRange> parseContentRange(std::string_view text) noexcept {
    if (!text.starts_with("bytes ")) return std::nullopt;
    const char* at = text.data() + 6;
    const char* end = text.data() + text.size();
    const auto take = [&](std::uint64_t& to, char after) {
        const auto [next, failed] = std::from_chars(at, end, to);
        if (failed != std::errc{} || (after != 0 && (next == end || *next != after))) return false;
        at = next + (after != 0);
        return true;
    };
    ContentRange range;
    if (!take(range.first, '-') || !take(range.last, '/') || !take(range.total, 0) || range.first > range.last ||
        range.last >= range.total)
        return std::nullopt;
    return range;
}

struct HttpClient::Connections {
    std::mutex mutex;
    std::vector<Curl::Handle*> idle;

    ~Connections() {
        for (Curl::Handle* handle : idle) loadedCurl()->cleanup(handle);
    }
    // A handle keeps its connection for the next request.
    Curl::Handle* take() {
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                Curl::Handle* handle = idle.back();
                idle.pop_back();
                return handle;
            }
        }
        const Curl& curl = *loadedCurl();
        Curl::Handle* handle = curl.init();
        if (handle == nullptr) return nullptr;
        curl.set(handle, Curl::kWriteFunction, &takeBody);
        curl.set(handle, Curl::kHeaderFunction, &takeHeader);
        curl.set(handle, Curl::kProgressFunction, &isStopped);
        curl.set(handle, Curl::kNoProgress, 0L);
        curl.set(handle, Curl::kUserAgent, "svt");
        curl.set(handle, Curl::kNoSignal, 1L);
        curl.set(handle, Curl::kFollow, 1L);
        curl.set(handle, Curl::kMostRedirects, 5L);
        curl.set(handle, Curl::kConnectSeconds, 20L);
        curl.set(handle, Curl::kLowSpeedLimit, 1000L);
        curl.set(handle, Curl::kLowSpeedTime, 30L);
        curl.set(handle, Curl::kProtocols, Curl::kHttpAndHttps);
        return handle;
    }
    void giveBack(Curl::Handle* handle) {
        const std::lock_guard lock(mutex);
        idle.push_back(handle);
    }
};

HttpClient::HttpClient() : connections_(std::make_unique<Connections>()) {}
HttpClient::~HttpClient() = default;

Result<HttpAnswer> HttpClient::ask(const HttpRequest& request) const {
    if (!loadedCurl()) return loadedCurl().error();
    const Curl& curl = *loadedCurl();
    Curl::Handle* handle = connections_->take();
    if (handle == nullptr) return Error(Code::CannotOpen, "libcurl gives no connection");
    Arriving arriving{request};
    const std::string range = fmt::format("{}-{}", request.offset, request.offset + request.size - 1);
    std::array<char, 256> reason{};  // CURL_ERROR_SIZE
    curl.set(handle, Curl::kUrl, request.address.c_str());
    curl.set(handle, Curl::kRange, request.size == 0 ? nullptr : range.c_str());
    curl.set(handle, Curl::kRedirectProtocols,
             request.address.starts_with("https://") ? Curl::kHttps : Curl::kHttpAndHttps);
    curl.set(handle, Curl::kWriteData, &arriving);
    curl.set(handle, Curl::kHeaderData, &arriving);
    curl.set(handle, Curl::kProgressData, &arriving);
    curl.set(handle, Curl::kErrorBuffer, reason.data());
    const int failed = curl.perform(handle);
    long status = 0;
    curl.get(handle, Curl::kResponseCode, &status);
    curl.set(handle, Curl::kErrorBuffer, nullptr);
    connections_->giveBack(handle);
    if (Progress::isCancelled(request.progress)) return Error(Code::Cancelled, "stopped during a request to a server");
    HttpAnswer& answer = arriving.answer;
    answer.status = static_cast<int>(status);
    if (failed != 0 && !answer.isTooLong) {
        // Texts of other failures contain times.
        const bool hasReason = failed == Curl::kCertificate && reason.front() != '\0';
        answer.fault = hasReason ? reason.data() : curl.textOf(failed);
        answer.isFaultFinal = failed == Curl::kTooManyRedirects || failed == Curl::kBadUrl ||
                              failed == Curl::kUnsupportedProtocol || failed == Curl::kCertificate;
    }
    return std::move(answer);
}

}  // namespace svt::http
