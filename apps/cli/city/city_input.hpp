#pragma once
/// \file
/// Cities as inputs of commands that work on volumes.

#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/city_page.hpp>

#include <svt/city/city_folder.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace svt::cli {

/// Prints what a city has, for `svt info` and `svt city info`. \return the exit code
[[nodiscard]] Result<int> printCity(const std::filesystem::path& folder, bool json);

/// Memory that tiles may take: half of --memory, or 1 GB.
[[nodiscard]] std::uint64_t tileMemory();

/// Reads all tiles, prints what was counted, and findings, for `svt check`. \return the exit code: that of findings, as of
/// models
[[nodiscard]] Result<int> checkCity(const std::filesystem::path& folder);

/// A box of west, south, lowest, east, north, highest in plan; everything where it is empty.
[[nodiscard]] std::array<double, 4> rectangleOf(const std::vector<double>& box);

}  // namespace svt::cli
