#pragma once
/// \file
/// `svt check` of a city: whether all of it is there and can be read, and which solids have holes.

#include <filesystem>

namespace svt::cli {

/// Reads all tiles, prints what was counted, and findings. \return the exit code: that of findings, as of models
int checkCity(const std::filesystem::path& folder);

}  // namespace svt::cli
