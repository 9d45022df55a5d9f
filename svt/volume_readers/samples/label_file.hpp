#pragma once
/// \file
/// The file of a label volume. Samples are copied out of it with checked reads: a file that another program shortens
/// gives an error and no signal.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace svt::volume_readers {

/// Threads: parts may be read at once.
class LabelFile {
public:
    /// Larger files are not read into memory but mapped. While somebody reads the header of a mapped file, another program
    /// must not shorten it: access raises SIGBUS.
    static constexpr std::uint64_t kMaxInMemory = std::uint64_t{64} << 20;

    /// \return the file, or CannotOpen as FileBytes
    [[nodiscard]] static Result<std::shared_ptr<const LabelFile>> open(const std::filesystem::path& path,
                                                                       std::uint64_t maxInMemory = kMaxInMemory);

    /// For headers and tables; part() gives samples.
    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_.bytes(); }
    [[nodiscard]] std::string_view text() const noexcept { return bytes_.text(); }

    /// \param stored  a part of bytes()
    /// \param buffer  receives the part where the file is mapped; keep it as long as the result
    /// \return the same bytes, safe to read, or CannotOpen where the file no longer has them
    [[nodiscard]] Result<std::span<const std::byte>> part(std::span<const std::byte> stored, std::string& buffer) const;

private:
    LabelFile(FileBytes bytes, std::optional<PartFile> parts) : bytes_(std::move(bytes)), parts_(std::move(parts)) {}

    FileBytes bytes_;
    std::optional<PartFile> parts_;  // of a mapped file
};

/// The file lives as long as somebody reads from it.
using SharedFile = std::shared_ptr<const LabelFile>;

}  // namespace svt::volume_readers
