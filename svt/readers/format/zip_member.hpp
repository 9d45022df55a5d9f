#pragma once
/// \file
/// The model in a zip archive, as .ifczip files are.

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
    std::uint64_t size = 0;   ///< as the archive says
    bool isDeflated = false;  ///< else stored
};

[[nodiscard]] bool isZip(std::span<const std::byte> bytes) noexcept;

/// The first file of an archive whose name ends in one of `extensions` (lower case, with the dot).
/// \param archive  in messages
/// \return the member, or CannotOpen: damaged, encrypted, of another method than deflate, or UnknownFormat: no such file
/// Cost: O(files). No ZIP64.
[[nodiscard]] Result<ZipMember> findZipMember(std::span<const std::byte> bytes, std::string_view archive,
                                              std::span<const std::string_view> extensions);

}  // namespace svt::readers
