#pragma once
/// \file
/// Internal: the ZIP dialect of the `.svt` file. Entries stored or deflated, sizes and CRC32 in the local headers,
/// fixed timestamps, data aligned to 64 bytes, so that any zip tool opens the file and parts of it can be read in
/// place. docs/formats/svt.md specifies it to the bit.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::volume {

inline constexpr std::size_t kZipAlignment = 64;

/// An entry to write: its data are `parts` one after the other.
struct ZipSource {
    std::string name;  ///< printable ASCII, folders separated by '/'
    std::vector<std::span<const std::byte>> parts;
    bool isAligned = true;  ///< false: no extra field, so that the data of the first entry stand at a fixed offset
    bool isDeflated = false;
};

/// An entry found; views of the container's bytes.
struct ZipEntry {
    std::string_view name;
    std::span<const std::byte> data;  ///< as they stand in the file
    std::uint32_t crc = 0;            ///< of the data when unpacked
    std::uint64_t size = 0;           ///< of the data when unpacked
    bool isDeflated = false;
};

/// CRC-32 (ISO-HDLC, as in ZIP) of `bytes` after bytes whose CRC is `before`, computed on all cores where they are
/// many. Cost: under 1 s per GB and core.
[[nodiscard]] std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// Writes the entries in their order as one file, all or nothing. The same entries give the same bytes. Data are
/// deflated on all cores; stored where that gains nothing, or where unpack() would refuse the ratio.
/// \param zip64From  sizes and offsets from this on are written in ZIP64 form; only tests choose another
/// \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeZip(const std::filesystem::path& path, std::span<const ZipSource> entries,
                                             std::uint64_t zip64From = 0xFFFFFFFFu);

/// The entries in the order of the central directory. Everything that the bytes claim is checked against the bytes
/// themselves: places, sizes, names, both headers of each entry. The CRC is not checked here.
/// \return the entries, or BadVolume that says what is wrong with which entry
[[nodiscard]] Result<std::vector<ZipEntry>> readZip(std::span<const std::byte> bytes);

/// Data of an entry, unpacked into `buffer` where they are deflated, and checked against the CRC.
/// \return the data; BadChecksum; BadVolume where they cannot be unpacked or claim to unpack to more than 64 MiB + 128
///         times their bytes in the file; InputTooBig over `maxBytes`
[[nodiscard]] Result<std::span<const std::byte>> unpack(const ZipEntry& entry, std::uint64_t maxBytes,
                                                        std::vector<std::byte>& buffer);

}  // namespace svt::volume
