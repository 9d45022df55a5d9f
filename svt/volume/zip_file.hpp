#pragma once
/// \file
/// ZIP files of other formats, written by the container of the `.svt` file.

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace svt::volume {

/// A file in a ZIP file.
struct ZippedFile {
    std::string name;  ///< printable ASCII, folders separated by '/'
    std::vector<std::byte> bytes;
};

/// A ZIP file with these files in the given order, stored without compression and with fixed times. Equal files give equal
/// bytes.
/// \param files  with different names
[[nodiscard]] Result<std::vector<std::byte>> makeZip(std::span<const ZippedFile> files);

}  // namespace svt::volume
