#pragma once
/// \file
/// The model in a zip archive, such as an .ifczip file.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers {

/// A file of an archive that is not unpacked yet.
struct ZipMember {
    std::string name;
    std::span<const std::byte> packed;
    std::uint64_t size = 0;      ///< unpacked, according to the archive
    std::uint32_t checksum = 0;  ///< of the unpacked bytes, according to the archive
    bool isDeflated = false;     ///< else stored
};

[[nodiscard]] bool isZip(std::span<const std::byte> bytes) noexcept;

/// The one file of an archive whose name ends in one of `extensions` (lower case, with the dot). Companion files of
/// macOS (`__MACOSX/`, `._name`) do not count.
/// \param archive  in messages
/// \return the member, or CannotOpen: damaged, encrypted, of another method than deflate, or with several such files;
///         UnknownFormat: no such file
/// Cost: O(files). No ZIP64.
[[nodiscard]] Result<ZipMember> findZipMember(std::span<const std::byte> bytes, std::string_view archive,
                                              std::span<const std::string_view> extensions);

/// Whether `unpacked` are the bytes that were put into the archive.
/// \return success, or CannotOpen if the size or the checksum differs
[[nodiscard]] Result<void> checkZipMember(const ZipMember& member, std::span<const std::byte> unpacked,
                                          std::string_view archive);

}  // namespace svt::readers
