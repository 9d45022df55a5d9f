#pragma once
/// \file
/// Cities as inputs of commands that work on volumes.

#include <apps/cli/options/city_page.hpp>

#include <svt/city/city_folder.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace svt::cli {

/// Prints the figures of a city, for `svt info` and `svt city info`. \return the exit code
[[nodiscard]] Result<int> printCity(const std::filesystem::path& folder, bool json);

/// Memory that tiles may take: half of --memory, or 1 GB.
[[nodiscard]] std::uint64_t tileMemory();

/// Reads all tiles, and prints counts and findings, for `svt check`. \return the exit code, as for findings of models
[[nodiscard]] Result<int> checkCity(const std::filesystem::path& folder);

/// The rectangle in plan of a box (west, south, lowest, east, north, highest); kEverywhere for an empty box.
[[nodiscard]] std::array<double, 4> rectangleOf(const std::vector<double>& box);

}  // namespace svt::cli
