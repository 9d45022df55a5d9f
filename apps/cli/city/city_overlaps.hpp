#pragma once
/// \file
/// Space that two buildings of a city claim, in one tile or over the border of two.

#include <apps/cli/output/table.hpp>

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>

#include <filesystem>
#include <string>

namespace svt::cli {

/// Pairs of different buildings (labels without parent) that claim a sample of detail 0, of which the query selects one at
/// least or something below it. Within a tile they were counted when it was built; of two tiles all samples that both
/// fill are.
/// Cost: each tile is read once, and again for each neighbour that it reaches over to and that is not in memory.
[[nodiscard]] Result<Table> cityOverlaps(const std::filesystem::path& folder, const std::string& query,
                                         const Progress* progress);

}  // namespace svt::cli
