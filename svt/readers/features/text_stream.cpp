#include <svt/readers/features/text_stream.hpp>

#include <svt/readers/feature_file.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace svt::readers::features {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;

}  // namespace

Error TextStream::error(Code code, std::string message) const {
    return {code, std::move(message), {path_.string(), 0, 0, {}}};
}

Result<TextStream> TextStream::open(const std::filesystem::path& path) {
    TextStream stream;
    stream.path_ = path;
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed))
        return stream.error(Code::CannotOpen, "not a file that can be read");
    stream.size_ = std::filesystem::file_size(path, failed);
    stream.file_.open(path, std::ios::binary);
    if (!stream.file_ || failed) return stream.error(Code::CannotOpen, "the file cannot be read");
    char magic[3] = {};
    stream.file_.read(magic, sizeof magic);
    stream.isGzip_ = stream.file_.gcount() == 3 && std::memcmp(magic, "\x1F\x8B\x08", 3) == 0;
    stream.file_.clear();
    stream.file_.seekg(0);
    return stream;
}

Result<bool> TextStream::more() {
    // The same limit as in readModel(): models unpack to 5 to 50 times their size.
    constexpr std::uint64_t kMaxRatio = 100, kFreeBytes = std::uint64_t{64} << 20;
    if (isEnd_) return false;
    if (buffer_.size() - front_ > FeatureFile::kMaxFeatureBytes)
        return error(Code::InputTooBig,
                     fmt::format("one feature has more than {} bytes; split it", FeatureFile::kMaxFeatureBytes));
    if (front_ > buffer_.size() / 2 && front_ > kPiece) {
        buffer_.erase(0, front_);
        front_ = 0;
    }
    const std::size_t before = buffer_.size();
    while (buffer_.size() == before && !isEnd_) {
        std::string& to = isGzip_ ? packed_ : buffer_;
        const std::size_t at = isGzip_ ? 0 : before;
        to.resize(at + kPiece);
        file_.read(to.data() + at, static_cast<std::streamsize>(kPiece));
        const auto got = static_cast<std::size_t>(file_.gcount());
        to.resize(at + got);
        taken_ += got;
        isEnd_ = got == 0;
        if (!isGzip_) continue;
        if (gzip_.append(std::as_bytes(std::span(packed_)), buffer_) != InflateStatus::Done)
            return error(Code::CannotOpen, fmt::format("damaged gzip data before byte {}", taken_));
        unpacked_ += buffer_.size() - before;
        if (unpacked_ > std::max(kFreeBytes, taken_ * kMaxRatio))
            return error(Code::InputTooBig, fmt::format("the gzip data unpack to more than {} times their size; unpack "
                                                        "the file (gunzip) if it is not damaged",
                                                        kMaxRatio));
        if (isEnd_ && !gzip_.isComplete())
            return error(Code::CannotOpen, "the gzip data end too early; the file seems to be cut off");
    }
    return buffer_.size() != before;
}

void TextStream::discard(std::uint64_t offset) {
    if (line_ != 0) line_ += xml::countLines(window().substr(0, static_cast<std::size_t>(offset - base_)));
    front_ += static_cast<std::size_t>(offset - base_);
    base_ = offset;
}

void TextStream::seek(std::uint64_t offset) {
    buffer_.clear();
    front_ = 0;
    base_ = offset;
    line_ = 0;
    isEnd_ = false;
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
}

}  // namespace svt::readers::features
