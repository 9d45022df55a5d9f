#pragma once
/// \file
/// Entries of a `.svt` beside those of the volume, for libraries that keep their own data in it. One entry can be read by ranges of
/// bytes, without the rest of the file. A file can be written anew with other entries in place of some.
/// docs/formats/svt.md specifies the container.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::volume {

/// Reads exactly `size` bytes from `offset` on, of a file or an address.
using ReadRange = std::function<Result<std::string>(std::uint64_t offset, std::size_t size)>;

/// The place of an entry in its file.
struct EntryPlace {
    std::string name;
    std::uint64_t headerOffset = 0;  ///< of its local header
    std::uint64_t packedSize = 0;    ///< bytes in the file
    std::uint64_t size = 0;          ///< bytes of the unpacked data
    std::uint32_t crc = 0;           ///< CRC-32 of the unpacked data
    bool isDeflated = false;
};

/// The entries of a file that is read by ranges. Copyable; any thread may read if `read` allows it.
class ZipRanges {
public:
    /// Maximum size of a central directory, bytes.
    static constexpr std::uint64_t kMaxDirectory = std::uint64_t{64} << 20;

    /// Reads the end of the file and its central directory: 98 bytes, and about 60 per entry.
    /// \param size  bytes of the file
    /// \return the entries, or BadVolume, or an error of `read`
    [[nodiscard]] static Result<ZipRanges> open(ReadRange read, std::uint64_t size);
    /// The same for a file.
    /// \return or CannotOpen
    [[nodiscard]] static Result<ZipRanges> open(const std::filesystem::path& path);

    [[nodiscard]] const std::vector<EntryPlace>& entries() const noexcept { return entries_; }
    [[nodiscard]] const EntryPlace* find(std::string_view name) const noexcept;

    /// Data of an entry, unpacked and checked against the CRC.
    /// \return the data, or BadChecksum, BadVolume; InputTooBig if they have more than `maxBytes`
    [[nodiscard]] Result<std::vector<std::byte>> unpacked(const EntryPlace& entry, std::uint64_t maxBytes) const;

    /// Offset of the data of an entry in the file; reads its local header, at most 65,565 bytes.
    /// \return the offset, or BadVolume
    [[nodiscard]] Result<std::uint64_t> dataOffset(const EntryPlace& entry) const;

    /// Bytes of the file.
    [[nodiscard]] Result<std::string> bytes(std::uint64_t offset, std::size_t size) const {
        return read_(offset, size);
    }

private:
    ReadRange read_;
    std::uint64_t size_ = 0;
    std::vector<EntryPlace> entries_;
};

/// An entry to write.
struct NewEntry {
    std::string name;  ///< printable ASCII, folders separated by '/'
    std::vector<std::span<const std::byte>> parts;
    bool isDeflated = false;
};

/// Writes a copy of a ZIP file, atomically. The entries that are kept come first, in their order and with the same bytes.
/// \param input   the whole file; not that of the path, unless it is in memory
/// \param isKept  whether the entry with this name stays
/// \return bytes written, or BadVolume, CannotWrite, DiskFull; BadArgument for an entry whose name is kept, too
[[nodiscard]] Result<std::uint64_t> writeWithEntries(std::span<const std::byte> input,
                                                     const std::filesystem::path& output,
                                                     const std::function<bool(std::string_view)>& isKept,
                                                     std::span<const NewEntry> entries);

/// CRC-32 as in ZIP.
[[nodiscard]] std::uint32_t checksumOf(std::span<const std::byte> bytes);

/// One zstd frame with stated content size, as all frames of a `.svt`. Equal bytes give equal frames.
/// \param what  name of the content for messages
/// \return the frame, or BadArgument if zstd fails
[[nodiscard]] Result<std::vector<std::byte>> packFrame(std::span<const std::uint8_t> bytes, std::string_view what);
/// \return the bytes; BadVolume for a frame that is damaged, or states more than `maxBytes` or 1 MiB + 1024 times its size
[[nodiscard]] Result<std::vector<std::uint8_t>> unpackFrame(std::span<const std::byte> frame, std::uint64_t maxBytes,
                                                            std::string_view what);

}  // namespace svt::volume
