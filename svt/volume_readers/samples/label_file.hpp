#pragma once
/// \file
/// The file of a label volume. Headers and samples of a large file are copied with checked reads, so a file that
/// another program shortens causes an error and not a signal.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace svt::volume_readers {

/// Bytes of a file.
struct FilePart {
    std::uint64_t offset = 0, size = 0;
};

/// Threads: safe for concurrent reads.
class LabelFile {
public:
    /// Larger files stay on the disk, and parts of them are read.
    static constexpr std::uint64_t kMaxInMemory = std::uint64_t{64} << 20;

    /// \return the file, or CannotOpen as FileBytes
    [[nodiscard]] static Result<std::shared_ptr<const LabelFile>> open(const std::filesystem::path& path,
                                                                       std::uint64_t maxInMemory = kMaxInMemory);

    /// The size of the file when it was opened.
    [[nodiscard]] std::uint64_t size() const noexcept;
    /// The part from `offset` to the end.
    [[nodiscard]] FilePart from(std::uint64_t offset) const noexcept {
        return {offset, size() - std::min(offset, size())};
    }

    /// \param part    bytes of it after the end of the file are left out
    /// \param buffer  receives the part if the file is not in memory; keep it as long as the result
    /// \return the part, or CannotOpen if the file no longer has it
    [[nodiscard]] Result<std::string_view> text(FilePart part, std::string& buffer) const;
    [[nodiscard]] Result<std::span<const std::byte>> bytes(FilePart part, std::string& buffer) const;
    /// The first bytes, for detection of the format; empty if they cannot be read.
    [[nodiscard]] std::string head(std::size_t size) const;

private:
    explicit LabelFile(std::variant<FileBytes, PartFile> file) : file_(std::move(file)) {}

    std::variant<FileBytes, PartFile> file_;
};

/// The file lives as long as it has readers.
using SharedFile = std::shared_ptr<const LabelFile>;

/// Reads a file at any position, and keeps the last piece that it read. One thread at a time.
class FileWindow {
public:
    /// \param piece  bytes per read
    FileWindow(SharedFile file, std::size_t piece) : file_(std::move(file)), piece_(piece) {}
    FileWindow(const FileWindow&) = delete;
    FileWindow& operator=(const FileWindow&) = delete;

    /// The text from `offset` on: at least `size` bytes, or all up to the end of the file. More bytes may follow. Valid
    /// until the next call.
    /// \return the text, or CannotOpen if the file no longer has it
    [[nodiscard]] Result<std::string_view> at(std::uint64_t offset, std::size_t size);
    /// \return the first position of `text` within `from` to `end`; `end` if it is not there; or CannotOpen as at()
    [[nodiscard]] Result<std::uint64_t> find(std::string_view text, std::uint64_t from, std::uint64_t end);
    [[nodiscard]] const LabelFile& file() const noexcept { return *file_; }

private:
    SharedFile file_;
    std::size_t piece_;
    std::uint64_t offset_ = 0;
    std::string buffer_;
    std::string_view text_;
};

/// Unsigned numbers anywhere in a file. A number that is outside of the file, or cannot be read, is 0 and sets `isCut`.
class FileNumbers {
public:
    FileNumbers(SharedFile file, std::endian order) : window_(std::move(file), kPiece), order_(order) {}

    /// \param size  of the number, 1 to 8 bytes
    [[nodiscard]] std::uint64_t number(std::uint64_t offset, std::size_t size);
    /// `size` bytes; empty if the file has fewer.
    [[nodiscard]] std::string text(std::uint64_t offset, std::uint64_t size);
    [[nodiscard]] std::uint64_t fileSize() const noexcept { return window_.file().size(); }

    bool isCut = false;
    /// The error of the last failed read, or else `otherwise`.
    [[nodiscard]] Error fault(const Error& otherwise) const { return fault_ ? *fault_ : otherwise; }

private:
    static constexpr std::size_t kPiece = 4096;  // numbers are in tables, which may lie far apart

    FileWindow window_;
    std::endian order_;
    std::optional<Error> fault_;
};

}  // namespace svt::volume_readers
