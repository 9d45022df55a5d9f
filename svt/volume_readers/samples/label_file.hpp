#pragma once
/// \file
/// The file of a label volume. Headers and samples of a large file are copied out of it with checked reads: a file that
/// another program shortens gives an error and no signal.

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

/// Threads: parts may be read at once.
class LabelFile {
public:
    /// Larger files stay on the disk, and parts of them are read.
    static constexpr std::uint64_t kMaxInMemory = std::uint64_t{64} << 20;

    /// \return the file, or CannotOpen as FileBytes
    [[nodiscard]] static Result<std::shared_ptr<const LabelFile>> open(const std::filesystem::path& path,
                                                                       std::uint64_t maxInMemory = kMaxInMemory);

    /// When it was opened.
    [[nodiscard]] std::uint64_t size() const noexcept;
    /// From `offset` to the end.
    [[nodiscard]] FilePart from(std::uint64_t offset) const noexcept {
        return {offset, size() - std::min(offset, size())};
    }

    /// \param part    what of it lies behind the end of the file is left out
    /// \param buffer  receives the part where the file is not in memory; keep it as long as the result
    /// \return the part, or CannotOpen where the file no longer has it
    [[nodiscard]] Result<std::string_view> text(FilePart part, std::string& buffer) const;
    [[nodiscard]] Result<std::span<const std::byte>> bytes(FilePart part, std::string& buffer) const;
    /// The first bytes, by which formats are told; empty where they cannot be read.
    [[nodiscard]] std::string head(std::size_t size) const;

private:
    explicit LabelFile(std::variant<FileBytes, PartFile> file) : file_(std::move(file)) {}

    std::variant<FileBytes, PartFile> file_;
};

/// The file lives as long as somebody reads from it.
using SharedFile = std::shared_ptr<const LabelFile>;

/// Reads a file here and there, and keeps the piece that it has read last. One thread at a time.
class FileWindow {
public:
    /// \param piece  how much is read at a time
    FileWindow(SharedFile file, std::size_t piece) : file_(std::move(file)), piece_(piece) {}
    FileWindow(const FileWindow&) = delete;
    FileWindow& operator=(const FileWindow&) = delete;

    /// The text from `offset` on: `size` bytes or as many as the file has, and what is at hand behind them. Valid until
    /// the next call.
    /// \return the text, or CannotOpen where the file no longer has it
    [[nodiscard]] Result<std::string_view> at(std::uint64_t offset, std::size_t size);
    /// \return where `text` begins first, from `from` on and ending at `end` at most; `end` where it does not stand; or
    ///         CannotOpen as at()
    [[nodiscard]] Result<std::uint64_t> find(std::string_view text, std::uint64_t from, std::uint64_t end);
    [[nodiscard]] const LabelFile& file() const noexcept { return *file_; }

private:
    SharedFile file_;
    std::size_t piece_;
    std::uint64_t offset_ = 0;
    std::string buffer_;
    std::string_view text_;
};

/// Unsigned numbers anywhere in a file. What lies outside of it, or cannot be read, is 0 and sets `isCut`.
class FileNumbers {
public:
    FileNumbers(SharedFile file, std::endian order) : window_(std::move(file), kPiece), order_(order) {}

    /// \param size  of the number, 1 to 8 bytes
    [[nodiscard]] std::uint64_t number(std::uint64_t offset, std::size_t size);
    /// `size` bytes; empty if they are not all there.
    [[nodiscard]] std::string text(std::uint64_t offset, std::uint64_t size);
    [[nodiscard]] std::uint64_t fileSize() const noexcept { return window_.file().size(); }

    bool isCut = false;
    /// The error of what could not be read, or else `otherwise`.
    [[nodiscard]] Error fault(Error otherwise) const { return fault_ ? *fault_ : otherwise; }

private:
    static constexpr std::size_t kPiece = 4096;  // numbers stand in tables, which may lie far apart

    FileWindow window_;
    std::endian order_;
    std::optional<Error> fault_;
};

}  // namespace svt::volume_readers
