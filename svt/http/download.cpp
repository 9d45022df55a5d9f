#include <svt/http/download.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/http/http_client.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace svt::http {
namespace {

constexpr std::uint64_t kFirstBytes = std::uint64_t{64} << 10, kPieceBytes = std::uint64_t{8} << 20;

// A download in progress.
class Downloading {
public:
    Downloading(const std::string& address, const std::filesystem::path& to, const DownloadOptions& options)
        : address_(address), to_(to), options_(options) {}

    Result<std::uint64_t> run() {
        SVT_DO(begin());
        for (std::uint64_t offset = 0; offset == 0 || offset < total_; offset = file_->size()) {
            SVT_TRY(answer, ask(offset, offset == 0 ? kFirstBytes : kPieceBytes));
            if (answer->status == 200) return takeWhole(*answer);
            SVT_DO(takeRange(*answer, offset));
        }
        return finish();
    }

private:
    [[nodiscard]] Error wrong(std::string message, Code code = Code::CannotOpen) const {
        return {code, std::move(message), {address_, 0, 0, {}}};
    }
    [[nodiscard]] Error at(const Error& error) const { return {error.code(), error.message(), {address_, 0, 0, {}}}; }

    Result<void> begin() {
        file_.reset();
        head_.clear();
        isChecked_ = false;
        auto made = AtomicFile::create(to_);
        if (!made) return at(made.error());
        file_.emplace(std::move(*made));
        return {};
    }

    Result<std::uint64_t> finish() {
        const auto written = file_->commit(AtomicFile::Durability::Temporary);
        return written ? *written : Result<std::uint64_t>(at(written.error()));
    }

    // A request, with further attempts.
    Result<HttpAnswer> ask(std::uint64_t offset, std::uint64_t size) {
        for (int attempt = 1;; ++attempt) {
            HttpRequest request{address_, offset, size, {}, options_.progress};
            std::optional<Error> failed;
            if (size == 0) {
                SVT_DO(begin());  // the pieces of an earlier attempt are void
                request.take = [&](std::string_view piece) {
                    auto taken = append(piece);
                    if (!taken) failed = taken.error();
                    return taken.hasValue();
                };
            }
            auto answer = client_.ask(request);
            if (failed) return *failed;
            if (!answer) return at(answer.error());
            if (!answer->isWorthRetry()) return checked(std::move(*answer));
            const double seconds = retrySeconds(attempt, answer->retryAfter, options_.clock.now());
            if (attempt == kMostAttempts || seconds > kLongestRetrySeconds) return checked(std::move(*answer));
            options_.clock.wait(seconds);
        }
    }

    // An answer with bytes; otherwise the error.
    Result<HttpAnswer> checked(HttpAnswer answer) const {
        if (answer.isRefused())
            return wrong(fmt::format("the server has no such file (status {}); check the address", answer.status));
        if (std::string fault = faultMessage(answer); !fault.empty()) return wrong(std::move(fault));
        if (answer.status == 416) return wrong("the file of the server is empty");
        if (answer.status != 200 && answer.status != 206)
            return wrong(
                fmt::format("the server answers with status {}; check the address and its permissions", answer.status));
        return answer;
    }

    Result<void> checkSize(std::uint64_t bytes) const {
        if (bytes <= options_.maxBytes) return {};
        return wrong(fmt::format("the file has more than {}, the limit{}{}", bytesText(options_.maxBytes),
                                 options_.remedy.empty() ? "" : "; ", options_.remedy),
                     Code::InputTooBig);
    }

    // Appends bytes. The first ones are checked, as soon as there are enough of them.
    Result<void> append(std::string_view piece) {
        SVT_DO(checkSize(file_->size() + piece.size()));
        if (!isChecked_) {
            head_.append(piece.substr(0, kFirstBytes - head_.size()));
            if (head_.size() == kFirstBytes) SVT_DO(checkHead());
        }
        if (auto written = file_->write(piece); !written) return at(written.error());
        return {};
    }
    Result<void> checkHead() {
        if (std::exchange(isChecked_, true) || !options_.check) return {};
        auto done = options_.check(head_);
        return done ? Result<void>() : at(done.error());
    }

    Result<void> takeRange(const HttpAnswer& answer, std::uint64_t offset) {
        const auto range = parseContentRange(answer.contentRange);
        const std::uint64_t end = offset + answer.body.size();
        const bool isWhole =
            range && (answer.body.size() == (offset == 0 ? kFirstBytes : kPieceBytes) || end == range->total);
        if (!range || answer.isTooLong || range->first != offset || range->last + 1 != end || !isWhole)
            return wrong(
                fmt::format("asked for bytes from {} on, the server sent {} bytes as '{}'; use another server, "
                            "or a copy on this machine",
                            offset, answer.body.size(), answer.contentRange));
        if (offset != 0 && (range->total != total_ || answer.tag != tag_))
            return wrong("the file changed while it was read; try again");
        total_ = range->total;
        tag_ = answer.tag;
        SVT_DO(checkSize(total_));
        SVT_DO(append(answer.body));
        SVT_DO(checkHead());
        Progress::tell(options_.progress, "download", double(end) / double(total_));
        return {};
    }

    // The server has no ranges: the file was short enough for one, or is requested as a whole.
    Result<std::uint64_t> takeWhole(const HttpAnswer& first) {
        if (file_->size() != 0) return wrong("the server has sent ranges, and now sends whole files; try again");
        if (!first.isTooLong) {
            if (first.body.empty()) return wrong("the file of the server is empty");
            SVT_DO(append(first.body));
        } else {
            SVT_DO(ask(0, 0));
        }
        SVT_DO(checkHead());
        return finish();
    }

    const std::string& address_;
    const std::filesystem::path& to_;
    const DownloadOptions& options_;
    HttpClient client_;
    std::optional<AtomicFile> file_;
    std::uint64_t total_ = 0;
    std::string tag_, head_;
    bool isChecked_ = false;
};

}  // namespace

Result<std::uint64_t> downloadFile(const std::string& address, const std::filesystem::path& to,
                                   const DownloadOptions& options) {
    return Downloading(address, to, options).run();
}

}  // namespace svt::http
