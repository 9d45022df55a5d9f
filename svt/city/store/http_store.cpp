#include <svt/city/store/store.hpp>
#include <svt/http/http_client.hpp>

#include <fmt/format.h>

#include <map>
#include <mutex>

namespace svt::city {
namespace {

using http::HttpAnswer, http::HttpRequest, http::RetryClock;

class HttpStore : public Store {
public:
    HttpStore(std::string address, std::shared_ptr<Traffic> traffic, RetryClock clock)
        : address_(std::move(address)), traffic_(std::move(traffic)), clock_(std::move(clock)) {
        while (address_.ends_with('/')) address_.pop_back();
    }

    Result<std::string> read(const std::string& name, std::uint64_t offset, std::size_t size) const override {
        if (size == 0) return std::string();
        for (int attempt = 1;; ++attempt) {
            const HttpRequest request{place(name), offset, size};
            SVT_TRY(answer, client_.ask(request));
            count(*answer);
            if (!answer->isWorthRetry() || attempt == http::kMostAttempts)
                return bytesOf(name, request, std::move(*answer));
            const double seconds = http::retrySeconds(attempt, answer->retryAfter, clock_.now());
            if (seconds > http::kLongestRetrySeconds)
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
    Error wrong(const std::string& name, std::string message, Code code = Code::CannotOpen) const {
        return {code, std::move(message), {place(name), 0, 0, {}}};
    }

    Result<std::string> bytesOf(const std::string& name, const HttpRequest& request, HttpAnswer answer) const {
        if (answer.isRefused() || answer.status == 416) return std::string();
        if (std::string fault = faultMessage(answer); !fault.empty()) return wrong(name, std::move(fault));
        return checked(name, request.offset, static_cast<std::size_t>(request.size), std::move(answer));
    }

    // The body of an answer, if it is the requested range.
    Result<std::string> checked(const std::string& name, std::uint64_t offset, std::size_t size,
                                HttpAnswer answer) const {
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
        const auto range = http::parseContentRange(answer.contentRange);
        if (answer.isTooLong || !range || range->first != offset ||
            range->last - range->first + 1 != answer.body.size() ||
            (answer.body.size() < size && range->last + 1 != range->total))
            return wrong(name,
                         fmt::format("asked for bytes {} to {}, the server sent {} bytes as '{}'; it does not support "
                                     "ranges: use another server, or a copy on this machine",
                                     offset, offset + size - 1, answer.body.size(), answer.contentRange));
        return remembered(name, range->total, std::move(answer.body));
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

    void count(const HttpAnswer& answer) const {
        if (!traffic_) return;
        const std::lock_guard lock(mutex_);
        ++traffic_->requests;
        traffic_->bytes += answer.body.size();
    }

    std::string address_;
    std::shared_ptr<Traffic> traffic_;
    RetryClock clock_;
    http::HttpClient client_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::uint64_t> sizes_;
};

}  // namespace

std::shared_ptr<const Store> openHttpStore(std::string address, std::shared_ptr<Traffic> traffic, RetryClock clock) {
    return std::make_shared<HttpStore>(std::move(address), std::move(traffic), std::move(clock));
}

}  // namespace svt::city
