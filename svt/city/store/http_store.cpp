#include <svt/city/store/store.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <vector>

namespace svt::city {
namespace {

// libcurl's functions and the numbers of its options, which are the same in all versions of its fourth interface (since
// 2006). It is loaded with the first request and not linked: few runs need it.
struct Curl {
    using Handle = void;
    enum Option : int {
        kWriteData = 10001,
        kUrl = 10002,
        kRange = 10007,
        kErrorBuffer = 10010,
        kUserAgent = 10018,
        kHeaderData = 10029,
        kWriteFunction = 20011,
        kHeaderFunction = 20079,
        kLowSpeedLimit = 19,
        kLowSpeedTime = 20,
        kFollow = 52,
        kMostRedirects = 68,
        kConnectSeconds = 78,
        kNoSignal = 99,
        kProtocols = 181,
        kRedirectProtocols = 182
    };
    static constexpr int kResponseCode = 0x200002;
    static constexpr long kHttpAndHttps = 3;

    int (*globalInit)(long) = nullptr;
    Handle* (*init)() = nullptr;
    int (*set)(Handle*, int, ...) = nullptr;
    int (*perform)(Handle*) = nullptr;
    int (*get)(Handle*, int, ...) = nullptr;
    void (*cleanup)(Handle*) = nullptr;
    const char* (*textOf)(int) = nullptr;
};

Result<Curl> loadCurl() {
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
        "addresses need libcurl, which is not installed (Debian: libcurl4); install it, or copy the city here");
}

const Result<Curl>& loadedCurl() {
    static const Result<Curl> curl = loadCurl();
    return curl;
}

// The answer of a server.
struct Answer {
    std::string body, contentRange, retryAfter;
    std::size_t most = 0;  // largest accepted size
    bool isTooLong = false;
    long status = 0;
};

std::size_t takeBody(char* bytes, std::size_t one, std::size_t count, void* to) {
    auto& answer = *static_cast<Answer*>(to);
    if (count * one > answer.most - answer.body.size()) {
        answer.isTooLong = true;
        return 0;
    }
    answer.body.append(bytes, count * one);
    return count * one;
}

std::size_t takeHeader(char* bytes, std::size_t one, std::size_t count, void* to) {
    auto& answer = *static_cast<Answer*>(to);
    const std::string_view line(bytes, count * one);
    if (line.starts_with("HTTP/")) {  // of a redirection
        answer.contentRange.clear();
        answer.retryAfter.clear();
    }
    const auto take = [&](std::string_view name, std::string& value) {
        if (line.size() > name.size() && lowerAscii(std::string(line.substr(0, name.size()))) == name)
            value = std::string(withoutBlanks(line.substr(name.size())));
    };
    take("content-range:", answer.contentRange);
    take("retry-after:", answer.retryAfter);
    return count * one;
}

// "bytes 0-99/1234" -> 0, 99, 1234
struct ContentRange {
    std::uint64_t first = 0, last = 0, total = 0;
};
bool parseContentRange(std::string_view text, ContentRange& range) {
    if (!text.starts_with("bytes ")) return false;
    const char* at = text.data() + 6;
    const char* end = text.data() + text.size();
    const auto take = [&](std::uint64_t& to, char after) {
        const auto [next, failed] = std::from_chars(at, end, to);
        if (failed != std::errc{} || (after != 0 && (next == end || *next != after))) return false;
        at = next + (after != 0);
        return true;
    };
    return take(range.first, '-') && take(range.last, '/') && take(range.total, 0) && range.first <= range.last &&
           range.last < range.total;
}

class HttpStore : public Store {
public:
    HttpStore(std::string address, std::shared_ptr<Traffic> traffic, RetryClock clock)
        : address_(std::move(address)), traffic_(std::move(traffic)), clock_(std::move(clock)) {
        while (address_.ends_with('/')) address_.pop_back();
    }
    ~HttpStore() override {
        for (Curl::Handle* handle : idle_) loadedCurl()->cleanup(handle);
    }
    HttpStore(const HttpStore&) = delete;
    HttpStore& operator=(const HttpStore&) = delete;

    Result<std::string> read(const std::string& name, std::uint64_t offset, std::size_t size) const override {
        if (size == 0) return std::string();
        if (!loadedCurl()) return loadedCurl().error();
        for (int attempt = 1;; ++attempt) {
            Retry retry;
            auto bytes = ask(name, offset, size, retry);
            if (bytes || !retry.isUseful || attempt == kMostAttempts) return bytes;
            const double seconds = retrySeconds(attempt, retry.after, clock_.now());
            if (seconds > kLongestRetrySeconds)
                return wrong(name,
                             fmt::format("the server is busy and asks to wait {:.0f} s; try it again then", seconds));
            clock_.wait(seconds);
        }
    }
    Result<std::uint64_t> size(const std::string& name) const override {
        if (const auto known = knownSize(name); known != 0) return known;
        SVT_DO(read(name, 0, 1));
        return knownSize(name);
    }
    std::string place(const std::string& name) const override { return address_ + "/" + name; }

private:
    // Whether a request is worth sending again, and the time that the server asks for.
    struct Retry {
        bool isUseful = false;
        std::string after;
    };

    Error wrong(const std::string& name, std::string message, Code code = Code::CannotOpen) const {
        return {code, std::move(message), {place(name), 0, 0, {}}};
    }

    Result<std::string> ask(const std::string& name, std::uint64_t offset, std::size_t size, Retry& retry) const {
        const Curl& curl = *loadedCurl();
        Curl::Handle* handle = takeHandle();
        if (handle == nullptr) return wrong(name, "libcurl gives no connection");
        Answer answer;
        answer.most = size;
        const std::string url = place(name), range = fmt::format("{}-{}", offset, offset + size - 1);
        curl.set(handle, Curl::kUrl, url.c_str());
        curl.set(handle, Curl::kRange, range.c_str());
        curl.set(handle, Curl::kWriteData, &answer);
        curl.set(handle, Curl::kHeaderData, &answer);
        const int failed = curl.perform(handle);
        curl.get(handle, Curl::kResponseCode, &answer.status);
        giveBack(handle, answer.body.size());
        retry.isUseful = (failed != 0 && !answer.isTooLong) || answer.status == 429 || answer.status >= 500;
        retry.after = answer.retryAfter;
        if (answer.status == 404 || answer.status == 410 || answer.status == 416) return std::string();
        if (failed != 0 && !answer.isTooLong && answer.status != 0)
            return wrong(name, fmt::format("the answer of the server breaks off after {} bytes ({}); try it later",
                                           answer.body.size(), curl.textOf(failed)));
        if (failed != 0 && !answer.isTooLong)
            return wrong(name, fmt::format("the server does not answer ({}); try it later, or check the address",
                                           curl.textOf(failed)));
        return checked(name, offset, size, std::move(answer));
    }

    // The body of an answer, if it is the requested range.
    Result<std::string> checked(const std::string& name, std::uint64_t offset, std::size_t size, Answer answer) const {
        if (answer.status == 200) {
            // A complete file is accepted if it is not longer than the requested range.
            if (offset == 0 && !answer.isTooLong) return remembered(name, answer.body.size(), std::move(answer.body));
            return wrong(name,
                         "the server sends whole files where a range is asked for; a city needs one with range "
                         "requests (svt serve, nginx, Apache, S3), or a copy on this machine");
        }
        if (answer.status != 206)
            return wrong(name, fmt::format("the server answers with status {}; check the address and its permissions",
                                           answer.status));
        ContentRange range;
        if (answer.isTooLong || !parseContentRange(answer.contentRange, range) || range.first != offset ||
            range.last - range.first + 1 != answer.body.size() ||
            (answer.body.size() < size && range.last + 1 != range.total))
            return wrong(name,
                         fmt::format("asked for bytes {} to {}, the server sent {} bytes as '{}'; it does not support "
                                     "ranges: use another server, or a copy on this machine",
                                     offset, offset + size - 1, answer.body.size(), answer.contentRange));
        return remembered(name, range.total, std::move(answer.body));
    }

    Result<std::string> remembered(const std::string& name, std::uint64_t total, std::string body) const {
        const std::lock_guard lock(mutex_);
        const auto [known, isNew] = sizes_.emplace(name, total);
        if (!isNew && known->second != total)
            return wrong(name,
                         fmt::format("the file had {} bytes and has {} now: the city changed while it was read; try "
                                     "again",
                                     known->second, total),
                         Code::BadCity);
        return body;
    }

    std::uint64_t knownSize(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        const auto known = sizes_.find(name);
        return known == sizes_.end() ? 0 : known->second;
    }

    // A handle keeps its connection for the next request.
    Curl::Handle* takeHandle() const {
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                Curl::Handle* handle = idle_.back();
                idle_.pop_back();
                return handle;
            }
        }
        const Curl& curl = *loadedCurl();
        Curl::Handle* handle = curl.init();
        if (handle == nullptr) return nullptr;
        curl.set(handle, Curl::kWriteFunction, &takeBody);
        curl.set(handle, Curl::kHeaderFunction, &takeHeader);
        curl.set(handle, Curl::kUserAgent, "svt");
        curl.set(handle, Curl::kNoSignal, 1L);
        curl.set(handle, Curl::kFollow, 1L);
        curl.set(handle, Curl::kMostRedirects, 5L);
        curl.set(handle, Curl::kConnectSeconds, 20L);
        curl.set(handle, Curl::kLowSpeedLimit, 100L);
        curl.set(handle, Curl::kLowSpeedTime, 30L);
        curl.set(handle, Curl::kProtocols, Curl::kHttpAndHttps);
        curl.set(handle, Curl::kRedirectProtocols, Curl::kHttpAndHttps);
        return handle;
    }
    void giveBack(Curl::Handle* handle, std::size_t bytes) const {
        const std::lock_guard lock(mutex_);
        idle_.push_back(handle);
        if (!traffic_) return;
        ++traffic_->requests;
        traffic_->bytes += bytes;
    }

    std::string address_;
    std::shared_ptr<Traffic> traffic_;
    RetryClock clock_;
    mutable std::mutex mutex_;
    mutable std::vector<Curl::Handle*> idle_;
    mutable std::map<std::string, std::uint64_t> sizes_;
};

}  // namespace

std::shared_ptr<const Store> openHttpStore(std::string address, std::shared_ptr<Traffic> traffic, RetryClock clock) {
    return std::make_shared<HttpStore>(std::move(address), std::move(traffic), std::move(clock));
}

}  // namespace svt::city
