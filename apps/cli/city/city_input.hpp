#pragma once
/// \file
/// Cities as inputs of commands that work on volumes.

#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/city_page.hpp>

#include <svt/city/city_view.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace svt::cli {

/// Prints what a city has, for `svt info` and `svt city info`. \return the exit code
int printCity(const std::filesystem::path& folder, bool json);

/// Memory that tiles may take: half of --memory, or 1 GB.
[[nodiscard]] std::uint64_t tileMemory();

/// Asks each tile of a city, one after the other, so that memory is that of one tile for each thread.
/// \param box   west, south, lowest, east, north, highest; empty: all of the city
/// \param work  called in the order of tiles, never twice at once; an error ends it
/// \param isWanted  tiles that are read; null: all
[[nodiscard]] Result<void> forEachTile(const city::City& city, const std::vector<double>& box, int threads,
                                       const Progress* progress,
                                       const std::function<Result<void>(const volume::SemanticVolume&)>& work,
                                       const std::function<bool(const city::IndexEntry&)>& isWanted = {});

}  // namespace svt::cli
