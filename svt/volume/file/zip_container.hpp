#pragma once
/// \file
/// The ZIP subset of the `.svt` file: entries are stored or deflated, sizes and CRC32 are in the local headers,
/// timestamps are fixed, data are aligned to 64 bytes. Any ZIP tool can open the file, and parts of it can be read in
/// place. docs/formats/svt.md specifies it to the bit.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::volume {

inline constexpr std::size_t kZipAlignment = 64;

/// Sizes and checksum of data that are copied from another file.
struct PackedAs {
    std::uint64_t size = 0;  ///< bytes of the unpacked data
    std::uint32_t crc = 0;   ///< of the unpacked data
    bool isDeflated = false;
};

/// An entry to write; its data are the concatenated `parts`.
struct ZipSource {
    std::string name;  ///< printable ASCII, folders separated by '/'
    std::vector<std::span<const std::byte>> parts;
    bool isAligned = true;  ///< false: no extra field; gives the data of the first entry a fixed offset
    bool isDeflated = false;
    std::optional<PackedAs> packed{};  ///< `parts` are written as they are, with this header; isDeflated has no meaning
};

/// An entry of a file; views of the bytes of the container.
struct ZipEntry {
    std::string_view name;
    std::span<const std::byte> data;  ///< as in the file
    std::uint32_t crc = 0;            ///< CRC-32 of the unpacked data
    std::uint64_t size = 0;           ///< bytes of the unpacked data
    bool isDeflated = false;
};

/// CRC-32 (ISO-HDLC, as in ZIP) of `bytes`, continuing from a CRC `before`. Large inputs are processed in parallel.
/// Cost: under 1 s per GB and core.
[[nodiscard]] std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// Writes the entries in the given order to a file, atomically. Equal entries give equal bytes. Data are deflated in
/// parallel; they are stored instead if deflating gains nothing, or if unpack() would reject the ratio.
/// \param zip64From  sizes and offsets of at least this value are written in ZIP64 form; only tests use another value
/// \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeZip(const std::filesystem::path& path, std::span<const ZipSource> entries,
                                             std::uint64_t zip64From = 0xFFFFFFFFu);

/// The bytes that writeZip() would write.
[[nodiscard]] Result<std::vector<std::byte>> zipBytes(std::span<const ZipSource> entries);

/// The entries in the order of the central directory. Offsets, sizes, names and both headers of each entry are checked
/// against the file; the CRC is not.
/// \return the entries, or BadVolume that names the entry and the reason
[[nodiscard]] Result<std::vector<ZipEntry>> readZip(std::span<const std::byte> bytes);

/// Data of an entry, unpacked into `buffer` if deflated, and checked against the CRC.
/// \return the data, or BadChecksum; BadVolume if they cannot be unpacked or claim to unpack to more than 64 MiB + 128
///         times their bytes in the file; InputTooBig if they are larger than `maxBytes`
[[nodiscard]] Result<std::span<const std::byte>> unpack(const ZipEntry& entry, std::uint64_t maxBytes,
                                                        std::vector<std::byte>& buffer);

}  // namespace svt::volume
