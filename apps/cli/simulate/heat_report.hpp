#pragma once
/// \file
/// The reports of `svt simulate heat`: a table of rooms, and JSON.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/simulate/heat.hpp>
#include <svt/simulate/heat_over_time.hpp>

#include <string>
#include <vector>

namespace svt::cli {

/// A row per room, and one for outside air; over time, for each time.
[[nodiscard]] Table heatTable(const volume::SemanticVolume& volume, const simulate::HeatResult& result);
[[nodiscard]] Table heatTable(const volume::SemanticVolume& volume, const simulate::HeatOverTime& result);

/// Everything except the field.
[[nodiscard]] Json heatJson(const volume::SemanticVolume& volume, const simulate::HeatResult& result);
[[nodiscard]] Json heatJson(const volume::SemanticVolume& volume, const simulate::HeatOverTime& result);

/// Notes on the figures: assumptions, the share of faces without a plane, leaks.
[[nodiscard]] std::vector<std::string> heatNotes(const volume::SemanticVolume& volume,
                                                 const simulate::HeatResult& result);
[[nodiscard]] std::vector<std::string> heatNotes(const simulate::HeatOverTime& result);

}  // namespace svt::cli
