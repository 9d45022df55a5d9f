#pragma once
/// \file
/// The text of a file from start to end through a window; gzip data are unpacked.

#include <svt/core/deflate.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace svt::readers::features {

class TextStream {
public:
    /// \return CannotOpen
    [[nodiscard]] static Result<TextStream> open(const std::filesystem::path& path);

    /// The text in the window; begins at offset base().
    [[nodiscard]] std::string_view window() const noexcept { return std::string_view(buffer_).substr(front_); }
    [[nodiscard]] std::uint64_t base() const noexcept { return base_; }
    /// The line at base(), from 1; 0 after seek(): unknown.
    [[nodiscard]] std::uint64_t line() const noexcept { return line_; }
    [[nodiscard]] bool isGzip() const noexcept { return isGzip_; }
    [[nodiscard]] double progress() const noexcept { return size_ == 0 ? 1 : double(taken_) / double(size_); }

    /// Reads more into the window.
    /// \return false at the end of the text; CannotOpen for damaged data; InputTooBig for data that unpack to too much,
    ///         or for a window beyond FeatureFile::kMaxFeatureBytes
    Result<bool> more();
    /// Forgets the text before `offset` (>= base()).
    void discard(std::uint64_t offset);
    /// Moves the window of a file that is not packed to an offset, and empties it.
    void seek(std::uint64_t offset);

private:
    [[nodiscard]] Error error(Code code, std::string message) const;

    std::filesystem::path path_;
    std::ifstream file_;
    GzipStream gzip_;
    std::string buffer_, packed_;
    std::size_t front_ = 0;
    std::uint64_t base_ = 0, line_ = 1, taken_ = 0, size_ = 0, unpacked_ = 0;
    bool isGzip_ = false, isEnd_ = false;
};

}  // namespace svt::readers::features
