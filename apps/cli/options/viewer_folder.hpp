#pragma once
/// \file
/// Where the files of the page are.

#include <svt/core/result.hpp>

#include <filesystem>

namespace svt::cli {

/// The folder of the page: `given`, or share/svt/viewer beside the program's folder where that is empty.
/// \return the folder, or CannotOpen if it has no page
[[nodiscard]] Result<std::filesystem::path> findViewerFolder(const std::filesystem::path& given);

}  // namespace svt::cli
