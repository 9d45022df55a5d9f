#pragma once
/// \file
/// The changes between two states of a city, from the tiles that differ.

#include <apps/cli/diff/compared.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/city/city_changes.hpp>
#include <svt/compare/comparison.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::cli {

struct CityComparison {
    Table rows;     ///< of comparisonTable(): rows that differ
    Json rowsJson;  ///< these rows, see rowsJson()
    std::vector<ClassSums> classes;
    /// Objects with geometry by their change; 0 for Change::Same, because tiles with equal bytes are not counted.
    std::array<std::size_t, compare::kChangeCount> counts{};
    std::array<std::size_t, compare::kChangeCount> groups{};  ///< likewise, features without geometry
    std::size_t otherProperties = 0;
    compare::PropertyCounts properties;
    bool isComplete = true;  ///< see Comparison::isComplete
    bool hasMeshes = false;  ///< a tile keeps its meshes
    std::uint64_t changedTiles = 0, equalTiles = 0, equalBuildings = 0, apart = 0;

    [[nodiscard]] bool isDifferent() const noexcept { return !rows.rows.empty(); }
};

/// Compares the tiles that differ, place by place.
/// \return the rows, or an error of findCityChanges(), readPlace(), compareVolumes()
/// Cost: that of findCityChanges(), and of compareVolumes() for each place that differs. Memory: one place, and the rows.
[[nodiscard]] Result<CityComparison> compareCities(const city::City& was, const city::City& is,
                                                   const compare::CompareOptions& options);

/// rows and summary, see docs/user/json.md.
[[nodiscard]] Json cityComparisonJson(const CityComparison& comparison);

/// "3 changed, 1 removed in 2 of 14 tiles; 12 tiles with 812 buildings are equal"
[[nodiscard]] std::string citySummary(const CityComparison& comparison);

}  // namespace svt::cli
