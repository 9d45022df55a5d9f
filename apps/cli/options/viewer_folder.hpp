#pragma once
/// \file
/// The folder with the files of the page.

#include <svt/core/result.hpp>

#include <filesystem>

namespace svt::cli {

/// The folder of the page: `given`, or share/svt/viewer next to the program's folder if `given` is empty.
/// \return the folder, or CannotOpen if it has no page
[[nodiscard]] Result<std::filesystem::path> findViewerFolder(const std::filesystem::path& given);

}  // namespace svt::cli
